r"""Tables of Denavit-Hartenberg parameters as people draw them: a head with θ, d, a, α in some order.

In a report it is a table of Markdown (`| i | $\theta_i$ | ...`), of LaTeX (`tabular`, `array`, `pmatrix`), or
columns of plain text; its rows are those of the table, or its columns where it lies on its side.  Each
becomes rows [θ, d, a, α], in which every character keeps its place.

What is only set beside a value is left out: dollars, rules, "(variable)"; a dash or nothing is 0.  Every
character that is kept stays at its place.

A head is a symbol ($\alpha_{i-1}$, `theta_i [deg]`), a symbol after its words (`Link length a_i`), or words
alone (`twist`, `Rot x`).

Tables in a report: a row `| $P_1$ | $m_1 g L_1$ |` gives P_1, a cell may hold an equation of its own.

Every change keeps the length of the text, so that every character stays at its place.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator, Sequence
from itertools import count, groupby, islice, pairwise

from msgspec import Struct

from dynsolve.answers.reading.displays import Display
from dynsolve.answers.reading.sources import Piece, PlacedText, Source, blanked, hidden, placed

# The cells of a table of Denavit-Hartenberg parameters as a report has them, and as they are read

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
    plain = _DEGREES.sub(lambda found: f"({found[1]}°)".ljust(len(found[0])), plain)
    plain = _DEGREE.sub(lambda found: "°".ljust(len(found[0])), plain)
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
    return blanked(found[0])


# The heads of tables of Denavit-Hartenberg parameters: which column is θ, which d, a, α

_LONGEST = 80
_FONT = r"(?:(?:mathbf|boldsymbol|textbf|text|mathrm|bm|mathit)[\s{\\$]*)?"
_SYMBOL = re.compile(
    rf"[\s$\\*{{}}(]*{_FONT}(?:var)?(theta|alpha|θ|ϑ|α|d|a)(?![A-Za-zα-ω])(?![ \t]+[A-Za-z])", re.IGNORECASE
)
_SYMBOL_INSIDE = re.compile(r"(?<![A-Za-z])(theta|alpha|θ|ϑ|α|[da](?=\W{0,3}[\]_}$ᵢ)]|\s*$))(?![A-Za-z])")
_DH_HEADS_COLUMNS = {"theta": 0, "θ": 0, "ϑ": 0, "d": 1, "a": 2, "alpha": 3, "α": 3}
_WORDS = (
    (re.compile(r"joint angle|rot\w*[\s_({]*z|r[_{]+z", re.IGNORECASE), 0),
    (re.compile(r"offset|trans\w*[\s_({]*z", re.IGNORECASE), 1),
    (re.compile(r"link length|trans\w*[\s_({]*x", re.IGNORECASE), 2),
    (re.compile(r"twist|rot\w*[\s_({]*x|r[_{]+x", re.IGNORECASE), 3),
)
_TWIST = re.compile(rf"alpha|α|{_WORDS[3][0].pattern}", re.IGNORECASE)
"""What stands in the head of every table."""


def column_of(head: str) -> int | None:
    r"""The column that a head names: 0 for θ, 1 for d, 2 for a, 3 for α; None of another.

    >>> column_of("theta_i [deg]"), column_of(r"$\alpha_{i-1}$"), column_of("Link"), column_of("Link twist")
    (0, 3, None, 3)
    """
    if len(head) > _LONGEST:
        return None
    symbol = _SYMBOL.match(head) or _SYMBOL_INSIDE.search(head)
    if symbol is not None:
        return _DH_HEADS_COLUMNS[symbol[1].lower()]
    return next((column for words, column in _WORDS if words.search(head)), None)


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


class FoundTable(Struct, frozen=True):
    """A table of a report: where it begins and ends, and its rows [θ, d, a, α] as a text."""

    start: int
    end: int
    value: PlacedText


def tables_of(text: str, variables: Sequence[str] = ()) -> list[FoundTable]:
    """The tables of a text, in order; `variables` are the names of the joints' variables in theirs."""
    if not _TWIST.search(text):
        return []
    found = list(islice(_latex(text, variables), MOST_TABLES))
    found += islice(_piped(without(text, found), variables), MOST_TABLES)
    found += islice(_plain(without(text, found), variables), MOST_TABLES)
    return sorted(found, key=lambda table: table.start)[:MOST_TABLES]


