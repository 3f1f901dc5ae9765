"""An expression as terms that a person would name: monomials in the symbols, each with its factor.

The factor of a part is a polynomial in sines and cosines.  Two parts that have one monomial
in common are told apart by this factor alone.
"""

from __future__ import annotations

from collections.abc import Iterator
from math import prod

from dynsolve.algebra.expr import Expr
from dynsolve.algebra.ring import Ring

Monomial = tuple[tuple[int, int], ...]
"""(generator, exponent) of the generators that are no sines and cosines."""

MOST_TERMS = 600
"""The most terms of an expression that is taken apart."""

MOST_TRIG_TERMS = 8_000
"""The most sines and cosines that it may have, multiplied out."""

HIGHEST = 10
"""The highest degree in sines and cosines."""


def is_small(expr: Expr) -> bool:
    """Whether an expression is small enough to be taken apart; answers written by hand are."""
    if len(expr) > MOST_TERMS:
        return False
    if not expr.poly or not expr.ring.pairs:
        return True
    degrees = expr.poly.degrees()
    if (
        sum(max(int(degrees[p.sine]), 0) + max(int(degrees[p.cosine]), 0) for p in expr.ring.pairs)
        > 4 * HIGHEST
    ):
        return False
    places = [i for pair in expr.ring.pairs for i in (pair.sine, pair.cosine)]
    total = 0
    for exponents in expr.poly.monoms():
        powers = [int(exponents[i]) for i in places]
        if sum(powers) > HIGHEST:
            return False
        total += prod(power + 1 for power in powers)
    return total <= MOST_TRIG_TERMS


def parts(expr: Expr) -> dict[Monomial, Expr]:
    """The parts of an expression, by monomial."""
    groups: dict[Monomial, dict[tuple[int, ...], object]] = {}
    if not expr.poly:
        return {}
    turning = _turning(expr.ring)
    for exponents, value in expr.poly.to_dict().items():
        groups.setdefault(_monomial(exponents, turning), {})[exponents] = value
    return {m: Expr(expr.ring, expr.ring.ctx.from_dict(terms)) for m, terms in groups.items()}


def _monomial(exponents: tuple[int, ...], turning: frozenset[int]) -> Monomial:
    return tuple((i, int(e)) for i, e in enumerate(exponents) if e and i not in turning)


def _turning(ring: Ring) -> frozenset[int]:
    return frozenset(i for pair in ring.pairs for i in (pair.sine, pair.cosine))


def monomial_expr(ring: Ring, monomial: Monomial) -> Expr:
    """Π generator^exponent"""
    total = ring.one
    for index, power in monomial:
        total = total * ring.generator(index) ** power
    return total


def used(expr: Expr) -> Iterator[int]:
    """The generators that occur."""
    if expr.poly:
        yield from (i for i, degree in enumerate(expr.poly.degrees()) if degree > 0)


def stands_in(term: Expr, whole: Expr) -> bool:
    """Whether an expression holds all of a term: to take it away leaves every coefficient with its sign."""
    if not term.poly:
        return True
    held = whole.poly.to_dict() if whole.poly else {}
    return all(
        exponents in held and 0 < value / held[exponents] <= 1
        for exponents, value in term.poly.to_dict().items()
    )
