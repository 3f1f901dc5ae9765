"""Constraints as rules; the formulas are in `constraints`."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial

from dynsolve.algebra.fraction_matrix import FractionMatrix
from dynsolve.algebra.matrix import Matrix
from dynsolve.derivation import constraints, kinematics, task
from dynsolve.derivation.forward_dynamics import acting_forces, acting_names
from dynsolve.derivation.graph import Rule, Skipped
from dynsolve.derivation.kinematic_rules import position_rule
from dynsolve.derivation.reduced import reduced
from dynsolve.robot.model import Robot
from dynsolve.robot.questions import TIP, Task, points_of

LAMBDA, REDUCED = "lambda", "reduced"


def constraint_rules(robot: Robot) -> Iterator[Rule]:
    """The rules of h, A_c, its rate and, where they are asked for, the multipliers."""
    used = points_of(Task(tuple(one.entry for one in constraints.holonomic(robot))))

    def functions(*found: Matrix) -> Matrix:
        positions = zip(used, found, strict=True)
        at = {point: kinematics.origin(x) if point == TIP else x for point, x in positions}
        return constraints.constraint_functions(robot, at)

    yield Rule("hc", tuple(position_rule(robot, point) for point in used), functions)
    yield Rule("Ac", ("hc",), partial(constraints.constraint_matrix, robot))
    yield Rule("Ac_dot", ("Ac",), task.rate)
    if LAMBDA in robot.questions.asked and robot.has_dynamics:
        yield _multipliers(robot)
    if REDUCED in robot.questions.asked and robot.has_dynamics:
        loads = ("Q",) if robot.questions.loads else ()
        yield Rule(REDUCED, ("Ac", "tau", *loads), partial(reduced, robot))


def _multipliers(robot: Robot) -> Rule:
    def compute(A: Matrix, A_dot: Matrix, D: Matrix, *forces: Matrix) -> Matrix | FractionMatrix | Skipped:
        return constraints.multipliers(robot, A, A_dot, D, acting_forces(robot, *forces))

    return Rule(LAMBDA, ("Ac", "Ac_dot", "D", *acting_names(robot)), compute)
