"""Names of quantities inside values: the student's own answers, or definitions."""

from __future__ import annotations

import pytest
from msgspec.structs import replace

from dynsolve.answers.verdict import JudgedAnswer
from dynsolve.notation import tree
from tests.unit.answers.hands import (
    Text,
    answer,
    checker,
    submission,
    verdicts,
)
from tests.unit.answers.judging.elbow import D11, D12, D22, ELBOW


def _referring(*names: str) -> tree.Node:
    return tree.Sum(tuple(tree.Reference(name) for name in names))


def _with_reference(own: dict[str, Text], name: str, value: tree.Node) -> JudgedAnswer:
    """A hand-in whose last answer names others."""
    hand = submission(own)
    one = replace(answer(name, "0", 99), node=value)
    report = checker(ELBOW)(replace(hand, answers=(*hand.answers, one)))
    return next(a for a in report.answers if a.name == name)


def test_a_name_inside_a_value_is_the_students_own_answer() -> None:
    second = {"P2": "m2*g*(l1*sin(q1) + lc2*sin(q1 + q2))"}
    right = _with_reference({"P1": "m1*g*lc1*sin(q1)", **second}, "P", _referring("P1", "P2"))
    assert right.verdict == "correct"
    carried = _with_reference({"P1": "m1*g*l1*sin(q1)", **second}, "P", _referring("P1", "P2"))
    assert (carried.verdict, carried.follows_from) == ("follows", ("P1",))


@pytest.mark.parametrize("name", ["g2", "c121", "d12", "C12", "K1"])
def test_a_name_that_is_given_nowhere_makes_a_definition(name: str) -> None:
    found = _with_reference({}, name, tree.Reference(name))
    assert (found.verdict, found.given) == ("missing", False)
    assert found.notes == (f"{name} stands in it and is given nowhere: this is a definition",)


def test_a_name_of_an_entry_is_of_the_matrix_that_was_handed_in() -> None:
    own: dict[str, Text] = {"D": [[D11, f"2*({D12})"], [D12, D22]]}
    assert _with_reference(own, "d21", tree.Reference("d12")).verdict == "wrong"


MODEL = r"$$\tau_1 = d_{11}\ddot q_1 + d_{12}\ddot q_2 + c_{121}\dot q_1\dot q_2 + c_{221}\dot q_2^2 + g_1$$"
ENERGY = r"$$K = \frac12(d_{11}\dot q_1^2 + 2d_{12}\dot q_1\dot q_2 + d_{22}\dot q_2^2)$$"
D_ENTRIES = (
    r"$$d_{11} = m_1 l_{c1}^2 + m_2(l_1^2+l_{c2}^2+2l_1 l_{c2} c_2)+I_1+I_2$$"
    r"$$d_{12} = m_2(l_{c2}^2+l_1l_{c2}c_2)+I_2$$ $$d_{22} = m_2 l_{c2}^2+I_2$$"
)
SPEED = r"$$K_1 = \frac12 m_1 v_{c1}^T v_{c1} + \frac12 I_1 \dot q_1^2$$"
JACOBIAN = r"$$J_{v1} = \begin{bmatrix} -l_{c1} s_1 & 0 \\ l_{c1} c_1 & 0\\0&0\end{bmatrix}$$"


@pytest.mark.parametrize(
    ("text", "name", "verdict", "listed"),
    [
        (MODEL, "tau1", "missing", 1),
        (ENERGY, "K", "missing", 1),
        (ENERGY + D_ENTRIES, "K", "correct", 0),
        (D_ENTRIES.replace("+I_1+", "+2I_1+") + ENERGY, "K", "wrong", 0),
        (SPEED, "K1", "missing", 1),
        (SPEED + JACOBIAN, "K1", "correct", 0),
        (MODEL + D_ENTRIES, "tau1", "missing", 1),
        (MODEL + MODEL + D_ENTRIES, "tau1", "missing", 2),
    ],
)
def test_what_only_repeats_a_definition_earns_nothing(
    text: str, name: str, verdict: str, listed: int
) -> None:
    one = checker(ELBOW)
    report = one(one.reader(text, "report.md"))
    found = next(a for a in report.answers if a.name == name)
    assert (str(found.verdict), len(report.not_recognized)) == (verdict, listed)
    assert ("given nowhere" in "".join(found.notes)) == (verdict == "missing")


def test_what_needs_an_answer_that_cannot_be_read_cannot_be_read() -> None:
    one = checker(ELBOW)
    report = one(one.reader("answers:\n  d12: foo(((\n  d21: d12\n", "a.yaml"))
    assert verdicts(report)["d21"] == "unreadable"
