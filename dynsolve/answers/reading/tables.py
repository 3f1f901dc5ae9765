r"""Tables in a report: a row `| $P_1$ | $m_1 g L_1$ |` gives P_1, a cell may hold an equation of its own.

Every change keeps the length of the text, so that every character stays at its place.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from functools import partial
from itertools import pairwise

from dynsolve.answers.reading.displays import Display
from dynsolve.answers.reading.sources import Source
from dynsolve.answers.submission import Place

_ROW = re.compile(r"(?m)^[ \t]*\|[^\n]*\|[^\n|]*$")
_BAR = re.compile(r"\$[^$\n]*\$|\\\||\|")
_INLINE = re.compile(r"\\\(([^$\n]{0,1000}?)\\\)")
_MARKUP = re.compile(r"[$*`]")
_VALUE = re.compile(r"[ \t]*(?:\$[^$=]+\$[ \t.,;]*|[^$=]*[^$=\s:-][^$=]*)")
_LONGEST_NAME = 60
_HEADED = re.compile(
    r"(?m)^[ \t]*(?P<heads>\|[^\n]+\|)[ \t]*\n[ \t]*\|[-: \t|]+\|[ \t]*\n[ \t]*(?P<values>\|[^\n]+\|)[ \t]*$"
)
"""A table with one row of values."""


def with_equations(text: str, names_answer: Callable[[str], bool]) -> str:
    """The text with a line for each cell of its tables, and an equation for a name beside a value."""
    if "|" not in text:
        return text
    return _ROW.sub(lambda row: _lines(_INLINE.sub(_in_dollars, row[0]), names_answer), text)


def _in_dollars(formula: re.Match[str]) -> str:
    return f" ${formula[1]}$ "


def _lines(row: str, names_answer: Callable[[str], bool]) -> str:
    bars = [found.start() for found in _BAR.finditer(row) if found[0] == "|"]
    between = "".join(row[a + 1 : b] for a, b in zip(bars[1::2], bars[2::2], strict=False))
    if len(bars) % 2 == 0 and not between.strip() and not {"=", "$"} & set(row):
        return row  # one row of matrices that are drawn
    cells = [row[a + 1 : b] for a, b in zip(bars, [*bars[1:], len(row)], strict=True)]
    pieces = [row[: bars[0]]]
    at = 0
    while at < len(cells):
        equation = _equation(cells[at], cells[at + 1], names_answer) if at + 2 < len(cells) else ""
        pieces.append(equation or cells[at])
        at += 2 if equation else 1
    return "\n".join(pieces)


def _equation(name: str, value: str, names_answer: Callable[[str], bool]) -> str:
    """The two cells as one equation, empty where they are none."""
    plain = _MARKUP.sub(" ", name)
    if not _are_names(plain, names_answer) or not _VALUE.fullmatch(value):
        return ""
    if "$" not in value:
        return f"{plain}={value}"
    blank = len(plain) - len(plain.lstrip()) - 1
    return f"{plain[:blank]}${plain[blank + 1 :]}={value.replace('$', ' ', 1)}" if blank >= 0 else ""


def _are_names(plain: str, names_answer: Callable[[str], bool]) -> bool:
    """Whether a cell is the name of an answer, or of several that are the same: d_12 = d_21."""
    return len(plain) <= _LONGEST_NAME and all(names_answer(name.strip()) for name in plain.split("="))


def headed_columns(
    text: str, source: Source, names_answer: Callable[[str], bool]
) -> tuple[str, list[tuple[int, Display]]]:
    """The equations of tables with names as their heads and a row of values, and the text without these."""
    found = list[tuple[int, Display]]()
    for table in list(_HEADED.finditer(text)):
        heads = [_MARKUP.sub(" ", head).strip() for _, head in _cells(table["heads"])]
        values = _cells(table["values"])
        if len(heads) != len(values) or not all(_are_names(head, names_answer) for head in heads):
            continue
        for head, (at, value) in zip(heads, values, strict=True):
            place = partial(_place, source, table.start("values") + at - len(head) - 1)
            found.append(
                (table.start("values") + at, Display(f"{head}={value.replace('$', ' ')}", "", place))
            )
        text = text[: table.start()] + " " * len(table[0]) + text[table.end() :]
    return text, found


def _place(source: Source, start: int, offset: int, length: int) -> Place:
    return source.place(start + offset, length)


def _cells(row: str) -> list[tuple[int, str]]:
    """The cells of a row, each with the offset at which it begins."""
    bars = [found.start() for found in _BAR.finditer(row) if found[0] == "|"]
    return [(a + 1, row[a + 1 : b]) for a, b in pairwise(bars)]
