"""Formulas as pieces between which a line may end, and the best lines for a width.

What is a piece, and how wide it is, does not depend on the notation: a `Notation`
gives the text of a tree and a few signs, this module says where they may be parted.

Numbers of equations: every named result of a document, in order.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from itertools import pairwise, zip_longest
from textwrap import shorten

from msgspec import Struct, field
from msgspec.structs import replace

from dynsolve.document import Block, Document, Equations, Fold, Formula, Heading, Prose, Text, Uses
from dynsolve.notation.build import factors_of
from dynsolve.notation.extent import BINARY, FLAT, PARENTHESIS, RELATION, Ruler
from dynsolve.notation.tree import (
    ONE,
    Cross,
    Function,
    Matrix,
    Negative,
    Node,
    Number,
    Parenthesized,
    Power,
    Product,
    Quotient,
    Relation,
    Row,
    Sum,
    Words,
    walk,
)
from dynsolve.render.terminal_boxes import holds_matrix

RELATION_BREAK, SUM_BREAK, FACTOR_BREAK = 0, 1, 3
"""How deep a place to break lies, within one level of parentheses."""

_DEEPER = 2
_FINE = 11.0
"""Terms and factors that are narrower than this, in em, stay whole."""
_FRACTION = 32.0
"""Denominators that are wider than this, in em, stand behind a slash, where they may be broken."""

_ABOVE = 0.75
"""Numerators up to this share of that width stand above their denominators as a whole."""

HEIGHTS = (FLAT, 1.35, 1.8)
"""In em: around what has no parentheses, around what has some, and around some with others in them."""

Fence = Callable[[str, float], str]
"""A parenthesis, `(` or `)`, of a height in em."""


def height_around(text: str, fence: Fence) -> float:
    """The height of parentheses around a text that is not tall: a reader finds pairs by their size.

    >>> fence = lambda sign, height: {FLAT: "", 1.35: "big", 1.8: "Big"}[height] + sign
    >>> [height_around(text, fence) for text in ("a + b", "a + c(b + d)", "a + big(e + c(b + d)big)")]
    [1.3, 1.35, 1.8]
    """
    inside = [place for place, height in enumerate(HEIGHTS, 1) if fence("(", height) in text]
    return HEIGHTS[min(max(inside, default=0), len(HEIGHTS) - 1)]


class Notation(Struct, frozen=True):
    """The signs of a formula in one notation.

    `plus`, `minus` and `relation` are signs between two parts, `lead` a minus before
    the first term; `times` begins a line between two matrices of a product; `fence` gives
    parentheses that may stand on different lines, `raised` puts an exponent to the second; `joined`
    puts texts side by side.
    """

    text: Callable[[Node], str]
    plus: str
    minus: str
    lead: str
    times: str
    relation: Callable[[str], str]
    fence: Fence
    raised: Callable[[str, str], str]
    joined: Callable[[Sequence[str]], str]


class Piece(Struct, frozen=True):
    """A part of a formula that is not broken; `depth` says how deep the place before it lies.

    `level` is how many parentheses that place is in, `sign` what a line begins with that begins there.
    """

    text: str
    width: float
    depth: int = 0
    level: int = 0
    sign: str = ""


class _Builder(Struct):
    joined: Callable[[Sequence[str]], str]
    texts: list[list[str]] = field(default_factory=lambda: [[]])
    widths: list[float] = field(default_factory=lambda: [0.0])
    places: list[tuple[int, int, str]] = field(default_factory=lambda: [(0, 0, "")])

    def add(self, text: str, width: float) -> None:
        self.texts[-1].append(text)
        self.widths[-1] += width

    def gap(self, level: int, kind: int, sign: str = "") -> None:
        """A place where a line may end, of a kind, in so many parentheses."""
        if self.texts[-1]:
            self.texts.append([])
            self.widths.append(0.0)
            self.places.append((_DEEPER * level + kind, level, sign))

    def pieces(self) -> Iterator[Piece]:
        for texts, width, place in zip(self.texts, self.widths, self.places, strict=True):
            if texts:
                yield Piece(self.joined(texts), width, *place)


class FormulaSplitter:
    """Takes formulas apart into pieces."""

    def __init__(
        self, notation: Notation, ruler: Ruler, fine: float = _FINE, fraction: float = _FRACTION
    ) -> None:
        self.notation = notation
        self.ruler = ruler
        self.fine = fine
        self.fraction = fraction
        self._memory: dict[tuple[int, str], tuple[Node, list[Piece]]] = {}
        self._has_matrix = True

    def pieces(self, node: Node, sign: str = "") -> list[Piece]:
        """The pieces of a formula, with a sign of a relation before it."""
        known = self._memory.get((id(node), sign))
        if known is None:
            known = self._memory[id(node), sign] = (node, list(self._pieces(node, sign)))
        return known[1]

    def _pieces(self, node: Node, sign: str) -> Iterator[Piece]:
        builder = _Builder(self.notation.joined)
        self._has_matrix = any(type(part) is Matrix for part in walk(node))
        if sign:
            builder.add(self.notation.relation(sign), RELATION)
        self._put(builder, node, 0)
        return builder.pieces()

    def _put(self, builder: _Builder, node: Node, level: int) -> None:
        match node:
            case Relation(parts, signs) if self._is_wide(node) or self._holds(node):
                self._put(builder, parts[0], level)
                for sign, part in zip(signs, parts[1:], strict=True):
                    builder.gap(level, RELATION_BREAK)
                    builder.add(self.notation.relation(sign), RELATION)
                    self._put(builder, part, level)
            case Sum(terms) if terms:
                self._sum(builder, terms, level)
            case Negative(argument):
                builder.add(self.notation.lead, 0.78)
                put = self._put if isinstance(argument, Quotient) else self._factor
                put(builder, argument, level)
            case Row(parts):
                inside = level + 1 if any(map(_is_comma, parts)) else level
                for before, part in pairwise((Words(""), *parts)):
                    if holds_matrix(before) and not _is_comma(part):  # its unit
                        builder.gap(level, FACTOR_BREAK)
                    self._put(builder, part, inside)
                    if _is_comma(part):
                        builder.gap(level, RELATION_BREAK)
            case _ if not (self._is_wide(node) or self._holds(node)):
                builder.add(self.notation.text(node), self.ruler.width(node))
            case Product(factors) if factors:
                self._product(builder, factors, level)
            case Quotient(numerator) if self._is_long_fraction(node) or self._is_long_above(numerator):
                self._quotient(builder, node, level)
            case Power(base, exponent) if isinstance(base, Sum | Parenthesized | Negative | Product):
                inner = base.argument if isinstance(base, Parenthesized) else base
                self._enclosed(builder, inner, level, exponent)
            case Parenthesized(argument):
                self._enclosed(builder, argument, level)
            case Cross(left, right):
                self._factor(builder, left, level)
                builder.gap(level, FACTOR_BREAK)
                builder.add(self.notation.relation("×"), BINARY)
                self._factor(builder, right, level)
            case _:
                builder.add(self.notation.text(node), self.ruler.width(node))

    def _quotient(self, builder: _Builder, node: Quotient, level: int) -> None:
        """A long fraction as a / (b); of another one 1/b, or 2/b, stands before what else is above."""
        numerator, denominator = node.numerator, node.denominator
        if self._is_long_fraction(node):
            self._factor(builder, numerator, level)
            builder.gap(level, FACTOR_BREAK)
            builder.add(self.notation.relation("/"), BINARY)
            self._enclosed(builder, denominator, level)
            return
        first, *rest = factors_of(numerator)
        number, factors = (first, rest) if isinstance(first, Number) else (ONE, [first, *rest])
        builder.add(self.notation.text(Quotient(number, denominator)), self.ruler.width(denominator) + 0.4)
        if len(factors) > 1:
            self._product(builder, factors, level)
        else:
            self._factor(builder, factors[0], level)

    def _sum(self, builder: _Builder, terms: Sequence[Node], level: int) -> None:
        whole = level > 0 and not self._is_wide(Sum(tuple(terms)))
        for i, term in enumerate(terms):
            negative = isinstance(term, Negative)
            if i:
                if not whole:
                    builder.gap(level, SUM_BREAK)
                builder.add(self.notation.minus if negative else self.notation.plus, BINARY)
            elif negative:
                builder.add(self.notation.lead, 0.78)
            inner = term.argument if isinstance(term, Negative) else term
            if isinstance(inner, Sum):
                self._enclosed(builder, inner, level)
            else:
                self._put(builder, inner, level)

    def _product(self, builder: _Builder, factors: Sequence[Node], level: int) -> None:
        """Narrow factors together, wide ones taken apart; m_1 and ( are not parted."""
        narrow: list[Node] = []
        for i, factor in enumerate(factors):
            if narrow and isinstance(factor, Function):  # never broken, and it keeps its distance
                narrow.append(factor)
            elif self._is_wide(factor) or self._holds(factor):
                self._together(builder, narrow, after=i > len(narrow))
                if i and (not narrow or holds_matrix(factor)):
                    builder.gap(level, FACTOR_BREAK, self.notation.times)
                narrow = []
                self._factor(builder, factor, level)
            else:
                narrow.append(factor)
        self._together(builder, narrow, after=len(factors) > len(narrow))

    def _together(self, builder: _Builder, factors: Sequence[Node], after: bool = False) -> None:
        """Narrow factors; `after` a wide one a number has a product sign."""
        if factors:
            if after and isinstance(factors[0], Number):
                builder.add(self.notation.times, BINARY)
            node = factors[0] if len(factors) == 1 else Product(tuple(factors))
            if len(factors) == 1 and isinstance(node, Sum):
                node = Parenthesized(node)
            builder.add(self.notation.text(node), self.ruler.width(node))

    def _factor(self, builder: _Builder, node: Node, level: int) -> None:
        if isinstance(node, Sum | Negative | Relation) or self._is_long_fraction(node):
            self._enclosed(builder, node, level)
        else:
            self._put(builder, node, level)

    def _enclosed(self, builder: _Builder, node: Node, level: int, exponent: Node | None = None) -> None:
        height = self.ruler.height(node)
        if height <= FLAT:
            height = height_around(self.notation.text(node), self.notation.fence)
        builder.add(self.notation.fence("(", height), PARENTHESIS)
        self._put(builder, node, level + 1)
        closed, width = self.notation.fence(")", height), PARENTHESIS
        if exponent is not None:
            closed = self.notation.raised(closed, self.notation.text(exponent))
            width += self.ruler.index(exponent)
        builder.add(closed, width)

    def _is_long_fraction(self, node: Node) -> bool:
        return isinstance(node, Quotient) and self.ruler.width(node.denominator) > self.fraction

    def _is_long_above(self, numerator: Node) -> bool:
        return self._holds(numerator) or self.ruler.width(numerator) > _ABOVE * self.fraction

    def _holds(self, node: Node) -> bool:
        """Whether a matrix stands in a part; of most formulas none does in the whole."""
        return self._has_matrix and holds_matrix(node)

    def _is_wide(self, node: Node) -> bool:
        return self.ruler.width(node) > self.fine


def _is_comma(node: Node) -> bool:
    """Whether this stands between formulas that are side by side."""
    return isinstance(node, Words) and node.text in (", ", ",\N{NO-BREAK SPACE}")


def together(pieces: Sequence[Piece], most: float, join: Callable[[Sequence[str]], str]) -> list[Piece]:
    """The pieces, each joined with the deeper ones after it where that is at most `most` em wide.

    Whoever breaks lines without looking at depth then breaks at shallow places first.

    >>> parts = [Piece("a", 4), Piece("+(b", 4, 1), Piece("+c)", 4, 3), Piece("+d", 4, 1)]
    >>> [piece.text for piece in together(parts, 12, "".join)]
    ['a', '+(b+c)', '+d']
    """
    joined: list[Piece] = []
    i = 0
    while i < len(pieces):
        end, width = i + 1, pieces[i].width
        while end < len(pieces) and pieces[end].depth > pieces[i].depth:
            width += pieces[end].width
            end += 1
        if width > most:
            end = i + 1
        group = pieces[i:end]
        text = join([piece.text for piece in group])
        joined.append(replace(pieces[i], text=text, width=sum(piece.width for piece in group)))
        i = end
    return joined


_SUM_COST = 0.35
_INSIDE_COST = 25.0
"""A line ends in parentheses only where what they hold is too wide: many lines are better."""
_MIXED_COST = 2.5
"""A term that takes several lines has them for itself: that is worth as many lines more."""
_SHORT, _SHORT_COST = 0.3, 0.3
"""A last line that takes less of its room is too short, and what that costs."""
_OVERFULL = 1e6
_DEEPEST = 10**6


def _depth_cost(depth: int, opened: int) -> float:
    """What it costs to end a line at a depth, where a line has ended in parentheses at `opened` before."""
    if depth <= max(SUM_BREAK, opened):
        return _SUM_COST * min(depth, FACTOR_BREAK)
    return _INSIDE_COST * 3.0 ** (depth - SUM_BREAK)


def lines(pieces: Sequence[Piece], first: float, rest: float, step: float = 0.0) -> list[list[Piece]]:
    """The pieces in lines, the first `first` em wide, the others `rest`: as shallow and as even as can be.

    A line that begins in parentheses is narrower, by `step` for each pair of them.  What stands in
    parentheses over several lines shares none of them with a term outside.

    >>> parts = [Piece("a", 4), Piece("+ b (c", 6, 1), Piece("+ d)", 4, 3), Piece("+ e", 4, 1)]
    >>> [[piece.text for piece in line] for line in lines(parts, 14, 14)]
    [['a', '+ b (c', '+ d)'], ['+ e']]
    """
    n = len(pieces)
    best = [0.0] * (n + 1)
    following = [n] * (n + 1)
    for i in range(n - 1, -1, -1):
        room = first if i == 0 else rest - step * pieces[i].level
        began = pieces[i].depth
        width, found = 0.0, float("inf")
        outermost = _DEEPEST  # of the places that this line goes over
        for j in range(i + 1, n + 1):
            width += pieces[j - 1].width
            if j > i + 1:
                outermost = min(outermost, pieces[j - 1].depth)
            cost = best[j] + 1.0 + _MIXED_COST * (outermost < began)
            if width > room:
                cost += _OVERFULL * (1.0 + width - room)
            elif j < n:
                cost += ((room - width) / room) ** 2
            elif width < _SHORT * room:
                cost += _SHORT_COST
            if j < n:
                depth = pieces[j].depth
                cost += _depth_cost(depth, min(began, outermost)) + _MIXED_COST * (outermost < depth)
            if cost < found:
                found, following[i] = cost, j
            if width > room:
                break
        best[i] = found
    broken, i = [], 0
    while i < n:
        broken.append(list(pieces[i : following[i]]))
        i = following[i]
    return broken


# Numbers of equations: every named result of a document, in order


def numbered(document: Document) -> dict[str, int]:
    """The number of each labelled display, from 1."""
    displays = (b for b in unfolded(document.blocks) if isinstance(b, Formula | Equations))
    numbers: dict[str, int] = {}
    for number, display in enumerate((d for d in displays if d.label and d.label not in numbers), start=1):
        numbers |= dict.fromkeys((display.label, *display.also), number)
    return numbers


_MANY_STEPS = 40
_LONGEST_HEADER = 60


def is_long(document: Document) -> bool:
    """Whether a document wants a table of contents: from forty steps on."""
    return _steps(document.blocks) >= _MANY_STEPS


def _steps(blocks: Iterable[Block]) -> int:
    return sum(1 + _steps(block.blocks) for block in blocks if isinstance(block, Fold))


def sections(document: Document) -> tuple[Heading, ...]:
    """The headings of the sections of a document."""
    return tuple(block for block in document.blocks if isinstance(block, Heading) and block.level == 2)


def running_title(title: str) -> str:
    """A title as it stands above every page: in one line.

    >>> running_title("RP manipulator")
    'RP manipulator'
    """
    return shorten(title, _LONGEST_HEADER, placeholder="…") if len(title) > _LONGEST_HEADER else title


def runs(labels: Iterable[str], numbers: Mapping[str, int]) -> list[list[str]]:
    """Labels in the order of their numbers, one of each, three or more that follow each other together.

    >>> runs(["c", "a", "b", "e"], {"a": 1, "b": 2, "c": 3, "d": 4, "e": 5})
    [['a', 'b', 'c'], ['e']]
    """
    first = {number: label for label, number in reversed([*numbers.items()])}
    found: list[list[str]] = []
    for label in map(first.__getitem__, sorted({numbers[label] for label in labels if label in numbers})):
        if found and numbers[label] == numbers[found[-1][-1]] + 1:
            found[-1].append(label)
        else:
            found.append([label])
    return [part for run in found for part in ([run] if len(run) > 2 else [[label] for label in run])]


def formulas(blocks: Iterable[Block]) -> Iterator[Formula]:
    """The displayed formulas, those in folds too."""
    return (block for block in unfolded(blocks) if isinstance(block, Formula))


def unfolded(blocks: Iterable[Block]) -> Iterator[Block]:
    """The blocks, in place of a fold those in it."""
    for block in blocks:
        yield from unfolded(block.blocks) if isinstance(block, Fold) else (block,)


def after_references(parts: Prose) -> Prose:
    """How a lead-in goes on after "With (3)".

    >>> after_references(("Term by term:",)), after_references(("With s = 0:",))
    ((', term by term:',), (' and with s = 0:',))
    """
    first, *rest = parts
    if not isinstance(first, str):
        return (", ", *parts)
    joint = " and " if first.startswith("With ") else ", "
    return (joint + first[:1].lower() + first[1:], *rest)


def with_results(blocks: Sequence[Block]) -> list[Block]:
    """The blocks, without each `Uses` that says nothing else and that no formula follows."""
    return [
        block
        for block, after in zip_longest(blocks, blocks[1:])
        if not isinstance(block, Uses) or block.parts or isinstance(after, Formula | Equations)
    ]


def with_sources(blocks: Sequence[Block]) -> Iterator[Block]:
    """The same blocks, the source of a formula beside the paragraph that introduces it."""
    blocks = with_results(blocks)
    for block, following in zip_longest(blocks, blocks[1:]):
        if isinstance(block, Text) and isinstance(following, Formula) and not block.source:
            yield replace(block, source=following.source)
        else:
            yield block


def slug(document: Document) -> str:
    """A short name of a document, of letters, digits and `-`, for labels and anchors.

    >>> slug(Document((Heading("RP manipulator, 2nd", 1),)))
    'rp-manipulator-2nd'
    """
    titles = (block.text for block in document.blocks if isinstance(block, Heading))
    words = re.findall(r"[a-z0-9]+", next(titles, "").lower())
    return "-".join(words)[:40].strip("-") or "robot"
