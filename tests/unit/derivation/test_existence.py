"""For which parameters sums of sines and cosines can be 0, against their values on a grid."""

from __future__ import annotations

from itertools import product
from math import pi

import pytest

from dynsolve.algebra.angles import Angle
from dynsolve.algebra.inequality import Bound
from dynsolve.algebra.ring import Expr
from dynsolve.algebra.ring_values import build_ring, evaluate
from dynsolve.derivation.elimination import ParameterSigns
from dynsolve.derivation.existence import conditions
from dynsolve.notation.tree import Symbol

NAMES = ("a", "b", "k")
GRID = [2 * pi * i / 24 for i in range(24)]
TURNING = [Angle.of("q1"), Angle.of("q2")]
RING = build_ring(
    [("q1", "revolute"), ("q2", "revolute")], [Symbol(name) for name in NAMES], TURNING, TURNING
)
A, B, K = map(RING.symbol, NAMES)
Q1, Q2 = Angle.of("q1"), Angle.of("q2")
SINE, COSINE = RING.sin, RING.cos
ONE = RING.one


def found_on_grid(values: list[Expr], numbers: dict[str, float]) -> bool:
    """Whether the last changes its sign or is 0 along a line on which the others stay 0."""
    *fixed, last = values
    lines = [[(x, y + turned * x) for x in GRID] for y in GRID for turned in (0, -1)]
    lines += [[(x, y) for y in GRID] for x in GRID]
    for line in lines:
        points = [{**numbers, "q1": x, "q2": y} for x, y in line]
        if all(abs(evaluate(value, at)) < 1e-9 for value in fixed for at in points):
            here = [evaluate(last, at) for at in points]
            if min(here) <= 1e-9 and max(here) >= -1e-9:
                return True
    return False


@pytest.mark.parametrize(
    ("values", "count"),
    [
        ([A * (SINE(Q1) + SINE(Q1 + Q2)) - K], 1),
        ([A * COSINE(Q1) - B], 1),
        ([A * COSINE(Q1) + A * SINE(Q1) + K], 1),
        ([COSINE(Q1), A * SINE(Q1) * (ONE + COSINE(Q2)) - K], 1),
        ([SINE(Q2) - ONE, A * COSINE(Q1 + Q2) + B], 1),
        ([COSINE(Q1) + ONE, A * COSINE(Q1) - B * COSINE(Q1 + Q2) - K], 1),
        ([COSINE(Q1 + Q2), A * SINE(Q1) + B * SINE(Q1 + Q2) - K], 2),
    ],
)
def test_what_the_parameters_must_satisfy_is_what_a_grid_shows(values: list[Expr], count: int) -> None:
    bounds = conditions(values, ParameterSigns())
    assert bounds is not None and len(bounds) == count
    seen = set()
    for numbers in product((0.31, 1.13, 2.57), repeat=3):
        at = dict(zip(NAMES, numbers, strict=True))
        told = all(evaluate(bound.value, at) >= 0 for bound in bounds)
        assert told is found_on_grid(values, at)
        seen.add(told)
    assert seen == {True, False}


@pytest.mark.parametrize("values", [[COSINE(Q1), A * SINE(Q1) ** 2 + K], [A * COSINE(Q1) + A + K]])
def test_what_is_never_0_exists_for_no_parameters(values: list[Expr]) -> None:
    assert conditions(values, ParameterSigns()) is None


def test_a_condition_that_always_holds_is_none() -> None:
    """A cos q + B sin q is 0 somewhere, whatever A and B are."""
    assert conditions([(A - B) * COSINE(Q1) + K * SINE(Q1)], ParameterSigns()) == ()


def test_nor_is_one_that_follows_from_what_is_assumed() -> None:
    """k (g + l W²) - (M + m) g W² - M l W⁴ = (g + l W²)(k - (M + m) W²) + m l W⁴."""
    names = ("k", "g", "l", "W", "M", "m")
    ring = build_ring([], [Symbol(name) for name in names])
    k, g, length, w, body, point = map(ring.symbol, names)
    stiff = Bound(k - (body + point) * w * w)
    value = k * (g + length * w**2) - (body + point) * g * w**2 - body * length * w**4
    assert ParameterSigns((stiff,)).is_positive(value) and not ParameterSigns().is_positive(value)
