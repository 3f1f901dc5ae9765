"""Documents -> lines of a terminal.

Lines are laid out here to the width that there is; a terminal's colours are put on
by whoever prints them.  In a pipe a line is its text.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import zip_longest

from dynsolve.document import (
    Document,
    Equations,
    Fold,
    Formula,
    Heading,
    Picture,
    Prose,
    Table,
    Text,
)
from dynsolve.notation.printing import PLAIN, Style
from dynsolve.notation.tree import Node
from dynsolve.notation.unicode import UnicodePrinter, printable, width
from dynsolve.render.page import Page
from dynsolve.render.terminal_breaking import HARD_SPACE, wrap
from dynsolve.render.terminal_formulas import set_formula

WIDTH = 100
"""The width where none is known, in a pipe."""

NARROWEST = 40

_PROSE = 88
_INDENT = 4


@dataclass(frozen=True, slots=True)
class StyledLine:
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
