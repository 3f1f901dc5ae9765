"""Where g is zero in every pose, or in none; the joints that gravity does not load.

In which poses it is zero, and what P has there, is a question of its own: `equilibria`.
"""

from __future__ import annotations

from dynsolve.algebra import matrix as algebra
from dynsolve.derivation.kinematics import axis, joint_frame
from dynsolve.document import Prose, Reference
from dynsolve.document.books import spong
from dynsolve.document.sentences import say
from dynsolve.explain.context import Context
from dynsolve.explain.sanity.determinant import sign_of
from dynsolve.explain.step import Step
from dynsolve.explain.writing import listed, turns
from dynsolve.notation.tree import ZERO, Relation, equation
from dynsolve.quantities import letters
from dynsolve.robot.model import Coordinate, JointType


def equilibrium_step(context: Context) -> Step | None:
    """That the arm needs no torques against gravity, whatever its pose, or some in every pose."""
    robot = context.robot
    if robot.gravity.is_zero or robot.given is not None or robot.actions.stored:
        return None
    if "equilibria" in context.wanted:
        return None
    if context.values["g"].is_zero:
        return _told(_everywhere(context))
    if robot.questions.constraints or robot.questions.loads:  # it is not gravity alone that is balanced
        return None
    return _nowhere(context)


def _told(why: Prose, outcome: Prose = ()) -> Step:
    """The step; its `outcome` may be what it says itself."""
    return Step(
        id="equilibrium",
        title="Check: where gravity is balanced",
        why=why,
        source=spong("7.2.3"),
        outcome=outcome or why,
        is_task=False,
    )


def _everywhere(context: Context) -> Prose:
    ring = context.robot.ring
    heights = [context.values[f"P{body.name}"] for body in context.robot.bodies]
    why = "some mass centres rise as others fall."
    if not any(ring.depends_on_coordinates(height) for height in heights):
        kinds = {q.type for q in context.robot.coordinates}
        what = "no torque" if JointType.REVOLUTE in kinds else "no force"
        what += " and no force" if len(kinds) > 1 else ""
        where = " at any joint" if context.robot.has_table else ""
        why = f"no mass centre changes its height, so gravity needs {what}{where}."
    return say(f"$𝐠 = 𝟎$ in every pose: {why}")


def _nowhere(context: Context) -> Step | None:
    """An entry of g that is 0 in no pose; None where there is none."""
    g = context.values["g"]
    k, sign = next(((k, sign) for k in range(context.robot.n) if (sign := sign_of(context, g[k, 0]))), (0, 0))
    if not sign:
        return None
    parts = (letters.entry("g", k + 1), context.named(context.show(g[k, 0])), ZERO)
    value = Relation(parts, ("=", ">" if sign > 0 else "<"))
    why = say(
        "{assumed}{value}{where} in every pose, so gravity is balanced in none.",
        assumed="Let all parameters be positive. " if context.robot.parameters else "",
        value=value,
        where=Reference(("g",), " in "),
    )
    return _told(why, outcome=say("Gravity is balanced in no pose: {value} in each.", value=value))


# -- joints that gravity does not load: their axes are vertical, or they slide level ---------------


def unloaded_step(context: Context) -> Step | None:
    """The entries of g that must be zero, by the axes of the joints alone."""
    robot = context.robot
    if not robot.has_table or robot.gravity.is_zero or robot.actions.stored or robot.given is not None:
        return None
    free = [q for q in robot.coordinates if _is_level(context, q)]
    if not free or any(not context.values["g"][q.index - 1, 0].is_zero for q in free):
        return None
    why: Prose = ()
    for turning, motion in ((True, "turning about a vertical axis"), (False, "sliding along a level axis")):
        none = listed([equation(letters.entry("g", q.index), ZERO) for q in free if turns(q) is turning])
        why += say("{none}: {motion} changes no height. ", none=none, motion=motion) if none else ()
    return Step(
        id="unloaded",
        title=f"Check: {'a joint' if len(free) == 1 else 'joints'} that gravity does not load",
        why=why,
        source=spong("7.2.3"),
        outcome=why,
        is_task=False,
    )


def _is_level(context: Context, q: Coordinate) -> bool:
    """Whether a coordinate moves joints that turn about vertical axes, or slide along level ones, alone."""
    robot, down = context.robot, context.robot.gravity
    axes = [axis(context.values[f"H{joint_frame(robot, joint)}"]) for joint, _ in robot.joints_of(q)]
    if turns(q):
        return bool(axes) and all(algebra.cross(z, down).is_zero for z in axes)
    return bool(axes) and all((z.T @ down).is_zero for z in axes)
