r"""The cells of a table of Denavit-Hartenberg parameters as a report has them, and as they are read.

What is only set beside a value is left out: dollars, rules, "(variable)"; a dash or nothing is 0.  Every
character that is kept stays at its place.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from itertools import count

from dynsolve.answers.reading.placed_text import Piece

Cell = tuple[int, int]
"""Where a cell begins and ends in the text."""

RULE = re.compile(
    r"\\(?:hline|toprule|midrule|bottomrule|endhead|endfirsthead|addlinespace"
    r"|(?:cline|rowcolor|hhline)\s*\{[^{}]*\}|cmidrule(?:\([^)]*\))?\s*\{[^{}]*\})"
)
"""The lines between the rows of a table of LaTeX."""

_SPACING = re.compile(r"\A\s*\[\s*-?[0-9.]+\s*(?:pt|em|ex|mm|cm)\s*\]")
_SPANNING = re.compile(r"\A\s*\\multi(?:column|row)\s*\{[^{}]*\}\s*\{[^{}]*\}(?=\s*\{)")
_SIGNS = re.compile(r"\$|\\[()]|(?<!\\)~|\\[,;:!]|\\(?:centering|displaystyle|rule|strut)(?![A-Za-z])")
_DEGREES = re.compile(r"\\(?:SI|qty|ang)\s*\{\s*([-+−]?[0-9.]+)\s*\}(?:\s*\{\s*\\(?:degree|deg)\s*\})?")
_DEGREE = re.compile(r"\\(?:degree|textdegree)(?![A-Za-z])(?:\s*\{\})?")
_RAISED = re.compile(r"\\textsuperscript\s*\{")
_VARIABLE = re.compile(
    r"\(\s*(?:variable|variabel|var\.?)\s*\)|(?<![\w\\])(?:variable|variabel|var\.?)(?!\w)"
)
_DASHES = frozenset({"", "-", "--", "---", "–", "—", "−"})
_BLANK = re.compile(r"[^\n]")

Variables = Callable[[], str]
"""The joint variable of the next row that only says that it has one."""


def variables_of(names: Sequence[str]) -> Variables:
    """The joint variables in their order, for cells that only say `variable`."""
    numbers = count()

    def following() -> str:
        place = next(numbers)
        return names[place] if place < len(names) else ""

    return following


def without_rules(text: str, cell: Cell) -> str:
    """The text of a cell, blanks for lines, spacing and what says that it spans several columns."""
    plain = text[cell[0] : cell[1]]
    for pattern in (RULE, _SPACING, _SPANNING):
        plain = pattern.sub(_blank, plain)
    return plain


def bare(text: str, cell: Cell, variable: Variables) -> Piece:
    """A cell as it is read, and where it begins."""
    plain = without_rules(text, cell)
    plain = _DEGREES.sub(lambda found: _filled(found, f"({found[1]}°)"), plain)
    plain = _DEGREE.sub(lambda found: _filled(found, "°"), plain)
    plain = _RAISED.sub(lambda found: "^{".rjust(len(found[0])), plain)
    plain = _SIGNS.sub(_blank, plain)
    says_variable = _VARIABLE.search(plain)
    content = (_VARIABLE.sub(_blank, plain) if says_variable else plain).rstrip()
    start = len(content) - len(content.lstrip())
    content = content.strip()
    if content in _DASHES:
        content = (variable() if says_variable else "") or "0"
    return content, cell[0] + start


def _blank(found: re.Match[str]) -> str:
    return _BLANK.sub(" ", found[0])


def _filled(found: re.Match[str], text: str) -> str:
    """A text in place of a longer one, of its length."""
    return text.ljust(len(found[0]))
