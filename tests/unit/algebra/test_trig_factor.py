"""Products of factors in sines and cosines are taken apart again, whatever their normal form hides."""

from __future__ import annotations

import pytest

from dynsolve.algebra.angles import Angle
from dynsolve.algebra.factors import leading, squares, trig_factors, trig_quotient
from dynsolve.algebra.ring import Expr, Ring
from dynsolve.algebra.ring_values import build_ring, value_of
from dynsolve.notation.text import read

COORDINATES = [("d1", "prismatic"), ("q2", "revolute"), ("q3", "revolute")]

FACTORS = [
    ["sin(q2)"],
    ["sin(q2)", "sin(q2)"],
    ["sin(q2)", "cos(q2)"],
    ["sin(q2)", "sin(q2) + cos(q2)"],  # the normal form is 1 - c² + s c
    ["sin(q2 + q3)", "cos(q3)"],
    ["L*cos(q2) + l*cos(q2 + q3)", "sin(q2)", "sin(q3)"],
    ["d1 + L + l*cos(q3)", "cos(q3)"],
    ["cos(q2) - 1", "sin(q3)"],
    ["L*sin(q2) - d1*cos(q3)", "L + l*cos(q2)"],
    ["d1", "d1 - L"],
    ["sqrt(2)*sin(q2) + cos(q3)", "sin(q2)"],
    ["d1 + sqrt(2)*L", "d1 + sqrt(2)*L", "cos(q2) - sqrt(2)/2"],
    ["d1 + sqrt(6)*L*sin(q2)", "sqrt(2)*L + sqrt(3)*cos(q3)", "1 + cos(q2)"],
    ["sin(q2)*cos(q3) + sqrt(3)*cos(q2)*sin(q3)", "L*cos(q2) + l*sqrt(3)*sin(q3)"],
]


def ring_of(texts: list[str]) -> Ring:
    angles = [Angle.of("q2"), Angle.of("q3")]
    return build_ring(COORDINATES, [read(text).tree for text in texts], angles, angles)


def same_up_to_a_number(a: Expr, b: Expr) -> bool:
    quotient = trig_quotient(a, b)
    return quotient is not None and leading(quotient) == quotient


@pytest.mark.parametrize("texts", FACTORS, ids=" · ".join)
def test_the_factors_of_a_product(texts: list[str]) -> None:
    ring = ring_of(texts)
    wanted = [value_of(ring, read(text).tree) for text in texts]
    product = ring.one
    for factor in wanted:
        product = product * factor
    found = [factor for factor, times in trig_factors(product) for _ in range(times)]
    assert len(found) == len(wanted)
    for factor in wanted:
        assert any(same_up_to_a_number(factor, other) for other in found)


def test_what_is_irreducible_stays_whole() -> None:
    ring = ring_of(["L*cos(q2) + l"])
    expr = value_of(ring, read("L*cos(q2) + l").tree)
    assert len(trig_factors(expr)) == 1


def test_a_number_has_no_factors() -> None:
    assert trig_factors(ring_of([]).constant(6)) == ()


def test_a_quotient_keeps_its_number() -> None:
    ring = ring_of(["sqrt(2)"])
    a, b = (value_of(ring, read(text).tree) for text in ("-3*sqrt(2)*sin(q2)", "d1 + cos(q3)"))
    assert trig_quotient(a * b, b) == a
    assert trig_quotient(a * b, b + b * b) is None


def test_what_must_be_0_where_a_sum_of_squares_is() -> None:
    ring = ring_of(["L", "l"])
    found = squares(value_of(ring, read("L + L*cos(q2)*cos(q3)").tree))
    zero = ["(1 + cos(q2))*(1 + cos(q3))", "(1 - cos(q2))*(1 - cos(q3))"]
    wanted = [value_of(ring, read(text).tree) for text in zero]
    assert len(found) == 2 and all(any(same_up_to_a_number(a, b) for b in found) for a in wanted)
    assert squares(value_of(ring, read("L + d1*cos(q2)").tree)) == ()
