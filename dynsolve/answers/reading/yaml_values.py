r"""YAML text -> the keys of an answer file with their values, as text that knows its place.

Only PyYAML's parser of events is used: nothing is composed, resolved or constructed, so that no
alias expands, no tag runs code, and `010` stays what it is.  The parser never sees an escape it
does not know: backslashes are hidden from it, and the values are taken from the source.

A list becomes the text of a row, a list of lists that of a matrix: `[[a, b], [c, d]]`.  A mapping,
and whatever has an anchor, a tag or an alias, stays as it stands in the source.

The scalars of an answer file: what stands between their quotes, with the place of every character.

LaTeX is full of backslashes, and so people write `"\theta_1"` between double quotes, where YAML would
have them write `"\\theta_1"`, as every library does.  Both are read, each value by itself:

- A value is *escaped* if every run of backslashes in it is one that a library writes (an even number,
  or an escape of YAML and JSON), and an even run stands directly before a letter or before one of the
  signs that make a command.  All its escapes are then resolved: `"\\frac"` is `\frac`, `"\\\\"` is `\\`.
- In every other value backslashes stand for themselves, save `\uXXXX`, `\UXXXXXXXX`, `\xXX`, `\"`,
  `\/` and one at the end of a line, which are always escapes, and `\n` and `\t`, which are where the letters
  that follow make no command (`\nu`, `\theta`).
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from itertools import islice
from typing import Any

from msgspec import Struct, field

from dynsolve.answers.reading.dh_tables import column_of, order_of
from dynsolve.answers.reading.sources import Piece, PlacedText, levels, placed

# The scalars of an answer file

_RUN = re.compile(r"(\\+)((?s:.)?)")
_HEX = "[0-9a-fA-F]"
_PAIR = rf"u[dD][89abAB]{_HEX}{{2}}\\u[dD][c-fC-F]{_HEX}{{2}}"
"""Two halves of one character, as JSON writes those beyond U+FFFF."""

_CODE = rf"{_PAIR}|u{_HEX}{{4}}|U{_HEX}{{8}}|x{_HEX}{{2}}"
_NEXT_LINE = r"\n[ \t]*(?:\\\\\n[ \t]*(?=\\ ))?"
"""The end of a line, and the backslash alone in a line that PyYAML adds where it cuts before a blank."""

_ESCAPE = re.compile(rf"\\(?:({_CODE})|({_NEXT_LINE})|((?s:.)))")
_IS_CODE = re.compile(_CODE)
_LINE_END = re.compile(rf"(?<!\\)((?:\\\\)*)\\{_NEXT_LINE}")
"""A backslash at the end of a line, with which a library cuts a long value."""

_COMMAND_SIGNS = frozenset(",;:!{}")
_NEUTRAL = frozenset('"/\n \t_nt')
"""What may follow a lone backslash in a value that a library wrote and in one written by hand."""

_CONTROLS = {"n": "\n", "N": "\n", "L": "\n", "P": "\n", "r": "\n", "\\": "\\", '"': '"', "/": "/"}
_LETTERS = re.compile(r"[A-Za-z]*")
_COMMANDS = frozenset(
    "nabla natural ncong ne nearrow neg negthinspace neq newline nexists ngeq ni nicefrac nleq nobreak "
    "nolimits nonumber normalsize not notag notin nu nwarrow "
    "tag tan tanh tau tbinom tdot text textbf textit textnormal textrm textstyle texttt tfrac the theta "
    "thickspace thinspace tilde times tiny to top triangle triangleq".split()
)
"""The commands of LaTeX that begin like an escape, `\\n` or `\\t`."""

_FOLD = re.compile(r"[ \t]*\n[ \t\n]*")


def plain(raw: str, start: int) -> Iterator[Piece]:
    """A scalar without quotes that begins at an offset of the file."""
    yield folded(raw), start


def single_quoted(raw: str, start: int) -> Iterator[Piece]:
    """What stands between single quotes: a doubled one is one."""
    text = folded(raw)
    position = 0
    while (doubled := text.find("''", position)) >= 0:
        yield text[position : doubled + 1], start + position
        position = doubled + 2
    yield text[position:], start + position


def literal(raw: str, start: int) -> Iterator[Piece]:
    """A block after `|`: lines as they stand."""
    yield raw, start


def block_folded(raw: str, start: int) -> Iterator[Piece]:
    """A block after `>`: lines are joined, save those that are indented further."""
    lines = raw.split("\n")
    widths = [len(line) - len(line.lstrip(" ")) for line in lines]
    base = min((width for width, line in zip(widths, lines, strict=True) if line.strip()), default=0)
    kept = [lines[0]] if lines else []
    for number in range(1, len(lines)):
        pair = (number - 1, number)
        joins = all(lines[i].strip() and widths[i] == base for i in pair)
        kept += [" " if joins else "\n", lines[number]]
    yield "".join(kept), start


def double_quoted(raw: str, start: int) -> Iterator[Piece]:
    """What stands between double quotes, its escapes resolved where they are meant."""
    escaped = is_escaped(raw)
    text = folded(raw)
    position = 0
    for found in _ESCAPE.finditer(raw):
        meant = _meant(raw, found, escaped)
        if meant is not None:
            yield text[position : found.start()], start + position
            yield meant, start + found.start()
            position = found.end()
    yield text[position:], start + position


def is_escaped(raw: str) -> bool:
    """Whether the backslashes of a command are doubled."""
    doubled = False
    raw = _LINE_END.sub(r"\1", raw)
    for run in _RUN.finditer(raw):
        follows = run[2]
        if len(run[1]) % 2 == 0:
            sign = (follows.isalpha() and follows.isascii()) or follows in _COMMAND_SIGNS
            doubled = doubled or bool(follows and sign) or (follows in ("(", "[") and run.start() == 0)
        elif follows not in _NEUTRAL and not _IS_CODE.match(raw, run.end() - len(follows)):
            return False
    return doubled


def _meant(raw: str, found: re.Match[str], escaped: bool) -> str | None:
    """What an escape stands for, None where it is no escape."""
    code, line_end, sign = found.groups()
    if code:
        return _character(code)
    if line_end:
        return ""
    if sign in '"/':
        return str(sign)
    if escaped:
        return _CONTROLS.get(sign, " ")
    if sign in "nt":
        letters = _LETTERS.match(raw, found.start() + 1)
        return None if letters and letters[0] in _COMMANDS else "\n" if sign == "n" else " "
    return None


def _character(code: str) -> str:
    if "\\" in code:
        pair = [int(half.strip("\\")[1:], 16) for half in (code[:5], code[5:])]
        return chr(0x10000 + ((pair[0] - 0xD800) << 10) + pair[1] - 0xDC00)
    value = int(code[1:], 16)
    return chr(value) if value <= 0x10FFFF and not 0xD800 <= value <= 0xDFFF else "\ufffd"


def folded(raw: str) -> str:
    """The text with blanks for single ends of lines; blank lines stay, and so does every offset."""
    if "\n" not in raw:
        return raw
    return _FOLD.sub(_joined, raw)


def _joined(found: re.Match[str]) -> str:
    return found[0].replace("\n", " ") if found[0].count("\n") == 1 else found[0]


MAX_EVENTS = 30_000
MAX_DEPTH = 12

_NULLS = frozenset({"", "~", "null", "Null", "NULL"})
_SCALARS = {"'": single_quoted, '"': double_quoted, "|": literal, ">": block_folded}
_BACKSLASHES = re.compile(r'\\(\\|(?!"))')
_DELIMITERS = (("$$", "$$"), ("$", "$"), ("\\(", "\\)"), ("\\[", "\\]"))
_DECIMAL = re.compile(r"(?<=[0-9]),(?=[0-9])")
_COMMENT = re.compile(r":?[ \t]+(#[^\n]*)")


class NotYaml(Exception):
    """The text is refused by YAML, or goes over a bound."""


class YamlNode(Struct):
    """A scalar ('' for plain, else its quote or sign), a list ("list") or a mapping ("mapping").

    `as_it_stands` says that it has an anchor, a tag or is an alias; `inside` are the items of a list,
    or keys and values in turn.  It reaches from `start` to `end` in the source.
    """

    style: str
    start: int
    end: int
    as_it_stands: bool = False
    inside: list[YamlNode] = field(default_factory=list)

    def entries(self) -> Iterator[tuple[YamlNode, YamlNode]]:
        """Keys with their values, of a mapping or of a list of mappings; a key given twice stands twice."""
        if self.style == "mapping":
            yield from zip(self.inside[::2], self.inside[1::2], strict=True)
        elif self.style == "list":
            for item in self.inside:
                if item.style == "mapping":
                    yield from item.entries()


def documents(text: str) -> list[YamlNode]:
    """The documents of a YAML text; raises NotYaml."""
    import yaml

    loader: Any = getattr(yaml, "CSafeLoader", yaml.SafeLoader)
    hidden = _BACKSLASHES.sub(lambda found: "q" * len(found[0]), text)
    roots: list[YamlNode] = []
    opened: list[YamlNode] = []
    try:
        for number, event in enumerate(islice(yaml.parse(hidden, Loader=loader), MAX_EVENTS + 1)):
            if number >= MAX_EVENTS or len(opened) > MAX_DEPTH:
                raise NotYaml
            _take(event, roots, opened)
    except (yaml.YAMLError, ValueError):
        raise NotYaml from None
    return roots


def root_of(text: str) -> YamlNode | None:
    """The one document of a text that is YAML by itself, None where it is not."""
    try:
        (root,) = documents(text)
    except (NotYaml, ValueError):
        return None
    return root


def _take(event: Any, roots: list[YamlNode], opened: list[YamlNode]) -> None:
    kind = type(event).__name__
    start, end = event.start_mark.index, event.end_mark.index
    if kind in ("SequenceEndEvent", "MappingEndEvent"):
        opened.pop().end = end
        return
    if kind in ("ScalarEvent", "AliasEvent"):
        node = YamlNode(getattr(event, "style", None) or "", start, end)
    elif kind in ("SequenceStartEvent", "MappingStartEvent"):
        node = YamlNode("list" if kind[0] == "S" else "mapping", start, end)
    else:
        return
    node.as_it_stands = bool(event.anchor or getattr(event, "tag", None))
    (opened[-1].inside if opened else roots).append(node)
    if kind.endswith("StartEvent"):
        opened.append(node)


def word(text: str, node: YamlNode) -> str:
    """A key, a name: the text of a scalar."""
    return placed(_pieces(text, node)).text.strip()


def value(text: str, node: YamlNode) -> PlacedText | None:
    """The text of an answer, None where it is null or blank; one that is a comment is its text."""
    if node.start == node.end and (comment := _COMMENT.match(text, node.start)) is not None:
        return placed([(comment[1], comment.start(1))])
    if node.style == "" and not node.as_it_stands and text[node.start : node.end].strip() in _NULLS:
        return None
    found = without_delimiters(placed(_pieces(text, node)))
    return found if found.text.strip() else None


def _pieces(text: str, node: YamlNode) -> Iterator[Piece]:
    if node.style == "mapping" and not node.as_it_stands and (table := _table_by_columns(text, node)):
        yield from table
    elif node.as_it_stands or node.style == "mapping":
        yield text[node.start : node.end].rstrip(), node.start
    elif node.style == "list":
        yield from _list(text, node)
    elif node.style:
        start, end = _inner(text, node)
        yield from _SCALARS[node.style](text[start:end], start)
    else:
        yield from plain(text[node.start : node.end], node.start)


def _inner(text: str, node: YamlNode) -> tuple[int, int]:
    """Where the content of a scalar begins and ends that is quoted or a block."""
    if node.style in "'\"":
        return node.start + 1, node.end - 1
    line_end = text.find("\n", node.start, node.end)
    start = line_end + 1 if line_end >= 0 else node.end
    return start, start + len(text[start : node.end].rstrip())


def _list(text: str, node: YamlNode) -> Iterator[Piece]:
    if any(item.style == "" and ";" in text[item.start : item.end] for item in node.inside):
        yield text[node.start : node.end], node.start  # [a, b; c, d], as MATLAB writes a matrix
        return
    yield "[", node.start
    for number, item in enumerate(_rejoined(text, _without_head(text, node.inside))):
        if number:
            yield ", ", item.start
        yield from _item(text, item)
    yield "]", max(node.end - 1, node.start)


def _without_head(text: str, items: list[YamlNode]) -> list[YamlNode]:
    """The rows of a table in the order θ, d, a, α, where the first of them is a head that says another."""
    rows = [item.inside for item in items if item.style == "list" and not item.as_it_stands]
    if len(rows) < 2 or len(rows) < len(items) or any(cell.inside for cell in rows[0]):
        return items
    order = order_of([text[cell.start : cell.end].strip("'\"") for cell in rows[0]])
    if order is None or any(len(row) != len(rows[0]) for row in rows):
        return items
    return [
        YamlNode("list", item.start, item.end, inside=[item.inside[place] for place in order])
        for item in items[1:]
    ]


def _row_of_table(text: str, node: YamlNode) -> list[Piece] | None:
    """A row {theta: ..., d: ..., a: ..., alpha: ...} as its cells; None of another mapping."""
    cells = {word(text, key): value for key, value in node.entries()}
    columns = {column_of(head): cell for head, cell in cells.items()}
    if None in columns or len(columns) < len(cells) or not cells:
        return None
    row = _cells(text, [columns.get(column) for column in range(4)], node.start)
    return [("[", node.start), *row, ("]", max(node.end - 1, node.start))]


def _cells(text: str, cells: Iterable[YamlNode | None], at: int) -> Iterator[Piece]:
    """The cells of a row with commas between them, 0 for one that is not there."""
    for number, cell in enumerate(cells):
        yield (", " if number else ""), at
        yield from _item(text, cell) if cell is not None else [("0", at)]


def _table_by_columns(text: str, node: YamlNode) -> list[Piece]:
    """A table {theta: [...], d: [...], a: [...], alpha: [...]} as its rows; empty of another mapping."""
    columns = {column_of(word(text, key)): cells for key, cells in node.entries()}
    heights = {len(cells.inside) for cells in columns.values() if cells.style == "list"}
    if None in columns or len(columns) != 4 or len(node.inside) != 8 or len(heights) != 1:
        return []
    pieces: list[Piece] = [("[", node.start)]
    order = [columns[column] for column in range(4)]
    for row in range(heights.pop()):
        cells = [column.inside[row] if column.style == "list" else column for column in order]
        pieces += [(", [" if row else "[", node.start), *_cells(text, cells, node.start), ("]", node.start)]
    return [*pieces, ("]", max(node.end - 1, node.start))]


def items_of(text: str, node: YamlNode) -> list[YamlNode]:
    """The items of a list, those that a comma inside parentheses has cut made one again."""
    return list(_rejoined(text, node.inside))


def pairs_of(text: str, node: YamlNode) -> Iterator[tuple[str, str]]:
    """The keys of a mapping with the texts of their values, `{q1: atan2(y, x)}` made one again."""
    pairs = list(node.entries())
    while pairs:
        name, found = pairs.pop(0)
        start, end = found.start, found.end
        while pairs and _open_in(text[start:end]) > 0:
            more = pairs.pop(0)
            end = max(more[0].end, more[1].end)
        yield word(text, name), word(text, found) if end == found.end else text[start:end]


def _open_in(text: str) -> int:
    """How many brackets a text leaves open."""
    return levels(text)[-1] if text else 0


def _rejoined(text: str, items: list[YamlNode]) -> Iterator[YamlNode]:
    """The items; those that a comma inside parentheses has cut, `atan2(y, x)`, are one again."""
    whole: YamlNode | None = None
    level = 0
    for item in items:
        is_plain = item.style == ""
        if whole is None and not is_plain:
            yield item
            continue
        whole = item if whole is None else YamlNode("", whole.start, item.end)
        if is_plain:
            level += _open_in(text[item.start : item.end])
        if level <= 0:
            yield whole
            whole, level = None, 0
    if whole is not None:
        yield whole


def _item(text: str, node: YamlNode) -> Iterator[Piece]:
    """One entry of a list, read by itself: what it holds is never taken for further entries."""
    if node.style == "list" and not node.as_it_stands:
        yield from _list(text, node)
        return
    if node.style == "mapping" and not node.as_it_stands and (row := _row_of_table(text, node)):
        yield from row
        return
    found = without_delimiters(placed(_pieces(text, node)))
    commas = _commas(found.text)
    decimal = [at for at in commas if _DECIMAL.match(found.text, at)]
    if not commas:
        yield from found.pieces()
    elif len(commas) == len(decimal) == 1 and re.search(r"[^0-9,\s+-]", found.text):
        (at,) = commas
        yield from found.part(0, at).pieces()
        yield ".", found.origin(at)
        yield from found.part(at + 1, len(found.text)).pieces()
    else:
        yield from (("[", node.start), *found.pieces(), ("]", max(node.end - 1, node.start)))


def _commas(text: str) -> list[int]:
    """The commas and semicolons of a text that stand in no bracket."""
    if "," not in text and ";" not in text:
        return []
    outside = [at for at, level in enumerate(levels(text)) if level <= 0 and text[at] in ",;"]
    return [at for at in outside if text[at - 1 : at] != "\\"]


def without_delimiters(found: PlacedText) -> PlacedText:
    """The formula without the signs that LaTeX writes around it."""
    start, end = len(found.text) - len(found.text.lstrip()), len(found.text.rstrip())
    for opening, closing in _DELIMITERS:
        inside = found.text[start:end]
        if inside.startswith(opening) and inside.endswith(closing) and len(inside) > len(opening + closing):
            start, end = start + len(opening), end - len(closing)
    return found.part(start, end) if (start, end) != (0, len(found.text)) else found
