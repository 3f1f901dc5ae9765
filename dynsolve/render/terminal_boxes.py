"""Formulas laid out in the characters of a terminal: boxes of lines side by side on one baseline."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from itertools import takewhile

from dynsolve.notation.tree import (
    Cross,
    Matrix,
    Negative,
    Node,
    Parenthesized,
    Product,
    Relation,
    Row,
    Sum,
    Transpose,
)
from dynsolve.notation.unicode import UnicodePrinter, width
from dynsolve.render.matrices import holds_matrix


@dataclass(frozen=True, slots=True)
class TextBox:
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
