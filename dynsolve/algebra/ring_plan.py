"""What a ring must hold: the symbols, angles, roots and denominators of a problem's formulas.

Sines and cosines of constant angles, and roots of numbers, exactly.

Multiples of 90° are signs.  Multiples of 15° are made of √2 and √3.  Angles whose
greatest common angle δ with 90° has a cosine of small degree are polynomials in
cos δ, modulo its minimal polynomial, so that 4 cos³10° - 3 cos 10° = √3/2 comes
out.  For others (17.3°, whose cosine has degree 480) the sine and cosine are a
pair of their own: below that degree no further relation can hold.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from fractions import Fraction
from math import isqrt
from typing import Any

from flint import fmpq, fmpq_mpoly, fmpq_mpoly_ctx, fmpz, fmpz_poly
from msgspec import Struct
from msgspec.structs import replace

from dynsolve.algebra.angles import (
    Angle,
    Atom,
    Contents,
    ContentsCollector,
    Vector,
    coordinates_in,
    integer_basis,
)
from dynsolve.algebra.rationals import rational_gcd
from dynsolve.errors import AlgebraError
from dynsolve.notation.tree import Function, Node, Number

# Sines and cosines of constant angles, and roots of numbers, exactly

LARGEST_DEGREE = 12
"""The largest degree of a minimal polynomial that is worked with."""

LARGEST_MULTIPLE = 6
"""Up to this multiple of it, constant angles share one pair of generators."""

_QUARTER = Fraction(90)
_HALF = Fraction(180)
_BY_ROOTS = {Fraction(30), Fraction(45), Fraction(60)}
"""Angles whose sines and cosines are written with one root."""

_BY_TWO_ROOTS = {Fraction(15), Fraction(75)}
"""Those that are sums of these: 60° - 45°."""

_TRIAL_BOUND = 10_000


class ConstantPlan(Struct, frozen=True):
    """Which generators the constant angles and the roots of a problem need.

    `generator_degrees` is δ where cos δ is one; `primes` are those whose square roots are; `pairs` the
    degrees of angles that bring a pair of their own.  `written` are all these angles, those below 90°.
    """

    generator_degrees: Fraction | None = None
    primes: tuple[int, ...] = ()
    pairs: tuple[Fraction, ...] = ()
    written: frozenset[Fraction] = frozenset()

    def holds_root(self, value: Fraction) -> bool:
        """Whether the root of a positive number is made of these generators."""
        _, primes = square_free_primes(value.numerator * value.denominator)
        delta = self.generator_degrees
        return all(p in self.primes or (delta is not None and _in_field(p, delta)) for p in primes)


def plan_constants(degrees: Iterable[Fraction], radicands: Iterable[Fraction]) -> ConstantPlan:
    """The smallest plan for these constant angles and these numbers under a root.

    >>> plan_constants([Fraction(90), Fraction(30)], [])
    ConstantPlan(generator_degrees=None, primes=(3,), pairs=(), written=frozenset({Fraction(30, 1)}))
    """
    primes = {p for r in radicands for p in square_free_primes(r.numerator * r.denominator)[1]}
    turned = {min(d % _HALF, -d % _HALF) for d in degrees if d % _QUARTER}
    odd = {d % _QUARTER for d in turned}
    simple = odd & _BY_ROOTS
    if simple != odd:
        delta = rational_gcd([*odd, _QUARTER])
        if _totient(int(360 / delta)) // 2 <= LARGEST_DEGREE:
            others = tuple(sorted(p for p in primes if not _in_field(p, delta)))
            return ConstantPlan(delta, others, written=frozenset(turned))
    for d in simple:
        primes.add(2 if d == 45 else 3)
    pairs = sorted({min(d, _QUARTER - d) for d in odd - simple})
    if pairs:
        shared = rational_gcd(pairs)
        if pairs[-1] / shared <= LARGEST_MULTIPLE:
            pairs = [shared]
    return ConstantPlan(None, tuple(sorted(primes)), tuple(pairs), frozenset(turned))


def square_free_primes(n: int) -> tuple[int, tuple[int, ...]]:
    """(k, primes) with n = k² · Π primes; a large cofactor counts as a prime.

    >>> square_free_primes(72)
    (6, (2,))
    """
    outside, primes, p = 1, [], 2
    while p * p <= n and p < _TRIAL_BOUND:
        while n % (p * p) == 0:
            n //= p * p
            outside *= p
        if n % p == 0:
            n //= p
            primes.append(p)
        p += 1
    if isqrt(n) ** 2 == n:
        return outside * isqrt(n), tuple(primes)
    return outside, (*primes, n)


def _totient(n: int) -> int:
    return int(fmpz(n).euler_phi())


def _in_field(prime: int, delta: Fraction) -> bool:
    """Whether √prime is a polynomial in cos δ, by the cosines of 45°, 30° and 36°."""
    angle = {2: 45, 3: 30, 5: 36}.get(prime)
    return angle is not None and (angle / delta).denominator == 1


def minimal_polynomial(generator: fmpq_mpoly, degrees: Fraction) -> tuple[fmpq_mpoly, int]:
    """(polynomial that vanishes where the generator is the cosine of so many degrees, its degree)

    Its leading coefficient is 1; the angle is 360° divided by a whole number.
    """
    minimal = fmpz_poly.cos_minpoly(int(360 / degrees))
    total: Any = 0
    for k, coefficient in enumerate(minimal.coeffs()):
        total = total + (2 * generator) ** k * fmpq(coefficient)
    degree = int(minimal.degree())
    return total / fmpq(2) ** degree, degree


class ConstantAngles(Struct, frozen=True):
    """Cosines, sines and roots of numbers as polynomials of one ring.

    `root` gives the generator √prime, `pair` (cos, sin) of a multiple of the
    i-th planned pair, `generator` is cos δ.
    """

    plan: ConstantPlan
    root: Callable[[int], fmpq_mpoly | None]
    pair: Callable[[int, int], tuple[fmpq_mpoly, fmpq_mpoly]]
    generator: fmpq_mpoly | None

    def cos_sin(self, degrees: Fraction, ctx: fmpq_mpoly_ctx) -> tuple[fmpq_mpoly, fmpq_mpoly]:
        """(cos, sin) of a constant angle."""
        quarters, rest = divmod(degrees % 360, _QUARTER)
        c, s = self._acute(rest, ctx)
        for _ in range(int(quarters)):
            c, s = -s, c
        return c, s

    def _acute(self, rest: Fraction, ctx: fmpq_mpoly_ctx) -> tuple[fmpq_mpoly, fmpq_mpoly]:
        if not rest:
            return ctx.constant(1), ctx.constant(0)
        if self.generator is not None:
            return self._multiple(rest, ctx), self._multiple(_QUARTER - rest, ctx)
        if rest in _BY_ROOTS:
            return self._simple_cos(rest, ctx), self._simple_cos(_QUARTER - rest, ctx)
        for i, shared in reversed(list(enumerate(self.plan.pairs))):  # the fewest turns
            found = [
                (start + quarters * _QUARTER, quarters, start)
                for start in (rest, _QUARTER - rest)
                for quarters in range(4)
                if ((start + quarters * _QUARTER) / shared).denominator == 1
            ]
            if found:
                angle, quarters, start = min(found)
                c, s = self.pair(i, int(angle / shared))
                for _ in range(quarters):
                    c, s = s, -c
                return (c, s) if start == rest else (s, c)
        root2, root3 = self.root(2), self.root(3)
        if rest in _BY_TWO_ROOTS and root2 is not None and root3 is not None:
            c, s = root2 * (root3 + 1) / 4, root2 * (root3 - 1) / 4
            return (c, s) if rest == min(_BY_TWO_ROOTS) else (s, c)
        raise AlgebraError(f"the angle {float(rest)}° does not occur in the problem")

    def _multiple(self, angle: Fraction, ctx: fmpq_mpoly_ctx) -> fmpq_mpoly:
        """cos of a multiple of δ, by Chebyshev's recursion T_{k+1} = 2x T_k - T_{k-1}."""
        assert self.generator is not None and self.plan.generator_degrees is not None
        relation, _ = minimal_polynomial(self.generator, self.plan.generator_degrees)
        values: list[fmpq_mpoly] = [ctx.constant(1), self.generator]
        count = int(angle / self.plan.generator_degrees)
        for _ in range(count - 1):
            values.append((2 * self.generator * values[-1] - values[-2]) % relation)
        return values[count]

    def _simple_cos(self, angle: Fraction, ctx: fmpq_mpoly_ctx) -> fmpq_mpoly:
        match int(angle):
            case 60:
                return ctx.constant(fmpq(1, 2))
            case 30:
                return self._prime(3) / 2
            case _:
                return self._prime(2) / 2

    def _prime(self, p: int) -> fmpq_mpoly:
        found = self.root(p)
        if found is not None:
            return found
        if self.generator is None:
            raise AlgebraError(f"the root of {p} does not occur in the problem")
        ctx = self.generator.context()
        return {
            2: lambda: 2 * self._multiple(Fraction(45), ctx),
            3: lambda: 2 * self._multiple(Fraction(30), ctx),
            5: lambda: 4 * self._multiple(Fraction(36), ctx) - 1,
        }[p]()

    def sqrt(self, value: Fraction, ctx: fmpq_mpoly_ctx) -> fmpq_mpoly:
        """√value of a positive rational."""
        outside, primes = square_free_primes(value.numerator * value.denominator)
        result: fmpq_mpoly = ctx.constant(fmpq(outside, value.denominator))
        for p in primes:
            result = result * self._prime(p)
        return result


# What a ring must hold: the symbols, angles, roots and denominators of a problem's formulas


class RingPlan(Struct, frozen=True):
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
            degrees += [constants.generator_degrees, *constants.written]
        if any(d % 90 for d in degrees) or more.radicands:
            found = plan_constants(degrees, [*map(Fraction, constants.primes), *more.radicands])
            constants = replace(found, written=found.written | constants.written)
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
