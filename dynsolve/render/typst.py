"""Documents -> Typst, and through it to PDF on a machine without TeX."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from dynsolve.document import (
    Document,
    Formula,
    Heading,
    Picture,
    Prose,
    Table,
    Text,
)
from dynsolve.errors import UsageError
from dynsolve.notation.printing import PLAIN, Style
from dynsolve.notation.tree import Node
from dynsolve.notation.typst import TypstPrinter, quoted
from dynsolve.render.line_breaking import Notation
from dynsolve.render.page import TypesetPage
from dynsolve.render.prose import visible
from dynsolve.render.references import numbered
from dynsolve.render.typesetting import Line

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
    """The signs of a formula in Typst."""

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


class _Page(TypesetPage):
    """Turns blocks into Typst."""

    def __init__(self, style: Style, labels: dict[str, int]) -> None:
        printer = TypstPrinter(style)
        super().__init__(printer, typst_notation(printer), labels, PAGE, _NUMBER)

    def heading(self, heading: Heading) -> Iterator[str]:
        yield f"#heading(level: {heading.level})[{self.words(heading.text)}]"

    def text(self, text: Text) -> Iterator[str]:
        source = f"#source[{self.words(text.source)}]" if text.source else ""
        yield f"{self.prose(text.parts)}{source}\n"

    def formula(self, formula: Formula) -> Iterator[str]:
        lines = self.typesetter(formula).set(formula)
        if not lines:
            return
        display = f"$ {_rows(lines)} $"
        if number := self.labels.get(formula.label):
            numbering = f"#set math.equation(numbering: _ => [({number})])"
            display = f"#[{numbering}\n{display} <eq-{formula.label}>]"
        yield display

    def equations(self, nodes: Sequence[Node]) -> Iterator[str]:
        yield f"$ {_rows(self.unnumbered.equations(nodes))} $"

    def reference(self, label: str) -> str:
        return f"#link(<eq-{label}>)[{super().reference(label)}]"

    def uses(self, sentence: str) -> Iterator[str]:
        yield f"#block(sticky: true)[{sentence}]"

    def list(self, items: Sequence[Prose]) -> Iterator[str]:
        yield from (f"- {self.prose(item)}" for item in items)
        yield ""

    def note(self, parts: Prose) -> Iterator[str]:
        yield f"#note[*Note.* {self.prose(parts)}]"

    def table(self, table: Table) -> Iterator[str]:
        cells = [f"[{self.part(cell)}]" for row in (table.header, *table.rows) for cell in row]
        columns = len(table.header)
        yield (
            f"#align(center, table(columns: {columns}, stroke: none, align: center, "
            f"inset: (x: 0.8em, y: 0.35em), {', '.join(cells[:columns])}, table.hline(stroke: 0.5pt), "
            f"{', '.join(cells[columns:])}))"
        )

    def picture(self, picture: Picture) -> Iterator[str]:
        image = f'image(bytes({quoted(picture.svg)}), format: "svg")'
        yield f"#align(center)[#{image} #text(size: 9pt)[{self.words(picture.caption)}]]"

    def escaped(self, text: str) -> str:
        """Words as a string, so that nothing in them is markup."""
        return f"#{quoted(_known(text))};"

    def verbatim(self, text: str) -> str:
        return f"#raw({quoted(visible(text))});"


def _rows(lines: Sequence[Line]) -> str:
    if len(lines) == 1:
        return lines[0].alone
    return " \\\n".join(line.aligned("#h(2em) ") for line in lines)


def _known(text: str) -> str:
    """A letter that the fonts inside Typst lack stands as its code point."""
    if text.isascii():
        return text
    return "".join(
        c if ord(c) < _LAST_KNOWN or ord(c) in _MATHEMATICAL else f"[U+{ord(c):04X}]" for c in text
    )
