"""Why Christoffel symbols of joints with parallel axes are equal."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise

from dynsolve.derivation.jacobian import joint_frame
from dynsolve.derivation.kinematics import axis
from dynsolve.document import Prose
from dynsolve.explain.context import Context
from dynsolve.explain.writing import listed
from dynsolve.notation.tree import Letter, Number, Relation, Row, Sum, Symbol, equation
from dynsolve.robot.model import Coordinate, JointType

_J, _K = Symbol("j"), Symbol("k")


def on_parallel_axes(context: Context) -> Prose:
    """c_2jk = c_3jk where 3 ≤ j, of neighbours that turn about parallel axes.

    ∂²r/∂q_i ∂q_j = z_i × (∂r/∂q_j) of a point that joints i ≤ j move, and ∂(J_ω)_j/∂q_i = z_i × z_j,
    speak of joint i by the direction of its axis alone.
    """
    why: Prose = ()
    for first, second in _parallel(context):
        of_first, of_second = (Letter("c", Row((Number(q.index), _J, _K))) for q in (first, second))
        rates = Sum(tuple(Symbol(q.name, 1) for q in (first, second)))
        why += (
            "The axes of joints ",
            *listed([Number(first.index), Number(second.index)]),
            " are parallel: velocities that come from joint j with ",
            Relation((Number(second.index), _J), ("≤",)),
            " are turned by them at the rate ",
            rates,
            ", so there ",
            equation(of_first, of_second),
            ". ",
        )
    return why


def _parallel(context: Context) -> Iterator[tuple[Coordinate, Coordinate]]:
    """Neighbouring joints that turn about the same direction, in the same sense."""
    robot = context.robot
    if robot.is_tree or not robot.has_table or not robot.moves_each_joint_alone or robot.actions.motors:
        return
    moving = [joint for joint in robot.joints if joint.type]
    for (q, joint), (following, after) in pairwise(zip(robot.coordinates, moving, strict=True)):
        if joint.type is after.type is JointType.REVOLUTE:
            here, there = (axis(context.values[f"H{joint_frame(robot, each)}"]) for each in (joint, after))
            if here == there:
                yield q, following
