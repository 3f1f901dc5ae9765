"""Displayed formulas set to a width in em, in any notation: lines that are level at one place.

A formula that fits stands on one line.  Otherwise each member of a chain of equations
has its own lines, and a matrix that is too wide is given entry by entry.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from dynsolve.document import Formula
from dynsolve.notation.extent import RELATION, Ruler
from dynsolve.notation.tree import Matrix, Node, Relation, Row, Words, equation
from dynsolve.render.line_breaking import RELATION_BREAK, FormulaSplitter, Notation, Piece, lines
from dynsolve.render.matrices import entries_by_value, entry_name, holds_matrix

INDENT = 2.0
"""How far a line is moved in that goes on with a member, in em."""

_LONGEST_LEFT = 0.3


@dataclass(frozen=True, slots=True)
class Line:
    """`left` stands right-aligned before the place where lines are level, `right` after it.

    `width` is that of both together in em, `name` that of `left`.
    """

    left: str
    right: str
    indented: bool = False
    width: float = 0.0
    name: float = 0.0

    @property
    def alone(self) -> str:
        """The text of a line that is level with no other."""
        return f"{self.left} {self.right}".strip()

    def aligned(self, indent: str) -> str:
        """The text with `&` at the place where lines are level, and an indent where it goes on."""
        return f"{self.left} & {indent if self.indented else ''}{self.right}"


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
        if formula.optional and self._is_too_wide(formula.node):
            return []
        return list(self._parts(formula.node, formula))

    def _is_too_wide(self, node: Node) -> bool:
        """Whether a part that cannot be broken is wider than the page."""
        return holds_matrix(node) and any(
            piece.width > self.room - INDENT for piece in self.splitter.pieces(node)
        )

    def _parts(self, node: Node, formula: Formula) -> Iterator[Line]:
        """Formulas that stand side by side with commas: as many on a line as fit, a wide one on its own."""
        if isinstance(node, Row) and not all(self._fits(part) for part in listed(node)):
            for part in listed(node):
                yield from self._parts(part, formula)
        elif isinstance(node, Relation) and self.ruler.width(node) > self.room:
            yield from self._chain(node, formula)
        elif isinstance(node, Matrix) and self.ruler.width(node) > self.room:
            yield from self._entries(node, None, formula)
        else:
            rest = self.room if isinstance(node, Row) else self.room - INDENT
            yield from self._broken(self.splitter.pieces(node), self.room, rest)

    def _fits(self, node: Node) -> bool:
        return self.ruler.width(node) <= self.room

    def _chain(self, node: Relation, formula: Formula) -> Iterator[Line]:
        left, *members = node.parts
        width = self.ruler.width(left)
        beside = width <= _LONGEST_LEFT * self.room
        if not beside:
            yield from self._broken(self.splitter.pieces(left), self.room, self.room - INDENT)
        room = self.room - (width if beside else INDENT)
        name = self.notation.text(left) if beside else ""
        waiting: list[Piece] = []
        for sign, member in zip(node.signs, members, strict=True):
            if isinstance(member, Matrix) and self.ruler.width(member) + RELATION > room:
                yield from self._members(name, waiting, room, beside)
                name, waiting = "" if waiting else name, []
                yield from self._entries(member, left, formula)
            else:
                waiting += self.splitter.pieces(member, sign)
        yield from self._members(name, waiting, room, beside)

    def _members(self, name: str, pieces: Sequence[Piece], room: float, beside: bool) -> Iterator[Line]:
        """Members of a chain, broken at their signs where that is possible."""
        for i, line in enumerate(lines(pieces, room, room - INDENT)):
            yield Line("" if i else name, self._text(line), not beside or line[0].depth > RELATION_BREAK)

    def _broken(self, pieces: Sequence[Piece], first: float, rest: float) -> Iterator[Line]:
        for i, line in enumerate(lines(pieces, first, rest)):
            yield Line("", self._text(line), i > 0 and rest < first)

    def _text(self, line: Sequence[Piece]) -> str:
        return self.notation.joined([piece.text for piece in line])

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
        for value, places in entries_by_value(matrix):
            names = [entry_name(i, j, matrix, left, formula) for i, j in places]
            yield list(self._level(equation(*names, value)))

    def equations(self, nodes: Sequence[Node]) -> list[Line]:
        """The lines of equations without matrices, level at their first equals sign."""
        return [line for node in nodes for line in self._level(_chained(node))]

    def _level(self, chain: Relation) -> Iterator[Line]:
        """The lines of a = b ≈ ..., level after a."""
        name, *rest = chain.parts
        width = self.ruler.width(name)
        room = self.room - width
        if not rest:
            yield Line("", self.notation.text(name), width=width)
        for i, line in enumerate(lines(self.splitter.chain(rest, chain.signs), room, room - INDENT)):
            text, whole = self._text(line), width + sum(piece.width for piece in line)
            before = "" if i else self.notation.text(name)
            yield Line(before, text, i > 0, whole, width)


def _chained(node: Node) -> Relation:
    """A chain of equations; a formula that is none is a chain of one."""
    return node if isinstance(node, Relation) else Relation((node,), ())


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
