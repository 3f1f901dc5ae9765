"""Joints that gravity does not load: their axes are vertical, or they slide level."""

from __future__ import annotations

from dynsolve.algebra import matrix as algebra
from dynsolve.derivation.jacobian import joint_frame
from dynsolve.derivation.kinematics import axis
from dynsolve.document import Prose
from dynsolve.explain.context import Context
from dynsolve.explain.step import Step
from dynsolve.explain.writing import listed, spong, turns
from dynsolve.notation.tree import Node, Number, equation
from dynsolve.quantities import letters
from dynsolve.quantities.stages import Stage
from dynsolve.robot.model import Coordinate


def unloaded_step(context: Context) -> Step | None:
    """The entries of g that must be zero, by the axes of the joints alone."""
    robot = context.robot
    if not robot.has_table or robot.gravity.is_zero or robot.actions.springs or robot.given is not None:
        return None
    free = [q for q in robot.coordinates if _is_level(context, q)]
    turning, sliding = [q for q in free if turns(q)], [q for q in free if not turns(q)]
    if not free or any(not context.values["g"][q.index - 1, 0].is_zero for q in free):
        return None
    why: Prose = ()
    for group, reason in (
        (turning, "turning about a vertical axis changes no height. "),
        (sliding, "sliding along a level axis changes no height. "),
    ):
        if group:
            why += (*listed([_zero(q) for q in group]), f": {reason}")
    return Step(
        id="unloaded",
        stage=Stage.VECTORIZED,
        title=f"Check: {'a joint' if len(free) == 1 else 'joints'} that gravity does not load",
        why=why,
        source=spong("7.2.3"),
        outcome=why,
        is_task=False,
    )


def _zero(q: Coordinate) -> Node:
    """g_k = 0"""
    return equation(letters.entry("g", q.index), Number(0))


def _is_level(context: Context, q: Coordinate) -> bool:
    """Whether a coordinate moves joints that turn about vertical axes, or slide along level ones, alone."""
    down = context.robot.gravity
    axes = [
        axis(context.values[f"H{joint_frame(context.robot, joint)}"])
        for joint, _ in context.robot.joints_of(q)
    ]
    if turns(q):
        return bool(axes) and all(algebra.cross(z, down).is_zero for z in axes)
    return bool(axes) and all((z.T @ down).is_zero for z in axes)
