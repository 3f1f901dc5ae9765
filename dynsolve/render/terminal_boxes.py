"""Formulas laid out in the characters of a terminal: boxes of lines side by side on one baseline.

Matrices in displayed formulas: where they stand, and how one that is too wide is given entry by entry.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from itertools import takewhile

from msgspec import Struct

from dynsolve.document import Formula
from dynsolve.notation.printing import Style
from dynsolve.notation.rounding import marked
from dynsolve.notation.tree import (
    ZERO,
    Cross,
    Entry,
    Letter,
    Matrix,
    Negative,
    Node,
    Number,
    Parenthesized,
    Product,
    Relation,
    Row,
    Sum,
    Transpose,
    Words,
    children,
    equation,
    walk,
)
from dynsolve.notation.unicode import UnicodePrinter, width

# Matrices in displayed formulas

_SHALLOW = 4
_OTHERS = Words("every other entry")


def holds_matrix(node: Node, depth: int = _SHALLOW) -> bool:
    """Whether a matrix stands in a formula, near enough to its top to be laid out."""
    level = [node]
    for _ in range(depth + 1):
        if any(type(part) is Matrix for part in level):
            return True
        level = [part for above in level for part in children(above)]
    return False


def height(node: Node) -> int:
    """How many rows the highest matrix in a formula has."""
    return max((len(part.rows) for part in walk(node) if isinstance(part, Matrix)), default=1)


def entries_by_value(matrix: Matrix) -> list[tuple[Node, list[tuple[int, int]]]]:
    """The different entries of a matrix, each with all of its places (from 0); those that are 0 last.

    >>> from dynsolve.notation.tree import ONE
    >>> [places for _, places in entries_by_value(Matrix(((ZERO, ONE), (ONE, ZERO))))]
    [[(0, 1), (1, 0)], [(0, 0), (1, 1)]]
    """
    places: dict[Node, list[tuple[int, int]]] = {}
    for i, row in enumerate(matrix.rows):
        for j, entry in enumerate(row):
            places.setdefault(entry, []).append((i, j))
    zeros = places.pop(ZERO, None)
    return [*places.items(), *([(ZERO, zeros)] if zeros else [])]


MOST_ZEROS = 6
"""So many entries that are 0 are named."""


def entry_equations(matrix: Matrix, left: Node | None, formula: Formula, style: Style) -> Iterator[Relation]:
    """`d_12 = d_21 = ...`: equal entries in one chain, those that are 0 last; ≈ before what is rounded.

    Many zeros are told in words, and so are those of what has no letter of its own, (A - B)_12.
    """
    found = entries_by_value(matrix)
    for value, places in found:
        names = [entry_name(i, j, matrix, left, formula) for i, j in places]
        first = names[0]
        has_letter = not isinstance(first, Entry) or isinstance(first.of, Letter)
        many = MOST_ZEROS if has_letter else 1
        if value == ZERO and len(names) > many and len(found) > 1:
            names = [_OTHERS]
        chain = marked(equation(*names, value), style)
        assert isinstance(chain, Relation)
        yield chain


def given_name(i: int, j: int, matrix: Matrix, formula: Formula) -> Node | None:
    """The name that a formula gives to an entry of its matrix, if it does."""
    if len(formula.entries) == len(matrix.rows) and len(formula.entries[i]) == len(matrix.rows[i]):
        return formula.entries[i][j]
    return None


def entry_name(i: int, j: int, matrix: Matrix, left: Node | None, formula: Formula) -> Node:
    """The name of an entry: given, or the letter on the left with the entry's place."""
    if (given := given_name(i, j, matrix, formula)) is not None:
        return given
    place: list[Node] = [Number(i + 1), Number(j + 1)]
    if len(matrix.rows[0]) == 1 or len(matrix.rows) == 1:
        place = [Number(max(i, j) + 1)]
    between = [Words(",")] if max(i, j) >= 9 else []  # 1 and 11 are not 11 and 1
    index = place[0] if len(place) == 1 else Row((place[0], *between, place[1]))
    if isinstance(left, Letter) and left.sub is None and left.sup is None:
        return Letter(left.base, index, None, dots=left.dots)
    if left is None:
        return Row((Words("["), *place, Words("]")))
    return Entry(left, index)


class TextBox(Struct, frozen=True):
    """Lines of one width; `baseline` is the line that stands level with its neighbours."""

    lines: tuple[str, ...]
    width: int
    baseline: int = 0

    @staticmethod
    def of(text: str) -> TextBox:
        """One line."""
        return TextBox((text,), width(text))


def beside(boxes: Sequence[TextBox]) -> TextBox:
    """Boxes side by side, baselines level."""
    above = max(box.baseline for box in boxes)
    below = max(len(box.lines) - box.baseline for box in boxes)
    padded = [_padded(box, above, below) for box in boxes]
    lines = tuple("".join(parts) for parts in zip(*padded, strict=True))
    return TextBox(lines, sum(box.width for box in boxes), above)


