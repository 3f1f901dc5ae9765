"""Matrices of fractions: what comes out of a system of equations.

Systems of linear equations with exact coefficients: solved, of least norm, of least squares.

Every matrix J of rank r is B M⁻¹ R, with r independent columns B, r independent rows R and
the square part M where they meet; its pseudoinverse is

    J⁺ = Rᵀ (R Rᵀ)⁻¹ M (Bᵀ B)⁻¹ Bᵀ,

which is J⁻¹ of a square matrix of full rank, Jᵀ (J Jᵀ)⁻¹ of one with independent rows and
(Jᵀ J)⁻¹ Jᵀ of one with independent columns.  Where lengths are xᵀ W x, the part on the left is
W⁻¹ Rᵀ (R W⁻¹ Rᵀ)⁻¹ in place of Rᵀ (R Rᵀ)⁻¹.  Ranks are those for general values of what is
left as a symbol.

Golub, Van Loan, Matrix Computations, section 5.5; Ben-Israel, Greville, Generalized Inverses, 1.6.

A basis of a space (`spaces`) is a matrix whose columns span it; of {0} it has no columns.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence, Set
from fractions import Fraction
from itertools import combinations
from math import gcd, lcm

from msgspec import Struct

from dynsolve.algebra.fraction import RationalExpr, cancelled, equal, is_zero
from dynsolve.algebra.lowest_terms import without_shared
from dynsolve.algebra.matrix import Matrix, determinant
from dynsolve.algebra.rationals import fraction
from dynsolve.algebra.ring import Expr, Ring


class FractionMatrix(Struct, frozen=True, eq=False):
    """An r×c matrix of fractions over a ring; frozen.  `==` decides equality exactly."""

    ring: Ring
    rows: tuple[tuple[RationalExpr, ...], ...]

    @property
    def shape(self) -> tuple[int, int]:
        """(rows, columns)"""
        return len(self.rows), len(self.rows[0]) if self.rows else 0

    @property
    def entries(self) -> tuple[RationalExpr, ...]:
        """All entries, row by row."""
        return tuple(entry for row in self.rows for entry in row)

    def __getitem__(self, place: tuple[int, int]) -> RationalExpr:
        return self.rows[place[0]][place[1]]

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, FractionMatrix | Matrix) or self.shape != other.shape:
            return False
        pairs = zip(self.entries, map(fraction_of, other.entries), strict=True)
        return all(equal(a, b) for a, b in pairs)

    __hash__ = None  # type: ignore[assignment]

    def map(self, function: Callable[[RationalExpr], RationalExpr]) -> FractionMatrix:
        """The matrix of function(entry)."""
        return FractionMatrix(self.ring, tuple(tuple(map(function, row)) for row in self.rows))


def fraction_of(entry: Expr | RationalExpr) -> RationalExpr:
    """An entry of either kind of matrix as a fraction."""
    return entry if isinstance(entry, RationalExpr) else RationalExpr(entry)


def quotient(numerators: Matrix, divisor: Expr) -> Matrix | FractionMatrix:
    """A matrix over one divisor, each entry cancelled; polynomials where nothing is left below."""
    ring = numerators.ring
    rows = [[cancelled(RationalExpr(entry, divisor)) for entry in row] for row in numerators.rows]
    return tidy(ring, rows)


def inverse_times(matrix: Matrix, right: Matrix) -> Matrix | FractionMatrix | None:
    """A⁻¹ B, cancelled; None where A has no inverse.

    Rows that no entry beside the diagonal links are solved apart: of a diagonal matrix each over its own
    entry.

    >>> from dynsolve.algebra.ring_values import build_ring
    >>> from dynsolve.notation.tree import Symbol
    >>> ring = build_ring([], [Symbol("a"), Symbol("b")])
    >>> a, b = ring.symbol("a"), ring.symbol("b")
    >>> found = inverse_times(Matrix.of(ring, [[a, ring.zero], [ring.zero, a + b]]), Matrix.identity(ring, 2))
    >>> found[1, 1]
    RationalExpr(numerator=Expr(1), divisor=Expr(1*a + 1*b))
    """
    rows: dict[int, tuple[RationalExpr, ...]] = {}
    for block in blocks(matrix):
        linked = part(matrix, block, block)
        divisor = determinant(linked)
        if divisor.is_zero:
            return None
        here = adjugate(linked) @ Matrix(right.ring, tuple(right.rows[i] for i in block))
        for i, row in zip(block, here.rows, strict=True):
            rows[i] = tuple(cancelled(RationalExpr(entry, divisor)) for entry in row)
    return tidy(matrix.ring, [rows[i] for i in range(len(rows))])


def is_diagonal(matrix: Matrix) -> bool:
    """Whether all entries beside the diagonal of a square matrix are 0."""
    return len(blocks(matrix)) == len(matrix.rows)


def blocks(matrix: Matrix) -> list[tuple[int, ...]]:
    """The rows of a square matrix, from 0, in sets that no entry links with each other."""
    found: list[set[int]] = []
    for i, row in enumerate(matrix.rows):
        linked = {i, *(j for j, entry in enumerate(row) if not (entry.is_zero and matrix[j, i].is_zero))}
        apart = [one for one in found if one.isdisjoint(linked)]
        found = [*apart, linked.union(*(one for one in found if one not in apart))]
    return [tuple(sorted(one)) for one in found]


def tidy(ring: Ring, rows: Iterable[Iterable[RationalExpr]]) -> Matrix | FractionMatrix:
    """A matrix of fractions, one of polynomials where it has no denominators."""
    listed = tuple(tuple(row) for row in rows)
    if all(entry.divisor is None for row in listed for entry in row):
        return Matrix.of(ring, ([entry.numerator for entry in row] for row in listed))
    return FractionMatrix(ring, listed)


# Systems of linear equations with exact coefficients


class RankParts(Struct, frozen=True):
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


# Spaces spanned by exact vectors


def basis(like: Matrix, vectors: Sequence[Sequence[Expr]], height: int) -> Matrix:
    """The matrix with these columns; without any it still has its height."""
    return Matrix.of(like.ring, ([vector[i] for vector in vectors] for i in range(height)))


def primitive(vector: Sequence[Expr]) -> list[Expr]:
    """A vector over what its entries share, in integers; its first number, or else entry, is positive."""
    some = [entry for entry in vector if not entry.is_zero]
    if not some:
        return list(vector)
    rests = iter(without_shared(some))
    divided = [entry if entry.is_zero else next(rests) for entry in vector]
    some = [entry for entry in divided if not entry.is_zero]
    leading = next((entry for entry in some if entry.is_number), some[0])
    number = content(divided) * (1 if leading.poly.leading_coefficient() > 0 else -1)
    return [entry * (1 / number) for entry in divided]


def content(values: Iterable[Expr]) -> Fraction:
    """The number that leaves whole coefficients without a common factor.

    >>> from dynsolve.algebra.ring_values import build_ring
    >>> from dynsolve.notation.tree import Symbol
    >>> ring = build_ring([], [Symbol("a"), Symbol("b")])
    >>> a, b = ring.symbol("a"), ring.symbol("b")
    >>> content([2 * a / 3, 4 * b])
    Fraction(2, 3)
    """
    numbers = [number for value in values for number in value.poly.coeffs()]
    return Fraction(gcd(*(int(n.p) for n in numbers)), lcm(*(int(n.q) for n in numbers)))


MOST_DIGITS = 6
"""What has more is printed rounded."""


def decimal_content(values: Iterable[Expr], typed: Set[Fraction] = frozenset()) -> Fraction:
    """The number that leaves coefficients of the fewest digits, but for those of numbers that were typed.

    >>> from dynsolve.algebra.ring_values import build_ring
    >>> from dynsolve.notation.tree import Symbol
    >>> ring = build_ring([], [Symbol("a"), Symbol("b")])
    >>> a, b = ring.symbol("a"), ring.symbol("b")
    >>> decimal_content([981 * a + 100 * b]), decimal_content([3 * a + 4 * b])
    (Fraction(100, 1), Fraction(1, 1))
    """
    values = list(values)
    whole = content(values)
    numbers = [abs(fraction(number)) / whole for value in values for number in value.poly.coeffs()]
    ways = dict.fromkeys([*(Fraction(10) ** power for power in range(MOST_DIGITS)), *numbers])
    return whole * min(ways, key=lambda way: sum(_digits(n / way) for n in numbers if n / way not in typed))


def _digits(number: Fraction) -> int:
    """How many digits are written of a positive number, none of 1."""
    ends = next((k for k in range(MOST_DIGITS) if (number * 10**k).denominator == 1), MOST_DIGITS)
    size = max(len(str(int(number * 10**ends))), ends + 1)
    return 0 if number == 1 else min(size, MOST_DIGITS + 1)


def same_span(one: Matrix, other: Matrix) -> bool:
    """Whether the columns of two matrices of one height span the same space."""
    both = Matrix(one.ring, tuple((*a, *b) for a, b in zip(one.rows, other.rows, strict=True)))
    return _rank(one) == _rank(other) == _rank(both)


def _rank(matrix: Matrix) -> int:
    return rank_parts(matrix).rank if matrix.shape[1] else RankParts((), ()).rank
