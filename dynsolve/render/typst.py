"""Documents -> Typst, and through it to PDF on a machine without TeX."""

from __future__ import annotations

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
from dynsolve.errors import UsageError
from dynsolve.notation.extent import Ruler
from dynsolve.notation.printing import PLAIN, Style
from dynsolve.notation.tree import Node
from dynsolve.notation.typst import TypstPrinter, quoted
from dynsolve.render.flow import Notation
from dynsolve.render.references import numbered, with_sources
from dynsolve.render.typesetting import Line, Setter
from dynsolve.render.words import Speech, visible

PAGE = 45.0
"""The width of the page, in em."""

_NUMBER = 3.0
_TALL = ("frac(", "mat(", "sum_")
_LAST_KNOWN = 0x2C00
_MATHEMATICAL = range(0x1D400, 0x1D800)

_PREAMBLE = """#set document(title: {title}, date: none)
#set page(paper: "a4", margin: (x: 2.2cm, y: 2.2cm), numbering: "1")
#set text(font: ("New Computer Modern", "Libertinus Serif", "DejaVu Sans Mono"), size: 10pt, lang: "en")
#set par(justify: true, leading: 0.6em, spacing: 0.9em)
#set math.mat(delim: "[", row-gap: 0.45em, column-gap: 0.9em)
#set math.equation(numbering: none, number-align: end + bottom)
#show math.equation: set block(breakable: true)
#show heading: set text(hyphenate: false)
#show heading.where(level: 1): set text(size: 17pt)
#show heading.where(level: 2): it => block(above: 2em, below: 1em, sticky: true, text(13pt, it.body))
#show heading.where(level: 3): it => block(above: 1.6em, below: .8em, sticky: true, text(10.5pt, it.body))
#show link: set text(fill: rgb("#1a5a96"))
#let source(body) = {
  [ ] + box[] + sym.wj + h(1fr) + sym.wj + box(text(size: 8.5pt, fill: luma(90), body))
}
#let note(body) = {
  block(inset: (left: 0.8em, y: 0.3em), stroke: (left: 1.5pt + luma(150)), text(9.3pt, body))
}
"""


def render(document: Document, style: Style = PLAIN) -> bytes:
    """A PDF, the same bytes for the same document.

    Raises UsageError where the extra `pdf` is not installed.
    """
    try:
        import typst
    except ImportError:
        raise UsageError("PDF needs the extra [pdf]: pip install 'dynsolve[pdf]'") from None
    source = to_typst_document(document, style).encode()
    pdf: bytes = typst.compile(source, format="pdf", ignore_system_fonts=True, timestamp=0)
    return pdf


def to_typst_document(document: Document, style: Style = PLAIN) -> str:
    """The source of a complete Typst document."""
    title = next((visible(b.text) for b in document.blocks if isinstance(b, Heading)), "")
    page = _Page(style, numbered(document))
    return _PREAMBLE.replace("{title}", quoted(title)) + "\n".join(page.blocks(document.blocks)) + "\n"


def typst_notation(printer: TypstPrinter) -> Notation:
    """How Typst writes what a formula is made of."""

    def fence(sign: str, inner: str) -> str:
        return f"lr(size: #1.9em, \\{sign})" if any(mark in inner for mark in _TALL) else f"\\{sign}"

    def closed(inner: str, exponent: Node | None) -> str:
        sign = fence(")", inner)
        return sign if exponent is None else f"{sign}^({printer.text(exponent)})"

    return Notation(
        text=printer.text,
        plus='class("binary", +)',
        minus='class("binary", -)',
        lead="-",
        relation=lambda sign: sign,
        opened=lambda inner: fence("(", inner),
        closed=closed,
        joined=" ".join,
    )


