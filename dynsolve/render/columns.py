"""Many short equations in columns: each as wide as it needs, as many on a line as fit.

The constants of a long model, and the entries of a matrix that is too wide for a page,
are lists of equations.  One under another they would leave most of a page empty.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import ceil

from dynsolve.render.typesetting import Line

FEWEST = 20
"""From this number of equations on they are set in columns."""

FEWEST_SHORT = 3
"""From this number of equations on that fit a column each."""

MOST_COLUMNS = 3
GAP = 1.2
"""The space between two columns, in em."""

_WIDEST_NAME = 4.0


@dataclass(frozen=True, slots=True)
class Cell:
    """A line of an equation that takes `span` columns."""

    line: Line
    span: int


@dataclass(frozen=True, slots=True)
class Columns:
    """Rows of cells in `count` columns of equal width; names stand right-aligned in `name` em.

    `indent` is how far the rows are moved in, as a part of the room: they stand in its middle.
    """

    count: int
    name: float
    rows: tuple[tuple[Cell, ...], ...]
    indent: float = 0.0

    @property
    def begins(self) -> list[bool]:
        """With which rows an equation begins."""
        return [any(cell.line.left for cell in row) for row in self.rows]

    def share(self, row: Sequence[Cell], place: int) -> float:
        """The part of the room that a cell of a row takes: the last column makes good what is moved in."""
        columns = sum(cell.span for cell in row[: place + 1])
        return row[place].span / self.count - (self.indent if columns == self.count else 0.0)


def in_columns(equations: Sequence[Sequence[Line]], room: float) -> Columns:
    """Equations, each one line or several, in the number of columns that takes the fewest rows.

    >>> short, long = [Line("a", "= b", width=3)], [Line("c", "= d + e", width=11)]
    >>> table = in_columns([short, short, short, long, short], 18)
    >>> table.count, [[cell.span for cell in row] for row in table.rows]
    (3, [[1, 1, 1], [3], [1]])
    """
    name = min(max((lines[0].name for lines in equations), default=0.0), _WIDEST_NAME)
    tables = [_table(equations, count, name, room) for count in range(1, MOST_COLUMNS + 1)]
    return min(tables, key=lambda table: (len(table.rows), table.count))


def _table(equations: Sequence[Sequence[Line]], count: int, name: float, room: float) -> Columns:
    rows: list[list[Cell]] = []
    free = 0
    for lines in equations:
        for line in lines:
            width = _width(line, name) + GAP
            span = count if len(lines) > 1 else min(ceil(width * count / room), count)
            if span > free:
                rows.append([])
                free = count
            rows[-1].append(Cell(line, span))
            free -= span
    return Columns(count, name, tuple(map(tuple, rows)), _indent(rows, count, name, room))


def _width(line: Line, name: float) -> float:
    """The width of a line whose name takes at least `name` em."""
    return line.width + max(name - line.name, 0.0)


def _indent(rows: Sequence[Sequence[Cell]], count: int, name: float, room: float) -> float:
    """Half of what the row that reaches furthest leaves free, as a part of the room."""
    furthest = max(
        (sum(cell.span for cell in row[:-1]) / count + _width(row[-1].line, name) / room for row in rows),
        default=1.0,
    )
    return min(max(1.0 - furthest, 0.0), 1.0 / count) / 2
