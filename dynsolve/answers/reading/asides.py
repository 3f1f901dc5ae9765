"""What a formula in the midst of a sentence says: it defines letters, and answers what nothing else does."""

from __future__ import annotations

from dataclasses import replace

from dynsolve.answers.reading.answer_list import Member, Origin
from dynsolve.answers.reading.by_content import called_force, force_meant, meant
from dynsolve.answers.reading.displays import Display, Equation, equations
from dynsolve.answers.reading.equation_reader import EquationReader
from dynsolve.answers.reading.grammar.references import OWN_LETTERS
from dynsolve.answers.reading.grids import Abstract
from dynsolve.answers.reading.index_order import defined_order
from dynsolve.answers.reading.left_side import (
    LeftSide,
    NamedAnswers,
    UnknownSide,
    name_alone,
    read_left_side,
    read_left_sides,
    spoken_of,
)
from dynsolve.answers.reading.limits import MAX_MEMBERS
from dynsolve.answers.reading.motion_equations import motion_equation
from dynsolve.answers.reading.no_answers import is_condition, states_zero
from dynsolve.answers.reading.right_side import RightSide, is_value, read_right_side
from dynsolve.answers.reading.sentences import CONDITION, may_hold
from dynsolve.answers.reading.tokens.lexer import Token
from dynsolve.answers.reading.tokens.prepare import prepared
from dynsolve.errors import ReadError

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
