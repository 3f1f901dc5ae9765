"""Displayed formulas in LaTeX: one, several of one line each, one of several lines, many in columns.

Where `last` is given, no page ends in so many rows at the end of the display.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import chain, groupby, pairwise

from msgspec import Struct

from dynsolve.render.page import LAST_OF_DISPLAY, LAST_OF_DOCUMENT, stay
from dynsolve.render.typesetting import INDENT, Cell, Columns, Line

_MOST_LINES = 60  # what TeX holds in memory at once is bounded

_MATRIX = r"\begin{"
_FRACTION = r"\frac"


def _end(text: str, below: str, keep: bool) -> str:
    """The end of a row, further from the next one below a matrix, or below fractions if that has none.

    amsmath ends no page in a display by itself: where a row need not `keep` with the next, it says so.
    """
    may_end = "" if keep else r"\displaybreak[0] "
    is_apart = _MATRIX in text or (_FRACTION in text and _FRACTION not in below)
    return f" {may_end}\\\\{'[2pt]' if is_apart else ''}\n"


def in_columns(columns: Columns, label: str = "", last: int = LAST_OF_DISPLAY) -> Iterator[str]:
    """Rows of equations, the number at the end of the last."""
    yield "\\begingroup\\parskip=1pt\\lineskiplimit=2pt\\lineskip=3pt"
    for row, stays in zip(columns.rows, stay(columns.begins, last), strict=True):
        cells = "".join(_cell(cell, columns, columns.share(row, k)) for k, cell in enumerate(row))
        at_end = row is columns.rows[-1]
        number = f"\\equationnumber{{{label}}}" if label and at_end else ""
        keep = "\\nopagebreak" if stays or (at_end and last == LAST_OF_DOCUMENT) else ""
        yield f"\\equationrow{{{columns.indent:.4f}}}{{{cells}{number}}}{keep}"
    yield "\\par\\endgroup\\noindent"


def _cell(cell: Cell, columns: Columns, share: float) -> str:
    indent = _indent(cell.line)
    texts = f"{{{cell.line.left}}}{{{indent}{cell.line.right}}}"
    return f"\\equationcell{{{share:.4f}}}{{{columns.name:.2f}}}{texts}"


def level(line: Line) -> str:
    """A line with `&` at the place where lines are level."""
    return f"{line.left} & {_indent(line)}{line.right}"


def _indent(line: Line) -> str:
    return r"\qquad " * round(line.indent / INDENT)


class DisplayRow(Struct, frozen=True):
    """A formula of one line, `level` with others like it; it `stays` on the page of the next."""

    line: Line
    label: str = ""
    level: bool = False
    stays: bool = False


def gathered(rows: Sequence[DisplayRow]) -> Iterator[str]:
    """Formulas of one line each, one under the other; results that follow each other are level."""
    for are_level, run in groupby(rows, lambda row: row.level):
        shown = list(run)
        yield _kept(_gathered(shown, are_level), shown[-1].stays)


def _kept(display: str, stays: bool) -> str:
    """A display after which no page ends where it `stays` with what follows."""
    return f"\\begingroup\\postdisplaypenalty=10000\n{display}\n\\endgroup" if stays else display


def _gathered(rows: Sequence[DisplayRow], are_level: bool) -> str:
    if len(rows) == 1:
        (row,) = rows
        star = "" if row.label else "*"
        return f"\\begin{{equation{star}}}{row.label}\n{row.line.alone}\n\\end{{equation{star}}}"
    texts = [level(row.line) if are_level else row.line.alone for row in rows]
    labelled = [text + (row.label or r" \notag") for text, row in zip(texts, rows, strict=True)]
    ends = [_end(*pair, row.stays) for pair, row in zip(pairwise(texts), rows[:-1], strict=True)]
    body = "".join(chain.from_iterable(zip(labelled, [*ends, ""], strict=True)))
    name = "align" if are_level else "gather"
    return f"\\begin{{{name}}}\n{body}\n\\end{{{name}}}"


def aligned(
    lines: Sequence[Line], label: str = "", last: int = LAST_OF_DISPLAY, stays: bool = False
) -> Iterator[str]:
    """One formula on several lines, the number beside the last; a very long one in several displays."""
    for start in range(0, len(lines), _MOST_LINES):
        part = lines[start : start + _MOST_LINES]
        number = label if start + _MOST_LINES >= len(lines) else ""
        star = "" if number else "*"
        display = f"\\begin{{align{star}}}\n{''.join(_rows(part, number, last))}\n\\end{{align{star}}}"
        yield _kept(display, stays)


def _rows(lines: Sequence[Line], label: str, last: int) -> Iterator[str]:
    texts = [level(line) for line in lines]
    stays = stay([bool(line.left) for line in lines], last, [_MATRIX in text for text in texts])
    notag = r" \notag" if label else ""
    for (text, below), keep in zip(pairwise(texts), stays[:-1], strict=True):
        yield text + notag + _end(text, below, keep)
    yield texts[-1] + label
