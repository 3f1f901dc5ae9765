"""Displayed formulas in LaTeX: one, several of one line each, one of several lines, many in columns.

Where `last` is given, no page ends in so many rows at the end of the display.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from dynsolve.render.columns import Cell, Columns
from dynsolve.render.page_ends import LAST_OF_DISPLAY, LAST_OF_DOCUMENT, stays
from dynsolve.render.typesetting import Line

_MOST_LINES = 60  # what TeX holds in memory at once is bounded

_MATRIX = r"\begin{"


def _end(text: str, keep: bool) -> str:
    """The end of a row, further from the next one below a matrix.

    amsmath ends no page in a display by itself: where a row need not `keep` with the next, it says so.
    """
    may_end = "" if keep else r"\displaybreak[0] "
    return f" {may_end}\\\\{'[2pt]' if _MATRIX in text else ''}\n"


def in_columns(columns: Columns, label: str = "", last: int = LAST_OF_DISPLAY) -> Iterator[str]:
    """Rows of equations, the number at the end of the last."""
    yield "\\begingroup\\parskip=1pt\\lineskiplimit=2pt\\lineskip=3pt"
    count = len(columns.rows)
    for place, row in enumerate(columns.rows):
        cells = "".join(_cell(cell, columns) for cell in row)
        at_end = place == count - 1
        number = f"\\equationnumber{{{label}}}" if label and at_end else ""
        keep = "\\nopagebreak" if (last == LAST_OF_DOCUMENT if at_end else stays(place, count, last)) else ""
        yield f"\\equationrow{{{cells}{number}}}{keep}"
    yield "\\par\\endgroup"


def _cell(cell: Cell, columns: Columns) -> str:
    indent = _indent(cell.line)
    share = f"{cell.span / columns.count:.4f}"
    return f"\\equationcell{{{share}}}{{{columns.name:.2f}}}{{{cell.line.left}}}{{{indent}{cell.line.right}}}"


def level(line: Line) -> str:
    """A line with `&` at the place where lines are level."""
    return f"{line.left} & {_indent(line)}{line.right}"


def _indent(line: Line) -> str:
    return f"\\hspace{{{line.indent}em}}" if line.indent else ""


def gathered(rows: Sequence[tuple[Line, str]], keep: bool = False) -> Iterator[str]:
    """Formulas of one line each, one under the other; on one page where they are to `keep` together."""
    if not rows:
        return
    texts = [line.alone for line, _ in rows]
    if len(rows) == 1:
        label = rows[0][1]
        star = "" if label else "*"
        yield f"\\begin{{equation{star}}}{label}\n{texts[0]}\n\\end{{equation{star}}}"
        return
    labelled = [text + (label or r" \notag") for text, (_, label) in zip(texts, rows, strict=True)]
    body = "".join(text + _end(text, keep) for text in labelled[:-1]) + labelled[-1]
    yield f"\\begin{{gather}}\n{body}\n\\end{{gather}}"


def aligned(lines: Sequence[Line], label: str = "", last: int = LAST_OF_DISPLAY) -> Iterator[str]:
    """One formula on several lines, the number beside the last; a very long one in several displays."""
    for start in range(0, len(lines), _MOST_LINES):
        part = lines[start : start + _MOST_LINES]
        number = label if start + _MOST_LINES >= len(lines) else ""
        star = "" if number else "*"
        yield f"\\begin{{align{star}}}\n{''.join(_rows(part, number, last))}\n\\end{{align{star}}}"


def _rows(lines: Sequence[Line], label: str, last: int) -> Iterator[str]:
    count = len(lines)
    for place, line in enumerate(lines):
        at_end = place == count - 1
        tag = (label if at_end else r" \notag") if label else ""
        text = level(line) + tag
        yield text if at_end else text + _end(text, stays(place, count, last))
