"""Where g is zero: in every pose, or in poses of quarter turns, hanging and upright among them."""

from __future__ import annotations

from dynsolve.algebra.generators import Pair
from dynsolve.derivation.stability import Stability
from dynsolve.document import Inline, Prose, Table
from dynsolve.explain.context import Context
from dynsolve.explain.sanity.definite import determinant
from dynsolve.explain.sanity.pose import Pose, at, poses, turning_in, written
from dynsolve.explain.sanity.sign import is_positive, with_lengths
from dynsolve.explain.step import Step
from dynsolve.explain.writing import listed, side_by_side, spong
from dynsolve.notation.tree import Node, Row, Symbol, Words, equation
from dynsolve.quantities import letters
from dynsolve.quantities.stages import Stage
from dynsolve.robot.model import JointType

QUARTER_TURNS = (0, 90, 180, -90)

Verdicts = dict[frozenset[tuple[str, int]], Stability]
"""How stable a pose is, by its angles in degrees."""


def equilibrium_step(context: Context) -> Step | None:
    """The poses in which the arm needs no torques against gravity, with what P has there."""
    robot = context.robot
    if robot.gravity.is_zero or robot.given is not None or robot.actions.springs:
        return None
    table: Table | None = None
    if context.values["g"].is_zero:
        why = _everywhere(context)
    else:
        found = _in_poses(context)
        if found is None:
            return None
        why, table = found
    return Step(
        id="equilibrium",
        stage=Stage.VECTORIZED,
        title="Check: where gravity is balanced",
        why=why,
        source=spong("7.2.3"),
        table=table,
        is_task=False,
    )


def _everywhere(context: Context) -> Prose:
    """Why g is zero in every pose."""
    ring = context.robot.ring
    heights = [context.values[f"P{body.name}"] for body in context.robot.bodies]
    zero = (equation(letters.G, letters.bold("0")), " in every pose: ")
    if any(ring.depends_on_coordinates(height) for height in heights):
        return (*zero, "some mass centres rise as others fall.")
    kinds = {q.type for q in context.robot.coordinates}
    what = "no torque" if JointType.REVOLUTE in kinds else "no force"
    what += " and no force" if len(kinds) > 1 else ""
    return (*zero, f"no mass centre changes its height, so gravity needs {what} at any joint.")


# -- in some poses ---------------------------------------------------------------------------------


def _in_poses(context: Context) -> tuple[Prose, Table] | None:
    """The poses in which g is zero, and what P has there: all of them, or those where it is an extremum."""
    zero = _balanced(context)
    if not zero:
        return None
    verdicts = _all_quarter_turns(context)
    all_told = verdicts is not None and len(verdicts) == len(zero)
    rows = [row for pose in zero if (row := _row(context, pose, verdicts if all_told else None))]
    if not rows:
        return None
    why: Prose = ("Let all parameters be positive. ",) if context.robot.parameters else ()
    why += (equation(letters.G, letters.bold("0")), f" {'exactly ' * all_told}in ")
    why += ("this pose" if len(rows) == 1 else "these poses", *_free(context, zero[0]), ":")
    return why, Table(("pose", "potential energy", "equilibrium"), tuple(rows))


def _free(context: Context, pose: Pose) -> Prose:
    """The coordinates that g does not depend on."""
    free = [Symbol(q.name) for q in context.robot.coordinates if q.name not in pose]
    return (", whatever ", *listed(free), " is" if len(free) == 1 else " are") if free else ()


def _row(context: Context, pose: Pose, verdicts: Verdicts | None) -> tuple[Inline, ...] | None:
    """A pose, what P has there, how stable that is; None where only extrema are told, and it is none."""
    whole = len(pose) == context.robot.n
    shown = side_by_side(written(pose))
    if _is_definite(context, pose, 1):
        told = f"minimum: the {context.machine} hangs" if whole else "minimum"
        return shown, told, "stable" if whole else _stable_in(pose)
    if _is_definite(context, pose, -1):
        told = f"maximum: the {context.machine} stands upright" if whole else "maximum"
        return shown, told, "unstable"
    if verdicts is None:
        return None
    unstable = verdicts[frozenset(pose.items())] is Stability.UNSTABLE
    return shown, "decreases in some direction" if unstable else "", "unstable" if unstable else "undecided"


def _stable_in(pose: Pose) -> Row:
    """The coordinates that gravity holds, where it does not hold the others: these drift once they move."""
    parts = listed([Symbol(name) for name in pose])
    return Row(
        (Words("stable in "), *(part if isinstance(part, Node) else Words(str(part)) for part in parts))
    )


def _all_quarter_turns(context: Context) -> Verdicts | None:
    """How stable each zero of g is, where all are quarter turns whatever the parameters."""
    from dynsolve.derivation.equilibria import Equilibria, equilibria

    found = equilibria(context.robot, context.values["g"])
    if not isinstance(found, Equilibria) or any(found.exist):
        return None
    verdicts: Verdicts = {}
    for alternative, points in zip(found.alternatives, found.points, strict=True):
        if not points or any(len(point.values) < len(alternative) for point in points):
            return None
        for point in points:
            verdicts[frozenset(map(_turn, point.values))] = point.stability
    return verdicts


def _turn(value: tuple[Pair, int, int]) -> tuple[str, int]:
    """A coordinate and its quarter turn in degrees."""
    pair, sine, cosine = value
    ((atom, _),) = pair.angle.terms
    return atom[0][0], 90 * sine if sine else 90 - 90 * cosine


def balanced_poses(context: Context) -> tuple[Pose | None, Pose | None]:
    """The poses of quarter turns in which P surely has a minimum, and a maximum."""
    zero = _balanced(context)
    hanging = next((pose for pose in zero if _is_definite(context, pose, 1)), None)
    upright = next((pose for pose in zero if _is_definite(context, pose, -1)), None)
    return hanging, upright


def _balanced(context: Context) -> list[Pose]:
    """The poses of quarter turns in which g is zero; none where a length changes the potential energy."""
    g = context.values["g"].entries
    names = turning_in(context.robot, *g)
    if not names or _slides(context):
        return []
    return [pose for pose in poses(names, QUARTER_TURNS) if all(at(x.ring, x, pose).is_zero for x in g)]


def _slides(context: Context) -> bool:
    """Whether a length among the coordinates changes the potential energy."""
    robot, P = context.robot, context.values["P"]
    lengths = (k for k, q in enumerate(robot.coordinates) if q.type is JointType.PRISMATIC)
    return any(not robot.ring.diff(P, k).is_zero for k in lengths)


def _is_definite(context: Context, pose: Pose, sign: int) -> bool:
    """Whether ± ∂²P/∂q² is positive definite in a pose, by its leading minors."""
    ring, names = context.robot.ring, list(pose)
    places = [ring.names.index(name) for name in names]
    g = context.values["g"]
    second = [[at(ring, ring.diff(g[i, 0], j), pose) * sign for j in places] for i in places]
    minors = (determinant([row[:size] for row in second[:size]]) for size in range(1, len(places) + 1))
    positive, constant = with_lengths(context.robot), frozenset(ring.parameters)
    return all(is_positive(context.show(minor), positive, constant) for minor in minors)
