"""Factors of a polynomial in sines and cosines: s₂ (L₂c₂ + L₃c₂₃) from its normal form.

The normal form has no s², so that a product may show no factor: s₂(c₂ + s₂) becomes
1 + s₂c₂ - c₂².  In S = sin(q/2) and C = cos(q/2), with

    sin q = 2 S C,   cos q = C² - S²,   1 = C² + S²,

the polynomial is homogeneous in each pair (S, C), and such polynomials factor in one way
alone.  FLINT factors them; what comes out is put together again into sines and cosines of
whole angles: S C into sin q, (C - S)(C + S) into cos q, S² into 1 - cos q.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator
from itertools import combinations
from typing import Any

from flint import Ordering, fmpq_mpoly, fmpq_mpoly_ctx

from dynsolve.algebra.expr import Expr
from dynsolve.algebra.generators import Pair
from dynsolve.algebra.positivity import parameters
from dynsolve.algebra.ring import Ring
from dynsolve.algebra.root_factor import factors, quotient

MOST_TERMS = 20_000
"""A polynomial that may have more terms in half angles is not taken apart."""


def trig_factors(expr: Expr) -> tuple[tuple[Expr, int], ...]:
    """(factor, multiplicity) of an expression, up to a number; those without an angle too.

    A factor of its own is what is irreducible in sines and cosines of whole angles.  An
    expression that is too long, or has inverses or roots of letters, is its own only factor.

    >>> from dynsolve.algebra.angles import Angle
    >>> from dynsolve.algebra.build import build_ring
    >>> ring = build_ring([("q1", "revolute")], [], [Angle.of("q1")])
    >>> s, c = ring.sin(Angle.of("q1")), ring.cos(Angle.of("q1"))
    >>> sorted(map(str, trig_factors(s * (c + s))))[1]
    "(Expr(1*sin(1*(('q1', 1),))), 1)"
    """
    if len(expr) == 0 or leading(expr) == expr:
        return ()
    halves = _HalfAngles(expr.ring)
    if not halves.can_hold(expr):
        return ((expr, 1),)
    found: Counter[Expr] = Counter()
    for factor, times in halves.factors(halves.homogeneous(expr)):
        found[factor] += times
    return tuple(found.items())


def trig_quotient(expr: Expr, divisor: Expr) -> Expr | None:
    """expr / divisor, where the divisor is seen to be a factor of it."""
    halves = _HalfAngles(expr.ring)
    if expr.is_zero or expr == divisor or not (halves.can_hold(expr) and halves.can_hold(divisor)):
        return expr if expr.is_zero else expr.ring.one if expr == divisor else None
    found = quotient(halves.homogeneous(expr), halves.homogeneous(divisor), halves.roots)
    return None if found is None else halves.expr(found)


def squares(expr: Expr) -> tuple[Expr, ...]:
    """What must be 0 where a sum of squares is, as in 1 + c₁ c₂ = 2 (C₁² C₂² + S₁² S₂²).

    Parameters count as positive.  Nothing of what is no such sum.
    """
    halves = _HalfAngles(expr.ring)
    if not halves.can_hold(expr):
        return ()
    terms, free = halves.homogeneous(expr).to_dict(), parameters(expr)
    same_sign = len({number > 0 for number in terms.values()}) == 1
    if not same_sign or any(e % 2 and i not in free for exponents in terms for i, e in enumerate(exponents)):
        return ()
    bare = {tuple(0 if i in free else int(e) for i, e in enumerate(exponents)) for exponents in terms}
    return tuple(halves.expr(halves.ctx.from_dict({exponents: 1})) for exponents in sorted(bare))


class _HalfAngles:
    """The ring's polynomials with S and C in the places of sine and cosine, without relations."""

    def __init__(self, ring: Ring) -> None:
        self.ring = ring
        self.pairs: tuple[Pair, ...] = ring.pairs
        self.roots = numeric_roots(ring)
        self.ctx: Any = fmpq_mpoly_ctx.get(("h", ring.ctx.nvars()), Ordering.lex)
        self.gens: tuple[fmpq_mpoly, ...] = self.ctx.gens()

    def can_hold(self, expr: Expr) -> bool:
        """Whether the expression is a polynomial in sines, cosines and symbols, and not too long."""
        degrees = expr.poly.degrees()
        plain = ("sin", "cos", "symbol")
        others = (g.index for g in self.ring.generators if g.kind not in plain and g.index not in self.roots)
        if any(degrees[index] > 0 for index in others):
            return False
        size = len(expr)
        for pair in self.pairs:
            size *= 1 + 2 * max(int(degrees[pair.sine]) + int(degrees[pair.cosine]), 0)
        return size <= MOST_TERMS

    def homogeneous(self, expr: Expr) -> fmpq_mpoly:
        """The polynomial in S and C, of one degree in each pair."""
        poly = expr.poly
        highest = {pair: self._highest(poly, pair) for pair in self.pairs}
        total: fmpq_mpoly = self.ctx.constant(0)
        powers: dict[tuple[Pair, int, int], fmpq_mpoly] = {}
        for exponents, factor in poly.to_dict().items():
            plain = list(exponents)
            term = self.ctx.constant(1)
            for pair, degree in highest.items():
                if degree:
                    key = pair, int(exponents[pair.sine]), int(exponents[pair.cosine])
                    if key not in powers:
                        powers[key] = self._power(*key, degree)
                    term = term * powers[key]
                    plain[pair.sine] = plain[pair.cosine] = 0
            total = total + term * self.ctx.from_dict({tuple(plain): factor})
        return total

    @staticmethod
    def _highest(poly: fmpq_mpoly, pair: Pair) -> int:
        return max((int(e[pair.sine]) + int(e[pair.cosine]) for e in poly.monoms()), default=0)

    def _power(self, pair: Pair, sines: int, cosines: int, degree: int) -> fmpq_mpoly:
        """sin^sines cos^cosines · 1^rest, of degree 2·degree in S and C."""
        S, C = self.gens[pair.sine], self.gens[pair.cosine]
        one: fmpq_mpoly = (C * C + S * S) ** (degree - sines - cosines)
        return (2 * S * C) ** sines * (C * C - S * S) ** cosines * one

    def factors(self, poly: fmpq_mpoly) -> Iterator[tuple[Expr, int]]:
        """Those of a polynomial in S and C, in sines and cosines of whole angles."""
        return self.whole(factors(poly, self.roots, [(pair.sine, pair.cosine) for pair in self.pairs]))

    # -- back to whole angles ----------------------------------------------------------------------

    def whole(self, factors: Iterable[tuple[fmpq_mpoly, int]]) -> Iterator[tuple[Expr, int]]:
        """The factors in sines and cosines of whole angles."""
        odd: list[fmpq_mpoly] = []
        for factor, times in factors:
            if self._is_even(factor):
                if not self._is_one(factor):
                    yield _primitive(self.expr(factor)), times
            else:
                odd += [factor] * times
        for expr in self._paired(odd):
            yield expr, 1

    def _paired(self, odd: list[fmpq_mpoly]) -> Iterator[Expr]:
        """Factors of odd degree two by two, those first that make the shortest; then the rest."""
        while True:
            products = [
                (len(value), i, j, value)
                for i, j in combinations(range(len(odd)), 2)
                if self._is_even(odd[i] * odd[j])
                for value in (self.expr(odd[i] * odd[j]),)
            ]
            if not products:
                break
            _, i, j, value = min(products, key=lambda found: found[:3])
            del odd[j], odd[i]
            yield _primitive(value)
        rest = self.ctx.constant(1)
        for factor in odd:
            rest = rest * factor
        if not rest.is_constant():
            yield _primitive(self.expr(rest))

    def _is_one(self, factor: fmpq_mpoly) -> bool:
        """Whether a factor is some C² + S² = 1."""
        return any(factor == self.gens[pair.sine] ** 2 + self.gens[pair.cosine] ** 2 for pair in self.pairs)

    def _is_even(self, factor: fmpq_mpoly) -> bool:
        return all(
            (int(e[pair.sine]) + int(e[pair.cosine])) % 2 == 0 for pair in self.pairs for e in factor.monoms()
        )

    def expr(self, poly: fmpq_mpoly) -> Expr:
        """A polynomial of even degree in each pair, by S² = (1 - c)/2, C² = (1 + c)/2, S C = s/2."""
        ring = self.ring
        total = ring.zero
        for exponents, factor in poly.to_dict().items():
            plain = list(exponents)
            term = ring.one
            for pair in self.pairs:
                S, C = int(exponents[pair.sine]), int(exponents[pair.cosine])
                plain[pair.sine] = plain[pair.cosine] = 0
                if S or C:
                    s, c = ring.generator(pair.sine), ring.generator(pair.cosine)
                    both = S % 2
                    term = term * s**both * (ring.one - c) ** (S // 2) * (ring.one + c) ** (C // 2)
                    term = term / 2 ** ((S + C) // 2)
            total = total + term * Expr(ring, ring.ctx.from_dict({tuple(plain): factor}))
        return total


def numeric_roots(ring: Ring) -> dict[int, int]:
    """The generators that are square roots of whole numbers, with these."""
    found = {index: square for index, square in ring.radicands.items() if square.is_constant()}
    return {index: int(square.leading_coefficient().p) for index, square in found.items()}


def leading(expr: Expr) -> Expr:
    """The number, with the roots in it, that stands before the first term."""
    roots = numeric_roots(expr.ring)
    split = [
        (tuple(0 if i in roots else int(e) for i, e in enumerate(exponents)), exponents, number)
        for exponents, number in expr.poly.to_dict().items()
    ]
    first = max(plain for plain, _, _ in split)
    terms = {
        tuple(e if i in roots else 0 for i, e in enumerate(exponents)): number
        for plain, exponents, number in split
        if plain == first
    }
    return Expr(expr.ring, expr.ring.ctx.from_dict(terms))


def ratio(expr: Expr, other: Expr) -> Expr:
    """The number that an expression is of another, where it is one."""
    return leading(expr) * expr.ring.inverse(leading(other))


def _primitive(expr: Expr) -> Expr:
    """The expression with leading coefficient 1."""
    return expr * expr.ring.inverse(leading(expr))
