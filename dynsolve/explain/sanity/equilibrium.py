"""Where g is zero: in every pose, in none, or in poses of quarter turns, hanging and upright among them.

Where g = 0 is solved row by row (`balance`), all poses are found; what P has there is read off its
second derivatives (`curvature`).  Else those poses are told in which P surely has an extremum.
Where a joint slides up and down, `sliding` has the answer.
"""

from __future__ import annotations

from collections.abc import Sequence

from dynsolve.algebra.matrix import cross
from dynsolve.derivation.kinematics import origin
from dynsolve.document import Inline, Prose, Reference, Table
from dynsolve.explain.context import Context
from dynsolve.explain.sanity import balance, cases, curvature, sliding
from dynsolve.explain.sanity.at_rest import assumed, at_rest, free, in_no_others, told
from dynsolve.explain.sanity.curvature import Kind
from dynsolve.explain.sanity.pose import Pose, at, poses, turning_in, written
from dynsolve.explain.step import Line, Step
from dynsolve.explain.writing import as_row, listed, side_by_side
from dynsolve.notation.tree import Row, Symbol, equation
from dynsolve.quantities import letters
from dynsolve.robot.model import JointType

QUARTER_TURNS = (0, 90, 180, -90)


def equilibrium_step(context: Context) -> Step | None:
    """The poses in which the arm needs no torques against gravity, with what P has there."""
    robot = context.robot
    if robot.gravity.is_zero or robot.given is not None or robot.actions.springs:
        return None
    if context.values["g"].is_zero:
        return told(_everywhere(context))
    if (nowhere := sliding.nowhere(context)) is not None:
        return nowhere
    if _slides(context):
        return sliding.at_one_length(context)
    zero = _balanced(context)
    return (_all_poses(context, zero) or _extrema(context, zero)) if zero else None


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


def _all_poses(context: Context, zero: Sequence[Pose]) -> Step | None:
    """All poses in which g is zero, by its rows; None where these do not give them, or what P has there."""
    names = list(zero[0])
    rows = balance.zeros(context)
    if rows is not None and len(rows) == len(names):  # each row leaves two quarter turns of an angle
        lines = (Line((), tuple(balance.written(context, row) for row in rows)),)
        return _told_of_all(context, zero, lines, rows)
    by_cases = cases.cases(context, names) if rows is None else None
    return None if by_cases is None else _told_of_all(context, by_cases.poses, by_cases.lines, None)


def _told_of_all(
    context: Context, zero: Sequence[Pose], lines: Sequence[Line], rows: Sequence[balance.Zero] | None
) -> Step | None:
    """What P has in each of the poses, by its second derivatives; None where a sign is not seen.

    `rows` are the zeros that are put into these, None where they differ from case to case.
    """
    names = list(zero[0])
    minors = curvature.minors(context, names, rows or ())
    signs = [curvature.signs_of(context, minors, pose) for pose in zero]
    kinds = [kind for each in signs if (kind := curvature.kind_of(each)) is not None]
    if len(kinds) != len(zero):
        return None
    shows = len(names) <= curvature.MOST_SHOWN
    found = (
        (*_signs(each, shows), *_told(context, pose, kind))
        for pose, each, kind in zip(zero, signs, kinds, strict=True)
    )
    table = tuple((side_by_side(written(pose)), *row) for pose, row in zip(zero, found, strict=True))
    shown = (_second_derivatives(context, names, rows),) if shows else ()
    concluding: Prose = (
        in_no_others(f"the pose{'s' * (len(zero) > 1)} of the table"),
        *free(context, zero[0]),
        ". ",
        *_by_minors(context, names),
    )
    why = (*at_rest(context), *assumed(context), *_rows_of(context, rows))
    poses = Table(_header(context, names), table)
    return told(why, (*lines, *shown), concluding, poses, _counted(context, zero, kinds))


def _counted(context: Context, zero: Sequence[Pose], kinds: Sequence[Kind]) -> Prose:
    """In how many poses gravity is balanced, and at which the equilibrium is stable."""
    poses = "one pose" if len(zero) == 1 else f"{len(zero)} poses"
    where: Prose = (f"Gravity is balanced in {poses} (up to full turns)", *free(context, zero[0]), "; ")
    return (*where, *_minima(zero, kinds))


def _minima(zero: Sequence[Pose], kinds: Sequence[Kind]) -> Prose:
    """In which poses P has a minimum."""
    stable = [
        side_by_side(written(pose)) for pose, kind in zip(zero, kinds, strict=True) if kind is Kind.MINIMUM
    ]
    if not stable:
        return ("the potential energy has a minimum in none.",)
    return ("the potential energy has a minimum at ", *listed(stable), ".")


def _rows_of(context: Context, rows: Sequence[balance.Zero] | None) -> Prose:
    """How the rows of g are gone through."""
    found = (letters.G, Reference(("g",), " in "))
    if rows is None:
        return ("A row of ", *found, " is 0 where one of its factors is:")
    if len(rows) == 1 and context.robot.n > 1:
        only = letters.entry("g", rows[0].row + 1)
        return ("Of the entries of ", *found, " only ", only, " is not identically 0:")
    if len(rows) == 1:
        return ("The only row of ", *found, ":")
    return ("The rows of ", *found, ", from the last row up, each result put into the row above:")


