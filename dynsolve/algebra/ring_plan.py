"""What a ring must hold: the symbols, angles, roots and denominators of a problem's formulas."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction

from dynsolve.algebra.angles import Angle, Atom, angle_from_tree, names_of
from dynsolve.algebra.constants import ConstantPlan, plan_constants
from dynsolve.algebra.integer_basis import Vector, coordinates_in, integer_basis
from dynsolve.algebra.rationals import rational_gcd
from dynsolve.errors import AlgebraError
from dynsolve.notation.tree import (
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


@dataclass(frozen=True, slots=True)
class RingPlan:
    """The plan of a ring: what becomes a generator, and how angles are made of the basic ones.

    `turning` are the basic angles that turn with coordinates, each as its vector of
    rates and its offset: θ₁ + 30° is one angle, and cos(θ₁ + 30°) one generator.
    """

    coordinates: tuple[str, ...]
    symbols: tuple[str, ...]
    roots: tuple[Node, ...]
    denominators: tuple[Node, ...]
    turning: tuple[tuple[Vector, Angle], ...]
    fixed: tuple[tuple[Atom, Fraction], ...]
    constants: ConstantPlan
    inverses: int

    @property
    def basic_angles(self) -> tuple[Angle, ...]:
        """The basic angles: those that turn with coordinates, symbolic ones, constant ones."""
        turning = (self._linear(vector) + offset for vector, offset in self.turning)
        fixed = (Angle(((atom, rate),)) for atom, rate in self.fixed)
        constant = (Angle((), degrees) for degrees in self.constants.pairs)
        return (*turning, *fixed, *constant)

    def _linear(self, vector: Vector) -> Angle:
        rates = zip(self.coordinates, vector, strict=True)
        return Angle(tuple(sorted((((name, 1),), rate) for name, rate in rates if rate)))

    def multiples(self, angle: Angle) -> tuple[tuple[int, ...], Fraction]:
        """(integer multiples of the basic angles, degrees left over) that make up an angle.

        Raises AlgebraError where there are none: the ring was not built for that angle.
        """
        turning, rest = _without_turning(angle, self.turning, self.coordinates)
        _, others = _split(rest, self.coordinates)
        known = dict(self.fixed)
        if any(m.denominator != 1 for m in turning) or not others.keys() <= known.keys():
            raise AlgebraError("this angle does not occur in the problem")
        fixed = [others.get(atom, Fraction(0)) / rate for atom, rate in self.fixed]
        if any(m.denominator != 1 for m in fixed):
            raise AlgebraError("this part of an angle does not occur in the problem")
        multiples = (*map(int, turning), *map(int, fixed), *(0 for _ in self.constants.pairs))
        return multiples, rest.degrees

    def at_rest(self, angle: Angle) -> Angle:
        """What is left of an angle at q = 0."""
        return Angle(tuple(sorted(_split(angle, self.coordinates)[1].items())), angle.degrees)

    def with_more_inverses(self) -> RingPlan:
        """The same plan with room for more denominators."""
        return replace(self, inverses=2 * self.inverses + 1)


def _split(angle: Angle, coordinates: Sequence[str]) -> tuple[Vector, dict[Atom, Fraction]]:
    """An angle's coordinate part as a vector, and the rest of its atoms."""
    rates = dict(angle.terms)
    vector = tuple(rates.pop(((name, 1),), Fraction(0)) for name in coordinates)
    return vector, rates


def _without_turning(
    angle: Angle, turning: Sequence[tuple[Vector, Angle]], coordinates: Sequence[str]
) -> tuple[tuple[Fraction, ...], Angle]:
    """(multiples of the turning angles, what is left of the angle, without coordinates)

    Raises AlgebraError where the angle turns otherwise.
    """
    vector, _ = _split(angle, coordinates)
    multiples = coordinates_in([v for v, _ in turning], vector)
    if multiples is None:
        raise AlgebraError("this angle does not occur in the problem")
    for times, (_, offset) in zip(multiples, turning, strict=True):
        angle = angle - offset * times
    return multiples, Angle(tuple(sorted(_split(angle, coordinates)[1].items())), angle.degrees)