class _Page:
    """Turns blocks into Typst."""

    def __init__(self, style: Style, labels: dict[str, int]) -> None:
        self.printer = TypstPrinter(style)
        self.words = Speech(_string, self.inline)
        ruler, notation = Ruler(style), typst_notation(self.printer)
        self.plain = Setter(notation, ruler, PAGE)
        self.with_number = Setter(notation, ruler, PAGE - _NUMBER)
        self.labels = labels

    def blocks(self, blocks: Iterable[Block]) -> Iterator[str]:
        """The blocks one after the other."""
        for block in blocks:
            yield from self.block(block)

    def block(self, block: Block) -> Iterator[str]:
        match block:
            case Heading(text, level):
                yield f"#heading(level: {level})[{self.words(text)}]"
            case Text(parts, source):
                beside = f"#source[{self.words(source)}]" if source else ""
                yield f"{self.prose(parts)}{beside}\n"
            case Formula():
                yield from self.formula(block)
            case Equations(nodes):
                yield f"$ {_rows(self.plain.equations(nodes))} $"
            case Uses(labels):
                yield from self.uses(labels)
            case List(items):
                yield from (f"- {self.prose(item)}" for item in items)
                yield ""
            case Note(parts):
                yield f"#note[*Note.* {self.prose(parts)}]"
            case Table():
                yield self.table(block)
            case Picture(svg, caption):
                image = f'image(bytes({quoted(svg)}), format: "svg")'
                yield f"#align(center)[#{image} #text(size: 9pt)[{self.words(caption)}]]"
            case Fold(title, blocks):
                yield f"#heading(level: 3)[{self.words(title)}]"
                yield from self.blocks(with_sources(blocks))

    def prose(self, parts: Prose) -> str:
        return "".join(map(self.part, parts))

    def part(self, part: Inline) -> str:
        """A piece of a sentence, or a cell of a table."""
        match part:
            case str():
                return self.words(part)
            case Verbatim(text):
                return f"#raw({quoted(visible(text))});"
        return self.inline(part)

    def inline(self, node: Node) -> str:
        return f"${self.printer.text(node)}$"

    def uses(self, labels: Sequence[str]) -> Iterator[str]:
        known = [label for label in labels if label in self.labels]
        if known:
            links = [f"#link(<eq-{label}>)[({self.labels[label]})]" for label in known]
            listed = ", ".join(links[:-1]) + " and " * (len(links) > 1) + links[-1]
            yield f"#block(sticky: true)[With {listed}:]"

    def formula(self, formula: Formula) -> Iterator[str]:
        number = self.labels.get(formula.label)
        lines = (self.with_number if number else self.plain).set(formula)
        if not lines:
            return
        display = f"$ {_rows(lines)} $"
        if number:
            numbering = f"#set math.equation(numbering: _ => [({number})])"
            yield f"#[{numbering}\n{display} <eq-{formula.label}>]"
        else:
            yield display

    def table(self, table: Table) -> str:
        cells = [f"[{self.part(cell)}]" for row in (table.header, *table.rows) for cell in row]
        columns = len(table.header)
        return (
            f"#align(center, table(columns: {columns}, stroke: none, align: center, "
            f"inset: (x: 0.8em, y: 0.35em), {', '.join(cells[:columns])}, table.hline(stroke: 0.5pt), "
            f"{', '.join(cells[columns:])}))"
        )


def _rows(lines: Sequence[Line]) -> str:
    if len(lines) == 1:
        return f"{lines[0].left} {lines[0].right}".strip()
    return " \\\n".join(f"{line.left} & {'#h(2em) ' if line.indented else ''}{line.right}" for line in lines)


def _string(text: str) -> str:
    """Words as a string, so that nothing in them is markup."""
    return f"#{quoted(_known(text))};"


def _known(text: str) -> str:
    """A letter that the fonts inside Typst lack stands as its code point."""
    if text.isascii():
        return text
    return "".join(
        c if ord(c) < _LAST_KNOWN or ord(c) in _MATHEMATICAL else f"[U+{ord(c):04X}]" for c in text
    )
