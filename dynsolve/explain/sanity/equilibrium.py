"""Where g is zero: in every pose, or hanging and upright in poses of right angles."""

from __future__ import annotations

from dynsolve.document import Prose
from dynsolve.explain.context import Context
from dynsolve.explain.sanity.definite import determinant
from dynsolve.explain.sanity.pose import Pose, at, poses, turning_in, written
from dynsolve.explain.sanity.sign import is_positive, with_lengths
from dynsolve.explain.step import Step
from dynsolve.explain.writing import listed, spong
from dynsolve.notation.tree import Symbol, equation
from dynsolve.quantities import letters
from dynsolve.quantities.stages import Stage
from dynsolve.robot.model import JointType

RIGHT_ANGLES = (0, 90, 180, -90)


def equilibrium_step(context: Context) -> Step | None:
    """The poses in which the arm needs no torques against gravity, with what P has there."""
    robot = context.robot
    if robot.gravity.is_zero or robot.given is not None or robot.actions.springs:
        return None
    why = _everywhere(context) if context.values["g"].is_zero else _hanging_and_upright(context)
    if not why:
        return None
    return Step(
        id="equilibrium",
        stage=Stage.VECTORIZED,
        title="Check: where gravity is balanced",
        why=why,
        source=spong("7.2.3"),
        is_task=False,
    )


def _everywhere(context: Context) -> Prose:
    """Why g is zero in every pose."""
    ring = context.robot.ring
    heights = [context.values[f"P{body.name}"] for body in context.robot.bodies]
    zero = (equation(letters.G, letters.bold("0")), " in every pose: ")
    if any(ring.depends_on_coordinates(height) for height in heights):
        return (*zero, "some mass centres rise as others fall.")
    return (*zero, "no mass centre changes its height, so gravity needs no torque and no force of a joint.")


def _hanging_and_upright(context: Context) -> Prose:
    hanging, upright = balanced_poses(context)
    why: Prose = ()
    if hanging is not None:
        why += (*_zero_at(hanging), f"minimum: the {context.machine} hangs; the equilibrium is stable")
        why += (*_in_what_moves(context, hanging), ". ")
    if upright is not None:
        why += (
            *_zero_at(upright),
            f"maximum: the {context.machine} stands upright; the equilibrium is unstable. ",
        )
    if not why:
        return ()
    assumed = ("Let all lengths be positive. ",) if context.robot.parameters else ()
    number = len(_balanced(context))
    others = (f"Gravity is balanced in {number} poses of right angles in all.",) if number > 2 else ()
    return (*assumed, *why, *others)


def _in_what_moves(context: Context, pose: Pose) -> Prose:
    """The coordinates that gravity holds, where it does not hold the others: these drift once they move."""
    if len(pose) == context.robot.n:
        return ()
    return (" in ", *listed([Symbol(name) for name in pose]))


def balanced_poses(context: Context) -> tuple[Pose | None, Pose | None]:
    """The poses of right angles in which P surely has a minimum, and a maximum."""
    zero = _balanced(context)
    hanging = next((pose for pose in zero if _is_definite(context, pose, 1)), None)
    upright = next((pose for pose in zero if _is_definite(context, pose, -1)), None)
    return hanging, upright


def _balanced(context: Context) -> list[Pose]:
    """The poses of right angles in which g is zero; none where a length changes the potential energy."""
    g = context.values["g"].entries
    names = turning_in(context.robot, *g)
    if not names or _slides(context):
        return []
    return [pose for pose in poses(names, RIGHT_ANGLES) if all(at(x.ring, x, pose).is_zero for x in g)]


def _slides(context: Context) -> bool:
    """Whether a length among the coordinates changes the potential energy."""
    robot, P = context.robot, context.values["P"]
    lengths = (k for k, q in enumerate(robot.coordinates) if q.type is JointType.PRISMATIC)
    return any(not robot.ring.diff(P, k).is_zero for k in lengths)


def _zero_at(pose: Pose) -> Prose:
    return ("At ", *listed(written(pose)), ", ", letters.G, " is zero and ", letters.P, " has a ")


def _is_definite(context: Context, pose: Pose, sign: int) -> bool:
    """Whether ± ∂²P/∂q² is positive definite in a pose, by its leading minors."""
    ring, names = context.robot.ring, list(pose)
    places = [ring.names.index(name) for name in names]
    g = context.values["g"]
    second = [[at(ring, ring.diff(g[i, 0], j), pose) * sign for j in places] for i in places]
    minors = (determinant([row[:size] for row in second[:size]]) for size in range(1, len(places) + 1))
    positive, constant = with_lengths(context.robot), frozenset(ring.parameters)
    return all(is_positive(context.show(minor), positive, constant) for minor in minors)
