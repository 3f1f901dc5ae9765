"""What a formula in the midst of a sentence says: it defines letters, and answers what nothing else does.

Verdicts on matrices in the lines of a report: `$M_a$: no`, `| $M_b$ | yes |`, `M_c is not valid`.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

from msgspec.structs import replace

from dynsolve.answers.reading.answer_list import Member, Origin
from dynsolve.answers.reading.by_content import (
    called_force,
    force_meant,
    is_condition,
    meant,
    motion_equation,
    states_zero,
)
from dynsolve.answers.reading.displays import Display, Equation, equations
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
    spoken_of,
)
from dynsolve.answers.reading.sentences import CONDITION, may_hold
from dynsolve.answers.reading.sources import Source
from dynsolve.answers.reading.tokens.lexer import Token
from dynsolve.answers.reading.tokens.prepare import prepared
from dynsolve.answers.reading.vocabulary import defined_order
from dynsolve.answers.verdict import VerdictAnswer
from dynsolve.errors import ReadError
from dynsolve.quantities.letters import key

# What a formula in the midst of a sentence says

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
    members = equation.members
    if (order := defined_order(members)) is not None:
        reader.vocabulary.orders |= [order]
        reader.found.left_alone.append(origin.of(members, origin.display.aside))
        return
    side = read_left_side(reader.vocabulary, members[0])
    motion = None if isinstance(side, NamedAnswers) else motion_equation(reader.vocabulary, members)
    if motion is not None:
        tokens = [token for member in members for token in member]
        origin = replace(origin, names=motion.forces)
        refused = origin.of(members, origin.display.aside)
        if may_hold(origin.display.aside):
            reader.found.motion_aside(motion, tokens, origin, refused)
        else:
            reader.found.said_aside(refused)
        return
    origin = replace(origin, names=spoken_of(reader.vocabulary, members[0], side))
    value = (
        read_right_side(reader.vocabulary, members[-1])
        if len(members) <= MAX_MEMBERS
        else ReadError(f"more than {MAX_MEMBERS} members")
    )
    if isinstance(side, UnknownSide) and isinstance(value, RightSide):
        forces = force_meant(reader.vocabulary, side.key, value.value)
        by_content = meant(reader.vocabulary, side.key, value.value) or forces
        if len(by_content) == 1:
            reader.define(side.key, value)
            side = NamedAnswers(by_content)
        origin = replace(origin, names=by_content or origin.names)
    if isinstance(side, NamedAnswers) and isinstance(value, RightSide):
        name = name_alone(reader.vocabulary, members[0])
        called = called_force(reader.vocabulary, name, side.candidates, [value.value])
        side = NamedAnswers(called or side.candidates)
        origin = replace(origin, names=side.candidates)
    names = [side.candidates] if isinstance(side, NamedAnswers) else []
    before = read_right_side(reader.vocabulary, members[-2]) if len(members) > 2 else None
    if (
        isinstance(before, RightSide)
        and is_value(before)
        and is_condition(reader.vocabulary, names, value, [before])
    ):
        members, value = members[:-1], before
    own = members[0][0].text if len(members[0]) == 1 else ""
    gives = isinstance(value, RightSide) and not isinstance(value.value, Abstract)
    if reader.defines_shorthand(members[0], [value] if isinstance(value, RightSide) else []):
        reader.found.left_alone.append(origin.of(members, origin.display.aside))
        return
    if isinstance(side, NamedAnswers) and (
        isinstance(value, ReadError) or (gives and reader.any_fits(side.candidates, [value]))
    ):
        sides = [side, *read_left_sides(reader.vocabulary, members)[1:]]
        names = [one.candidates for one in sides if isinstance(one, NamedAnswers)]
        member = Member(len(members) - 1, members[-1], value)
        answers = [reader.found.answer(candidates, member, origin) for candidates in names]
        refused = origin.of(members, value.message if isinstance(value, ReadError) else origin.display.aside)
        if isinstance(value, RightSide) and value.is_definition:
            reader.found.left_alone.append(replace(refused, needs=value.references))
            reader.found.general += answers
        else:
            holds = may_hold(origin.display.aside)
            if holds and states_zero(reader.vocabulary, members[0], names, value):
                refused, holds = replace(refused, why=CONDITION), False
            reader.found.said_aside(refused, answers if holds else ())
        return
    reader.found.left_alone.append(origin.of(members, origin.display.aside))
    if isinstance(value, ReadError):
        if isinstance(side, UnknownSide):
            reader.vocabulary.broken[side.key] = value.message
    elif gives:
        _define(reader, side, own, value, equation)
        _define_by_the_end(reader, members)


def _define_by_the_end(reader: EquationReader, members: list[list[Token]]) -> None:
    r"""Keep the letter at the end of `\cos q_2 = ... =: D`."""
    last = read_left_side(reader.vocabulary, members[-1])
    value = read_right_side(reader.vocabulary, members[-2]) if len(members) > 2 else None
    if isinstance(value, RightSide) and isinstance(last, NamedAnswers):
        reader.define_scalar(members[-1], last, value)


def _define(reader: EquationReader, side: LeftSide, own: str, value: RightSide, equation: Equation) -> None:
    """Keep what a letter means."""
    if isinstance(side, UnknownSide):
        is_new = side.is_name_alone and not side.family and side.key not in _NEVER_DEFINED
        if is_new:
            reader.define(side.key, value)
        return
    if isinstance(side, NamedAnswers):
        if own in OWN_LETTERS:
            reader.define(own, value)
        else:
            reader.define_scalar(equation.members[0], side, value)
        return
    reader.defines_in_passing(equation.members[0], value)


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
_NOT_LINE_END = re.compile(r"[^\n]")


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
        lines.append(_NOT_LINE_END.sub(" ", line) if found else line)
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
