"""One report on several problems: which part of it is for which, told by its headings.

A part begins with a heading that names a problem, by its file's stem or its title, or else by its number in
the set (`Problem 2`, `Oppgave 2`), and ends where the next one begins.  What stands before the first
of them, names and macros say, belongs to all.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from html import unescape

HEADING = re.compile(
    r"(?m)^#{1,6}[ \t]+(.{1,300})$|^([^\n]{1,300})\n={3,}[ \t]*$"
    r"|\\(?:title|section|chapter|subsection)\*?\{([^}\n]{1,300})\}|<h[1-6][^>]{0,300}>((?s:.{1,300}?))</h"
)
"""A heading in Markdown, LaTeX and HTML."""

_SET_OFF = re.compile(r"(?m)^(?:\*\*|__)([^*_\n$=]{1,100})(?:\*\*|__)[ \t]*$|^([^\n$=:]{1,30}):?[ \t]*$")
"""A line in bold, or a short one of words alone, as it stands over a part in plain text."""

_NUMBER = re.compile(
    r"\W{0,9}(?:problem|exercise|task|question|oppgave|oppg|opgave|uppgift|aufgabe|exercice|ejercicio"
    r"|esercizio|tehtävä)\W{1,3}([0-9]{1,2})\b",
    re.IGNORECASE,
)
_TAG = re.compile(r"<[^>]{0,300}>")
_NOT_LINE_END = re.compile(r"[^\n]")

Span = tuple[int, int]


def titles(text: str) -> list[tuple[int, str]]:
    """The headings of a text with their offsets."""
    return [
        (found.start(), unescape(_TAG.sub(" ", next(filter(None, found.groups())))))
        for found in HEADING.finditer(text)
    ]


def parts(text: str, named: Callable[[str], str], stems: Sequence[str]) -> dict[str, tuple[Span, ...]]:
    """What a report holds for each problem: the spans that are of others; of one problem alone nothing.

    `named` gives the stem of the problem that a heading names, or nothing; `stems` are all, in their order.
    """
    begins = _begins(text, named, stems)
    if len({stem for _, stem in begins}) < 2:
        return {}
    ends = [*(at for at, _ in begins[1:]), len(text)]
    spans = [(at, end, stem) for (at, stem), end in zip(begins, ends, strict=True)]
    return {
        stem: tuple((at, end) for at, end, other in spans if other != stem)
        for stem in dict.fromkeys(stem for _, stem in begins)
    }


def _begins(text: str, named: Callable[[str], str], stems: Sequence[str]) -> list[tuple[int, str]]:
    """Where a part begins, and for which problem."""
    headings = titles(text)
    by_name = [(at, stem) for at, title in headings if (stem := named(title))]
    by_number = [(at, stem) for at, title in headings if (stem := _numbered(title, stems))]
    if not by_name:
        return by_number or [
            (found.start(), stem)
            for found in _SET_OFF.finditer(text)
            if (stem := _numbered(found[1] or found[2], stems))
        ]
    both = dict(by_name)
    agree = [both[at] == stem for at, stem in by_number if at in both]
    if agree and all(agree):
        return sorted({**dict(by_number), **both}.items())
    return by_name


def _numbered(title: str, stems: Sequence[str]) -> str:
    """The problem of a number in the set."""
    found = _NUMBER.match(title)
    number = int(found[1]) if found else 0
    return stems[number - 1] if 1 <= number <= len(stems) else ""


def without(text: str, spans: Sequence[Span]) -> str:
    """The text with blanks for some spans: every line keeps its number."""
    pieces, done = [], 0
    for start, end in spans:
        pieces += [text[done:start], _NOT_LINE_END.sub(" ", text[start:end])]
        done = end
    return "".join([*pieces, text[done:]])