def _by_minors(context: Context, names: Sequence[str]) -> Prose:
    """How what P has in a pose is found, by the number of angles."""
    if len(names) == 1:
        where: Prose = ("a minimum where the second derivative is positive, a maximum where it is negative",)
    elif len(names) == 2:
        where = ("a minimum where ", curvature.slope_of_last(context, names), " and det are positive, ")
        where += ("a maximum where det alone is (Sylvester's criterion), ",)
        where += ("a saddle point where det is negative",)
    else:
        where = ("a minimum where all the leading minors of its second derivatives are positive (Sylvester's "
                 "criterion)",)  # fmt: skip
    stable: Prose = ("; at a minimum the equilibrium is stable",)
    if len(names) < context.robot.n:  # nothing holds the others
        stable += (" in ", *listed([Symbol(name) for name in names]))
    return (letters.P, " has ", *where, *stable, ", elsewhere it is not:")


def _second_derivatives(context: Context, names: Sequence[str], rows: Sequence[balance.Zero] | None) -> Line:
    if len(names) == 1:
        return Line(
            ("The second derivative of ", letters.P, ":"), tuple(curvature.shown(context, names, rows))
        )
    of_some: Prose = ()
    if len(names) < context.robot.n:
        of_some = (
            " with respect to ",
            *listed([Symbol(name) for name in names]),
            " (it depends on no other coordinate)",
        )
    by = ("The second derivatives of ", letters.P, *of_some, "; det is the determinant of their matrix")
    by += (*curvature.how_multiplied(context, names, rows), ":")
    return Line(by, tuple(curvature.shown(context, names, rows)))


def _header(context: Context, names: Sequence[str]) -> tuple[Inline, ...]:
    slope = curvature.slope_of_last(context, names)
    of_minors: tuple[Inline, ...] = {1: (slope,), 2: (slope, "det")}.get(len(names), ())
    return ("pose", *of_minors, "potential energy", "equilibrium")


def _signs(signs: Sequence[int], shows: bool) -> tuple[str, ...]:
    return tuple({1: "> 0", 0: "", -1: "< 0"}[sign] for sign in signs) if shows else ()


def _told(context: Context, pose: Pose, kind: Kind) -> tuple[Inline, Inline]:
    """What P has in a pose, and how stable that is."""
    whole = len(pose) == context.robot.n
    is_upright = whole and _is_vertical(context, pose)
    match kind:
        case Kind.MINIMUM:
            what = f"{kind}: the {context.machine} hangs" if is_upright else kind.value
            return what, "stable" if whole else _stable_in(pose)
        case Kind.MAXIMUM:
            return f"{kind}: the {context.machine} stands upright" if is_upright else kind.value, "unstable"
        case Kind.SADDLE:
            return kind.value, "unstable"


def _is_vertical(context: Context, pose: Pose) -> bool:
    """Whether all origins and mass centres lie on one vertical line."""
    values, ring, gravity = context.values, context.robot.ring, context.robot.gravity
    frames = [values[name] for k in range(len(context.robot.joints) + 1) if (name := f"H{k}") in values]
    mass_centres = [values[f"rc{body.name}"] for body in context.robot.bodies]
    points = [origin(H) for H in frames] + mass_centres
    offsets = ((point - points[0]).map(lambda x: at(ring, x, pose)) for point in points)
    return all(cross(offset, gravity).is_zero for offset in offsets)


def _stable_in(pose: Pose) -> Row:
    """The coordinates that gravity holds, where it does not hold the others: these drift once they move."""
    return as_row(("stable in ", *listed([Symbol(name) for name in pose])))


def _extrema(context: Context, zero: Sequence[Pose]) -> Step | None:
    """The poses in which P surely has a minimum or a maximum."""
    found = [(pose, kind) for pose in zero if (kind := _kind(context, pose)) in (Kind.MINIMUM, Kind.MAXIMUM)]
    if not found:
        return None
    rows = [(side_by_side(written(pose)), *_told(context, pose, kind)) for pose, kind in found]
    why = (*assumed(context), equation(letters.G, letters.bold("0")))
    outcome = ("Of the poses in which gravity is balanced, ", *_minima(*zip(*found, strict=True)))
    why += (" in this pose" if len(rows) == 1 else " in these poses", *free(context, zero[0]), ":")
    poses = Table(("pose", "potential energy", "equilibrium"), tuple(rows))
    return told(why, table=poses, outcome=outcome)


def _kind(context: Context, pose: Pose) -> Kind | None:
    """What P has in a pose of quarter turns."""
    return curvature.kind_of(curvature.signs_of(context, curvature.minors(context, list(pose)), pose))


def _balanced(context: Context) -> list[Pose]:
    """The poses of quarter turns in which g is zero."""
    g = context.values["g"].entries
    names = turning_in(context.robot, *g)
    if not names:
        return []
    return [pose for pose in poses(names, QUARTER_TURNS) if all(at(x.ring, x, pose).is_zero for x in g)]


def _slides(context: Context) -> bool:
    """Whether a length among the coordinates changes the potential energy."""
    robot, P = context.robot, context.values["P"]
    lengths = (k for k, q in enumerate(robot.coordinates) if q.type is JointType.PRISMATIC)
    return any(not robot.ring.diff(P, k).is_zero for k in lengths)
