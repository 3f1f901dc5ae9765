"""Equations whose left side names an answer that they do not give.

Constants that a report says (g = 9.81), letters for what drives the joints (τ = (u, 0)), and vectors that
are called as a force is (Craig's F_i = m v̇_c).
"""

from __future__ import annotations

from collections.abc import Sequence

from dynsolve.answers.reading.grids import Grid
from dynsolve.answers.reading.left_side import LeftSide, NamedAnswers, is_symbol
from dynsolve.answers.reading.motion_equations import says_what_drives
from dynsolve.answers.reading.right_side import RightSide
from dynsolve.answers.reading.shapes import fitted, is_gravity_vector
from dynsolve.answers.reading.tokens.lexer import Token
from dynsolve.answers.reading.vocabulary import Vocabulary
from dynsolve.errors import ReadError
from dynsolve.notation.tree import ZERO, Symbol
from dynsolve.notation.walk import walk
from dynsolve.quantities.spelling import key

Names = Sequence[tuple[str, ...]]
"""The answers that each name of a chain may be."""


def states_constant(
    vocabulary: Vocabulary, members: Sequence[list[Token]], names: Names, values: Sequence[RightSide]
) -> bool:
    """Whether `g = 9.81 m/s^2` says what a symbol of the problem is, no value fitting the answer."""
    first = members[0]
    if names == [("g",)] and _is_gravity(vocabulary, values):
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
    forces = _forces(vocabulary)
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
    balanced = {"det", "g", *vocabulary.quantities.parts("g"), *_forces(vocabulary)}
    return bool(before) and all(balanced.issuperset(candidates[:1]) for candidates in names)


def states_zero(
    vocabulary: Vocabulary, first: list[Token], names: Names, found: RightSide | ReadError
) -> bool:
    r"""Whether a sentence says of a symbol or a force that it is 0: $\phi = 0$, `\tau = 0`."""
    is_force = all(_forces(vocabulary).issuperset(candidates[:1]) for candidates in names)
    return _is_zero(found) and (
        is_force or is_symbol(vocabulary, first) or is_condition(vocabulary, names, found)
    )


def _forces(vocabulary: Vocabulary) -> set[str]:
    return {"tau", *(q.force for q in vocabulary.coordinates)}


def _is_zero(found: RightSide | ReadError) -> bool:
    """Whether a value is 0, or holds nothing else."""
    if not isinstance(found, RightSide):
        return False
    value = found.value
    return (
        {entry for row in value.rows for entry in row} == {ZERO} if isinstance(value, Grid) else value == ZERO
    )


def is_inertia_force(vocabulary: Vocabulary, names: Names, tokens: Sequence[Token]) -> bool:
    """Whether a vector is called as a force is, where the recursions are asked for."""
    shapes = {vocabulary.shape(name) for candidates in names for name in candidates}
    is_vector = tokens[0].kind in ("begin", "[")
    return is_vector and shapes == {None} and "fl1" in vocabulary.quantities


def _is_input(vocabulary: Vocabulary, values: Sequence[RightSide]) -> bool:
    """Whether B is the matrix of the inputs, B u: one of constants, or of another shape than D."""
    shape = vocabulary.shape("D")
    return any(
        isinstance(found.value, Grid)
        and (found.value.shape != shape or not any(isinstance(p, Symbol) for p in walk(found.value.node)))
        for found in values
    )


def _is_gravity(vocabulary: Vocabulary, values: Sequence[RightSide]) -> bool:
    """Whether a value is the vector of the acceleration of gravity, [0, 0, -g], and not its torques."""
    return any(is_gravity_vector(found.value, len(vocabulary.coordinates)) for found in values)
