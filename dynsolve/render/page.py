"""The base of every format: a `Page` turns the blocks of a document into pieces of the format.

To add a format, write a file with a `render` function and a page that derives from `Page`,
or from `TypesetPage` where lines are broken here and not by whoever shows them; its methods
are one for each kind of block and one for each kind of thing in a sentence.  A solution has
it once it stands in `render.files` and `solution.reports`.

Where a page may end, in what is set on pages: not at a few lines of a display, or of a document.

Paragraphs stay with the display that they introduce, a long one not with a table, a formula of the
textbook with the display it leads to, a short one with its result, but not with a matrix, a note with what
it is about, the last of several results with the one before.  The rows of an equation stay together, of a
long one the first two and the last ones, as do those of a display.  So many rows at the end of a
document are on one page that none is nearly empty.

Fractions in a line of words have a stroke, m l²/12: stacked ones are small there, and part the lines.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from itertools import accumulate, pairwise
from typing import Generic, TypeVar

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
    Reference,
    Table,
    Text,
    Uses,
    Verbatim,
)
from dynsolve.notation.extent import Ruler
from dynsolve.notation.formulas import FormulaPrinter
from dynsolve.notation.tree import (
    Cross,
    Derivative,
    Letter,
    Negative,
    Node,
    Number,
    Parenthesized,
    Power,
    Product,
    Quotient,
    Relation,
    Row,
    Slashed,
    Sum,
    Symbol,
    Transpose,
    Words,
    walk,
    with_children,
)
from dynsolve.render.line_breaking import Notation, after_references, runs, unfolded, with_results
from dynsolve.render.prose import ProseWriter
from dynsolve.render.terminal_boxes import height, holds_matrix
from dynsolve.render.typesetting import (
    FEWEST,
    FEWEST_SHORT,
    GAP,
    MOST_COLUMNS,
    Columns,
    Line,
    Typesetter,
    in_columns,
    listed,
)

# Where a page may end, in what is set on pages

LAST_OF_DISPLAY = 3
LAST_OF_DOCUMENT = 8
_ENOUGH = 5
"""The rows of a last page to which no matrices are added, which would leave a gap on the page before."""

_TALL = 3
"""So many rows a row with a matrix counts for: after it a page may end sooner."""

_FIRST = 2
_LONG = 350
"""A paragraph of more letters need not stay with a table."""


def runs_of_rows(count: int, last: int = LAST_OF_DISPLAY) -> tuple[int, ...]:
    """The rows of a display, in runs in which no page ends.

    >>> runs_of_rows(7), runs_of_rows(5)
    ((2, 1, 1, 3), (2, 3))
    """
    if count < _FIRST + last:
        return (count,)
    return (_FIRST, *[1] * (count - _FIRST - last), last)


def runs_of_equations(
    begins: Sequence[bool], last: int = LAST_OF_DISPLAY, tall: Sequence[bool] = ()
) -> tuple[int, ...]:
    """The same for a display of several equations; `begins` says with which rows one begins.

    Rows with matrices are `tall`.

    >>> runs_of_equations([True] * 3 + [False] + [True] * 4)
    (2, 2, 1, 1, 2)
    >>> runs_of_equations([True, False, False], tall=[False, True, True])
    (2, 1)
    >>> runs_of_equations([True] + [False] * 6)
    (2, 1, 1, 3)
    """
    if any(tall):
        sizes = [_TALL if high else 1 for high in tall]
        counted = [begun and not k for begun, n in zip(begins, sizes, strict=True) for k in range(n)]
        ends = {*accumulate(runs_of_equations(counted, last))}
        rows = [row for row, end in enumerate(accumulate(sizes), 1) if end in ends]
        return tuple(end - start for start, end in pairwise([0, *rows]))
    starts = [row for row, begun in enumerate(begins) if begun or not row]
    sizes = [end - start for start, end in zip(starts, [*starts[1:], len(begins)], strict=True)]
    runs = [run for size in sizes for run in runs_of_rows(size, last)]
    while len(runs) > 1 and runs[0] < _FIRST:
        runs[:2] = [runs[0] + runs[1]]
    fewest = last if last > LAST_OF_DISPLAY else _FIRST
    while len(runs) > 1 and runs[-1] < fewest:
        runs[-2:] = [runs[-2] + runs[-1]]
    return tuple(runs)


def stay(begins: Sequence[bool], last: int = LAST_OF_DISPLAY, tall: Sequence[bool] = ()) -> list[bool]:
    """Which rows of a display stay on the page of the next.

    >>> stay([True] + [False] * 6)
    [True, False, False, False, True, True, False]
    """
    ends = set(accumulate(runs_of_equations(begins, last, tall)))
    return [row not in ends for row in range(1, len(begins) + 1)]


def introduces(block: Block, following: Block | None, closes: bool = False) -> bool:
    """Whether a block belongs on one page with the one that follows; it `closes` where it is the last one."""
    if isinstance(block, Text):
        leads = isinstance(following, Text) and leads_on(following.parts)
        letters = sum(len(part) for part in block.parts if isinstance(part, str))
        table = isinstance(following, Table) and letters <= _LONG
        return leads_on(block.parts) or leads or table or isinstance(following, Formula | Equations | Uses)
    if isinstance(following, Note):
        return isinstance(block, Formula | Equations | Table)
    if isinstance(block, Formula):
        if block.label:
            return closes and isinstance(following, Formula)
        if block.source:
            return isinstance(following, Formula | Equations | Uses)
        if isinstance(following, Formula) and (not following.label or holds_matrix(following.node)):
            return False
        return not holds_matrix(block.node) and isinstance(following, Formula | Equations | Uses)
    return isinstance(block, Uses)


def leads_on(parts: Prose) -> bool:
    """Whether a sentence ends with a colon."""
    return bool(parts) and isinstance(parts[-1], str) and parts[-1].rstrip().endswith(":")


def before_closing(blocks: Sequence[Block]) -> tuple[Sequence[Block], Sequence[Block]]:
    """The blocks before a heading that is closing, and those from it on."""
    places = (k for k, block in enumerate(blocks) if isinstance(block, Heading) and block.closing)
    first = next(places, len(blocks))
    return blocks[:first], blocks[first:]


def closing(blocks: Iterable[Block], rows: Callable[[Block], int]) -> tuple[Block, ...]:
    """The last blocks, as many as have enough rows for the last page; `rows` is how many a block has."""
    found: list[Block] = []
    total = 0
    for block in reversed(list(blocks)):
        matrices = isinstance(block, Formula) and holds_matrix(block.node)
        if total >= (_ENOUGH if matrices else LAST_OF_DOCUMENT):
            break
        found.append(block)
        total += rows(block)
    return tuple(reversed(found))


# Fractions in a line of words have a stroke, m l²/12


def in_line(node: Node) -> Node:
    """The formula with a stroke in the fractions that stand alone or as terms.

    A factor before others stays stacked, for a stroke there could be misread, but not in parentheses, and
    so does a number: ½ has the size of a line.

    >>> from dynsolve.notation.text import read
    >>> [type(in_line(read(text).tree)).__name__ for text in ("m*l^2/12", "(m/2)/l", "1/2")]
    ['Slashed', 'Quotient', 'Quotient']
    >>> squared = in_line(Power(Derivative(Symbol("g"), Symbol("q")), Number(2)))
    >>> [type(node).__name__ for node in walk(squared)][:3]
    ['Power', 'Parenthesized', 'Slashed']
    """
    match node:
        case Product((*before, last)):
            closed = Parenthesized | Power | Transpose  # with parentheses around it, raised or not
            return Product((*(in_line(p) if isinstance(p, closed) else p for p in before), in_line(last)))
        case Power(Derivative() as base, exponent):
            return Power(Parenthesized(in_line(base)), exponent)
        case Derivative(Derivative() as inner, by, total):
            return Slashed(Derivative(Parenthesized(in_line(inner)), by, total))
        case Quotient(Number(), Number()):
            return node
        case Quotient() if not any(map(_is_stacked, walk(node.numerator, node.denominator))):
            return Slashed(node)
        case Derivative(of) if isinstance(of, Symbol | Letter):
            return Slashed(node)
        case Sum() | Relation() | Row() | Negative() | Parenthesized() | Power() | Transpose() | Cross():
            return with_children(node, in_line)
    return node


def _is_stacked(node: Node) -> bool:
    """Whether a part of a fraction is one itself."""
    return isinstance(node, Quotient | Derivative) or (isinstance(node, Number) and node.q != 1)


_Piece = TypeVar("_Piece")


class Page(ABC, Generic[_Piece]):
    """Turns blocks into pieces of one format: text, or the lines of a terminal."""

    labels: Mapping[str, int]
    """The numbers of the formulas that have a label."""

    def blocks(self, blocks: Iterable[Block]) -> Iterator[_Piece]:
        """Blocks one after the other."""
        for block in blocks:
            yield from self.block(block)

    def block(self, block: Block) -> Iterator[_Piece]:
        """One block."""
        match block:
            case Heading():
                yield from self.heading(block)
            case Text():
                yield from self.text(block)
            case Formula():
                yield from self.formula(block)
            case Equations():
                yield from self.equations(block)
            case Uses():
                yield from self.used(block)
            case List(items):
                yield from self.list(items)
            case Note(parts):
                yield from self.note(parts)
            case Table():
                yield from self.table(block)
            case Picture():
                yield from self.picture(block)
            case Fold():
                yield from self.fold(block)

    @abstractmethod
    def heading(self, heading: Heading) -> Iterator[_Piece]:
        """A heading."""

    @abstractmethod
    def text(self, text: Text) -> Iterator[_Piece]:
        """A paragraph."""

    @abstractmethod
    def formula(self, formula: Formula) -> Iterator[_Piece]:
        """A displayed formula."""

    @abstractmethod
    def equations(self, equations: Equations) -> Iterator[_Piece]:
        """Equations in one display."""

    def leading_on(self, uses: Uses) -> str:
        """With (3) and (7), term by term: the numbered results that are used in the next formula."""
        references = self.numbers_of(uses.labels)
        if not references:
            return self.prose(uses.parts)
        named = f"With {references}"
        return f"{named}{self.prose(after_references(uses.parts))}" if uses.parts else f"{named}:"

    def numbers_of(self, labels: Iterable[str]) -> str:
        """References to formulas: (3), (7) to (9) and (12); none to those without a number."""
        references = list(map(self.references, runs(labels, self.labels)))
        return ", ".join(references[:-1]) + " and " * (len(references) > 1) + "".join(references[-1:])

    def referred(self, reference: Reference) -> str:
        """References among words, with the words that lead to them."""
        found = self.numbers_of(reference.labels)
        return f"{self.words(reference.before)}{found}" if found else ""

    def references(self, run: Sequence[str]) -> str:
        """References to formulas whose numbers follow each other: (3) to (7)."""
        first, last = (self.reference(label, self.labels[label]) for label in (run[0], run[-1]))
        return first if len(run) == 1 else f"{first} to {last}"

    def reference(self, label: str, number: int) -> str:
        """A reference to a numbered formula."""
        return f"({number})"

    def used(self, uses: Uses) -> Iterator[_Piece]:
        """The results used in the next formula, where they have numbers."""
        if sentence := self.leading_on(uses):
            yield from self.uses(sentence)

    @abstractmethod
    def uses(self, sentence: str) -> Iterator[_Piece]:
        """The sentence that lists the results used in the next formula."""

    @abstractmethod
    def list(self, items: Sequence[Prose]) -> Iterator[_Piece]:
        """Items, one under another."""

    @abstractmethod
    def note(self, parts: Prose) -> Iterator[_Piece]:
        """A remark beside the text."""

    @abstractmethod
    def table(self, table: Table) -> Iterator[_Piece]:
        """A table."""

    @abstractmethod
    def picture(self, picture: Picture) -> Iterator[_Piece]:
        """A drawing."""

    @abstractmethod
    def fold(self, fold: Fold) -> Iterator[_Piece]:
        """Blocks that belong together under a title."""

    def prose(self, parts: Prose) -> str:
        """A sentence with its formulas."""
        return "".join(map(self.part, parts))

    def part(self, part: Inline) -> str:
        """A piece of a sentence, or a cell of a table."""
        match part:
            case str():
                return self.words(part)
            case Verbatim(text):
                return self.verbatim(text)
            case Reference():
                return self.referred(part)
        return self.inline(in_line(part))

    @abstractmethod
    def words(self, text: str) -> str:
        """Words of a sentence."""

    @abstractmethod
    def verbatim(self, text: str) -> str:
        """Text as somebody typed it."""

    @abstractmethod
    def inline(self, node: Node) -> str:
        """A formula in a sentence."""


_PROSE = 36
"""Cells with more letters than this are sentences, which are broken."""


def prose_columns(table: Table) -> frozenset[int]:
    """The columns of a table that hold sentences, from 0."""
    columns = enumerate(zip(*table.rows, strict=True))
    return frozenset(
        k for k, cells in columns if any(isinstance(cell, str) and len(cell) > _PROSE for cell in cells)
    )


class MarkupPage(Page[str]):
    """A page of text with markup, in which mathematics among words is set as formulas."""

    def __init__(self, printer: FormulaPrinter, labels: Mapping[str, int]) -> None:
        self.printer = printer
        self.labels = labels
        self._prose_writer = ProseWriter(self.escaped, self.inline)

    def words(self, text: str) -> str:
        """Words of a sentence, the mathematics among them as formulas."""
        return self._prose_writer(text)

    @abstractmethod
    def escaped(self, text: str) -> str:
        """Any text, so that nothing in it is markup."""


SHORT = 16.5
"""Formulas in a sentence that are no wider, in em, are not broken."""

PART = 22.0
"""Nor are the parts between the relations of others; wider parts are broken between their terms."""

_SOURCE_LETTER = 0.46  # small letters, in em
_SOURCE_SPACE = 1.5


class TypesetPage(MarkupPage):
    """A page of a certain width in em, of which `number` em are kept for the number of a formula."""

    def __init__(
        self,
        printer: FormulaPrinter,
        notation: Notation,
        labels: Mapping[str, int],
        width: float,
        number: float,
        ruler: Ruler | None = None,
    ) -> None:
        super().__init__(printer, labels)
        self.notation, self.ruler = notation, Ruler(printer.style) if ruler is None else ruler
        self.width, self.number = width, number
        self.closing: tuple[Block, ...] = ()

    def typesetter(self, display: Formula | Equations) -> Typesetter:
        """The typesetter of a display; one with a number or its source beside it has less room."""
        return Typesetter(self.notation, self.ruler, self.width - self.beside(display))

    def beside(self, display: Formula | Equations) -> float:
        """The room that stands beside a display, in em."""
        if display.label in self.labels:
            return self.number
        source = display.source if isinstance(display, Formula) else ""
        return len(source) * _SOURCE_LETTER + _SOURCE_SPACE if source else 0.0

    def columns(self, display: Formula | Equations) -> Columns | None:
        """Columns of a matrix's entries where they have to be, of equations that are many, or some short.

        What is derived from line to line, P_2 and then P_2 again, is read downwards: it has none.
        """
        room = self.width - self.number
        if isinstance(display, Formula):
            found = self.typesetter(display).listed(display)
            return in_columns(found, room) if found and len(found) >= FEWEST else None
        lefts = [node.parts[0] for node in display.nodes if isinstance(node, Relation)]
        if not display.in_columns and len(set(lefts)) < len(lefts):
            return None
        short = sum(self.ruler.width(node) + GAP <= room / MOST_COLUMNS for node in display.nodes)
        if short < FEWEST_SHORT and not (display.in_columns and len(display.nodes) >= FEWEST):
            return None
        return in_columns(Typesetter(self.notation, self.ruler, room).each(display.nodes), room)

    def lines_of(self, display: Formula | Equations) -> list[Line]:
        """The lines of a display that does not stand in columns."""
        typesetter = self.typesetter(display)
        if isinstance(display, Formula):
            return typesetter.set(display)
        return typesetter.equations(display.nodes)

    def level_result(self, formula: Formula) -> Line | None:
        """A numbered equation without matrices in one line, which is level with others beside it."""
        node = formula.node
        if formula.label not in self.labels or not isinstance(node, Relation) or holds_matrix(node):
            return None
        lines = self.typesetter(formula).equations([node])
        return lines[0] if len(lines) == 1 else None

    def rows(self, block: Block) -> int:
        """How many rows a block has on a page, at least."""
        match block:
            case Formula() | Equations():
                if columns := self.columns(block):
                    return len(columns.rows)
                rows = len(self.lines_of(block))
                return max(rows, height(block.node)) if isinstance(block, Formula) else rows
            case Table():
                return len(block.rows) + 1
            case List():
                return len(block.items)
        return 1

    def is_lost(self, block: Block | None) -> bool:
        """Whether a last block is so short that it has no page of its own."""
        return block is not None and self.rows(block) < LAST_OF_DISPLAY

    def close(self, document: Document) -> None:
        """Let no page end in the last rows of a document."""
        self.closing = closing(unfolded(document.blocks), self.rows)

    def closes(self, block: Block) -> bool:
        """Whether a block is among those between which no page ends."""
        return any(block is one for one in self.closing)

    def kept(self, block: Block) -> int:
        """How many of the last rows of a display are on one page."""
        return LAST_OF_DOCUMENT if self.closes(block) else LAST_OF_DISPLAY

    def inline(self, node: Node) -> str:
        """A formula in a sentence; those of a list with the commas of the sentence between them."""
        parts = listed(node) if isinstance(node, Row) and Words(", ") in node.parts else [node]
        return ", ".join(map(self.whole_or_pieces, parts))

    def whole_or_pieces(self, node: Node) -> str:
        """A formula that is not broken, or pieces between which it may be."""
        return f"${self.printer.text(node)}$"

    def fold(self, fold: Fold) -> Iterator[str]:
        """The blocks of a fold under its title, which cannot be folded away on paper."""
        yield from self.heading(Heading(fold.title, 3))
        yield from self.blocks(with_results(fold.blocks))
