"""Factors of polynomials whose coefficients hold square roots of numbers, as √2 of 45°.

With r² = 2 the norm f(r) f(-r) is free of r, and FLINT factors it.  What f has of a factor of the
norm is their greatest common divisor: FLINT finds it modulo a prime for which 2 is a square, once for
each sign of the root there; from these a + b√2 follows, and a division proves it.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from functools import cache
from itertools import product
from math import isqrt, prod
from typing import Any

from flint import Ordering, fmpq, fmpq_mpoly, fmpz, nmod_mpoly_ctx

Signs = tuple[int, ...]
Pairs = Sequence[tuple[int, int]]
"""Generators by two, in each of which the polynomials are homogeneous."""


def factors(poly: fmpq_mpoly, roots: Mapping[int, int], pairs: Pairs) -> list[tuple[fmpq_mpoly, int]]:
    """(factor, multiplicity), up to a number; `roots` are generators with the numbers they square to."""
    degrees = poly.degrees()
    used = {index: square for index, square in roots.items() if degrees[index] > 0}
    if not used:
        return [(factor, int(times)) for factor, times in poly.factor()[1]]
    field = _Field(poly.context(), used, pairs)
    content = poly.term_content()
    poly, _ = divmod(poly, content)
    found = [(factor, int(times)) for factor, times in content.factor()[1] if not field.is_number(factor)]
    for norm, _ in field.norm(poly)[0].factor()[1]:
        while (shared := field.common(poly, norm)) is not None:
            times = 0
            while (rest := field.divided(poly, shared)) is not None:
                poly, times = rest, times + 1
            found.append((shared, times))
    return found if field.is_number(poly) else [*found, (poly, 1)]


def quotient(poly: fmpq_mpoly, divisor: fmpq_mpoly, roots: Mapping[int, int]) -> fmpq_mpoly | None:
    """poly / divisor; None where a rest is left."""
    degrees = divisor.degrees()
    used = {index: square for index, square in roots.items() if degrees[index] > 0}
    if used:
        return _Field(poly.context(), used, ()).divided(poly, divisor)
    found, rest = divmod(poly, divisor)
    return None if rest else found


class _Field:
    """Polynomials in generators of which some are square roots of numbers."""

    def __init__(self, ctx: Any, roots: Mapping[int, int], pairs: Pairs) -> None:
        self.ctx, self.roots, self.pairs = ctx, roots, pairs
        self._gens = ctx.gens()
        self._prime = _prime(tuple(roots.values()))
        get: Any = nmod_mpoly_ctx.get  # its types lack the modulus
        self._finite = get(("n", ctx.nvars()), self._prime, Ordering.lex)
        self._values = [pow(square, (self._prime + 1) // 4, self._prime) for square in roots.values()]

    def reduced(self, poly: fmpq_mpoly) -> fmpq_mpoly:
        """A polynomial that is linear in each root."""
        for index, square in self.roots.items():
            poly %= self._gens[index] ** 2 - square
        return poly

    def is_number(self, poly: fmpq_mpoly) -> bool:
        """Whether nothing but roots occurs."""
        return all(degree <= 0 or index in self.roots for index, degree in enumerate(poly.degrees()))

    def norm(self, poly: fmpq_mpoly) -> tuple[fmpq_mpoly, fmpq_mpoly]:
        """The product with all conjugates, which is free of roots, and the product of these alone."""
        others = self.ctx.constant(1)
        for index in self.roots:
            turned = [-g if i == index else g for i, g in enumerate(self._gens)]
            conjugate = poly.compose(*turned, ctx=self.ctx)
            others = self.reduced(others * conjugate)
            poly = self.reduced(poly * conjugate)
        return poly, others

    def divided(self, poly: fmpq_mpoly, divisor: fmpq_mpoly) -> fmpq_mpoly | None:
        """poly / divisor; None where a rest is left."""
        norm, others = self.norm(divisor)
        quotient, rest = divmod(self.reduced(poly * others), norm)
        return None if rest else quotient

    def common(self, poly: fmpq_mpoly, other: fmpq_mpoly) -> fmpq_mpoly | None:
        """The greatest common divisor of two polynomials, the second one free of roots; None of none."""
        images: dict[Signs, dict[Any, int]] = {}
        for signs in product((1, -1), repeat=len(self.roots)):
            shared = self._image(poly, signs).gcd(self._image(other, signs))
            if shared.is_constant():
                return None
            lead = pow(int(shared.leading_coefficient()), -1, self._prime)
            images[signs] = {tuple(map(int, e)): int(c) * lead for e, c in shared.to_dict().items()}
        found = self._lifted(images)
        return found if found is not None and self.divided(poly, found) is not None else None

    def _image(self, poly: fmpq_mpoly, signs: Signs) -> Any:
        """A polynomial modulo the prime, with these signs of the roots and 1 for the second of each pair."""
        values = dict(zip(self.roots, map(int.__mul__, signs, self._values), strict=True))
        values |= {index: 1 for _, index in self.pairs}
        terms: dict[tuple[int, ...], int] = {}
        for exponents, number in poly.to_dict().items():
            value = int(number.p) * pow(int(number.q), -1, self._prime)
            value *= prod(values[i] ** int(exponents[i]) for i in values)
            plain = tuple(0 if i in values else int(e) for i, e in enumerate(exponents))
            terms[plain] = (terms.get(plain, 0) + value) % self._prime
        return self._finite.from_dict(terms)

    def _lifted(self, images: Mapping[Signs, Mapping[Any, int]]) -> fmpq_mpoly | None:
        """The polynomial with these images; None where its numbers are too long for the prime."""
        terms: dict[tuple[int, ...], fmpq] = {}
        keys = {key for image in images.values() for key in image}
        highest = {index: max(key[first] for key in keys) for first, index in self.pairs}
        firsts = {index: first for first, index in self.pairs}
        for exponents in keys:
            for chosen in product((0, 1), repeat=len(self.roots)):
                total = sum(
                    image.get(exponents, 0) * prod(s**k for s, k in zip(signs, chosen, strict=True))
                    for signs, image in images.items()
                )
                below = len(images) * prod(v**k for v, k in zip(self._values, chosen, strict=True))
                number = _rational(total * pow(below, -1, self._prime) % self._prime, self._prime)
                if number is None:
                    return None
                places = dict(zip(self.roots, chosen, strict=True))
                places |= {i: degree - exponents[firsts[i]] for i, degree in highest.items()}
                terms[tuple(places.get(i, e) for i, e in enumerate(exponents))] = number
        found: fmpq_mpoly = self.ctx.from_dict({key: value for key, value in terms.items() if value})
        return found


@cache
def _prime(squares: Sequence[int]) -> int:
    """A large prime for which all of these are squares, 3 modulo 4."""
    return next(p for p in _candidates() if all(pow(d, (p - 1) // 2, p) == 1 for d in squares))


def _candidates() -> Iterator[int]:
    candidate = 2**62 - 1
    while True:
        if fmpz(candidate).is_prime():
            yield candidate
        candidate -= 4


def _rational(value: int, prime: int) -> fmpq | None:
    """p/q that is `value` modulo the prime, both small; None where there is none."""
    r, s, bound = (prime, value), (0, 1), isqrt(prime // 2)
    while r[1] > bound:
        quotient = r[0] // r[1]
        r, s = (r[1], r[0] - quotient * r[1]), (s[1], s[0] - quotient * s[1])
    return fmpq(r[1], s[1]) if abs(s[1]) <= bound else None
