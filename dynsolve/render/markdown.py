r"""Documents -> Markdown with mathematics as GitHub and Jupyter show it.

Displays stand between `$$` on lines of their own.  Rows end with `\cr`, which both
keep, where Markdown takes a backslash away from `\\`.
"""

from __future__ import annotations

import re
from base64 import b64encode
from collections.abc import Iterator, Sequence

from dynsolve.document import (
    Document,
    Equations,
    Fold,
    Formula,
    Heading,
    Inline,
    Picture,
    Prose,
    Table,
    Text,
    Verbatim,
)
from dynsolve.notation.extent import Ruler
from dynsolve.notation.markup import LatexPrinter
from dynsolve.notation.printing import PLAIN, Style
from dynsolve.notation.tree import Words
from dynsolve.render.latex import latex_notation
from dynsolve.render.latex_displays import level
from dynsolve.render.line_breaking import numbered, with_sources
from dynsolve.render.page import TypesetPage
from dynsolve.render.prose import visible
from dynsolve.render.typesetting import Line

PAGE = 40.0
"""The width of a page on GitHub, in em."""

PICTURE_DATA = "data:image/svg+xml;base64,"
"""What stands before the picture's data."""

_NUMBER = 3.0
_MOST_LINES = 40  # a display that MathJax and KaTeX still set
_SPECIAL = re.compile(r"[\\`*_{}\[\]#|~$<>&]")
_ENTITIES = {"<": "&lt;", ">": "&gt;", "&": "&amp;", "$": "&#36;", "|": "&#124;"}


def render(document: Document, style: Style = PLAIN, ruler: Ruler | None = None) -> str:
    """The document in Markdown; `ruler` knows widths of its formulas already."""
    return "\n".join(_Page(style, numbered(document), ruler).blocks(document.blocks))


class _Printer(LatexPrinter):
    r"""LaTeX that Markdown leaves alone: `\cr` for `\\`, no escaped signs."""

    row_end = r" \cr "

    def _words(self, node: Words) -> str:
        if node.text.strip() == ",":
            return r",\quad " if node.text.endswith(" ") else ","
        return super()._words(node)


class _Page(TypesetPage):
    """Turns blocks into Markdown, each with an empty line after it."""

    def __init__(self, style: Style, labels: dict[str, int], ruler: Ruler | None = None) -> None:
        printer = _Printer(style)
        super().__init__(printer, latex_notation(printer), labels, PAGE, _NUMBER, ruler)

    def heading(self, heading: Heading) -> Iterator[str]:
        yield f"{'#' * heading.level} {self.words(heading.text)}\n"

    def text(self, text: Text) -> Iterator[str]:
        source = f" *({self.words(text.source)})*" if text.source else ""
        yield _begun(self.prose(text.parts)) + source + "\n"

    def formula(self, formula: Formula) -> Iterator[str]:
        yield from self.equations(formula)

    def equations(self, equations: Formula | Equations) -> Iterator[str]:
        yield from _display(self.lines_of(equations), self.tag(equations.label))

    def tag(self, label: str) -> str:
        """The number beside a display that has one."""
        number = self.labels.get(label)
        return rf" \tag{{{number}}}" if number else ""

    def beside(self, display: Formula | Equations) -> float:
        """A source stands in the text, not beside its formula."""
        return self.number if display.label in self.labels else 0.0

    def fold(self, fold: Fold) -> Iterator[str]:
        """The blocks of a fold, sources with the paragraphs that introduce their formulas."""
        yield from self.heading(Heading(fold.title, 3))
        yield from self.blocks(with_sources(fold.blocks))

    def uses(self, sentence: str) -> Iterator[str]:
        yield sentence + "\n"

    def list(self, items: Sequence[Prose]) -> Iterator[str]:
        yield "\n".join(f"- {self.prose(item)}" for item in items) + "\n"

    def note(self, parts: Prose) -> Iterator[str]:
        yield f"> **Note.** {self.prose(parts)}\n"

    def table(self, table: Table) -> Iterator[str]:
        rows = [" | ".join(map(self.cell, row)) for row in (table.header, *table.rows)]
        rule = " | ".join([":---:"] * len(table.header))
        yield "\n".join(f"| {row} |" for row in (rows[0], rule, *rows[1:])) + "\n"

    def cell(self, cell: Inline) -> str:
        """A cell of a table; a bar in it would begin the next."""
        return self.part(cell).replace("|", "\\|") if isinstance(cell, Verbatim) else self.part(cell)

    def picture(self, picture: Picture) -> Iterator[str]:
        """The picture in the page itself, which then needs no file beside it."""
        data = b64encode(picture.svg.encode()).decode()
        yield f"![]({PICTURE_DATA}{data})\n"
        yield f"*{self.words(picture.caption)}*\n" if picture.caption else ""

    def escaped(self, text: str) -> str:
        return escaped(text)

    def verbatim(self, text: str) -> str:
        return code(text)


def escaped(text: str) -> str:
    r"""Any text as Markdown text: what could be markup has a backslash or is an entity.

    >>> print(escaped("50% of <b> & a_1, $5"))
    50% of &lt;b&gt; &amp; a\_1, &#36;5
    """
    return _SPECIAL.sub(lambda found: _ENTITIES.get(found[0]) or "\\" + found[0], text)


def code(text: str) -> str:
    """Any text as it was typed, between more backticks than it holds.

    >>> print(code("a_1 `*b*`"))
    `` a_1 `*b*` ``
    """
    text = visible(text)
    runs = [len(run) for run in re.findall("`+", text)]
    fence = "`" * next(n for n in range(1, len(runs) + 2) if n not in runs)
    space = " " if runs or text != text.strip() else ""
    return f"{fence}{space}{text or ' '}{space}{fence}"


def _begun(text: str) -> str:
    """A paragraph whose first characters begin no list, heading or quotation."""
    return re.sub(r"^(\d+)([.)])", r"\1\\\2", re.sub(r"^([+=-])", r"\\\1", text))


def _display(lines: Sequence[Line], number: str = "") -> Iterator[str]:
    """Displays of lines, a very long formula in several; the number stands in the last."""
    for start in range(0, len(lines), _MOST_LINES):
        tag = number if start + _MOST_LINES >= len(lines) else ""
        yield f"$$\n{_rows(lines[start : start + _MOST_LINES])}{tag}\n$$\n"


def _rows(lines: Sequence[Line]) -> str:
    if len(lines) == 1:
        return lines[0].alone
    body = " \\cr\n".join(map(level, lines))
    return f"\\begin{{aligned}}\n{body}\n\\end{{aligned}}"
