"""Generalized forces and holding torques, compared with the power of the forces in numbers.

A generalized force is the power of the forces while one coordinate alone moves at unit rate; how
points move then, and what gravity takes at rest, comes from recursive Newton-Euler.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import islice
from typing import Any

from dynsolve.derivation.arm_values import RobotValues, arm_at, arms
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
from dynsolve.derivation.verification import TOLERANCE as VERIFICATION_TOLERANCE
from dynsolve.derivation.verification import acting_forces
from dynsolve.errors import VerificationError
from dynsolve.notation.tree import Node
from dynsolve.notation.tree_values import compile_trees
from dynsolve.questions.held import Held
from dynsolve.questions.rates.check import state_numbers
from dynsolve.robot.model import Robot
from dynsolve.robot.questions import Load


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
        held = [a + b for a, b in zip(weight, acting_forces(robot, values).stored, strict=True)]
        theirs = {"Q": Q, "tau_static": [a - b for a, b in zip(held, Q, strict=True)]}
        size = max((1.0, *map(abs, Q), *map(abs, held)))
        for name, mine in zip(results, program.run(values), strict=True):
            if not _gap(mine, theirs[name]) <= VERIFICATION_TOLERANCE * size:
                raise VerificationError(
                    f"{name} differs from the power of the forces; this is a fault of dynsolve"
                )


def outside_forces(robot: Robot, values: Mapping[str, float]) -> list[float]:
    """Q in a configuration, by the power of the forces; 0 where none acts."""
    if not robot.questions.loads:
        return [0.0] * robot.n
    return generalized_forces(robot, values, arm_at(robot, values))


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


def _gap(mine: Any, theirs: Sequence[float]) -> float:
    gaps = [abs(a - b) for (a,), b in zip(mine, theirs, strict=True)]
    return max((gap if gap == gap else float("inf") for gap in gaps), default=0.0)


def verify(held: Held) -> None:
    """Hold the results as they are printed; raises VerificationError where one is wrong."""
    held.hold(verify_statics, (name for name in ("Q", "tau_static") if name in held.wanted))
