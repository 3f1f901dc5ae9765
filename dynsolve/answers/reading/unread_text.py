"""Text that was not read as equations: what is asked for and stands before `=` there is listed.

So an equation in code, or in a line of prose that no reader knows, waits for a human like any other.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Callable
from itertools import islice

from dynsolve.answers.reading.answer_list import Member
from dynsolve.answers.reading.displays import OPENS, Display
from dynsolve.answers.reading.equation_reader import EquationReader
from dynsolve.answers.reading.left_side import RightSide, is_value, read_left_side, read_right_side, spoken_of
from dynsolve.answers.reading.matrix_parts import shown
from dynsolve.answers.reading.sources import Source
from dynsolve.answers.reading.tokens.prepare import prepared
from dynsolve.answers.verdict import PICTURE, Answer, NotRecognized, Place
from dynsolve.errors import ReadError
from dynsolve.notation.tree import names_in

NOT_READ = "it stands where no equation is read"

_GROUP = r"(?:[\[(][^\[\]()\n=]{0,40}[\])])?"
_BEFORE_SIGN = re.compile(
    rf"(?<![^\s,;:|$&(\"'*])(?P<name>[^\s=,;:|$&\"'()\[\]*<>!+/-]{{1,40}}{_GROUP})"
    r"[\"'*$}]{0,4}[ \t]{0,9}:?=(?!=)"
)
_PROMPT = r"(?:>>>|In ?\[[0-9]{1,4}\]:)[ \t]{1,9}"
_CALLED = re.compile(
    rf"(?m)(?:\bEq\([ \t]*|^{_PROMPT})"
    rf"(?P<name>[^\s=,;:|$&\"'()\[\]*<>!+/-]{{1,40}}{_GROUP})"
    r"(?:,|[ \t]{0,9}$(?:\n[ \t]{0,9}Out ?\[[0-9]{1,4}\]:)?)"
)
"""SymPy's `Eq(tau1, ...)`, and a name behind a prompt of Python, its value below."""

_OUTSIDE = re.compile(rf"(?:{_PROMPT})?")
_CHANGED = re.compile(
    rf"(?<![^\s;])(?P<name>[^\s=,;:|$&\"'()\[\]*<>!+/-]{{1,40}}{_GROUP})[ \t]{{0,9}}[-+*/]="
)
_REMARK = re.compile(r"#[^\n]*")
_PICTURE = re.compile(
    r"!\[[^\[\]\n]{0,200}\]\([^()\n]{1,300}\)|<img\s[^<>\n]{1,300}>"
    r"|\\includegraphics(?:\[[^\[\]\n]{0,200}\])?\{[^{}\n]{1,200}\}"
)
_MOST_PICTURES = 20
_LONGEST_READ = 5_000

_KEY = re.compile(
    r"(?m)(?:^[ \t>-]*|[{,][ \t]*)[\"']?(?P<name>[^\s:\"'#={,][^:\"'#=\n]{0,40}?)[\"']?[ \t]*[:=](?=\s)"
)
_MOST = 2_000
_MOST_LISTED = 100
"""So many signs of equality are looked at, and so many of them are listed."""


def list_unread(
    reader: EquationReader, source: Source, text: str, why: str = NOT_READ, is_code: bool = False
) -> None:
    """List what stands before `=` in a text, in which what was read is blank, and is asked for.

    What a program prints of a name, or gives a name of its `is_code` once, outside of loops, is read.
    """
    _list(reader, source, text, _BEFORE_SIGN, why, is_read=is_code)
    _list(reader, source, text, _CALLED, why, is_read=True)


def list_pictures(reader: EquationReader, source: Source, text: str) -> None:
    """List the pictures of a report, in which anything may stand that is asked for."""
    for found in islice(_PICTURE.finditer(text), _MOST_PICTURES):
        place = source.place(found.start(), len(found[0]))
        reader.found.not_recognized.append(picture(reader, shown(found[0]), place))


def picture(reader: EquationReader, text: str, place: Place) -> NotRecognized:
    """The record of a picture."""
    return NotRecognized(text, "", place, PICTURE, tuple(sorted(reader.vocabulary.asked)))


def list_unread_keys(reader: EquationReader, source: Source, text: str, why: str = NOT_READ) -> None:
    """List the keys in a text that name what is asked for."""
    _list(reader, source, text, _KEY, why)


def _list(
    reader: EquationReader,
    source: Source,
    text: str,
    pattern: re.Pattern[str],
    why: str,
    is_read: bool = False,
) -> None:
    named: Callable[[str], tuple[str, ...]] = _Names(reader)
    seen = set[tuple[int, tuple[str, ...]]]()
    matches = list(islice(pattern.finditer(text), _MOST))
    times = Counter(found["name"] for found in matches)
    if is_read and matches:
        times.update(found["name"] for found in islice(_CHANGED.finditer(text), _MOST))
    for found in matches:
        names = named(found["name"])
        begin = text.rfind("\n", 0, found.start("name")) + 1
        if not names or (begin, names) in seen or len(seen) == _MOST_LISTED:
            continue
        seen.add((begin, names))
        end = text.find("\n", found.end())
        line = source.text[found.start("name") : end if end >= 0 else len(text)]
        place = source.place(found.start("name"), len(found["name"]))
        refused = NotRecognized(shown(line), "", place, why, names)
        is_outside = pattern is _CALLED or _OUTSIDE.fullmatch(text, begin, found.start("name"))
        is_once = is_read and is_outside and times[found["name"]] == 1
        answers = _answers(reader, source, text, found.end(), names) if is_once else []
        if answers:
            reader.found.said_aside(refused, answers)
        else:
            reader.found.not_recognized.append(refused)


def _answers(
    reader: EquationReader, source: Source, text: str, start: int, names: tuple[str, ...]
) -> list[Answer]:
    """What a value that begins here answers; nothing where it cannot be read, or the names are answered."""
    quantities = reader.vocabulary.quantities
    given = {
        part for answer in reader.found.answers if answer.node for part in quantities.within(answer.name)
    }
    parts = {part for name in names for part in quantities.parts(name)}
    if given.intersection(names) or (parts and parts <= given):
        return []
    value = _REMARK.sub(lambda remark: " " * len(remark[0]), text[start : _end(text, start)])

    def locate(offset: int, length: int) -> Place:
        return source.place(start + offset, length)

    origin = reader.origin(Display(value, "", locate, plain=True), "")
    try:
        tokens = prepared(value.replace("\n", " "))[:-1]
    except ReadError:
        return []
    found = read_right_side(reader.vocabulary, tokens, names)
    if not isinstance(found, RightSide) or not is_value(found):
        return []
    answer = reader.found.answer(names, Member(1, tokens, found), origin)
    holds = answer.node is not None and not names_in(answer.node).isdisjoint(
        q.name for q in reader.vocabulary.coordinates
    )
    is_entry = bool(quantities.entry_of(answer.name)[0])  # an energy that begins with 0 is none yet
    return [answer] if answer.node is not None and (holds or is_entry) else []


def _end(text: str, start: int) -> int:
    """Where a value ends: at the end of its line, or where a bracket closes that it did not open."""
    level = 0
    start += len(text[start : start + 99]) - len(text[start : start + 99].lstrip())
    last = min(len(text), start + _LONGEST_READ)
    for at in range(start, last):
        level += OPENS.get(text[at], 0)
        if level < 0 or (level == 0 and text[at] == "\n"):
            return at
    return last


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
