"""Parentheses and matrices in every notation: bmatrix, [[a, b], [c, d]], [a, b; c, d], rows below rows."""

from __future__ import annotations

from dynsolve.answers.reading.grammar.reader import Reader
from dynsolve.answers.reading.grammar.references import placeholder, whole_of
from dynsolve.answers.reading.grids import MAX_ENTRIES, Abstract, Grid, Value, stacked
from dynsolve.answers.reading.lexer import Token
from dynsolve.errors import ReadError
from dynsolve.notation.tree import ZERO, Node, Reference, Symbol

STOPS = frozenset({"quad", "qquad"})
_MATRICES = frozenset(
    "matrix pmatrix bmatrix Bmatrix vmatrix Vmatrix smallmatrix psmallmatrix bsmallmatrix array".split()
)


_MARKS = frozenset({"*", "cdot"})
_SYMMETRIC = frozenset("sym symm symmetric".split())
_ROW_SIGNS = frozenset({"&", "\\\\", "close"})
_ENTRY_ENDS = frozenset({"&", "\\\\", ",", ";", "]", "}", "close", "⟩", "|"})
MIRRORED = Symbol("*")
"""What stands for an entry that a symmetric matrix has across its diagonal: `*`, `sym.`"""

EMPTY = Symbol("")
"""What stands for an entry that was left blank."""

_DOT = Symbol("\\cdot")
"""What stands for an entry that is a dot: that across the diagonal of a symmetric matrix, or 0."""

SYMMETRIC_NOTE = "a mark in a symmetric matrix is read as the entry across the diagonal"


def read(reader: Reader) -> Value:
    """A parenthesis or a matrix, whose bracket is looked at."""
    start, symbols = reader.position, dict(reader.symbols)
    found = {"begin": environment, "(": parenthesis, "⟨": _angular, "[": square}[reader.token.kind](reader)
    if reader.naming or not isinstance(found, Grid) or not isinstance(found.rows[0][0], Reference):
        return found
    whole = _named(reader, reader.tokens[start : reader.position])
    if not whole:
        return found
    reader.symbols.clear()
    reader.symbols.update(symbols)
    return placeholder(reader.vocabulary, whole)


def _named(reader: Reader, tokens: list[Token]) -> str:
    """The matrix whose entries are named, empty where they are not: C of [C_11, C_12; C_21, C_22]."""
    try:
        found = reader.inner(tokens, naming=True)
    except ReadError:
        return ""
    names = whole_of(reader.vocabulary, found) if isinstance(found, Grid) else ()
    return names[0] if names else ""


def _angular(reader: Reader) -> Value:
    """Maple's `<a, b>`, a column, and `<<a | b>, <c | d>>`."""
    opening = reader.take()
    before, reader.bars_separate = reader.bars_separate, True
    rows: list[list[Value]] = [[entry(reader)]]
    while reader.token.kind in (",", "|") and len(rows) <= MAX_ENTRIES:
        if reader.take().kind == ",":
            rows.append([])
        rows[-1].append(entry(reader))
    reader.expect("⟩", opening)
    reader.bars_separate = before
    return finished(reader, rows, opening)


def parenthesis(reader: Reader) -> Value:
    """(a + b); or a tuple (a, b), a column."""
    before, reader.rows_by_line = reader.rows_by_line, False
    blanks, reader.by_blanks = reader.by_blanks, False
    found = _parenthesis(reader)
    reader.rows_by_line, reader.by_blanks = before, blanks
    return found


def _parenthesis(reader: Reader) -> Value:
    opening = reader.take()
    if reader.token.kind == ")":
        raise opening.fault("there is nothing between these parentheses", "write what belongs there", 2)
    first = reader.sum()
    if reader.token.kind == "end" and isinstance(first, Grid) and opening.text in ("\\{", "\\lbrace"):
        return first  # the brace at the side of a column
    rows = [[first]]
    while reader.token.kind == ",":
        reader.take()
        rows.append([reader.sum()])
    reader.expect(")", opening)
    return finished(reader, rows, opening)


def listed(reader: Reader, first: Value, opening: Token) -> Value:
    """The rest of `{a, b}`, a list as Mathematica writes it; or a group around one sum."""
    entries = [first]
    while reader.token.kind == "," and len(entries) < MAX_ENTRIES:
        reader.take()
        entries.append(reader.sum())
    reader.expect("}", opening)
    if len(entries) == 1:
        return first
    if all(isinstance(entry, Grid) and entry.shape[0] == 1 for entry in entries):
        return finished(reader, [[entry] for entry in entries], opening)
    return finished(reader, [entries], opening)


