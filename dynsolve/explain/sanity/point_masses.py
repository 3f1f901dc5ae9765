"""D where every body is a point at its mass centre, and what the moments of inertia add."""

from __future__ import annotations

from collections.abc import Iterator

from dynsolve.algebra.matrix import Matrix
from dynsolve.document import Prose, Reference
from dynsolve.explain.body_parts import linear_name
from dynsolve.explain.context import Context
from dynsolve.explain.sanity.inertia_poses import inertia_poses_step
from dynsolve.explain.step import Step
from dynsolve.explain.writing import and_joined, is_small, listed, spong, sum_of
from dynsolve.notation.tree import Negative, Sum, Symbol, equation
from dynsolve.quantities import letters
from dynsolve.quantities.stages import Stage
from dynsolve.robot.model import Body, JointType


def point_masses_step(context: Context) -> Step | None:
    """D_points = Σ m J_vᵀ J_v and D - D_points; None where the one or the other is nothing.

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
    mass, rest = context.show(points), context.show(left_over)
    if not is_small(rest) or (not varies and inertia_poses_step(context) is not None):
        return None
    linear = [linear_name(context, body) for body in _with_linear_part(context)]
    return Step(
        id="point_masses",
        stage=Stage.VECTORIZED,
        title="Check: point masses",
        why=_why(context),
        formula=equation(letters.D_POINTS, sum_of(linear)),
        source=spong("7.2.2"),
        result=(
            equation(letters.D_POINTS, mass),
            equation(Sum((letters.D, Negative(letters.D_POINTS))), rest),
        ),
        uses=(*(f"D_direct{body.name}" for body in _with_linear_part(context)), "D"),
        is_task=False,
    )


def _with_linear_part(context: Context) -> list[Body]:
    """The bodies whose mass centres move."""
    return [body for body in context.robot.bodies if not context.values[f"Dv{body.name}"].is_zero]


def _left_out(context: Context) -> Prose:
    """That the linear part of body 1 is zero, where the mass centre of some body does not move."""
    moving = _with_linear_part(context)
    still = [body.name for body in context.robot.bodies if body not in moving]
    if not still:
        return ()
    zero = f"those of bodies {and_joined(still)} are" if len(still) > 1 else f"that of body {still[0]} is"
    return (f" ({zero} zero)",)


def _why(context: Context) -> Prose:
    """What is left of D, and which entries the rest cannot have."""
    robot = context.robot
    rotors = " and of the rotors" if robot.actions.motors else ""
    why: Prose = (
        f"Without the moments of inertia of the bodies{rotors} each body is a point at its mass centre, and ",
        letters.D,
        " is ",
        letters.D_POINTS,
        ", the sum of the linear parts",
        *_left_out(context),
        ". What is left over of ",
        letters.D,
        Reference(("D",), " in "),
        f" is what the turning of the bodies{rotors} adds: the rotational parts",
        Reference(tuple(_rotational(context)), " in "),
    )
    sliding = [Symbol(q.name) for q in robot.coordinates if q.type is JointType.PRISMATIC]
    if robot.has_table and sliding and not robot.actions.motors:
        why += ("; nothing for ", *listed(sliding), f", which turn{'s' * (len(sliding) == 1)} no body")
    return (*why, ".")


def _rotational(context: Context) -> Iterator[str]:
    """The labels of the rotational parts of D: by themselves, or beside a linear part that is zero."""
    values = context.values
    for body in context.robot.bodies:
        if not values[f"Dw{body.name}"].is_zero:
            yield f"Dw{body.name}" if body in _with_linear_part(context) else f"D_direct{body.name}"
