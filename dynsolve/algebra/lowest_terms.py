"""What expressions share, with s² + c² = 1: fractions in lowest terms, vectors without a common factor.

Modulo s² + c² = 1 a polynomial has several factorings, s² = (1 - c)(1 + c), and so no greatest common
divisor.  In half angles (`factors`) there is one.  Where its factors are those of half angles only, as
sin(q/2) of sin q and 1 - cos q, dividing by it leaves no polynomial in whole angles.  Numerator and
denominator are then multiplied by what the denominator still holds, so that it has no further zeros:
sin q/(1 + cos q), which is tan(q/2), and not (1 - cos q)/sin q, which is 0/0 at q = 0.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import reduce
from itertools import combinations
from math import prod

from flint import fmpq_mpoly

from dynsolve.algebra.factors import HalfAngles, factors, quotient
from dynsolve.algebra.ring import Expr

MOST_TERMS = 200_000
"""A polynomial that may have more terms in half angles is left as it is."""

MOST_ROOTED = 150
"""Polynomials of more terms with roots of numbers are not taken apart: that takes minutes."""


def lowest_terms(above: Expr, below: Expr) -> tuple[Expr, Expr] | None:
    """A fraction without what numerator and denominator share; None where they are too long to tell.

    >>> from dynsolve.algebra.angles import Angle
    >>> from dynsolve.algebra.ring_values import build_ring
    >>> ring = build_ring([("q1", "revolute")], [], [Angle.of("q1")])
    >>> s, c = ring.sin(Angle.of("q1")), ring.cos(Angle.of("q1"))
    >>> lowest_terms(ring.one - c, s)
    (Expr(1*sin(1*(('q1', 1),))), Expr(1*cos(1*(('q1', 1),)) + 1))
    """
    halves = _halves((above, below))
    shared = _shared(halves, (above, below))
    if shared is None:
        return None
    if shared.is_constant():
        return above, below
    over, under = (_divided(halves, value, shared) for value in (above, below))
    missing = _odd_part(halves, under)
    return halves.expr(over * missing), halves.expr(under * missing)


def is_decided(above: Expr, below: Expr) -> bool:
    """Whether `lowest_terms` finds all that is shared: they are not too long, and hold no root of letters."""
    halves = _halves((above, below))
    is_plain = all(halves.can_hold(value, MOST_TERMS) for value in (above, below))
    return is_plain and _shared(halves, (above, below)) is not None


def zero_of_all(values: Sequence[Expr]) -> Expr | None:
    """What is 0 where a common factor of expressions is, which are not 0; None where they are too long."""
    halves = _halves(values)
    shared = _shared(halves, values)
    return None if shared is None else halves.expr(shared * _odd_part(halves, shared))


def without_shared(values: Sequence[Expr]) -> list[Expr]:
    """Expressions that are not 0 without what all share; of long ones without what their normal forms do."""
    plain = reduce(fmpq_mpoly.gcd, (value.poly for value in values))
    values = [Expr(value.ring, divmod(value.poly, plain)[0]) for value in values]
    halves = _halves(values)
    shared = _shared(halves, values)
    if shared is None or shared.is_constant():
        return values
    divisor, _ = divmod(shared, _odd_part(halves, shared))
    return [halves.expr(_divided(halves, value, divisor)) for value in values]


def _halves(values: Sequence[Expr]) -> HalfAngles:
    """With the angles that stand in all: a common factor has no others."""
    used = [value.poly.degrees() for value in values]
    pairs = values[0].ring.pairs
    return HalfAngles(
        values[0].ring, [p for p in pairs if all(d[p.sine] > 0 or d[p.cosine] > 0 for d in used)]
    )


def _shared(halves: HalfAngles, values: Sequence[Expr]) -> fmpq_mpoly | None:
    """The greatest common divisor in half angles; None where one is too long."""
    if not all(halves.has_room(value, MOST_TERMS) for value in values):
        return None
    polys = sorted(map(halves.homogeneous, values), key=len)
    rooted = [poly for poly in polys if any(poly.degrees()[index] > 0 for index in halves.roots)]
    if not rooted:
        return reduce(fmpq_mpoly.gcd, polys)
    if len(rooted[0]) > MOST_ROOTED:
        return None
    found = _one(halves)
    for factor, times in _factors(halves, rooted[0]):
        for _ in range(times):
            quotients = (quotient(poly, factor, halves.roots) for poly in polys)
            rests = [rest for rest in quotients if rest is not None]
            if len(rests) < len(polys):
                break
            polys, found = rests, found * factor
    return found


def _odd_part(halves: HalfAngles, poly: fmpq_mpoly) -> fmpq_mpoly:
    """The fewest factors of a polynomial that make one in whole angles of it: 1 where it is one already."""
    if halves.is_even(poly):
        return _one(halves)
    if len(poly) > MOST_ROOTED and any(poly.degrees()[index] > 0 for index in halves.roots):
        return poly
    odd = [factor for factor, _ in _factors(halves, poly) if not halves.is_even(factor)]
    chosen = (some for count in range(1, len(odd) + 1) for some in combinations(odd, count))
    products = (prod(some, start=_one(halves)) for some in chosen)
    return next(product for product in products if halves.is_even(poly * product))


def _divided(halves: HalfAngles, value: Expr, divisor: fmpq_mpoly) -> fmpq_mpoly:
    found = quotient(halves.homogeneous(value), divisor, halves.roots)
    assert found is not None
    return found


def _factors(halves: HalfAngles, poly: fmpq_mpoly) -> list[tuple[fmpq_mpoly, int]]:
    return factors(poly, halves.roots, [(pair.sine, pair.cosine) for pair in halves.pairs])


def _one(halves: HalfAngles) -> fmpq_mpoly:
    one: fmpq_mpoly = halves.ctx.constant(1)
    return one
