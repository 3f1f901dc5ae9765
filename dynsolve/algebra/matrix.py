"""Matrices of exact expressions."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass

from dynsolve.algebra.expr import Expr
from dynsolve.algebra.ring import Ring


@dataclass(frozen=True, slots=True)
class Matrix:
    """An r×c matrix over a ring; frozen."""

    ring: Ring
    rows: tuple[tuple[Expr, ...], ...]

    @staticmethod
    def of(ring: Ring, rows: Iterable[Iterable[Expr]]) -> Matrix:
        """The matrix with these rows."""
        return Matrix(ring, tuple(tuple(row) for row in rows))

    @staticmethod
    def identity(ring: Ring, n: int) -> Matrix:
        """1, n×n."""
        return Matrix.of(ring, ([ring.one if i == j else ring.zero for j in range(n)] for i in range(n)))

    @staticmethod
    def zero(ring: Ring, r: int, c: int) -> Matrix:
        """0, r×c."""
        return Matrix(ring, ((ring.zero,) * c,) * r)

    @staticmethod
    def column(ring: Ring, entries: Iterable[Expr]) -> Matrix:
        """A column vector."""
        return Matrix.of(ring, ([entry] for entry in entries))

    @property
    def shape(self) -> tuple[int, int]:
        """(rows, columns)"""
        return len(self.rows), len(self.rows[0]) if self.rows else 0

    @property
    def T(self) -> Matrix:
        """The transpose."""
        return Matrix(self.ring, tuple(zip(*self.rows, strict=True)))

    @property
    def entries(self) -> tuple[Expr, ...]:
        """All entries, row by row: of a column vector, its components."""
        return tuple(entry for row in self.rows for entry in row)

    @property
    def is_zero(self) -> bool:
        """Whether every entry is 0."""
        return all(entry.is_zero for entry in self.entries)

    def __getitem__(self, place: tuple[int, int]) -> Expr:
        return self.rows[place[0]][place[1]]

    def __matmul__(self, other: Matrix) -> Matrix:
        columns = other.T.rows
        return Matrix.of(self.ring, ([self.ring.dot(row, column) for column in columns] for row in self.rows))

    def __add__(self, other: Matrix) -> Matrix:
        return self._with(other, lambda a, b: a + b)

    def __sub__(self, other: Matrix) -> Matrix:
        return self._with(other, lambda a, b: a - b)

    def __neg__(self) -> Matrix:
        return self.map(lambda entry: -entry)

    def _with(self, other: Matrix, operation: Callable[[Expr, Expr], Expr]) -> Matrix:
        pairs = zip(self.rows, other.rows, strict=True)
        return Matrix.of(self.ring, (map(operation, mine, theirs) for mine, theirs in pairs))

    def map(self, function: Callable[[Expr], Expr]) -> Matrix:
        """The matrix of function(entry), in the ring of its values."""
        rows = tuple(tuple(map(function, row)) for row in self.rows)
        return Matrix(rows[0][0].ring if rows and rows[0] else self.ring, rows)

    def scale(self, factor: Expr) -> Matrix:
        """factor · self"""
        return self.map(lambda entry: factor * entry)

    def block(self, r0: int, r1: int, c0: int, c1: int) -> Matrix:
        """Rows r0..r1-1 and columns c0..c1-1."""
        return Matrix(self.ring, tuple(row[c0:c1] for row in self.rows[r0:r1]))

    def column_at(self, j: int) -> Matrix:
        """Column j as a column vector."""
        return Matrix(self.ring, tuple((row[j],) for row in self.rows))


def skew(a: Matrix) -> Matrix:
    """S(a), 3×3, with S(a) b = a × b."""
    (x, y, z), zero = a.entries, a.ring.zero
    return Matrix(a.ring, ((zero, -z, y), (z, zero, -x), (-y, x, zero)))


def cross(a: Matrix, b: Matrix) -> Matrix:
    """a × b of two 3×1 columns."""
    (x, y, z), (u, v, w) = a.entries, b.entries
    return Matrix.column(a.ring, (y * w - z * v, z * u - x * w, x * v - y * u))


def hstack(ring: Ring, columns: Sequence[Matrix], height: int) -> Matrix:
    """Columns side by side; a matrix of `height` rows."""
    return Matrix.of(ring, ([c[i, 0] for c in columns] for i in range(height)))


def vstack(upper: Matrix, lower: Matrix) -> Matrix:
    """Two matrices of one width, one above the other."""
    return Matrix(upper.ring, upper.rows + lower.rows)
