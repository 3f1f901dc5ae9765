"""The ring: its normal form decides equality; what it holds, its angles, its fractions."""

from __future__ import annotations

import math
from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st

from dynsolve.algebra.angles import Angle, Contents, ContentsCollector, coordinates_in, integer_basis
from dynsolve.algebra.fourier import FourierForm, fourier_form, positive, terms_of
from dynsolve.algebra.fraction import RationalExpr, as_expr, equal, is_zero, simplified
from dynsolve.algebra.ring import Expr, Ring
from dynsolve.algebra.ring_values import build_ring, evaluate, value_of
from dynsolve.errors import AlgebraError
from dynsolve.notation.text import read
from dynsolve.notation.tree import Number, Power, Product, Quotient

# -- the ring: its normal form decides equality, and agrees with floating point ----------------------


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
        ("l1*sqrt(m1/l1)^2 - m1", "0"),  # what stands before a root: an inverse, a cosine, a sine
        ("sqrt(l1^2 + m1^2 - 2*l1*m1*cos(beta))^2", "l1^2 + m1^2 - 2*l1*m1*cos(beta)"),
        ("sqrt(l1 + m1*sin(beta))^2*sin(beta)", "l1*sin(beta) + m1 - m1*cos(beta)^2"),
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
        for ours, theirs in ((ring.cos(angle), math.cos(value)), (ring.sin(angle), math.sin(value))):
            assert evaluate(ours, VALUES) == pytest.approx(theirs, abs=1e-9 + rounding(ours))


def rounding(expr: Expr) -> float:
    """What terms of many signs may lose where they are added in floating point."""
    ring, found = expr.ring, 0.0
    for exponents, factor in expr.poly.terms():
        term = Expr(ring, ring.ctx.from_dict({tuple(map(int, exponents)): factor}))
        found += 1e-14 * abs(evaluate(term, VALUES))
    return found


@pytest.mark.parametrize("degrees", [15, 75, 105, -15])
def test_sums_of_angles_that_have_roots_need_no_further_generator(degrees: int) -> None:
    """60° - 45° = 15°"""
    angles = [Angle.of("q1") + Angle((), Fraction(degrees)) for degrees in (45, 60)]
    ring = build_ring([("q1", "revolute")], [], angles)
    value = ring.cos(Angle((), Fraction(degrees)))
    assert math.isclose(evaluate(value, {}), math.cos(math.radians(degrees)))


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


# -- what formulas hold that a ring must hold for them -----------------------------------------------


def contents(*texts: str) -> Contents:
    collector = ContentsCollector()
    collector.collect([read(text).tree for text in texts])
    return collector.contents


def test_each_is_noted_once_in_order_of_first_appearance() -> None:
    held = contents("m*l^2*cos(q1) + l*m*g*cos(q1)", "a/(m + l) + sqrt(3)*tan(beta)")
    assert held.symbols == ("m", "l", "q1", "g", "a", "beta")
    assert held.angles == (Angle.of("q1"), Angle.of("beta"))
    assert held.radicands == (3,)
    assert held.denominators == (read("m + l").tree, read("cos(beta)").tree)


def test_an_inner_root_stands_before_the_outer() -> None:
    assert contents("sqrt(1 + sqrt(a))").roots == (read("a").tree, read("1 + sqrt(a)").tree)


def test_what_occurs_in_either_occurs_in_both_joined() -> None:
    assert not Contents()
    assert contents("a", "b*c").joined(contents("c + d")).symbols == ("a", "b", "c", "d")


@pytest.mark.parametrize("text", ["sqrt(0 - 4)", "sin(90)"])
def test_what_no_ring_can_hold_is_refused(text: str) -> None:
    with pytest.raises(AlgebraError):
        contents(text)


# -- A basis of angles: independent, and every given angle an integer combination of it --------------


rates = st.sampled_from([Fraction(n, d) for n in range(-3, 4) for d in (1, 2, 3)])
vectors = st.lists(st.tuples(rates, rates, rates), max_size=5)


@given(vectors)
def test_every_vector_is_an_integer_combination(given_vectors: list[tuple[Fraction, ...]]) -> None:
    basis = integer_basis(given_vectors)
    for vector in given_vectors:
        found = coordinates_in(basis, vector)
        assert found is not None
        assert all(c.denominator == 1 for c in found)
        for i, x in enumerate(vector):
            assert sum((c * b[i] for c, b in zip(found, basis, strict=True)), Fraction(0)) == x


@given(vectors)
def test_the_basis_generates_nothing_else(given_vectors: list[tuple[Fraction, ...]]) -> None:
    basis = integer_basis(given_vectors)
    assert integer_basis([*given_vectors, *basis]) == basis


def test_what_serves_is_kept_in_its_order() -> None:
    absolute = [(Fraction(1), Fraction(0)), (Fraction(1), Fraction(1))]
    assert integer_basis([*absolute, (Fraction(0), Fraction(1))]) == absolute


def test_outside_the_span_and_of_no_basis_there_are_no_coordinates() -> None:
    one, two = (Fraction(1), Fraction(0)), (Fraction(2), Fraction(0))
    assert coordinates_in([one], (Fraction(0), Fraction(1))) is None
    assert coordinates_in([one, two], one) is None
    assert coordinates_in([], (Fraction(0),)) == ()


# -- the Fourier form: the same function, unique, and every angle with one sign ----------------------


ANGLES = (0.7, -1.3)


def value(form: FourierForm) -> float:
    total = 0.0
    for (name, n), factor in terms_of(form):
        total += float(factor) * getattr(math, name)(sum(k * a for k, a in zip(n, ANGLES, strict=True)))
    return total


powers = st.tuples(*[st.integers(0, 3)] * 4)
polynomials = st.dictionaries(powers, st.integers(-5, 5).filter(bool), max_size=5)


@given(polynomials)
def test_it_is_the_same_function(poly: dict[tuple[int, ...], int]) -> None:
    functions = [f(a) for a in ANGLES for f in (math.sin, math.cos)]
    plain = sum(f * math.prod(x**e for x, e in zip(functions, es, strict=True)) for es, f in poly.items())
    assert value(fourier_form(poly)) == pytest.approx(plain, abs=1e-9)


@given(polynomials)
def test_every_angle_has_one_sign(poly: dict[tuple[int, ...], int]) -> None:
    assert all(positive(n) == (1, n) for n in fourier_form(poly))


def test_what_is_equal_has_one_form() -> None:
    one_minus_sine_squared, cosine_squared = {(0, 0): 1, (2, 0): -1}, {(0, 2): 1}
    assert fourier_form(one_minus_sine_squared) == fourier_form(cosine_squared)
    half = Fraction(1, 2)
    assert fourier_form(cosine_squared) == {(0,): (half, 0), (2,): (half, 0)}


# -- fractions over a ring: simplified where they divide, and compared by cross-multiplication -------


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
