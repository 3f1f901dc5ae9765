"""Documents -> lines of a terminal.

Lines are laid out here to the width that there is; a terminal's colours are put on
by whoever prints them.  In a pipe a line is its text.

Displayed formulas in a terminal, set to its width: on one line, or a line a member, or entry by entry.

Line breaks for a terminal: sums break at their signs, prose between its words.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import zip_longest

from msgspec import Struct
from msgspec.structs import replace

from dynsolve.document import Document, Equations, Fold, Formula, Heading, Picture, Prose, Table, Text
from dynsolve.notation.printing import PLAIN, Style
from dynsolve.notation.tree import Letter, Matrix, Node, Relation, Row, equation, mapped, walk
from dynsolve.notation.unicode import UnicodePrinter, printable, width
from dynsolve.render.page import Page
from dynsolve.render.terminal_boxes import (
    TextBox,
    beside,
    boxed,
    entry_equations,
    matrix_box,
    matrix_width,
    pieces,
)
from dynsolve.render.typesetting import fitting, listed

# Line breaks for a terminal: sums break at their signs, prose between its words

HARD_SPACE = "\u00a0"
"""Stands for a space inside a formula of a sentence, where no line may end."""

_FULL_ENOUGH = 0.33
_NEVER = 99


def break_sum(text: str, first: int, rest: int) -> list[str]:
    """Break a formula before a sign + or -, in as few parentheses as can be.

    The first line may take `first` cells, the others `rest`.  A product that is
    itself too wide is broken between its factors.

    >>> break_sum("a b + c (d - e) + f", 16, 16)
    ['a b + c (d - e)', '+ f']
    """
    lines: list[str] = []
    start, room = 0, first
    while (place := _end_of_line(text, start, room)) is not None:
        lines.append(text[start:place].rstrip())
        start, room = place + 1, rest
    return [*lines, text[start:]]


def _end_of_line(text: str, start: int, room: int) -> int | None:
    """Where a line ends that begins at `start`; None where all that is left fits, or cannot be broken.

    It is the last of the shallowest places that leave the line full enough.
    """
    best: tuple[int, int] | None = None
    spare: tuple[int, int] | None = None
    for depth, place, cells in _breaks(text, start, room):
        if place < 0:
            return None
        if cells >= room * _FULL_ENOUGH:
            best = (depth, place) if best is None or depth <= best[0] else best
        else:
            spare = (depth, place) if spare is None or depth <= spare[0] else spare
    found = best or spare
    return found[1] if found else None


def _breaks(text: str, start: int, room: int) -> Iterator[tuple[int, int, int]]:
    """(depth, offset, cells before it) of every place within reach; offset -1 where the end is reached.

    A space between the factors of a product is the deepest place.
    """
    depth, cells, met_one = 0, 0, False
    for i in range(start, len(text)):
        character = text[i]
        if character == "(":
            depth += 1
        elif character == ")":
            depth -= 1
        elif character == " " and i > start:
            sign = text[i + 1 : i + 3] in ("+ ", "- ", "= ", "≈ ")
            if sign or text[i - 1] not in "+-=≈":
                yield (depth if sign else depth + _NEVER), i, cells
                met_one = True
        cells += width(character)
        if cells > room and met_one:
            return
    if cells <= room:
        yield 0, -1, cells


def wrap(text: str, first: int, rest: int) -> list[str]:
    """Wrap prose; hard spaces are no places to break, unless the formula alone is too wide."""
    lines: list[str] = []
    line, room = "", first
    for word in filter(None, text.replace("\n", " ").split(" ")):
        for piece in _fitting(word, rest):
            joined = f"{line} {piece}" if line else piece
            if line and width(joined) > room:
                lines.append(line)
                line, room = piece, rest
            else:
                line = joined
    lines.append(line)
    return [line.replace(HARD_SPACE, " ") for line in lines]


def _fitting(word: str, room: int) -> Sequence[str]:
    if HARD_SPACE not in word or width(word) <= room:
        return (word,)
    return [piece.replace(" ", HARD_SPACE) for piece in break_sum(word.replace(HARD_SPACE, " "), room, room)]


# Displayed formulas in a terminal, set to its width

_HANG = 4
_UNDER_HEAD = 2
"""How far the entries of a matrix are moved in under the letter that they belong to."""

_LONGEST_HANG = 12

Group = tuple[str, TextBox | Matrix]
"""What stands before a piece (` = `, a space) and the piece; a `Matrix` is one too wide for a box."""


def set_formula(formula: Formula, printer: UnicodePrinter, room: int) -> list[str]:
    """The lines of a displayed formula in `room` cells; none for an optional one that does not fit.

    Where a matrix that cannot be listed entry by entry is wider, as one that is transposed, its rows are
    written one after the other.
    """
    lines = _set_in_boxes(formula, printer, room)
    if all(width(line) <= room for line in lines):
        return lines
    first, *others = break_sum(printer.text(formula.node), room, room - _HANG)
    return [first, *(" " * _HANG + other for other in others)]


def _set_in_boxes(formula: Formula, printer: UnicodePrinter, room: int) -> list[str]:
    groups = list(_grouped(formula.node, printer, room))
    boxes = [beside([TextBox.of(lead), piece]) for lead, piece in groups if isinstance(piece, TextBox)]
    if len(boxes) == len(groups) and sum(box.width for box in boxes) <= room:
        return list(beside(boxes).lines)
    within = [
        piece for _, piece in groups if isinstance(piece, Matrix) and not _is_alone(piece, formula.node)
    ]
    if formula.otherwise and within:
        found = [set_formula(each, printer, room) for each in formula.otherwise]
        return [line for lines in found for line in (*lines, "")][:-1]
    fitted = fitting(formula, lambda node: _fits(node, printer, room))
    if fitted is None:
        return []
    if fitted is not formula:
        return _set_in_boxes(fitted, printer, room)
    if within:
        apart = [Formula(node) for node in _named_apart(formula.node, within)]
        found = [set_formula(each, printer, room) for each in apart]
        return [line for lines in found for line in (*lines, "")][:-1]
    if len(boxes) < len(groups) and (rows := list(_entries_equated(formula.node))):
        return [line for row in rows for line in set_formula(Formula(row), printer, room)]
    if isinstance(formula.node, Row) and len(parts := list(listed(formula.node))) > 1:
        return _set_several(parts, formula, printer, room)
    members = list(_members(groups))
    left = _width(members[0], room)
    hang = left + 1 if left + 1 <= _LONGEST_HANG else _HANG
    lines: list[str] = []
    start = members[0]
    if len(members) > 1 and left <= room // 2:
        start = [*members[0], *members[1]]
        members = members[1:]
    lines += _set_member(start, formula, printer, room, 0, hang + 2)
    for member in members[1:]:
        lines += _set_member(member, formula, printer, room, hang, hang + 2)
    return lines


def _set_several(parts: Sequence[Node], formula: Formula, printer: UnicodePrinter, room: int) -> list[str]:
    """Equations with commas between them, as many on one line as it holds."""
    lines: list[str] = []
    row = TextBox.of("")
    for place, part in enumerate(parts):
        comma = "," if place < len(parts) - 1 else ""
        boxes = list(pieces(part, printer))
        fits = all(isinstance(box, TextBox) or matrix_width(box, printer) < room for box in boxes)
        box = beside([boxed(piece, printer) for piece in boxes]) if fits else None
        if box is not None and box.width < room:
            if row.width and row.width + 1 + box.width + len(comma) > room:
                lines += [*_flushed(row), *([""] if len(row.lines) > 1 else [])]
                row = TextBox.of("")
            row = beside([row, TextBox.of(" " if row.width else ""), box, TextBox.of(comma)])
        else:
            *others, last = set_formula(replace(formula, node=part, optional=False), printer, room - 1)
            lines += [*_flushed(row), *others, last + comma]
            row = TextBox.of("")
    return lines + _flushed(row)


def _fits(node: Node, printer: UnicodePrinter, room: int) -> bool:
    """Whether no matrix is too wide, alone or with others in one parenthesis."""
    found = [piece for _, piece in _grouped(node, printer, room)]
    return all(isinstance(each, TextBox) and (len(each.lines) == 1 or each.width <= room) for each in found)


def _grouped(node: Node, printer: UnicodePrinter, room: int) -> Iterator[Group]:
    lead = ""
    for part in pieces(node, printer):
        if isinstance(part, Matrix):
            fits = matrix_width(part, printer) + (_LONGEST_HANG if _is_alone(part, node) else 0) <= room
            yield lead, matrix_box(part, printer) if fits else part
            lead = ""
        else:
            text = part.lines[0]
            if len(part.lines) == 1 and (not text.strip(" =+-×≠≈⇒≤,") or text == " "):
                lead += text
            else:
                yield lead, part
                lead = ""


def _is_alone(matrix: Matrix, node: Node) -> bool:
    """Whether a matrix is a side of an equation, so that its entries may be listed in its place."""
    return matrix in (node.parts if isinstance(node, Relation) else (node,))


def _entries_equated(node: Node) -> Iterator[Node]:
    """The equations between the entries of matrices that are equal, where none of these has a letter."""
    if isinstance(node, Relation):
        matrices = [part.rows for part in node.parts if isinstance(part, Matrix)]
        if len(matrices) == len(node.parts):
            for rows in zip(*matrices, strict=True):
                yield from (Relation(entries, node.signs) for entries in zip(*rows, strict=True))


def _named_apart(node: Node, matrices: Sequence[Matrix]) -> Iterator[Node]:
    """A formula with letters for matrices in it, and what these are; one that says the letter is not new."""
    own = iter("MNSW")
    names: dict[Node, Node] = {
        matrix: _counterpart(node, matrix) or Letter(next(own), style="bold") for matrix in matrices
    }
    told = mapped(node, lambda part: names.get(part, part))
    if not isinstance(told, Relation) or len(set(told.parts)) > 1:
        yield told
    yield from (equation(name, matrix) for matrix, name in names.items())


def _counterpart(node: Node, matrix: Matrix) -> Node | None:
    """A with which one side of an equation is as another with the matrix, as in det A = det [...]."""
    if isinstance(node, Relation):
        for letter in (part for part in walk(node) if isinstance(part, Letter)):
            sides = [_put(letter, matrix, side) for side in node.parts]
            if len(set(sides)) < len(sides):
                return letter
    return None


def _put(letter: Letter, matrix: Matrix, node: Node) -> Node:
    return mapped(node, lambda part: letter if part == matrix else part)


def _width(member: Sequence[Group], room: int) -> int:
    """How wide a member of a chain is; more than the room where it is not all boxes."""
    return sum(len(lead) + (piece.width if isinstance(piece, TextBox) else room) for lead, piece in member)


def _members(groups: Sequence[Group]) -> Iterator[list[Group]]:
    """The members of a chain of equations."""
    member: list[Group] = []
    for lead, piece in groups:
        if ("=" in lead or "≈" in lead) and member:
            yield member
            member = []
        member.append((lead, piece))
    yield member


def _set_member(
    member: Sequence[Group], formula: Formula, printer: UnicodePrinter, room: int, indent: int, hang: int
) -> list[str]:
    """One member of a chain, its pieces side by side as far as they go."""
    lines: list[str] = []
    row = TextBox.of(" " * indent)
    for lead, piece in member:
        if not row.lines[0].strip() and len(row.lines) == 1:
            lead = lead.lstrip()
        if isinstance(piece, Matrix):
            left = formula.node.parts[0] if isinstance(formula.node, Relation) else None
            letter = printer.text(left) if isinstance(left, Letter) else ""  # its entries are named after it
            is_headed = row.lines[0].strip() != letter
            lines += _flushed(row) if is_headed else []
            lines += _entry_by_entry(piece, formula, printer, room, _UNDER_HEAD * is_headed)
            row = TextBox.of(" " * hang)
        elif row.width + width(lead) + piece.width <= room:
            row = beside([row, TextBox.of(lead), piece])
        elif len(piece.lines) > 1:
            multiplies = not lead.strip() and len(row.lines) > 1
            sign = "· " if multiplies else lead.lstrip()
            is_apart = width(sign) + piece.width > room  # then the sign has a line for itself
            lines += [*_flushed(row), *[" " * hang + sign.strip() if is_apart else ""] * multiplies]
            sign = "" if multiplies and is_apart else sign
            margin = max(0, min(hang, room - width(sign) - piece.width))
            row = beside([TextBox.of(" " * margin), TextBox.of(sign), piece])
        else:
            if len(row.lines) > 1:
                lines += _flushed(row)
                row = TextBox.of(" " * hang)
            text = row.lines[0] + lead + piece.lines[0]
            margin = len(text) - len(text.lstrip())
            first, *others = break_sum(text.lstrip(), room - margin, room - hang)
            broken = [" " * margin + first, *(" " * hang + other for other in others)]
            lines += broken[:-1]
            row = TextBox.of(broken[-1])
    return lines + _flushed(row)


def _flushed(row: TextBox) -> list[str]:
    return [line.rstrip() for line in row.lines] if any(line.strip() for line in row.lines) else []


def _entry_by_entry(
    matrix: Matrix, formula: Formula, printer: UnicodePrinter, room: int, indent: int
) -> list[str]:
    """`d₁₂ = ...` a line for each entry; equal ones in one chain, those that are 0 last."""
    lines: list[str] = []
    left = formula.node.parts[0] if isinstance(formula.node, Relation) else None
    for chain in entry_equations(matrix, left, formula, printer.style):
        text = printer.text(chain)
        first, *others = break_sum(text, room - indent, room - _HANG - indent)
        lines += [" " * indent + first, *(" " * (indent + _HANG) + other for other in others)]
    return lines


WIDTH = 100
"""The width where none is known, in a pipe."""

NARROWEST = 40

_PROSE = 88
_INDENT = 4


class StyledLine(Struct, frozen=True):
    """A line and what it is: `title`, `heading`, `step`, `formula`, `note`, `source` or plain text."""

    text: str
    kind: str = ""


def render(document: Document, columns: int = WIDTH, style: Style = PLAIN) -> Iterator[StyledLine]:
    """Lay a document out.

    >>> from dynsolve.notation.tree import Symbol, equation
    >>> lines = render(Document((Heading("Energy"), Formula(equation(Symbol("P1"), Symbol("m1"))))))
    >>> [line.text for line in lines]
    ['Energy', '──────', '', '    P₁ = m₁', '']
    """
    page = _Page(max(columns, NARROWEST), UnicodePrinter(style))
    yield from page.blocks(document.blocks)


class _Page(Page[StyledLine]):
    """Turns blocks into lines of at most `columns` cells; formulas have no numbers."""

    def __init__(self, columns: int, printer: UnicodePrinter) -> None:
        self.columns = columns
        self.printer = printer
        self.labels = {}

    def heading(self, heading: Heading) -> Iterator[StyledLine]:
        kind, rule = ("title", "═") if heading.level == 1 else ("heading", "─")
        lines = wrap(printable(heading.text), self.columns, self.columns)
        for line in lines:
            yield StyledLine(line, kind)
        yield StyledLine(rule * max(map(width, lines)), kind)
        yield StyledLine("")

    def words(self, text: str) -> str:
        return printable(text)

    def verbatim(self, text: str) -> str:
        return printable(text)

    def inline(self, node: Node) -> str:
        """A formula in a sentence, unbroken."""
        return self.printer.text(node).replace(" ", HARD_SPACE)

    def text(self, text: Text) -> Iterator[StyledLine]:
        yield from self.paragraph(self.prose(text.parts))

    def paragraph(self, sentence: str) -> Iterator[StyledLine]:
        """A sentence, broken into lines."""
        room = min(self.columns, _PROSE)
        for line in wrap(sentence, room, room):
            yield StyledLine(line)
        yield StyledLine("")

    def list(self, items: Sequence[Prose]) -> Iterator[StyledLine]:
        for item in items:
            yield from self.hanging(item, "• ", "")
        yield StyledLine("")

    def note(self, parts: Prose) -> Iterator[StyledLine]:
        yield from self.hanging(parts, "Note: ", "note")
        yield StyledLine("")

    def hanging(self, parts: Prose, sign: str, kind: str) -> Iterator[StyledLine]:
        """Prose that is indented, with a sign before its first line."""
        room = min(self.columns, _PROSE) - _INDENT - len(sign)
        for i, line in enumerate(wrap(self.prose(parts), room, room)):
            yield StyledLine(" " * _INDENT + (" " * len(sign) if i else sign) + line, kind)

    def formula(self, formula: Formula) -> Iterator[StyledLine]:
        lines = set_formula(formula, self.printer, self.columns - _INDENT)
        if not lines:
            return
        source = f"({formula.source})" if formula.source else ""
        middle = (len(lines) - 1) // 2
        beside = source and width(lines[middle]) + len(source) + _INDENT + 3 <= self.columns
        for i, line in enumerate(lines):
            text = (" " * _INDENT + line).rstrip()
            if beside and i == middle:
                text += " " * (min(self.columns, _PROSE) - width(text) - len(source)) + source
                if width(text) < width(line) + _INDENT + 3 + len(source):
                    text = " " * _INDENT + line.rstrip() + "   " + source
            yield StyledLine(text, "formula")
        if source and not beside:
            yield StyledLine(" " * max(min(self.columns, _PROSE) - len(source), 0) + source, "source")
        yield StyledLine("")

    def equations(self, equations: Equations) -> Iterator[StyledLine]:
        for node in equations.nodes:
            for line in set_formula(Formula(node), self.printer, self.columns - _INDENT):
                yield StyledLine(" " * _INDENT + line.rstrip(), "formula")
        yield StyledLine("")

    def uses(self, sentence: str) -> Iterator[StyledLine]:
        yield from self.paragraph(sentence)

    def picture(self, picture: Picture) -> Iterator[StyledLine]:
        yield from ()

    def fold(self, fold: Fold) -> Iterator[StyledLine]:
        for line in wrap(printable(fold.title), self.columns, self.columns):
            yield StyledLine(line, "step")
        yield from self.blocks(fold.blocks)

    def table(self, table: Table) -> Iterator[StyledLine]:
        rows = (table.header, *table.rows)
        cells = [[self.part(cell) for cell in row] for row in rows]
        widths = [max(map(width, column)) for column in zip(*cells, strict=True)]
        between = _INDENT + 3 * (len(widths) - 1)
        while sum(widths) + between > self.columns:  # the cells of the widest columns are broken
            widths[widths.index(max(widths))] -= 1
        for i, row in enumerate(cells):
            broken = [wrap(cell, room, room) or [""] for cell, room in zip(row, widths, strict=True)]
            for line in zip_longest(*broken, fillvalue=""):
                yield StyledLine(
                    " " * _INDENT + _padded([part.replace(HARD_SPACE, " ") for part in line], widths)
                )
            if i == 0:
                yield StyledLine(" " * _INDENT + "─" * (sum(widths) + 3 * (len(widths) - 1)))
        yield StyledLine("")


def _padded(row: Sequence[str], widths: Sequence[int]) -> str:
    cells = (cell + " " * (cells - width(cell)) for cell, cells in zip(row, widths, strict=True))
    return "   ".join(cells).rstrip()
