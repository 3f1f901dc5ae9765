"""Equations in plain text: lines `tau1 = ...`, as they are typed and as MATLAB and Python print them."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator

_LEAD = re.compile(r"[ \t]*(?:>>>?[ \t]+|[-*+•>][ \t]+|[0-9]{1,2}[.)][ \t]+|\(?[a-z]\)[ \t]+)?")
_EQUATION = re.compile(r"[^\n=]{1,200}=")
_ITEM = re.compile(r"[-*+][ \t]+[^=]{1,60}=|[-*+][ \t]+[^\s:]{1,40}:[ \t]")
"""The next item of a list, which is no term of the equation above."""

_NAMED = re.compile(r"([^\s:=|$]{1,40}):[ \t]+(?=\S)")
_SAID = re.compile(r"[^\n=$]{1,150}:[ \t]+(?=[^\s:=]{1,40}[ \t]*=)")
_WORDS = re.compile(r"(?:[^\W\d_]{2,30}[,.]?[ \t]+){1,20}(?=[^\s:=]{1,40}[ \t]*=)")
"""The words of a sentence before an equation: `The potential energy P = ...`."""

_AND = re.compile(r"[ \t](?:and|og|und|et|y)[ \t](?=[ \t]{0,9}[^\s:=]{1,40}[ \t]*=)")
_REMARK = re.compile(r"(?:(?<=\s)|(?<=[;)\]]))(?:#|//|%(?!pi\b))[^\n]*")
_DOTS = re.compile(r"\.\.\.[ \t]*(?=\n)")
_TRAILING = frozenset("=+-*/,([{&\\")
_LEADING = frozenset("=+-*/)][")


def plain_lines(
    text: str, start: int, end: int, names_answer: Callable[[str], bool]
) -> Iterator[tuple[int, str]]:
    """The equations between two offsets: each with its own, and its text, which has the length it had."""
    position = start
    while position < end:
        stop = text.find("\n", position, end)
        stop = end if stop < 0 else stop
        first = _begins(text, position, stop, names_answer)
        if first >= 0:
            stop = _whole(text, first, stop, end)
            yield first, _formula(text[first:stop], names_answer)
        position = stop + 1


def _begins(text: str, start: int, stop: int, names_answer: Callable[[str], bool]) -> int:
    """Where the equation of a line begins, behind a list's mark or `Potential energy: `; -1 without one."""
    if "$" in text[start:stop]:
        return -1
    lead = _LEAD.match(text, start, stop)
    first = lead.end() if lead else start
    if (named := _NAMED.match(text, first, stop)) is not None and names_answer(named[1]):
        return first
    if not _EQUATION.match(text, first, stop):
        return -1
    said = _SAID.match(text, first, stop)
    first = said.end() if said else first
    words = _WORDS.match(text, first, stop)
    if words is not None and names_answer(text[words.end() : text.index("=", words.end())].strip()):
        return words.end()
    return first


def _formula(piece: str, names_answer: Callable[[str], bool]) -> str:
    """The equation without remarks and the dots of lines that go on; `K1: ...` as `K1= ...`."""
    piece = _REMARK.sub(lambda found: " " * len(found[0]), piece)
    piece = _DOTS.sub(lambda found: " " * len(found[0]), piece)
    piece = _AND.sub(lambda found: ";" + " " * (len(found[0]) - 1), piece)
    named = _NAMED.match(piece)
    if named is not None and names_answer(named[1]):
        at = named.end(1)
        piece = f"{piece[:at]}={piece[at + 1 :]}"
    return piece


def _whole(text: str, start: int, stop: int, end: int) -> int:
    """Where an equation ends that goes on in the lines below."""
    level, seen = 0, start
    for _ in range(100):
        line = _REMARK.sub("", text[seen:stop]).rstrip()
        goes_on = line.endswith("...")
        line = line.removesuffix("...").rstrip()
        level += sum((c in "([{") - (c in ")]}") for c in line)
        if line.endswith("=") and seen == start:
            stop = _skip_blank_lines(text, stop, end)
        below = text.find("\n", stop + 1, end)
        below = end if below < 0 else below
        following = text[stop + 1 : below].strip()
        pending = level > 0 or goes_on or line[-1:] in _TRAILING
        leads = following[:1] in _LEADING and not _ITEM.match(following)
        if stop >= end or not following or not (pending or leads):
            break
        seen, stop = stop, below
    return stop


def _skip_blank_lines(text: str, stop: int, end: int) -> int:
    """The end of the last blank line below, as MATLAB prints one between `K1 =` and the value."""
    last = stop
    for _ in range(3):
        below = text.find("\n", last + 1, end)
        if below < 0 or text[last + 1 : below].strip():
            break
        last = below
    return last
