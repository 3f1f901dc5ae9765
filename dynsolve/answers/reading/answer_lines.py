r"""Answer files that YAML refuses, key by key and line by line.

A value is whatever stands between one key and the next, so that `\frac{a}{b}` in a list, a tag
or a bracket that never closes spoils that value alone.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass

from dynsolve.answers.reading.placed_text import PlacedText, placed
from dynsolve.answers.reading.yaml_values import NotYaml, documents, value

_KEY = re.compile(
    r"""([ \t]*)("[^"\n]{1,200}"|'[^'\n]{1,200}'|[^\s:#\-\[\]{},][^:\n]{0,200}?|-[^\s:][^:\n]{0,50}?)"""
    r"[ \t]{0,20}:(?=[ \t]|$)"
)
_BLOCK = re.compile(r"[|>][+-]?[0-9]?[+-]?[ \t]*(?:#[^\n]*)?$", re.MULTILINE)
_ITEM = re.compile(r"[ \t]*-(?=[ \t]|$)")
_TIGHT = re.compile(r"""([ \t]*)("[^"\n]{1,200}"|'[^'\n]{1,200}'|[^\s:,]{1,80})[ \t]{0,9}:""")
_QUOTED_KEY = re.compile(r"""[ \t]*["'][^"'\n]{1,200}["'][ \t]{0,20}:""")
_FLOW_END = re.compile(r"[,}\s]*\Z")
_DELIMITERS = (("$$", "$$"), ("$", "$"), ("\\(", "\\)"), ("\\[", "\\]"))


@dataclass(frozen=True, slots=True)
class KeyedText:
    """A key with the stretch of text that is its value."""

    key: str
    at: int
    start: int
    end: int


def entries(text: str) -> list[KeyedText]:
    """The keys of the file with their values."""
    if text.lstrip().startswith("{"):
        return list(_braced(text, 0, len(text)))
    return list(_block(text, 0, len(text)))


def inner(text: str, entry: KeyedText | None) -> Iterator[KeyedText]:
    """The entries of a mapping in either style."""
    if entry is None:
        return
    if text[entry.start : entry.end].lstrip().startswith("{"):
        yield from _braced(text, entry.start, entry.end)
        return
    yield from _block(text, text.find("\n", entry.start, entry.end) + 1 or entry.end, entry.end)


def _braced(text: str, start: int, end: int) -> Iterator[KeyedText]:
    """The entries of {key: value, ...}: by lines where each begins with a key, else by the commas."""
    opening = text.index("{", start, end)
    line_end = text.find("\n", opening, end)
    if line_end >= 0 and not text[opening + 1 : line_end].strip() and _QUOTED_KEY.match(text, line_end + 1):
        for entry in _block(text, line_end + 1, end):
            closing = _FLOW_END.search(text, entry.start, entry.end)
            is_mapping = text[entry.start : entry.end].lstrip().startswith("{")
            stop = entry.end if is_mapping or closing is None else closing.start()
            yield KeyedText(entry.key, entry.at, entry.start, stop)
        return
    closing_brace = text.rfind("}", opening, end)
    yield from _flow(text, opening + 1, closing_brace if closing_brace > opening else end)


def word(text: str, entry: KeyedText | None) -> str:
    """The first line of a value, without quotes."""
    if entry is None:
        return ""
    found = text[entry.start : entry.end].split("\n")[0].split(" #")[0].strip().strip("'\"")
    return found[:200]


def value_of(text: str, entry: KeyedText) -> PlacedText | None:
    """A value by itself: as YAML, else as it stands; None where it is null or blank."""
    line = text.rfind("\n", 0, entry.at) + 1
    indent = entry.at - line if not text[line : entry.at].strip(" ") else 0
    try:
        (root,) = documents(" " * indent + text[entry.at : entry.end])
        ((_, node),) = root.entries()
        found = value(" " * indent + text[entry.at : entry.end], node)
    except (NotYaml, ValueError):
        return _as_it_stands(text, entry.start, entry.end)
    if found is None:
        return None
    shift = entry.at - indent
    return PlacedText(found.text, found.starts, tuple(origin + shift for origin in found.origins))


