r"""Equations of motion as mechanics courses write them: `(m + M) ẍ + m l θ̈ = F - b ẋ`, `... = 0`.

No side of such an equation is the name of an answer alone.  The generalized force is the term
that is a name of one, and everything else brought to the other side is the answer; where no term
is one, the equation is that of a coordinate that no motor drives.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from dynsolve.answers.reading.by_content import force_meant
from dynsolve.answers.reading.displays import OPENS
from dynsolve.answers.reading.left_side import NamedAnswers, UnknownSide, name_alone, read_left_side
from dynsolve.answers.reading.right_side import RightSide, read_right_side
from dynsolve.answers.reading.tokens.lexer import Token
from dynsolve.answers.reading.vocabulary import DRIVING, Vocabulary
from dynsolve.notation.build import negated, total
from dynsolve.notation.tree import ZERO, Node, Symbol
from dynsolve.notation.walk import walk
from dynsolve.quantities.model_families import QDD_FORWARD

_LONGEST_NAME = 12
_BETWEEN = frozenset({"begin", "close", "\\\\", "&", ",", ";", "[", "]", "(", ")"})
_SIGNS = ("+", "-")
_OPERATORS = frozenset({"+", "-", "*", "/", "cdot", "times", "^"})


@dataclass(frozen=True, slots=True)
class MotionEquation:
    """The generalized forces that one equation may give, and the value that it gives to one of them.

    `is_zero` says that no force stands in it: `... = 0`.
    """

    forces: tuple[str, ...]
    found: RightSide
    is_zero: bool


@dataclass(frozen=True, slots=True)
class _Term:
    """A term of one side with its sign; `forces` are those that it names, none of any other term."""

    tokens: list[Token]
    is_negative: bool
    forces: tuple[str, ...] = ()


def motion_equation(vocabulary: Vocabulary, members: Sequence[list[Token]]) -> MotionEquation | None:
    """The equation of motion that a chain a = b is; None of every other chain."""
    if len(members) != 2 or name_alone(vocabulary, members[0]) in vocabulary.defined:
        return None
    sides = [_terms(vocabulary, member) for member in members]
    named = [(side, term) for side, terms in enumerate(sides) for term in terms if term.forces]
    if len(named) > 1:
        return None
    if not named and (called := _called(vocabulary, members)):
        return called
    rests = [_rest(vocabulary, terms) for terms in sides]
    values = [rest.value for rest in rests if rest is not None and isinstance(rest.value, Node)]
    if len(values) < 2:
        return None
    is_turned = values[0] == ZERO if not named else named[0][1].is_negative == (named[0][0] == 1)
    first, second = reversed(values) if is_turned else values
    value = total([first, negated(second)])
    forces = named[0][1].forces if named else _undriven(vocabulary)
    if not _is_of_motion(vocabulary, value):
        return None
    read = [rest for rest in rests if rest is not None]
    notes = tuple(dict.fromkeys(note for rest in read for note in rest.notes))
    free = tuple(name for rest in read for name in rest.free)
    found = RightSide(value, (), notes, free, is_definition=False)
    return MotionEquation(forces, found, is_zero=not named)


def _called(vocabulary: Vocabulary, members: Sequence[list[Token]]) -> MotionEquation | None:
    """The force that a name alone is said to be: one of the student's own behind it, or S_2, else a sine."""
    for place, others in ((1, NamedAnswers), (0, NamedAnswers | UnknownSide)):
        name = name_alone(vocabulary, members[place])
        if name and name not in vocabulary.others:
            value = read_right_side(vocabulary, members[1 - place])
            forces = force_meant(vocabulary, name, value.value) if isinstance(value, RightSide) else ()
            if (
                isinstance(value, RightSide)
                and forces
                and (
                    not isinstance(read_left_side(vocabulary, members[place]), others)
                    or vocabulary.similar(name) is not None  # L_2 beside l_2
                )
            ):
                return MotionEquation(forces, value, is_zero=False)
    return None


def acceleration_of(vocabulary: Vocabulary, members: Sequence[list[Token]]) -> int:
    r"""The coordinate, from 1, that `\ddot q_1 = ...` is solved for, where that is asked for; else 0."""
    if QDD_FORWARD.name not in vocabulary.quantities or len(members[0]) > _LONGEST_NAME:
        return 0
    first = read_right_side(vocabulary, members[0])
    value = first.value if isinstance(first, RightSide) else None
    is_one = isinstance(value, Symbol) and value.dots == 2
    q = vocabulary.coordinate(value) if is_one and isinstance(value, Symbol) else None
    return q.index if q is not None else 0


