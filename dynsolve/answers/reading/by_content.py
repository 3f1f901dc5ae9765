"""Names that mean an answer only where their value says so: k_1, u_1, H_11, T_1, Γ_1.

Craig calls the energies of a body k_i and u_i, others the torques u_i; Asada and Slotine call the
inertia matrix H; torques are called by any letter.  All of these are abbreviations as well, or other
answers: what stands on the other side decides.

Equations of motion as mechanics courses write them: `(m + M) ẍ + m l θ̈ = F - b ẋ`, `... = 0`.

No side of such an equation is the name of an answer alone.  The generalized force is the term
that is a name of one, and everything else brought to the other side is the answer; where no term
is one, the equation is that of a coordinate that no motor drives.

Constants that a report says (g = 9.81), letters for what drives the joints (τ = (u, 0)), and vectors that
are called as a force is (Craig's F_i = m v̇_c).
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from itertools import groupby

from msgspec import Struct

from dynsolve.answers.reading.displays import OPENS
from dynsolve.answers.reading.grids import Abstract, Grid, Value, symbols_in
from dynsolve.answers.reading.left_side import (
    LeftSide,
    NamedAnswers,
    RightSide,
    UnknownSide,
    is_symbol,
    name_alone,
    read_left_side,
    read_right_side,
)
from dynsolve.answers.reading.lexer import Token
from dynsolve.answers.reading.matrix_parts import fitted, is_gravity_vector
from dynsolve.answers.reading.vocabulary import DRIVING, Vocabulary
from dynsolve.errors import ReadError
from dynsolve.notation.build import negated, total
from dynsolve.notation.characters import split
from dynsolve.notation.tree import ZERO, Node, Symbol
from dynsolve.quantities.letters import key
from dynsolve.quantities.stages import Stage
from dynsolve.robot.model import Coordinate

_NAME = re.compile(r"(k|u)([0-9a-z]?)|(H)((?:[1-9][1-9])?)")
_FRICTION = re.compile(r"(?:tau|[TMFQ])(?:f|fr|fric|friction|r|R|Reib|reib|fv|d|D|diss)")
"""What the vector of friction is called beside the torques."""


def meant(vocabulary: Vocabulary, name: str, value: Value) -> tuple[str, ...]:
    """The answers that a name of the student's own may be, by what its value is made of; none for others."""
    if _FRICTION.fullmatch(name) and vocabulary.is_answer("friction"):
        return ("friction",) if isinstance(value, Grid) and _is_friction(vocabulary, value) else ()
    found = _NAME.fullmatch(name)
    if found is None or isinstance(value, Abstract):
        return ()
    letter, index = found[1] or found[3], found[2] or found[4] or ""
    symbols = symbols_in(value)
    rates = {symbol.dots for symbol in symbols}
    has_mass = any(symbol.name in vocabulary.masses for symbol in symbols)
    if letter == "H":
        wanted = f"D{index}" if has_mass and rates <= {0} else ""
    elif 2 in rates:
        return ()
    elif letter == "k":
        wanted = f"K{index}" if 1 in rates and has_mass else ""
    else:
        is_weight = any(split(symbol.name)[0] == "g" for symbol in symbols)
        wanted = f"P{index}" if is_weight and rates <= {0} else ""
    names = vocabulary.named(wanted) if wanted else ()
    scalar = not isinstance(value, Grid)
    return tuple(n for n in names if (vocabulary.shape(n) is None) == scalar)


def _is_friction(vocabulary: Vocabulary, value: Value) -> bool:
    """Whether a value holds rates, beside no mass and no acceleration."""
    symbols = [] if isinstance(value, Abstract) else symbols_in(value)
    has_mass = any(symbol.name in vocabulary.masses for symbol in symbols)
    return not has_mass and {symbol.dots for symbol in symbols} in ({1}, {0, 1})


def force_meant(vocabulary: Vocabulary, name: str, value: Value) -> tuple[str, ...]:
    """The generalized force of the index of a name, where its value holds accelerations beside a mass.

    Without an index it is one of those that are driven.
    """
    if isinstance(value, Abstract) or not name or name.rstrip("'") in vocabulary.symbols:
        return ()
    symbols = symbols_in(value)
    has_mass = any(symbol.name in vocabulary.masses for symbol in symbols)
    if not has_mass or all(symbol.dots < 2 for symbol in symbols):
        return ()
    if isinstance(value, Grid):
        return ("tau",) if value.shape == vocabulary.shape("tau") and len(name) == 1 else ()
    forces = [q.force for q in vocabulary.coordinates]
    index = "".join(split(name)[1]) or name[1:]
    counted = "".join(character for character in index if character.isdigit())
    named = vocabulary.named(f"tau{index}") or vocabulary.named(f"tau{counted}")
    driven = [force for force in forces if force not in vocabulary.passive]
    is_open = not split(name)[1] and (len(driven) == 1 or not index)
    return tuple(force for force in named if force in forces) or (tuple(driven) if is_open else ())


