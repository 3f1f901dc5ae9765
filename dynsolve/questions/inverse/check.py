"""Branches of the inverse kinematics as they are printed, put into r(q) at values that samples reach.

One of the branches must be the configuration that reached the values.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from dynsolve.derivation.configurations import Conditions, Values, on_branch, reaches, solution_of, states_of
from dynsolve.derivation.reached import angle_rows, near, same_configuration
from dynsolve.errors import VerificationError
from dynsolve.notation.tree import Node
from dynsolve.notation.tree_values import compile_trees
from dynsolve.questions.held import Held
from dynsolve.questions.inverse.forms import InverseForms
from dynsolve.questions.inverse.solving import MOST
from dynsolve.robot.model import Robot


def verify_inverse(
    robot: Robot, r: Node, angles: Sequence[bool], branches: Sequence[tuple[Mapping[str, Node], Conditions]]
) -> None:
    """Put every branch into r(q), whose components are lengths or `angles`, where its conditions hold.

    Raises VerificationError where one is none, or one is missing.
    """
    task, solutions = compile_trees([r]), [solution_of(*branch) for branch in branches]
    for values in states_of(robot, task, MOST):  # not those that the branches were found with
        reached = reaches(task, values)
        given = {**values, **dict(zip(robot.questions.reached, reached, strict=True))}
        found = [q for q in (solution(given) for solution in solutions) if q is not None]
        if not all(near(reaches(task, q), reached, angles) for q in found):
            raise VerificationError("a branch of the inverse kinematics does not reach what it should")
        if not any(same_configuration(robot.ring, q, values) for q in found):
            raise VerificationError("a branch of the inverse kinematics is missing")


def verify_target(
    robot: Robot,
    r: Node,
    angles: Sequence[bool],
    given: Values,
    configurations: Sequence[tuple[Mapping[str, Node], Sequence[str]]],
) -> None:
    """Put configurations as they are printed into r(q), each with the names of what is free in it.

    `given` are the values of the parameters and of the task.  Raises VerificationError where one
    does not reach the target.
    """
    task = compile_trees([r])
    wanted = [given[name] for name in robot.questions.reached]
    for formulas, free in configurations:
        for place in (0.0, 1.0) if free else (0.0,):
            q = on_branch(formulas, {**given, **dict.fromkeys(free, place)})
            if q is None or not near(reaches(task, q), wanted, angles):
                raise VerificationError("a configuration does not reach the target of the inverse kinematics")


def verify(held: Held) -> None:
    """Hold the results as they are printed; raises VerificationError where one is wrong."""
    robot, values = held.robot, held.values
    if "inverse" not in held.wanted:
        return
    shown = InverseForms(robot, values)
    (task,) = values.rules["inverse"].inputs
    if shown.solved is not None:
        branches = list(zip(shown.inverse, shown.when, strict=True))
        verify_inverse(robot, held.forms(task), angle_rows(values[task]), branches)
    target = shown.target
    if target is not None:
        configurations = [(c.formulas, c.free) for c in target.configurations]
        verify_target(robot, target.task, target.angles, target.numbers, configurations)
