"""What is left over of D where every body is a point at its mass centre: the moments of inertia."""

from __future__ import annotations

from dynsolve.algebra.matrix import Matrix
from dynsolve.document import Prose, Reference
from dynsolve.explain.body_parts import angular_name
from dynsolve.explain.context import Context
from dynsolve.explain.sanity.inertia_poses import inertia_poses_step
from dynsolve.explain.step import Step
from dynsolve.explain.writing import is_small, listed, spong, sum_of
from dynsolve.notation.tree import (
    Letter,
    Negative,
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
    """D - Σ m J_vᵀ J_v; None where the one or the other is nothing.

    None of numbers either, in which what is left over cannot be seen, nor where it is the same in
    every pose and stands beside the masses in the moments of inertia in simple poses.
    """
    values, robot = context.values, context.robot
    if not robot.parameters:
        return None
    parts = [values[f"Dv{body.name}"] for body in robot.bodies]
    points = sum(parts, start=Matrix.zero(robot.ring, robot.n, robot.n))
    if points.is_zero or points == values["D"]:
        return None
    left_over = values["D"] - points
    varies = any(robot.ring.depends_on_coordinates(entry) for entry in left_over.entries)
    turning = [body for body in robot.bodies if not values[f"Dw{body.name}"].is_zero]
    parts = [angular_name(body) for body in turning]
    parts += [letters.DM] if robot.actions.motors else []
    name, rest = Sum((letters.D, Negative(letters.D_POINTS))), context.show(left_over)
    if not is_small(rest) or (not varies and inertia_poses_step(context) is not None):
        return None
    return Step(
        id="point_masses",
        stage=Stage.VECTORIZED,
        title="Check: point masses",
        why=_why(context),
        formula=equation(name, sum_of(parts)),
        source=spong("7.2"),
        result=(equation(name, rest),),
        is_task=False,
    )


def _why(context: Context) -> Prose:
    """What is left of D, and which entries the rest cannot have."""
    robot = context.robot
    rotors = " and of the rotors" if robot.actions.motors else ""
    jv = letters.bold("J", Letter("v", Symbol("i")))
    why: Prose = (
        f"Without the moments of inertia of the bodies{rotors} each body is a point at its mass centre, and ",
        letters.D,
        " is ",
        letters.D_POINTS,
        ", the sum of the ",
        Product((Letter("m", Symbol("i")), Transpose(jv), jv)),
        ". What is left over of ",
        letters.D,
        Reference(("D",), " in "),
        f" is what the turning of the bodies{rotors} adds",
    )
    sliding = [Symbol(q.name) for q in robot.coordinates if q.type is JointType.PRISMATIC]
    if robot.has_table and sliding and not robot.actions.motors:
        why += (", and nothing for ", *listed(sliding), f", which turn{'s' * (len(sliding) == 1)} no body")
    return (*why, ":")
