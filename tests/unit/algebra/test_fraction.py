"""Fractions over a ring: simplified where they divide, and compared by cross-multiplication."""

from __future__ import annotations

import pytest

from dynsolve.algebra.angles import Angle
from dynsolve.algebra.fraction import RationalExpr, as_expr, equal, is_zero, simplified
from dynsolve.algebra.ring_values import build_ring, value_of
from dynsolve.notation.text import read

RING = build_ring(
    [("q1", "revolute"), ("q2", "revolute")],
    [read(text).tree for text in ("1/m", "1/(m + l)")],
    [Angle.of("q1"), Angle.of("q2")],
)


def fraction(above: str, below: str) -> RationalExpr:
    return RationalExpr(value_of(RING, read(above).tree), value_of(RING, read(below).tree))


@pytest.mark.parametrize(
    ("above", "below", "quotient"),
    [
        ("sin(q1)^2", "1 - cos(q1)", "1 + cos(q1)"),
        ("m*cos(q1)", "2*cos(q1)", "m/2"),
        ("m^2 - l^2", "m + l", "m - l"),
        ("sin(q1)*cos(q2)^2", "sin(q1)", "cos(q2)^2"),
        ("3*l", "6", "l/2"),
    ],
)
def test_what_divides_is_divided(above: str, below: str, quotient: str) -> None:
    assert simplified(fraction(above, below)) == RationalExpr(value_of(RING, read(quotient).tree))


def test_fractions_are_equal_by_cross_multiplication() -> None:
    tangent = fraction("sin(q1)", "cos(q1)")
    assert equal(tangent, fraction("sin(q1)^2", "sin(q1)*cos(q1)"))
    assert not equal(tangent, fraction("cos(q1)", "sin(q1)"))


def test_a_parameter_below_becomes_an_inverse_and_a_joint_variable_does_not() -> None:
    assert as_expr(fraction("l", "m")) == value_of(RING, read("l/m").tree)
    assert as_expr(fraction("l", "cos(q1)")) is None
    more = [as_expr(fraction("l", f"m - {number}*l + {number}")) for number in range(5)]
    assert more[-1] is None, "the ring has room for a few more inverses only"


def test_zero_is_found_where_several_denominators_occur() -> None:
    expr = value_of(RING, read("1/m - 1/(m + l) - l/(m*(m + l))").tree)
    assert is_zero(expr)
    assert not is_zero(expr + RING.one)
