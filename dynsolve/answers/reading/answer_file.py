r"""The answer file: YAML as people write it, its values taken from the source text.

A value is whatever stands between one key and the next, so that `\frac{a}{b}` in a
list, a tag, an alias or a bracket that never closes spoils that value alone.
Nothing is expanded, converted or constructed.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass

from dynsolve.answers.reading.definitions import own_symbols
from dynsolve.answers.reading.displays import Display
from dynsolve.answers.reading.equation_reader import EquationReader
from dynsolve.answers.reading.limits import MAX_ANSWERS
from dynsolve.answers.reading.sources import Source
from dynsolve.answers.submission import Place
from dynsolve.errors import Finding

KEYS = ("problem", "student", "symbols", "let", "answers")
"""The keys of an answer file."""

_KEY = re.compile(
    r"""([ \t]*)("[^"\n]{1,200}"|'[^'\n]{1,200}'|[^\s:#\-\[\]{},][^:\n]{0,200}?|-[^\s:][^:\n]{0,50}?)"""
    r"[ \t]{0,20}:(?=[ \t]|$)"
)
_BLOCK = re.compile(r"[|>][+-]?[0-9]?[+-]?[ \t]*(?:#[^\n]*)?$", re.MULTILINE)
_ITEM = re.compile(r"[ \t]*-(?=[ \t]|$)")


_DELIMITERS = (("$$", "$$"), ("$", "$"), ("\\(", "\\)"), ("\\[", "\\]"))


@dataclass(frozen=True, slots=True)
class KeyedText:
    """A key with the stretch of text that is its value."""

    key: str
    at: int
    start: int
    end: int


def read_answer_file(reader: EquationReader, source: Source) -> tuple[tuple[str, str], list[Finding]]:
    """Read an answer file; gives (problem, student) as it says, and what is wrong with the file."""
    text = source.text
    entries = {entry.key: entry for entry in _block(text, 0, len(text))}
    faults: list[Finding] = []
    head = tuple(_word(text, entries.get(key)) for key in ("problem", "student"))
    for key in ("symbols", "let"):
        for entry in _inner(text, entries.get(key)):
            fault = own_symbols(reader, _display(source, entry), entry.key, key == "symbols")
            if fault is not None:
                faults.append(_finding(source, entry, fault.message, fault.help))
    if "answers" in entries:
        answers = list(_inner(text, entries["answers"]))
    else:
        answers = [entry for entry in entries.values() if entry.key not in KEYS]
        if not answers:
            message = "there are no answers in this file"
            faults.append(Finding(message, "write them under `answers:`, one a line: K: m1*L1", source.file))
    for entry in answers[:MAX_ANSWERS]:
        display = _display(source, entry)
        if display.text.strip():
            reader.read_answer(entry.key, source.place(entry.at, len(entry.key)), display)
    return (head[0], head[1]), faults


def _finding(source: Source, entry: KeyedText, message: str, help: str) -> Finding:
    place = source.place(entry.start)
    return Finding(f"{entry.key}: {message}", help, source.file, place.line, place.column, 1, place.excerpt)


def _block(text: str, start: int, end: int) -> Iterator[KeyedText]:
    """The entries of a block mapping: a key and all that follows up to the next key of its indentation."""
    indent: int | None = None
    current: tuple[str, int, int] | None = None
    position, level = start, 0
    while position < end:
        stop = text.find("\n", position, end)
        stop = end if stop < 0 else stop
        found = _KEY.match(text, position, stop)
        blank = not text[position:stop].strip() or text[position:stop].lstrip()[0] == "#"
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


def _inner(text: str, entry: KeyedText | None) -> Iterator[KeyedText]:
    """The entries of a mapping in either style."""
    if entry is None:
        return
    value = text[entry.start : entry.end]
    stripped = value.lstrip()
    if not stripped.startswith("{"):
        yield from _block(text, text.find("\n", entry.start, entry.end) + 1 or entry.end, entry.end)
        return
    opening = entry.start + len(value) - len(stripped)
    closing = text.rfind("}", opening, entry.end)
    yield from _flow(text, opening + 1, closing if closing > opening else entry.end)


def _flow(text: str, start: int, end: int) -> Iterator[KeyedText]:
    """The entries of {key: value, key: value}."""
    level, piece = 0, start
    for position in range(start, end + 1):
        character = text[position] if position < end else ","
        if character in "([{":
            level += 1
        elif character in ")]}":
            level -= 1
        elif character == "," and (level <= 0 or position == end):
            found = _KEY.match(text, _skip_blank(text, piece, position), position) or _TIGHT.match(
                text, _skip_blank(text, piece, position), position
            )
            if found is not None:
                yield KeyedText(found[2].strip("'\"").strip(), found.start(2), found.end(), position)
            piece = position + 1


_TIGHT = re.compile(r"""([ \t]*)([^\s:,]{1,80})[ \t]{0,9}:""")


def _skip_blank(text: str, start: int, end: int) -> int:
    while start < end and text[start].isspace():
        start += 1
    return start


def _word(text: str, entry: KeyedText | None) -> str:
    if entry is None:
        return ""
    value = text[entry.start : entry.end].split("\n")[0].split(" #")[0].strip().strip("'\"")
    return value[:200]


def _display(source: Source, entry: KeyedText) -> Display:
    """The value of an entry as a display, without quotes, comments and the signs of block style."""
    text, start, end = source.text, entry.start, entry.end
    value = text[start:end].rstrip()
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
        if "\n" in text[entry.start : start] and _ITEM.match(value):
            value = _listed(value)
    for opening, closing in _DELIMITERS:
        if value.startswith(opening) and value.endswith(closing) and len(value) > len(opening + closing):
            start, value = start + len(opening), value[len(opening) : -len(closing)]
    base = start

    def locate(offset: int, length: int) -> Place:
        return source.place(base + min(offset, max(len(value) - 1, 0)), length)

    return Display(value, "", locate, plain=True)


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
