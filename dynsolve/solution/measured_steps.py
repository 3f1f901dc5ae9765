"""The steps of a model in numbers as they are printed: ≈ before what is rounded, units behind results.

A number that ends within the digits of the report is written whole, and = stands before it.  Any other is
rounded where it is printed, and ≈ stands between the members of an equation of which one is rounded.

A result that is a number alone has its unit behind it, and so has a matrix whose entries are all measured
in one.  A formula of several factors or terms has none: the unit is that of its left side in the list of
notation, which says so.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace
from typing import Any

from dynsolve.explain.step import Step
from dynsolve.explain.writing import measured
from dynsolve.notation.printing import Style
from dynsolve.notation.tree import ZERO, Matrix, Node, Number, Relation, Row, Transpose, Words
from dynsolve.notation.unicode import UnicodePrinter, width
from dynsolve.notation.walk import walk, with_children
from dynsolve.quantities import letters
from dynsolve.quantities.index import quantities
from dynsolve.robot import units
from dynsolve.robot.model import Robot
from dynsolve.solution.numbers import measures

_PARTS_OF_D = ("D_direct", "Dw")
"""What the ids of the steps begin with that give parts of D, which have no letters of their own."""

_WIDEST = 50
"""The characters up to which a row of a matrix leaves room for its unit."""


def measured_steps(steps: Iterable[Step], robot: Robot, style: Style) -> Iterator[Step]:
    """The steps as they are; in a report with decimals, with ≈ and units."""
    if not style.digits:
        yield from steps
        return
    known = _units(robot)
    for step in steps:
        yield _step(_with_units(step, known, style), style)


def marked(node: Node, style: Style) -> Node:
    """A formula with ≈ for = where a number on either side is rounded.

    >>> from dynsolve.notation.tree import Symbol, equation
    >>> from dynsolve.notation.unicode import to_unicode
    >>> style = Style(decimal=True, digits=6)
    >>> to_unicode(marked(equation(Symbol("I"), Number(5, 96)), style), style)
    'I ≈ 0.0520833'
    >>> to_unicode(marked(equation(Symbol("I"), Number(5, 32)), style), style)
    'I = 0.15625'
    """
    if not isinstance(node, Relation):
        return with_children(node, lambda part: marked(part, style)) if isinstance(node, Row) else node
    is_rounded = [_is_rounded(part, style) for part in node.parts]
    signs = (
        "≈" if sign == "=" and (is_rounded[k] or is_rounded[k + 1]) else sign
        for k, sign in enumerate(node.signs)
    )
    return replace(node, signs=tuple(signs))


def _is_rounded(node: Node, style: Style) -> bool:
    return any(isinstance(part, Number) and style.rounds(part) for part in walk(node))


def _step(step: Step, style: Style) -> Step:
    """A step with all its formulas marked."""

    def all_of(parts: Iterable[Any]) -> tuple[Any, ...]:
        return tuple(marked(part, style) if isinstance(part, Node) else part for part in parts)

    table = step.table
    return replace(
        step,
        why=all_of(step.why),
        further=all_of(step.further),
        working=all_of(step.working),
        lines=tuple(replace(line, by=all_of(line.by), formulas=all_of(line.formulas)) for line in step.lines),
        concluding=all_of(step.concluding),
        result=all_of(step.result),
        notes=tuple(map(all_of, step.notes)),
        table=None if table is None else replace(table, rows=tuple(map(all_of, table.rows))),
    )


def _units(robot: Robot) -> dict[Node, str]:
    """The one unit of all entries of each letter that has one."""
    length, count = units.si(units.LENGTH), len(robot.joints)
    found: dict[Node, str] = {letters.o(i): length for i in range(count + 1)}
    for i in range(1, count + 1):
        _, d, a, _ = letters.columns(robot, Number(i))
        found |= {d: length, a: length}
    found[letters.GRAVITY] = units.si(units.ACCELERATION)
    for name, quantity in quantities(robot).items():
        unit = measures.of_result(robot, name)
        several = {unit} if isinstance(unit, str) else {each for row in unit for each in row}
        if len(several) == 1 and quantity.family.has_letter:
            found[quantity.letter(robot)] = several.pop()
    places = range(1, robot.n + 1)
    if letters.D in found:  # its entries are listed where they are summed up
        found |= {letters.entry("d", i, j): found[letters.D] for i in places for j in places}
    if letters.C in found:
        found[letters.bold("N")] = found[letters.C]
    return found


def _with_units(step: Step, known: Mapping[Node, str], style: Style) -> Step:
    """The step with units behind what goes in and what comes out: numbers, and matrices in one unit."""
    of_parts = known.get(letters.D, "") if step.id.startswith(_PARTS_OF_D) else ""
    of_center = units.si(units.LENGTH) if step.id.startswith("rc") else ""  # as it is given, in its link

    def measure(nodes: Iterable[Node], otherwise: str = "") -> tuple[Node, ...]:
        return tuple(_measured(node, known, otherwise, style) for node in nodes)

    return replace(
        step,
        further=measure(step.further, of_center),
        working=measure(step.working),
        result=measure(step.result, of_parts),
    )


def _measured(node: Node, known: Mapping[Node, str], otherwise: str, style: Style) -> Node:
    """An equation with the unit of its left side behind its right side; each of several side by side."""
    if isinstance(node, Row):
        return replace(node, parts=tuple(_measured(part, known, otherwise, style) for part in node.parts))
    if not isinstance(node, Relation):
        return node
    unit, (*before, value) = known.get(node.parts[0], otherwise), node.parts
    if not unit:
        return node
    matrix = value.argument if isinstance(value, Transpose) else value
    if not isinstance(matrix, Matrix):
        return replace(node, parts=(*before, measured(value, unit)))
    write = UnicodePrinter(style).text
    is_zero = all(entry == ZERO for row in matrix.rows for entry in row)
    if is_zero or any(sum(width(write(entry)) + 2 for entry in row) > _WIDEST for row in matrix.rows):
        return node
    return replace(node, parts=(*before, Row((value, Words(" "), units.node(unit)))))
