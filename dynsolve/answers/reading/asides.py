"""What a formula in the midst of a sentence says: it defines letters, and answers what nothing else does.

Verdicts on matrices in the lines of a report: `$M_a$: no`, `| $M_b$ | yes |`, `M_c is not valid`.

Text that was not read as equations: what is asked for and stands before `=` there is listed.

So an equation in code, or in a line of prose that no reader knows, waits for a human like any other.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterator, Sequence
from itertools import islice

from msgspec.structs import replace

from dynsolve.answers.reading.answer_list import Member, Origin
from dynsolve.answers.reading.by_content import (
    called_force,
    called_friction,
    force_meant,
    is_condition,
    meant,
    motion_equation,
    states_zero,
)
from dynsolve.answers.reading.displays import OPENS, Display, Equation, equations
from dynsolve.answers.reading.equation_reader import EquationReader
from dynsolve.answers.reading.grammar.references import OWN_LETTERS
from dynsolve.answers.reading.grids import MAX_MEMBERS, Abstract
from dynsolve.answers.reading.left_side import (
    LeftSide,
    NamedAnswers,
    RightSide,
    UnknownSide,
    is_value,
    name_alone,
    read_left_side,
    read_left_sides,
    read_right_side,
    spoken_in,
    spoken_of,
)
from dynsolve.answers.reading.lexer import Token
from dynsolve.answers.reading.matrix_parts import shown
from dynsolve.answers.reading.prepare import prepared
from dynsolve.answers.reading.report_text import CONDITION, may_hold
from dynsolve.answers.reading.sources import Source, blanked
from dynsolve.answers.reading.vocabulary import Vocabulary, defined_order
from dynsolve.answers.verdict import PICTURE, Answer, NotRecognized, Place, VerdictAnswer
from dynsolve.errors import ReadError
from dynsolve.notation.tree import Node, Reference, Symbol
from dynsolve.quantities.letters import key

_NEVER_DEFINED = frozenset({"t", "i", "j", "k", "n"})
"""Letters of sentences that are no abbreviation: the time, running indices, the number of joints."""


def read_aside(reader: EquationReader, display: Display) -> None:
    """Keep what a formula in a sentence says of a letter; what it says of an answer may be listed."""
    origin = Origin(display, "", reader.equations)
    try:
        found = equations(prepared(display.text, reader.macros))
    except ReadError as error:
        refused = origin.not_recognized(0, len(display.text), error.message)
        reader.found.not_recognized.append(refused)
        return
    for equation in found:
        _read_equation(reader, equation, reader.origin(display, ""))


def _read_equation(reader: EquationReader, equation: Equation, origin: Origin) -> None:
    """Keep one of them: an order of angles, equations of motion, an answer, or the meaning of a letter."""
    members, vocabulary, aside = equation.members, reader.vocabulary, origin.display.aside
    if (order := defined_order(members)) is not None:
        vocabulary.count(dict([order]))
        reader.found.left_alone.append(origin.of(members, aside))
        return
    side = read_left_side(vocabulary, members[0])
    motion = None if isinstance(side, NamedAnswers) else motion_equation(vocabulary, members)
    if motion is not None:
        tokens = [token for member in members for token in member]
        origin = replace(origin, names=motion.forces)
        refused = origin.of(members, aside)
        if may_hold(aside):
            reader.found.motion_aside(motion, tokens, origin, refused)
        else:
            reader.found.said_aside(refused)
        return
    origin = replace(origin, names=spoken_of(vocabulary, members[0], side))
    value: RightSide | ReadError = ReadError(f"more than {MAX_MEMBERS} members")
    if len(members) <= MAX_MEMBERS:
        value = read_right_side(vocabulary, members[-1])
    if isinstance(value, RightSide):
        side, names = _by_content(reader, members[0], side, value)
        origin = replace(origin, names=names or origin.names)
    members, value = _without_condition(vocabulary, members, side, value)
    if reader.defines_shorthand(members[0], [value] if isinstance(value, RightSide) else []):
        reader.found.left_alone.append(origin.of(members, aside))
        return
    gives = isinstance(value, RightSide) and not isinstance(value.value, Abstract)
    if isinstance(side, NamedAnswers) and (
        isinstance(value, ReadError) or (gives and reader.any_fits(side.candidates, [value]))
    ):
        _keep_answers(reader, members, side, value, origin)
    else:
        _keep_meaning(reader, equation, members, side, value, origin)


def _by_content(
    reader: EquationReader, first: list[Token], side: LeftSide, value: RightSide
) -> tuple[LeftSide, tuple[str, ...]]:
    """What a left side means by what it is equal to, and the answers that it may speak of."""
    vocabulary = reader.vocabulary
    names: tuple[str, ...] = ()
    if isinstance(side, UnknownSide):
        forces = force_meant(vocabulary, side.key, value.value)
        names = meant(vocabulary, side.key, value.value) or forces
        if len(names) != 1:
            return side, names
        reader.define(side.key, value)
        side = NamedAnswers(names)
    if not isinstance(side, NamedAnswers):
        return side, names
    name = name_alone(vocabulary, first)
    called = called_force(vocabulary, name, side.candidates, [value.value])
    if friction := called_friction(vocabulary, name, side.candidates, [value.value]):
        reader.define(name, replace(value, value=Reference(friction[0])))
    side = NamedAnswers(called or friction or side.candidates)
    return side, side.candidates


def _without_condition(
    vocabulary: Vocabulary, members: list[list[Token]], side: LeftSide, value: RightSide | ReadError
) -> tuple[list[list[Token]], RightSide | ReadError]:
    """The members and their value, without the last one where it only says when the one before holds."""
    before = read_right_side(vocabulary, members[-2]) if len(members) > 2 else None
    names = [side.candidates] if isinstance(side, NamedAnswers) else []
    if (
        isinstance(before, RightSide)
        and is_value(before)
        and is_condition(vocabulary, names, value, [before])
    ):
        return members[:-1], before
    return members, value


def _keep_answers(
    reader: EquationReader,
    members: list[list[Token]],
    side: NamedAnswers,
    value: RightSide | ReadError,
    origin: Origin,
) -> None:
    """Keep the answers that all left sides name, where nothing else answers them."""
    vocabulary, aside = reader.vocabulary, origin.display.aside
    sides = [side, *read_left_sides(vocabulary, members)[1:]]
    names = [one.candidates for one in sides if isinstance(one, NamedAnswers)]
    member = Member(len(members) - 1, members[-1], value)
    answers = [reader.found.answer(candidates, member, origin) for candidates in names]
    refused = origin.of(members, value.message if isinstance(value, ReadError) else aside)
    if isinstance(value, RightSide) and value.is_definition:
        reader.found.left_alone.append(replace(refused, needs=value.references))
        reader.found.general += answers
        return
    holds = may_hold(aside)
    if holds and states_zero(vocabulary, members[0], names, value):
        refused, holds = replace(refused, why=CONDITION), False
    reader.found.said_aside(refused, answers if holds else ())


def _keep_meaning(
    reader: EquationReader,
    equation: Equation,
    members: list[list[Token]],
    side: LeftSide,
    value: RightSide | ReadError,
    origin: Origin,
) -> None:
    """Keep what a letter means, or that it cannot be read."""
    vocabulary, aside = reader.vocabulary, origin.display.aside
    if isinstance(value, ReadError) or isinstance(value.value, Abstract):
        reader.found.left_alone.append(origin.of(members, aside))
        if isinstance(value, ReadError) and isinstance(side, UnknownSide):
            vocabulary.cannot_be_read(side.key, value.message)
        return
    if _only_renames(vocabulary, members[0], side, value):
        origin = replace(origin, names=())
    refused = origin.of(members, aside)
    own = members[0][0].text if len(members[0]) == 1 else ""
    kept = _define(reader, side, own, value, equation)
    if kept:
        reader.found.own_scalars.append((kept, [], refused))
    else:
        reader.found.left_alone.append(refused)
    _define_by_the_end(reader, members)


def _only_renames(vocabulary: Vocabulary, first: list[Token], side: LeftSide, found: RightSide) -> bool:
    r"""Whether a formula only says what else a symbol, a sine or a cosine is called: `\sin q_2 = s_2`."""
    value = found.value
    same = read_right_side(vocabulary, first)
    is_same = isinstance(same, RightSide) and isinstance(value, Node) and same.value == value
    return is_same or (isinstance(side, NamedAnswers) and isinstance(value, Symbol))


def _define_by_the_end(reader: EquationReader, members: list[list[Token]]) -> None:
    r"""Keep the letter at the end of `\cos q_2 = ... =: D`."""
    last = read_left_side(reader.vocabulary, members[-1])
    value = read_right_side(reader.vocabulary, members[-2]) if len(members) > 2 else None
    if isinstance(value, RightSide) and isinstance(last, NamedAnswers):
        reader.define_scalar(members[-1], last, value)


def _define(reader: EquationReader, side: LeftSide, own: str, value: RightSide, equation: Equation) -> str:
    """Keep what a letter means; gives what it is kept under where else it is the name of an answer."""
    if isinstance(side, UnknownSide):
        is_new = side.is_name_alone and not side.family and side.key not in _NEVER_DEFINED
        if is_new:
            reader.define(side.key, value)
    elif not isinstance(side, NamedAnswers):
        reader.defines_in_passing(equation.members[0], value)
    elif own in OWN_LETTERS:
        reader.define(own, value)
    else:
        return reader.define_scalar(equation.members[0], side, value)
    return ""


# Verdicts on matrices in the lines of a report

_NAME = r"(?<![A-Za-z_\\])(?P<name>[A-Za-z]\}?(?:_?\{?[A-Za-z0-9]{1,4}\}?)?)(?:\([^()\n]{0,9}\))?"
_SAID = re.compile(rf"{_NAME}[ \t$*`}}|:=→-]*(?P<said>[^\n,;|:=$]{{1,90}})")
_HEAD = re.compile(r"[^A-Za-z\n]*(?:textbf\{)?(?:positive[ -])?definite[^A-Za-z\n]*[:=]", re.IGNORECASE)
_IS_ONE = re.compile(r"(?:inertia matri|positive[ -]definite|\bcan be\b|\bcould be\b|admissible|\bvalid\b)")
_NOT = re.compile(r"\b(?:not|cannot|can't|never|isn't|non)\b")
_BEGINNINGS = {
    "yes": re.compile(r"(?:yes|ja|true|possible|ok|✓|✔)(?!\w)"),
    "no": re.compile(r"(?:no|nei|nein|false|impossible|✗|✘|×)(?!\w)"),
    "if": re.compile(r"(?:(?:only )?if|conditional(?:ly)?|sometimes|provided)\b"),
}


def spoken_verdicts(names: Sequence[str], source: Source, text: str) -> tuple[list[VerdictAnswer], str]:
    """The verdicts that a report says on the matrices of these names, and the text without their lines.

    Of one matrix it may be what stands behind the head `definite:` that is said.
    """
    spelled = {key(name): name for name in names}
    said: dict[str, str] = {}
    first, at, lines = -1, 0, list[str]()
    for line in text.splitlines(keepends=True):
        found = list(_verdicts(line, spelled)) or list(_headed(line) if len(names) < 2 else ())
        first = at if found and first < 0 else first
        said |= found
        lines.append(blanked(line) if found else line)
        at += len(line)
    if not said:
        return [], text
    written = ", ".join(f"{name}: {word}" for name, word in said.items())
    answer = VerdictAnswer("definite", source.place(first, 1), written, tuple(said.items()))
    return [answer], "".join(lines)


def _headed(line: str) -> Iterator[tuple[str, str]]:
    """What one line says of the only matrix."""
    head = _HEAD.match(line)
    word = _meaning(line[head.end() :].strip(" \t\n$*_").lower()) if head is not None else ""
    if word:
        yield "", word


def _verdicts(line: str, spelled: dict[str, str]) -> Iterator[tuple[str, str]]:
    """(matrix, yes, no or if) of what one line says."""
    for found in _SAID.finditer(line):
        name = spelled.get(key(found["name"]))
        word = _meaning(found["said"].strip().lower()) if name else ""
        if name and word:
            yield name, word


def _meaning(said: str) -> str:
    """yes, no or if; empty of words that say neither."""
    for word, beginning in _BEGINNINGS.items():
        if beginning.match(said):
            return word
    if _IS_ONE.search(said):
        return "no" if _NOT.search(said) else "yes"
    return ""


# Text that was not read as equations

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

    def named(text: str) -> tuple[str, ...]:
        """What is asked for of the answers that a text speaks of."""
        return tuple(name for name in spoken_in(reader.vocabulary, text) if name in reader.vocabulary.asked)

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
    origin = reader.origin(Display(value, "", source.behind(start), plain=True), "")
    try:
        tokens = prepared(value.replace("\n", " "))[:-1]
    except ReadError:
        return []
    found = read_right_side(reader.vocabulary, tokens, names)
    if not isinstance(found, RightSide) or not is_value(found):
        return []
    answer = reader.found.answer(names, Member(1, tokens, found), origin)
    is_entry = bool(quantities.entry_of(answer.name)[0])  # an energy that begins with 0 is none yet
    return [answer] if reader.found.holds_generally(answer) or (answer.node and is_entry) else []


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
