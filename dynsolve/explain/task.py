"""Steps of what is asked of the task, and of how Jacobians change."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from dynsolve.document import Prose
from dynsolve.explain.context import Context
from dynsolve.explain.points import point_steps
from dynsolve.explain.rates import determinant_step
from dynsolve.explain.step import Detail, Group, Step
from dynsolve.explain.writing import listed, spong, sum_over_coordinates
from dynsolve.notation.tree import (
    Derivative,
    Letter,
    Matrix,
    Node,
    Product,
    Reference,
    Sum,
    Symbol,
    Words,
    column,
    equation,
)
from dynsolve.notation.walk import mapped
from dynsolve.quantities import letters
from dynsolve.quantities.stages import Stage
from dynsolve.robot.questions import TIP, Task, points_of

STAGE = Stage.TASK

TASK = Group("r", "The task and its Jacobian")

_POINTS, _TASK, _RATES = spong("4.6"), spong("4.8"), spong("4.11")


def steps(context: Context) -> Iterator[Step]:
    """What is asked, and what that is derived from: the points, how the arm's Jacobian changes, the task."""
    wanted = context.wanted
    for point in context.robot.questions.points:
        yield from point_steps(context, point, wanted)
    for name, letter in (("Jv", letters.JV), ("Jw", letters.JW)):
        if f"{name}_dot" in wanted:
            yield _rate(context, name, letter)
    if "J_dot" in wanted:
        yield _whole_rate(context)
    task = context.robot.questions.task
    if task is not None:
        yield from _task(context, task, wanted)


# -- the task --------------------------------------------------------------------------------------


def _task(context: Context, task: Task, wanted: frozenset[str]) -> Iterator[Step]:
    if "r" in wanted:
        yield replace(_map(context, task), group=TASK)
    if "Jr" in wanted:
        yield replace(_twist(context) if task.is_twist else _jacobian(context, task), group=TASK)
    if "Jr_dot" in wanted:
        yield _rate(context, "Jr", letters.J_TASK)
    if "det" in wanted:
        yield determinant_step(context)


def _map(context: Context, task: Task) -> Step:
    entries = column(*(mapped(entry, with_letters) for entry in task.entries))
    points = ["the tip" if point == TIP else point for point in points_of(task)]
    where: Prose = (" The coordinates of ", *listed(points), " are put in.") if points else ()
    why: Prose = ("The components of the task as functions of the joint variables.", *where)
    if task.is_default:
        why = ("The task is the position of the tip, of which these are the coordinates that move.",)
    return Step(
        id="r",
        stage=STAGE,
        title="The task",
        why=why,
        formula=equation(letters.TASK, entries),
        source=_TASK,
        result=(equation(letters.TASK, context.form("r")),),
        detail=Detail.BRIEF,
    )


def with_letters(part: Node) -> Node:
    """A coordinate of a point as it is printed: x_tip, y_P."""
    if not isinstance(part, Reference) or part.row is None:
        return part
    index = Words(TIP) if part.quantity == TIP else Symbol(part.quantity)
    return Letter("xyz"[part.row - 1], index)


def _jacobian(context: Context, task: Task) -> Step:
    columns = tuple(Derivative(letters.TASK, Symbol(q.name)) for q in context.robot.coordinates)
    return Step(
        id="Jr",
        stage=STAGE,
        title="The Jacobian of the task",
        why=(
            "One column for each coordinate: the derivatives of all components by it. Then ",
            equation(letters.rate(letters.TASK), Product((letters.J_TASK, letters.QD))),
            ".",
        ),
        formula=equation(letters.J_TASK, Derivative(letters.TASK, letters.Q), Matrix((columns,))),
        source=_TASK,
        result=(equation(letters.J_TASK, context.form("Jr")),),
        notes=tuple(_left_out(task)),
        detail=Detail.BRIEF,
    )


def _left_out(task: Task) -> Iterator[Prose]:
    """Which rows of J_v the default task does not have."""
    moving = {entry.row for entry in task.entries if isinstance(entry, Reference)}
    still = [axis for row, axis in enumerate("xyz", 1) if row not in moving]
    if task.is_default and still:
        rows = "row of " if len(still) == 1 else "rows of "
        yield (
            "This is ",
            letters.JV,
            f" without the {rows}",
            *listed(still),
            ", zero in every configuration.",
        )


def _twist(context: Context) -> Step:
    return Step(
        id="Jr",
        stage=STAGE,
        title="The Jacobian of the task",
        why=("The task is the twist of the last frame, its velocity and its angular velocity: ",
             equation(letters.J_TASK, letters.J), "."),
        formula=equation(letters.J_TASK, letters.J),
        source=spong("4.6.3"),
        result=(equation(letters.J_TASK, context.form("Jr")),),
        detail=Detail.BRIEF,
    )  # fmt: skip


# -- how a Jacobian changes ------------------------------------------------------------------------


def _rate(context: Context, name: str, letter: Letter) -> Step:
    changed = letters.rate(letter)
    k = Symbol("k")
    term = Product((Derivative(letter, Letter("q", k)), Letter("q", k, dots=1)))
    total = sum_over_coordinates(term, k, context.robot)
    moved = Product((letter, letters.QDD))
    return Step(
        id=f"{name}_dot",
        stage=STAGE,
        title=f"How {_CALLED[name]} changes",
        why=(
            "Entry by entry, by the chain rule: every joint variable in an entry moves. It stands in the "
            "acceleration, ",
            equation(_acceleration(name), Sum((moved, Product((changed, letters.QD))))),
            ".",
        ),
        formula=equation(changed, total),
        source=_RATES,
        result=(equation(changed, context.form(f"{name}_dot")),),
        detail=Detail.BRIEF,
    )


_CALLED = {
    "Jv": "the linear part of the Jacobian",
    "Jw": "its angular part",
    "Jr": "the Jacobian of the task",
}


def _acceleration(name: str) -> Node:
    """What a Jacobian gives the acceleration of."""
    if name == "Jr":
        return letters.bold("r", dots=2)
    return letters.bold("v" if name == "Jv" else "omega", dots=1)


def _whole_rate(context: Context) -> Step:
    changed = letters.rate(letters.J)
    parts = column(letters.rate(letters.JV), letters.rate(letters.JW))
    return Step(
        id="J_dot",
        stage=STAGE,
        title="How the Jacobian changes",
        why=("The two parts, one above the other.",),
        formula=equation(changed, parts),
        source=_RATES,
        result=(equation(changed, context.form("J_dot")),),
        detail=Detail.BRIEF,
    )
