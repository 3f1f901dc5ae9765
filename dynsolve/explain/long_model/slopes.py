"""One Christoffel symbol and one gravity term in full: the derivatives of what stands in names."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from dynsolve.document import Prose
from dynsolve.explain.christoffel import in_slopes
from dynsolve.explain.entry_formulas import pairs
from dynsolve.explain.long_model.model import LongModel
from dynsolve.explain.long_model.name_slopes import NameSlopes, slopes_that_are_names
from dynsolve.explain.recurring import expanded_once
from dynsolve.explain.step import Line
from dynsolve.explain.working.identities import doubled_angles
from dynsolve.explain.writing import listed
from dynsolve.notation.build import negated, total
from dynsolve.notation.tree import (
    ZERO,
    Derivative,
    Negative,
    Node,
    Parenthesized,
    Product,
    Relation,
    Slashed,
    Sum,
    Symbol,
    equation,
)
from dynsolve.notation.walk import walk
from dynsolve.quantities import letters

MOST_SLOPES = 3
"""The derivatives of names that an example takes at most, by one coordinate."""


def christoffel_example(model: LongModel, row: int, column: int) -> tuple[Line, ...]:
    """The symbol in which d_jk, of `row` and `column` from 0, is differentiated by the last that it can be.

    It is c_kkj where that coordinate is k itself, else the symbol of row k.
    """
    ring, entry = model.context.robot.ring, model.context.values["D"][row, column]
    varying = [k for k in range(model.n) if not ring.diff(entry, k).is_zero]
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
        case Derivative():
            return values[node]
        case Parenthesized(argument):
            return Parenthesized(_put_in(argument, values))
        case Sum(terms):
            return total([_put_in(term, values) for term in terms])
        case Negative(argument):
            return negated(_put_in(argument, values))
        case Product(factors):
            return Product(tuple(_put_in(factor, values) for factor in factors))
    return node


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
        slopes = NameSlopes(model, k, model.short.P)
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
