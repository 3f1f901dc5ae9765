r"""Tables of Denavit-Hartenberg parameters as people draw them: a head with θ, d, a, α in some order.

In a report it is a table of Markdown (`| i | $\theta_i$ | ...`), of LaTeX (`tabular`, `array`, `pmatrix`), or
columns of plain text; its rows are those of the table, or its columns where it lies on its side.  Each
becomes rows [θ, d, a, α], in which every character keeps its place.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import groupby, islice

from dynsolve.answers.reading.dh_cells import Cell, Variables, bare, variables_of, without_rules
from dynsolve.answers.reading.dh_heads import order_of
from dynsolve.answers.reading.placed_text import Piece, PlacedText, placed

NAME = "DH"
"""The answer that such a table is."""

MOST_TABLES = 20
MOST_ROWS = 40
MOST_COLUMNS = 40
LONGEST = 20_000
"""Longer tables are none of these."""

_LONGEST_LINE = 1_000
_PIPE = re.compile(r"(?<!\\)[|│┃]")
_LINE = re.compile(r"[^\n]+")
_RULE = re.compile(r"[\s|:+=│┃┼├┤─━-]*")
_HEAD = re.compile(r"^(?=[^\n]*(?:theta|θ|ϑ))(?=[^\n]*(?:alpha|α))[^\n|&]{7,200}$", re.MULTILINE)
_COLUMNS = (
    re.compile(r"[ \t]*\t[ \t]*|[ \t]{2,}"),
    re.compile(r"[ \t]*[,;][ \t]*"),
    re.compile(r"(?<![-+*/−])[ \t]+(?![-+*/−][ \t])"),
)
"""What may stand between the columns of plain text: wide blanks, commas, blanks that are beside no sign."""

_LATEX = re.compile(
    r"(?P<opens>\$\$\s{0,9}|\\\[\s{0,9})?(?:[A-Za-z\\{}_ ]{1,30}=\s{0,9})?(?:\\left\s{0,3}[\[(|.]\s{0,9})?"
    r"\\begin\{(?P<name>tabular[x*]?|longtable|array|tblr|[pbvBV]?matrix)\}"
)
_AFTER = re.compile(r"\s{0,9}(?:\\right\s{0,3}[\])|.])?\s{0,9}[.,]?\s{0,9}(?:\$\$|\\\])?")
_PREAMBLE = re.compile(r"\s*(?:\[[^\]]*\])?\s*(?:\{(?:[^{}]|\{[^{}]*\})*\})*")
_ROW_END = re.compile(r"\\\\|\\tabularnewline(?![A-Za-z])")
_AMPERSAND = re.compile(r"(?<!\\)&")

Row = list[Cell]


@dataclass(frozen=True, slots=True)
class FoundTable:
    """A table of a report: where it begins and ends, and its rows [θ, d, a, α] as a text."""

    start: int
    end: int
    value: PlacedText


def tables_of(text: str, variables: Sequence[str] = ()) -> list[FoundTable]:
    """The tables of a text, in order; `variables` are the names of the joints' variables in theirs."""
    found = list(islice(_latex(text, variables), MOST_TABLES))
    found += islice(_piped(without(text, found), variables), MOST_TABLES)
    found += islice(_plain(without(text, found), variables), MOST_TABLES)
    return sorted(found, key=lambda table: table.start)[:MOST_TABLES]


def without(text: str, tables: Sequence[FoundTable]) -> str:
    """The text with blanks for its tables."""
    for table in tables:
        blank = re.sub(r"[^\n]", " ", text[table.start : table.end])
        text = text[: table.start] + blank + text[table.end :]
    return text


# -- where tables are ------------------------------------------------------------------------------


def _latex(text: str, variables: Sequence[str]) -> Iterator[FoundTable]:
    unclosed: set[str] = set()
    done = 0
    for opening in _LATEX.finditer(text) if "\\begin{" in text else ():
        name = opening["name"]
        closing = f"\\end{{{name}}}"
        end = -1 if name in unclosed or opening.start() < done else text.find(closing, opening.end())
        if end < 0:
            unclosed |= {name} if opening.start() >= done else set()
            continue
        after = _AFTER.match(text, end + len(closing)) if opening["opens"] else None
        done = after.end() if after else end + len(closing)
        if end - opening.end() <= LONGEST:
            preamble = None if name.endswith("matrix") else _PREAMBLE.match(text, opening.end(), end)
            start = preamble.end() if preamble else opening.end()
            rows = [_cells(text, a, b, _AMPERSAND) for a, b in _cells(text, start, end, _ROW_END)]
            yield from _table(text, (opening.start(), done), rows, variables)


