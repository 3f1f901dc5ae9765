"""Formulas in d_ij, c_ijk and g_k, these being written by their compact forms or by their names."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from fractions import Fraction

from dynsolve.notation.build import negated, times, total
from dynsolve.notation.tree import ZERO, Matrix, Node, Symbol

ChristoffelSymbols = Callable[[int, int, int], Node]
"""c_ijk of i, j, k from 0, and ZERO for one that is zero."""

Factor = tuple[Node, int]
"""A factor of a product, and its exponent."""


ProductWriter = Callable[[Fraction | int, Iterable[Factor]], Node]
"""Writes coefficient · Π node^exponent."""


@dataclass(frozen=True, slots=True)
class EntryFormulas:
    """The formulas of the energies, momenta and forces for given ways to write d_ij, c_ijk, g_k and friction.

    Indices count from 0.  Each pair of rates is written once: q̇_i q̇_j with i ≤ j.
    """

    coordinates: Sequence[str]
    d: Callable[[int, int], Node]
    c: ChristoffelSymbols
    g: Callable[[int], Node]
    friction: Callable[[int], Node]
    product: ProductWriter = times

    def kinetic_energy(self) -> Node:
        """K = Σ_i ½ d_ii q̇_i² + Σ_{i<j} d_ij q̇_i q̇_j"""
        return total(
            [
                self.product(Fraction(1, 2) if i == j else 1, [(self.d(i, j), 1), *self._rates(i, j)])
                for i, j in pairs(len(self.coordinates))
            ]
        )

    def momentum(self, k: int) -> Node:
        """∂L/∂q̇_k = Σ_j d_kj q̇_j"""
        return total(self._times_rates(k, dots=1))

    def momentum_rate(self, k: int) -> Node:
        """d/dt ∂L/∂q̇_k = Σ_j d_kj q̈_j + Σ_ij ∂d_kj/∂q_i q̇_i q̇_j, with ∂d_kj/∂q_i = c_ijk + c_ikj"""
        terms = self.acceleration_terms(k)
        for i, j in pairs(len(self.coordinates)):
            own = self.product(1 if i == j else 2, [(self.c(i, j, k), 1)])
            others = [self.c(i, k, j)] if i == j else [self.c(i, k, j), self.c(j, k, i)]
            terms.append(self.product(1, [(total([own, *others]), 1), *self._rates(i, j)]))
        return total(terms)

    def lagrangian_derivative(self, k: int) -> Node:
        """∂L/∂q_k = ½ Σ_ij ∂d_ij/∂q_k q̇_i q̇_j - g_k, with ∂d_ij/∂q_k = c_kij + c_kji"""
        terms = []
        for i, j in pairs(len(self.coordinates)):
            factor = self.c(k, i, i) if i == j else total([self.c(k, i, j), self.c(k, j, i)])
            terms.append(self.product(1, [(factor, 1), *self._rates(i, j)]))
        return total([*terms, negated(self.g(k))])

    def force(self, k: int) -> Node:
        """τ_k = Σ_j d_kj q̈_j + Σ_ij c_ijk q̇_i q̇_j + friction_k + g_k"""
        return total([*self.acceleration_terms(k), *self._coriolis_terms(k), self.friction(k), self.g(k)])

    def acceleration_terms(self, k: int) -> list[Node]:
        """d_kj q̈_j for every j"""
        return self._times_rates(k, dots=2)

    def coriolis_force(self, k: int) -> Node:
        """Row k of C q̇: Σ_ij c_ijk q̇_i q̇_j"""
        return total(self._coriolis_terms(k))

    def _coriolis_terms(self, k: int) -> list[Node]:
        return [
            self.product(1 if i == j else 2, [(self.c(i, j, k), 1), *self._rates(i, j)])
            for i, j in pairs(len(self.coordinates))
        ]

    def _times_rates(self, k: int, dots: int) -> list[Node]:
        return [
            self.product(1, [(self.d(k, j), 1), (Symbol(name, dots), 1)])
            for j, name in enumerate(self.coordinates)
        ]

    def _rates(self, i: int, j: int) -> list[Factor]:
        return rate_factors(self.coordinates, i, j)


def pairs(n: int) -> list[tuple[int, int]]:
    """(i, j) with i ≤ j, from 0."""
    return [(i, j) for i in range(n) for j in range(i, n)]


def rate_factors(coordinates: Sequence[str], i: int, j: int) -> list[Factor]:
    """q̇_i q̇_j, or q̇_i²"""
    if i == j:
        return [(Symbol(coordinates[i], 1), 2)]
    return [(Symbol(coordinates[i], 1), 1), (Symbol(coordinates[j], 1), 1)]


def coriolis_matrix(coordinates: Sequence[str], c: ChristoffelSymbols) -> Matrix:
    """C with c_kj = Σ_i c_ijk q̇_i; the rates of equal symbols are collected."""
    n = len(coordinates)

    def entry(k: int, j: int) -> Node:
        return _collected((c(i, j, k), Symbol(name, 1)) for i, name in enumerate(coordinates))

    return Matrix(tuple(tuple(entry(k, j) for j in range(n)) for k in range(n)))


def collected_coriolis_force(coordinates: Sequence[str], c: ChristoffelSymbols, k: int) -> Node:
    """Row k of C q̇; the rates of equal symbols are collected."""
    return _collected(
        (c(i, j, k), times(1 if i == j else 2, rate_factors(coordinates, i, j)))
        for i, j in pairs(len(coordinates))
    )


def _collected(terms: Iterable[tuple[Node, Node]]) -> Node:
    """Σ symbol · rate, the rates of each symbol in one sum."""
    shared: dict[Node, list[Node]] = {}
    for symbol, rate in terms:
        if symbol != ZERO:
            shared.setdefault(symbol, []).append(rate)
    return total([times(1, [(symbol, 1), (total(rates), 1)]) for symbol, rates in shared.items()])
