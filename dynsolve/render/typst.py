"""Documents -> Typst, and through it to PDF on a machine without TeX."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence
from itertools import zip_longest

from dynsolve.document import (
    Block,
    Document,
    Equations,
    Formula,
    Heading,
    Picture,
    Prose,
    Table,
    Text,
)
from dynsolve.errors import UsageError
from dynsolve.notation.extent import FLAT
from dynsolve.notation.printing import PLAIN, Style
from dynsolve.notation.tree import Node
from dynsolve.notation.typst import TypstPrinter, quoted
from dynsolve.render.columns import Columns
from dynsolve.render.line_breaking import Notation
from dynsolve.render.page import TypesetPage, prose_columns
from dynsolve.render.page_ends import introduces, runs_of_rows
from dynsolve.render.prose import visible
from dynsolve.render.references import is_long, numbered, running_title
from dynsolve.render.typesetting import Line

PAGE = 45.0
"""The width of the page, in em."""

_NUMBER = 3.0
_LAST_KNOWN = 0x2C00
_MATHEMATICAL = range(0x1D400, 0x1D800)

_PREAMBLE = """#set document(title: {title}, date: none)
#set page(paper: "a4", margin: (x: 2.2cm, top: 2.2cm, bottom: 2cm), header-ascent: 40%, header: context {
  if here().page() > 1 { text(8.5pt, fill: luma(90), [#emph({header}) #h(1fr) #counter(page).display()]) }
})
#set text(font: ("New Computer Modern", "Libertinus Serif", "DejaVu Sans Mono"), size: 10pt, lang: "en")
#set par( leading: 0.6em, spacing: 0.75em)
#set math.mat(delim: "[", row-gap: 0.45em, column-gap: 0.9em)
#set math.equation(numbering: none)
#show heading: set text(hyphenate: false)
#show heading.where(level: 1): set text(size: 17pt)
#show heading.where(level: 2): it => block(above: 1.6em, below: .8em, sticky: true, text(13pt, it.body))
#show heading.where(level: 3): it => block(above: 1.2em, below: .6em, sticky: true, text(10.5pt, it.body))
#show link: set text(fill: rgb("#1a5a96"))
#let source(body) = text(size: 8.5pt, fill: luma(90), body)
#let displayed(body, ..options) = {
  set text(top-edge: "bounds", bottom-edge: "bounds")
  block(above: 0.9em, below: 0.9em, width: 100%, ..options, body)
}
#let formula(body, side) = displayed(breakable: false,
  grid(columns: (1fr, auto, 1fr), align: (left, center, right + horizon), [], body, side))
#let held(rows) = grid.cell(rowspan: rows, breakable: false, [])
#let formula-lines(..cells) = displayed(
  grid(columns: (1fr, auto, auto, 1fr), column-gutter: (0pt, 0.28em, 0pt), row-gutter: 0.6em,
    align: (left, right + horizon, left + horizon, right + horizon), ..cells))
#let columned(count, ..cells) = displayed(
  grid(columns: (0pt,) + (1fr,) * count + (3em,), row-gutter: 0.65em,
    align: (x, y) => if x == count + 1 { right + horizon } else { left + horizon }, ..cells))
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
    page = _Page(style, document)
    texts = {"{title}": quoted(title), "{header}": quoted(_known(running_title(title)))}
    preamble = re.sub("{title}|{header}", lambda found: texts[found[0]], _PREAMBLE)
    return preamble + "\n".join(page.blocks(document.blocks)) + "\n"


def typst_notation(printer: TypstPrinter) -> Notation:
    """The signs of a formula in Typst."""

    def fence(sign: str, height: float) -> str:
        return f"lr(size: #{height:.2f}em, \\{sign})" if height > FLAT else f"\\{sign}"

    def closed(height: float, exponent: Node | None) -> str:
        sign = fence(")", height)
        return sign if exponent is None else f"{sign}^({printer.text(exponent)})"

    return Notation(
        text=printer.text,
        plus='class("binary", +)',
        minus='class("binary", -)',
        lead="-",
        times='class("binary", dot.op)',
        relation=lambda sign: "\\/" if sign == "/" else sign,  # unescaped it sets a fraction
        opened=lambda height: fence("(", height),
        closed=closed,
        joined=" ".join,
    )


