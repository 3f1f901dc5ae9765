"""What exercises ask of the equations of motion as rules: parameters, linearization, q̈, inertia of the task.

A robot has the rules of those stages of which something is asked; the formulas are in
`regressor`, `linearization`, `forward_dynamics` and `task_inertia`.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial
from typing import TYPE_CHECKING

from dynsolve.algebra.matrix import Matrix
from dynsolve.derivation import balance, linearization, regressor, task_inertia
from dynsolve.derivation.energy import accelerations
from dynsolve.derivation.graph import Rule, Skipped
from dynsolve.quantities.robot_stages import asked_stages
from dynsolve.quantities.stages import Stage
from dynsolve.robot.model import Robot

if TYPE_CHECKING:
    from dynsolve.derivation.equilibria import Equilibria


def model_rules(robot: Robot) -> Iterator[Rule]:
    """The rules of what is asked of the equations of motion; none of a robot of which nothing is."""
    stages = asked_stages(robot.questions)
    if Stage.PARAMETERS in stages:
        yield from _parameters(robot)
    if Stage.EQUILIBRIA in stages:
        yield from _equilibria(robot)
    if Stage.FORWARD_DYNAMICS in stages:
        yield _forward(robot)
    if Stage.TASK_INERTIA in stages and robot.has_table:
        yield Rule("Lambda", ("Jr", "D"), task_inertia.task_inertia)


def _parameters(robot: Robot) -> Iterator[Rule]:
    minimal, columns = partial(regressor.minimal_parameters, robot), partial(regressor.regressor, robot)
    given = robot.questions.model.parameters
    yield Rule("a", ("tau",), minimal) if given is None else Rule("a", (), lambda: given)
    yield Rule("Y", ("tau", "a"), columns)

    def inertial(D: Matrix) -> Matrix:
        return D @ accelerations(robot)

    yield Rule("aM", ("D",), lambda D: minimal(inertial(D)))
    yield Rule("YM", ("D", "aM"), lambda D, a: columns(inertial(D), a))
    if robot.ring.plan.references:
        forces = partial(regressor.reference_forces, robot)
        yield Rule("Yr", ("D", "C", "g", "a"), lambda D, C, g, a: columns(forces(D, C, g), a))
    yield Rule("ag", ("g",), minimal)
    yield Rule("Yg", ("g", "ag"), columns)


def _equilibria(robot: Robot) -> Iterator[Rule]:
    yield Rule("balance", ("g",), partial(balance.balance, robot))
    if robot.questions.model.steady:
        yield Rule("equilibria", ("D", "C", "g"), partial(_in_steady_motion, robot))
    else:
        yield Rule("equilibria", ("g",), partial(_where_in_balance, robot))
    if robot.questions.model.linearize:
        friction = ("friction",) if "friction" in robot.actions.kinds else ()
        yield Rule("linear_A", ("D", "g", *friction), partial(linearization.state_matrix, robot))
        yield Rule("linear_B", ("D",), partial(linearization.input_matrix, robot))


def _forward(robot: Robot) -> Rule:
    """The rule of the accelerations; what works them out is imported when they are asked for."""
    from dynsolve.derivation.forward_dynamics import accelerations, acting_names

    return Rule("qdd_forward", ("D", *acting_names(robot)), partial(accelerations, robot))


def _where_in_balance(robot: Robot, gravity: Matrix) -> Equilibria | Skipped:
    """The equilibria; what finds them is imported when they are asked for."""
    from dynsolve.derivation.equilibria import equilibria

    return equilibria(robot, gravity)


def _in_steady_motion(robot: Robot, D: Matrix, C: Matrix, gravity: Matrix) -> Equilibria | Skipped:
    """Those of coordinates whose others move at constant rates."""
    from dynsolve.derivation.steady import steady_equilibria

    return steady_equilibria(robot, D, C, gravity)
