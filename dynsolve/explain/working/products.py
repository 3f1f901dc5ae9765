"""The identities by which the entries of a product of matrices become what is printed, and what cancels."""

from __future__ import annotations

from collections.abc import Iterable

from dynsolve.algebra.angles import angle_node
from dynsolve.algebra.generators import Pair
from dynsolve.algebra.matrix import Matrix
from dynsolve.algebra.ring import Ring
from dynsolve.document import Prose
from dynsolve.explain.context import Context
from dynsolve.explain.working.identities import Identity, identities, said
from dynsolve.explain.writing import sum_of
from dynsolve.notation.tree import Function, Product


def used_in_product(context: Context, left: Matrix, right: Matrix, result: Matrix) -> list[Identity]:
    """Those that lead from Σ_k left_ik right_kj to the entries of the result, each once."""
    used: dict[Identity, None] = {}
    for row, entries in zip(left.rows, result.rows, strict=True):
        for column, entry in zip(right.T.rows, entries, strict=True):
            pairs = [(a, b) for a, b in zip(row, column, strict=True) if not (a.is_zero or b.is_zero)]
            products = [Product((context.show(a), context.show(b))) for a, b in pairs]
            if len(products) > 1:
                found = identities(context.robot.ring, sum_of(products), context.show(entry))
                used |= dict.fromkeys(found or ())
    return list(used)


def cancelled_in_product(context: Context, left: Matrix, right: Matrix) -> Prose:
    """That the terms with s₁ c₁ cancel, where a product of matrices loses all of them without an identity."""
    ring = context.robot.ring
    left_over: set[tuple[int, ...]] = set()
    gone: set[tuple[int, ...]] = set()
    for row in left.rows:
        for column in right.T.rows:
            products = [a.poly * b.poly for a, b in zip(row, column, strict=True)]
            kept = set(sum(products, start=ring.zero.poly).to_dict())
            left_over |= kept
            gone |= {term for each in products for term in each.to_dict()} - kept
    for pair in ring.pairs:
        if _have_both(gone, pair) and not _have_both(left_over, pair):
            return products_cancel(ring, pair)
    return ()


def _have_both(terms: Iterable[tuple[int, ...]], pair: Pair) -> bool:
    """Whether the sine and the cosine of an angle stand in one of the terms, given by their exponents."""
    return any(term[pair.sine] and term[pair.cosine] for term in terms)


def products_cancel(ring: Ring, pair: Pair) -> Prose:
    """(the terms with s₁ c₁ cancel)"""
    angle = angle_node(pair.angle, ring.names)
    return (" (the terms with ", Product((Function("sin", angle), Function("cos", angle))), " cancel)")


def product_named(context: Context, left: Matrix, right: Matrix, result: Matrix) -> Prose:
    """The sentence before the result of a product; nothing of longer arms, or where none is used."""
    if not context.is_short:
        return ()
    used = used_in_product(context, left, right, result)
    return ("With ", *said(used), ":") if used else ()
