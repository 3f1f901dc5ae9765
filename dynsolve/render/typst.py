"""Documents -> Typst, and through it to PDF on a machine without TeX."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence
from itertools import groupby, islice, zip_longest

from dynsolve.document import (
    Block,
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
)
from dynsolve.errors import UsageError
from dynsolve.notation.extent import FLAT
from dynsolve.notation.markup import TypstPrinter, quoted
from dynsolve.notation.printing import PLAIN, Style
from dynsolve.notation.tree import Node
from dynsolve.render.line_breaking import (
    FormulaSplitter,
    Notation,
    height_around,
    is_long,
    numbered,
    running_title,
    together,
)
from dynsolve.render.page import (
    PART,
    SHORT,
    TypesetPage,
    before_closing,
    introduces,
    prose_columns,
    runs_of_equations,
)
from dynsolve.render.prose import typographic, visible
from dynsolve.render.typesetting import Columns, Line

PAGE = 45.0
"""The width of the page, in em."""

_FACE = "New Computer Modern"
"""The face of words and of what stands in drawings."""

_NUMBER = 3.0
_STICKY = ", sticky: true"
_MOST_ROWS = 12
"""The rows up to which a table stays on one page."""

_HELD = 3
"""The rows at both ends of a longer one that stay on one page each."""

_APART = {"mat(": 0.25, "frac(": 0.15}
"""How far lines with these are apart, in em."""

_LAST_KNOWN = 0x2C00
_MATHEMATICAL = range(0x1D400, 0x1D800)

_PREAMBLE = """#set document(title: {title}, date: none)
#set page(paper: "a4", margin: (x: 2.2cm, top: 2cm, bottom: 1.7cm), header-ascent: 40%, header: context {
  if here().page() > 1 { text(8.5pt, fill: luma(90), [#emph({header}) #h(1fr) #counter(page).display()]) }
})
#set text(font: ({face}, "Libertinus Serif", "DejaVu Sans Mono"), size: 10pt, lang: "en")
#set par(leading: 0.52em, spacing: 0.55em)
#set math.mat(delim: "[", row-gap: 0.4em, column-gap: 0.9em)
#set math.equation(numbering: none)
#show heading: set text(hyphenate: false)
#show heading.where(level: 1): set text(size: 17pt)
#show heading.where(level: 2): it => block(above: 1.25em, below: .6em, sticky: true, text(13pt, it.body))
#show heading.where(level: 3): it => block(above: .9em, below: .45em, sticky: true, text(10.5pt, it.body))
#show link: set text(fill: rgb("#1a5a96"))
#let contents = block(above: 1.6em, breakable: false, {
  show outline.entry: set block(above: 0.5em)
  outline(title: none, target: heading.where(level: 2))
})
#let source(body) = text(size: 8.5pt, fill: luma(90), body)
#let displayed(body, ..options) = {
  set text(top-edge: "bounds", bottom-edge: "bounds")
  block(width: 100%, ..options, body)
}
#let formula(body, side, sticky: false) = displayed(
  above: 0.6em, below: 0.6em, breakable: false, sticky: sticky,
  grid(columns: (1fr, auto, 1fr), align: (left, center, right + horizon), [], body, side))
#let in-runs(runs, sticky, columns, ..options) = for (place, rows) in runs.enumerate() {
  let last = place == runs.len() - 1
  displayed(breakable: false, sticky: sticky and last, above: if place == 0 { 0.6em } else { 0.22em },
    below: if last { 0.6em } else { 0.22em },
    grid(columns: columns, row-gutter: 0.22em, ..options, ..rows.flatten()))
}
#let strut = box(width: 0pt, hide($lr(|, size: #1.5em)$))
#let right-aligned(width, body) = context h(width.to-absolute() - measure(body).width) + body
#let level-line(width, left, right) = strut + right-aligned(width, left) + h(0.28em) + right
#let formula-lines(sticky: false, ..runs) = context {
  let widest(part) = calc.max(..runs.pos().join().map(row => measure(row.at(part)).width))
  let (left-width, right-width) = (widest(0), widest(1))
  let row((left, right, apart, side)) = ([], pad(y: apart, level-line(left-width, left, right)), side)
  in-runs(runs.pos().map(rows => rows.map(row)), sticky, (1fr, left-width + right-width + 0.3em, 1fr),
    align: (left, left + horizon, right + horizon))
}
#let columned(count, indent, sticky: false, ..runs) = in-runs(runs.pos(), sticky,
  (indent * 1fr, ..(1fr / count,) * (count - 1), (1 / count - indent) * 1fr, 3em),
  align: (x, y) => if x > count { right + horizon } else { left + horizon })
