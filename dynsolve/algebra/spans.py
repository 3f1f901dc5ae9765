"""Spaces spanned by exact vectors: what a matrix takes to zero, what it reaches, whether two are the same.

A basis is a matrix whose columns span the space; of {0} it has no columns.  Ranks are those for
general values of what is left as a symbol.
"""

from __future__ import annotations

from collections.abc import Sequence

from dynsolve.algebra.expr import Expr
from dynsolve.algebra.matrix import Matrix
from dynsolve.algebra.minors import determinant
from dynsolve.algebra.pseudoinverse import RankParts, adjugate, part, rank_parts


def nullspace(matrix: Matrix) -> Matrix:
    """A basis of the x with A x = 0, without denominators.

    With r independent rows and columns that meet in M, a further column j depends on these:
    x_j = det M, and the others are -adj M times that column.
    """
    found, ring = rank_parts(matrix), matrix.ring
    width = matrix.shape[1]
    M = part(matrix, found.rows, found.columns)
    size = determinant(M) if found.rank else ring.one
    vectors = []
    for free in (j for j in range(width) if j not in found.columns):
        vector = [ring.zero] * width
        vector[free] = size
        depending = adjugate(M) @ part(matrix, found.rows, (free,)) if found.rank else None
        for k, column in enumerate(found.columns):
            assert depending is not None
            vector[column] = -depending[k, 0]
        vectors.append(primitive(vector))
    return basis(matrix, vectors, width)


def rangespace(matrix: Matrix) -> Matrix:
    """A basis of all A x: independent columns; of a matrix with independent rows the unit vectors."""
    found, height = rank_parts(matrix), matrix.shape[0]
    if found.rank == height:
        return Matrix.identity(matrix.ring, height)
    vectors = [primitive([row[j] for row in matrix.rows]) for j in found.columns]
    return basis(matrix, vectors, height)


def basis(like: Matrix, vectors: Sequence[Sequence[Expr]], height: int) -> Matrix:
    """The matrix with these columns; without any it still has its height."""
    return Matrix.of(like.ring, ([vector[i] for vector in vectors] for i in range(height)))


def primitive(vector: Sequence[Expr]) -> list[Expr]:
    """A vector over what its entries share, the first that is not 0 with a positive leading number."""
    ring = vector[0].ring
    shared = ring.zero.poly
    for entry in vector:
        shared = shared.gcd(entry.poly)
    first = next((entry for entry in vector if not entry.is_zero), None)
    if first is None:
        return list(vector)
    lead = first.poly.leading_coefficient() / shared.leading_coefficient()
    return [Expr(ring, divmod(entry.poly, shared)[0] / lead) for entry in vector]


def same_span(one: Matrix, other: Matrix) -> bool:
    """Whether the columns of two matrices of one height span the same space."""
    both = Matrix(one.ring, tuple((*a, *b) for a, b in zip(one.rows, other.rows, strict=True)))
    return _rank(one) == _rank(other) == _rank(both)


def _rank(matrix: Matrix) -> int:
    return rank_parts(matrix).rank if matrix.shape[1] else RankParts((), ()).rank
