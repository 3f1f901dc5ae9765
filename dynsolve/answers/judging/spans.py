"""Answers that are spaces: vectors that span the key's, however many and however long they are."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction

from dynsolve.algebra.expr import Expr
from dynsolve.algebra.fraction import RationalExpr
from dynsolve.algebra.matrix import Matrix
from dynsolve.algebra.pseudoinverse import rank_parts
from dynsolve.algebra.spans import same_span
from dynsolve.answers.judging.entry_comparison import put_numbers, substituted

Rows = Sequence[Sequence[RationalExpr]]

MOST_VECTORS = 12
"""More vectors than this are not compared."""


def readings(rows: Rows, height: int) -> tuple[Matrix, ...]:
    """The vectors that were written, side by side: columns or rows, of which only one may have that height.

    A single 0 is the space {0}.
    """
    listed = [list(row) for row in rows]
    if len(listed) == 1 and len(listed[0]) == 1 and height != 1 and listed[0][0].is_zero:
        listed = [[listed[0][0]] for _ in range(height)]
    turned = [list(column) for column in zip(*listed, strict=True)]
    return tuple(
        _side_by_side(vectors)
        for vectors in (turned, listed)
        if vectors and len(vectors[0]) == height and len(vectors) <= MOST_VECTORS
    )


def _side_by_side(vectors: Sequence[Sequence[RationalExpr]]) -> Matrix:
    """The matrix with these columns, each times its denominators."""
    plain = [_without_denominators(vector) for vector in vectors]
    return Matrix.of(vectors[0][0].ring, zip(*plain, strict=True))


def _without_denominators(vector: Sequence[RationalExpr]) -> list[Expr]:
    ring = vector[0].ring
    found = []
    for place, entry in enumerate(vector):
        product = entry.numerator
        for other, factor in enumerate(vector):
            if other != place:
                product = product * factor.denominator
        found.append(product)
    return found if found else [ring.zero]


def spans(key: Matrix, written: Sequence[Matrix], values: Mapping[str, Fraction]) -> bool:
    """Whether any reading spans what the key's columns do, also with numbers for symbols."""
    if any(_same(key, one) for one in written):
        return True
    ring = key.ring
    put = {ring.symbol_indices[n, 0]: v for n, v in values.items() if ring.has_symbol(n)}
    if not put:
        return False
    numbers = key.map(lambda entry: substituted(entry, put))
    return any(_same(numbers, one.map(lambda entry: _number(entry, put))) for one in written)


def _number(entry: Expr, put: Mapping[int, Fraction]) -> Expr:
    return put_numbers(RationalExpr(entry), put).numerator


def _same(key: Matrix, written: Matrix) -> bool:
    return key.shape[0] == written.shape[0] and same_span(key, written)


def difference(key: Matrix, written: Sequence[Matrix], height: int) -> str:
    """What is wrong with the vectors, in a sentence."""
    if not written:
        return f"These are no vectors of {height} entries."
    mine, wanted = rank_parts(written[0]).rank, key.shape[1]
    if mine != wanted:
        return f"The space that you wrote has dimension {mine}; this one has dimension {wanted}."
    return "The space has the right dimension, but these vectors are not in it."
