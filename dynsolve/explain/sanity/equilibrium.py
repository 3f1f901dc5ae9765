"""Where g is zero: in every pose, in none, or in poses of quarter turns, hanging and upright among them.

Where g = 0 is solved row by row (`balance`), all poses are found; what P has there is read off its
second derivatives (`curvature`).  Else those poses are told in which P surely has an extremum.
Where a joint slides up and down, `sliding` has the answer.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import lcm

from dynsolve.algebra.expr import Expr
from dynsolve.algebra.matrix import cross
from dynsolve.derivation.kinematics import origin
from dynsolve.document import Inline, Prose, Reference, Table
from dynsolve.explain.context import Context
from dynsolve.explain.sanity.balance import (
    MOST_SHOWN,
    Kind,
    Zero,
    assumed,
    at_rest,
    free,
    how_multiplied,
    in_no_others,
    kind_of,
    leading_minors,
    shown,
    signs_of,
    slope,
    slope_of_last,
    told,
    written_zero,
    zeros,
)
from dynsolve.explain.sanity.determinant import cases, is_positive, sign_of, solved, with_lengths
from dynsolve.explain.sanity.poses import Pose, at, degrees, poses, turning_in, written_pose
from dynsolve.explain.step import Line, Step
from dynsolve.explain.working.derivatives import are_alike
from dynsolve.explain.working.squares import without_signs
from dynsolve.explain.writing import as_row, listed, side_by_side, sum_of
from dynsolve.notation.build import times, total
from dynsolve.notation.tree import (
    ZERO,
    Negative,
    Node,
    Number,
    Parenthesized,
    Power,
    Quotient,
    Relation,
    Row,
    Sum,
    Symbol,
    Words,
    equation,
)
from dynsolve.quantities import letters
from dynsolve.robot.model import JointType


def rests_nowhere(context: Context) -> Step | None:
    """An entry of g that is 0 in no pose; None where there is none."""
    g = context.values["g"]
    k, sign = next(((k, sign) for k in range(context.robot.n) if (sign := sign_of(context, g[k, 0]))), (0, 0))
    if not sign:
        return None
    value = Relation(
        (letters.entry("g", k + 1), context.show(g[k, 0]), ZERO), ("=", ">" if sign > 0 else "<")
    )
    why: Prose = (*at_rest(context), *assumed(context), "But ", value, Reference(("g",), " in "))
    outcome = ("Gravity is balanced in no pose: ", value, " in each.")
    return told((*why, " in every pose, so gravity is balanced in none."), outcome=outcome)


def at_one_length(context: Context) -> Step | None:
    """The two poses in which the axis of sliding is level, each with the length that balances the moments."""
    robot, g = context.robot, context.values["g"]
    loaded = [k for k in range(robot.n) if not g[k, 0].is_zero]
    slides = [k for k in loaded if robot.coordinates[k].type is JointType.PRISMATIC]
    angles = turning_in(robot, *g.entries)
    if len(loaded) != 2 or len(slides) != 1 or angles is None or len(angles) != 1:
        return None
    (turned,) = (k for k in loaded if k not in slides)
    (slid,), (angle,) = slides, angles
    level = solved(context, g[slid, 0], angle)
    if level is None or robot.ring.depends_on_coordinates(robot.ring.diff(g[slid, 0], slid)):
        return None
    said, values = level
    poses = [_moment(context, turned, slid, {angle: value}) for value in values]
    lengths = {pose.length for pose in poses if pose is not None}
    if None in poses or len(lengths) != 1:
        return None
    either = equation(Symbol(angle), Row((degrees(values[0]), Words(" or "), degrees(values[1]))))
    zero = equation(letters.entry("g", slid + 1), context.show(g[slid, 0]), ZERO)
    rows = (Row((zero, Words(", so "), said, Words(", "), either)), *(pose.zero for pose in poses if pose))
    name = robot.coordinates[slid].name
    why = (*at_rest(context), *assumed(context), "The rows of ", letters.G, Reference(("g",), " in "))
    why += ("; what ", equation(letters.entry("g", slid + 1), ZERO), " says is put into the other:")
    balanced = equation(Symbol(name), *lengths)
    only = in_no_others("this pose" if len(values) == 1 else "these poses")
    concluding: Prose = ("So ", balanced, " in both. ", only)
    concluding += (*free(context, (angle, name)), ". ", *_saddles(context, slid, turned))
    concluding += _not_extended(context, name, *lengths)
    outcome = (
        "Gravity is balanced in two poses, with ",
        balanced,
        ": saddle points of the potential energy.",
    )
    return told(why, (Line((), rows),), concluding, outcome=outcome)


@dataclass(frozen=True, slots=True)
class _Moment:
    """The moment of gravity in a pose, as an equation that it is 0, and the length at which it is."""

    zero: Node
    length: Node


def _moment(context: Context, row: int, slid: int, pose: Pose) -> _Moment | None:
    """θ = 180°: g_2 = -g (m_2 l_c2 + m_3 d_3) = 0, and -m_2 l_c2/m_3"""
    ring, d = context.robot.ring, Symbol(context.robot.coordinates[slid].name)
    value = at(ring, context.values["g"][row, 0], pose)
    by_d = ring.diff(value, slid)
    rest = value - by_d * ring.symbol(d.name)
    if not sign_of(context, by_d) or ring.depends_on_coordinates(rest):
        return None
    common, factor, constant = _parts(context, by_d, rest)
    linear = total([times(1, [(context.show(factor), 1), (d, 1)]), context.show(constant)])
    shown, collected = context.show(value), times(1, [(context.show(common), 1), (linear, 1)])
    members = (shown,) if are_alike(shown, collected) else (shown, collected)
    zero = Row((*written_pose(pose), Words(": "), equation(letters.entry("g", row + 1), *members, ZERO)))
    return _Moment(zero, _length(context, factor, constant))


def _parts(context: Context, by_d: Expr, rest: Expr) -> tuple[Expr, Expr, Expr]:
    """p, a, b of by_d = p a and rest = p b; a is positive, a and b have no fraction and no common factor."""
    ring, sign = rest.ring, sign_of(context, by_d)
    common = rest.poly.gcd(by_d.poly)
    a, b = (Expr(ring, each.poly / common) * sign for each in (by_d, rest))
    whole = lcm(*(int(each.poly.factor()[0].q) for each in (a, b) if not each.is_zero))
    return Expr(ring, common) * sign / whole, a * whole, b * whole


def _length(context: Context, a: Expr, b: Expr) -> Node:
    """Where a d + b = 0: d = -b/a"""
    if a.is_number or b.is_zero:
        return context.show(-b / a.number) if a.is_number else ZERO
    if sign_of(context, b) > 0:
        return Negative(Quotient(context.show(b), context.show(a)))
    return Quotient(context.show(-b), context.show(a))


def _saddles(context: Context, slid: int, turned: int) -> Prose:
    """Why P has a saddle point there: g_d does not depend on d, but on the angle it does."""
    names = [context.robot.coordinates[k].name for k in (slid, turned)]
    by_d, by_angle = (slope(context, names[0], name) for name in names)
    ring, place = context.robot.ring, context.robot.ring.names.index(names[1])
    rate = context.show(ring.diff(context.values["g"][slid, 0], place))
    det, value = (Negative(Power(x, Number(2))) for x in (Parenthesized(by_angle), without_signs(rate)))
    why: Prose = ("In both ", letters.P, " has a saddle point: as ", equation(by_d, ZERO))
    why += (", the determinant of the symmetric matrix of its second derivatives with respect to ",)
    why += (
        Symbol(names[1]),
        " and ",
        Symbol(names[0]),
        " is ",
        equation(det, value),
        ", which is negative there. So they are unstable.",
    )
    return why


def _not_extended(context: Context, name: str, length: Node) -> Prose:
    """That the length is on the other side of 0, where it is seen to be."""
    positive, constant = with_lengths(context.robot), frozenset(context.robot.ring.parameters)
    if isinstance(length, Quotient) and isinstance(length.numerator, Sum):
        return _where_extended(name, length.numerator.terms)
    if not isinstance(length, Negative) or not is_positive(length.argument, positive, constant):
        return ()
    return (" With ", Relation((Symbol(name), ZERO), (">",)), " no pose is balanced.")


def _where_extended(name: str, terms: Sequence[Node]) -> Prose:
    """Where the length is on the side of 0 that it should be: its positive terms are the larger ones."""
    positive = [term for term in terms if not isinstance(term, Negative)]
    negative = [term.argument for term in terms if isinstance(term, Negative)]
    if not (positive and negative):
        return ()
    where = Relation((sum_of(negative), sum_of(positive)), ("<",))
    return (" Here ", Relation((Symbol(name), ZERO), (">",)), " only if ", where, ".")


QUARTER_TURNS = (0, 90, 180, -90)


def equilibrium_step(context: Context) -> Step | None:
    """The poses in which the arm needs no torques against gravity, with what P has there."""
    robot = context.robot
    if robot.gravity.is_zero or robot.given is not None or robot.actions.springs:
        return None
    if context.values["g"].is_zero:
        return told(_everywhere(context))
    if (nowhere := rests_nowhere(context)) is not None:
        return nowhere
    if _slides(context):
        return at_one_length(context)
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
    rows = zeros(context)
    if rows is not None and len(rows) == len(names):  # each row leaves two quarter turns of an angle
        lines = (Line((), tuple(written_zero(context, row) for row in rows)),)
        return _told_of_all(context, zero, lines, rows)
    by_cases = cases(context, names) if rows is None else None
    return None if by_cases is None else _told_of_all(context, by_cases.poses, by_cases.lines, None)


def _told_of_all(
    context: Context, zero: Sequence[Pose], lines: Sequence[Line], rows: Sequence[Zero] | None
) -> Step | None:
    """What P has in each of the poses, by its second derivatives; None where a sign is not seen.

    `rows` are the zeros that are put into these, None where they differ from case to case.
    """
    names = list(zero[0])
    minors = leading_minors(context, names, rows or ())
    signs = [signs_of(context, minors, pose) for pose in zero]
    kinds = [kind for each in signs if (kind := kind_of(each)) is not None]
    if len(kinds) != len(zero):
        return None
    shows = len(names) <= MOST_SHOWN
    found = (
        (*_signs(each, shows), *_told(context, pose, kind))
        for pose, each, kind in zip(zero, signs, kinds, strict=True)
    )
    table = tuple((side_by_side(written_pose(pose)), *row) for pose, row in zip(zero, found, strict=True))
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
        side_by_side(written_pose(pose))
        for pose, kind in zip(zero, kinds, strict=True)
        if kind is Kind.MINIMUM
    ]
    if not stable:
        return ("the potential energy has a minimum in none.",)
    return ("the potential energy has a minimum at ", *listed(stable), ".")


def _rows_of(context: Context, rows: Sequence[Zero] | None) -> Prose:
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
        where = ("a minimum where ", slope_of_last(context, names), " and det are positive, ")
        where += ("a maximum where det alone is (Sylvester's criterion), ",)
        where += ("a saddle point where det is negative",)
    else:
        where = ("a minimum where all the leading minors of its second derivatives are positive (Sylvester's "
                 "criterion)",)  # fmt: skip
    stable: Prose = ("; at a minimum the equilibrium is stable",)
    if len(names) < context.robot.n:  # nothing holds the others
        stable += (" in ", *listed([Symbol(name) for name in names]))
    return (letters.P, " has ", *where, *stable, ", elsewhere it is not:")


def _second_derivatives(context: Context, names: Sequence[str], rows: Sequence[Zero] | None) -> Line:
    if len(names) == 1:
        return Line(("The second derivative of ", letters.P, ":"), tuple(shown(context, names, rows)))
    of_some: Prose = ()
    if len(names) < context.robot.n:
        of_some = (
            " with respect to ",
            *listed([Symbol(name) for name in names]),
            " (it depends on no other coordinate)",
        )
    by = ("The second derivatives of ", letters.P, *of_some, "; det is the determinant of their matrix")
    by += (*how_multiplied(context, names, rows), ":")
    return Line(by, tuple(shown(context, names, rows)))


def _header(context: Context, names: Sequence[str]) -> tuple[Inline, ...]:
    slope = slope_of_last(context, names)
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
    rows = [(side_by_side(written_pose(pose)), *_told(context, pose, kind)) for pose, kind in found]
    why = (*assumed(context), equation(letters.G, letters.bold("0")))
    outcome = ("Of the poses in which gravity is balanced, ", *_minima(*zip(*found, strict=True)))
    why += (" in this pose" if len(rows) == 1 else " in these poses", *free(context, zero[0]), ":")
    poses = Table(("pose", "potential energy", "equilibrium"), tuple(rows))
    return told(why, table=poses, outcome=outcome)


def _kind(context: Context, pose: Pose) -> Kind | None:
    """What P has in a pose of quarter turns."""
    return kind_of(signs_of(context, leading_minors(context, list(pose)), pose))


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