def says_what_drives(vocabulary: Vocabulary, names: Sequence[str], member: list[Token]) -> bool:
    """Whether a side of forces only calls them by letters, and passive ones 0: `F - b ẋ`, `(u, 0)` of all."""
    if any(term.forces for term in _terms(vocabulary, member)):
        return True
    if [token.text for token in member[-2:]] in (["^", "T"], ["^", "top"]):
        member = member[:-2]
    entries: list[list[Token]] = [[]]
    for token in member:
        if token.kind in _BETWEEN:
            entries.append([])
        else:
            entries[-1].append(token)
    given = [entry for entry in entries if entry]
    zeros = [entry for entry in given if [token.text for token in entry] == ["0"]]
    passive = [name for name in vocabulary.passive if name in names or "tau" in names]
    return 0 < len(given) >= len(zeros) <= len(passive) and all(
        len(entry) <= _LONGEST_NAME and _forces(vocabulary, entry) for entry in given if entry not in zeros
    )


def _terms(vocabulary: Vocabulary, member: list[Token]) -> list[_Term]:
    """The terms of a side, each with its sign and the forces that it names."""
    return [_Term(tokens, negative, _forces(vocabulary, tokens)) for tokens, negative in signed_terms(member)]


def signed_terms(member: Sequence[Token]) -> list[tuple[list[Token], bool]]:
    """The terms of a side, each with whether a minus stands before it."""
    found: list[tuple[list[Token], bool]] = []
    level, piece, negative = 0, list[Token](), False
    for token in member:
        starts = level == 0 and token.kind in _SIGNS and not (piece and piece[-1].kind in _OPERATORS)
        if starts:
            if piece:
                found.append((piece, negative))
            piece, negative = [], token.kind == "-"
        else:
            piece.append(token)
        level += OPENS.get(token.kind, 0)
    return [*found, (piece, negative)]


def _rest(vocabulary: Vocabulary, terms: Sequence[_Term]) -> RightSide | None:
    """A side without the generalized force in it; None where it has no value."""
    tokens: list[Token] = []
    for term in terms:
        if term.forces or not term.tokens:
            continue
        first = term.tokens[0]
        if term.is_negative:
            tokens.append(first._replace(kind="-", text="-", end=first.start, dots=0))
        elif tokens:
            tokens.append(first._replace(kind="+", text="+", end=first.start, dots=0))
        tokens += term.tokens
    if not tokens:
        return RightSide(ZERO, (), (), (), is_definition=False)
    found = read_right_side(vocabulary, tokens)
    return found if isinstance(found, RightSide) and vocabulary.are_multipliers(found.references) else None


def _forces(vocabulary: Vocabulary, tokens: list[Token]) -> tuple[str, ...]:
    """The generalized forces that a term may be a name of: one with its index, else those that are driven."""
    if not tokens or len(tokens) > _LONGEST_NAME:
        return ()
    name = name_alone(vocabulary, tokens)
    if name in vocabulary.symbols or name in vocabulary.defined:
        return ()
    known = [q.force for q in vocabulary.coordinates]
    indexed: tuple[str, ...] = ()
    side = read_left_side(vocabulary, tokens)
    if isinstance(side, NamedAnswers):
        forces = tuple(force for force in side.candidates if force in known)
        if forces or not {"tau", "friction"} & set(side.candidates):
            return forces
    else:  # `M_2` is no mass where the problem has only an m_2
        is_unknown = side.is_name_alone if isinstance(side, UnknownSide) else name[-1:].isdigit()
        indexed = vocabulary.named(f"tau{name[1:]}") if name[1:] and DRIVING.match(name) else ()
        is_force = DRIVING.fullmatch(name) or indexed
        if not is_unknown or not is_force or name in vocabulary.others:
            return ()
    return indexed or tuple(force for force in known if force not in vocabulary.passive)


def _undriven(vocabulary: Vocabulary) -> tuple[str, ...]:
    """The forces that an equation without one may be about: those that are 0, else all."""
    return vocabulary.passive or tuple(q.force for q in vocabulary.coordinates)


def _is_of_motion(vocabulary: Vocabulary, value: Node) -> bool:
    """Whether a value holds an acceleration, and a parameter beside it."""
    symbols = [part for part in walk(value) if isinstance(part, Symbol)]
    names = {q.name for q in vocabulary.coordinates}
    return any(symbol.dots == 2 for symbol in symbols) and any(s.name not in names for s in symbols)