#let closing(body) = v(1.25em, weak: true) + layout(size => {
  let needed = measure(block(width: size.width, body)).height
  let begun = calc.min(needed, (if needed > size.height { 0.2 } else { 0.35 }) * size.height)
  block(breakable: false, spacing: 0pt, height: begun)
  v(-begun - 1.25em) // the space above the heading is that before the block, which no page begins with
  body
})
#let contents = block(above: 1.4em, breakable: false, {
  set par(leading: 0.48em, spacing: 0.48em)
  outline(title: none, target: heading.where(level: 2))
})
#let note(body) = {
  block(inset: (left: 0.8em, y: 0.3em), stroke: (left: 1.5pt + luma(150)), text(9.3pt, body))
}
"""


def render(document: Document, style: Style = PLAIN, *further: tuple[Document, Style]) -> bytes:
    """A PDF, the same bytes for the same document; `further` ones stand behind it, each in its own style.

    Raises UsageError where the extra `pdf` is not installed.
    """
    try:
        import typst
    except ImportError:
        raise UsageError("PDF needs the extra [pdf]: pip install 'dynsolve[pdf]'") from None
    source = to_typst_document(document, style, *further).encode()
    pdf: bytes = typst.compile(source, format="pdf", ignore_system_fonts=True, timestamp=0)
    return pdf


def to_typst_document(document: Document, style: Style = PLAIN, *further: tuple[Document, Style]) -> str:
    """The source of a complete Typst document; of those behind it one that has a title begins a page."""
    title = next((visible(b.text) for b in document.blocks if isinstance(b, Heading)), "")
    page = _Page(style, document)
    texts = {"{title}": quoted(title), "{header}": quoted(_known(running_title(title)))}
    texts["{face}"] = quoted(_FACE)
    preamble = re.sub("|".join(texts), lambda found: texts[found[0]], _PREAMBLE)
    body = [*page.all(document)]
    for other, its in further:
        body += ["#pagebreak()"] if other.is_titled else []
        page = _Page(its, other)
        page.closing = () if other is not further[-1][0] else page.closing
        body += page.all(other)
    return preamble + "\n".join(body) + "\n"


def _fence(sign: str, height: float) -> str:
    """A parenthesis of a height in em."""
    return f"lr(size: #{height:.2f}em, \\{sign})" if height > FLAT else f"\\{sign}"


def _joined(texts: Sequence[str]) -> str:
    """Parts of a formula beside each other; blanks of the source would widen those between words."""
    whole = ""
    for text in texts:
        between_words = whole.endswith('"') or text.startswith('"')
        whole += ("" if between_words or not whole else " ") + text
    return whole


def typst_notation(printer: TypstPrinter) -> Notation:
    """The signs of a formula in Typst."""
    return Notation(
        text=printer.text,
        plus='class("binary", +)',
        minus='class("binary", -)',
        lead="-",
        times='class("binary", dot.op)',
        relation=lambda sign: "\\/" if sign == "/" else sign,  # unescaped it sets a fraction
        fence=_fence,
        raised=lambda sign, exponent: f"{sign}^({exponent})",
        joined=_joined,
    )


class _Printer(TypstPrinter):
    """Typst's mathematics for a page: fractions in a matrix are as large as beside it.

    Entries do not touch the brackets, nor fractions those of the next row.
    """

    def parenthesized(self, text: str) -> str:
        """The text in parentheses, which are larger than those in it."""
        whole = super().parenthesized(text)
        height = height_around(text, _fence)
        if height == FLAT or not whole.startswith("\\("):
            return whole
        return f"{_fence('(', height)} {text} {_fence(')', height)}"

    def _bracketed(self, rows: Sequence[Sequence[str]]) -> str:
        shown = [[_displayed(cell) if "frac(" in cell else cell for cell in row] for row in rows]
        high = any("frac(" in cell for row in rows for cell in row)
        gap = "row-gap: #0.8em, " if high else ""
        body = "; ".join(map(", ".join, shown))
        return f"lr([#h(0.12em) mat(delim: #none, {gap}{body}) #h(0.12em)])"


class _Page(TypesetPage):
    """Turns blocks into Typst."""

    def __init__(self, style: Style, document: Document) -> None:
        printer = _Printer(style)
        super().__init__(printer, typst_notation(printer), numbered(document), PAGE, _NUMBER)
        self.contents_are_due = is_long(document)
        self.sticks = False
        """Whether the block that is written stays on the page of the next."""
        self.close(document)

    def all(self, document: Document) -> Iterator[str]:
        """The blocks of a document; the closing ones begin a page where little is left of the one before."""
        before, end = before_closing(document.blocks)
        yield from self.blocks(before)
        if end:
            yield "#closing["
            yield from self.blocks(end)
            yield "]"

    def blocks(self, blocks: Iterable[Block]) -> Iterator[str]:
        """The blocks, in a sticky block what stays on the page of the next."""
        listed = list(blocks)
        pairs = zip_longest(listed, listed[1:])
        for are_level, run in groupby(pairs, lambda pair: self.is_level(pair[0])):
            shown = list(run)
            if are_level and len(shown) > 1:
                self.sticks = self.closes(shown[-1][0]) or introduces(*shown[-1])
                yield from self.results([block for block, _ in shown if isinstance(block, Formula)])
                continue
            for block, following in shown:
                closes = following is listed[-1] and self.is_lost(following)
                self.sticks = self.closes(block) or introduces(block, following, closes)
                yield from self.stuck(block)

    def is_level(self, block: Block) -> bool:
        """Whether a block is a result that is level with others beside it."""
        return isinstance(block, Formula) and self.level_result(block) is not None

    def results(self, formulas: Sequence[Formula]) -> Iterator[str]:
        """Results of one line each in one display, each with its number."""
        lines = [line for formula in formulas if (line := self.level_result(formula))]
        sides = [self.side(formula) for formula in formulas]
        yield _display(lines, sides, self.kept(formulas[-1]), self.sticks)

    def stuck(self, block: Block) -> Iterator[str]:
        """A block, in a sticky one where it stays on the page of the next and cannot be sticky itself."""
        if self.sticks and not isinstance(block, Formula | Equations | Heading | Fold):
            yield "#block(sticky: true, width: 100%)["
            yield from self.block(block)
            yield "]"
        else:
            yield from self.block(block)

    def heading(self, heading: Heading) -> Iterator[str]:
        if heading.level == 2 and self.contents_are_due:
            self.contents_are_due = False
            yield "#contents"
        yield f"#heading(level: {heading.level})[{self.words(heading.text)}]"

    def text(self, text: Text) -> Iterator[str]:
        yield f"{self.prose(text.parts)}\n"

    def formula(self, formula: Formula) -> Iterator[str]:
        yield from self.equations(formula)

    def equations(self, equations: Formula | Equations) -> Iterator[str]:
        columns = self.columns(equations)
        if columns is not None:
            yield _in_columns(columns, self.side(equations), self.kept(equations), self.sticks)
        elif lines := self.lines_of(equations):
            sides = [*[""] * (len(lines) - 1), self.side(equations)]
            yield _display(lines, sides, self.kept(equations), self.sticks)

    def side(self, display: Formula | Equations) -> str:
        """What stands beside a display: its number, which others refer to, or its source."""
        if number := self.labels.get(display.label):
            return f"({number})#metadata(none) <eq-{display.label}>"
        source = display.source if isinstance(display, Formula) else ""
        return f"#source[{self.words(source)}]" if source else ""

    def whole_or_pieces(self, node: Node) -> str:
        """A formula in boxes between which a line may end: one, or several outside its parentheses."""
        if self.ruler.width(node) <= SHORT:
            return f"#box(${self.printer.text(node)}$)"
        pieces = together(FormulaSplitter(self.notation, self.ruler).pieces(node), PART, " ".join)
        return " ".join(f"#box(${piece.text}$)" for piece in pieces)

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
        cells = [[self.cell(cell) for cell in row] for row in (table.header, *table.rows)]
        widths = "auto, " * len(table.header)
        breakable = "false"
        if len(table.rows) > _MOST_ROWS:
            widths, breakable = f"0pt, {widths}", "true"
            cells = [[*held, *row] for held, row in zip(_held(len(table.rows)), cells, strict=True)]
        header, *rows = map(", ".join, cells)
        side = "left" if prose_columns(table) else "center + horizon"
        yield (
            f"#block(breakable: {breakable}, width: 100%, "
            f"align(center, table(columns: ({widths}), stroke: none, align: {side}, "
            f"inset: (x: 0.8em, y: 0.35em), "
            f"table.header({header}, table.hline(stroke: 0.5pt)), {', '.join(rows)})))"
        )

    def cell(self, cell: Inline) -> str:
        """A cell of a table; around a fraction there is room to the rows beside it."""
        if isinstance(cell, Node) and self.ruler.height(cell) > FLAT:
            return f"table.cell(inset: (x: 0.8em, y: 0.6em), block(${_displayed(self.printer.text(cell))}$))"
        return f"[{self.part(cell)}]"

    def picture(self, picture: Picture) -> Iterator[str]:
        svg = re.sub('font-family="[^"]*"', f'font-family="{_FACE}"', picture.svg, count=1)
        image = f'image(bytes({quoted(svg)}), format: "svg")'
        yield f"#align(center)[#{image} #text(size: 9pt)[{self.words(picture.caption)}]]"

    def escaped(self, text: str) -> str:
        """Words as a string, so that nothing in them is markup."""
        return f"#{quoted(_known(typographic(text)))};"

    def verbatim(self, text: str) -> str:
        return f"#raw({quoted(visible(text))});"


def _held(count: int) -> Iterator[list[str]]:
    """The first cells of a table on several pages: two hold its first and its last rows each on one page."""
    holds = f"table.cell(rowspan: {_HELD}, breakable: false, inset: 0pt)[]"
    yield ["[]"]
    for row in range(count):
        if row in (0, count - _HELD):
            yield [holds]
        else:
            yield ["[]"] if _HELD <= row < count - _HELD else []


def _displayed(text: str) -> str:
    return f"display({text})"


def _display(lines: Sequence[Line], sides: Sequence[str], last: int, sticks: bool) -> str:
    """Formulas in the middle of the page, `sides` at the ends of their lines; they may stick to the next.

    A page may end between two lines, but not in so many at the end.
    """
    if len(lines) == 1:
        return f"#formula({_math(lines[0].alone)}, [{sides[0]}]{_STICKY * sticks})"
    rows = []
    rights = list(map(_right, lines))
    for line, right, apart, side in zip(lines, rights, _apart(rights), sides, strict=True):
        rows.append(f"({_math(line.left)}, {_math(right)}, {apart}em, [{side}])")
    runs = _in_runs(rows, list(map(_begins, lines)), last, ["mat(" in right for right in rights])
    return f"#formula-lines({runs}{_STICKY * sticks})"


def _apart(lines: Iterable[str]) -> Iterator[float]:
    """How far each line is kept from the one above, in em.

    Two matrices would look like one, and a denominator would touch the numerator below it.
    """
    above = 0.0
    for line in lines:
        height = next((apart for sign, apart in _APART.items() if sign in line), 0.0)
        yield min(height, above)
        above = height


def _begins(line: Line) -> bool:
    """Whether an equation begins with a line, or equations side by side, which have no name on the left."""
    return bool(line.left) or not line.name


def _in_runs(rows: Sequence[str], begins: Sequence[bool], last: int, tall: Sequence[bool] = ()) -> str:
    """The rows of a display in runs in which no page ends; each run is an array of rows."""
    left = iter(rows)
    runs = [islice(left, count) for count in runs_of_equations(begins, last, tall)]
    return ", ".join(f"({', '.join(run)},)" for run in runs)


def _in_columns(columns: Columns, side: str, last: int, sticks: bool) -> str:
    """Equations in columns, `side` at the end of the last row."""
    rows: list[list[str]] = []
    rights = (" ".join(_right(cell.line) for cell in row) for row in columns.rows)
    for row, apart in zip(columns.rows, _apart(rights), strict=True):
        cells = ["[]"]
        for cell in row:
            left_right = f"{_math(cell.line.left)}, {_math(_right(cell.line))}"
            line = f"pad(y: {apart}em, level-line({columns.name:.2f}em, {left_right}))"
            cells.append(f"grid.cell(colspan: {cell.span}, {line})")
        if rest := columns.count - sum(cell.span for cell in row):
            cells.append(f"grid.cell(colspan: {rest}, [])")
        rows.append([*cells, "[]"])
    rows[-1][-1] = f"[{side}]"
    runs = _in_runs([f"({', '.join(row)})" for row in rows], columns.begins, last)
    return f"#columned({columns.count}, {columns.indent:.4f}, {runs}{_STICKY * sticks})"


def _right(line: Line) -> str:
    return (f"#h({line.indent}em) " if line.indent else "") + line.right


def _math(text: str) -> str:
    """A formula as large as in a display, though it does not stand in one by itself."""
    return f"${_displayed(text)}$" if text else "none"


def _known(text: str) -> str:
    """A letter that the fonts inside Typst lack stands as its code point."""
    if text.isascii():
        return text
    return "".join(
        c if ord(c) < _LAST_KNOWN or ord(c) in _MATHEMATICAL else f"[U+{ord(c):04X}]" for c in text
    )
