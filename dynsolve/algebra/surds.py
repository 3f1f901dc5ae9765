"""Sums of square roots: exact real numbers Σ cᵢ √mᵢ, the c rational, the m squarefree.

Square roots of different squarefree whole numbers are linearly independent over the rationals,
so a sum is 0 exactly when it has no terms.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from fractions import Fraction
from math import gcd, isqrt, sqrt

from flint import arb, ctx, fmpz

from dynsolve.algebra.rationals import rational
from dynsolve.errors import AlgebraError
from dynsolve.notation.build import times, total
from dynsolve.notation.tree import Function, Node, Number

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


@dataclass(frozen=True, slots=True)
class Surd:
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
