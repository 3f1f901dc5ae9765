"""What a ring must hold: the symbols, angles, roots and denominators of a problem's formulas."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction

from dynsolve.algebra.angles import Angle, Atom
from dynsolve.algebra.constants import ConstantPlan, plan_constants
from dynsolve.algebra.contents import Contents, ContentsCollector
from dynsolve.algebra.integer_basis import Vector, coordinates_in, integer_basis
from dynsolve.algebra.rationals import rational_gcd
from dynsolve.errors import AlgebraError
from dynsolve.notation.tree import Function, Node, Number


@dataclass(frozen=True, slots=True)
class RingPlan:
    """The plan of a ring: what becomes a generator, and how angles are made of the basic ones.

    `turning` are the basic angles that turn with coordinates, each as its vector of
    rates and its offset: θ₁ + 30° is one angle, and cos(θ₁ + 30°) one generator.
    `fixed` are the atoms of the other angles with the rate that is basic; `inverses` so
    many generators are set aside for 1 / a denominator; `functions` are those that are
    generators of their own; `signed` are symbols that may be negative, as no length or mass is.
    `references` are names of which the first and second derivatives alone are symbols.
    """

    coordinates: tuple[str, ...]
    symbols: tuple[str, ...]
    roots: tuple[Node, ...]
    denominators: tuple[Node, ...]
    turning: tuple[tuple[Vector, Angle], ...]
    fixed: tuple[tuple[Atom, Fraction], ...]
    constants: ConstantPlan
    inverses: int
    functions: tuple[Function, ...] = ()
    signed: tuple[str, ...] = ()
    references: tuple[str, ...] = ()

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
        """The value of an angle at q = 0."""
        return Angle(tuple(sorted(_split(angle, self.coordinates)[1].items())), angle.degrees)

    def extended(self, more: Contents, most_denominators: int) -> RingPlan:
        """The plan for further formulas as well; where θ₁/2 is new, it takes the place of θ₁.

        Generators are set aside for the inverses of the denominators, up to that many.
        """
        offsets, constants = dict(self.turning), self.constants
        split = [_split(angle, self.coordinates) for angle in more.angles]
        vectors = integer_basis([*offsets, *(vector for vector, _ in split)])
        degrees = [*(angle.degrees for angle in more.angles), *constants.pairs]
        if constants.generator_degrees is not None:
            degrees.append(constants.generator_degrees)
        if any(d % 90 for d in degrees) or more.radicands:
            constants = plan_constants(degrees, [*map(Fraction, constants.primes), *more.radicands])
        old_roots = self.roots[len(self.constants.primes) :]
        return replace(
            self,
            symbols=tuple(dict.fromkeys((*self.symbols, *more.symbols))),
            roots=(*map(Number, constants.primes), *dict.fromkeys((*old_roots, *more.roots))),
            turning=tuple((vector, offsets.get(vector, Angle())) for vector in vectors),
            fixed=_finest((*self.fixed, *(term for _, others in split for term in others.items()))),
            constants=constants,
            inverses=self.inverses + 2 * min(len(more.denominators), most_denominators),
            functions=tuple(dict.fromkeys((*self.functions, *more.functions))),
        )

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
    """(multiples of the turning angles, the rest of the angle, which has no coordinates)

    Raises AlgebraError where the angle turns otherwise.
    """
    vector, _ = _split(angle, coordinates)
    multiples = coordinates_in([v for v, _ in turning], vector)
    if multiples is None:
        raise AlgebraError("this angle does not occur in the problem")
    for times, (_, offset) in zip(multiples, turning, strict=True):
        angle = angle - offset * times
    return multiples, Angle(tuple(sorted(_split(angle, coordinates)[1].items())), angle.degrees)


def plan_ring(
    coordinates: Sequence[str], trees: Iterable[Node], preferred: Sequence[Angle], angles: Sequence[Angle]
) -> RingPlan:
    """The plan for these formulas and angles; see `RingPlan`."""
    collector = ContentsCollector()
    collector.collect(trees)
    for angle in (*preferred, *angles):
        collector.angle(angle)
    held = collector.contents
    every = [*preferred, *held.angles]
    offsets = _offsets(every, coordinates)
    vectors = integer_basis([_split(angle, coordinates)[0] for angle in every])
    turning = tuple((vector, offsets.get(vector, Angle())) for vector in vectors)
    constant = [_without_turning(angle, turning, coordinates)[1] for angle in every]
    constant += [offset for _, offset in turning]
    constants = plan_constants((angle.degrees for angle in constant), held.radicands)
    return RingPlan(
        coordinates=tuple(coordinates),
        symbols=held.symbols,
        roots=(*(Number(p) for p in constants.primes), *held.roots),
        denominators=held.denominators,
        turning=turning,
        fixed=_finest(term for angle in constant for term in angle.terms),
        constants=constants,
        inverses=2 * len(held.denominators),
        functions=held.functions,
    )


def _finest(terms: Iterable[tuple[Atom, Fraction]]) -> tuple[tuple[Atom, Fraction], ...]:
    """For each atom the largest rate such that all its rates are integer multiples of it."""
    rates: dict[Atom, list[Fraction]] = {}
    for atom, rate in terms:
        rates.setdefault(atom, []).append(rate)
    return tuple((atom, rational_gcd(found)) for atom, found in rates.items())


def _offsets(angles: Sequence[Angle], coordinates: Sequence[str]) -> dict[Vector, Angle]:
    """The constant part with which each combination of coordinates occurs first; quarter turns are signs."""
    offsets: dict[Vector, Angle] = {}
    for angle in angles:
        vector, others = _split(angle, coordinates)
        degrees = angle.degrees if angle.degrees % 90 else Fraction(0)
        offsets.setdefault(vector, Angle(tuple(sorted(others.items())), degrees))
    return offsets