class _Page(TypesetPage):
    """Turns blocks into Typst."""

    def __init__(self, style: Style, document: Document) -> None:
        printer = TypstPrinter(style)
        super().__init__(printer, typst_notation(printer), numbered(document), PAGE, _NUMBER)
        self.contents_are_due = is_long(document)
        self.close(document)

    def blocks(self, blocks: Iterable[Block]) -> Iterator[str]:
        """The blocks, in a sticky block what stays on the page of the next."""
        listed = list(blocks)
        for block, following in zip_longest(listed, listed[1:]):
            if introduces(block, following) or self.closes(block):
                yield "#block(sticky: true, width: 100%)["
                yield from self.block(block)
                yield "]"
            else:
                yield from self.block(block)

    def heading(self, heading: Heading) -> Iterator[str]:
        if heading.level == 2 and self.contents_are_due:
            self.contents_are_due = False
            yield "#outline(title: none, target: heading.where(level: 2))"
        yield f"#heading(level: {heading.level})[{self.words(heading.text)}]"

    def text(self, text: Text) -> Iterator[str]:
        yield f"{self.prose(text.parts)}\n"

    def formula(self, formula: Formula) -> Iterator[str]:
        columns = self.columns(formula)
        if columns is not None:
            yield _in_columns(columns, self.side(formula), self.kept(formula))
        elif lines := self.typesetter(formula).set(formula):
            yield _display(lines, self.side(formula), self.kept(formula))

    def side(self, formula: Formula) -> str:
        """What stands beside a formula: its number, which others refer to, or its source."""
        if number := self.labels.get(formula.label):
            return f"({number})#metadata(none) <eq-{formula.label}>"
        return f"#source[{self.words(formula.source)}]" if formula.source else ""

    def equations(self, equations: Equations) -> Iterator[str]:
        columns = self.equation_columns(equations)
        if columns is not None:
            yield _in_columns(columns, "", self.kept(equations))
        else:
            yield _display(self.unnumbered.equations(equations.nodes), "", self.kept(equations))

    def reference(self, label: str, number: int) -> str:
        return f"#link(<eq-{label}>)[{super().reference(label, number)}]"

    def uses(self, sentence: str) -> Iterator[str]:
        yield sentence

    def list(self, items: Sequence[Prose]) -> Iterator[str]:
        yield from (f"- {self.prose(item)}" for item in items)
        yield ""

    def note(self, parts: Prose) -> Iterator[str]:
        yield f"#note[*Note.* {self.prose(parts)}]"

    def table(self, table: Table) -> Iterator[str]:
        cells = [f"[{self.part(cell)}]" for row in (table.header, *table.rows) for cell in row]
        columns = len(table.header)
        side = "left" if prose_columns(table) else "center"
        yield (
            f"#align(center, table(columns: {columns}, stroke: none, align: {side}, "
            f"inset: (x: 0.8em, y: 0.35em), "
            f"table.header({', '.join(cells[:columns])}, table.hline(stroke: 0.5pt)), "
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


def _display(lines: Sequence[Line], side: str, last: int) -> str:
    """A formula in the middle of the page, `side` at the end of its last line.

    A page may end between two lines, but not in so many at the end; what stands at the side is there once.
    """
    if len(lines) == 1:
        return f"#formula({_math(lines[0].alone)}, [{side}])"
    cells: list[str] = []
    for line, run in zip(lines, _held(len(lines), last), strict=True):
        cells += [*run, _math(line.left), _math(_right(line)), "[]"]
    cells[-1] = f"[{side}]"
    return f"#formula-lines({', '.join(cells)})"


def _held(count: int, last: int) -> Iterator[list[str]]:
    """What stands before each row: at the first of a run of rows a cell as high as all, which holds them."""
    for run in runs_of_rows(count, last):
        yield [f"held({run})"]
        yield from [[]] * (run - 1)


def _in_columns(columns: Columns, side: str, last: int) -> str:
    """Equations in columns, `side` at the end of the last row."""
    count = len(columns.rows)
    cells: list[str] = []
    for row, run in zip(columns.rows, _held(count, last), strict=True):
        cells += run
        for cell in row:
            name = f"box(width: {columns.name:.2f}em, align(right, {_math(cell.line.left)}))"
            cells.append(f"grid.cell(colspan: {cell.span}, {name} + h(0.28em) + {_math(_right(cell.line))})")
        if rest := columns.count - sum(cell.span for cell in row):
            cells.append(f"grid.cell(colspan: {rest}, [])")
        cells.append("[]")
    cells[-1] = f"[{side}]"
    return f"#columned({columns.count}, {', '.join(cells)})"


def _right(line: Line) -> str:
    return (f"#h({line.indent}em) " if line.indent else "") + line.right


def _math(text: str) -> str:
    """A formula as large as in a display, though it does not stand in one by itself."""
    return f"$display({text})$" if text else "none"


def _known(text: str) -> str:
    """A letter that the fonts inside Typst lack stands as its code point."""
    if text.isascii():
        return text
    return "".join(
        c if ord(c) < _LAST_KNOWN or ord(c) in _MATHEMATICAL else f"[U+{ord(c):04X}]" for c in text
    )
