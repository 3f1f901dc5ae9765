"""Determinants and minors of exact matrices, by Laplace's expansion; nothing is divided."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import combinations

from dynsolve.algebra.expr import Expr
from dynsolve.algebra.matrix import Matrix


def determinant(matrix: Matrix) -> Expr:
    """det of an n×n matrix.

    >>> from dynsolve.algebra.build import build_ring
    >>> from dynsolve.notation.tree import Symbol
    >>> ring = build_ring([], [Symbol("a"), Symbol("b")])
    >>> a, b = ring.symbol("a"), ring.symbol("b")
    >>> determinant(Matrix.of(ring, [[a, b], [b, a]]))
    Expr(1*a^2 + -1*b^2)
    """
    size = len(matrix.rows)
    return _Expansion(matrix).minor(tuple(range(size)), tuple(range(size)))


def work(matrix: Matrix) -> int:
    """The products of terms that a determinant may come to: the permanent of the numbers of terms."""
    sizes = [[len(entry) for entry in row] for row in matrix.rows]
    known: dict[tuple[int, ...], int] = {(): 1}

    def of(columns: tuple[int, ...]) -> int:
        if columns not in known:
            row = sizes[len(sizes) - len(columns)]
            rest = ((row[j], columns[:k] + columns[k + 1 :]) for k, j in enumerate(columns) if row[j])
            known[columns] = sum(size * of(left) for size, left in rest)
        return known[columns]

    return of(tuple(range(len(sizes))))


def minors(matrix: Matrix, size: int) -> Iterator[Expr]:
    """The determinants of all square parts of a size that are not 0 for every state."""
    expansion = _Expansion(matrix)
    rows, columns = matrix.shape
    for chosen in combinations(range(rows), size):
        for across in combinations(range(columns), size):
            value = expansion.minor(chosen, across)
            if not value.is_zero:
                yield value


def parts(matrix: Matrix, size: int) -> Iterator[Matrix]:
    """All square parts of a size."""
    rows, columns = matrix.shape
    for chosen in combinations(range(rows), size):
        for across in combinations(range(columns), size):
            yield Matrix.of(matrix.ring, ([matrix[i, j] for j in across] for i in chosen))


class _Expansion:
    """Minors of one matrix, each computed once, along their first row."""

    def __init__(self, matrix: Matrix) -> None:
        self.matrix = matrix
        self._known: dict[tuple[tuple[int, ...], tuple[int, ...]], Expr] = {}

    def minor(self, rows: tuple[int, ...], columns: tuple[int, ...]) -> Expr:
        """The determinant of the part with these rows and columns."""
        if not rows:
            return self.matrix.ring.one
        key = rows, columns
        if key not in self._known:
            entries, below = [], []
            for k, column in enumerate(columns):
                entry = self.matrix[rows[0], column]
                if not entry.is_zero:
                    entries.append(entry if k % 2 == 0 else -entry)
                    below.append(self.minor(rows[1:], columns[:k] + columns[k + 1 :]))
            self._known[key] = self.matrix.ring.dot(entries, below)
        return self._known[key]
