"""Whether equations can hold together, and what follows from them, by Buchberger's algorithm.

Each parameter is a number of a fixed seed here: what is found holds for general values of them.
Equations without a solution, not even in complex numbers, have a Gröbner basis with a number in it.
An expression f is 0 wherever others are, if these and t f = 1 have no solution (Rabinowitsch).
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from functools import lru_cache
from math import lcm
from random import Random
from typing import Any

from flint import Ordering, fmpq, fmpq_mpoly, fmpz_mpoly_ctx, fmpz_mpoly_vec

from dynsolve.algebra.expr import Expr
from dynsolve.algebra.ring import Ring

LIMITS = (40, 150, 400)
"""Of a basis: its polynomials, the terms of one, and the binary digits of its coefficients."""

SEED = 7

Terms = dict[tuple[int, ...], fmpq]


def can_hold(values: Sequence[Expr]) -> bool:
    """Whether expressions may be 0 together; what goes over the limits counts so."""
    return not values or not _has_number([_specialized(value) for value in values], values[0].ring)


def follows(value: Expr, others: Sequence[Expr]) -> bool:
    """Whether an expression is found to be 0 wherever the others are."""
    if value.is_zero or not others:
        return value.is_zero
    inverted = {(*key, 1): number for key, number in _specialized(value).items()}
    inverted[(0,) * (len(value.ring.generators) + 1)] = fmpq(-1)
    return _has_number([*map(_specialized, others), inverted], value.ring)


def _has_number(polys: Sequence[Terms], ring: Ring) -> bool:
    """Whether the Gröbner basis of polynomials and of the ring's relations is 1."""
    places = {i for terms in polys for key in terms for i, e in enumerate(key) if e}
    for poly in ring.relations(places):
        terms = _with_numbers(ring, poly)
        places |= {i for key in terms for i, e in enumerate(key) if e}
        polys = [*polys, terms]
    used = sorted(places)
    ctx = fmpz_mpoly_ctx.get(("z", max(len(used), 1)), Ordering.degrevlex)
    basis = fmpz_mpoly_vec([_whole(ctx, used, terms) for terms in polys if terms], ctx)
    found: Any = basis.buchberger_naive(limits=LIMITS)[0]
    return any(poly.is_constant() and poly for poly in found)


def _whole(ctx: Any, used: Sequence[int], terms: Terms) -> Any:
    scale = lcm(*(int(number.q) for number in terms.values()))
    return ctx.from_dict({
        tuple(key[i] if i < len(key) else 0 for i in used) or (0,): int((number * scale).p)
        for key, number in terms.items()
    })  # fmt: skip


def _specialized(value: Expr) -> Terms:
    return _with_numbers(value.ring, value.poly)


def _with_numbers(ring: Ring, poly: fmpq_mpoly) -> Terms:
    """A polynomial with numbers for parameters, and for sines and cosines of constant angles."""
    numbers, terms = _numbers(ring), Terms()
    for exponents, coefficient in poly.to_dict().items():
        number, key = coefficient, [int(e) for e in exponents]
        for i, value in numbers.items():
            if key[i]:
                number, key[i] = number * value ** key[i], 0
        terms[tuple(key)] = terms.get(tuple(key), 0) + number
    return {key: number for key, number in terms.items() if number}


@lru_cache(maxsize=4)
def _numbers(ring: Ring) -> Mapping[int, fmpq]:
    """The numbers, by the generators that they stand for."""
    return dict(_drawn(ring))


def _drawn(ring: Ring) -> Iterator[tuple[int, fmpq]]:
    draw = Random(SEED)  # noqa: S311 - the same numbers every time are wanted
    for g in ring.generators:
        if g.kind == "symbol" and g.name in ring.parameters:
            yield g.index, fmpq(draw.randint(2, 99), draw.randint(2, 99))
    for pair in ring.pairs:
        if not ring.depends_on_coordinates(ring.generator(pair.sine)):
            t = fmpq(draw.randint(2, 49), 50)
            yield pair.sine, 2 * t / (1 + t * t)
            yield pair.cosine, (1 - t * t) / (1 + t * t)
