"""Derivatives that a student leaves to be taken, held against differences of numbers."""

from __future__ import annotations

from collections.abc import Mapping

import pytest

from dynsolve.notation.text import read
from dynsolve.notation.tree_values import evaluate
from tests.unit.answers.reading.grammar.test_notation import answer, values

FORMULAS = [
    # in plain text, as students write it in LaTeX
    ("m1*lc1^2*q1_dot", r"m_1l_{c1}^2\dot q_1"),
    ("(I1 + m2*l1^2*sin(q2)^2)*q1_dot", r"\left(I_1+m_2l_1^2\sin^2q_2\right)\dot q_1"),
    ("m2*l1*lc2*cos(q1 - 2*q2)*q1_dot*q2_dot", r"m_2l_1l_{c2}\cos(q_1-2q_2)\dot q_1\dot q_2"),
    ("m1*q1_dot^3/3 - m2*q2_dot^(-2)", r"\frac{m_1\dot q_1^3}3-m_2\dot q_2^{-2}"),
    ("m1*q1_dot/(2 + cos(q2))", r"\frac{m_1\dot q_1}{2+\cos q_2}"),
    ("m1*sqrt(2 + sin(q1))*tan(q2/9)", r"m_1\sqrt{2+\sin q_1}\tan\frac{q_2}{9}"),
    ("-g*lc1*(q1 + q2)^2", r"-gl_{c1}(q_1+q_2)^2"),
]
OPERATORS = [
    ("t", r"\frac{d}{dt}\left(%s\right)"),
    ("t", r"\dfrac{\mathrm d}{\mathrm dt}\left[%s\right]"),
    ("t", r"\frac{d\left(%s\right)}{dt}"),
    ("t", r"{\frac {\rm d}{{\rm d}t}}\left(%s\right)"),
    ("t", r"\left(%s\right)^{\cdot}"),
    ("t", r"\left(%s\right)'"),
    ("t", r"\dot{\left(%s\right)}"),
    ("q1", r"\frac{\partial}{\partial q_1}\left(%s\right)"),
    ("q2", r"\frac{\partial\left(%s\right)}{\partial q_2}"),
    ("q1_dot", r"\frac{\partial}{\partial\dot q_1}\left[%s\right]"),
]


def moved(at: Mapping[str, float], by: str, step: float) -> dict[str, float]:
    """The state a little later, or with one of its values changed."""
    if by != "t":
        return {**at, by: at[by] + step}
    later = dict(at)
    for q in ("q1", "q2"):
        later[q] += step * at[f"{q}_dot"] + step**2 / 2 * at[f"{q}_ddot"]
        later[f"{q}_dot"] += step * at[f"{q}_ddot"]
    return later


@pytest.mark.parametrize(("plain", "latex"), FORMULAS)
@pytest.mark.parametrize(("by", "operator"), OPERATORS)
def test_a_derivative_is_taken(plain: str, latex: str, by: str, operator: str) -> None:
    found = answer("planar-2r", "tau1", operator % latex + r" + 5m_2 g l_1").node
    assert found is not None
    of, at, step = read(plain, dots=True).tree, values("planar-2r"), 1e-5
    slope = (evaluate(of, moved(at, by, step)) - evaluate(of, moved(at, by, -step))) / (2 * step)
    assert evaluate(found, at) == pytest.approx(slope + 5 * at["m2"] * at["g"] * at["l1"], rel=1e-7)


def test_behind_a_constant_the_whole_term_is_meant() -> None:
    at, of = values("planar-2r"), r"m_1l_{c1}^2\sin q_2\,\dot q_1"
    bare, closed = (
        answer("planar-2r", "tau1", rf"\frac{{d}}{{dt}}{text} + m_1gl_1").node for text in (of, f"({of})")
    )
    assert bare is not None and closed is not None
    assert evaluate(bare, at) == pytest.approx(evaluate(closed, at))


def test_what_may_be_meant_otherwise_is_not_read() -> None:
    assert "not clear" in answer("planar-2r", "tau1", r"m_1g\frac{d}{dt}q_1\sin q_2").fault


@pytest.mark.parametrize("text", ["diff(m1*q1(t)^2*diff(q2(t), t), t)", "d/dt(m1*q1^2*q2_dot)"])
def test_what_programs_leave_to_be_taken(text: str) -> None:
    found, at = answer("planar-2r", "tau1", text).node, values("planar-2r")
    assert found is not None
    rate = 2 * at["q1"] * at["q1_dot"] * at["q2_dot"] + at["q1"] ** 2 * at["q2_ddot"]
    assert evaluate(found, at) == pytest.approx(at["m1"] * rate)
