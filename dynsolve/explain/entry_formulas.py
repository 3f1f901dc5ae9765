"""Formulas in d_ij, c_ijk and g_k: by their compact forms, and those of a long model by their names.

A long model stays in these letters: its energies, momenta and forces written out would fill pages.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from fractions import Fraction

from msgspec import Struct
from msgspec.structs import replace

from dynsolve.algebra.compact.collect import product_of_sums
from dynsolve.algebra.ring import Expr
from dynsolve.derivation.graph import Derivation
from dynsolve.notation import tree
from dynsolve.notation.build import cost, factors_of, negated, split_sign, times, total
from dynsolve.notation.template import formula
from dynsolve.notation.tree import ZERO, Letter, Node, Number, Product, Relation, Symbol
from dynsolve.quantities import letters
from dynsolve.robot.model import Robot

Factor = tuple[Node, int]
"""A factor of a product, and its exponent."""

QUADRATIC = Product((letters.HALF, letters.transposed_product(letters.QD, letters.D)))
"""½ q̇ᵀ D q̇"""

ChristoffelSymbols = Callable[[int, int, int], Node]
"""c_ijk of i, j, k from 0, and ZERO for one that is zero."""


class EntryFormulas(Struct, frozen=True):
    """The formulas of the energies, momenta and forces for given ways to write d_ij, c_ijk, g_k and friction.

    Indices count from 0.  Each pair of rates is written once: q̇_i q̇_j with i ≤ j.
    """

    coordinates: Sequence[str]
    d: Callable[[int, int], Node]
    c: ChristoffelSymbols
    g: Callable[[int], Node]
    friction: Callable[[int], Node]
    product: Callable[[Fraction | int, Iterable[Factor]], Node] = times
    """Writes coefficient · Π node^exponent."""

    def kinetic_energy(self) -> Node:
        """K = Σ_i ½ d_ii q̇_i² + Σ_{i<j} d_ij q̇_i q̇_j"""
        return total(
            [
                self.product(Fraction(1, 2) if i == j else 1, [(self.d(i, j), 1), *rates])
                for i, j, rates in self._pairs()
            ]
        )

    def momentum(self, k: int) -> Node:
        """∂L/∂q̇_k = Σ_j d_kj q̇_j"""
        return total(self._times_rates(k, dots=1))

    def momentum_rate(self, k: int) -> Node:
        """d/dt ∂L/∂q̇_k = Σ_j d_kj q̈_j + Σ_ij ∂d_kj/∂q_i q̇_i q̇_j, with ∂d_kj/∂q_i = c_ijk + c_ikj"""
        terms = self.acceleration_terms(k)
        for i, j, rates in self._pairs():
            own = self.product(1 if i == j else 2, [(self.c(i, j, k), 1)])
            others = [self.c(i, k, j)] if i == j else [self.c(i, k, j), self.c(j, k, i)]
            terms.append(self.product(1, [(total([own, *others]), 1), *rates]))
        return total(terms)

    def lagrangian_derivative(self, k: int) -> Node:
        """∂L/∂q_k = ½ Σ_ij ∂d_ij/∂q_k q̇_i q̇_j - g_k, with ∂d_ij/∂q_k = c_kij + c_kji"""
        terms = []
        for i, j, rates in self._pairs():
            factor = self.c(k, i, i) if i == j else total([self.c(k, i, j), self.c(k, j, i)])
            terms.append(self.product(1, [(factor, 1), *rates]))
        return total([*terms, negated(self.g(k))])

    def force(self, k: int) -> Node:
        """τ_k = Σ_j d_kj q̈_j + Σ_ij c_ijk q̇_i q̇_j + friction_k + g_k"""
        return total([*self.acceleration_terms(k), *self.coriolis_terms(k), self.friction(k), self.g(k)])

    def acceleration_terms(self, k: int) -> list[Node]:
        """d_kj q̈_j for every j"""
        return self._times_rates(k, dots=2)

    def coriolis_terms(self, k: int) -> list[Node]:
        """Row k of C q̇: c_ijk q̇_i q̇_j for every i and j"""
        return [
            self.product(1 if i == j else 2, [(self.c(i, j, k), 1), *rates]) for i, j, rates in self._pairs()
        ]

    def _times_rates(self, k: int, dots: int) -> list[Node]:
        names = enumerate(self.coordinates)
        return [self.product(1, [(self.d(k, j), 1), (Symbol(name, dots), 1)]) for j, name in names]

    def _pairs(self) -> Iterator[tuple[int, int, list[Factor]]]:
        """(i, j, q̇_i q̇_j) with i ≤ j"""
        for i, j in pairs(len(self.coordinates)):
            yield i, j, rates_of_pair(self.coordinates, i, j)


def pairs(n: int) -> list[tuple[int, int]]:
    """(i, j) with i ≤ j, from 0."""
    return [(i, j) for i in range(n) for j in range(i, n)]


def rates_of_pair(coordinates: Sequence[str], i: int, j: int) -> list[Factor]:
    """q̇_i q̇_j, or q̇_i²"""
    if i == j:
        return [(Symbol(coordinates[i], 1), 2)]
    return [(Symbol(coordinates[i], 1), 1), (Symbol(coordinates[j], 1), 1)]


def coriolis_matrix(coordinates: Sequence[str], c: ChristoffelSymbols) -> tree.Matrix:
    """C with c_kj = Σ_i c_ijk q̇_i; the rates of equal symbols are collected."""
    n = len(coordinates)

    def entry(k: int, j: int) -> Node:
        return collected((c(i, j, k), Symbol(name, 1)) for i, name in enumerate(coordinates))

    return tree.Matrix(tuple(tuple(entry(k, j) for j in range(n)) for k in range(n)))


def collected_coriolis_force(coordinates: Sequence[str], c: ChristoffelSymbols, k: int) -> Node:
    """Row k of C q̇; the rates of equal symbols are collected."""
    return collected(
        (c(i, j, k), times(1 if i == j else 2, rates_of_pair(coordinates, i, j)))
        for i, j in pairs(len(coordinates))
    )


def collected(terms: Iterable[tuple[Node, Node]]) -> Node:
    """Σ symbol · rate, the rates of each symbol in one sum: σ (q̇₁ - q̇₂) of σ and -σ."""
    shared: dict[Node, list[tuple[int, Node]]] = {}
    for symbol, rate in terms:
        if symbol != ZERO:
            sign, inner = split_sign(symbol)
            shared.setdefault(inner, []).append((sign, rate))
    return total([_with_rates(symbol, rates) for symbol, rates in shared.items()])


def _with_rates(symbol: Node, rates: Sequence[tuple[int, Node]]) -> Node:
    """symbol · Σ ± rate, with a minus before it where all have one: 2h q̇₃ (q̇₁ + q̇₂), -h (q̇₁ + q̇₂)²."""
    front = max(sign for sign, _ in rates)
    inner = total([rate if sign == front else negated(rate) for sign, rate in rates])
    return times(front, [(symbol, 1), *((factor, 1) for factor in factors_of(product_of_sums(inner)))])


# -- the formulas of a long model, in the names of the entries -------------------------------------


def depends_on(robot: Robot, *values: Expr) -> list[int]:
    """The coordinates, from 0, that values depend on."""
    each = set(values)
    return [k for k in range(robot.n) if any(not robot.ring.diff(value, k).is_zero for value in each)]


def in_names_of_entries(robot: Robot, values: Derivation) -> EntryFormulas:
    """The formulas in d_ij, c_ijk, g_k and the friction by name, 0 for what is zero."""

    def d(i: int, j: int) -> Node:
        return ZERO if values["D"][i, j].is_zero else letters.entry("d", min(i, j) + 1, max(i, j) + 1)

    def c(i: int, j: int, k: int) -> Node:
        i, j = min(i, j), max(i, j)
        return ZERO if values["christoffel"][i, j, k].is_zero else letters.entry("c", i + 1, j + 1, k + 1)

    def g(k: int) -> Node:
        return ZERO if values["g"][k, 0].is_zero else letters.entry("g", k + 1)

    def friction(k: int) -> Node:
        rubs = robot.actions.resisting and not values["friction"][k, 0].is_zero
        return letters.friction(k + 1) if rubs else ZERO

    return EntryFormulas(robot.ring.names, d, c, g, friction, _with_number_in_front)


def _with_number_in_front(coefficient: Fraction | int, factors: Iterable[Factor]) -> Node:
    """coefficient · Π node^exponent with names for factors: ½ d_11 q̇_1², not d_11 q̇_1² / 2."""
    product = times(1, factors)
    if coefficient == 1 or product == ZERO:
        return product
    inner = product.factors if isinstance(product, Product) else (product,)
    return Product((Number(coefficient.numerator, coefficient.denominator), *inner))


def forms_of_long_model(robot: Robot, values: Derivation) -> dict[str, Node]:
    """K, L, and of each coordinate ∂L/∂q̇, d/dt of it, ∂L/∂q and the force, by the names of the quantities."""
    formulas, D = in_names_of_entries(robot, values), values["D"]
    found = {"K": formulas.kinetic_energy(), "L": formula("{K} - 𝒫", K=QUADRATIC)}
    for k, q in enumerate(robot.coordinates):
        found[f"dLdqd{q.index}"] = formulas.momentum(k)
        rates = [
            Product((replace(d, dots=1), Symbol(name, 1)))
            for j, name in enumerate(robot.ring.names)
            if isinstance(d := formulas.d(k, j), Letter) and depends_on(robot, D[k, j])
        ]
        found[f"ddt{q.index}"] = total([*formulas.acceleration_terms(k), *rates])
        slopes: list[Node] = []
        if k in depends_on(robot, *D.entries):
            slope = formula("(∂𝐃/∂{q})", q=Symbol(q.name))
            slopes.append(Product((letters.HALF, letters.transposed_product(letters.QD, slope))))
        found[f"dLdq{q.index}"] = total([*slopes, negated(formulas.g(k))])
        found[f"tau{q.index}"] = formulas.force(k)
    return found


LONGEST = 80
"""The operations up to which a result of a long model on the way to D, c_ijk and g is written out."""


def is_too_long(results: Sequence[Node]) -> bool:
    """Whether results on the way would fill pages."""
    return max(map(_size, results), default=0) > LONGEST


def _size(node: Node) -> int:
    value = node.parts[-1] if isinstance(node, Relation) else node
    if isinstance(value, tree.Matrix):
        return sum(_size(entry) for row in value.rows for entry in row)
    try:
        return cost(value)
    except TypeError:  # a formula in letters
        return 0