def called_force(
    vocabulary: Vocabulary, name: str, candidates: tuple[str, ...], values: Sequence[Value]
) -> tuple[str, ...]:
    """The force that T_1 or G_1 is, else an energy or an entry of g; none where that has the very name."""
    scalars = [vocabulary.quantities[c] for c in candidates if vocabulary.shape(c) is None]
    may_differ = all(
        one.family.stage is Stage.ENERGY or vocabulary.quantities.entry_of(one.name)[0] == "g"
        for one in scalars
    )
    if name in candidates or not values or not may_differ:
        return ()
    return force_meant(vocabulary, name, values[-1])


def called_friction(
    vocabulary: Vocabulary, name: str, candidates: tuple[str, ...], values: Sequence[Value]
) -> tuple[str, ...]:
    """The entry of the friction that F_1 is, where it holds rates beside no mass; none of a τ_1."""
    if name.startswith("tau") or not values or not _is_friction(vocabulary, values[-1]):
        return ()
    entries = (f"friction{q.index}" for q in vocabulary.coordinates if q.force in candidates)
    return tuple(entry for entry in entries if vocabulary.is_answer(entry))


# Equations of motion as mechanics courses write them

_LONGEST_NAME = 12
_BETWEEN = frozenset({"begin", "close", "\\\\", "&", ",", ";", "[", "]", "(", ")"})
_SIGNS = ("+", "-")
_OPERATORS = frozenset({"+", "-", "*", "/", "cdot", "times", "^"})


class MotionEquation(Struct, frozen=True):
    """The generalized forces that one equation may give, and the value that it gives to one of them.

    `is_zero` says that no force stands in it: `... = 0`.
    """

    forces: tuple[str, ...]
    found: RightSide
    is_zero: bool


class _Term(Struct, frozen=True):
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
    if any(
        len(member) > 1 and block(member) == member for member in members
    ):  # a matrix is no equation of one
        return None
    rests = [_rest(vocabulary, terms) for terms in sides]
    values = [rest.value for rest in rests if rest is not None and isinstance(rest.value, Node)]
    if len(values) < 2:
        return None
    is_turned = values[0] == ZERO if not named else named[0][1].is_negative == (named[0][0] == 1)
    first, second = reversed(values) if is_turned else values
    value = total([first, negated(second)])
    without = vocabulary.passive or tuple(
        q.force for q in vocabulary.coordinates
    )  # those that are 0, else all
    forces = named[0][1].forces if named else without
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
            if not isinstance(value, RightSide) or not forces:
                continue
            is_other = isinstance(read_left_side(vocabulary, members[place]), others)
            if not is_other or vocabulary.similar(name) is not None:  # L_2 beside l_2
                return MotionEquation(forces, value, is_zero=False)
    return None


def acceleration_of(vocabulary: Vocabulary, members: Sequence[list[Token]]) -> Coordinate | None:
    r"""The coordinate that `\ddot q_1 = ...` is solved for; beside others it is an equation of motion."""
    if len(members[0]) > _LONGEST_NAME:
        return None
    first, last = (read_right_side(vocabulary, member) for member in (members[0], members[-1]))
    value = first.value if isinstance(first, RightSide) else None
    q = vocabulary.coordinate(value) if isinstance(value, Symbol) and value.dots == 2 else None
    others = symbols_in(last.value) if isinstance(last, RightSide) else []
    is_equation = q is not None and q.force in vocabulary.passive and any(one.dots > 1 for one in others)
    return None if is_equation else q


def says_what_drives(vocabulary: Vocabulary, names: Sequence[str], member: list[Token]) -> bool:
    """Whether a side of forces only calls them by letters, and passive ones 0: `F - b ẋ`, `(u, 0)` of all.

    Letters that the report defines below are none of these when it is read anew.
    """
    if called := [term.tokens for term in _terms(vocabulary, member) if term.forces]:
        vocabulary.missed.update(name_alone(vocabulary, tokens) for tokens in called)
        return True
    if [token.text for token in member[-2:]] in (["^", "T"], ["^", "top"]):
        member = member[:-2]
    cut = groupby(member, lambda token: token.kind in _BETWEEN)
    given = [list(entry) for is_between, entry in cut if not is_between]
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


def block(tokens: Sequence[Token]) -> list[Token]:
    """The matrix that tokens begin with; empty where they begin with none."""
    if not tokens or tokens[0].kind != "begin":
        return []
    level = 0
    for position, token in enumerate(tokens, 1):
        level += OPENS.get(token.kind, 0)
        if level == 0:
            return list(tokens[:position])
    return []


