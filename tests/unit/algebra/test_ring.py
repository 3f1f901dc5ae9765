"""The ring: its normal form decides equality, and agrees with floating point."""

from __future__ import annotations

import math
from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st

from dynsolve.algebra.angles import Angle
from dynsolve.algebra.expr import Expr
from dynsolve.algebra.ring import Ring
from dynsolve.algebra.ring_values import build_ring, evaluate, value_of
from dynsolve.errors import AlgebraError
from dynsolve.notation.text import read
from dynsolve.notation.tree import Number, Power, Product, Quotient

COORDINATES = [("q1", "revolute"), ("q2", "revolute"), ("d3", "prismatic")]
VALUES = {"q1": 0.3, "q2": -1.1, "d3": 0.7, "l1": 0.8, "m1": 1.7, "m2": 0.4, "beta": 0.6}


def ring_of(*texts: str, angles: tuple[Angle, ...] = ()) -> tuple[Ring, list[Expr]]:
    """A ring that holds the formulas, and their values in it."""
    trees = [read(text).tree for text in texts]
    ring = build_ring(COORDINATES, trees, angles)
    return ring, [value_of(ring, tree) for tree in trees]


@pytest.mark.parametrize(
    ("left", "right"),
    [
        ("sin(q1)^2 + cos(q1)^2", "1"),
        ("cos(q1 + q2)", "cos(q1)*cos(q2) - sin(q1)*sin(q2)"),
        ("sin(2*q1)", "2*sin(q1)*cos(q1)"),
        ("cos(q1)", "2*cos(q1/2)^2 - 1"),
        ("sin(q1 + 90deg)", "cos(q1)"),
        ("cos(q1 + 30deg)", "sqrt(3)/2*cos(q1) - sin(q1)/2"),
        ("4*cos(10deg)^3 - 3*cos(10deg)", "sqrt(3)/2"),
        ("sin(18deg)", "(sqrt(5) - 1)/4"),
        ("cos(15deg)", "(sqrt(6) + sqrt(2))/4"),
        ("cos(17.3deg)^2", "1 - sin(17.3deg)^2"),
        ("tan(beta)*cos(beta)", "sin(beta)"),
        ("1/(2 + sqrt(3))", "2 - sqrt(3)"),
        ("m1/(m1 + m2) + m2/(m1 + m2)", "1"),
        ("l1*(m1/l1)", "m1"),
        ("sqrt(l1^2 + m1^2)^2", "l1^2 + m1^2"),
        ("sqrt(72)", "6*sqrt(2)"),
        ("1/((m1 + m2)*(m1 - m2))", "1/(m1^2 - m2^2)"),
        ("cos(pi/6)", "sqrt(3)/2"),
        ("9.81", "981/100"),
    ],
)
def test_equal_formulas_have_one_normal_form(left: str, right: str) -> None:
    _, (a, b) = ring_of(left, right)
    assert a == b, f"{a!r} is not {b!r}"
    assert evaluate(a, VALUES) == pytest.approx(evaluate(b, VALUES), rel=1e-12)


@pytest.mark.parametrize(
    ("left", "right"),
    [
        ("cos(2*q1)", "1"),
        ("sin(q1 + q2)", "sin(q1) + sin(q2)"),
        ("cos(10deg)", "1"),
        ("q1", "sin(q1)"),
        ("m1/(m1 + m2)", "m1"),
    ],
)
def test_different_formulas_have_different_normal_forms(left: str, right: str) -> None:
    _, (a, b) = ring_of(left, right)
    assert a != b


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("1/(m1 - m1)", "zero"),
        ("1/sin(q1)", "joint variable"),
        ("sin(90)", "bare number"),
        ("sqrt(0 - 4)", "negative"),
    ],
)
def test_what_has_no_exact_meaning_is_refused(text: str, message: str) -> None:
    with pytest.raises(AlgebraError, match=message):
        ring_of(text)


@given(
    st.lists(
        st.tuples(st.integers(-3, 3), st.integers(-3, 3), st.sampled_from([0, 30, 45, 90, 17, 200])),
        max_size=4,
    )
)
def test_sines_and_cosines_agree_with_floating_point(turns: list[tuple[int, int, int]]) -> None:
    angles = tuple(
        Angle.of("q1", Fraction(a, 2)) + Angle.of("q2", b) + Angle((), Fraction(degrees))
        for a, b, degrees in turns
    )
    ring = build_ring(COORDINATES, [], angles)
    for (a, b, degrees), angle in zip(turns, angles, strict=True):
        value = a / 2 * VALUES["q1"] + b * VALUES["q2"] + math.radians(degrees)
        assert evaluate(ring.cos(angle), VALUES) == pytest.approx(math.cos(value), abs=1e-9)
        assert evaluate(ring.sin(angle), VALUES) == pytest.approx(math.sin(value), abs=1e-9)


def test_a_product_is_bounded_before_it_is_formed() -> None:
    power = Power(read("m1 + m2 + l1 + d3 + q1").tree, Number(12))
    with pytest.raises(AlgebraError, match="too many terms"):
        value_of(build_ring(COORDINATES, [power]), Product((power, power)))


FORMULAS = [
    "m1*l1^2*cos(q1 + q2)",
    "sin(q1)*d3^2",
    "cos(q2/2)^3*l1",
    "m2*sin(q1 - 2*q2)*d3 + l1",
    "sin(q2 + 30deg)*d3",
]


@pytest.mark.parametrize("text", FORMULAS)
@pytest.mark.parametrize("k", range(3))
def test_derivatives_agree_with_differences(text: str, k: int) -> None:
    ring, (value,) = ring_of(text)
    name, step = COORDINATES[k][0], 1e-6
    ahead = evaluate(value, {**VALUES, name: VALUES[name] + step})
    behind = evaluate(value, {**VALUES, name: VALUES[name] - step})
    assert evaluate(ring.diff(value, k), VALUES) == pytest.approx((ahead - behind) / (2 * step), abs=1e-8)


@pytest.mark.parametrize("text", FORMULAS)
def test_the_time_derivative_is_the_chain_rule(text: str) -> None:
    ring, (value,) = ring_of(text)
    chain = ring.zero
    for k, (name, _) in enumerate(COORDINATES):
        chain += ring.diff(value, k) * ring.symbol(name, 1)
    assert ring.time_derivative(value) == chain


def test_at_rest_all_coordinates_are_zero() -> None:
    ring, (value, expected) = ring_of("l1*cos(q1 + 30deg) + d3*sin(q2) + cos(q2)", "l1*sqrt(3)/2 + 1")
    assert ring.at_rest(value) == expected


def test_an_inverse_is_refused_where_its_value_is_unknown() -> None:
    ring, _ = ring_of("m1")
    assert value_of(ring, Quotient(Number(1), Number(4))) == ring.constant(Fraction(1, 4))
    with pytest.raises(AlgebraError, match="not a symbol"):
        ring.symbol("nobody")
