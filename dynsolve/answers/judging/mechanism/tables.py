"""A Denavit-Hartenberg table as it is written: its cells as trees, its joint variables, its numbers.

In a student's table a coordinate is a joint variable with or without its star, and a bare number
stands for degrees where an angle belongs, unless it is one in radians.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from math import pi

from dynsolve.algebra.rationals import rational_value
from dynsolve.answers.judging.mechanism.chains import NumberRow
from dynsolve.notation.build import total
from dynsolve.notation.tree import ZERO, Degrees, Negative, Node, Number, Parenthesized, Sum, Symbol
from dynsolve.notation.tree_values import evaluate
from dynsolve.notation.walk import mapped, names_in
from dynsolve.problem.linear import NotLinear, linear_rates
from dynsolve.robot.model import Coordinate, JointType, Robot

COLUMNS = ("theta", "d", "a", "alpha")
ANGLES = (0, 3)
LETTERS = ("θ", "d", "a", "α")
_AS_RADIANS = 0.01
"""So near to a multiple of 15° in radians a bare number stands for that."""


class TableError(Exception):
    """A table that describes no chain of joints; `row` and `column` (from 1) say where, 0 where nowhere."""

    def __init__(self, message: str, row: int = 0, column: int = 0) -> None:
        super().__init__(message)
        self.message, self.row, self.column = message, row, column


@dataclass(frozen=True, slots=True)
class TableRow:
    """A row of a table: the constant parts of θ, d, a, α as trees.

    `variable` is the place of the column that holds the joint variable (0 for θ, 1 for d), None for a
    fixed frame; `rates` are (index of the coordinate from 0, rate).
    """

    constants: tuple[Node, ...]
    variable: int | None = None
    rates: tuple[tuple[int, Fraction], ...] = ()

    def changed(self, column: int, constant: Node) -> TableRow:
        """The row with another constant part in a column (from 0)."""
        constants = list(self.constants)
        constants[column] = constant
        return replace(self, constants=tuple(constants))

    def numbers(self, values: Mapping[str, float]) -> NumberRow:
        """The row at values of the letters."""
        theta, d, a, alpha = (float(evaluate(cell, values)) for cell in self.constants)
        variable = None if self.variable is None else COLUMNS[self.variable]
        return NumberRow(theta, d, a, alpha, variable, tuple((k, float(rate)) for k, rate in self.rates))


Table = tuple[TableRow, ...]


def key_table(robot: Robot) -> Table:
    """The robot's own table."""
    names = [q.name for q in robot.coordinates]
    return tuple(
        TableRow(
            tuple(_without(cell, names) for cell in joint.written),
            None if joint.variable is None else COLUMNS.index(joint.variable),
            joint.rates,
        )
        for joint in robot.joints
    )


def read_table(rows: Sequence[Sequence[Node]], coordinates: Sequence[Coordinate]) -> Table:
    """The table of an answer.

    Raises TableError for a row that has not four columns, for a joint variable where none can be.
    """
    numbered = [Number(i) for i in range(1, len(rows) + 1)]
    if all(len(row) == 5 for row in rows) and [row[0] for row in rows] == numbered:
        rows = [row[1:] for row in rows]
    return tuple(_read_row(i, row, coordinates) for i, row in enumerate(rows, 1))


def _read_row(index: int, cells: Sequence[Node], coordinates: Sequence[Coordinate]) -> TableRow:
    if len(cells) != len(COLUMNS):
        raise TableError(f"row {index} has {len(cells)} columns; they are θ, d, a, α", index)
    names = [q.name for q in coordinates]
    moving = [column for column, cell in enumerate(cells) if names_in(cell) & set(names)]
    for column in moving:
        _check_place(index, column, cells[column], coordinates)
    if len(moving) > 1:
        raise TableError(f"row {index} has a joint variable in θ and in d: these are two joints", index, 2)
    constants = [_constant(i, cell, names) for i, cell in enumerate(cells)]
    if not moving:
        return TableRow(tuple(constants))
    (column,) = moving
    try:
        rates = linear_rates(cells[column], names)
    except NotLinear as error:
        raise TableError(f"row {index}, {LETTERS[column]}: {error.message}", index, column + 1) from error
    order = tuple(sorted((names.index(name), rate) for name, rate in rates.items()))
    return TableRow(tuple(constants), column, order)


def _check_place(index: int, column: int, cell: Node, coordinates: Sequence[Coordinate]) -> None:
    """Raise TableError for an angle in a column of lengths, or the other way round, or a constant column."""
    for q in coordinates:
        if q.name not in names_in(cell):
            continue
        turns = q.type is JointType.REVOLUTE
        if column != (0 if turns else 1):
            what = "turns, and belongs to θ" if turns else "slides, and belongs to d"
            raise TableError(
                f"row {index}: {q.name} {what}; here it stands in {LETTERS[column]}", index, column + 1
            )


def _constant(column: int, cell: Node, names: Sequence[str]) -> Node:
    constant = _without(cell, names)
    if column not in ANGLES:
        return constant
    terms = constant.terms if isinstance(constant, Sum) else (constant,)
    return total([_angle(term) for term in terms])


def _angle(term: Node) -> Node:
    """A term of an angle; a bare number counts degrees, or is a multiple of 15° in radians."""
    value = rational_value(term)
    if not value:
        return term
    steps = float(value) * 12 / pi
    if abs(value) < 10 and steps and abs(steps - round(steps)) < _AS_RADIANS * 12 / pi and round(steps):
        value = Fraction(15 * round(steps))
    degrees = Degrees(abs(value).numerator, value.denominator)
    return Negative(degrees) if value < 0 else degrees


def _without(cell: Node, names: Sequence[str]) -> Node:
    """A cell without its joint variable: the variable 0 where it is, and no term of 0 left."""
    found = mapped(cell, lambda node: ZERO if isinstance(node, Symbol) and node.name in names else node)
    while isinstance(found, Parenthesized):
        found = found.argument
    terms = found.terms if isinstance(found, Sum) else (found,)
    kept = [term for term in terms if rational_value(term) != 0]
    return total(kept) if kept else Number(0)
