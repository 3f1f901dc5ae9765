"""One Christoffel symbol and one gravity term in full: the derivatives of what stands in names."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

from dynsolve.algebra.expr import Expr
from dynsolve.algebra.ring_values import value_of
from dynsolve.document import Prose
from dynsolve.document.sentences import say
from dynsolve.explain.christoffel import in_slopes
from dynsolve.explain.forms import pairs
from dynsolve.explain.long_model.model import LongModel
from dynsolve.explain.recurring import Definition, expanded, expanded_once, rewritten
from dynsolve.explain.step import Line
from dynsolve.explain.working.differentiation import by_symbol, differentiated
from dynsolve.explain.working.identities import doubled_angles
from dynsolve.explain.writing import listed
from dynsolve.notation.build import negated, times
from dynsolve.notation.tree import (
    ZERO,
    Derivative,
    Function,
    Negative,
    Node,
    Number,
    Parenthesized,
    Product,
    Relation,
    Slashed,
    Sum,
    Symbol,
    equation,
)
from dynsolve.notation.walk import names_in, walk, with_children
from dynsolve.quantities import letters

MOST_SLOPES = 3
"""The derivatives of names that an example takes at most, by one coordinate."""


def christoffel_example(model: LongModel, row: int, column: int) -> tuple[Line, ...]:
    """The symbol in which d_jk, of `row` and `column` from 0, is differentiated by the last that it can be.

    It is c_kkj where that coordinate is k itself, else the symbol of row k.
    """
    varying = model.varying(model.context.values["D"][row, column])
    if not varying:
        return ()
    by = varying[-1]
    i, j, k = (column, column, row) if by == column else (min(row, by), max(row, by), column)
    form = model.short.symbol(i, j, k)
    if form == ZERO:
        return ()
    slopes = Sum((_slope(model, k, j, i), _slope(model, k, i, j), Negative(_slope(model, i, j, k))))
    by_entries = in_slopes(model.context, i, j, k)
    name = letters.entry("c", i + 1, j + 1, k + 1)
    first = equation(name, *dict.fromkeys((Product((letters.HALF, Parenthesized(slopes))), by_entries)))
    once = expanded_once(model.short.sums, form)
    names, entries = _entries_differentiated(model, by_entries, once)
    if not names:
        return (Line(("For example:",), (equation(*dict.fromkeys((*first.parts, once, form))),)),)
    put_in = _put_in(by_entries, {each.parts[0]: each.parts[-1] for each in entries})
    shown = {each.parts[0] for each in names}
    others = tuple(
        equation(Slashed(slope), form) for slope, form in slopes_that_are_names(model) if slope not in shown
    )
    again = "Other derivatives of names, found in the same way, that are names again:"
    return (
        Line(("For example:",), (first,)),
        Line(("The names are differentiated as they were defined", *_with_doubled(model, names), ":"), names),
        Line(("With these:",), entries),
        Line(("Put in:",), (equation(*dict.fromkeys((name, put_in, once, form))),)),
        *([Line((again,), others, in_columns=True)] if others else []),
    )


def _with_doubled(model: LongModel, slopes: Sequence[Relation]) -> Prose:
    """The identities by which derivatives of names are names that have sines or cosines of twice an angle."""
    meanings = {one.name: one.meaning for one in model.short.sums}
    found: dict[Relation, None] = {}
    for relation in slopes:
        named = [meanings[node] for node in walk(relation.parts[-1]) if node in meanings]
        found |= dict.fromkeys(doubled_angles(*named))
        for known in doubled_angles(*relation.parts):
            found.pop(known, None)
    return (", with ", *listed(list(found))) if found else ()


def _entries_differentiated(
    model: LongModel, slopes: Node, result: Node
) -> tuple[tuple[Relation, ...], tuple[Relation, ...]]:
    """The derivatives of the names in some entries of D, and of these entries; none where there are too many.

    Which entries, and by which coordinates, is what stands in `slopes`.
    """
    names: dict[Relation, None] = {}
    entries = []
    for slope in dict.fromkeys(part for part in walk(slopes) if isinstance(part, Derivative)):
        row, column, by = next(
            (row, column, by)
            for by in range(model.n)
            for row, column in pairs(model.n)
            if _slope(model, row, column, by) == slope
        )
        form = model.short.D.rows[row][column]
        found = NameSlopes(model, by, form, result)
        if len(found.shown) > MOST_SLOPES:
            return (), ()
        names |= dict.fromkeys(found.shown.values())
        entries.append(equation(*dict.fromkeys((slope, found.by_the_chain_rule(form), found.value(form)))))
    return tuple(names), tuple(entries)


def _put_in(node: Node, values: Mapping[Node, Node]) -> Node:
    """½ (Σ ±∂d/∂q) with values for the derivatives."""
    match node:
        case Negative(argument):
            return negated(_put_in(argument, values))
        case Product() | Parenthesized():
            return with_children(node, lambda part: _put_in(part, values))
    return _with_values(node, values)


def _with_values(node: Node, values: Mapping[Node, Node]) -> Node:
    return rewritten(node, lambda leaf: values.get(leaf, leaf))


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
        slopes = NameSlopes(model, k, model.short.P)
        if form == ZERO or not 1 <= len(slopes.shown) <= MOST_SLOPES:
            continue
        members = dict.fromkeys((slopes.of(letters.P), slopes.by_the_chain_rule(model.short.P), form))
        term = equation(letters.entry("g", k + 1), *members)
        one = len(slopes.shown) == 1
        why = say(
            "For one entry in full, the {names} on {q} {are} differentiated as {they} defined:",
            names="name that depends" if one else "names that depend",
            q=slopes.coordinate,
            are="is" if one else "are",
            they="it was" if one else "they were",
        )
        return Line(why, tuple(slopes.shown.values())), Line(("Put in:",), (term,))
    return ()


# -- the derivatives of the names in a formula by one coordinate -----------------------------------
# A name is differentiated as it was defined, term by term; what comes out is often a name again.

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
        return _with_values(self.by_the_chain_rule(node), self._values_of_names)

    @cached_property
    def _values_of_names(self) -> dict[Node, Node]:
        """What the derivatives of the names are: a name, a multiple of one, or else their terms."""
        found: dict[Node, Node] = {}
        for definition in self._used:
            slope = self._slope(definition.name)
            if not slope.is_zero:
                found[self.of(definition.name)] = self._as_a_name(slope) or _with_values(
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

    def single(part: Node) -> Node:
        match part:
            case Function("sin", Product((Number(2, 1), angle))):
                return Product((Number(2), Function("sin", angle), Function("cos", angle)))
        return part

    return rewritten(node, single)
