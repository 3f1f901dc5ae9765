"""The steps of a model in numbers as they are printed: ≈ before what is rounded, units behind matrices.

A number that ends within the digits of the report is written whole, and = stands before it.  Any other is
rounded where it is printed, and ≈ stands between the members of an equation of which one is rounded.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import replace

from dynsolve.document import Inline
from dynsolve.explain.step import Step
from dynsolve.notation.printing import Style
from dynsolve.notation.tree import Matrix, Node, Number, Relation, Row, Words
from dynsolve.notation.unicode import UnicodePrinter, width
from dynsolve.notation.walk import walk, with_children
from dynsolve.quantities import families
from dynsolve.quantities.index import quantities
from dynsolve.robot import units
from dynsolve.robot.model import Robot
from dynsolve.solution.numbers import measures

_WITH_UNIT = (families.I_BODY, families.D, families.G)
"""The results whose matrices have their unit behind them."""

_WIDEST = 50
"""The characters up to which a row of a matrix leaves room for its unit."""


def measured_steps(steps: Iterable[Step], robot: Robot, style: Style) -> Iterator[Step]:
    """The steps as they are; in a report with decimals, with ≈ and units."""
    if not style.digits:
        yield from steps
        return
    for step in steps:
        yield _step(_with_unit(step, robot, style), style)


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

    def inline(part: Inline) -> Inline:
        return marked(part, style) if isinstance(part, Node) else part

    def formulas(nodes: Iterable[Node]) -> tuple[Node, ...]:
        return tuple(marked(node, style) for node in nodes)

    table = step.table
    if table is not None:
        table = replace(table, rows=tuple(tuple(map(inline, row)) for row in table.rows))
    return replace(
        step,
        why=tuple(map(inline, step.why)),
        working=formulas(step.working),
        lines=tuple(
            replace(line, by=tuple(map(inline, line.by)), formulas=formulas(line.formulas))
            for line in step.lines
        ),
        result=formulas(step.result),
        notes=tuple(tuple(map(inline, note)) for note in step.notes),
        table=table,
    )


def _with_unit(step: Step, robot: Robot, style: Style) -> Step:
    """The unit behind a matrix in numbers whose entries are all measured in it, where it fits."""
    quantity = quantities(robot).of_rule(step.id)
    if quantity is None or quantity.family not in _WITH_UNIT or len(step.result) != 1:
        return step
    found = measures.of_result(robot, step.id)
    several = {found} if isinstance(found, str) else {unit for row in found for unit in row}
    match step.result[0]:
        case Relation((*before, Matrix() as matrix)) if len(several) == 1 and _leaves_room(matrix, style):
            result = Row((matrix, Words(" "), units.node(several.pop())))
            return replace(step, result=(Relation((*before, result)),))
    return step


def _leaves_room(matrix: Matrix, style: Style) -> bool:
    printer = UnicodePrinter(style)
    return all(sum(width(printer.text(entry)) + 2 for entry in row) <= _WIDEST for row in matrix.rows)
