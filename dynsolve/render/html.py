"""Documents -> one HTML file: MathML, no script, and nothing that is fetched.

A displayed formula is a row of pieces between which the browser breaks lines, so that
it fits a phone.  A matrix stays one and is scrolled where the page is narrow; only one
that no page shows whole is given entry by entry.

What a browser knows is how wide its window is; what it does not know is which places to prefer.
So a part that is to stay whole where a line holds it is a box with lines of its own, and what is wide
for a phone is put together for that width.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator, Mapping, Sequence
from functools import cache
from html import escape
from importlib.resources import files
from itertools import chain, takewhile

from msgspec import Struct, field
from msgspec.structs import replace

from dynsolve.document import Document, Equations, Fold, Formula, Heading, Inline, Picture, Prose, Table, Text
from dynsolve.notation.extent import FLAT, Ruler
from dynsolve.notation.markup import MINUS, MathMLPrinter, row
from dynsolve.notation.printing import PLAIN, Style
from dynsolve.notation.tree import Matrix, Node, Relation, Row, Words
from dynsolve.render.line_breaking import (
    RELATION_BREAK,
    SUM_BREAK,
    FormulaSplitter,
    Notation,
    Piece,
    height_around,
    numbered,
    together,
    with_results,
)
from dynsolve.render.page import MarkupPage, prose_columns
from dynsolve.render.prose import typographic, visible
from dynsolve.render.terminal_boxes import entry_equations, holds_matrix
from dynsolve.render.typesetting import fitting, listed

PHONE = 16.5
"""What fits a phone beside a number, in em."""

LINE = 20.0
"""What fits a phone where the number stands below."""

SCROLLED = 24.0
"""What no phone shows whole, even on a line of its own."""

PAGE = 44.0
"""What fits the widest page."""

_SHORT_SIDE = 3.0
"""The width of a left side that stays with what follows in a sentence."""

_INDENT = 2.0
"""How much less a line of a phone holds in a box of its own."""


def math(text: str, display: bool = False) -> str:
    """Elements as a formula of their own."""
    return f'<math displaystyle="true">{text}</math>' if display else f"<math>{text}</math>"


# -- the notation -----------------------------------------------------------------------------------


def _fence(sign: str, height: float) -> str:
    """A parenthesis of a height in em."""
    if height <= FLAT:
        return f'<mo stretchy="false">{sign}</mo>'
    size = f'minsize="{height:.2f}em" maxsize="{height:.2f}em"'
    form = "prefix" if sign == "(" else "postfix"
    return f'<mo form="{form}" stretchy="true" symmetric="true" {size}>{sign}</mo>'


class PagePrinter(MathMLPrinter):
    """MathML for a page: parentheses are larger than those in them."""

    def parenthesized(self, text: str) -> str:
        """The text in parentheses."""
        whole = super().parenthesized(text)
        height = height_around(text, _fence)
        if height == FLAT or "stretchy" not in whole.partition(">")[0]:
            return whole
        return row(f"{_fence('(', height)}{text}{_fence(')', height)}")


def html_notation(printer: MathMLPrinter) -> Notation:
    """The signs of a formula in MathML."""
    return Notation(
        text=printer.text,
        plus='<mo form="infix">+</mo>',
        minus='<mo form="infix">\u2212</mo>',
        lead=MINUS,
        times='<mo form="infix">·</mo>',
        relation=lambda sign: f'<mo form="infix">{escape(sign)}</mo>',
        fence=_fence,
        raised=lambda sign, exponent: f"<msup>{row(sign)}{row(exponent)}</msup>",  # alone it is stretched
        joined="".join,
    )


# -- displayed formulas -----------------------------------------------------------------------------


def laid_out(parts: Sequence[Piece], room: float) -> str:
    """The pieces of a formula, between which a line may end; `room` is what a line of a phone holds.

    A left side of several pieces takes a right side of one with it; another left side stays with what
    no line of a phone holds, and an equation of two members is broken before the terms of the second.
    """
    members = sum(part.depth == RELATION_BREAK for part in parts)
    if members == 2 and len(parts) > 2 and parts[-1].depth == RELATION_BREAK:
        terms = min(part.depth for part in parts[1:-1])
        return _nested([*parts[:-1], replace(parts[-1], depth=terms)])
    if members < 2 or parts[1].depth > RELATION_BREAK:
        return _nested(parts)
    left, right, *rest = parts
    inside = list(takewhile(lambda part: part.depth > RELATION_BREAK, rest))
    own = (part for part in inside if part.level == 0)  # terms, and factors that are matrices; no unit
    terms = min((part.depth for part in own if part.depth == SUM_BREAK or part.sign), default=RELATION_BREAK)
    head = right.width + sum(part.width for part in takewhile(lambda part: part.depth > terms, inside))
    width = left.width + right.width
    is_broken = inside and head > room >= width
    is_scrolled = right.width > (room if left.width <= _SHORT_SIDE else SCROLLED)
    if is_scrolled or is_broken or (inside and members > 2 and left.width + head <= room):
        parts = [replace(left, text=left.text + right.text, width=width), *rest]
    return _nested(parts, terms if members == 2 else RELATION_BREAK)


def _nested(parts: Sequence[Piece], depth: int = RELATION_BREAK, room: float = LINE) -> str:
    """Pieces between which a line may end; one with the deeper ones after it is a box with lines of its own.

    So a browser, which looks at no depth, breaks a chain at its equals signs, and a member of it,
    or what is in parentheses, only where no line holds that whole.

    >>> _nested([Piece("a", 1), Piece("=b", 2), Piece("=c", 2), Piece("+d", 2, 1)])
    '<math displaystyle="true">a</math><wbr><math displaystyle="true">=b</math><wbr>\
<span class="whole"><math displaystyle="true">=c</math><wbr><math displaystyle="true">+d</math></span>'
    """
    width = sum(part.width for part in parts)
    groups: list[list[Piece]] = []
    for part in parts:
        if groups and part.depth > depth:
            groups[-1].append(part)
        else:
            groups.append([_multiplied(part, width, room) if groups else part])
    return "<wbr>".join(_grouped(group, room) for group in groups)


def _multiplied(part: Piece, width: float, room: float) -> Piece:
    """A piece of a box so wide; a matrix before which a line may end has a product sign.

    Where that is a line of a phone alone, the sign is seen there alone.
    """
    if not part.sign or width <= room:
        return part
    sign = part.sign if width > PAGE else f'<mrow class="broken">{part.sign}</mrow>'
    return replace(part, text=sign + part.text)


def _grouped(group: Sequence[Piece], room: float) -> str:
    first, *deeper = group
    if not deeper:
        return math(first.text, display=True)
    inside = _nested(group, min(part.depth for part in deeper), room - _INDENT)
    return f'<span class="whole">{inside}</span>'


# -- formulas in sentences --------------------------------------------------------------------------


def in_sentence(parts: Sequence[Piece]) -> Iterator[str]:
    """Formulas between which a line may end; a short left side stays with what follows.

    The space before a sign ends the line before it.

    >>> for text in in_sentence([Piece("<mi>d</mi>", 4), Piece('<mo form="infix">=</mo><mi>m</mi>', 9)]):
    ...     print(text)
    <math><mi>d</mi><mspace width="0.28em"/></math>
    <math><mo form="infix" lspace="0">=</mo><mi>m</mi></math>
    """
    first, *rest = parts
    if rest and first.width <= _SHORT_SIDE and first.width + rest[0].width <= PHONE:
        first, rest = replace(first, text=first.text + rest[0].text), rest[1:]
    texts = [part.text for part in (first, *rest)]
    sign = '<mo form="infix">'
    for k, text in enumerate(texts):
        begun = text.replace(sign, '<mo form="infix" lspace="0">', 1) if k and text.startswith(sign) else text
        is_followed = k + 1 < len(texts) and texts[k + 1].startswith(sign)
        yield math(begun + '<mspace width="0.28em"/>' * is_followed)


_SHORT_CELL = 6
"""The letters of a cell of a table up to which it is never broken."""

_HENCE = ", so "
"""The words of a row whose formulas follow from each other."""

_FINE = 6.0
_FRACTION = 13.0
_WHOLE = 13.0
_FEWEST, _FEW, _COLUMN = 4, 12, 20.0
"""From how many equations on columns are made: of narrow ones, of any; and what a column holds, in em."""

_COMMA, _AND_SO_ON = Words(","), Words(", …, ")
_SIGN = re.compile(r"(?:([<>=]) )?([-\u2212])?(\d+)")
"""A cell of a table that is a number, or what one is compared with."""
_SIGN_PARTS = ("<mo>{}</mo>".format, MINUS.format, "<mn>{}</mn>".format)
_DOUBLE_NAME = re.compile(r"\b[A-Z][a-z]+-[A-Z][a-z]+\b")
_CLOSED_FORMULA = re.compile(r"<math>(?:(?!</math>).)*</math>(?:[.,:;)]+|-\w+)")


def render(
    document: Document,
    style: Style = PLAIN,
    ruler: Ruler | None = None,
    further: Sequence[tuple[Document, Style]] = (),
) -> str:
    """A page that is complete in itself; `ruler` knows widths of its formulas already.

    `further` documents stand behind it, each in its own style.
    """
    behind = "".join(
        f"<hr>\n{_Page(_Formulas(its), other, f'behind-{k}-').all()}"
        for k, (other, its) in enumerate(further)
    )
    return _file(document, f"<main>\n{_Page(_Formulas(style, ruler), document).all()}{behind}</main>")


def render_choice(documents: Mapping[str, Document], style: Style, chosen: str) -> str:
    """A page that shows one of several documents, by style alone: first the one named `chosen`."""
    formulas = _Formulas(style)
    inputs = "".join(
        f'<input type="radio" name="depth" id="{name}"{" checked" if name == chosen else ""}>'
        f'<label for="{name}">{name.capitalize()}</label>'
        for name in documents
    )
    pages = "".join(
        f'<article class="{name}">\n{_Page(formulas, document, f"{name}-").all()}</article>\n'
        for name, document in documents.items()
    )
    return _file(documents[chosen], f'<div class="depths">{inputs}</div>\n<main>\n{pages}</main>')


def render_folded(document: Document, folded: Document, title: str, style: Style) -> str:
    """A document and another one folded behind it, as a part of a page that has styles of its own."""
    formulas = _Formulas(style)
    first, second = (
        _Page(formulas, each, f"dynsolve-{k}-").all() for k, each in enumerate((document, folded))
    )
    return f"<div>\n{first}<details><summary>{escape(title)}</summary>\n{second}</details>\n</div>\n"


def _file(document: Document, body: str) -> str:
    title = next((visible(b.text) for b in document.blocks if isinstance(b, Heading)), "")
    return whole_page(escape(title), "img-src data:", stylesheet(), body)


def whole_page(title: str, policy: str, style: str, body: str) -> str:
    """A page that fetches nothing; its `policy` says what else than its styles it may use."""
    return (
        '<!DOCTYPE html>\n<html lang="en">\n<head>\n<meta charset="utf-8">\n'
        '<meta http-equiv="Content-Security-Policy" content="default-src \'none\'; '
        f"style-src 'unsafe-inline'; {policy}\">\n"
        '<meta name="viewport" content="width=device-width, initial-scale=1">\n'
        '<meta name="color-scheme" content="light dark">\n<link rel="icon" href="data:,">\n'
        f"<title>{title}</title>\n<style>\n{style}</style>\n</head>\n<body>\n"
        f"{body}\n</body>\n</html>\n"
    )


@cache
def stylesheet() -> str:
    """The styles that every page holds."""
    return (files("dynsolve.render") / "report.css").read_text(encoding="utf-8")


class _Entry(Struct):
    """A line of the table of contents."""

    anchor: str
    text: str
    steps: list[tuple[str, str]] = field(default_factory=list)


class _Formulas:
    """Formulas in MathML, each printed once however often a page has it."""

    def __init__(self, style: Style, ruler: Ruler | None = None) -> None:
        self.printer = PagePrinter(style)
        self.ruler = Ruler(style) if ruler is None else ruler
        self.text = cache(self.printer.text)
        self.pieces = cache(FormulaSplitter(html_notation(self.printer), self.ruler, _FINE, _FRACTION).pieces)


class _Page(MarkupPage):
    """Turns a document into HTML, with `prefix` before its anchors, and remembers what the contents need."""

    def __init__(self, formulas: _Formulas, document: Document, prefix: str = "") -> None:
        super().__init__(formulas.printer, numbered(document))
        self.formulas, self.ruler = formulas, formulas.ruler
        self.prefix = prefix
        self.document = document
        self.entries: list[_Entry] = []

    def all(self) -> str:
        """The document, its contents before the first section."""
        opening, mark, sections = "".join(self.sections()).partition("<section ")
        return f"{opening}{self.contents()}{mark}{sections}"

    def sections(self) -> Iterator[str]:
        """The blocks, those under a heading in a section; of an appendix they are folded away."""
        end = ""
        for block in self.document.blocks:
            if isinstance(block, Heading) and block.level > 1:
                anchor = f"{self.prefix}part-{len(self.entries) + 1}"
                self.entries.append(_Entry(anchor, self.title(block.text)))
                yield f'{end}<section id="{anchor}">\n'
                end = "</section>\n"
                if block.appendix:
                    yield f"<details><summary>{''.join(self.block(block))}</summary>\n"
                    end = f"</details>\n{end}"
                    continue
            yield from self.block(block)
        yield end

    def heading(self, heading: Heading) -> Iterator[str]:
        level = heading.level
        yield f'<h{level} dir="auto">{self.title(heading.text)}</h{level}>\n'

    def title(self, text: str) -> str:
        """The words of a heading, in which no line ends within a double name."""
        return _DOUBLE_NAME.sub(r'<span class="one">\g<0></span>', self.words(text))

    def prose(self, parts: Prose) -> str:
        """A sentence, in which no line begins with the comma or the stop after a formula."""
        return _CLOSED_FORMULA.sub(r'<span class="one">\g<0></span>', super().prose(parts))

    def text(self, text: Text) -> Iterator[str]:
        yield f'<p class="why" dir="auto">{self.prose(text.parts)}</p>\n'

    def equations(self, equations: Equations) -> Iterator[str]:
        room = PHONE if equations.label else LINE
        lines = "".join(self.broken(node, room) for node in equations.nodes)
        columns = " columns" if equations.in_columns and self.fit_columns(equations.nodes) else ""
        label = equations.label
        kind = "result" if label else "work"
        yield f'<div class="formula {kind}"{self.anchor(label)}><div class="box{columns}">{lines}</div>'
        yield f"{self.number(label)}</div>\n"

    def anchor(self, label: str) -> str:
        """Where references to a display lead."""
        return f' id="{self.prefix}eq-{label}"' if label else ""

    def reference(self, label: str, number: int) -> str:
        return f'<a href="#{self.prefix}eq-{label}">{super().reference(label, number)}</a>'

    def uses(self, sentence: str) -> Iterator[str]:
        yield f'<p class="uses" dir="auto">{sentence}</p>\n'

    def list(self, items: Sequence[Prose]) -> Iterator[str]:
        yield "<ul>" + "".join(f"<li>{self.prose(item)}</li>" for item in items) + "</ul>\n"

    def note(self, parts: Prose) -> Iterator[str]:
        yield f'<p class="note"><strong>Note.</strong> {self.prose(parts)}</p>\n'

    def table(self, table: Table) -> Iterator[str]:
        prose = prose_columns(table)
        head = "".join(self.cells(table.header, prose, "th"))
        rows = "".join(f"<tr>{''.join(self.cells(row, prose))}</tr>" for row in table.rows)
        yield (
            f'<div class="scroll"><table><thead><tr>{head}</tr></thead><tbody>{rows}</tbody></table></div>\n'
        )

    def cells(self, cells: Sequence[Inline], prose: Collection[int], tag: str = "td") -> Iterator[str]:
        """A row of a table."""
        for k, cell in enumerate(cells):
            if k in prose:
                yield f'<{tag} class="words">{self.prose((cell,))}</{tag}>'
            else:
                yield f"<{tag}>{self.cell(cell)}</{tag}>"

    def cell(self, cell: Inline) -> str:
        """What is no sentence in a table: signs or units, a number, or words; few stay on one line."""
        if isinstance(cell, Node):
            *before, last = map(self.inline, _between_commas(cell))
            return " ".join([*(f'<span class="one">{each},</span>' for each in before), last])
        if isinstance(cell, str) and (sign := _SIGN.fullmatch(cell)):
            parts = zip(_SIGN_PARTS, sign.groups(), strict=True)
            return math("".join(write(escape(part)) for write, part in parts if part))
        text = self.prose((cell,))
        is_short = isinstance(cell, str) and len(cell) <= _SHORT_CELL
        return f'<span class="one">{text}</span>' if is_short else text

    def picture(self, picture: Picture) -> Iterator[str]:
        caption = self.words(picture.caption)
        yield f"<figure>{picture.svg}<figcaption>{caption}</figcaption></figure>\n"

    def fold(self, fold: Fold) -> Iterator[str]:
        title = self.words(fold.title)
        anchor = f"{self.prefix}step-{sum(len(entry.steps) for entry in self.entries) + 1}"
        if self.entries:
            self.entries[-1].steps.append((anchor, title))
        yield f'<details open class="step" id="{anchor}"><summary>{title}</summary>\n'
        yield from self.blocks(with_results(fold.blocks))
        yield "</details>\n"

    def escaped(self, text: str) -> str:
        return escape(typographic(text))

    def verbatim(self, text: str) -> str:
        return f'<code dir="auto">{escape(visible(text))}</code>'

    def inline(self, node: Node) -> str:
        """A formula in a sentence; a long one may be broken."""
        if self.ruler.width(node) <= 0.8 * PHONE:
            return math(self.formulas.text(node))
        return "<wbr>".join(in_sentence(together(self.formulas.pieces(node), _WHOLE, "".join)))

    # -- displayed formulas ------------------------------------------------------------------------

    def formula(self, formula: Formula) -> Iterator[str]:
        found = fitting(formula, lambda node: self.widest(node) <= PAGE)
        if found is None:
            return
        formula = found
        label = formula.label
        kind = "result" if label else "law" if formula.source else "work"
        is_wide = self.ruler.width(formula.node) > PHONE and self.widest(formula.node) > PHONE
        kind += " wide" * is_wide
        beside = self.number(label)
        if formula.source:
            beside = f"<cite>{self.words(formula.source)}</cite>{beside}"
        yield f'<div class="formula {kind}"{self.anchor(label)}><div class="box">'
        yield from self.lines(formula.node, formula, LINE if is_wide or not beside else PHONE)
        yield f"</div>{beside}</div>\n"

    def number(self, label: str) -> str:
        """The number beside a formula that has a label."""
        return f'<span class="n">({self.labels[label]})</span>' if label else ""

    def lines(self, node: Node, formula: Formula, room: float) -> Iterator[str]:
        """A formula on the page: whole, or in pieces; a matrix that no page shows whole, entry by entry.

        A phone has so much `room`, in em, for what is not broken.
        """
        width = self.ruler.width(node)
        if width <= PHONE:
            yield f'<div class="line">{math(self.formulas.text(node), display=True)}</div>'
            return
        matrix = node.parts[-1] if isinstance(node, Relation) else node  # what the formula gives
        widest = self.widest(node)
        beside = list(listed(node)) if isinstance(node, Row) else []
        if widest > PAGE and len(beside) > 1 and not formula.optional:
            for part in beside:
                yield from self.lines(part, formula, room)
        elif widest <= PAGE or not isinstance(matrix, Matrix):
            yield self.broken(node, room)
        else:
            yield from self.entry_by_entry(node, matrix, formula)

    def widest(self, node: Node) -> float:
        """The width of the widest part that cannot be broken; of a matrix wider than any page its own."""
        given = node.parts[-1] if isinstance(node, Relation) else node
        if isinstance(given, Matrix) and (width := self.ruler.width(given)) > PAGE:
            return width
        return max(piece.width for piece in self.formulas.pieces(node))

    def broken(self, node: Node, room: float = PHONE) -> str:
        """A formula in pieces; of several side by side each is broken only where a line cannot hold it."""
        beside = list(listed(node)) if isinstance(node, Row) and Words(_HENCE) not in node.parts else []
        if len(beside) < 2:
            return f'<div class="line">{self.in_pieces(node, room)}</div>'
        comma = math(self.printer.text(Words(",")))
        *before, last = (self.in_pieces(each, room) for each in beside)
        parts = [*(f'<span class="one">{part}{comma}</span>' for part in before), last]
        spans = "".join(f'<span class="part">{part}</span>' for part in parts)
        return f'<div class="line">{spans}</div>'

    def in_pieces(self, node: Node, room: float) -> str:
        """A formula between whose pieces a line may end."""
        return laid_out(together(self.formulas.pieces(node), _WHOLE, "".join), room)

    def entry_by_entry(self, node: Node, matrix: Matrix, formula: Formula) -> Iterator[str]:
        left = node.parts[0] if isinstance(node, Relation) else None
        if isinstance(node, Relation) and len(node.parts) > 2 and not any(map(holds_matrix, node.parts[:-1])):
            yield self.broken(Relation(node.parts[:-1], node.signs[:-1]))
        chains = list(entry_equations(matrix, left, formula, self.ruler.style))
        yield '<div class="columns">' if self.fit_columns(chains) else "<div>"
        yield from map(self.broken, chains)
        yield "</div>"

    def fit_columns(self, nodes: Sequence[Node]) -> bool:
        """Whether equations stand in columns: many, or such as a column holds on one line."""
        are_narrow = all(self.ruler.width(node) <= _COLUMN for node in nodes)
        return len(nodes) > _FEW or (are_narrow and len(nodes) >= _FEWEST)

    def contents(self) -> str:
        """The table of contents, where there is more than one part."""
        items = []
        for entry in self.entries:
            steps = "".join(f'<li><a href="#{anchor}">{title}</a></li>' for anchor, title in entry.steps)
            link = f'<a href="#{entry.anchor}">{entry.text}</a>'
            inner = f"<details><summary>{link}</summary><ul>{steps}</ul></details>" if steps else link
            items.append(f"<li>{inner}</li>")
        listed_items = "\n".join(items)
        nav = f'<nav aria-label="Contents"><h2>Contents</h2><ul>{listed_items}</ul></nav>\n'
        return nav if len(items) > 1 else ""


def _between_commas(cell: Node) -> list[Node]:
    """What stands between the commas of a cell: signs, or units."""
    if isinstance(cell, Words):
        return [Words(text) for text in cell.text.split(", ")]
    if not isinstance(cell, Row):
        return [cell]
    parts = ((_COMMA, Words("…"), _COMMA) if part == _AND_SO_ON else (part,) for part in cell.parts)
    return list(listed(Row(tuple(chain.from_iterable(parts)))))
