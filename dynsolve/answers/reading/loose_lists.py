r"""Lists and mappings in a text that YAML refuses, found by their brackets alone.

    [{q2: \arccos\frac{a}{b}, q1: \operatorname{atan2}(y, x)}, {q2: ..., q1: ...}]

A brace opens a mapping where an item begins and a name with a colon follows; every other one belongs
to a formula.  A comma parts items outside of all inner brackets.
"""

from __future__ import annotations

import re

from dynsolve.answers.reading.limits import MAX_LENGTH
from dynsolve.answers.reading.yaml_values import MAX_DEPTH, YamlNode

_KEY = re.compile(r"""\s*("[^"\n]{1,80}"|'[^'\n]{1,80}'|[\w\\{}^]{1,80}?)\s*:""")
_LEVELS = {"(": 1, "[": 1, "{": 1, ")": -1, "]": -1, "}": -1}


def loose_node(text: str) -> YamlNode | None:
    """What a text says as a list, a mapping or a scalar; None where a bracket never closes."""
    if len(text) > MAX_LENGTH or not _is_balanced(text):
        return None
    return _node(text, 0, len(text), MAX_DEPTH)


def _node(text: str, start: int, end: int, depth: int) -> YamlNode:
    start, end = _stripped(text, start, end)
    opening, closing = text[start : start + 1], text[end - 1 : end]
    if depth and opening == "[" and closing == "]":
        pieces = _pieces(text, start + 1, end - 1)
        return YamlNode("list", start, end, inside=[_node(text, *piece, depth - 1) for piece in pieces])
    if depth and opening == "{" and closing == "}" and _KEY.match(text, start + 1):
        return _mapping(text, start, end, depth)
    is_quoted = end - start > 1 and opening in "'\"" and opening == closing
    return YamlNode(opening if is_quoted else "", start, end)


def _mapping(text: str, start: int, end: int, depth: int) -> YamlNode:
    """{key: value, ...}; a piece without a key goes on with the value before it."""
    node = YamlNode("mapping", start, end)
    for first, last in _pieces(text, start + 1, end - 1):
        name = _KEY.match(text, first, last)
        if name is None:
            node.inside[-1] = _node(text, node.inside[-1].start, last, depth - 1)
            continue
        node.inside.append(_node(text, name.start(1), name.end(1), 0))
        node.inside.append(_node(text, name.end(), last, depth - 1))
    return node


def _pieces(text: str, start: int, end: int) -> list[tuple[int, int]]:
    """Where the items stand that commas part, outside of brackets."""
    found, level, first = [], 0, start
    for at in range(start, end):
        level += _LEVELS.get(text[at], 0)
        if text[at] == "," and level == 0:
            found.append((first, at))
            first = at + 1
    return [*found, (first, end)] if text[first:end].strip() else found


def _stripped(text: str, start: int, end: int) -> tuple[int, int]:
    while start < end and text[start].isspace():
        start += 1
    while start < end and text[end - 1].isspace():
        end -= 1
    return start, end


def _is_balanced(text: str) -> bool:
    level = 0
    for character in text:
        level += _LEVELS.get(character, 0)
        if level < 0:
            return False
    return level == 0
