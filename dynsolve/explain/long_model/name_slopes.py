"""The derivatives of the names in a formula by one coordinate.

A name is differentiated as it was defined, term by term; what comes out is often a name again.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

from dynsolve.algebra.expr import Expr
from dynsolve.algebra.ring_values import value_of
from dynsolve.explain.long_model.model import LongModel
from dynsolve.explain.recurring import Definition, expanded
from dynsolve.explain.working.differentiation import by_symbol, differentiated
from dynsolve.notation.build import negated, times, total
from dynsolve.notation.tree import (
    ZERO,
    Derivative,
    Function,
    Negative,
    Node,
    Number,
    Product,
    Relation,
    Sum,
    Symbol,
    equation,
)
from dynsolve.notation.walk import names_in
from dynsolve.quantities import letters

_FACTORS = (1, -1, 2, -2)
"""The multiples of a name that a derivative is looked for among."""


@dataclass(frozen=True)
class NameSlopes:
    """The derivatives by one coordinate, `k` from 0, of the names that a formula is made of.

    One that is a name of the formula again, or of the `result` that it leads to, is written as that.
    """

    model: LongModel
    k: int
    formula: Node
    result: Node = ZERO

    @property
    def coordinate(self) -> Symbol:
        """q_k"""
        return Symbol(self.model.context.robot.coordinates[self.k].name)

    @cached_property
    def shown(self) -> dict[Symbol, Relation]:
        """∂σ/∂q as it is made and what it is, for the names for which it is not zero."""
        found: dict[Symbol, Relation] = {}
        for definition in self._used:
            if not self._slope(definition.name).is_zero:
                slope = self.of(definition.name)
                chain = self.by_the_chain_rule(definition.meaning)
                found[definition.name] = equation(
                    *dict.fromkeys((slope, chain, self._values_of_names[slope]))
                )
        return found

    def of(self, node: Node) -> Derivative:
        """∂node/∂q in letters."""
        return letters.partial_derivative(node, self.coordinate)

    def by_the_chain_rule(self, node: Node) -> Node:
        """The derivative of a tree term by term, those of the names in letters."""
        by = by_symbol(self.coordinate)
        names = {definition.name for definition in self._used}

        def rule(part: Symbol) -> Node:
            if part not in names:
                return by(part)
            return ZERO if self._slope(part).is_zero else self.of(part)

        return _of_single_angles(differentiated(node, rule).tree)

    def value(self, node: Node) -> Node:
        """The derivative of a tree term by term, what those of the names are put in."""
        return self._put_in(self.by_the_chain_rule(node), self._values_of_names)

    def _put_in(self, node: Node, values: Mapping[Node, Node]) -> Node:
        """A tree with values for derivatives."""
        match node:
            case Derivative():
                return values[node]
            case Sum(terms):
                return total([self._put_in(term, values) for term in terms])
            case Negative(argument):
                return negated(self._put_in(argument, values))
            case Product(factors):
                return times(1, [(self._put_in(factor, values), 1) for factor in factors])
        return node

    @cached_property
    def _values_of_names(self) -> dict[Node, Node]:
        """What the derivatives of the names are: a name, a multiple of one, or else their terms."""
        found: dict[Node, Node] = {}
        for definition in self._used:
            slope = self._slope(definition.name)
            if not slope.is_zero:
                found[self.of(definition.name)] = self._as_a_name(slope) or self._put_in(
                    self.by_the_chain_rule(definition.meaning), found
                )
        return found

    def _as_a_name(self, slope: Expr) -> Node | None:
        """A name, or a small multiple of one, that has this value."""
        for definition in self._candidates:
            for factor in _FACTORS:
                if self._values[definition.name] * factor == slope:
                    return times(factor, [(definition.name, 1)])
        return None

    @cached_property
    def _used(self) -> list[Definition]:
        """The definitions that the formula needs, in their order."""
        return self._needed_by(self.formula)

    @cached_property
    def _candidates(self) -> list[Definition]:
        """Those of the formula, and those of the result."""
        return [*self._used, *(each for each in self._needed_by(self.result) if each not in self._used)]

    def _needed_by(self, formula: Node) -> list[Definition]:
        wanted, found = names_in(formula), []
        for definition in reversed(self.model.short.sums):
            if definition.name.name in wanted:
                found.append(definition)
                wanted |= names_in(definition.meaning)
        return found[::-1]

    def _slope(self, name: Symbol) -> Expr:
        return self.model.context.robot.ring.diff(self._values[name], self.k)

    @cached_property
    def _values(self) -> dict[Symbol, Expr]:
        return _values(self.model, self._candidates)


def slopes_that_are_names(model: LongModel) -> Iterator[tuple[Derivative, Node]]:
    """∂σ/∂q where it is a name again, or twice one, and that: coordinate by coordinate."""
    values = _values(model, model.short.sums)
    known: dict[Expr, Node] = {}
    for factor in _FACTORS:
        for name, value in values.items():
            known.setdefault(value * factor, times(factor, [(name, 1)]))
    for k, q in enumerate(model.context.robot.coordinates):
        for name, value in values.items():
            if form := known.get(model.context.robot.ring.diff(value, k)):
                yield letters.partial_derivative(name, Symbol(q.name)), form


def _values(model: LongModel, definitions: Sequence[Definition]) -> dict[Symbol, Expr]:
    """What names are worth, exactly."""
    names = [definition.name for definition in definitions]
    trees = expanded(model.short.definitions, names)
    ring = model.context.robot.ring
    return {name: value_of(ring, node) for name, node in zip(names, trees, strict=True)}


def _of_single_angles(node: Node) -> Node:
    """2 s c for sin(2θ), as the names are written."""
    match node:
        case Function("sin", Product((Number(2, 1), angle))):
            return Product((Number(2), Function("sin", angle), Function("cos", angle)))
        case Sum(terms):
            return total([_of_single_angles(term) for term in terms])
        case Negative(argument):
            return negated(_of_single_angles(argument))
        case Product(factors):
            return times(1, [(_of_single_angles(factor), 1) for factor in factors])
    return node
