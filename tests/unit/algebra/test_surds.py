"""Sums of square roots, and angles with such sines and cosines: exact, and as a person would write them."""

from __future__ import annotations

from fractions import Fraction
from math import atan2, isclose, pi

import pytest

from dynsolve.algebra.surds import NotExact, NoValue, Surd, SurdAngle, Undetermined, exact_value
from dynsolve.notation.text import read
from dynsolve.notation.tree import Arguments, Function, Node
from dynsolve.notation.unicode import UnicodePrinter


def shown(node: Node) -> str:
    return UnicodePrinter().text(node)


# (a formula, its value)
NUMBERS = [
    ("sqrt(12)", "2√3"),
    ("sqrt(1/2)", "√2/2"),
    ("(1 + sqrt(2))/(1 - sqrt(2))", "-3 - 2√2"),
    ("1/(sqrt(2) + sqrt(3) + sqrt(5))", "√2/4 + √3/6 - √30/12"),
    ("sqrt(3 - 2*sqrt(2))", "√2 - 1"),
    ("sqrt(2 + sqrt(3))", "√2/2 + √6/2"),
    ("cos(15deg)", "√2/4 + √6/4"),
    ("sin(pi/3 + 90deg)", "½"),
    ("tan(30deg)", "√3/3"),
    ("(sqrt(2) + sqrt(3))^2 - 5 - 2*sqrt(6)", "0"),
]


@pytest.mark.parametrize(("formula", "value"), NUMBERS)
def test_numbers(formula: str, value: str) -> None:
    found = exact_value(read(formula).tree, {})
    assert isinstance(found, Surd)
    assert shown(found.node) == value


# (y, x, the angle as it is written)
ANGLES = [
    ("0", "-1", "π"),
    ("-1", "-1", "-3π/4"),
    ("sqrt(3)", "1", "π/3"),
    ("sqrt(6) - sqrt(2)", "sqrt(6) + sqrt(2)", "π/12"),
    ("8", "6", "atan2(4, 3)"),
    ("sqrt(8)", "1", "arccos(⅓)"),
    ("-sqrt(8)", "-1", "-arccos(-⅓)"),
    ("1", "sqrt(8)", "arcsin(⅓)"),
    ("-1", "sqrt(8)", "-arcsin(⅓)"),
    ("2*sqrt(2)", "3*sqrt(2)", "atan2(2, 3)"),
]


@pytest.mark.parametrize(("y", "x", "written"), ANGLES)
def test_angles(y: str, x: str, written: str) -> None:
    parts = Arguments((read(y).tree, read(x).tree))
    found = exact_value(Function("atan2", parts), {})
    assert isinstance(found, SurdAngle)
    assert shown(found.node) == written
    values = [exact_value(part, {}) for part in parts.parts]
    assert isclose(float(found), atan2(*map(float, values)), rel_tol=1e-14)


def test_the_sum_of_two_angles_is_one_angle() -> None:
    both = [SurdAngle(Surd.of(x), Surd.of(y)) for x, y in ((2, 1), (3, 1))]
    assert (both[0] + both[1]).is_same(SurdAngle.of_degrees(45))
    assert not (both[0] + both[1]).is_same(SurdAngle.of_degrees(225))


# (some degrees, what is added to atan2(4, 3), the sum as it is written)
SUMS = [
    ("20deg", "25deg", "atan2(7, -1)"),
    ("-145deg", "0deg", "atan2(-4, -3) + 7π/36"),
    ("100deg", "-10deg", "atan2(3, -4)"),
]


@pytest.mark.parametrize(("first", "second", "written"), SUMS)
def test_degrees_that_have_no_exact_sine_stand_beside_a_direction(
    first: str, second: str, written: str
) -> None:
    one, other = (exact_value(read(text).tree, {}) for text in (first, second))
    direction = exact_value(Function("atan2", Arguments((read("4").tree, read("3").tree))), {})
    assert isinstance(one, SurdAngle) and isinstance(other, SurdAngle) and isinstance(direction, SurdAngle)
    found = one + direction + other
    assert shown(found.node) == written
    turns = (float(one) + float(other) + atan2(4, 3) - float(found)) / (2 * pi)
    assert isclose(turns, round(turns), abs_tol=1e-12)
    assert (found + -found).is_same(SurdAngle.of_degrees(0))


def test_degrees_alone_are_a_part_of_pi() -> None:
    assert shown(SurdAngle.of_degrees(Fraction(-145)).node) == "-29π/36"


@pytest.mark.parametrize(
    ("function", "argument"), [("sqrt", "1 - sqrt(2)"), ("acos", "5/4"), ("asin", "-1 - sqrt(2)/1000")]
)
def test_what_is_not_real_says_of_what(function: str, argument: str) -> None:
    with pytest.raises(NoValue) as error:
        exact_value(Function(function, read(argument).tree), {})
    assert error.value.function == function


def test_the_direction_of_a_point_to_itself_is_undetermined() -> None:
    zero = read("sqrt(8) - 2*sqrt(2)").tree
    with pytest.raises(Undetermined):
        exact_value(Function("atan2", Arguments((zero, zero))), {})


@pytest.mark.parametrize("formula", ["sqrt(1 + sqrt(2))", "cos(20deg)", "x"])
def test_what_is_no_sum_of_roots_is_refused(formula: str) -> None:
    with pytest.raises(NotExact):
        exact_value(read(formula).tree, {})


def test_the_sign_of_a_sum_that_is_nearly_zero() -> None:
    # 1351/780 is a convergent of the continued fraction of √3, greater by 4.7e-7; 978122/564719 by 9e-13
    for p, q in ((1351, 780), (978122, 564719)):
        assert (Surd.of(Fraction(p, q)) - Surd.of(3).root()).sign == 1
