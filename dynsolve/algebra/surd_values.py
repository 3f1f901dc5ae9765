"""The exact value of a formula of numbers with roots, sines, cosines and their inverses.

What a solution of the inverse kinematics gives for numbers: a length is a sum of square
roots, an angle the direction of a point whose coordinates are.  What is neither has a value in
floating point.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from fractions import Fraction
from functools import reduce
from math import atan2, inf
from operator import add, mul
from typing import Any

from dynsolve.algebra.angles import angle_from_tree
from dynsolve.algebra.surd_angles import PI, SurdAngle
from dynsolve.algebra.surds import NotExact, Surd
from dynsolve.errors import AlgebraError
from dynsolve.notation.build import negated
from dynsolve.notation.tree import (
    Arguments,
    Degrees,
    Function,
    Negative,
    Node,
    Number,
    Parenthesized,
    Power,
    Product,
    Quotient,
    Sum,
    Symbol,
)
from dynsolve.notation.tree_values import FUNCTIONS, compile_trees

Exact = Surd | SurdAngle
"""A number, or an angle."""


class NoValue(AlgebraError):
    """A formula has no real value: `function` was taken of `argument`."""

    def __init__(self, function: str, argument: Node) -> None:
        super().__init__("this has no real value")
        self.function, self.argument = function, argument


class Undetermined(AlgebraError):
    """A formula has no definite value: 0/0, or the direction of a point to itself."""

    def __init__(self) -> None:
        super().__init__("this has no definite value")


def exact_value(node: Node, known: Mapping[str, Exact]) -> Exact:
    """The value of a formula; `known` are the values of its names.

    Raises NoValue for the root of a negative number and the like, Undetermined for 0/0, NotExact
    for what is neither a sum of roots nor such an angle.

    >>> from dynsolve.notation.text import read
    >>> value = exact_value(read("sqrt(12)/2 + cos(30deg)").tree, {})
    >>> value.node
    Quotient(numerator=Product(factors=(Number(p=3, q=1, decimal=False), Function(name='sqrt', argument=Number(p=3, q=1, decimal=False)))), denominator=Number(p=2, q=1, decimal=False))
    """  # noqa: E501
    match node:
        case Number(p, q):
            return Surd.of(Fraction(p, q))
        case Degrees(p, q):
            return SurdAngle.of_degrees(Fraction(p, q))
        case Symbol(name, 0) if node != PI:
            if name not in known:
                raise NotExact
            return known[name]
        case Parenthesized(argument):
            return exact_value(argument, known)
        case Negative(argument):
            return -exact_value(argument, known)
        case Function(name, argument):
            return _function(name, argument, known)
    if _is_angle(node):
        return SurdAngle.of_degrees(angle_from_tree(node).degrees)
    match node:
        case Sum(terms):
            return _sum([exact_value(term, known) for term in terms])
        case Product(factors):
            return _product([exact_value(factor, known) for factor in factors])
        case Quotient(numerator, denominator):
            return _quotient(exact_value(numerator, known), exact_value(denominator, known))
        case Power(base, Number(p, 1)):
            return reduce(mul, [_number(exact_value(base, known))] * p, Surd.of(1))
    raise NotExact


def _is_angle(node: Node) -> bool:
    """Whether a formula is a constant angle by itself: π/3."""
    try:
        return bool(angle_from_tree(node).degrees) and angle_from_tree(node).is_constant
    except AlgebraError:
        return False


def _function(name: str, argument: Node, known: Mapping[str, Exact]) -> Exact:
    if isinstance(argument, Arguments):
        y, x = (_number(exact_value(part, known)) for part in argument.parts)
        if x.is_zero and y.is_zero:
            raise Undetermined
        return SurdAngle(x, y)
    value = exact_value(argument, known)
    if name in ("sin", "cos", "tan"):
        return _of_angle(name, value)
    number = _number(value)
    if name == "sqrt":
        if number.sign < 0:
            raise NoValue(name, number.node)
        return number.root()
    if name == "atan":
        return SurdAngle(Surd.of(1), number)
    return _inverse(name, number)


def _of_angle(name: str, value: Exact) -> Surd:
    if not isinstance(value, SurdAngle):
        raise NotExact
    if name == "tan":
        if value.rest:
            raise NotExact
        return _quotient_of(value.y, value.x)
    return value.sine if name == "sin" else value.cosine


def _inverse(name: str, number: Surd) -> SurdAngle:
    """arccos or arcsin."""
    rest = Surd.of(1) - number * number
    if rest.sign < 0:
        raise NoValue(name, number.node)
    if name == "acos":
        return SurdAngle(number, rest.root())
    if name == "asin":
        return SurdAngle(rest.root(), number)
    raise NotExact


def _sum(values: list[Exact]) -> Exact:
    angles = [value for value in values if isinstance(value, SurdAngle)]
    numbers = [value for value in values if isinstance(value, Surd)]
    if angles and numbers:
        raise NotExact
    return reduce(add, angles) if angles else reduce(add, numbers)


def _product(values: list[Exact]) -> Exact:
    angles = [value for value in values if isinstance(value, SurdAngle)]
    number = reduce(mul, (value for value in values if isinstance(value, Surd)), Surd.of(1))
    if not angles:
        return number
    if len(angles) > 1 or number.rational is None:
        raise NotExact
    return angles[0].times(number.rational)


def _quotient(above: Exact, below: Exact) -> Exact:
    if isinstance(above, SurdAngle) and isinstance(below, Surd) and below.rational:
        return above.times(1 / below.rational)
    return _quotient_of(_number(above), _number(below))


def _quotient_of(above: Surd, below: Surd) -> Surd:
    if below.is_zero:
        if above.is_zero:
            raise Undetermined
        raise NoValue("/", above.node)
    return above / below


def _number(value: Exact) -> Surd:
    if isinstance(value, Surd):
        return value
    raise NotExact


# -- in floating point -----------------------------------------------------------------------------

DIGITS = 12
"""So many digits has a value that has no formula."""

_ROUNDING = 1e-9
"""What rounding may make of 0, and of what is on the boundary."""


def number_of(formula: Node, values: Mapping[str, float]) -> float:
    """The value of a formula; what is beyond a boundary by rounding alone is on it.

    Raises NoValue beyond that, Undetermined for the direction of a point to itself.
    """
    return float(compile_trees([formula], _NEARLY).run(values)[0])


def _within(name: str, low: float, high: float) -> Callable[[float], float]:
    """The function of this name between bounds."""

    def at(x: float) -> float:
        if not low - _ROUNDING <= x <= high + _ROUNDING:
            raise NoValue(name, decimal(x, 4))
        return float(FUNCTIONS[name](min(max(x, low), high)))

    return at


def _direction(both: tuple[float, float]) -> float:
    if max(map(abs, both)) < _ROUNDING:
        raise Undetermined
    return atan2(*both)


_NEARLY: dict[str, Callable[[Any], Any]] = {
    **FUNCTIONS,
    "acos": _within("acos", -1, 1),
    "asin": _within("asin", -1, 1),
    "sqrt": _within("sqrt", 0, inf),
    "atan2": _direction,
}


def decimal(value: float, digits: int = DIGITS) -> Node:
    """A number in floating point, as a decimal."""
    exact = Fraction(f"{value:.{digits}g}")
    size = Number(abs(exact.numerator), exact.denominator, decimal=True)
    return negated(size) if exact < 0 else size