def _piped(text: str, variables: Sequence[str]) -> Iterator[FoundTable]:
    """Tables of Markdown: lines of cells between bars, with or without bars at the ends."""
    if len(_PIPE.findall(text, 0, LONGEST * MOST_TABLES)) < 6:
        return
    lines = ((line.start(), min(line.end(), line.start() + _LONGEST_LINE)) for line in _LINE.finditer(text))
    number, last = 0, -2

    def block(line: Cell) -> int:
        """The number of the block of lines with bars that a line is in, 0 of one without."""
        nonlocal number, last
        if not _PIPE.search(text, *line):
            return 0
        number += line[0] != last + 1
        last = line[1]
        return number

    for is_table, found in groupby(lines, block):
        if is_table:
            spans = list(islice(found, 2 * MOST_ROWS))
            rows = [_between_bars(text, line) for line in spans if not _RULE.fullmatch(text, *line)]
            yield from _table(text, (spans[0][0], spans[-1][1]), rows, variables)


def _between_bars(text: str, line: Cell) -> Row:
    cells = _cells(text, *line, _PIPE)
    first, last = (not text[a:b].strip() for a, b in (cells[0], cells[-1]))
    return cells[int(first) : len(cells) - int(last)]


def _plain(text: str, variables: Sequence[str]) -> Iterator[FoundTable]:
    """Tables of plain text: below a line that is a head, lines of as many cells."""
    done = 0
    for head in _HEAD.finditer(text):
        if head.start() < done:
            continue
        for columns in _COLUMNS:
            rows = [_cells(text, *_inner(text, head.span()), columns)]
            if len(rows[0]) > 8 or order_of([text[a:b] for a, b in rows[0]]) is None:
                continue
            end = head.end()
            for line in islice(_LINE.finditer(text, end), 2 * MOST_ROWS):
                if _RULE.fullmatch(line[0]):
                    continue
                row = _in_columns(text, _inner(text, line.span()), columns, len(rows[0]))
                if row is None:
                    break
                rows.append(row)
                end = line.end()
            if len(rows) > 1:
                yield from _table(text, (head.start(), end), rows, variables)
                done = end
                break


def _in_columns(text: str, line: Cell, columns: re.Pattern[str], wanted: int) -> Row | None:
    """A line cut into as many cells as the head has; None where it does not fall into them."""
    for pattern in (columns, _COLUMNS[-1]):
        row = _cells(text, *line, pattern)
        if len(row) == wanted:
            return row
    return None


def _inner(text: str, line: Cell) -> Cell:
    """A line without the blanks around it."""
    start, end = line
    content = text[start:end]
    return start + len(content) - len(content.lstrip()), start + len(content.rstrip())


def _cells(text: str, start: int, end: int, separator: re.Pattern[str]) -> Row:
    """The stretches between separators."""
    ends = [(match.start(), match.end()) for match in separator.finditer(text, start, end)]
    starts = [start, *(after for _, after in ends)]
    return list(zip(starts, [*(before for before, _ in ends), end], strict=True))


# -- what they say ---------------------------------------------------------------------------------


def _table(text: str, span: Cell, rows: list[Row], variables: Sequence[str]) -> Iterator[FoundTable]:
    """The table of these rows, one of whose first two is a head, or whose first column is."""
    filled = [row for row in rows if any(without_rules(text, cell).strip() for cell in row)]
    filled = filled[: MOST_ROWS + 2]
    body = _below_head(text, filled) or _beside_head(text, filled)
    if body:
        yield FoundTable(*span, placed(_rows(text, body, variables_of(variables))))


def _below_head(text: str, rows: list[Row]) -> list[Row]:
    for place, head in enumerate(rows[:2]):
        order = order_of([without_rules(text, cell) for cell in head])
        if order is not None:
            least = 3
            return [_ordered(row, order) for row in rows[place + 1 :] if len(row) >= least]
    return []


def _ordered(row: Row, order: Sequence[int]) -> Row:
    """The cells θ, d, a, α of a row; one that is not there is empty."""
    end = row[-1][1]
    return [row[place] if place < len(row) else (end, end) for place in order]


def _beside_head(text: str, rows: list[Row]) -> list[Row]:
    """The columns of a table that lies on its side."""
    order = order_of([without_rules(text, row[0]) for row in rows])
    if order is None or len({len(rows[place]) for place in order}) > 1:
        return []
    columns = zip(*(rows[place][1 : MOST_COLUMNS + 1] for place in order), strict=True)
    return [list(column) for column in columns]


def _rows(text: str, body: list[Row], variable: Variables) -> Iterator[Piece]:
    yield "[", body[0][0][0]
    for i, row in enumerate(body):
        yield (", [" if i else "["), row[0][0]
        for j, cell in enumerate(row):
            content, at = bare(text, cell, variable)
            if j:
                yield ", ", at
            yield content, at
        yield "]", row[-1][1]
    yield "]", body[-1][-1][1]
