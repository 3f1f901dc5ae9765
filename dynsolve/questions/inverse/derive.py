"""Which configurations reach a point: q from r(q) = r, in closed form where one is found."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial
from typing import TYPE_CHECKING

from msgspec import Struct

from dynsolve.algebra.matrix import Matrix
from dynsolve.algebra.ring_values import evaluate
from dynsolve.algebra.sampling import samples
from dynsolve.derivation.elimination import rank
from dynsolve.derivation.graph import Rule, Skipped
from dynsolve.robot.model import Robot

if TYPE_CHECKING:
    from dynsolve.questions.inverse.solving import Branch, Solving

NO_CLOSED_FORM = "no closed form was found"


REDUNDANT = (
    "the arm can move and keep the task: infinitely many configurations reach what is inside its reach"
)


_STEP = 1e-5


def rules(robot: Robot) -> Iterator[Rule]:
    """The branches of the task, where it has values to be reached: a twist has none."""
    task = robot.questions.task
    if task is not None and task.reached:
        yield Rule("inverse", ("pose" if task.is_pose else "r",), partial(inverse, robot))


class Inverse(Struct, frozen=True):
    """How a task is solved, and the branches that solve it."""

    solving: Solving
    branches: tuple[Branch, ...]


class NoClosedForm(Struct, frozen=True):
    """A task that the known forms do not solve; what reaches a target in numbers is looked for there."""


def inverse(robot: Robot, r: Matrix) -> Inverse | NoClosedForm | Skipped:
    """q from r(q) = r, where a closed form is found (Spong, section 3.3).

    `r` is r(q), m×1, or of a pose its position and the rows of its rotation, 12×1.
    """
    from dynsolve.questions.inverse.pose import solve_pose
    from dynsolve.questions.inverse.search import solve_task, with_conditions
    from dynsolve.questions.inverse.solving import branches

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