def square(reader: Reader) -> Value:
    """[...]: rows after commas, semicolons or line ends; or a bracket around a sum."""
    before, blanks = reader.rows_by_line, reader.by_blanks
    reader.rows_by_line, reader.by_blanks = _lines_are_rows(reader), "spaces" in reader.options
    found = _square(reader)
    reader.rows_by_line, reader.by_blanks = before, blanks
    return found


def _lines_are_rows(reader: Reader) -> bool:
    """Whether the lines inside the bracket here are rows: entries with commas, no other sign between rows."""
    level, commas, lines = 0, 0, [0]
    by_spaces = "spaces" in reader.options
    for token in reader.tokens[reader.position : reader.position + 2_000]:
        level += (token.kind in ("[", "(", "{")) - (token.kind in ("]", ")", "}"))
        if level == 0:
            break
        if token.kind in (";", "\\\\", "&", "begin") or (token.kind == "[" and level > 1):
            return False
        if token.broken and level == 1 and token.kind != "]" and (commas or by_spaces):
            lines.append(0)
        if token.kind == "," and level == 1:
            lines[-1] += 1
            commas += 1
    return len(lines) > 1 and len(set(lines)) == 1 and (lines[0] > 0 or by_spaces)


def _square(reader: Reader) -> Value:
    opening = reader.take()
    rows: list[list[Value]] = [[]]
    if reader.token.kind == "]":
        raise opening.fault("there is nothing between these brackets", "write the entries", 2)
    count = 0
    while True:
        while reader.token.kind in (";", "\\\\"):
            reader.take()
            if rows[-1]:
                rows.append([])
        if reader.token.kind == "]":
            break
        rows[-1].append(entry(reader))
        count += 1
        if count > MAX_ENTRIES:
            raise opening.fault(f"a matrix of more than {MAX_ENTRIES} entries", "check the brackets", 1)
        kind = reader.token.kind
        if kind == "," or kind == "&":
            reader.take()
        elif reader.rows_by_line and reader.token.broken and kind != "]":
            rows.append([])
        elif kind not in (";", "\\\\", "]") and not (reader.by_blanks and reader.token.spaced):
            reader.expect("]", opening)
    reader.expect("]", opening)
    rows = [row for row in rows if row]
    if len(rows) == 1 and len(rows[0]) == 1:
        return rows[0][0]
    if len(rows) == 1 and all(isinstance(entry, Grid) and entry.shape[0] == 1 for entry in rows[0]):
        rows = [[entry] for entry in rows[0]]
    found = finished(reader, rows, opening)
    if _next_row(reader, found):
        return _rows_below(reader, found, opening)
    return found


def _next_row(reader: Reader, found: Value) -> bool:
    """Whether a line below begins with one more row, as MATLAB prints a matrix."""
    one_row = isinstance(found, Grid) and found.shape[0] == 1
    return one_row and reader.token.kind == "[" and reader.token.broken


def _rows_below(reader: Reader, first: Value, opening: Token) -> Value:
    assert isinstance(first, Grid)
    rows: list[list[Value]] = [list(first.rows[0])]
    while reader.token.kind == "[" and reader.token.broken and len(rows) < MAX_ENTRIES:
        bracket = reader.take()
        row: list[Value] = []
        while reader.token.kind != "]":
            row.append(entry(reader))
            if reader.token.kind == ",":
                reader.take()
            elif reader.token.kind != "]":
                reader.expect("]", bracket)
        reader.expect("]", bracket)
        rows.append(row)
    return finished(reader, rows, opening)


