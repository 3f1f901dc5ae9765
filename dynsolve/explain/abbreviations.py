"""Long results with names: constants first, then what recurs.

An explicit model of a six-joint arm is read as Armstrong, Khatib and Burdick wrote
theirs (The explicit dynamic model and inertial parameters of the PUMA 560 arm, ICRA
1986): inertial constants J₁, J₂, ... are defined once, and every entry of D, C and g
is a short sum of products of sines, cosines and these.

1. Angles are collected outside; what is left at each product of sines and cosines is
   a combination of masses, moments and lengths.  Each becomes a constant, unless it
   is a multiple of one that has a name or a sum of two.
2. Sums that then stand in several places are named h₁, h₂, ..., the longest first.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from fractions import Fraction
from itertools import combinations

from dynsolve.algebra.build import cost
from dynsolve.algebra.collect import Poly
from dynsolve.algebra.compact import Compactor
from dynsolve.algebra.matrix import Matrix
from dynsolve.algebra.terms import Exponents, Factor, Frame, Terms, exact, primitive
from dynsolve.explain.forms import Forms
from dynsolve.notation import tree
from dynsolve.notation.tree import Negative, Node, Power, Product, Quotient, Sum, Symbol

SHORTEST = 2
"""The operations from which on a constant is worth a name."""

SHORTEST_SUM = 5
"""The operations from which on a recurring sum is worth a name."""

NEIGHBOURS = 60
"""How many of the latest constants are tried for a sum of two."""


@dataclass(frozen=True, slots=True)
class Definition:
    """name = meaning"""

    name: Symbol
    meaning: Node


@dataclass(frozen=True, slots=True)
class Abbreviated:
    """Definitions in the order in which they build on each other, and the forms that use them.

    `D` and `g` are matrices, `christoffel` holds c_ijk at (i, j, k) with i ≤ j and from 0.
    """

    constants: tuple[Definition, ...]
    sums: tuple[Definition, ...]
    D: tree.Matrix
    g: tree.Matrix
    christoffel: Mapping[tuple[int, int, int], Node]

    @property
    def cost(self) -> int:
        """The operations of everything, definitions included."""
        definitions = sum(cost(d.meaning) for d in (*self.constants, *self.sums))
        entries = [e for matrix in (self.D, self.g) for row in matrix.rows for e in row]
        return definitions + sum(map(cost, (*entries, *self.christoffel.values())))


def abbreviate(forms: Forms) -> Abbreviated:
    """The explicit model of a robot, with its constants and recurring sums named."""
    values, robot = forms.values, forms.robot
    taken = {*robot.ring.parameters, *robot.ring.names}
    compactor = _Naming(forms, _names("J", taken))
    D, g = (_matrix(compactor, values[name]) for name in ("D", "g"))
    symbols = {key: compactor.form(value) for key, value in values["christoffel"].items()}
    entries = [e for matrix in (D, g) for row in matrix.rows for e in row] + list(symbols.values())
    sums = _recurring(entries, _names("h", taken))
    replace = _Replacement({d.meaning: d.name for d in sums})
    return Abbreviated(
        constants=tuple(compactor.constants),
        sums=tuple(Definition(d.name, replace.inside(d.meaning)) for d in sums),
        D=tree.Matrix(tuple(tuple(map(replace, row)) for row in D.rows)),
        g=tree.Matrix(tuple(tuple(map(replace, row)) for row in g.rows)),
        christoffel={key: replace(node) for key, node in symbols.items()},
    )


def _matrix(compactor: Compactor, matrix: Matrix) -> tree.Matrix:
    return compactor.matrix(matrix)


def _names(letter: str, taken: set[str]) -> Iterator[Symbol]:
    """letter1, letter2, ..., past those that the problem uses."""
    number = 0
    while True:
        number += 1
        if f"{letter}{number}" not in taken:
            yield Symbol(f"{letter}{number}")


class _Naming(Compactor):
    """Collects angles outside, and names what is left of masses, moments and lengths."""

    def __init__(self, forms: Forms, names: Iterator[Symbol]) -> None:
        super().__init__(forms.robot.ring, *forms.collecting)
        self.constants: list[Definition] = []
        self._names = names
        self._plain = forms.compactor
        self._symbols: dict[object, Symbol] = {}
        self._vectors: dict[Symbol, Poly] = {}

    def _scalar(self, frame: Frame, terms: Terms) -> Node:
        return self._by_angles(frame, terms)

    def _without_angles(self, frame: Frame, terms: Terms) -> Node:
        """Σ coordinate monomial · named constant"""
        names = [self.ring.generators[i].name for i in frame.symbols]
        moving = [k for k, name in enumerate(names) if name in self.ring.names]
        parts: dict[Exponents, Terms] = {}
        for e, f in terms.items():
            key = tuple(e[k] if k in moving else 0 for k in range(len(e)))
            parts.setdefault(key, {})[tuple(0 if k in moving else x for k, x in enumerate(e))] = f
        return self.collector.sum_of(
            (1, self._mono(frame.symbols, key), self._constant(frame, part)) for key, part in parts.items()
        )

    def _constant(self, frame: Frame, terms: Terms) -> Node:
        """The named constant, or the little that is not worth a name."""
        poly: Poly = {self._mono(frame.symbols, e): f for e, f in terms.items()}
        plain = self.collector.form(poly)
        if cost(plain) < SHORTEST:
            return plain
        key, scale = primitive(poly)
        found = self._symbols.get(key)
        if found is None:
            combined = self._combined(poly)
            if combined is not None:
                return combined
            found = self._symbols[key] = next(self._names)
            whole = {mono: exact(f, scale) for mono, f in poly.items()}
            self._vectors[found] = whole
            self.constants.append(Definition(found, self.collector.form(whole)))
        return self.collector.product(scale, (), (found,))

    def _combined(self, poly: Poly) -> Node | None:
        """The sum or difference of two named constants, where it is one."""
        near = list(self._vectors.items())[-NEIGHBOURS:]
        candidates = [(name, vector) for name, vector in near if not vector.keys().isdisjoint(poly)]
        for (first, a), (second, b) in combinations(candidates, 2):
            for sign in (1, -1):
                total = dict(a)
                for mono, f in b.items():
                    total[mono] = total.get(mono, 0) + sign * f
                total = {mono: f for mono, f in total.items() if f}
                if total.keys() == poly.keys() and (scale := _ratio(poly, total)) is not None:
                    inner = self.collector.sum_of([(1, (), first), (sign, (), second)])
                    return self.collector.product(scale, (), (inner,))
        return None


def _ratio(poly: Poly, other: Poly) -> Factor | None:
    """The number r with poly = r·other, or None."""
    ratios = {Fraction(f) / other[mono] for mono, f in poly.items()}
    return exact(ratios.pop(), 1) if len(ratios) == 1 else None


def _parts(node: Node) -> tuple[Node, ...]:
    match node:
        case Sum(parts) | Product(parts):
            return parts
        case Negative(part):
            return (part,)
        case Power(base):
            return (base,)
        case Quotient(numerator, _):
            return (numerator,)
    return ()


def _recurring(entries: Iterable[Node], names: Iterator[Symbol]) -> list[Definition]:
    """The sums that stand in several places, inner ones first."""
    counts: Counter[Node] = Counter()
    order: dict[Node, None] = {}

    def visit(node: Node) -> None:
        counts[node] += isinstance(node, Sum)
        if node in order:
            return
        for part in _parts(node):
            visit(part)
        order[node] = None

    for entry in entries:
        visit(entry)
    known: dict[int, tuple[Node, int]] = {}
    return [
        Definition(next(names), node)
        for node in order
        if counts[node] > 1 and cost(node, known) >= SHORTEST_SUM
    ]


class _Replacement:
    """Puts names for the sums that have one."""

    def __init__(self, names: Mapping[Node, Symbol]) -> None:
        self.names = names
        self._done: dict[Node, Node] = {}

    def __call__(self, node: Node) -> Node:
        if node in self.names:
            return self.names[node]
        found = self._done.get(node)
        if found is None:
            found = self._done[node] = self.inside(node)
        return found

    def inside(self, node: Node) -> Node:
        """The node with its parts replaced, itself not."""
        match node:
            case Sum(parts):
                return Sum(tuple(map(self, parts)))
            case Product(parts):
                return Product(tuple(map(self, parts)))
            case Negative(part):
                return Negative(self(part))
            case Power(base, exponent):
                return Power(self(base), exponent)
            case Quotient(numerator, denominator):
                return Quotient(self(numerator), denominator)
        return node