def without(text: str, tables: Iterable[FoundTable]) -> str:
    """The text with blanks for its tables."""
    return hidden(text, ((table.start, table.end) for table in tables))


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
    rows = (_cells(text, *line, pattern) for pattern in (columns, _COLUMNS[-1]))
    return next((row for row in rows if len(row) == wanted), None)


def _inner(text: str, line: Cell) -> Cell:
    """A line without the blanks around it."""
    start, end = line
    content = text[start:end]
    return start + len(content) - len(content.lstrip()), start + len(content.rstrip())


def _cells(text: str, start: int, end: int, separator: re.Pattern[str]) -> Row:
    """The stretches between separators."""
    borders = [start, *(at for sign in separator.finditer(text, start, end) for at in sign.span()), end]
    return list(zip(borders[::2], borders[1::2], strict=True))


# -- what they say ---------------------------------------------------------------------------------


def _table(text: str, span: Cell, rows: list[Row], variables: Sequence[str]) -> Iterator[FoundTable]:
    """The table of these rows, one of whose first two is a head, or whose first column is; no empty one."""
    filled = [row for row in rows if any(without_rules(text, cell).strip() for cell in row)]
    filled = filled[: MOST_ROWS + 2]
    body = _below_head(text, filled) or _beside_head(text, filled)
    if any(without_rules(text, cell).strip() for row in body for cell in row):
        yield FoundTable(*span, placed(_rows(text, body, variables_of(variables))))


def _below_head(text: str, rows: list[Row]) -> list[Row]:
    """The cells θ, d, a, α of the rows below a head; one that is not there is empty."""
    for number, head in enumerate(rows[:2], 1):
        order = order_of([without_rules(text, cell) for cell in head])
        if order is not None:
            wide = [(row, (row[-1][1], row[-1][1])) for row in rows[number:] if len(row) > 2]
            return [[row[at] if at < len(row) else blank for at in order] for row, blank in wide]
    return []


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


# Tables in a report

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
    return _ROW.sub(lambda row: _lines(_INLINE.sub(r" $\1$ ", row[0]), names_answer), text)


def _lines(row: str, names_answer: Callable[[str], bool]) -> str:
    bars = [found.start() for found in _BAR.finditer(row) if found[0] == "|"]
    between = "".join(row[a + 1 : b] for a, b in zip(bars[1::2], bars[2::2], strict=False))
    if len(bars) % 2 == 0 and not between.strip() and not {"=", "$"} & set(row):
        return row  # one row of matrices that are drawn
    cells = [row[a + 1 : b] for a, b in zip(bars, [*bars[1:], len(row)], strict=True)]
    if cells[-1].lstrip().startswith("="):
        return row  # a determinant in bars
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
        heads = [_MARKUP.sub(" ", head).strip() for _, head in _tables_cells(table["heads"])]
        values = _tables_cells(table["values"])
        if len(heads) != len(values) or not all(_are_names(head, names_answer) for head in heads):
            continue
        for head, (at, value) in zip(heads, values, strict=True):
            at += table.start("values")
            equation = f"{head}={value.replace('$', ' ')}"
            found.append((at, Display(equation, "", source.behind(at - len(head) - 1))))
        text = text[: table.start()] + " " * len(table[0]) + text[table.end() :]
    return text, found


def _tables_cells(row: str) -> list[tuple[int, str]]:
    """The cells of a row, each with the offset at which it begins."""
    bars = [found.start() for found in _BAR.finditer(row) if found[0] == "|"]
    return [(a + 1, row[a + 1 : b]) for a, b in pairwise(bars)]
