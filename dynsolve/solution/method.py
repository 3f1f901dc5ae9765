"""The way to the forces that a user chooses: by the Lagrangian, or by the Newton-Euler recursions."""

from __future__ import annotations

from dataclasses import replace

from dynsolve.derivation.graph import Derivation
from dynsolve.derivation.rules import derive
from dynsolve.errors import UsageError, VerificationError
from dynsolve.explain.context import MOST_JOINTS
from dynsolve.problem import Problem
from dynsolve.quantities.index import quantities
from dynsolve.quantities.stages import Stage
from dynsolve.robot.model import Robot
from dynsolve.robot.questions import Method


def by_method(problem: Problem, method: Method) -> Problem:
    """The problem, to be solved by a method; by the recursions with all their quantities asked for.

    Of robots of more than three coordinates these would fill pages, and are only there where the file
    asks for them.  Raises UsageError for the recursions of a robot without masses or links.
    """
    if method is Method.LAGRANGE:
        return problem
    if not problem.robot.bodies:
        raise UsageError("no body has mass, so the Newton-Euler recursions have nothing to work out")
    if not problem.robot.has_table:
        raise UsageError("this model has no links, along which the Newton-Euler recursions go")
    robot = _with_method(problem.robot, method)
    if robot.n > MOST_JOINTS:
        return replace(problem, robot=robot)
    own = (q.name for q in quantities(robot).values() if q.family.stage is Stage.NEWTON_EULER)
    asked = robot.questions.asked.union(own)
    return replace(problem, robot=replace(robot, questions=replace(robot.questions, asked=asked)))


def verify_method(robot: Robot, values: Derivation) -> None:
    """Compare the forces of the recursions with those of the Lagrangian, exactly.

    Raises VerificationError where they differ.
    """
    if robot.questions.method is Method.NEWTON_EULER:
        by_lagrange = derive(_with_method(robot, Method.LAGRANGE))
        if values["tau"] != by_lagrange["tau"]:
            raise VerificationError("the forces of the recursions differ from those of the Lagrangian")


def _with_method(robot: Robot, method: Method) -> Robot:
    return replace(robot, questions=replace(robot.questions, method=method))
