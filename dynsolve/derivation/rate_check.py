"""Determinants, joint rates and accelerations, compared with elimination on numbers.

The Jacobian is taken as it is printed, for `kinematic_check` has held it to the motion of the
arm.  Rates x for a velocity b are right where Jᵀ (J x - b) = 0, so that no others come nearer
to b, and where W x is a sum of rows of J, so that none of those have a lesser xᵀ W x.

Generalized forces and holding torques, compared with the power of the forces in numbers.

A generalized force is the power of the forces while one coordinate alone moves at unit rate; how
points move then, and what gravity takes at rest, comes from recursive Newton-Euler.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import islice
from typing import Any

from dynsolve.algebra.matrix import Matrix
from dynsolve.algebra.ring_values import evaluate
from dynsolve.derivation.arm_values import RobotValues, arm_at, arms
from dynsolve.derivation.elimination import determinant
from dynsolve.derivation.newton_euler import (
    ZERO,
    Arm,
    applied,
    cross,
    dot,
    inverse_dynamics,
    outwards,
    plus,
)
from dynsolve.derivation.newton_euler import (
    Vector as newton_euler_Vector,
)
from dynsolve.derivation.rates import whole_or_task
from dynsolve.derivation.verification import TOLERANCE as VERIFICATION_TOLERANCE
from dynsolve.derivation.verification import acting_forces
from dynsolve.errors import VerificationError
from dynsolve.notation.tree import Node, Symbol
from dynsolve.notation.tree_values import compile_trees, plain_name
from dynsolve.robot.model import Robot
from dynsolve.robot.questions import Load

# Generalized forces and holding torques, compared with the power of the forces in numbers


def verify_statics(robot: Robot, results: Mapping[str, Node], states: int = 5) -> None:
    """Compare printed forms of `Q` and `tau_static` with the power of the forces, at the state asked for.

    Raises VerificationError where one is off by more than rounding.
    """
    program = compile_trees(list(results.values()))
    for values, _ in islice(arms(robot), states if results else 0):
        values = {**values, **state_numbers(robot, values)}
        arm = arm_at(robot, values)
        still = [0.0] * arm.n
        Q = generalized_forces(robot, values, arm)
        weight = inverse_dynamics(arm, still, still, arm.gravity)
        held = [a + b for a, b in zip(weight, acting_forces(robot, values).springs, strict=True)]
        theirs = {"Q": Q, "tau_static": [a - b for a, b in zip(held, Q, strict=True)]}
        size = max((1.0, *map(abs, Q), *map(abs, held)))
        for name, mine in zip(results, program.run(values), strict=True):
            if not _static_check_gap(mine, theirs[name]) <= VERIFICATION_TOLERANCE * size:
                raise VerificationError(
                    f"{name} differs from the power of the forces; this is a fault of dynsolve"
                )


def state_numbers(robot: Robot, values: Mapping[str, float]) -> dict[str, float]:
    """The values of the state that is asked for, in numbers."""
    state = robot.questions.state.by_symbol
    found = compile_trees(list(state.values())).run(values)
    names = [plain_name(Symbol(name, dots)) for name, dots in state]
    return {name: float(value) for name, value in zip(names, found, strict=True)}


def generalized_forces(robot: Robot, values: Mapping[str, float], arm: Arm) -> list[float]:
    """The power of all forces while one coordinate alone moves at unit rate, coordinate by coordinate."""
    numbers = RobotValues(robot, values)
    units = [[float(i == k) for i in range(arm.n)] for k in range(arm.n)]
    return [sum(_power(numbers, arm, load, unit) for load in robot.questions.loads) for unit in units]


def _power(numbers: RobotValues, arm: Arm, load: Load, rates: Sequence[float]) -> float:
    """F·v + M·ω, along the axes of the world."""
    frames, _ = outwards(arm, rates, [0.0] * arm.n, ZERO)
    frame = frames[load.link]
    force, moment = numbers.vector(load.force), numbers.vector(load.moment)
    if load.axes is not None:
        axes = numbers.rotation(load.axes)
        force, moment = (applied(frame.R, applied(axes, vector)) for vector in (force, moment))
    velocity: newton_euler_Vector = plus(
        frame.v, cross(frame.w, applied(frame.R, numbers.vector(load.position)))
    )
    power = dot(force, velocity) + dot(moment, frame.w)
    return -power if load.by_robot else power


def _static_check_gap(mine: Any, theirs: Sequence[float]) -> float:
    gaps = [abs(a - b) for (a,), b in zip(mine, theirs, strict=True)]
    return max((gap if gap == gap else float("inf") for gap in gaps), default=0.0)


TOLERANCE = 1e-7
"""The largest relative error: near a singular state rounding is divided by a small number."""

NEGLIGIBLE = 1e-9
"""A row that is shorter than this after the others were taken off depends on them."""

_SPACES = ("nullspace", "rangespace", "lost")

Vector = list[float]
Rows = Sequence[Sequence[float]]


def rate_names(robot: Robot, wanted: frozenset[str]) -> tuple[str, ...]:
    """Which of the wanted results are compared, with the Jacobians that they come from."""
    asked = [name for name in ("det", "qd", "qdd", *_SPACES) if name in wanted]
    if not asked:
        return ()
    needed = {whole_or_task(robot), "Jr"} | ({"Jr_dot"} if "qdd" in asked else set())
    needed |= {"D"} if robot.questions.weighs_by_inertia else set()
    return tuple(dict.fromkeys((*(name for name in sorted(needed) if name in wanted), *asked)))


def verify_rates(robot: Robot, results: Mapping[str, Node], states: int = 5) -> None:
    """Compare printed forms of `det`, `qd` and `qdd` with elimination on numbers (see `rate_names`).

    Raises VerificationError where one is off by more than `TOLERANCE` of its size.
    """
    program = compile_trees(list(results.values()))
    for values, _ in islice(arms(robot), states if results else 0):
        here = dict(zip(results, program.run(values), strict=True))
        at_state = {**values, **state_numbers(robot, values)}
        there = dict(zip(results, program.run(at_state), strict=True))
        found = (*_determinant(robot, here), *_rates(robot, at_state, there), *_spaces(there))
        for name, gap in found:
            if not gap <= TOLERANCE:
                raise VerificationError(f"{name} differs from elimination; this is a fault of dynsolve")


def _determinant(robot: Robot, ours: Mapping[str, Any]) -> Iterator[tuple[str, float]]:
    if "det" in ours:
        J = ours[whole_or_task(robot)]
        rows = [list(row) for row in J]
        if len(rows) > len(rows[0]):
            rows = _products(_transposed(rows), _transposed(rows))
        elif len(rows) < len(rows[0]):
            rows = _products(rows, rows)
        theirs = determinant(rows)
        yield "det", abs(ours["det"] - theirs) / max(1.0, abs(theirs))


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
    inside = {"nullspace": J, "lost": _transposed(J)}
    dimension = {"nullspace": len(J[0]) - rank, "rangespace": rank, "lost": len(J) - rank}
    for name in asked:
        vectors = orthonormal(_transposed(ours[name]))
        gap = 0.0 if len(vectors) == dimension[name] else float("inf")
        for vector in vectors if name in inside else ():
            gap = max((gap, *map(abs, _times(inside[name], vector))))
        for column in _transposed(J) if name == "rangespace" else ():
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
    return max(map(abs, (*_times(_transposed(J), left), *across))) / size


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


def _products(a: Rows, b: Rows) -> list[Vector]:
    """A Bᵀ"""
    return [[sum(x * y for x, y in zip(row, other, strict=True)) for other in b] for row in a]


def _transposed(rows: Rows) -> list[Vector]:
    return [list(column) for column in zip(*rows, strict=True)]


def _times(rows: Rows, x: Vector) -> Vector:
    return [sum(a * b for a, b in zip(row, x, strict=True)) for row in rows]


def _flat(rows: Any) -> Vector:
    return [entry for row in rows for entry in row]
