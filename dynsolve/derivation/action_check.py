"""What acts beside gravity, on numbers: springs, friction and dampers, for the independent check.

No derivative of the ring is taken: the force of a spring is the slope of its energy by central
differences, and a linear form of the coordinates, put at the rates, is its own rate.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass

from dynsolve.algebra.expr import Expr
from dynsolve.algebra.floats import evaluate
from dynsolve.robot.actions import Spring
from dynsolve.robot.model import Robot

_STEP = 0.02
_WEIGHTS = (4 / 5, -1 / 5, 4 / 105, -1 / 280)
"""Central differences of the eighth order: what is left is of the order of rounding."""


@dataclass(frozen=True, slots=True)
class ActingForces:
    """The generalized forces of springs (a part of g) and of friction at a state, and the springs' energy."""

    springs: tuple[float, ...]
    friction: tuple[float, ...]
    energy: float = 0.0


def acting_forces(robot: Robot, values: Mapping[str, float]) -> ActingForces:
    """Those of a robot at a state; zeros where nothing acts."""
    n, acting = robot.n, robot.actions
    springs, friction, energy = [0.0] * n, [0.0] * n, 0.0
    for spring in acting.springs:
        energy += _energy(robot, spring, values)
        for k in range(n):
            springs[k] += _slope(robot, spring, values, k)
    for one in acting.friction:
        rate = values[robot.coordinates[one.coordinate].velocity]
        viscous, coulomb = (evaluate(expr, values) for expr in (one.viscous, one.coulomb))
        friction[one.coordinate] += viscous * rate + (math.copysign(coulomb, rate) if rate else 0.0)
    for damper in acting.dampers:
        moving = {**values, **{q.name: values[q.velocity] for q in robot.coordinates}}
        force = evaluate(damper.damping, values) * evaluate(damper.of, moving)
        for k in range(n):
            friction[k] += force * _at_unit(robot, damper.of, values, k)
    return ActingForces(tuple(springs), tuple(friction), energy)


def _at_unit(robot: Robot, form: Expr, values: Mapping[str, float], k: int) -> float:
    """A linear form where coordinate k is 1 and the others are 0."""
    unit = {q.name: float(place == k) for place, q in enumerate(robot.coordinates)}
    return evaluate(form, {**values, **unit})


def _energy(robot: Robot, spring: Spring, values: Mapping[str, float]) -> float:
    if spring.law is None:
        return evaluate(spring.energy, values)
    k, x, rest = (evaluate(expr, values) for expr in (spring.law.stiffness, spring.law.of, spring.law.rest))
    return k * (x - rest) ** 2 / 2


def _slope(robot: Robot, spring: Spring, values: Mapping[str, float], k: int) -> float:
    name = robot.coordinates[k].name
    total = 0.0
    for times, weight in enumerate(_WEIGHTS, 1):
        beyond, before = ({**values, name: values[name] + sign * times * _STEP} for sign in (1, -1))
        total += weight * (_energy(robot, spring, beyond) - _energy(robot, spring, before))
    return total / _STEP
