"""YAML text -> the keys of an answer file with their values, as text that knows its place.

Only PyYAML's parser of events is used: nothing is composed, resolved or constructed, so that no
alias expands, no tag runs code, and `010` stays what it is.  The parser never sees an escape it
does not know: backslashes are hidden from it, and the values are taken from the source.

A list becomes the text of a row, a list of lists that of a matrix: `[[a, b], [c, d]]`.  A mapping,
and whatever has an anchor, a tag or an alias, stays as it stands in the source.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass, field
from itertools import islice
from typing import Any

from dynsolve.answers.reading import yaml_scalars
from dynsolve.answers.reading.dh_heads import column_of, order_of
from dynsolve.answers.reading.placed_text import Piece, PlacedText, placed

MAX_EVENTS = 30_000
MAX_DEPTH = 12

_NULLS = frozenset({"", "~", "null", "Null", "NULL"})
_SCALARS = {
    "'": yaml_scalars.single_quoted,
    '"': yaml_scalars.double_quoted,
    "|": yaml_scalars.literal,
    ">": yaml_scalars.block_folded,
}
_BACKSLASHES = re.compile(r'\\(\\|(?!"))')
_DELIMITERS = (("$$", "$$"), ("$", "$"), ("\\(", "\\)"), ("\\[", "\\]"))
_DECIMAL = re.compile(r"(?<=[0-9]),(?=[0-9])")
_COMMENT = re.compile(r":?[ \t]+(#[^\n]*)")
_OPENS = {"(": 1, "[": 1, "{": 1, ")": -1, "]": -1, "}": -1}


class NotYaml(Exception):
    """The text is refused by YAML, or goes over a bound."""


@dataclass(slots=True)
class YamlNode:
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
    found = _without_delimiters(placed(_pieces(text, node)))
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
        yield from yaml_scalars.plain(text[node.start : node.end], node.start)


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
    pieces: list[Piece] = [("[", node.start)]
    for column in range(4):
        pieces += [(", ", node.start)] * bool(column)
        pieces += _item(text, columns[column]) if column in columns else [("0", node.start)]
    return [*pieces, ("]", max(node.end - 1, node.start))]


def _table_by_columns(text: str, node: YamlNode) -> list[Piece]:
    """A table {theta: [...], d: [...], a: [...], alpha: [...]} as its rows; empty of another mapping."""
    columns = {column_of(word(text, key)): cells for key, cells in node.entries()}
    heights = {len(cells.inside) for cells in columns.values() if cells.style == "list"}
    if None in columns or len(columns) != 4 or len(node.inside) != 8 or len(heights) != 1:
        return []
    pieces: list[Piece] = [("[", node.start)]
    for row in range(heights.pop()):
        pieces.append((", [" if row else "[", node.start))
        for column in range(4):
            cells = columns[column]
            pieces += [(", ", node.start)] * bool(column)
            pieces += _item(text, cells.inside[row] if cells.style == "list" else cells)
        pieces.append(("]", node.start))
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
        while pairs and _is_open(text[start:end]):
            more = pairs.pop(0)
            end = max(more[0].end, more[1].end)
        yield word(text, name), word(text, found) if end == found.end else text[start:end]


def _is_open(text: str) -> bool:
    return sum(_OPENS.get(character, 0) for character in text) > 0


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
            level += sum(_OPENS.get(character, 0) for character in text[item.start : item.end])
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
    found = _without_delimiters(placed(_pieces(text, node)))
    commas = _commas(found.text)
    decimal = [at for at in commas if _DECIMAL.match(found.text, at)]
    if not commas:
        yield from _placed(found)
    elif len(commas) == len(decimal) == 1 and re.search(r"[^0-9,\s+-]", found.text):
        (at,) = commas
        yield from _placed(found.part(0, at))
        yield ".", found.origin(at)
        yield from _placed(found.part(at + 1, len(found.text)))
    else:
        yield "[", node.start
        yield from _placed(found)
        yield "]", max(node.end - 1, node.start)


def _placed(found: PlacedText) -> Iterator[Piece]:
    ends = (*found.starts[1:], len(found.text))
    for start, end, origin in zip(found.starts, ends, found.origins, strict=True):
        if end > start:
            yield found.text[start:end], origin


def _commas(text: str) -> list[int]:
    """The commas and semicolons of a text that stand in no bracket."""
    found: list[int] = []
    level = 0
    if "," not in text and ";" not in text:
        return found
    for at, character in enumerate(text):
        level += _OPENS.get(character, 0)
        if level <= 0 and character in ",;" and text[at - 1 : at] != "\\":
            found.append(at)
    return found


def _without_delimiters(found: PlacedText) -> PlacedText:
    """The formula without the signs that LaTeX writes around it."""
    start, end = len(found.text) - len(found.text.lstrip()), len(found.text.rstrip())
    for opening, closing in _DELIMITERS:
        inside = found.text[start:end]
        if inside.startswith(opening) and inside.endswith(closing) and len(inside) > len(opening + closing):
            start, end = start + len(opening), end - len(closing)
    return found.part(start, end) if (start, end) != (0, len(found.text)) else found
