"""Why Christoffel symbols of joints with parallel axes are equal."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise

from dynsolve.derivation.jacobian import joint_frame
from dynsolve.derivation.kinematics import axis
from dynsolve.document import Prose
from dynsolve.explain.context import Context
from dynsolve.explain.writing import listed
from dynsolve.notation.tree import (
    Cross,
    Letter,
    Negative,
    Number,
    Parenthesized,
    Product,
    Relation,
    Row,
    Sum,
    Symbol,
    Transpose,
    equation,
)
from dynsolve.quantities import letters
from dynsolve.robot.model import Coordinate, JointType

_I, _J, _K = Symbol("i"), Symbol("j"), Symbol("k")


def on_parallel_axes(context: Context) -> Prose:
    """c_2jk = c_3jk where 3 ≤ j, of neighbours that turn about parallel axes.

    ∂²r/∂q_i ∂q_j = z_i × (∂r/∂q_j) of a point that joints i ≤ j move, and ∂(J_ω)_j/∂q_i = z_i × z_j,
    speak of joint i by the direction of its axis alone.
    """
    why: Prose = ()
    for first, second in _parallel(context):
        of_first, of_second = (Letter("c", Row((Number(q.index), _J, _K))) for q in (first, second))
        why += (
            "The axes of joints ",
            *listed([Number(first.index), Number(second.index)]),
            " are parallel, so ",
            equation(of_first, of_second),
            " where ",
            Relation((Number(second.index), _J), ("≤",)),
            ". ",
        )
    return (*_by_points(context), *why) if why else ()


def _by_points(context: Context) -> Prose:
    """c_ijk = Σ m (∂p/∂q_k)ᵀ ∂²p/∂q_i∂q_j over points p; joint i ≤ j turns ∂p/∂q_j about its axis."""
    p = letters.ANY_POINT
    by_j, by_k = (letters.partial_derivative(p, Letter("q", index)) for index in (_J, _K))
    axis_of_i = letters.bold("z", Sum((_I, Negative(Number(1)))) if context.standard else _I)
    slope = letters.partial_derivative(by_j, Letter("q", _I))
    return (
        Letter("d", Row((_J, _K))),
        " is the sum over all points ",
        p,
        " of the bodies of their mass times ",
        Product((Transpose(Parenthesized(by_k)), by_j)),
        ". Put into the formula below, four of six terms cancel: ",
        Letter("c", Row((_I, _J, _K))),
        " is the sum of the masses times ",
        Product((Transpose(Parenthesized(by_k)), slope)),
        ". Where ",
        Relation((_I, _J), ("≤",)),
        ", joint i turns ",
        by_j,
        " about its axis: ",
        equation(slope, Cross(axis_of_i, by_j)),
        ". ",
    )


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