class _Collector:
    """Walks trees and notes what they hold, in order of first appearance."""

    def __init__(self) -> None:
        self.symbols: dict[str, None] = {}
        self.angles: dict[Angle, None] = {}
        self.roots: dict[Node, None] = {}
        self.radicands: list[Fraction] = []
        self.denominators: dict[Node, None] = {}

    def walk(self, node: Node) -> None:
        match node:
            case Symbol(name, 0):
                self.symbols.setdefault(name)
            case Degrees():
                self.symbols.setdefault("pi")
            case Negative(argument) | Parenthesized(argument):
                self.walk(argument)
            case Sum(parts) | Product(parts):
                for part in parts:
                    self.walk(part)
            case Quotient(numerator, denominator):
                self.walk(numerator)
                self.divide_by(denominator)
            case Power(base, exponent):
                if isinstance(exponent, Negative):
                    self.divide_by(base)
                else:
                    self.walk(base)
            case Function("sqrt", argument):
                self.root(argument)
            case Function(name, argument):
                self.angle(angle_from_tree(argument))
                if name == "tan":
                    self.denominators.setdefault(Function("cos", argument))

    def divide_by(self, node: Node) -> None:
        self.walk(node)
        if rational_value(node) is None:
            self.denominators.setdefault(node)

    def root(self, argument: Node) -> None:
        value = rational_value(argument)
        if value is None:
            self.walk(argument)
            self.roots.setdefault(argument)
        elif value < 0:
            raise AlgebraError("the root of a negative number", "lengths and masses are real")
        else:
            self.radicands.append(value)

    def angle(self, angle: Angle) -> None:
        self.angles.setdefault(angle)
        for name in names_of(angle):
            self.symbols.setdefault(name)


def plan_ring(
    coordinates: Sequence[str], trees: Iterable[Node], preferred: Sequence[Angle], angles: Sequence[Angle]
) -> RingPlan:
    """The plan for these formulas and angles; see `RingPlan`."""
    collector = _Collector()
    for tree in trees:
        collector.walk(tree)
    for angle in (*preferred, *angles):
        collector.angle(angle)
    every = [*preferred, *collector.angles]
    offsets = _offsets(every, coordinates)
    vectors = integer_basis([_split(angle, coordinates)[0] for angle in every])
    turning = tuple((vector, offsets.get(vector, Angle())) for vector in vectors)
    constant = [_without_turning(angle, turning, coordinates)[1] for angle in every]
    constant += [offset for _, offset in turning]
    rates: dict[Atom, list[Fraction]] = {}
    for atom, rate in (term for angle in constant for term in angle.terms):
        rates.setdefault(atom, []).append(rate)
    constants = plan_constants((angle.degrees for angle in constant), collector.radicands)
    return RingPlan(
        coordinates=tuple(coordinates),
        symbols=tuple(collector.symbols),
        roots=(*(Number(p) for p in constants.primes), *collector.roots),
        denominators=tuple(collector.denominators),
        turning=turning,
        fixed=tuple((atom, rational_gcd(found)) for atom, found in rates.items()),
        constants=constants,
        inverses=2 * len(collector.denominators),
    )


def _offsets(angles: Sequence[Angle], coordinates: Sequence[str]) -> dict[Vector, Angle]:
    """The constant part with which each combination of coordinates occurs first; quarter turns are signs."""
    offsets: dict[Vector, Angle] = {}
    for angle in angles:
        vector, others = _split(angle, coordinates)
        degrees = angle.degrees if angle.degrees % 90 else Fraction(0)
        offsets.setdefault(vector, Angle(tuple(sorted(others.items())), degrees))
    return offsets


def rational_value(node: Node) -> Fraction | None:
    """The value of a tree made of numbers alone, else None; large powers count as None."""
    match node:
        case Number(p, q):
            return Fraction(p, q)
        case Negative(argument):
            value = rational_value(argument)
            return None if value is None else -value
        case Parenthesized(argument):
            return rational_value(argument)
        case Sum(terms):
            return _folded(terms, lambda a, b: a + b, Fraction(0))
        case Product(factors):
            return _folded(factors, lambda a, b: a * b, Fraction(1))
        case Quotient(numerator, denominator):
            top, bottom = rational_value(numerator), rational_value(denominator)
            return None if top is None or not bottom else top / bottom
        case Power(base, Number(p, 1)) if p <= _LARGEST_POWER:
            value = rational_value(base)
            return None if value is None else value**p
    return None


_LARGEST_POWER = 20


def _folded(
    parts: tuple[Node, ...], operation: Callable[[Fraction, Fraction], Fraction], start: Fraction
) -> Fraction | None:
    total = start
    for part in parts:
        value = rational_value(part)
        if value is None:
            return None
        total = operation(total, value)
    return total
