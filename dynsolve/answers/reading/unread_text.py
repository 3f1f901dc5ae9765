"""Text that was not read as equations: what is asked for and stands before `=` there is listed.

So an equation in code, or in a line of prose that no reader knows, waits for a human like any other.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from itertools import islice

from dynsolve.answers.reading.equation_reader import EquationReader
from dynsolve.answers.reading.left_side import read_left_side, spoken_of
from dynsolve.answers.reading.shapes import shown
from dynsolve.answers.reading.sources import Source
from dynsolve.answers.reading.tokens.prepare import prepared
from dynsolve.answers.submission import NotRecognized
from dynsolve.errors import ReadError

NOT_READ = "it stands where no equation is read"

_GROUP = r"(?:[\[(][^\[\]()\n=]{0,40}[\])])?"
_BEFORE_SIGN = re.compile(
    rf"(?<![^\s,;:|$&(\"'*])(?P<name>[^\s=,;:|$&\"'()\[\]*<>!+/-]{{1,40}}{_GROUP})"
    r"[\"'*$}]{0,4}[ \t]{0,9}:?=(?!=)"
)
_CALLED = re.compile(
    rf"(?m)(?:\bEq\([ \t]*|^>>>[ \t]+)(?P<name>[^\s=,;:|$&\"'()\[\]*<>!+/-]{{1,40}}{_GROUP})(?=,|[ \t]*$)"
)
"""SymPy's `Eq(tau1, ...)`, and a name behind Python's prompt, its value below."""

_KEY = re.compile(
    r"(?m)(?:^[ \t>-]*|[{,][ \t]*)[\"']?(?P<name>[^\s:\"'#={,][^:\"'#=\n]{0,40}?)[\"']?[ \t]*[:=](?=\s)"
)
_MOST = 2_000
_MOST_LISTED = 100
"""So many signs of equality are looked at, and so many of them are listed."""


def list_unread(reader: EquationReader, source: Source, text: str, why: str = NOT_READ) -> None:
    """List what stands before `=` in a text, in which what was read is blank, and is asked for."""
    _list(reader, source, text, _BEFORE_SIGN, why)
    _list(reader, source, text, _CALLED, why)


def list_unread_keys(reader: EquationReader, source: Source, text: str, why: str = NOT_READ) -> None:
    """List the keys in a text that name what is asked for."""
    _list(reader, source, text, _KEY, why)


def _list(reader: EquationReader, source: Source, text: str, pattern: re.Pattern[str], why: str) -> None:
    named: Callable[[str], tuple[str, ...]] = _Names(reader)
    seen = set[tuple[int, tuple[str, ...]]]()
    for found in islice(pattern.finditer(text), _MOST):
        names = named(found["name"])
        begin = text.rfind("\n", 0, found.start("name")) + 1
        if not names or (begin, names) in seen or len(seen) == _MOST_LISTED:
            continue
        seen.add((begin, names))
        end = text.find("\n", found.end())
        line = source.text[found.start("name") : end if end >= 0 else len(text)]
        place = source.place(found.start("name"), len(found["name"]))
        reader.found.not_recognized.append(NotRecognized(shown(line), "", place, why, names))


class _Names:
    """What is asked for of the answers that a text speaks of."""

    def __init__(self, reader: EquationReader) -> None:
        self.vocabulary = reader.vocabulary
        self.known: dict[str, tuple[str, ...]] = {}

    def __call__(self, text: str) -> tuple[str, ...]:
        if text not in self.known:
            try:
                member = prepared(text)[:-1]
                names = spoken_of(self.vocabulary, member, read_left_side(self.vocabulary, member))
            except ReadError:
                names = ()
            self.known[text] = tuple(name for name in names if name in self.vocabulary.asked)
        return self.known[text]
