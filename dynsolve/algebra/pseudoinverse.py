"""Systems of linear equations with exact coefficients: solved, of least norm, of least squares.

Every matrix J of rank r is B M⁻¹ R, with r independent columns B, r independent rows R and
the square part M where they meet; its pseudoinverse is

    J⁺ = Rᵀ (R Rᵀ)⁻¹ M (Bᵀ B)⁻¹ Bᵀ,

which is J⁻¹ of a square matrix of full rank, Jᵀ (J Jᵀ)⁻¹ of one with independent rows and
(Jᵀ J)⁻¹ Jᵀ of one with independent columns.  Where lengths are xᵀ W x, the part on the left is
W⁻¹ Rᵀ (R W⁻¹ Rᵀ)⁻¹ in place of Rᵀ (R Rᵀ)⁻¹.  Ranks are those for general values of what is
left as a symbol.

Golub, Van Loan, Matrix Computations, section 5.5; Ben-Israel, Greville, Generalized Inverses, 1.6.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import combinations

from dynsolve.algebra.expr import Expr
from dynsolve.algebra.fraction import is_zero
from dynsolve.algebra.fraction_matrix import FractionMatrix, quotient
from dynsolve.algebra.matrix import Matrix
from dynsolve.algebra.minors import determinant


@dataclass(frozen=True, slots=True)
class RankParts:
    """Independent rows and columns of a matrix, as many as its rank."""

    rows: tuple[int, ...]
    columns: tuple[int, ...]

    @property
    def rank(self) -> int:
        """The rank."""
        return len(self.rows)


def rank_parts(matrix: Matrix) -> RankParts:
    """The first independent rows and columns: a minor of the greatest size that is not 0."""
    height, width = matrix.shape
    for size in range(min(height, width), 0, -1):
        for rows in combinations(range(height), size):
            for columns in combinations(range(width), size):
                if not is_zero(determinant(part(matrix, rows, columns))):
                    return RankParts(rows, columns)
    return RankParts((), ())


def part(matrix: Matrix, rows: tuple[int, ...], columns: tuple[int, ...]) -> Matrix:
    """The entries where some rows and columns meet."""
    return Matrix.of(matrix.ring, ([matrix[i, j] for j in columns] for i in rows))


def adjugate(matrix: Matrix) -> Matrix:
    """adj A, n×n, with A adj A = det A."""
    size = range(len(matrix.rows))

    def entry(i: int, j: int) -> Expr:
        rows, columns = tuple(k for k in size if k != j), tuple(k for k in size if k != i)
        minor = determinant(part(matrix, rows, columns))
        return minor if (i + j) % 2 == 0 else -minor

    return Matrix.of(matrix.ring, ([entry(i, j) for j in size] for i in size))


def pseudoinverse_times(
    matrix: Matrix, right: Matrix, weights: Matrix | None = None
) -> Matrix | FractionMatrix:
    """J⁺ b: the solution of J x = b; of many the shortest; of none what is nearest to one.

    With `weights` W, symmetric and positive definite, the shortest is that with the least xᵀ W x.
    """
    found, ring = rank_parts(matrix), matrix.ring
    height, width = matrix.shape
    if not found.rank:
        return Matrix.zero(ring, width, 1)
    if found.rank == height == width:
        return quotient(adjugate(matrix) @ right, determinant(matrix))
    every_row, every_column = tuple(range(height)), tuple(range(width))
    R = part(matrix, found.rows, every_column)
    value, divisor = right, ring.one
    if found.rank == height:
        value = right
    else:
        B = part(matrix, every_row, found.columns)
        squares = B.T @ B
        value = part(matrix, found.rows, found.columns) @ adjugate(squares) @ B.T @ right
        divisor = determinant(squares)
    lifted = R.T if weights is None else adjugate(weights) @ R.T  # a factor of W⁻¹ cancels
    squares = R @ lifted
    return quotient(lifted @ adjugate(squares) @ value, divisor * determinant(squares))


def is_solvable(matrix: Matrix, right: Matrix) -> bool:
    """Whether J x = b has a solution: whether b adds nothing to the rank."""
    both = Matrix(matrix.ring, tuple((*row, b) for row, (b,) in zip(matrix.rows, right.rows, strict=True)))
    return rank_parts(both).rank == rank_parts(matrix).rank
