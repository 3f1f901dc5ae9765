"""The values of an answer file, each of which stands under the name of its answer."""

from __future__ import annotations

from dynsolve.answers.reading.answer_list import Member, Origin
from dynsolve.answers.reading.displays import Display, chain
from dynsolve.answers.reading.equation_reader import EquationReader
from dynsolve.answers.reading.grids import Abstract
from dynsolve.answers.reading.left_side import LeftSide, NamedAnswers, UnknownSide, read_left_side
from dynsolve.answers.reading.limits import MAX_MEMBERS
from dynsolve.answers.reading.right_side import RightSide, read_right_side
from dynsolve.answers.reading.shapes import shown
from dynsolve.answers.reading.tokens.lexer import Token
from dynsolve.answers.reading.tokens.prepare import prepared
from dynsolve.answers.submission import Answer, NotRecognized, Place
from dynsolve.errors import ReadError


def read_value(reader: EquationReader, name: str, place: Place, display: Display) -> None:
    """Read the value that an answer file gives under a name."""
    origin = reader.origin(display, display.label)
    side = _key(reader, name)
    names = side.family if isinstance(side, UnknownSide) else ()
    refused = NotRecognized(shown(f"{name}: {display.text}"), "", place, "it names nothing known", names)
    if isinstance(side, NamedAnswers):
        reader.found.answers += _given(reader, side.candidates, origin)
    elif isinstance(side, UnknownSide) and side.family:
        made = _given(reader, side.family[:1], origin)
        reader.found.put_off(side.family, made, refused)
    else:
        reader.found.not_recognized.append(refused)


def announce(reader: EquationReader, name: str) -> None:
    """Keep that a file gives the entry of a matrix under this name, wherever it stands."""
    side = _key(reader, name)
    if isinstance(side, NamedAnswers):
        reader.vocabulary.gives(side.candidates[0])


def _key(reader: EquationReader, name: str) -> LeftSide:
    """What a key of an answer file names."""
    if name.startswith("I") and reader.vocabulary.is_answer(name):
        return NamedAnswers((name,))
    try:
        return read_left_side(reader.vocabulary, prepared(name)[:-1])
    except ReadError:
        return None


def _given(reader: EquationReader, candidates: tuple[str, ...], origin: Origin) -> list[Answer]:
    """The answers that the members of a value are."""
    found = reader.found
    try:
        members = chain(prepared(origin.display.text, reader.macros))
        if len(members) > MAX_MEMBERS:
            message = f"more than {MAX_MEMBERS} members of one chain"
            raise ReadError(message, 0, 1, "write the value alone")
    except ReadError as error:
        return [found.unreadable(candidates, error, origin, 0)]
    side = read_left_side(reader.vocabulary, members[0]) if len(members) > 1 else None
    if isinstance(side, NamedAnswers) and set(side.candidates) & set(candidates):
        members = members[1:]
    made: list[Answer] = []
    for index, tokens in enumerate(members):
        member = Member(index, tokens, _value(reader, candidates, tokens))
        if isinstance(member.found, ReadError):
            made += found.unread(candidates, member, origin)
        else:
            made += found.value([candidates], member, origin)
    return made


def _value(reader: EquationReader, candidates: tuple[str, ...], tokens: list[Token]) -> RightSide | ReadError:
    """The value of a member, which is no value where it consists of letters of the derivation."""
    if not tokens:
        return ReadError("nothing stands on one side of this `=`", 0, 1, "write the value alone")
    found = read_right_side(reader.vocabulary, tokens, candidates)
    if isinstance(found, RightSide) and isinstance(found.value, Abstract):
        help = "write it in the symbols of the problem"
        return ReadError(found.value.why, tokens[0].start, 1, help)
    return found
