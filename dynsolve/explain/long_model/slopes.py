"""One Christoffel symbol and one gravity term in full: the derivatives of what stands in names.

A name is differentiated as it was defined, term by term; what comes out is often a name again.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

from dynsolve.algebra.expr import Expr
from dynsolve.algebra.ring_values import value_of
from dynsolve.document import Prose
from dynsolve.explain.abbreviations import Definition, expanded, expanded_once
from dynsolve.explain.christoffel import in_slopes
from dynsolve.explain.long_model.model import LongModel
from dynsolve.explain.step import Line
from dynsolve.explain.working.differentiation import by_symbol, differentiated
from dynsolve.notation.build import negated, times, total
from dynsolve.notation.tree import (
    ZERO,
    Derivative,
    Negative,
    Node,
    Parenthesized,
    Product,
    Sum,
    Symbol,
    equation,
)
from dynsolve.notation.walk import names_in
from dynsolve.quantities import letters

MOST_SLOPES = 3
"""The derivatives of names that an example of a gravity term takes at most."""


def christoffel_example(model: LongModel, row: int) -> Line | None:
    """c_ijn of the entry d_in of D, i being `row` (from 0), by the last coordinate that the entry has."""
    ring, D, n = model.context.robot.ring, model.context.values["D"], model.n - 1
    varying = [k for k in range(model.n) if not ring.diff(D[row, n], k).is_zero]
    if not varying:
        return None
    by = varying[-1]
    i, j, k = (n, n, row) if by == n else (min(row, by), max(row, by), n)
    form = model.short.symbol(i, j, k)
    if form == ZERO:
        return None
    slopes = Sum((_slope(model, k, j, i), _slope(model, k, i, j), Negative(_slope(model, i, j, k))))
    members = dict.fromkeys((
        Product((letters.HALF, Parenthesized(slopes))),
        in_slopes(model.context, i, j, k),
        expanded_once(model.short.sums, form),
        form,
    ))  # fmt: skip
    shown = equation(letters.entry("c", i + 1, j + 1, k + 1), *members)
    return Line(("For example:",), (shown,))


def _slope(model: LongModel, row: int, column: int, by: int) -> Node:
    """∂d_ij/∂q_k of indices from 0."""
    entry = letters.entry("d", min(row, column) + 1, max(row, column) + 1)
    return letters.partial_derivative(entry, Symbol(model.context.robot.coordinates[by].name))


def gravity_example(model: LongModel) -> tuple[Line, ...]:
    """A gravity term for which a few names in the potential energy must be differentiated."""
    if model.short.P is None:
        return ()
    for k in reversed(range(model.n)):
        form = model.short.g.rows[k][0]
        if form == ZERO:
            continue
        slopes = _Slopes(model, k)
        if 1 <= len(slopes.shown) <= MOST_SLOPES:
            members = dict.fromkeys((slopes.of(letters.P), slopes.by_the_chain_rule(model.short.P), form))
            term = equation(letters.entry("g", k + 1), *members)
            one = len(slopes.shown) == 1
            why: Prose = (
                f"For one entry in full, the {'name that depends' if one else 'names that depend'} on ",
            )
            how = " is differentiated as it was" if one else " are differentiated as they were"
            why += (slopes.coordinate, f"{how} defined:")
            return Line(why, tuple(slopes.shown.values())), Line(("Put in:",), (term,))
    return ()


@dataclass(frozen=True)
class _Slopes:
    """The derivatives by one coordinate, `k` from 0, of the names that the potential energy is made of."""

    model: LongModel
    k: int

    @property
    def coordinate(self) -> Symbol:
        """q_k"""
        return Symbol(self.model.context.robot.coordinates[self.k].name)

    @cached_property
    def shown(self) -> dict[Symbol, Node]:
        """∂σ/∂q as it is made and what it is, for the names for which it is not zero."""
        found: dict[Symbol, Node] = {}
        for definition in self._used:
            if not self._slope(definition.name).is_zero:
                slope = self.of(definition.name)
                chain = self.by_the_chain_rule(definition.meaning)
                members = (slope, chain, self._put_in(chain), self._put_in(slope))
                found[definition.name] = equation(*dict.fromkeys(members))
        return found

    def of(self, node: Node) -> Node:
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

        return differentiated(node, rule).tree

    def _put_in(self, node: Node) -> Node:
        """A tree with derivatives that are names written as these."""
        match node:
            case Derivative():
                return self._named.get(node, node)
            case Sum(terms):
                return total([self._put_in(term) for term in terms])
            case Negative(argument):
                return negated(self._put_in(argument))
            case Product(factors):
                return times(1, [(self._put_in(factor), 1) for factor in factors])
        return node

    @cached_property
    def _named(self) -> dict[Node, Node]:
        """The derivatives that are names, or their opposites."""
        found: dict[Node, Node] = {}
        for definition in self._used:
            slope = self._slope(definition.name)
            for other in self._used:
                if self._values[other.name] in (slope, -slope):
                    sign = self._values[other.name] == slope
                    found[self.of(definition.name)] = other.name if sign else negated(other.name)
        return found

    @cached_property
    def _used(self) -> list[Definition]:
        """The definitions that the potential energy needs, in their order."""
        assert self.model.short.P is not None
        wanted, found = names_in(self.model.short.P), []
        for definition in reversed(self.model.short.sums):
            if definition.name.name in wanted:
                found.append(definition)
                wanted |= names_in(definition.meaning)
        return found[::-1]

    def _slope(self, name: Symbol) -> Expr:
        return self.model.context.robot.ring.diff(self._values[name], self.k)

    @cached_property
    def _values(self) -> dict[Symbol, Expr]:
        """What the names are worth, exactly."""
        names = [definition.name for definition in self._used]
        trees = expanded(self.model.short.definitions, names)
        ring = self.model.context.robot.ring
        return {name: value_of(ring, node) for name, node in zip(names, trees, strict=True)}
