"""What a sentence says of the entries that are not written: `all others are zero`, `sonst 0`."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from itertools import islice

from dynsolve.answers.reading.shapes import shown
from dynsolve.answers.reading.sources import Source
from dynsolve.answers.submission import Answer, Place
from dynsolve.notation.tree import ZERO
from dynsolve.quantities.index import Quantities

_OTHER = (
    r"others?|remaining|rest|übrigen|anderen|restlichen|restliche|øvrige|andre|andere|resten"
    r"|not (?:listed|given|shown|mentioned)"
)
_ZERO = r"(?:zero(?:es|s)?|vanish\w*|null|verschwinden|forsvinner|(?:=[ \t]{0,9})?\$?0)(?![\w.,]*\w)"
_REST_IS_ZERO = re.compile(
    rf"\b(?:(?:all|the|alle|die|de)[ \t]+(?:(?:the|die|de)[ \t]+)?)?(?:{_OTHER})\b[^.;\n+*/]{{0,60}}?{_ZERO}"
    rf"|\b(?:otherwise|else|sonst|ellers)[ \t]+(?:all[ \t]+|alles[ \t]+|alt[ \t]+)?{_ZERO}"
    rf"|\b{_ZERO}[ \t]+(?:otherwise|elsewhere|else|sonst|ellers)\b",
    re.IGNORECASE,
)
_NOT = re.compile(
    r"\b(?:not|non|nonzero|nicht|ikke|no|kein\w*)\b(?! (?:listed|given|shown|mentioned))", re.IGNORECASE
)
_WORDS = (
    *("other", "remaining", "rest", "übrigen", "andere", "øvrige", "andre", "listed", "given", "shown"),
    *("mentioned", "else", "ellers", "sonst", "otherwise"),
)
_MOST = 20


def rest_is_zero(text: str) -> Iterator[re.Match[str]]:
    """Where a text says so; without one of the words, which are quickly found, it is not searched."""
    lower = text.lower()
    return _REST_IS_ZERO.finditer(text) if any(word in lower for word in _WORDS) else iter(())


def said_zero(source: Source, text: str) -> Iterator[tuple[Place, str]]:
    """Where a text says that what is not written is zero."""
    for found in islice(rest_is_zero(text), _MOST):
        if not _NOT.search(found[0]):
            yield source.place(found.start(), len(found[0])), shown(found[0])


def others(answers: Iterable[Answer], quantities: Quantities, place: Place, text: str) -> list[Answer]:
    """The entries that a sentence says are zero: those beside the last one that is written before it."""
    answers = list(answers)
    here = place.line, place.column
    before = [a for a in answers if (a.place.line, a.place.column) < here]
    last = max(before, key=lambda a: (a.place.line, a.place.column), default=None)
    whole = quantities.entry_of(last.name)[0] if last is not None else ""
    names = {answer.name for answer in answers}
    if not whole or whole in names:
        return []
    written = {quantities.entry_of(one) for name in names for one in (name, quantities.mirrored(name))}
    by_entry = {quantities.entry_of(part): part for part in reversed(quantities.parts(whole))}
    after = 1 + max(answer.occurrence[0] for answer in answers)
    return [
        Answer(part, "", ZERO, place, text, "0", occurrence=(after + number, 0))
        for number, (entry, part) in enumerate(by_entry.items())
        if entry not in written
    ]
