"""The entries d_ij, c_ijk and g_k by their names, and formulas in them."""

from __future__ import annotations

from dataclasses import dataclass, replace

from dynsolve.explain.abbreviations import Abbreviated
from dynsolve.explain.writing import sum_of
from dynsolve.notation import tree
from dynsolve.notation.tree import ZERO, Letter, Node, Number, Power, Product, Symbol
from dynsolve.quantities import letters
from dynsolve.robot.model import Robot


@dataclass(frozen=True, slots=True)
class Entries:
    """The entries of a model by name, indices from 0; those that are zero are left out."""

    robot: Robot
    short: Abbreviated

    def d(self, i: int, j: int, dots: int = 0) -> Letter | None:
        """The name of d_ij; None where it is zero."""
        if self.short.D.rows[i][j] == ZERO:
            return None
        return replace(letters.entry("d", min(i, j) + 1, max(i, j) + 1), dots=dots)

    def c(self, i: int, j: int, k: int) -> Letter | None:
        """The name of c_ijk, of which the first two indices may be swapped; None where it is zero."""
        i, j = min(i, j), max(i, j)
        if self.short.christoffel[i, j, k] == ZERO:
            return None
        return letters.entry("c", i + 1, j + 1, k + 1)

    def g(self, k: int) -> Letter | None:
        """The name of g_k; None where it is zero."""
        return None if self.short.g.rows[k][0] == ZERO else letters.entry("g", k + 1)

    def rate(self, k: int, dots: int = 1) -> Symbol:
        """q̇_k, or q̈_k."""
        return Symbol(self.robot.coordinates[k].name, dots)

    def rates(self, i: int, j: int) -> tuple[Node, ...]:
        """q̇_i q̇_j"""
        return (Power(self.rate(i), Number(2)),) if i == j else (self.rate(i), self.rate(j))

    def pairs(self) -> list[tuple[int, int]]:
        """(i, j) with i ≤ j."""
        return [(i, j) for i in range(self.robot.n) for j in range(i, self.robot.n)]

    def kinetic_energy(self) -> list[Node]:
        """½ d_ii q̇_i², d_ij q̇_i q̇_j"""
        return [
            Product((*([letters.HALF] if i == j else []), d, *self.rates(i, j)))
            for i, j in self.pairs()
            if (d := self.d(i, j))
        ]

    def momentum(self, k: int) -> list[Node]:
        """d_kj q̇_j"""
        return [Product((d, self.rate(j))) for j in range(self.robot.n) if (d := self.d(k, j))]

    def accelerated(self, k: int) -> list[Node]:
        """d_kj q̈_j"""
        return [Product((d, self.rate(j, 2))) for j in range(self.robot.n) if (d := self.d(k, j))]

    def coriolis_force(self, k: int) -> list[Node]:
        """c_ijk q̇_i q̇_j, twice where i and j differ"""
        return [
            Product((*([] if i == j else [Number(2)]), c, *self.rates(i, j)))
            for i, j in self.pairs()
            if (c := self.c(i, j, k))
        ]

    def coriolis_matrix(self) -> tree.Matrix:
        """C, with c_kj = Σ_i c_ijk q̇_i."""
        n = self.robot.n

        def entry(k: int, j: int) -> Node:
            return sum_of([Product((c, self.rate(i))) for i in range(n) if (c := self.c(i, j, k))])

        return tree.Matrix(tuple(tuple(entry(k, j) for j in range(n)) for k in range(n)))
