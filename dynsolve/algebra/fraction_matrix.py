"""Matrices of fractions: what comes out of a system of equations."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass

from dynsolve.algebra.expr import Expr
from dynsolve.algebra.fraction import RationalExpr, cancelled, equal
from dynsolve.algebra.matrix import Matrix
from dynsolve.algebra.ring import Ring


@dataclass(frozen=True, slots=True, eq=False)
class FractionMatrix:
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


def tidy(ring: Ring, rows: Iterable[Iterable[RationalExpr]]) -> Matrix | FractionMatrix:
    """A matrix of fractions, one of polynomials where it has no denominators."""
    listed = tuple(tuple(row) for row in rows)
    if all(entry.divisor is None for row in listed for entry in row):
        return Matrix.of(ring, ([entry.numerator for entry in row] for row in listed))
    return FractionMatrix(ring, listed)
