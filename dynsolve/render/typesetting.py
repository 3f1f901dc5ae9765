"""Displayed formulas set to a width in em, in any notation: lines that are level at one place.

A formula that fits stands on one line.  Otherwise each member of a chain of equations
has its own lines, which begin with its sign, and a matrix that is too wide is given entry by
entry.  A line that goes on with a member is moved in, and further where it begins in parentheses.

Many short equations in columns: each as wide as it needs, as many on a line as fit.

The constants of a long model, and the entries of a matrix that is too wide for a page,
are lists of equations.  One under another they would leave most of a page empty.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from math import ceil

from msgspec import Struct
from msgspec.structs import replace

from dynsolve.document import Formula
from dynsolve.notation.extent import RELATION, Ruler
from dynsolve.notation.tree import Matrix, Node, Relation, Row, Words, equation
from dynsolve.render.line_breaking import FACTOR_BREAK, FormulaSplitter, Notation, Piece, lines
from dynsolve.render.terminal_boxes import entry_equations, holds_matrix

INDENT = 2.0
"""How far a line is moved in that goes on with a member, in em."""

INSIDE = INDENT
"""How much further for each pair of parentheses that it begins in."""

_LONGEST_NAME = 6.0
"""After a member that is no wider, as d_12 = d_21, the next one may stand on its line, in em."""

_LONGEST_LEFT = 0.3
"""The part of the room that a left side may take beside which the members of a chain stand."""

_WIDEST_LEVEL = 0.5
"""The same where equations are level with each other."""


class Line(Struct, frozen=True):
    """`left` stands right-aligned before the place where lines are level, `right` after it.

    `indent` is how far `right` is moved in, `width` that of both together, `name` that of `left`, all in em.
    """

    left: str
    right: str
    indent: float = 0.0
    width: float = 0.0
    name: float = 0.0

    @property
    def alone(self) -> str:
        """The text of a line that is level with no other."""
        return f"{self.left} {self.right}".strip()


class Typesetter:
    """Sets formulas in `room` em."""

    def __init__(self, notation: Notation, ruler: Ruler, room: float) -> None:
        self.notation = notation
        self.ruler = ruler
        self.room = room
        self.splitter = FormulaSplitter(notation, ruler)

    def set(self, formula: Formula) -> list[Line]:
        """The lines of a formula; none where it is optional and its matrices do not fit."""
        if self.ruler.width(formula.node) <= self.room:
            return [Line("", self.notation.text(formula.node))]
        found = fitting(formula, self._fits)
        return [] if found is None else list(self._parts(found.node, found))

    def _fits(self, node: Node) -> bool:
        """Whether no matrix is too wide."""
        widest = max(piece.width for piece in self.splitter.pieces(node))
        return not holds_matrix(node) or widest <= self.room - INDENT

    def _parts(self, node: Node, formula: Formula) -> Iterator[Line]:
        """Formulas that stand side by side with commas: as many on a line as fit, a wide one on its own."""
        beside = list(listed(node)) if isinstance(node, Row) else []
        if len(beside) > 1 and any(self.ruler.width(part) > self.room for part in beside):
            for part in beside:
                yield from self._parts(part, formula)
        elif isinstance(node, Relation) and self.ruler.width(node) > self.room:
            yield from self._chain(node, formula)
        elif isinstance(node, Matrix) and self.ruler.width(node) > self.room:
            yield from self._entries(node, None, formula)
        else:
            rest = self.room if isinstance(node, Row) else self.room - INDENT
            yield from self._broken(self.splitter.pieces(node), self.room, rest)

    def _chain(self, node: Relation, formula: Formula) -> Iterator[Line]:
        left, *members = node.parts
        width = self.ruler.width(left)
        beside = width <= _LONGEST_LEFT * self.room
        if not beside:
            before = self.splitter.pieces(left)
            last = self.splitter.pieces(members[0], node.signs[0])
            if len(members) == len(last) == 1:  # τ goes on from g, where it has room there
                after = replace(last[0], depth=before[-1].depth)
                yield from self._broken([*before, after], self.room, self.room - INDENT)
                return
            yield from self._broken(before, self.room, self.room - INDENT)
        room = self.room - (width if beside else INDENT)
        name = self.notation.text(left) if beside else ""
        waiting: list[list[Piece]] = []
        for sign, member in zip(node.signs, members, strict=True):
            if isinstance(member, Matrix) and self.ruler.width(member) + RELATION > room:
                yield from self._members(name, waiting, room, beside)
                name, waiting = "" if waiting else name, []
                yield from self._entries(member, left, formula)
            else:
                waiting.append(self.splitter.pieces(member, sign))
        yield from self._members(name, waiting, room, beside)

    def _members(
        self, name: str, members: Sequence[list[Piece]], room: float, beside: bool
    ) -> Iterator[Line]:
        """Members of a chain: on one line where all fit, else each on its own lines."""
        base = 0.0 if beside else INDENT
        for member in _on_own_lines(members, room):
            for i, line in enumerate(lines(member, room, room - INDENT, INSIDE)):
                yield Line(name, self._text(line, i), base + _indent(line, i))
                name = ""

    def _broken(self, pieces: Sequence[Piece], first: float, rest: float) -> Iterator[Line]:
        for i, line in enumerate(lines(pieces, first, rest, INSIDE)):
            yield Line("", self._text(line, i), _indent(line, i) if rest < first else 0.0)

    def _text(self, line: Sequence[Piece], place: int) -> str:
        """The text of a line, which is not the first of its formula where its place is not 0."""
        sign = [line[0].sign] if place and line[0].sign else []
        return self.notation.joined([*sign, *(piece.text for piece in line)])

    # -- matrices that are given entry by entry ----------------------------------------------------

    def listed(self, formula: Formula) -> list[list[Line]] | None:
        """The lines of each entry, of a formula that is no more than a matrix, and that too wide."""
        node = formula.node
        if formula.optional or not isinstance(node, Relation) or len(node.parts) != 2:
            return None
        left, matrix = node.parts
        if not isinstance(matrix, Matrix) or self.ruler.width(node) <= self.room:
            return None
        return list(self._each_entry(matrix, left, formula))

    def each(self, nodes: Sequence[Node]) -> list[list[Line]]:
        """The lines of each of several equations."""
        return [list(self._level(_chained(node))) for node in nodes]

    def _entries(self, matrix: Matrix, left: Node | None, formula: Formula) -> Iterator[Line]:
        for lines_ in self._each_entry(matrix, left, formula):
            yield from lines_

    def _each_entry(self, matrix: Matrix, left: Node | None, formula: Formula) -> Iterator[list[Line]]:
        """`d_12 = ...` for each entry; equal ones in one chain, those that are 0 last."""
        for chain in entry_equations(matrix, left, formula, self.ruler.style):
            yield list(self._level(chain))

    def equations(self, nodes: Sequence[Node]) -> list[Line]:
        """The lines of equations without matrices, level at their first equals sign."""
        return [line for node in nodes for line in self._level(_chained(node))]

    def _level(self, chain: Relation) -> Iterator[Line]:
        """The lines of a = b ≈ ..., level after a, where that leaves room for b."""
        name, *rest = chain.parts
        width = self.ruler.width(name)
        room = self.room - width
        if rest and width > _WIDEST_LEVEL * self.room:
            yield from self._chain(chain, Formula(chain))
            return
        if not rest:
            yield Line("", self.notation.text(name), width=width)
        before = self.notation.text(name)
        members = [self.splitter.pieces(part, sign) for sign, part in zip(chain.signs, rest, strict=True)]
        for member in _on_own_lines(members, room):
            for i, line in enumerate(lines(member, room, room - INDENT, INSIDE)):
                indent = _indent(line, i)
                yield Line(before, self._text(line, i), indent, width + indent + _width(line), width)
                before = ""


def _width(pieces: Iterable[Piece]) -> float:
    return sum(piece.width for piece in pieces)


def _indent(line: Sequence[Piece], place: int) -> float:
    """How far a line of a member is moved in; it is the first at place 0."""
    return INDENT + INSIDE * line[0].level if place else 0.0


def _on_own_lines(members: Sequence[list[Piece]], room: float) -> list[list[Piece]]:
    """The members of a chain, together where they fit one line; else apart, but names together.

    A single name is hardly parted from the member after it.
    """
    if _width(piece for member in members for piece in member) <= room:
        return [[piece for member in members for piece in member]] if members else []
    apart: list[list[Piece]] = []
    for member in members:
        before = apart[-1] if apart else []
        names = bool(before) and all(piece.width <= _LONGEST_NAME for piece in before)
        together = len(member) == 1 and member[0].width <= _LONGEST_NAME
        if names and (len(before) == 1 or (together and _width([*before, *member]) <= room)):
            first = member[0] if together else replace(member[0], depth=FACTOR_BREAK)
            apart[-1] = [*before, first, *member[1:]]
        else:
            apart.append(member)
    return apart


def _chained(node: Node) -> Relation:
    """A chain of equations; a formula that is none is a chain of one."""
    return node if isinstance(node, Relation) else Relation((node,), ())


def fitting(formula: Formula, fits: Callable[[Node], bool]) -> Formula | None:
    """A formula without the members of a chain of which a matrix does not fit; None where it is left out.

    A matrix that is a member stays, to be listed entry by entry, but not in an optional formula.
    """
    node = formula.node
    if fits(node):
        return formula
    if isinstance(node, Relation) and set(node.signs) == {"="}:
        left, *members = node.parts
        is_listed = not formula.optional
        kept = [part for part in members if fits(part) or (is_listed and isinstance(part, Matrix))]
        if kept == members:
            return formula
        if kept:
            return replace(formula, node=equation(left, *kept))
    return None if formula.optional else formula


def listed(row: Row) -> Iterator[Node]:
    """The parts of a row between its commas."""
    part: list[Node] = []
    for node in row.parts:
        if isinstance(node, Words) and node.text.strip() == ",":
            yield part[0] if len(part) == 1 else Row(tuple(part))
            part = []
        else:
            part.append(node)
    if part:
        yield part[0] if len(part) == 1 else Row(tuple(part))


# Many short equations in columns: each as wide as it needs, as many on a line as fit

FEWEST = 20
"""From this number of equations on they are set in columns."""

FEWEST_SHORT = 3
"""From this number of equations on that fit a column each."""

MOST_COLUMNS = 3
GAP = 1.2
"""The space between two columns, in em."""

_WIDEST_NAME = 4.0


class Cell(Struct, frozen=True):
    """A line of an equation that takes `span` columns."""

    line: Line
    span: int


class Columns(Struct, frozen=True):
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
    for rows_of in equations:
        for line in rows_of:
            width = _columns_width(line, name) + GAP
            span = count if len(rows_of) > 1 else min(ceil(width * count / room), count)
            if span > free:
                rows.append([])
                free = count
            rows[-1].append(Cell(line, span))
            free -= span
    return Columns(count, name, tuple(map(tuple, rows)), _columns_indent(rows, count, name, room))


def _columns_width(line: Line, name: float) -> float:
    """The width of a line whose name takes at least `name` em."""
    return line.width + max(name - line.name, 0.0)


def _columns_indent(rows: Sequence[Sequence[Cell]], count: int, name: float, room: float) -> float:
    """Half of what the row that reaches furthest leaves free, as a part of the room."""
    before = (sum(cell.span for cell in row[:-1]) / count for row in rows)
    ends = (
        start + _columns_width(row[-1].line, name) / room for start, row in zip(before, rows, strict=True)
    )
    return min(max(1.0 - max(ends, default=1.0), 0.0), 1.0 / count) / 2