def environment(reader: Reader) -> Value:
    r"""`\begin{bmatrix} a & b \\ c & d \end{bmatrix}`."""
    opening = reader.take()
    name = opening.text.rstrip("*")
    if name not in _MATRICES:
        raise opening.fault(f"the environment `{name[:40]}` is not read", "matrices are written in bmatrix")
    rows: list[list[Value]] = [[]]
    blanks: list[Token] = []
    while reader.token.kind not in ("close", "end"):
        if reader.token.kind == "\\\\":
            reader.take()
            rows.append([])
            continue
        if reader.token.kind == "&":
            blanks.append(reader.token)
            rows[-1].append(EMPTY)
        else:
            rows[-1].append(entry(reader))
            if reader.token.kind == "," and reader.peek().kind in _ROW_SIGNS:
                reader.take()
            if reader.token.kind not in (",", *_ROW_SIGNS):
                raise reader.unexpected("`&` or `\\\\` is expected between the entries of a matrix")
        if reader.token.kind in ("&", ","):
            sign = reader.take()
            if reader.token.kind in ("\\\\", "close"):
                blanks.append(sign)
                rows[-1].append(EMPTY)
    if reader.token.kind == "end":
        raise opening.fault(f"this `\\begin{{{name}}}` is never closed", f"add \\end{{{name}}}")
    reader.take()
    rows = [row for row in rows if row]
    if not rows:
        raise opening.fault("this matrix is empty", "write its entries")
    if blanks and not _are_zeros(rows):
        raise blanks[0].fault("an entry of this matrix is empty", "write 0 where nothing stands", 1)
    return finished(reader, [[ZERO if entry is EMPTY else entry for entry in row] for row in rows], opening)


def _are_zeros(rows: list[list[Value]]) -> bool:
    """Whether blanks are the zeros beside a diagonal: the one across is blank too, and no 0 is written."""
    size = range(len(rows))
    is_square = all(len(row) == len(rows) for row in rows)
    return is_square and all(
        rows[i][j] != ZERO and (rows[i][j] is not EMPTY or (i != j and rows[j][i] is EMPTY))
        for i in size
        for j in size
    )


def entry(reader: Reader) -> Value:
    """One entry of a matrix, which may be the mark of a symmetric one."""
    ahead = 1 + (reader.peek().kind == ".")
    is_mark = reader.token.kind in _MARKS or reader.token.text.lower() in _SYMMETRIC
    if not is_mark or reader.peek(ahead).kind not in _ENTRY_ENDS:
        return reader.sum()
    mark = _DOT if reader.token.kind == "cdot" else MIRRORED
    for _ in range(ahead):
        reader.take()
    if mark is MIRRORED:
        reader.notes.setdefault(SYMMETRIC_NOTE)
    return mark


def _without_dots(reader: Reader, rows: list[list[Value]]) -> list[list[Value]]:
    """The rows with 0, or the mark of a symmetric matrix, for each dot: one across from a dot is 0.

    Where one stands on the diagonal, or there is none, all are.
    """
    size = range(len(rows))
    dots = [(i, j) for i in size for j, entry in enumerate(rows[i]) if entry is _DOT]
    if not dots:
        return rows
    is_square = all(len(row) == len(rows) for row in rows)
    are_zeros = not is_square or any(i == j for i, j in dots)
    rows = [list(row) for row in rows]
    for i, j in dots:
        rows[i][j] = ZERO if are_zeros or (j, i) in dots else MIRRORED
        if rows[i][j] is MIRRORED:
            reader.notes.setdefault(SYMMETRIC_NOTE)
    return rows


def _mirrored(found: Value) -> Value:
    """A square matrix with the entry across the diagonal for each mark."""
    if not isinstance(found, Grid) or found.shape[0] != found.shape[1]:
        return found
    rows = found.rows
    size = range(len(rows))
    return Grid(
        tuple(tuple(rows[j][i] if rows[i][j] is MIRRORED else rows[i][j] for j in size) for i in size)
    )


def finished(reader: Reader, rows: list[list[Value]], opening: Token) -> Value:
    """The matrix of these rows; one of one entry is that entry."""
    if len(rows) == 1 and len(rows[0]) == 1:
        return rows[0][0]
    found = reader.placed(opening.start, stacked, _without_dots(reader, rows))
    if SYMMETRIC_NOTE in reader.notes:
        found = _mirrored(found)
    return found if isinstance(found, Abstract) else _as_rates(reader, found)


def _as_rates(reader: Reader, value: Value) -> Value:
    """Mark the column of the velocities or accelerations as that."""
    coordinates = reader.vocabulary.coordinates
    if not isinstance(value, Grid) or value.shape != (len(coordinates), 1):
        return value
    for dots in range(3):
        wanted: list[Node] = [Symbol(q.name, dots) for q in coordinates]
        if [row[0] for row in value.rows] == wanted:
            return Grid(value.rows, is_rates=dots)
    return value
