"""Where the arm is singular, and which configurations reach a point: rules where a file asks for them.

What computes them is imported when it is asked for, so that no other solution pays for it.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING

from dynsolve.algebra.floats import evaluate
from dynsolve.algebra.matrix import Matrix
from dynsolve.algebra.sampling import samples
from dynsolve.derivation.elimination import rank
from dynsolve.derivation.graph import Rule, Skipped
from dynsolve.derivation.rates import whole_or_task
from dynsolve.quantities.robot_stages import asked_stages
from dynsolve.quantities.stages import Stage
from dynsolve.robot.model import Robot

if TYPE_CHECKING:
    from dynsolve.derivation.inverse.branches import Branch
    from dynsolve.derivation.inverse.solving import Solving
    from dynsolve.derivation.singular.sets import SingularSet


NO_CLOSED_FORM = "no closed form was found"
REDUNDANT = "the arm has more joints than the task: infinitely many configurations reach it"

_STEP = 1e-5


@dataclass(frozen=True, slots=True)
class Inverse:
    """How a task is solved, and the branches that solve it."""

    solving: Solving
    branches: tuple[Branch, ...]


@dataclass(frozen=True, slots=True)
class NoClosedForm:
    """A task that the known forms do not solve; what reaches a target in numbers is looked for there."""


def configuration_rules(robot: Robot) -> Iterator[Rule]:
    """The rules of singular configurations and of inverse kinematics, where they are asked for."""
    stages = asked_stages(robot.questions)
    if Stage.SINGULAR in stages:
        yield Rule("singular", (whole_or_task(robot),), where_singular)
    task = robot.questions.task
    if Stage.INVERSE in stages and task is not None and task.reached:
        yield Rule("inverse", ("pose" if task.is_pose else "r",), lambda r: inverse(robot, r))


def where_singular(jacobian: Matrix) -> SingularSet | Skipped:
    """Where a Jacobian has less than its greatest rank (Spong, section 4.9)."""
    from dynsolve.algebra.transfer import Transfer
    from dynsolve.derivation.inverse.unknowns import search_ring
    from dynsolve.derivation.singular.sets import singular_set

    ring = search_ring(jacobian.ring, (), {})
    found = singular_set(jacobian.map(Transfer(jacobian.ring, ring)))
    return found or Skipped("the Jacobian and its minors are too long to be taken apart into factors")


def inverse(robot: Robot, r: Matrix) -> Inverse | NoClosedForm | Skipped:
    """q from r(q) = r, where a closed form is found (Spong, section 3.3).

    `r` is r(q), m×1, or of a pose its position and the rows of its rotation, 12×1.
    """
    from dynsolve.derivation.inverse.branches import branches
    from dynsolve.derivation.inverse.conditions import with_conditions
    from dynsolve.derivation.inverse.pose import solve_pose
    from dynsolve.derivation.inverse.search import solve_task

    task, names = robot.questions.task, robot.questions.reached
    is_pose = task is not None and task.is_pose
    solving = solve_pose(robot, r, names) if is_pose else solve_task(r, names)
    found = None if solving is None else branches(solving)
    if solving is not None and found is not None and solving.conditions > 0:
        found = with_conditions(solving, found)
    if solving is None or found is None:
        has_target = robot.questions.target is not None and not without_number(robot, r)
        return NoClosedForm() if has_target else Skipped(REDUNDANT if is_redundant(r) else NO_CLOSED_FORM)
    return Inverse(solving, found)


def is_redundant(r: Matrix) -> bool:
    """Whether joints can move and leave the task where it is, at a sample."""
    names, at = r.ring.names, next(samples(r.ring))
    ends = [
        [evaluate(entry, {**at, name: at[name] + step}) for entry in r.entries]
        for name in names for step in (_STEP, -_STEP)
    ]  # fmt: skip
    columns = [
        [(a - b) / (2 * _STEP) for a, b in zip(*pair, strict=True)]
        for pair in zip(ends[::2], ends[1::2], strict=True)
    ]
    return rank(columns, _STEP) < len(names)


def without_number(robot: Robot, r: Matrix) -> str:
    """The first parameter of the task that has no number where the target has; nothing where all have."""
    if robot.questions.target is None:
        return ""
    at = dict.fromkeys((*robot.ring.names, *dict(robot.questions.target.numbers)), 0.0)
    for entry in r.entries:
        try:
            evaluate(entry, at)
        except KeyError as error:
            return str(error.args[0])
    return ""
