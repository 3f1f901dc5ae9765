"""D without the moments of inertia, every body a point at its mass centre, and what is left over."""

from __future__ import annotations

from dynsolve.algebra.matrix import Matrix
from dynsolve.document import Prose
from dynsolve.explain.context import Context
from dynsolve.explain.step import Step
from dynsolve.explain.writing import is_small, listed, spong
from dynsolve.notation.tree import (
    BigSum,
    Letter,
    Negative,
    Node,
    Number,
    Product,
    Sum,
    Symbol,
    Transpose,
    equation,
)
from dynsolve.quantities import letters
from dynsolve.quantities.stages import Stage
from dynsolve.robot.model import JointType


def point_masses_step(context: Context) -> Step | None:
    """Σ m J_vᵀ J_v: D without the tensors, and D - Σ m J_vᵀ J_v; None where one of them is nothing.

    None of numbers either: what is left over cannot be seen in them.
    """
    values, robot = context.values, context.robot
    if not robot.parameters:
        return None
    parts = [values[f"Dv{body.name}"] for body in robot.bodies]
    points = sum(parts, start=Matrix.zero(robot.ring, robot.n, robot.n))
    if points.is_zero or points == values["D"]:
        return None
    shown, rest = context.show(points), context.show(values["D"] - points)
    if not is_small(shown) or not is_small(rest):
        return None
    i = Symbol("i")
    jv = letters.bold("J", Letter("v", i))
    general = BigSum(Product((Letter("m", i), Transpose(jv), jv)), i, Number(1), Number(len(robot.bodies)))
    bodies: tuple[Node, ...] = (general,) if len(robot.bodies) > 1 else ()
    return Step(
        id="point_masses",
        stage=Stage.VECTORIZED,
        title="Check: point masses",
        why=_why(context),
        source=spong("7.2"),
        result=(
            equation(letters.D_POINTS, *bodies, shown),
            equation(Sum((letters.D, Negative(letters.D_POINTS))), rest),
        ),
        is_task=False,
    )


def _why(context: Context) -> Prose:
    """What the two matrices are, and which entries the second one cannot have."""
    robot = context.robot
    rotors = " and of the rotors" if robot.actions.motors else ""
    why: Prose = (
        f"Without the moments of inertia of the bodies{rotors} each body is a point at its mass centre, and ",
        letters.D,
        " is the sum of the linear parts alone. What is left over has a moment of inertia in each term",
    )
    sliding = [Symbol(q.name) for q in robot.coordinates if q.type is JointType.PRISMATIC]
    if robot.has_table and sliding and not robot.actions.motors:
        why += (", and nothing for ", *listed(sliding), f", which turn{'s' * (len(sliding) == 1)} no body")
    return (*why, ":")
