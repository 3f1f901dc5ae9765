"""Equations whose left side names an answer that they do not give.

Constants that a report says (g = 9.81), letters for what drives the joints (τ = (u, 0)), and vectors that
are called as a force is (Craig's F_i = m v̇_c).
"""

from __future__ import annotations

from collections.abc import Sequence

from dynsolve.answers.reading.grids import Grid
from dynsolve.answers.reading.left_side import LeftSide, NamedAnswers
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
    forces = {"tau", *(q.force for q in vocabulary.coordinates)}
    named = [name for name in first.candidates if name in forces] if isinstance(first, NamedAnswers) else []
    return len(members) == 2 and bool(named) and says_what_drives(vocabulary, named, members[-1])


def is_condition(vocabulary: Vocabulary, names: Names, found: RightSide | ReadError) -> bool:
    """Whether det J = 0 says which configurations are singular, where these are asked for."""
    is_asked = names == [("det",)] and "singular" in vocabulary.quantities
    return is_asked and isinstance(found, RightSide) and found.value == ZERO


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
