"""Whether equations can hold together, and what follows from them, by Buchberger's algorithm.

Each parameter is a number of a fixed seed here: what is found holds for general values of them.
Equations without a solution, not even in complex numbers, have a Gröbner basis with a number in it.
An expression f is 0 wherever others are, if these and t f = 1 have no solution (Rabinowitsch).
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
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
    inverted = _inverted(_specialized(value), value.ring)
    return _has_number([*map(_specialized, others), inverted], value.ring)


def _inverted(terms: Terms, ring: Ring) -> Terms:
    """t f - 1, with t behind the generators."""
    inverted = {(*key, 1): number for key, number in terms.items()}
    inverted[(0,) * (len(ring.generators) + 1)] = fmpq(-1)
    return inverted


def obstacles(values: Sequence[Expr]) -> list[Expr]:
    """Polynomials in parameters alone that are found to be 0 wherever expressions are 0 together.

    Where one of them is not 0 the expressions cannot hold together, whatever numbers the parameters are.
    """
    return _still([_exact_terms(value.ring, value.poly) for value in values], values[0].ring)


def exceptions(value: Expr, others: Sequence[Expr]) -> list[Expr]:
    """Polynomials in parameters alone: where one is not 0, `value` is 0 wherever the others are."""
    ring = value.ring
    if value.is_zero:
        return [ring.one]
    polys = [_exact_terms(ring, other.poly) for other in others]
    return _still([*polys, _inverted(_exact_terms(ring, value.poly), ring)], ring)


def _still(polys: Sequence[Terms], ring: Ring) -> list[Expr]:
    """What a basis has that holds no coordinate, in one of two orders."""
    still = [g.index for g in ring.generators if not ring.depends_on_coordinates(ring.generator(g.index))]
    found: list[Expr] = []
    for ordering in (Ordering.degrevlex, Ordering.lex):
        used, basis = _basis(polys, ring, _exact_terms, ordering, still)
        for poly in basis:
            terms = [(dict(zip(used, key, strict=False)), number) for key, number in poly.to_dict().items()]
            if all(i in still for powers, _ in terms for i, e in powers.items() if e):
                plain = {tuple(powers.get(g.index, 0) for g in ring.generators): n for powers, n in terms}
                found.append(Expr(ring, ring.reduce(ring.ctx.from_dict(plain))))
        found = [value for value in found if not value.is_zero]
        if found:
            break
    return found


def _has_number(polys: Sequence[Terms], ring: Ring) -> bool:
    """Whether the Gröbner basis of polynomials and of the ring's relations is 1."""
    _, basis = _basis(polys, ring, _with_numbers, Ordering.degrevlex, ())
    return any(poly.is_constant() and poly for poly in basis)


def _basis(
    polys: Sequence[Terms],
    ring: Ring,
    terms_of: Callable[[Ring, fmpq_mpoly], Terms],
    ordering: Ordering,
    last: Sequence[int],
) -> tuple[list[int], Any]:
    """The generators that occur, those of `last` behind the others, and a basis in them."""
    places = {i for terms in polys for key in terms for i, e in enumerate(key) if e}
    for poly in ring.relations(places):
        terms = terms_of(ring, poly)
        places |= {i for key in terms for i, e in enumerate(key) if e}
        polys = [*polys, terms]
    used = sorted(places, key=lambda i: (i in last, i))
    ctx = fmpz_mpoly_ctx.get(("z", max(len(used), 1)), ordering)
    basis = fmpz_mpoly_vec([_whole(ctx, used, terms) for terms in polys if terms], ctx)
    return used, basis.buchberger_naive(limits=LIMITS)[0]


def _whole(ctx: Any, used: Sequence[int], terms: Terms) -> Any:
    scale = lcm(*(int(number.q) for number in terms.values()))
    return ctx.from_dict({
        tuple(key[i] if i < len(key) else 0 for i in used) or (0,): int((number * scale).p)
        for key, number in terms.items()
    })  # fmt: skip


def _specialized(value: Expr) -> Terms:
    return _with_numbers(value.ring, value.poly)


def _exact_terms(_: Ring, poly: fmpq_mpoly) -> Terms:
    """A polynomial as it is."""
    return {tuple(int(e) for e in exponents): number for exponents, number in poly.to_dict().items()}


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