def _rest(vocabulary: Vocabulary, terms: Sequence[_Term]) -> RightSide | None:
    """A side without the generalized force in it; None where it has no value."""
    tokens: list[Token] = []
    for term in terms:
        if term.forces or not term.tokens:
            continue
        first, sign = term.tokens[0], "-" if term.is_negative else "+"
        if term.is_negative or tokens:
            tokens.append(first._replace(kind=sign, text=sign, end=first.start, dots=0))
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
        if forces or not name or not {"tau", "friction"} & set(side.candidates):
            return forces
    else:  # `M_2` is no mass where the problem has only an m_2
        is_unknown = side.is_name_alone if isinstance(side, UnknownSide) else name[-1:].isdigit()
        indexed = vocabulary.named(f"tau{name[1:]}") if name[1:] and DRIVING.match(name) else ()
        is_force = DRIVING.fullmatch(name) or indexed
        if not is_unknown or not is_force or name in vocabulary.others:
            return ()
    return indexed or tuple(force for force in known if force not in vocabulary.passive)


def _is_of_motion(vocabulary: Vocabulary, value: Node) -> bool:
    """Whether a value holds an acceleration, and a parameter beside it."""
    symbols = symbols_in(value)
    names = {q.name for q in vocabulary.coordinates}
    return any(symbol.dots == 2 for symbol in symbols) and any(s.name not in names for s in symbols)


# Equations whose left side names an answer that they do not give

Names = Sequence[tuple[str, ...]]
"""The answers that each name of a chain may be."""


def states_constant(
    vocabulary: Vocabulary, members: Sequence[list[Token]], names: Names, values: Sequence[RightSide]
) -> bool:
    """Whether `g = 9.81 m/s^2` says what a symbol of the problem is, no value fitting the answer."""
    first = members[0]
    n = len(vocabulary.coordinates)
    if names == [("g",)] and any(is_gravity_vector(found.value, n) for found in values):
        return True
    if names == [("D",)] and [token.text for token in first] == ["B"] and _is_input(vocabulary, values):
        return True
    if len(names) > 1 or len(first) > 1 or key(first[0].text) not in vocabulary.symbols:
        return False
    if any(token.kind in ("begin", "[") for member in members for token in member):
        return False
    return not any(fitted(vocabulary, names[0], found.value) for found in values)


def calls_forces(vocabulary: Vocabulary, members: Sequence[list[Token]], first: LeftSide) -> bool:
    """Whether a chain only says what forces are called: τ = (u, 0), d/dt ∂L/∂ẋ - ∂L/∂x = F."""
    forces = _no_answers_forces(vocabulary)
    named = [name for name in first.candidates if name in forces] if isinstance(first, NamedAnswers) else []
    return len(members) == 2 and bool(named) and says_what_drives(vocabulary, named, members[-1])


def is_condition(
    vocabulary: Vocabulary, names: Names, found: RightSide | ReadError, before: Sequence[RightSide] = ()
) -> bool:
    """Whether `= 0` says where the arm is singular or at rest, as at the end of det J = l_1 l_2 s_2 = 0.

    `before` are the values before it in its chain.
    """
    if not names or not _is_zero(found):
        return False
    if names == [("det",)] and "singular" in vocabulary.quantities:
        return True
    balanced = {"det", "g", *vocabulary.quantities.parts("g"), *_no_answers_forces(vocabulary)}
    return bool(before) and all(balanced.issuperset(candidates[:1]) for candidates in names)


def states_zero(
    vocabulary: Vocabulary, first: list[Token], names: Names, found: RightSide | ReadError
) -> bool:
    r"""Whether a sentence says of a symbol or a force that it is 0: $\phi = 0$, `\tau = 0`."""
    is_force = all(_no_answers_forces(vocabulary).issuperset(candidates[:1]) for candidates in names)
    return _is_zero(found) and (
        is_force or is_symbol(vocabulary, first) or is_condition(vocabulary, names, found)
    )


def _no_answers_forces(vocabulary: Vocabulary) -> set[str]:
    return {"tau", *(q.force for q in vocabulary.coordinates)}


def _is_zero(found: RightSide | ReadError) -> bool:
    """Whether a value is 0, or holds nothing else."""
    if not isinstance(found, RightSide):
        return False
    value = found.value
    return set(value.entries) == {ZERO} if isinstance(value, Grid) else value == ZERO


def is_inertia_force(vocabulary: Vocabulary, names: Names, tokens: Sequence[Token]) -> bool:
    """Whether a vector is called as a force is, where the recursions are asked for."""
    shapes = {vocabulary.shape(name) for candidates in names for name in candidates}
    is_vector = tokens[0].kind in ("begin", "[")
    return is_vector and shapes == {None} and "fl1" in vocabulary.quantities


def _is_input(vocabulary: Vocabulary, values: Sequence[RightSide]) -> bool:
    """Whether B is the matrix of the inputs, B u: one of constants, or of another shape than D."""
    matrices = [found.value for found in values if isinstance(found.value, Grid)]
    return any(matrix.shape != vocabulary.shape("D") or not symbols_in(matrix) for matrix in matrices)
