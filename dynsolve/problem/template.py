"""The problem file that `dynsolve new` writes: valid as it stands, with every key and its meaning.

It is made from the specification of the keys: an `active` key stands with its example,
any other as a comment that can be uncommented.
"""

from __future__ import annotations

import re
from textwrap import wrap

from dynsolve.problem.kinds import BRACKETS, Key, Kind, ListOf, OneOf, Record, Shared, Word, either, ways
from dynsolve.problem.specification import PROBLEM

_WIDTH = 110
_SENTENCE_END = re.compile(r"(?<=[.]) (?=[A-Za-z])")
_FIXED_BLANK = "\N{NO-BREAK SPACE}"


def template() -> str:
    """A commented, valid example: the manipulator of the README."""
    return "\n".join(map(_entry, PROBLEM.keys))


def _entry(key: Key) -> str:
    """A key with its example, under a comment that says what it means."""
    sentences = _SENTENCE_END.split(f"{key.described} {key.more}".strip())
    comment = [line for sentence in sentences for line in _wrapped("# ", sentence)]
    example = f"{key.name}: {key.example}".replace(": \n", ":\n").replace("\n", "\n  ")
    if not key.active:
        example = "# " + example.replace("\n", "\n# ")
    return "\n".join([*comment, *_parts(key), example, ""])


def _parts(key: Key) -> list[str]:
    """The keys of each item of a list, a line each."""
    items = key.kind.items if isinstance(key.kind, ListOf) else None
    record = items.kind if isinstance(items, Shared) else items
    if not isinstance(record, Record):
        return []
    width = max(map(len, record.names)) + 2
    return [
        line
        for part in record.keys
        for line in _wrapped(f"#   {part.name:{width}}", part.described + _choice(part.kind))
    ]


def _choice(kind: Kind) -> str:
    """The ways in which a value can be written, where there are several."""
    kind = kind.kind if isinstance(kind, Shared) else kind
    return f" Write {either(ways(kind))}.".replace("`", "") if isinstance(kind, OneOf | Word) else ""


def _wrapped(head: str, text: str) -> list[str]:
    """The lines of a comment after its head; what stands in brackets is not broken."""
    whole = BRACKETS.sub(lambda found: found[0].replace(" ", _FIXED_BLANK), text)
    indent = "#" + " " * (len(head) - 1)
    lines = wrap(whole, _WIDTH, initial_indent=head, subsequent_indent=indent, break_on_hyphens=False)
    return [line.replace(_FIXED_BLANK, " ") for line in lines]
