"""The identities by which the entries of a product of matrices become what is printed."""

from __future__ import annotations

from dynsolve.algebra.matrix import Matrix
from dynsolve.document import Prose
from dynsolve.explain.context import Context
from dynsolve.explain.working.identities import Identity, identities, said
from dynsolve.explain.writing import sum_of
from dynsolve.notation.tree import Product


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


def product_named(context: Context, left: Matrix, right: Matrix, result: Matrix) -> Prose:
    """The sentence before the result of a product; nothing of longer arms, or where none is used."""
    if not context.is_short:
        return ()
    used = used_in_product(context, left, right, result)
    return ("With ", *said(used), ":") if used else ()
