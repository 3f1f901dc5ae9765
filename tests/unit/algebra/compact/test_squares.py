"""Squares of sums of sines and cosines, found in polynomials that are multiplied out."""

from __future__ import annotations

import random

import pytest

from dynsolve.algebra.angles import Angle
from dynsolve.algebra.compact.compactor import Compactor
from dynsolve.algebra.expr import Expr
from dynsolve.algebra.ring import Ring
from dynsolve.algebra.ring_values import build_ring, evaluate
from dynsolve.notation.tree import Symbol
from dynsolve.notation.tree_values import evaluate as value_of_tree
from dynsolve.notation.unicode import to_unicode


def ring() -> Ring:
    joints = [("q1", "revolute"), ("q2", "revolute"), ("d3", "prismatic")]
    angles = [Angle.of("q1"), Angle.of("q1") + Angle.of("q2")]
    return build_ring(joints, [Symbol(name) for name in ("m", "a", "b", "l")], angles)


R = ring()
Q1, Q12 = Angle.of("q1"), Angle.of("q1") + Angle.of("q2")
M, A, B, L = map(R.symbol, ("m", "a", "b", "l"))
C1, S1, C12, S12, D3 = R.cos(Q1), R.sin(Q1), R.cos(Q12), R.sin(Q12), R.symbol("d3")

FORMS = [
    # an arm in a turning plane: Murray, Li, Sastry (1994), example 4.3, has m_3 (l_1 c_2 + r_2 c_23)²
    (M * (A * C1 + B * C12) ** 2, "m (a cos(q₁) + b cos(q₁ + q₂))²"),
    (M * (A * S1 + B * S12) ** 2, "m (a sin(q₁) + b sin(q₁ + q₂))²"),
    (M * (A * C1 - B * C12) ** 2, "m (a cos(q₁) - b cos(q₁ + q₂))²"),
    (M * (L + A * C1 + B * C12) ** 2, "m (l + a cos(q₁) + b cos(q₁ + q₂))²"),
    (M * (L + A * S1) ** 2, "m (l + a sin(q₁))²"),
    # sines and cosines together: a mass centre beside the axis of its link
    (M * (A * C1 - B * S12) ** 2, "m (a cos(q₁) - b sin(q₁ + q₂))²"),
    (M * (A * C1 - B * S1) ** 2, "m (b sin(q₁) - a cos(q₁))²"),
    (M * (A * C1 + B * C12) ** 2 + M * L**2, "m (l² + (a cos(q₁) + b cos(q₁ + q₂))²)"),
    # no square: the elbow's own coupling, and a difference of squares
    (M * (A**2 + B**2 + A * B * C1 * 2), "m (a² + b² + 2a b cos(q₁))"),
    # a rod that slides past its joint: the distance of its middle, and its moment about that
    (M * (D3**2 - D3 * L + L**2 / 3), "m ((d₃ - l/2)² + l²/12)"),
    (M * (D3**2 + D3 * L + L**2 / 3), "m ((l/2 + d₃)² + l²/12)"),
]


@pytest.mark.parametrize(("value", "form"), FORMS, ids=[form for _, form in FORMS])
def test_forms(value: Expr, form: str) -> None:
    assert to_unicode(Compactor(R, ["m"], [["q1", "q2"]]).form(value)) == form


def test_what_is_written_is_what_was_meant() -> None:
    draw = random.Random(3)
    for _ in range(40):
        roots = [draw.choice((-2, -1, 1, 3)) * one for one in (A * C1, B * C12, L, B * S1, A * S12)]
        value = M * sum(draw.sample(roots, draw.randint(2, 4)), R.zero) ** 2 + M * draw.choice(roots) * D3
        state = {name: draw.uniform(0.3, 1.5) for name in ("m", "a", "b", "l", "q1", "q2", "d3")}
        tree = Compactor(R, ["m"], [["q1", "q2"]]).form(value)
        assert value_of_tree(tree, state) == pytest.approx(evaluate(value, state))
