"""YAML text -> nodes that know their place, and nothing else that YAML can do.

Only PyYAML's parser of events is used: no composer (it recurses and expands
aliases), no constructor (it runs code for tags), no resolver (it takes `no` for
a boolean, `010` for 8 and `1:30` for 90).  A scalar is its source text.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from itertools import islice
from typing import Any

from dynsolve.problem.source import Faults
from dynsolve.problem.yaml_errors import explain

MAX_DEPTH = 12
"""A problem file needs five levels."""

MAX_EVENTS = 50_000

Span = tuple[int, int]


@dataclass(frozen=True, slots=True)
class ScalarNode:
    """A value: `text` is the source between its quotes, which begins at character `start`.

    `decoded` is what YAML makes of it (escapes resolved, lines folded): for titles.
    """

    text: str
    start: int
    span: Span
    decoded: str


@dataclass(frozen=True, slots=True)
class ListNode:
    """A list."""

    items: tuple[YamlNode, ...]
    span: Span


@dataclass(frozen=True, slots=True)
class MappingNode:
    """Keys with their values, in order."""

    entries: tuple[tuple[ScalarNode, YamlNode], ...]
    span: Span


@dataclass(frozen=True, slots=True)
class FaultyNode:
    """Something that was reported already; whoever meets it leaves it alone."""

    span: Span


YamlNode = ScalarNode | ListNode | MappingNode | FaultyNode


_DIGITS = re.compile("[+-]?[0-9]+")


def decimal_comma(before: YamlNode, after: YamlNode) -> str:
    """The number that two values next to each other were meant as: 9.81 of 9,81; empty for any others."""
    if not (isinstance(before, ScalarNode) and isinstance(after, ScalarNode)):
        return ""
    adjoin = before.span[1] + 1 == after.span[0] and after.text.isdecimal()
    return f"{before.text}.{after.text}" if adjoin and _DIGITS.fullmatch(before.text) else ""


def write_point(number: str) -> str:
    """The remedy for a decimal comma."""
    return f"did you mean {number}? A decimal is written with a point"


def too_many(node: ListNode, help: str) -> str:
    """The remedy for a list of the wrong length: a decimal comma in it, where there is one."""
    pairs = zip(node.items, node.items[1:], strict=False)
    found = next(filter(None, (decimal_comma(one, other) for one, other in pairs)), "")
    return write_point(found) if found else help


def read_nodes(faults: Faults) -> YamlNode | None:
    """The root node of the source of `faults`; None for an empty file or wrong YAML syntax."""
    import yaml

    loader: Any = getattr(yaml, "CSafeLoader", yaml.SafeLoader)
    text = faults.source.text
    tree = _Tree(faults)
    try:
        for event in islice(yaml.parse(text, Loader=loader), MAX_EVENTS):
            if not tree.take(event):
                return tree.root
    except yaml.MarkedYAMLError as error:
        explain(faults, error)
        return None
    faults.error(
        (len(text), len(text)), f"the file has more than {MAX_EVENTS} parts", "give the problem file itself"
    )
    return None


class _Open:
    """A list or mapping whose end has not come yet."""

    def __init__(self, kind: str, start: int) -> None:
        self.kind, self.start = kind, start
        self.items: list[YamlNode] = []


class _Tree:
    """Builds nodes from events on a stack of its own: no depth of nesting can exhaust Python's."""

    def __init__(self, faults: Faults) -> None:
        self.faults = faults
        self.root: YamlNode | None = None
        self.open: list[_Open] = []
        self.documents = 0

    def take(self, event: Any) -> bool:
        """Take one event in; False ends the reading."""
        kind = type(event).__name__
        start, end = event.start_mark.index, event.end_mark.index
        if kind == "StreamEndEvent":
            return False
        if kind == "DocumentStartEvent":
            return self._document(start, end)
        if kind in ("SequenceStartEvent", "MappingStartEvent"):
            self._properties(event)
            self.open.append(_Open(kind, start))
            if len(self.open) > MAX_DEPTH:
                self.faults.error(
                    (start, start + 1), f"more than {MAX_DEPTH} levels of nesting", "write it flatter"
                )
                self.root = None
                return False
        elif kind in ("SequenceEndEvent", "MappingEndEvent"):
            self._place(self._closed(end))
        elif kind == "ScalarEvent":
            self._properties(event)
            self._place(self._scalar(event, start, end))
        elif kind == "AliasEvent":
            self._alias(event.anchor, start, end)
        return True

    def _document(self, start: int, end: int) -> bool:
        self.documents += 1
        if self.documents == 2:
            message = "a second document begins here; a problem file holds one robot"
            self.faults.error(
                (start, max(end, start + 3)), message, "put the other robot in a file of its own"
            )
        return self.documents < 2

    def _properties(self, event: Any) -> None:
        """Anchors and tags: neither has a use here."""
        start = event.start_mark.index
        if event.anchor:
            span = (start, start + len(event.anchor) + 1)
            self.faults.error(
                span, f"`&{event.anchor}` is a YAML anchor, which a problem file has no use for", "delete it"
            )
        if event.tag:
            text = self.faults.source.text
            length = len(text[start:].split(None, 1)[0]) if text[start : start + 1] == "!" else 1
            message = "a YAML tag (`!...`) has no meaning in a problem file"
            self.faults.error((start, start + length), message, "delete it")

    def _alias(self, name: str, start: int, end: int) -> None:
        message = f"`*{name}` is a YAML alias, which a problem file has no use for"
        help = f"the star of a joint variable stands after its name: {name}*"
        self.faults.error((start, end), message, help)
        self._place(FaultyNode((start, end)))

    def _scalar(self, event: Any, start: int, end: int) -> ScalarNode:
        source = self.faults.source.text
        style = event.style
        text_start, text_end = start, end
        if event.anchor or event.tag:
            text_start = max(start, end - len(event.value)) if not style else source.find(style, start, end)
        if style in ("'", '"'):
            text_start, text_end = text_start + 1, end - 1
        elif style in ("|", ">"):
            line_end = source.find("\n", start, end)
            text_start = line_end + 1 if line_end >= 0 else end
            text_end = text_start + len(source[text_start:text_end].rstrip())
        return ScalarNode(source[text_start:text_end], text_start, (start, max(end, start)), event.value)

    def _closed(self, end: int) -> YamlNode:
        done = self.open.pop()
        text = self.faults.source.text
        end = done.start + len(text[done.start : end].rstrip())
        if done.kind == "SequenceStartEvent":
            return ListNode(tuple(done.items), (done.start, end))
        return MappingNode(self._entries(done.items), (done.start, end))

    def _entries(self, items: list[YamlNode]) -> tuple[tuple[ScalarNode, YamlNode], ...]:
        entries: dict[str, tuple[ScalarNode, YamlNode]] = {}
        last = ""
        for key, value in zip(items[::2], items[1::2], strict=True):
            if isinstance(key, FaultyNode):
                continue
            if last and (whole := decimal_comma(entries[last][1], key)) and value.span[0] == value.span[1]:
                before = entries[last]
                span = (before[1].span[0], key.span[1])
                self.faults.error(span, f"{whole.replace('.', ',')} is cut at its comma", write_point(whole))
                entries[last] = (before[0], FaultyNode(span))
                continue
            if not isinstance(key, ScalarNode):
                self.faults.error(key.span, "a key is a word, not a list or a mapping", "write `key: value`")
            elif key.decoded in entries:
                line, _ = self.faults.source.position(entries[key.decoded][0].span[0])
                message = f"`{key.decoded}` is given twice, first in line {line}"
                self.faults.error(key.span, message, "keep one of them")
            else:
                entries[key.decoded] = (key, value)
                last = key.decoded
        return tuple(entries.values())

    def _place(self, node: YamlNode) -> None:
        if self.open:
            self.open[-1].items.append(node)
        elif self.root is None:
            self.root = node
