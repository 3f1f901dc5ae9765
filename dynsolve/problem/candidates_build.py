"""Matrices that are to be judged, and what is assumed of their parameters, with exact values."""

from __future__ import annotations

from dynsolve.algebra.inequality import Bound
from dynsolve.algebra.matrix import Matrix
from dynsolve.problem.candidates import EVERY, ParsedCandidates, ParsedInequality
from dynsolve.problem.values import CellValues
from dynsolve.robot.candidates import Candidate


def candidates(values: CellValues, parsed: ParsedCandidates, given: Matrix | None) -> tuple[Candidate, ...]:
    """The matrices to be judged, or the D that a model is given by; what is wrong is reported."""
    every = _bounds(values, parsed.assumed.get(EVERY, ()))
    if not parsed.matrices:
        return (Candidate("D", given, every, parsed.is_relative),) if given is not None else ()
    made = []
    for name, cells in parsed.matrices.items():
        rows = [[values.expr(cell) for cell in row] for row in cells]
        known = [[entry for entry in row if entry is not None] for row in rows]
        if all(len(row) == len(cells) for row in known):
            own = _bounds(values, parsed.assumed.get(name, ()))
            made.append(Candidate(name, Matrix.of(values.ring, known), (*every, *own), parsed.is_relative))
    return tuple(made)


def assumed(values: CellValues, parsed: ParsedCandidates) -> tuple[Bound, ...]:
    """What is assumed of the parameters, whatever matrix they stand in."""
    return _bounds(values, parsed.assumed.get(EVERY, ()))


def _bounds(values: CellValues, parsed: tuple[ParsedInequality, ...]) -> tuple[Bound, ...]:
    found = []
    for one in parsed:
        left, right = values.expr(one.left), values.expr(one.right)
        if left is not None and right is not None:
            found.append(Bound(left - right, one.is_strict))
    return tuple(found)