def _padded(box: TextBox, above: int, below: int) -> list[str]:
    blank = " " * box.width
    over = above - box.baseline
    under = below - (len(box.lines) - box.baseline)
    return [blank] * over + list(box.lines) + [blank] * under


def centered(text: str, cells: int) -> str:
    """`text` in the middle of a number of terminal cells."""
    space = cells - width(text)
    return " " * (space // 2) + text + " " * (space - space // 2)


_BRACKETS = {"[": "[⎡⎢⎣", "]": "]⎤⎥⎦", "(": "(⎛⎜⎝", ")": ")⎞⎟⎠"}


def bracket(sign: str, height: int) -> list[str]:
    """A bracket of a height."""
    single, top, middle, bottom = tuple(_BRACKETS[sign])
    return [single] if height == 1 else [top, *[middle] * (height - 2), bottom]


def matrix_box(matrix: Matrix, printer: UnicodePrinter) -> TextBox:
    """A matrix between brackets, each column centred."""
    cells = [[printer.text(entry) for entry in row] for row in matrix.rows]
    widths = [max(map(width, column)) for column in zip(*cells, strict=True)]
    rows = ["  ".join(map(centered, row, widths)) for row in cells]
    return _enclosed(TextBox(tuple(rows), width(rows[0]), (len(rows) - 1) // 2), "[", "]")


def matrix_width(matrix: Matrix, printer: UnicodePrinter) -> int:
    """The width of `matrix_box`, which is not made where it does not fit."""
    columns = zip(*matrix.rows, strict=True)
    widths = [max(width(printer.text(entry)) for entry in column) for column in columns]
    return sum(widths) + 2 * len(widths)


def _enclosed(box: TextBox, left: str, right: str) -> TextBox:
    height = len(box.lines)
    sides = zip(bracket(left, height), box.lines, bracket(right, height), strict=True)
    return TextBox(tuple(a + line + b for a, line, b in sides), box.width + 2, box.baseline)


def pieces(node: Node, printer: UnicodePrinter) -> Iterator[TextBox | Matrix]:
    """A formula that holds matrices, as boxes that may be set side by side.

    A matrix stays a node, so that whoever sets it may choose how.
    """
    match node:
        case Matrix():
            yield node
        case Relation(parts, signs):
            yield from pieces(parts[0], printer)
            for sign, part in zip(signs, parts[1:], strict=True):
                yield TextBox.of(f" {sign} ")
                yield from pieces(part, printer)
        case Row(parts) if holds_matrix(node):
            for part in parts:
                yield from pieces(part, printer)
        case Sum(terms) if holds_matrix(node):
            yield from _sum(terms, printer)
        case Product(factors) if holds_matrix(node):
            front = tuple(takewhile(lambda factor: not holds_matrix(factor), factors))
            grouped = (Product(front), *factors[len(front) :]) if len(front) > 1 else factors
            for i, factor in enumerate(grouped):
                if i:
                    yield TextBox.of(" ")
                yield from _factor(factor, printer)
        case Negative(argument) if holds_matrix(node):
            yield TextBox.of("-")
            yield from _factor(argument, printer)
        case Transpose(Matrix() as matrix):
            box = matrix_box(matrix, printer)
            yield beside([box, TextBox(("ᵀ", *[" "] * (len(box.lines) - 1)), 1, box.baseline)])
        case Cross(left, right) if holds_matrix(node):
            yield from _factor(left, printer)
            yield TextBox.of(" × ")
            yield from _factor(right, printer)
        case Parenthesized(argument) if holds_matrix(node):
            yield _enclosed(box_of(argument, printer), "(", ")")
        case _:
            yield TextBox.of(printer.text(node))


def _sum(terms: Iterable[Node], printer: UnicodePrinter) -> Iterator[TextBox | Matrix]:
    for i, term in enumerate(terms):
        negative = isinstance(term, Negative)
        if i or negative:
            sign = "-" if negative else "+"
            yield TextBox.of(f" {sign} " if i else sign)
        yield from pieces(term.argument if isinstance(term, Negative) else term, printer)


def _factor(factor: Node, printer: UnicodePrinter) -> Iterator[TextBox | Matrix]:
    """A factor of a product: a sum stands between parentheses."""
    if isinstance(factor, Sum | Negative | Relation):
        yield _enclosed(box_of(factor, printer), "(", ")")
    else:
        yield from pieces(factor, printer)


def box_of(node: Node, printer: UnicodePrinter) -> TextBox:
    """A whole formula in one box, however wide."""
    return beside([boxed(piece, printer) for piece in pieces(node, printer)])


def boxed(piece: TextBox | Matrix, printer: UnicodePrinter) -> TextBox:
    """A piece in a box."""
    return piece if isinstance(piece, TextBox) else matrix_box(piece, printer)