def _block(text: str, start: int, end: int) -> Iterator[KeyedText]:
    """The entries of a block mapping: a key and all that follows up to the next key of its indentation."""
    indent: int | None = None
    current: tuple[str, int, int] | None = None
    position, level = start, 0
    while position < end:
        stop = text.find("\n", position, end)
        stop = end if stop < 0 else stop
        found = _KEY.match(text, position, stop)
        blank = text[position:stop].lstrip()[:1] in ("", "#")
        if found is not None and not blank and (indent is None or _width(found[1]) <= indent) and level <= 0:
            indent = _width(found[1]) if indent is None else indent
            if current is not None:
                yield KeyedText(current[0], current[1], current[2], position)
            current = (found[2].strip("'\"").strip(), found.start(2), found.end())
            level = _balance(text, found.end(), stop)
        elif current is not None:
            level = max(level + _balance(text, position, stop), 0) if not found or level < 5 else 0
            if found is not None and indent is not None and _width(found[1]) <= indent:
                yield KeyedText(current[0], current[1], current[2], position)
                current, level = (found[2].strip("'\"").strip(), found.start(2), found.end()), 0
        position = stop + 1
    if current is not None:
        yield KeyedText(current[0], current[1], current[2], end)


def _width(indent: str) -> int:
    return len(indent.expandtabs(8))


def _balance(text: str, start: int, stop: int) -> int:
    """How many square brackets stay open in a line."""
    return text.count("[", start, stop) - text.count("]", start, stop)


def _flow(text: str, start: int, end: int) -> Iterator[KeyedText]:
    """The entries of {key: value, key: value}."""
    piece = start
    for position in [*_separators(text, start, end), end]:
        found = _KEY.match(text, _skip_blank(text, piece, position), position) or _TIGHT.match(
            text, _skip_blank(text, piece, position), position
        )
        if found is not None:
            yield KeyedText(found[2].strip("'\"").strip(), found.start(2), found.end(), position)
        piece = position + 1


_MARK = re.compile(r"""(?<=[\[{,:( ])"(?:[^"\\\n]|\\.)*"|(?<=[\[{,: ])'[^'\n]*'(?=\s*[,:}\]])|[()\[\]{},]""")


def _separators(text: str, start: int, end: int) -> Iterator[int]:
    """The commas that stand in no bracket and between no quotes."""
    level = 0
    for found in _MARK.finditer(text, start, end):
        if found[0] in "([{":
            level += 1
        elif found[0] in ")]}":
            level -= 1
        elif found[0] == "," and level <= 0:
            yield found.start()


def _skip_blank(text: str, start: int, end: int) -> int:
    while start < end and text[start].isspace():
        start += 1
    return start


def _as_it_stands(text: str, start: int, end: int) -> PlacedText:
    """The value of an entry without quotes, comments and the signs of block style."""
    first, value = start, text[start:end].rstrip()
    skipped = len(value) - len(value.lstrip())
    start, value = start + skipped, value[skipped:]
    block = _BLOCK.match(value)
    if block is not None:
        start, value = start + block.end(), value[block.end() :]
    elif len(value) > 1 and value[0] in "'\"" and _unquoted(value) is not None:
        inner = _unquoted(value)
        assert inner is not None
        start, value = start + 1, inner
    else:
        value = _without_comments(value)
        if "\n" in text[first:start] and _ITEM.match(value):
            value = _listed(value)
    for opening, closing in _DELIMITERS:
        if value.startswith(opening) and value.endswith(closing) and len(value) > len(opening + closing):
            start, value = start + len(opening), value[len(opening) : -len(closing)]
    return placed([(value, start)])


def _unquoted(value: str) -> str | None:
    """What stands between quotes that enclose the value, None where they do not."""
    closing = value.rfind(value[0])
    after = value[closing + 1 :].strip()
    if closing > 0 and (not after or after[0] == "#") and "\n\n" not in value:
        return value[1:closing]
    return None


def _without_comments(value: str) -> str:
    """The value with blanks in place of `# ...` behind a blank; a value that is one stays."""
    lines = value.split("\n")
    kept = []
    for number, line in enumerate(lines):
        at = line.find(" #")
        if number and line.lstrip().startswith("#"):
            at = 0
        kept.append(line if at < 0 else line[:at] + " " * (len(line) - at))
    return "\n".join(kept).rstrip()


def _listed(value: str) -> str:
    """A block list as [a, b], every character where it was."""
    lines = value.split("\n")
    indent = len(lines[0]) - len(lines[0].lstrip())
    items = [i for i, line in enumerate(lines) if _ITEM.match(line)]
    if len(items) < 2:
        return value
    for number, i in enumerate(items):
        dash = lines[i].index("-")
        lines[i] = lines[i][:dash] + ("," if number else "[") + lines[i][dash + 1 :]
    return "\n".join(lines) + "]" if indent >= 0 else value
