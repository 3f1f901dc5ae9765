"""Sentences written as they are read, with values and formulas put in.

    say("Entry $d_ij$ is the factor of $q̈_j$ in the force of the {machine}.", machine="arm")

Formulas stand between dollar signs, as `notation.template` has them; values stand in braces, in formulas
as in words.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping
from functools import lru_cache

from dynsolve.document import Inline, Prose
from dynsolve.notation.template import Value as FormulaValue
from dynsolve.notation.template import formula

Value = Inline | Prose | int
"""What is put in: words, a formula, numbers of results, a sentence."""


def say(text: str, /, **values: Value) -> Prose:
    """A sentence: words, formulas between dollar signs, values in braces.  What is empty leaves no trace.

    >>> say("Its mass is $m$, {more}.", more="and so on")
    ('Its mass is ', Symbol(name='m', dots=0, star=False), ', and so on.')
    """
    return tuple(_joined(_pieces(text, values)))


def paragraph(sentences: Iterable[Prose]) -> Prose:
    """Sentences after each other; those that are empty leave no trace.

    >>> paragraph([say("One."), (), say("Two.")])
    ('One. Two.',)
    """
    said = [sentence for sentence in sentences if sentence]
    return tuple(_joined(part for k, one in enumerate(said) for part in ([" "] * (k > 0) + [*one])))


def opened(text: str) -> str:
    """Words that begin a sentence: their first letter a capital, every other letter as it is.

    >>> opened("body b of link A")
    'Body b of link A'
    """
    return text[:1].upper() + text[1:]


def _pieces(text: str, values: Mapping[str, Value]) -> Iterator[Inline]:
    for piece, kind in _split(text):
        if kind == "formula":
            yield formula(piece, **_of_formula(values))
        elif kind == "value":
            value = values[piece]
            if isinstance(value, tuple):
                yield from value
            else:
                yield str(value) if isinstance(value, int) else value
        else:
            yield piece


def _joined(parts: Iterable[Inline]) -> Iterator[Inline]:
    """The parts, words that follow each other in one."""
    words = ""
    for part in parts:
        if isinstance(part, str):
            words += part
            continue
        if words:
            yield words
            words = ""
        yield part
    if words:
        yield words


@lru_cache(maxsize=4096)
def _split(text: str) -> tuple[tuple[str, str], ...]:
    """The pieces of a sentence, each with its kind."""
    found: list[tuple[str, str]] = []
    for place, piece in enumerate(text.split("$")):
        if place % 2:
            found.append((piece, "formula"))
            continue
        for odd, part in enumerate(re.split(r"\{(\w+)\}", piece)):
            if part:
                found.append((part, "value" if odd % 2 else "words"))
    return tuple(found)


def _of_formula(values: Mapping[str, Value]) -> dict[str, FormulaValue]:
    return {name: value for name, value in values.items() if isinstance(value, FormulaValue)}
