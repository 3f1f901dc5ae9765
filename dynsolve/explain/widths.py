"""How wide formulas are as text: what fits a line, and what is written otherwise."""

from __future__ import annotations

from dynsolve.explain.context import Context
from dynsolve.explain.style import style_of
from dynsolve.notation.tree import Matrix
from dynsolve.notation.unicode import UnicodePrinter, width


def matrix_width(context: Context, matrix: Matrix) -> int:
    """How wide a matrix is in characters, two blanks between its columns."""
    printer = UnicodePrinter(style_of(context.robot))
    columns = zip(*matrix.rows, strict=True)
    return sum(max(width(printer.text(entry)) for entry in column) + 2 for column in columns)
