"""Determinants, joint rates and accelerations, compared with elimination on numbers.

The Jacobian is taken as it is printed, for `task.check` has held it to the motion of the
arm.  Rates x for a velocity b are right where Jᵀ (J x - b) = 0, so that no others come nearer
to b, and where W x is a sum of rows of J, so that none of those have a lesser xᵀ W x.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import islice
from typing import Any

from dynsolve.algebra.matrix import Matrix
from dynsolve.algebra.ring_values import evaluate
from dynsolve.derivation.arm_values import arms
from dynsolve.errors import VerificationError
from dynsolve.notation.tree import Node, Symbol
from dynsolve.notation.tree_values import compile_trees, plain_name
from dynsolve.questions.held import Held
from dynsolve.robot.model import Robot


def state_numbers(robot: Robot, values: Mapping[str, float]) -> dict[str, float]:
    """The values of the state that is asked for, in numbers."""
    state = robot.questions.state.by_symbol
    found = compile_trees(list(state.values())).run(values)
    names = [plain_name(Symbol(name, dots)) for name, dots in state]
    return {name: float(value) for name, value in zip(names, found, strict=True)}


TOLERANCE = 1e-7
"""The largest relative error: near a singular state rounding is divided by a small number."""

NEGLIGIBLE = 1e-9
"""A row that is shorter than this after the others were taken off depends on them."""

_SPACES = ("nullspace", "rangespace", "lost")

Vector = list[float]
Rows = Sequence[Sequence[float]]


def rate_names(robot: Robot, wanted: frozenset[str]) -> tuple[str, ...]:
    """Which of the wanted results are compared, with the Jacobians that they come from."""
    asked = [name for name in ("qd", "qdd", *_SPACES) if name in wanted]
    if not asked:
        return ()
    needed = {"Jr"} | ({"Jr_dot"} if "qdd" in asked else set())
    needed |= {"D"} if robot.questions.weighs_by_inertia else set()
    return tuple(dict.fromkeys((*(name for name in sorted(needed) if name in wanted), *asked)))


def verify_rates(robot: Robot, results: Mapping[str, Node], states: int = 5) -> None:
    """Compare printed forms of `qd`, `qdd` and of spaces with elimination on numbers (see `rate_names`).

    Raises VerificationError where one is off by more than `TOLERANCE` of its size.
    """
    program = compile_trees(list(results.values()))
    for values, _ in islice(arms(robot), states if results else 0):
        at_state = {**values, **state_numbers(robot, values)}
        there = dict(zip(results, program.run(at_state), strict=True))
        found = (*_rates(robot, at_state, there), *_spaces(there))
        for name, gap in found:
            if not gap <= TOLERANCE:
                raise VerificationError(f"{name} differs from elimination; this is a fault of dynsolve")


def _rates(robot: Robot, values: Mapping[str, float], ours: Mapping[str, Any]) -> Iterator[tuple[str, float]]:
    asked, rates = robot.questions, [values[q.velocity] for q in robot.coordinates]
    if "qd" in ours and asked.velocity is not None:
        wanted = _numbers(robot, asked.velocity, values)
        yield "qd", _gap(ours["Jr"], _flat(ours["qd"]), wanted, _weights(robot, values, ours))
    if "qdd" in ours and asked.acceleration is not None:
        wanted = _numbers(robot, asked.acceleration, values)
        wanted = [a - b for a, b in zip(wanted, _times(ours["Jr_dot"], rates), strict=True)]
        yield "qdd", _gap(ours["Jr"], _flat(ours["qdd"]), wanted, _weights(robot, values, ours))


def _weights(robot: Robot, values: Mapping[str, float], ours: Mapping[str, Any]) -> Rows | None:
    """W in numbers, None where all weights are 1."""
    if robot.questions.weighs_by_inertia:
        return [list(row) for row in ours["D"]]
    if robot.questions.weights is None:
        return None
    return [[evaluate(entry, values) for entry in row] for row in robot.questions.weights.rows]


def _spaces(ours: Mapping[str, Any]) -> Iterator[tuple[str, float]]:
    """How far the vectors of a space are from it, and whether they are as many as its dimension."""
    asked = [name for name in _SPACES if name in ours]
    if not asked:
        return
    J = ours["Jr"]
    rank = len(orthonormal(J))
    inside = {"nullspace": J, "lost": transposed(J)}
    dimension = {"nullspace": len(J[0]) - rank, "rangespace": rank, "lost": len(J) - rank}
    for name in asked:
        vectors = orthonormal(transposed(ours[name]))
        gap = 0.0 if len(vectors) == dimension[name] else float("inf")
        for vector in vectors if name in inside else ():
            gap = max((gap, *map(abs, _times(inside[name], vector))))
        for column in transposed(J) if name == "rangespace" else ():
            rest = list(column)
            for vector in vectors:
                along = sum(a * b for a, b in zip(vector, rest, strict=True))
                rest = [a - along * b for a, b in zip(rest, vector, strict=True)]
            gap = max((gap, *map(abs, rest)))
        yield name, gap


def _numbers(robot: Robot, column: Matrix, values: Mapping[str, float]) -> Vector:
    return [evaluate(entry, values) for entry in column.entries]


def _gap(J: Rows, x: Vector, wanted: Vector, weights: Rows | None) -> float:
    """How far x is from the shortest of the nearest to a solution, relative to its size."""
    left = [a - b for a, b in zip(_times(J, x), wanted, strict=True)]
    across = list(x) if weights is None else _times(weights, x)
    for row in orthonormal(J):
        along = sum(a * b for a, b in zip(row, across, strict=True))
        across = [a - along * b for a, b in zip(across, row, strict=True)]
    size = max((1.0, *map(abs, x), *map(abs, wanted))) * max((1.0, *(abs(e) for row in J for e in row))) ** 2
    return max(map(abs, (*_times(transposed(J), left), *across))) / size


def orthonormal(J: Rows) -> list[Vector]:
    """Orthogonal rows of length 1 that span those of J."""
    found: list[Vector] = []
    for row in J:
        rest = list(row)
        for other in (*found, *found):
            along = sum(a * b for a, b in zip(other, rest, strict=True))
            rest = [a - along * b for a, b in zip(rest, other, strict=True)]
        length = sum(a * a for a in rest) ** 0.5
        if length > NEGLIGIBLE:
            found.append([a / length for a in rest])
    return found


def products(a: Rows, b: Rows) -> list[Vector]:
    """A Bᵀ"""
    return [[sum(x * y for x, y in zip(row, other, strict=True)) for other in b] for row in a]


def transposed(rows: Rows) -> list[Vector]:
    """Columns as rows."""
    return [list(column) for column in zip(*rows, strict=True)]


def _times(rows: Rows, x: Vector) -> Vector:
    return [sum(a * b for a, b in zip(row, x, strict=True)) for row in rows]


def _flat(rows: Any) -> Vector:
    return [entry for row in rows for entry in row]


def verify(held: Held) -> None:
    """Hold the results as they are printed; raises VerificationError where one is wrong."""
    held.hold(verify_rates, rate_names(held.robot, held.wanted))
