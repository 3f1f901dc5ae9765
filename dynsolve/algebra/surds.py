"""Sums of square roots: exact real numbers Σ cᵢ √mᵢ, the c rational, the m squarefree.

Square roots of different squarefree whole numbers are linearly independent over the rationals,
so a sum is 0 exactly when it has no terms.

Exact angles: directions of points (x, y) whose coordinates are sums of roots, and degrees beside them.

The exact value of a formula of numbers with roots, sines, cosines and their inverses.

What a solution of the inverse kinematics gives for numbers: a length is a sum of square
roots, an angle the direction of a point whose coordinates are.  What is neither has a value in
floating point.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from fractions import Fraction
from functools import cache, reduce
from math import atan2, copysign, gcd, inf, isqrt, pi, radians, sqrt
from operator import add, mul
from typing import Any

from flint import arb, ctx, fmpz
from msgspec import Struct
from msgspec.structs import replace

from dynsolve.algebra.angles import angle_from_tree
from dynsolve.algebra.rationals import rational
from dynsolve.errors import AlgebraError
from dynsolve.notation.build import cost, negated, times, total
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
    walk,
)
from dynsolve.notation.tree_values import FUNCTIONS, compile_trees

MOST_BITS = 96
"""Larger numbers under a root are not taken apart into factors."""

MOST_TERMS = 16
"""Sums of more roots are no help to a reader."""

_CLEAR = 1e-9
"""A value of more than this part of its terms has the sign that floating point gives it."""


class NotExact(AlgebraError):
    """A number that is no sum of square roots, or too long a one."""

    def __init__(self) -> None:
        super().__init__("this is no short sum of square roots")


class Surd(Struct, frozen=True):
    """Σ cᵢ √mᵢ, sorted by m; `==` decides equality exactly.

    >>> half = Surd.of(Fraction(1, 2))
    >>> root = Surd.of(3).root()
    >>> (half * root + half) / (half * root - half) == root + Surd.of(2)
    True
    >>> (Surd.of(4) - root * Surd.of(2)).root() == root - Surd.of(1)
    True
    """

    terms: tuple[tuple[int, Fraction], ...] = ()

    @staticmethod
    def of(value: Fraction | int) -> Surd:
        """A rational number."""
        return _surd({1: Fraction(value)})

    @property
    def is_zero(self) -> bool:
        """Whether it is 0."""
        return not self.terms

    @property
    def rational(self) -> Fraction | None:
        """Its value where it is rational."""
        if not self.terms:
            return Fraction(0)
        return self.terms[0][1] if len(self.terms) == 1 and self.terms[0][0] == 1 else None

    def __add__(self, other: Surd) -> Surd:
        found = dict(self.terms)
        for m, c in other.terms:
            found[m] = found.get(m, Fraction(0)) + c
        return _surd(found)

    def __neg__(self) -> Surd:
        return Surd(tuple((m, -c) for m, c in self.terms))

    def __sub__(self, other: Surd) -> Surd:
        return self + -other

    def __mul__(self, other: Surd) -> Surd:
        found: dict[int, Fraction] = {}
        for m, c in self.terms:
            for n, d in other.terms:
                shared = gcd(m, n)
                product = m * n // shared**2
                found[product] = found.get(product, Fraction(0)) + c * d * shared
        return _surd(found)

    def __truediv__(self, other: Surd) -> Surd:
        """The quotient; the divisor is not 0."""
        top, below = self, other
        while below.rational is None:
            conjugate = below._conjugate()
            top, below = top * conjugate, below * conjugate
        value = below.rational
        return Surd(tuple((m, c / value) for m, c in top.terms))

    def _conjugate(self) -> Surd:
        """The sum with the other sign for the roots that hold one of its primes."""
        prime = int(fmpz(self.terms[-1][0]).factor()[0][0])
        return Surd(tuple((m, -c if m % prime == 0 else c) for m, c in self.terms))

    def root(self) -> Surd:
        """The square root of what is not negative; raises NotExact where it is no sum of roots."""
        value = self.rational
        if value is not None:
            return _root(value)
        if len(self.terms) == 2 and self.terms[0][0] == 1:
            (_, a), (m, b) = self.terms
            difference = _root(a * a - b * b * m).rational if a * a >= b * b * m else None
            if difference is not None and a > 0:
                larger, smaller = _root((a + difference) / 2), _root((a - difference) / 2)
                return larger + smaller if b > 0 else larger - smaller
        raise NotExact

    @property
    def sign(self) -> int:
        """1, 0 or -1"""
        parts = [float(c) * sqrt(m) for m, c in self.terms]
        if not parts:
            return 0
        value = sum(parts)
        if abs(value) > _CLEAR * sum(map(abs, parts)):
            return 1 if value > 0 else -1
        bits = 128
        while True:
            with ctx.workprec(bits):
                near = sum((arb(rational(c)) * arb(m).sqrt() for m, c in self.terms), arb(0))
                if near > 0 or near < 0:
                    return 1 if near > 0 else -1
            bits *= 2

    def __float__(self) -> float:
        with ctx.workprec(128):
            return float(sum((arb(rational(c)) * arb(m).sqrt() for m, c in self.terms), arb(0)))

    @property
    def node(self) -> Node:
        """The number as a formula."""
        return total([_term(m, c) for m, c in self.terms])


def _surd(terms: Mapping[int, Fraction]) -> Surd:
    found = tuple(sorted((m, c) for m, c in terms.items() if c))
    if len(found) > MOST_TERMS:
        raise NotExact
    return Surd(found)


def _root(value: Fraction) -> Surd:
    """√(p/q) = √(p q) / q"""
    product = value.numerator * value.denominator
    outside, inside = _squares_out(product)
    return _surd({inside: Fraction(outside, value.denominator)}) if product else Surd()


def _squares_out(number: int) -> tuple[int, int]:
    """(a, m) with number = a² m, m squarefree."""
    whole = isqrt(number)
    if whole * whole == number:
        return whole, 1
    if number.bit_length() > MOST_BITS:
        raise NotExact
    outside = inside = 1
    for prime, exponent in fmpz(number).factor():
        outside *= int(prime) ** (exponent // 2)
        inside *= int(prime) ** (exponent % 2)
    return outside, inside


def _term(m: int, c: Fraction) -> Node:
    if m == 1:
        return times(c, [])
    return times(c, [(Function("sqrt", Number(m)), 1)])


def whole_multiple(values: Iterable[Surd]) -> Fraction:
    """The positive factor that makes all coefficients whole numbers without a common divisor."""
    factors = [c for value in values for _, c in value.terms]
    if not factors:
        return Fraction(1)
    above = gcd(*(c.numerator for c in factors))
    below = 1
    for c in factors:
        below = below * c.denominator // gcd(below, c.denominator)
    return Fraction(below, above)


# Exact angles

PI = Symbol("pi")

_STEP = 15
"""The sines and cosines of the multiples of so many degrees are sums of roots."""


class SurdAngle(Struct, frozen=True):
    """The angle of the point (x, y), which is not the origin, and `rest` degrees; modulo 2π.

    The length of (x, y) means nothing.  `rest` is 0 or no multiple of 15, between -45 and 45.

    >>> right = SurdAngle(Surd.of(0), Surd.of(1))
    >>> (right + right).is_same(SurdAngle.of_degrees(180))
    True
    """

    x: Surd
    y: Surd
    rest: Fraction = Fraction(0)

    @staticmethod
    def of_degrees(degrees: Fraction | int) -> SurdAngle:
        """A constant angle."""
        steps = Fraction(degrees) / _STEP
        if steps.denominator == 1:
            return _multiples()[int(steps) % (360 // _STEP)]
        quarters = round(Fraction(degrees) / 90)
        quarter = _multiples()[quarters * 90 // _STEP % (360 // _STEP)]
        return SurdAngle(quarter.x, quarter.y, Fraction(degrees) - 90 * quarters)

    @property
    def norm(self) -> Surd:
        """√(x² + y²); raises NotExact where it is no sum of roots, or there is a rest."""
        if self.rest:
            raise NotExact
        return (self.x * self.x + self.y * self.y).root()

    @property
    def cosine(self) -> Surd:
        """cos, exact."""
        return self.x / self.norm

    @property
    def sine(self) -> Surd:
        """sin, exact."""
        return self.y / self.norm

    def __add__(self, other: SurdAngle) -> SurdAngle:
        x = self.x * other.x - self.y * other.y
        y = self.x * other.y + self.y * other.x
        size = Surd.of(whole_multiple((x, y)))
        both = SurdAngle(x * size, y * size)
        if not (self.rest or other.rest):
            return both
        more = SurdAngle.of_degrees(self.rest + other.rest)
        return replace(both + replace(more, rest=Fraction(0)), rest=more.rest)

    def __neg__(self) -> SurdAngle:
        return SurdAngle(self.x, -self.y, -self.rest)

    def times(self, factor: Fraction) -> SurdAngle:
        """A whole multiple; raises NotExact for another."""
        if factor.denominator != 1 or abs(factor) > 12:
            raise NotExact
        one = self if factor > 0 else -self
        found = SurdAngle.of_degrees(0)
        for _ in range(abs(int(factor))):
            found = found + one
        return found

    def is_same(self, other: SurdAngle) -> bool:
        """Whether both are one angle, modulo 2π."""
        across = self.x * other.y - self.y * other.x
        return self.rest == other.rest and across.is_zero and (self.x * other.x + self.y * other.y).sign > 0

    def __float__(self) -> float:
        """The angle in radians, greater than -π and at most π."""
        value = atan2(float(self.y), float(self.x)) + radians(self.rest)
        if value > pi or value <= -pi:
            value -= copysign(2 * pi, value)
        return pi if not self.rest and self.y.is_zero and self.x.sign < 0 else value

    @property
    def node(self) -> Node:
        """The angle as a formula: π/3, arccos(1/3), atan2(4, 3)."""
        direction = replace(self, rest=Fraction(0))
        for steps, angle in enumerate(_multiples()):
            if direction.is_same(angle):
                degrees = steps * _STEP + self.rest
                return times((degrees if degrees <= 180 else degrees - 360) / 180, [(PI, 1)])
        if self.rest:
            return total([direction.node, times(self.rest / 180, [(PI, 1)])])
        return min(self._written(), key=lambda node: (_roots(node), cost(node)))

    def _written(self) -> Iterator[Node]:
        size = Surd.of(whole_multiple((self.x, self.y)))
        x, y = self.x * size, self.y * size
        yield _atan2(y, x)
        shared = {m for m, _ in (*x.terms, *y.terms)}
        for m in sorted(shared - {1}):
            root = Surd(((m, Fraction(1)),))
            size = Surd.of(whole_multiple((x * root, y * root)))
            yield _atan2(y * root * size, x * root * size)
        try:
            norm = self.norm
        except NotExact:
            return
        cosine, sine = self.x / norm, self.y / norm
        if cosine.rational is not None:
            found = Function("acos", cosine.node)
            yield found if sine.sign > 0 else negated(found)
        if sine.rational is not None:
            angle: Node = Function("asin", (sine if sine.sign > 0 else -sine).node)
            parts = [angle] if cosine.sign > 0 else [PI, negated(angle)]
            yield total(parts if sine.sign > 0 else [negated(part) for part in parts])


def _roots(node: Node) -> int:
    return sum(isinstance(part, Function) and part.name == "sqrt" for part in walk(node))


def _atan2(y: Surd, x: Surd) -> Node:
    return Function("atan2", Arguments((y.node, x.node)))


@cache
def _multiples() -> tuple[SurdAngle, ...]:
    """0°, 15°, 30°, ... up to 345°."""
    root6, root2 = (Surd(((m, Fraction(1, 4)),)) for m in (6, 2))
    step = SurdAngle(root6 + root2, root6 - root2)
    found = [SurdAngle(Surd.of(1), Surd())]
    while len(found) < 360 // _STEP:
        found.append(found[-1] + step)
    return tuple(found)


# The exact value of a formula of numbers with roots, sines, cosines and their inverses

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
    Quotient(numerator=Product(factors=(Number(p=3, q=1, decimal=False, rounded=False), Function(name='sqrt', argument=Number(p=3, q=1, decimal=False, rounded=False)))), denominator=Number(p=2, q=1, decimal=False, rounded=False))
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
    if isinstance(value, Surd):
        if not value.is_zero:
            raise NotExact
        value = SurdAngle.of_degrees(0)
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
    if angles and any(not number.is_zero for number in numbers):
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
    size = Number(abs(exact.numerator), exact.denominator, decimal=True, rounded=exact != Fraction(value))
    return negated(size) if exact < 0 else size
