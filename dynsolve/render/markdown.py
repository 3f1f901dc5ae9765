r"""Documents -> Markdown with mathematics as GitHub and Jupyter show it.

Displays stand between `$$` on lines of their own.  Rows end with `\cr`, which both
keep, where Markdown takes a backslash away from `\\`.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence

from dynsolve.document import (
    Block,
    Document,
    Equations,
    Fold,
    Formula,
    Heading,
    Inline,
    List,
    Note,
    Picture,
    Prose,
    Table,
    Text,
    Uses,
    Verbatim,
)
from dynsolve.notation.extent import Ruler
from dynsolve.notation.latex import LatexPrinter
from dynsolve.notation.printing import PLAIN, Style
from dynsolve.notation.tree import Matrix, Node, Words
from dynsolve.render.latex import latex_notation
from dynsolve.render.references import numbered, with_sources
from dynsolve.render.typesetting import Line, Setter
from dynsolve.render.words import Speech, visible

PAGE = 40.0
"""The width of a page on GitHub, in em."""

_NUMBER = 3.0
_MOST_LINES = 40  # a display that MathJax and KaTeX still set
_SPECIAL = re.compile(r"[\\`*_{}\[\]#|~$<>&]")
_ENTITIES = {"<": "&lt;", ">": "&gt;", "&": "&amp;", "$": "&#36;", "|": "&#124;"}


def render(document: Document, style: Style = PLAIN) -> str:
    """The document in Markdown."""
    return "\n".join(_Page(style, numbered(document)).blocks(document.blocks))


class _Printer(LatexPrinter):
    r"""LaTeX that Markdown leaves alone: `\cr` for `\\`, no escaped signs."""

    def _matrix(self, node: Matrix) -> str:
        rows = r" \cr ".join(" & ".join(map(self.text, row)) for row in node.rows)
        return rf"\begin{{bmatrix}} {rows} \end{{bmatrix}}"

    def _words(self, node: Words) -> str:
        if node.text.strip() == ",":
            return r",\quad " if node.text.endswith(" ") else ","
        return super()._words(node)


class _Page:
    """Turns blocks into Markdown."""

    def __init__(self, style: Style, labels: dict[str, int]) -> None:
        self.printer = _Printer(style)
        self.words = Speech(escaped, self.inline)
        ruler, notation = Ruler(style), latex_notation(self.printer)
        self.plain = Setter(notation, ruler, PAGE)
        self.with_number = Setter(notation, ruler, PAGE - _NUMBER)
        self.labels = labels

    def blocks(self, blocks: Iterable[Block]) -> Iterator[str]:
        """The blocks one after the other, each with an empty line after it."""
        for block in blocks:
            yield from self.block(block)

    def block(self, block: Block) -> Iterator[str]:
        match block:
            case Heading(text, level):
                yield f"{'#' * level} {self.words(text)}\n"
            case Text(parts, source):
                yield _begun(self.prose(parts)) + (f" *({self.words(source)})*" if source else "") + "\n"
            case Formula():
                yield from self.formula(block)
            case Equations(nodes):
                yield from self.display(self.plain.equations(nodes))
            case Uses(labels):
                known = [f"({self.labels[label]})" for label in labels if label in self.labels]
                if known:
                    yield f"With {', '.join(known[:-1]) + ' and ' * (len(known) > 1) + known[-1]}:\n"
            case List(items):
                yield "\n".join(f"- {self.prose(item)}" for item in items) + "\n"
            case Note(parts):
                yield f"> **Note.** {self.prose(parts)}\n"
            case Table():
                yield self.table(block)
            case Picture(_, caption):
                yield f"*{self.words(caption)}*\n" if caption else ""
            case Fold(title, blocks):
                yield f"### {self.words(title)}\n"
                yield from self.blocks(with_sources(blocks))

    def prose(self, parts: Prose) -> str:
        return "".join(map(self.part, parts))

    def part(self, part: Inline) -> str:
        match part:
            case str():
                return self.words(part)
            case Verbatim(text):
                return code(text)
        return self.inline(part)

    def inline(self, node: Node) -> str:
        return f"${self.printer.text(node)}$"

    def formula(self, formula: Formula) -> Iterator[str]:
        number = self.labels.get(formula.label)
        lines = (self.with_number if number else self.plain).set(formula)
        yield from self.display(lines, rf" \tag{{{number}}}" if number else "")

    def display(self, lines: Sequence[Line], number: str = "") -> Iterator[str]:
        for start in range(0, len(lines), _MOST_LINES):
            is_last = start + _MOST_LINES >= len(lines)
            tag = number if is_last else ""
            yield f"$$\n{_rows(lines[start : start + _MOST_LINES])}{tag}\n$$\n"

    def table(self, table: Table) -> str:
        rows = [" | ".join(map(self.cell, row)) for row in (table.header, *table.rows)]
        rule = " | ".join([":---:"] * len(table.header))
        return "\n".join(f"| {row} |" for row in (rows[0], rule, *rows[1:])) + "\n"

    def cell(self, cell: Inline) -> str:
        return self.part(cell).replace("|", "\\|") if isinstance(cell, Verbatim) else self.part(cell)


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


def _rows(lines: Sequence[Line]) -> str:
    if len(lines) == 1:
        return f"{lines[0].left} {lines[0].right}".strip()
    rows = []
    for line in lines:
        indent = "\\qquad " if line.indented else ""
        rows.append(f"{line.left} & {indent}{line.right}")
    body = " \\cr\n".join(rows)
    return f"\\begin{{aligned}}\n{body}\n\\end{{aligned}}"
