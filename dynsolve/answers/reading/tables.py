r"""Tables in a report: a row `| $P_1$ | $m_1 g L_1$ |` gives P_1, a cell may hold an equation of its own.

Every change keeps the length of the text, so that every character stays at its place.
"""

from __future__ import annotations

import re
from collections.abc import Callable

_ROW = re.compile(r"(?m)^[ \t]*\|[^\n]*\|[^\n|]*$")
_BAR = re.compile(r"\$[^$\n]*\$|\\\||\|")
_INLINE = re.compile(r"\\\(([^$\n]{0,1000}?)\\\)")
_MARKUP = re.compile(r"[$*`]")
_VALUE = re.compile(r"[ \t]*(?:\$[^$=]+\$[ \t.,;]*|[^$=]*[^$=\s:-][^$=]*)")
_LONGEST_NAME = 60


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
    is_name = 0 < len(plain.strip()) <= _LONGEST_NAME and "=" not in plain and _VALUE.fullmatch(value)
    if not is_name or not names_answer(plain.strip()):
        return ""
    if "$" not in value:
        return f"{plain}={value}"
    blank = len(plain) - len(plain.lstrip()) - 1
    return f"{plain[:blank]}${plain[blank + 1 :]}={value.replace('$', ' ', 1)}" if blank >= 0 else ""
