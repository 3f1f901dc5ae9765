r"""Denavit-Hartenberg tables as people draw them: a head with θ, d, a, α in some order, a row a frame.

In a report it is a table of Markdown (`| i | $\theta_i$ | ...`) or of LaTeX (`tabular`, `array`); in an
answer file rows may be mappings, or the first of them the head.  Each becomes rows [θ, d, a, α], in
which every character keeps its place.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import islice

from dynsolve.answers.reading.placed_text import Piece, PlacedText, placed

NAME = "DH"
"""The answer that such a table is."""

MOST_TABLES = 20
MOST_ROWS = 40
LONGEST = 20_000
"""Longer tables are none of these."""

_HEAD = re.compile(
    r"[\s$\\*{}(]*(?:(?:mathbf|boldsymbol|text|mathrm|bm)[\s{\\]*)?(?:var)?(theta|alpha|θ|ϑ|α|d|a)(?![A-Za-z])"
)
_COLUMNS = {"theta": 0, "θ": 0, "ϑ": 0, "d": 1, "a": 2, "alpha": 3, "α": 3}
_MARKDOWN = re.compile(r"(?:^[ \t]*\|[^\n]*\|[ \t]*(?:\n|\Z)){3,}", re.MULTILINE)
_RULE = re.compile(r"[\s|:-]*")
_LATEX = re.compile(r"(?:\$\$\s{0,9}|\\\[\s{0,9})?\\begin\{(?P<name>tabular[x*]?|longtable|array|tblr)\}")
_AFTER = re.compile(r"\s{0,9}(?:\$\$|\\\])")
_LINES = re.compile(
    r"\\(?:hline|toprule|midrule|bottomrule|endhead|cline\s*\{[^{}]*\}|cmidrule(?:\([^)]*\))?\s*\{[^{}]*\})"
)
_PREAMBLE = re.compile(r"\s*(?:\[[^\]]*\])?\s*(?:\{(?:[^{}]|\{[^{}]*\})*\})*")
_DOLLARS = re.compile(r"(?:\$|\\\(|\\\)|\s|~)*")

Cell = tuple[int, int]
"""Where a cell begins and ends."""


@dataclass(frozen=True, slots=True)
class FoundTable:
    """A table of a report: where it begins and ends, and its rows [θ, d, a, α] as a text."""

    start: int
    end: int
    value: PlacedText


def column_of(head: str) -> int | None:
    r"""The column that a head names: 0 for θ, 1 for d, 2 for a, 3 for α; None of another.

    >>> column_of("theta_i [deg]"), column_of(r"$\alpha_{i-1}$"), column_of("Link")
    (0, 3, None)
    """
    match = _HEAD.match(head) if len(head) <= 80 else None
    return _COLUMNS[match[1]] if match else None


def order_of(heads: Sequence[str]) -> tuple[int, ...] | None:
    r"""The places of θ, d, a, α in a head; None of what is no head.

    >>> order_of(["Link", "$a_i$", r"$\alpha_i$", "$d_i$", r"$\theta_i$"])
    (4, 3, 1, 2)
    """
    found: dict[int, int] = {}
    for place, head in enumerate(heads):
        column = column_of(head)
        if column in found:
            return None
        if column is not None:
            found[column] = place
    return tuple(found[column] for column in range(4)) if len(found) == 4 else None


def tables_of(text: str) -> Iterator[FoundTable]:
    """The tables of a report, in order."""
    found = [*_markdown(text), *_latex(text)]
    yield from islice(sorted(found, key=lambda table: table.start), MOST_TABLES)


def without(text: str, tables: Sequence[FoundTable]) -> str:
    """The text with blanks for its tables."""
    for table in tables:
        blank = re.sub(r"[^\n]", " ", text[table.start : table.end])
        text = text[: table.start] + blank + text[table.end :]
    return text


def _markdown(text: str) -> Iterator[FoundTable]:
    if "|" not in text:
        return
    for block in _MARKDOWN.finditer(text):
        rows = []
        for line in re.finditer(r"[^\n]+", text[block.start() : block.end()]):
            start = block.start() + line.start()
            if not _RULE.fullmatch(line[0]):
                rows.append(_cells(text, start, start + len(line[0]), r"(?<!\\)\|")[1:-1])
        yield from _table(text, block.start(), block.end(), rows)


def _latex(text: str) -> Iterator[FoundTable]:
    unclosed: set[str] = set()
    done = 0
    for opening in _LATEX.finditer(text) if "\\begin{" in text else ():
        name = opening["name"]
        closing = f"\\end{{{name}}}"
        end = -1 if name in unclosed or opening.start() < done else text.find(closing, opening.end())
        if end < 0:
            unclosed |= {name} if opening.start() >= done else set()
            continue
        after = _AFTER.match(text, end + len(closing)) if opening[0][0] in "$\\" else None
        done = after.end() if after and not opening[0].startswith("\\begin") else end + len(closing)
        if end - opening.end() <= LONGEST:
            preamble = _PREAMBLE.match(text, opening.end(), end)
            start = preamble.end() if preamble else opening.end()
            rows = [_cells(text, a, b, r"(?<!\\)&") for a, b in _cells(text, start, end, r"\\\\")]
            yield from _table(text, opening.start(), done, rows)


def _cells(text: str, start: int, end: int, separator: str) -> list[Cell]:
    """The stretches between separators."""
    ends = [(match.start(), match.end()) for match in re.compile(separator).finditer(text, start, end)]
    starts = [start, *(after for _, after in ends)]
    return list(zip(starts, [*(before for before, _ in ends), end], strict=True))


def _table(text: str, start: int, end: int, rows: list[list[Cell]]) -> Iterator[FoundTable]:
    """The table whose first row is a head."""
    filled = [row for row in rows if any(_bare(text, cell)[0] for cell in row)][: MOST_ROWS + 1]
    order = order_of([text[a:b] for a, b in _ruled(text, filled[0])]) if filled else None
    if order is None:
        return
    body = [[row[place] for place in order] for row in filled[1:] if len(row) > max(order)]
    if body:
        yield FoundTable(start, end, placed(_rows(text, body)))


def _ruled(text: str, row: list[Cell]) -> list[Cell]:
    """The cells of a row after the rules that stand before it."""
    start = row[0][0]
    while (rule := re.compile(rf"\s*{_LINES.pattern}").match(text, start, row[0][1])) is not None:
        start = rule.end()
    return [(start, row[0][1]), *row[1:]]


def _rows(text: str, body: list[list[Cell]]) -> Iterator[Piece]:
    yield "[", body[0][0][0]
    for i, row in enumerate(body):
        yield (", [" if i else "["), row[0][0]
        for j, cell in enumerate(row):
            content, at = _bare(text, cell)
            if j:
                yield ", ", at
            yield (content or "0"), at
        yield "]", row[-1][1]
    yield "]", body[-1][-1][1]


def _bare(text: str, cell: Cell) -> Piece:
    """A cell without rules, dollars and blanks around it; empty where a dash stands for 0."""
    start, end = cell
    plain = _LINES.sub(lambda rule: " " * len(rule[0]), text[start:end])
    lead = _DOLLARS.match(plain)
    skipped = lead.end() if lead else 0
    content = re.sub(r"(?:\$|\\\)|\s|~)+$", "", plain[skipped:])
    return ("" if content in ("-", "--", "–", "—") else content), start + skipped
