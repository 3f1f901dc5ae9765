"""Further ways to results about the task: J_r by rows of J_v, and forces to the joints by J_rᵀ."""

from __future__ import annotations

from collections.abc import Iterator

from dynsolve.algebra.expr import Expr
from dynsolve.algebra.matrix import Matrix
from dynsolve.answers.judging.route import Key, Route
from dynsolve.derivation import statics
from dynsolve.notation.tree import Reference
from dynsolve.quantities import kinematic_families, static_families
from dynsolve.quantities.index import Quantity
from dynsolve.robot.questions import TIP, Load, Questions, Task


def task_routes(questions: Questions, quantity: Quantity, key: Key) -> Iterator[Route]:
    """The routes to a quantity beside that of its rule."""
    task = questions.task
    if task is None or task.is_twist:
        return
    if quantity.family is kinematic_families.JR:
        rows = [_axis(entry) for entry in task.entries]
        if None not in rows:
            yield Route(("Jv",), lambda Jv: Matrix(Jv.ring, tuple(Jv.rows[k] for k in rows if k is not None)))
    elif quantity.family is static_families.LOAD:
        load = questions.loads[quantity.index[0] - 1]
        wrench = _task_wrench(task, load, quantity.rule, key)
        if wrench is not None:
            yield Route(("Jr",), lambda J: J.T @ wrench, linear=False)


def _axis(entry: object) -> int | None:
    """Which coordinate of the tip a component of the task is, None for any other component."""
    if isinstance(entry, Reference) and entry.quantity == TIP and entry.row is not None:
        return entry.row - 1
    return None


def _task_wrench(task: Task, load: Load, rule: str, key: Key) -> Matrix | None:
    """The force along each component of the task with which J_rᵀ gives the generalized forces; None of none.

    Along a coordinate of the tip it is that of the force, along an angle one of the moment.
    """
    if load.point != TIP:
        return None
    J, wanted = key("Jr"), key(rule)
    force, moment = statics.wrench(load, key(f"H{load.link}"))
    for around in range(3):
        parts: list[Expr] = []
        for entry in task.entries:
            axis = _axis(entry)
            parts.append(moment[around, 0] if axis is None else force[axis, 0])
        wrench = Matrix.column(J.ring, parts)
        if J.T @ wrench == wanted:
            return wrench
    return None
