"""A matrix of which each row stands on a line of its own, with blanks inside its entries.

Whether a line is a row, and which blanks part its entries, is open: the shape of the answer decides.
"""

from __future__ import annotations

import re
from collections.abc import Iterable

from dynsolve.answers.reading.sources import is_balanced, levels

_LONGEST, _MOST_LINES = 20_000, 60
_OUTER = {"[": "]", "(": ")", "|": "|"}
_NO_ROW = re.compile(
    r"[ \t]*(?:[1-9][0-9 \t]*|[-─_ \t]*)|[ \t]*(?:[+*/=]|-[ \t]).*|.*(?:[-+*/({]|\.\.\.)[ \t]*|.*[=⎡⎢⎣⎛⎜⎝].*"
)
"""Powers above a line, a line of a fraction, and what goes on."""

_GAPS = [re.compile(rf"(?<=[^\s+*/,-])[ \t]{{{least},}}(?=[^\s+*/,-]|-[^\s])") for least in (2, 1)]
"""What may part two entries: wide blanks, else any, but beside no operator."""


def printed_matrix(text: str, first: int, end: int, shapes: Iterable[tuple[int, int]]) -> str:
    """The equation at an offset with a matrix of one of the shapes for its rows, as long as they are."""
    sign = text.find("=", first, end) + 1
    begin = text.rfind("\n", 0, first) + 1
    head, *below = text[sign : min(end, sign + _LONGEST)].split("\n", _MOST_LINES)
    blank = 0
    while below and not head.strip():
        blank += len(head) + 1
        head, *below = below
    indent = 0 if blank else sign - begin
    for rows, columns in shapes:
        lines = [" " * indent + head, *below[: rows - 1]]
        after = below[rows - 1] if len(below) >= rows else ""
        ends = not after.strip() or "=" in after
        is_bracketed = all(line.strip()[:1] in _OUTER for line in lines)
        if (
            1 < rows == len(lines)
            and ends
            and (blank or is_bracketed)
            and (joined := _joined(lines, columns))
        ):
            return f"{text[first:sign]}[{(' ' * blank + joined[indent:])[1:]}]"
    return ""


def _joined(lines: list[str], columns: int) -> str:
    """The lines with semicolons between them and commas in them; empty where they are no such rows."""
    rows = list(map(_without_brackets, lines))
    if not all(is_balanced(row) and not _NO_ROW.fullmatch(row) for row in rows):
        return ""
    found = [_commas(row, columns) for row in rows]
    aligned = {commas for commas in found if commas is not None}
    for place, row in enumerate(rows):
        if found[place] is None:
            fits = [commas for commas in aligned if all(row[at : at + 1].isspace() for at in commas)]
            found[place] = fits[0] if len(fits) == 1 else None
    if None in found:
        return ""
    return ";".join(
        "".join("," if at in (commas or ()) else sign for at, sign in enumerate(row))
        for row, commas in zip(rows, found, strict=True)
    )


def _without_brackets(line: str) -> str:
    """The line with blanks for the bracket around all of it, and for the sign behind it."""
    start, end = len(line) - len(line.lstrip()), len(line.rstrip(" \t,;"))
    inside = line[start + 1 : end - 1]
    is_around = end - start > 2 and _OUTER.get(line[start]) == line[end - 1]
    if is_around and is_balanced(inside) and "|" not in inside:
        return f"{' ' * (start + 1)}{inside}".ljust(len(line))
    return line[:end].ljust(len(line))


def _commas(row: str, columns: int) -> tuple[int, ...] | None:
    """Where commas stand between the entries of a row, or belong; None where the blanks leave that open."""
    depths = levels(row)
    given = [at for at, sign in enumerate(row) if sign == "," and depths[at] == 0]
    if given or columns == 1:
        return tuple(given) if len(given) == columns - 1 else None
    for blanks in _GAPS:
        gaps = [gap.end() - 1 for gap in blanks.finditer(row) if depths[gap.start()] == 0]
        if len(gaps) == columns - 1:
            return tuple(gaps)
    return None
