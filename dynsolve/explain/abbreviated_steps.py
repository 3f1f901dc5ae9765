"""The steps of a derivation in the names of `explain.abbreviations`.

Those of a long model are in `explain.long_model`; of a short one D, the Christoffel symbols, C and g
have names in them.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import replace

from dynsolve.document import Inline
from dynsolve.explain.abbreviations import Abbreviated
from dynsolve.explain.context import Context
from dynsolve.explain.entry_formulas import collected_coriolis_force
from dynsolve.explain.long_model.steps import of_long_model
from dynsolve.explain.named_steps import steps_in_names
from dynsolve.explain.step import Step
from dynsolve.notation import tree
from dynsolve.notation.tree import Node, Product, Relation, Sum, equation
from dynsolve.notation.walk import with_children
from dynsolve.quantities.stages import Stage


def in_names(steps: Iterable[Step], context: Context, short: Abbreviated) -> Iterator[Step]:
    """The steps, with names in them and, of a long model, without what fills pages."""
    if short.at_symbols:
        return steps_in_names(steps, context, short)
    return of_long_model(steps, context, short) if short.long else _of_short_model(steps, context, short)


def _of_short_model(steps: Iterable[Step], context: Context, short: Abbreviated) -> Iterator[Step]:
    forms, names = context.forms, context.robot.ring.names
    named: dict[Node, Node] = {
        **{forms.christoffel(*ijk): symbol for ijk, symbol in short.christoffel.items()},
        forms("D"): short.D,
        forms("C"): short.C,
        forms("g"): short.g,
        forms("Cqd"): tree.column(
            *(collected_coriolis_force(names, short.symbol, k) for k in range(context.robot.n))
        ),
    }
    for step in steps:
        if step.stage is Stage.VECTORIZED:
            step = replace(step, result=tuple(_exchanged(node, named) for node in step.result))
        in_letters = _IN_LETTERS.get(step.id)
        yield step if in_letters is None else in_letters(step)


def _rates_in_letters(step: Step) -> Step:
    """A step whose lines end in values: Ḋ by the derivatives of D alone, C q̇ by the symbols alone."""
    lines = (replace(line, formulas=tuple(map(_without_value, line.formulas))) for line in step.lines)
    return replace(step, lines=tuple(lines))


def _terms_in_letters(step: Step) -> Step:
    """The table of the terms of the forces, each by its name alone."""
    assert step.table is not None

    def cell(part: Inline) -> Inline:
        return _without_value(part) if isinstance(part, Node) else part

    rows = tuple(tuple(map(cell, row)) for row in step.table.rows)
    return replace(step, table=replace(step.table, rows=rows))


_IN_LETTERS: Mapping[str, Callable[[Step], Step]] = {
    "agreement": _rates_in_letters,
    "skew": _rates_in_letters,
    "terms": _terms_in_letters,
}
"""The steps whose values would not be in names, by their ids."""


def _without_value(node: Node) -> Node:
    """A chain of equations without its last member, which is the value written out."""
    if not isinstance(node, Relation):
        return node
    return node.parts[0] if len(node.parts) == 2 else equation(*node.parts[:-1])


def _exchanged(node: Node, named: Mapping[Node, Node]) -> Node:
    """A formula with parts exchanged for the same in names."""
    found = named.get(node)
    if found is not None:
        return found
    inside = isinstance(node, Relation | Sum | Product)
    return with_children(node, lambda part: _exchanged(part, named)) if inside else node
