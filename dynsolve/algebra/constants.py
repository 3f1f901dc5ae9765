"""Sines and cosines of constant angles, and roots of numbers, exactly.

Multiples of 90° are signs.  Multiples of 15° are made of √2 and √3.  Angles whose
greatest common angle δ with 90° has a cosine of small degree are polynomials in
cos δ, modulo its minimal polynomial, so that 4 cos³10° - 3 cos 10° = √3/2 comes
out.  For others (17.3°, whose cosine has degree 480) the sine and cosine are a
pair of their own: below that degree no further relation can hold.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from fractions import Fraction
from math import isqrt
from typing import Any

from flint import fmpq, fmpq_mpoly, fmpq_mpoly_ctx, fmpz, fmpz_poly

from dynsolve.algebra.rationals import rational_gcd
from dynsolve.errors import AlgebraError

LARGEST_DEGREE = 12
"""The largest degree of a minimal polynomial that is worked with."""

LARGEST_MULTIPLE = 6
"""Up to this multiple of it, constant angles share one pair of generators."""

_QUARTER = Fraction(90)
_FIFTEEN = Fraction(15)
_TRIAL_BOUND = 10_000


@dataclass(frozen=True, slots=True)
class ConstantPlan:
    """Which generators the constant angles and the roots of a problem need.

    `generator_degrees` is δ where cos δ is one; `primes` are those whose square
    roots are; `pairs` the degrees of angles that bring a pair of their own.
    """

    generator_degrees: Fraction | None = None
    primes: tuple[int, ...] = ()
    pairs: tuple[Fraction, ...] = ()

    def holds_root(self, value: Fraction) -> bool:
        """Whether the root of a positive number is made of these generators."""
        _, primes = square_free_primes(value.numerator * value.denominator)
        delta = self.generator_degrees
        return all(p in self.primes or (delta is not None and _in_field(p, delta)) for p in primes)


def plan_constants(degrees: Iterable[Fraction], radicands: Iterable[Fraction]) -> ConstantPlan:
    """The smallest plan for these constant angles and these numbers under a root.

    >>> plan_constants([Fraction(90), Fraction(30)], [])
    ConstantPlan(generator_degrees=None, primes=(3,), pairs=())
    """
    primes = {p for r in radicands for p in square_free_primes(r.numerator * r.denominator)[1]}
    odd = {d % _QUARTER for d in degrees} - {Fraction(0)}
    simple = {d for d in odd if d % _FIFTEEN == 0}
    if simple != odd:
        delta = rational_gcd([*odd, _QUARTER])
        if _totient(int(360 / delta)) // 2 <= LARGEST_DEGREE:
            return ConstantPlan(delta, tuple(sorted(p for p in primes if not _in_field(p, delta))))
    for d in simple:
        primes |= {2} if d == 45 else {3} if d % 30 == 0 else {2, 3}
    others = sorted({min(d, _QUARTER - d) for d in odd - simple})
    if others:
        shared = rational_gcd(others)
        if others[-1] / shared <= LARGEST_MULTIPLE:
            others = [shared]
    return ConstantPlan(None, tuple(sorted(primes)), tuple(others))


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


@dataclass(frozen=True, slots=True)
class ConstantAngles:
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
        if rest % _FIFTEEN == 0:
            return self._simple_cos(rest, ctx), self._simple_cos(_QUARTER - rest, ctx)
        small = min(rest, _QUARTER - rest)
        for i, shared in reversed(list(enumerate(self.plan.pairs))):  # the fewest turns
            if (small / shared).denominator == 1:
                c, s = self.pair(i, int(small / shared))
                return (c, s) if small == rest else (s, c)
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
            case 45:
                return self._prime(2) / 2
            case 15:
                return self._prime(2) * (self._prime(3) + 1) / 4
            case _:
                return self._prime(2) * (self._prime(3) - 1) / 4

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
