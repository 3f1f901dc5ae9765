"""Where g is zero: in every pose, in none, or in poses of quarter turns, hanging and upright among them.

Where g = 0 is solved row by row, all poses are found: a row that one sine or cosine makes 0 says where, and
is put into the others.  What P has there is read off its second derivatives.  Else those poses are told in
which P surely has an extremum.  Where a joint slides up and down, the pose has one length.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence
from enum import StrEnum
from itertools import chain
from math import lcm

from msgspec import Struct

from dynsolve.algebra import matrix as algebra
from dynsolve.algebra.angles import angle_node
from dynsolve.algebra.expr import Expr, Generator
from dynsolve.algebra.matrix import cross
from dynsolve.derivation.kinematics import axis, joint_frame, origin
from dynsolve.document import Inline, Prose, Reference, Table
from dynsolve.document.sentences import say
from dynsolve.explain.context import Context
from dynsolve.explain.named_steps import looked_at, put_in
from dynsolve.explain.sanity.definite import determinant
from dynsolve.explain.sanity.determinant import cases, is_positive, sign_of, solved, with_lengths
from dynsolve.explain.sanity.poses import Pose, at, degrees, poses, turning_in, written_pose
from dynsolve.explain.step import Line, Step
from dynsolve.explain.terms import driving_side
from dynsolve.explain.working.identities import are_alike
from dynsolve.explain.working.squares import without_signs
from dynsolve.explain.writing import as_row, listed, side_by_side, spong, sum_of, turns
from dynsolve.notation.build import times, total
from dynsolve.notation.template import formula
from dynsolve.notation.tree import (
    ZERO,
    Degrees,
    Negative,
    Node,
    Number,
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
from dynsolve.robot.model import Coordinate, JointType


class Zero(Struct, frozen=True):
    """Row `row` of g, from 0, is `value` once the zeros before it are put in: 0 where a sine or cosine is."""

    row: int
    value: Expr
    factor: Generator


def zeros(context: Context) -> tuple[Zero, ...] | None:
    """The rows of g one after the other, from the last on; None where one does not say where it is 0."""
    left = [k for k in reversed(range(context.robot.n)) if not context.values["g"][k, 0].is_zero]
    found: list[Zero] = []
    while left:
        told = next((zero for k in left if (zero := _zero(context, k, found)) is not None), None)
        if told is None:
            return None
        found.append(told)
        left.remove(told.row)
    return tuple(found)


def _zero(context: Context, k: int, known: Sequence[Zero]) -> Zero | None:
    """Row k, where a sine or cosine times what surely has a sign is left of it."""
    value = at_zeros(context.values["g"][k, 0], known)
    ring = value.ring
    degrees = value.poly.degrees()
    turning = [g for g in ring.generators if g.kind in ("sin", "cos") and degrees[g.index] > 0]
    if len(turning) != 1:
        return None
    (factor,) = turning
    beside = _put(value, {factor.index: 1})
    if value != beside * ring.generator(factor.index) or not sign_of(context, beside):
        return None
    return Zero(k, value, factor)


def at_zeros(value: Expr, known: Sequence[Zero]) -> Expr:
    """A value where the rows of g are 0."""
    return _put(value, {zero.factor.index: 0 for zero in known})


def _put(value: Expr, images: Mapping[int, int]) -> Expr:
    """A value with numbers for some generators."""
    ring = value.ring
    point = [
        (ring.constant(images[g.index]) if g.index in images else ring.generator(g.index)).poly
        for g in ring.generators
    ]
    return Expr(ring, ring.reduce(value.poly.compose(*point, ctx=ring.ctx)))


def written_zero(context: Context, zero: Zero) -> Node:
    """g_3 = m_3 g l_c3 c_23 = 0, so c_23 = 0, θ_2 + θ_3 = ±90°"""
    ring, factor = context.robot.ring, zero.factor
    row = equation(letters.entry("g", zero.row + 1), context.named(context.show(zero.value)), ZERO)
    one, other = (ZERO, Degrees(180)) if factor.kind == "sin" else (Degrees(90), Negative(Degrees(90)))
    angle = Row((equation(angle_node(factor.angle, ring.names), one), Words(" or "), other))
    vanishing = equation(context.show(ring.generator(factor.index)), ZERO)
    return as_row((row, ", so ", vanishing, ", ", angle))


# -- what is said of every equilibrium: the step itself, what is assumed, which coordinates are free


def told(
    why: Prose,
    lines: Sequence[Line] = (),
    concluding: Prose = (),
    table: Table | None = None,
    outcome: Prose = (),
) -> Step:
    """The step, by what is said before its lines and after them; its `outcome` may be what it says itself."""
    return Step(
        id="equilibrium",
        title="Check: where gravity is balanced",
        why=why,
        source=spong("7.2.3"),
        lines=tuple(lines),
        concluding=concluding,
        table=table,
        table_last=bool(lines),
        outcome=outcome or concluding or why,
        is_task=False,
    )


def at_rest(context: Context) -> Prose:
    """What an equilibrium is, and what is assumed."""
    return say(
        "In an equilibrium the {machine} stays at rest with ${driving} = 𝟎$, so $𝐠 = 𝟎$. {assumed}",
        machine=context.machine,
        driving=driving_side(context),
        assumed=assumed(context),
    )


def assumed(context: Context) -> str:
    """That lengths and masses are positive, where there are any in letters."""
    return "Let all parameters be positive. " * bool(context.robot.parameters)


def in_no_others(poses: str) -> str:
    """That there are no other poses than those: `this pose`, `the poses of the table`."""
    return f"Gravity is balanced in {poses} alone (up to full turns)"


def free(context: Context, names: Collection[str]) -> Prose:
    """The coordinates but those that are named, which may have any value."""
    others = [Symbol(q.name) for q in context.robot.coordinates if q.name not in names]
    what = ", whatever {others} is" if len(others) == 1 else ", whatever {others} are"
    return say(what, others=listed(others)) if others else ()


# -- what P has where g = 0, by the signs of the minors of its second derivatives, ∂²P/∂q_i∂q_j = ∂g_i/∂q_j
# The minors are those of the last coordinate, the last two, ... (Sylvester's criterion): all of them
# are positive at a minimum; those of odd size alone are negative at a maximum; where the determinant
# is not 0, and it is neither, P rises in one direction and falls in another.

DET = Words("det")
"""The determinant of the second derivatives."""

MOST_SHOWN = 2
"""Of up to so many angles the minors are shown with the derivatives that they are made of."""


class Kind(StrEnum):
    """What P has where its first derivatives are 0."""

    MINIMUM = "minimum"
    MAXIMUM = "maximum"
    SADDLE = "saddle point"


def leading_minors(context: Context, names: Sequence[str], known: Sequence[Zero] = ()) -> list[Expr]:
    """The minors of ∂g/∂q of the last angle, the last two, ..., where rows of g are 0."""
    second = _second(context, names, known)
    sizes = range(1, len(names) + 1)
    return [determinant([row[-size:] for row in second[-size:]]) for size in sizes]


def _second(context: Context, names: Sequence[str], known: Sequence[Zero]) -> list[list[Expr]]:
    ring, g = context.robot.ring, context.values["g"]
    places = [ring.names.index(name) for name in names]
    return [[at_zeros(ring.diff(g[i, 0], j), known) for j in places] for i in places]


def signs_of(context: Context, found: Sequence[Expr], pose: Pose) -> list[int]:
    """The sign of each minor in a pose: 1, -1, or 0 where it is not seen."""
    return [sign_of(context, at(context.robot.ring, minor, pose)) for minor in found]


def kind_of(signs: Sequence[int]) -> Kind | None:
    """What P has by the signs of the minors; None where they do not tell.

    >>> [kind_of(signs) for signs in ([1, 1], [-1, 1], [1, -1], [0, -1], [1, 0])]
    [<Kind.MINIMUM: 'minimum'>, <Kind.MAXIMUM: 'maximum'>, <Kind.SADDLE: 'saddle point'>, \
<Kind.SADDLE: 'saddle point'>, None]
    """
    at_maximum = [(-1) ** size for size in range(1, len(signs) + 1)]
    if all(sign == 1 for sign in signs):
        return Kind.MINIMUM
    if list(signs) == at_maximum:
        return Kind.MAXIMUM
    rules_out_both = -1 in signs and any(a == -b for a, b in zip(signs, at_maximum, strict=True) if a)
    return Kind.SADDLE if rules_out_both and signs[-1] else None


def shown(context: Context, names: Sequence[str], known: Sequence[Zero] | None) -> Iterator[Node]:
    """The second derivatives and the determinant of two, with its value where rows of g are 0."""
    second = _second(context, names, known or ())
    slopes = [[slope(context, i, j) for j in names] for i in names]
    alike: dict[Expr, list[Node]] = {}
    for value, name in zip(chain(*second), chain(*slopes), strict=True):
        alike.setdefault(value, []).append(name)
    for value, of_value in alike.items():
        yield equation(*of_value, context.show(value))
    if len(names) > 1:
        (a, b), (_, c) = slopes
        values = [] if known is None else [_put_in(context, second), context.show(determinant(second))]
        yield equation(DET, formula("{a} {c} - {b}²", a=a, b=b, c=c), *dict.fromkeys(values))


def how_multiplied(context: Context, names: Sequence[str], known: Sequence[Zero] | None) -> Prose:
    """That the determinant of two is multiplied out, and whether the square in it cancels."""
    if len(names) != 2 or known is None:
        return ()
    second = _second(context, names, known)
    form = _put_in(context, second)
    if not isinstance(form, Sum) or form == context.show(determinant(second)):
        return ()
    square = (second[0][1] * second[0][1]).poly.to_dict()
    left = determinant(second).poly.to_dict()
    return (", multiplied out (the square cancels)",) if not square.keys() & left else (", multiplied out",)


def _put_in(context: Context, second: Sequence[Sequence[Expr]]) -> Node:
    """a c - b² with the entries of the matrix."""
    (a, b), (_, c) = ([context.show(entry) for entry in row] for row in second)
    product = times(1, [(a, 1), (c, 1)])
    return product if b == ZERO else Sum((product, Negative(Power(without_signs(b), Number(2)))))


def slope_of_last(context: Context, names: Sequence[str]) -> Node:
    """∂g_n/∂q_n"""
    return slope(context, names[-1], names[-1])


def slope(context: Context, row: str, by: str) -> Node:
    """∂g_i/∂q_j, by the names of the coordinates."""
    place = context.robot.ring.names.index(row) + 1
    return letters.partial_derivative(letters.entry("g", place), Symbol(by))


# -- the poses ------------------------------------------------------------------------------------


def rests_nowhere(context: Context) -> Step | None:
    """An entry of g that is 0 in no pose; None where there is none."""
    g = context.values["g"]
    k, sign = next(((k, sign) for k in range(context.robot.n) if (sign := sign_of(context, g[k, 0]))), (0, 0))
    if not sign:
        return None
    parts = (letters.entry("g", k + 1), context.named(context.show(g[k, 0])), ZERO)
    value = Relation(parts, ("=", ">" if sign > 0 else "<"))
    why = say(
        "{rest}But {value}{where} in every pose, so gravity is balanced in none.",
        rest=at_rest(context),
        value=value,
        where=Reference(("g",), " in "),
    )
    return told(why, outcome=say("Gravity is balanced in no pose: {value} in each.", value=value))


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
    level_where, values = level
    moments = [found for value in values if (found := _moment(context, turned, slid, {angle: value}))]
    lengths = {length for _, length in moments}
    if len(moments) < len(values) or len(lengths) != 1:
        return None
    either = equation(Symbol(angle), Row((degrees(values[0]), Words(" or "), degrees(values[1]))))
    zero = equation(letters.entry("g", slid + 1), context.named(context.show(g[slid, 0])), ZERO)
    rows = (as_row((zero, ", so ", level_where, ", ", either)), *(balance for balance, _ in moments))
    name = robot.coordinates[slid].name
    why = say(
        "{rest}The rows of $𝐠${where}; what ${entry} = 0$ says is put into the other:",
        rest=at_rest(context),
        where=Reference(looked_at(context, "g", put_in(rows)), " in "),
        entry=letters.entry("g", slid + 1),
    )
    balanced = equation(Symbol(name), *lengths)
    concluding = say(
        "So {balanced} in both. {only}{free}. {saddles}{limits}",
        balanced=balanced,
        only=in_no_others("this pose" if len(values) == 1 else "these poses"),
        free=free(context, (angle, name)),
        saddles=_saddles(context, slid, turned),
        limits=_not_extended(context, name, *lengths),
    )
    outcome = say(
        "Gravity is balanced in two poses, with {balanced}: saddle points of the potential energy.",
        balanced=balanced,
    )
    return told(why, (Line((), rows),), concluding, outcome=outcome)


def _moment(context: Context, row: int, slid: int, pose: Pose) -> tuple[Node, Node] | None:
    """θ = 180°: g_2 = -g (m_2 l_c2 + m_3 d_3) = 0, and the length at which it is, -m_2 l_c2/m_3."""
    ring, d = context.robot.ring, Symbol(context.robot.coordinates[slid].name)
    value = at(ring, context.values["g"][row, 0], pose)
    by_d = ring.diff(value, slid)
    rest, sign = value - by_d * ring.symbol(d.name), sign_of(context, by_d)
    if not sign or ring.depends_on_coordinates(rest):
        return None
    # by_d = p a and rest = p b, where a is positive, and a and b have no fraction and no common factor
    common = rest.poly.gcd(by_d.poly)
    a, b = (Expr(ring, each.poly / common) * sign for each in (by_d, rest))
    whole = lcm(*(int(each.poly.factor()[0].q) for each in (a, b) if not each.is_zero))
    p, a, b = Expr(ring, common) * sign / whole, a * whole, b * whole
    linear = total([times(1, [(context.show(a), 1), (d, 1)]), context.show(b)])
    shown, collected = context.show(value), times(1, [(context.show(p), 1), (linear, 1)])
    members = (shown,) if are_alike(shown, collected) else (shown, collected)
    shown_zero = equation(letters.entry("g", row + 1), *map(context.named, members), ZERO)
    zero = Row((*written_pose(pose), Words(": "), shown_zero))
    if a.is_number or b.is_zero:
        return zero, context.show(-b / a.number) if a.is_number else ZERO
    if sign_of(context, b) > 0:
        return zero, Negative(Quotient(context.show(b), context.show(a)))
    return zero, Quotient(context.show(-b), context.show(a))


def _saddles(context: Context, slid: int, turned: int) -> Prose:
    """Why P has a saddle point there: g_d does not depend on d, but on the angle it does."""
    names = [context.robot.coordinates[k].name for k in (slid, turned)]
    by_d, by_angle = (slope(context, names[0], name) for name in names)
    ring, place = context.robot.ring, context.robot.ring.names.index(names[1])
    rate = context.show(ring.diff(context.values["g"][slid, 0], place))
    return say(
        "In both $𝒫$ has a saddle point: as ${by_d} = 0$, the determinant of the symmetric matrix of its "
        "second derivatives with respect to {angle} and {d} is $-({by_angle})² = -{rate}²$, which is "
        "negative there. So they are unstable.",
        by_d=by_d,
        angle=Symbol(names[1]),
        d=Symbol(names[0]),
        by_angle=by_angle,
        rate=without_signs(rate),
    )


def _not_extended(context: Context, name: str, length: Node) -> Prose:
    """That the length is on the other side of 0, where it is seen to be."""
    positive, constant = with_lengths(context.robot), frozenset(context.robot.ring.parameters)
    if isinstance(length, Quotient) and isinstance(length.numerator, Sum):
        terms = length.numerator.terms
        larger = sum_of([term for term in terms if not isinstance(term, Negative)])
        less = sum_of([term.argument for term in terms if isinstance(term, Negative)])
        text, limits = " Here ${d} > 0$ only if ${less} < {larger}$.", {"less": less, "larger": larger}
        return () if ZERO in (less, larger) else say(text, d=Symbol(name), **limits)
    if not isinstance(length, Negative) or not is_positive(length.argument, positive, constant):
        return ()
    return say(" With ${d} > 0$ no pose is balanced.", d=Symbol(name))


QUARTER_TURNS = (0, 90, 180, -90)

_HEADER = ("potential energy", "equilibrium")


def equilibrium_step(context: Context) -> Step | None:
    """The poses in which the arm needs no torques against gravity, with what P has there."""
    robot = context.robot
    if robot.gravity.is_zero or robot.given is not None or robot.actions.springs:
        return None
    if context.values["g"].is_zero:
        return told(_everywhere(context))
    if robot.questions.constraints or robot.questions.loads:  # it is not gravity alone that is balanced
        return None
    if (nowhere := rests_nowhere(context)) is not None:
        return nowhere
    lengths = (k for k, q in enumerate(robot.coordinates) if q.type is JointType.PRISMATIC)
    if any(not robot.ring.diff(context.values["P"], k).is_zero for k in lengths):
        return at_one_length(context)
    zero = _balanced(context)
    return (_all_poses(context, zero) or _extrema(context, zero)) if zero else None


def _everywhere(context: Context) -> Prose:
    """Why g is zero in every pose."""
    ring = context.robot.ring
    heights = [context.values[f"P{body.name}"] for body in context.robot.bodies]
    why = "some mass centres rise as others fall."
    if not any(ring.depends_on_coordinates(height) for height in heights):
        kinds = {q.type for q in context.robot.coordinates}
        what = "no torque" if JointType.REVOLUTE in kinds else "no force"
        what += " and no force" if len(kinds) > 1 else ""
        why = f"no mass centre changes its height, so gravity needs {what} at any joint."
    return say(f"$𝐠 = 𝟎$ in every pose: {why}")


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
    marks = {1: "> 0", 0: "", -1: "< 0"}
    table = tuple(
        (
            side_by_side(written_pose(pose)),
            *([marks[sign] for sign in each] if shows else []),
            *_told(context, pose, kind),
        )
        for pose, each, kind in zip(zero, signs, kinds, strict=True)
    )
    concluding = say(
        "{only}{free}. {minors}",
        only=in_no_others(f"the pose{'s' * (len(zero) > 1)} of the table"),
        free=free(context, zero[0]),
        minors=_by_minors(context, names),
    )
    outcome = say(
        "Gravity is balanced in {poses} (up to full turns){free}; {minima}",
        poses="one pose" if len(zero) == 1 else f"{len(zero)} poses",
        free=free(context, zero[0]),
        minima=_minima(zero, kinds),
    )
    second = (_second_derivatives(context, names, rows),) if shows else ()
    why = (*at_rest(context), *_rows_of(context, rows))
    slope = slope_of_last(context, names)
    of_minors: tuple[Inline, ...] = {1: (slope,), 2: (slope, "det")}.get(len(names), ())
    poses = Table(("pose", *of_minors, *_HEADER), table)
    return told(why, (*lines, *second), concluding, poses, outcome)


def _minima(zero: Sequence[Pose], kinds: Sequence[Kind]) -> Prose:
    """In which poses P has a minimum."""
    found = zip(zero, kinds, strict=True)
    stable = [side_by_side(written_pose(pose)) for pose, kind in found if kind is Kind.MINIMUM]
    where = "at {stable}" if stable else "in none"
    return say(f"the potential energy has a minimum {where}.", stable=listed(stable))


def _rows_of(context: Context, rows: Sequence[Zero] | None) -> Prose:
    """How the rows of g are gone through."""
    text = "The rows of $𝐠${where}, from the last row up, each result put into the row above:"
    if rows is None:
        text = "A row of $𝐠${where} is 0 where one of its factors is:"
    elif len(rows) == 1:
        text = "The only row of $𝐠${where}:"
        if context.robot.n > 1:
            text = "Of the entries of $𝐠${where} only {only} is not identically 0:"
    only = letters.entry("g", rows[0].row + 1) if rows else ""
    seen = put_in(written_zero(context, row) for row in rows or ())
    return say(text, where=Reference(looked_at(context, "g", seen), " in "), only=only)


def _by_minors(context: Context, names: Sequence[str]) -> Prose:
    """How what P has in a pose is found, by the number of angles."""
    where = (
        "a minimum where all the leading minors of its second derivatives are positive (Sylvester's "
        "criterion)"
    )
    if len(names) == 1:
        where = "a minimum where the second derivative is positive, a maximum where it is negative"
    elif len(names) == 2:
        where = (
            "a minimum where {slope} and det are positive, a maximum where det alone is (Sylvester's "
            "criterion), a saddle point where det is negative"
        )
    held = listed([Symbol(name) for name in names]) if len(names) < context.robot.n else ()
    return say(
        f"$𝒫$ has {where}; at a minimum the equilibrium is stable{{held}}, elsewhere it is not:",
        slope=slope_of_last(context, names),
        held=(" in ", *held) if held else "",  # nothing holds the others
    )


def _second_derivatives(context: Context, names: Sequence[str], rows: Sequence[Zero] | None) -> Line:
    derivatives = tuple(shown(context, names, rows))
    if len(names) == 1:
        return Line(say("The second derivative of $𝒫$:"), derivatives)
    some = ""
    if len(names) < context.robot.n:
        some = " with respect to {names} (it depends on no other coordinate)"
    by = say(
        f"The second derivatives of $𝒫${some}; det is the determinant of their matrix{{multiplied}}:",
        names=listed([Symbol(name) for name in names]),
        multiplied=how_multiplied(context, names, rows),
    )
    return Line(by, derivatives)


def _told(context: Context, pose: Pose, kind: Kind) -> tuple[Inline, Inline]:
    """What P has in a pose, and how stable that is."""
    whole = len(pose) == context.robot.n
    is_upright = whole and _is_vertical(context, pose)
    if kind is Kind.MINIMUM:
        those = as_row(("stable in ", *listed([Symbol(name) for name in pose])))  # the others may drift
        what = f"{kind}: the {context.machine} hangs" if is_upright else kind.value
        return what, "stable" if whole else those
    stands = is_upright and kind is Kind.MAXIMUM
    return f"{kind}: the {context.machine} stands upright" if stands else kind.value, "unstable"


def _is_vertical(context: Context, pose: Pose) -> bool:
    """Whether all origins and mass centres lie on one vertical line."""
    values, ring, gravity = context.values, context.robot.ring, context.robot.gravity
    frames = [values[name] for k in range(len(context.robot.joints) + 1) if (name := f"H{k}") in values]
    mass_centres = [values[f"rc{body.name}"] for body in context.robot.bodies]
    points = [origin(H) for H in frames] + mass_centres
    offsets = ((point - points[0]).map(lambda x: at(ring, x, pose)) for point in points)
    return all(cross(offset, gravity).is_zero for offset in offsets)


def _extrema(context: Context, zero: Sequence[Pose]) -> Step | None:
    """The poses in which P surely has a minimum or a maximum."""
    found = [
        (pose, kind)
        for pose in zero
        if (kind := kind_of(signs_of(context, leading_minors(context, list(pose)), pose)))
        in (Kind.MINIMUM, Kind.MAXIMUM)
    ]
    if not found:
        return None
    rows = [(side_by_side(written_pose(pose)), *_told(context, pose, kind)) for pose, kind in found]
    why = say(
        "{assumed}$𝐠 = 𝟎$ {where}{free}:",
        assumed=assumed(context),
        where="in this pose" if len(rows) == 1 else "in these poses",
        free=free(context, zero[0]),
    )
    outcome = ("Of the poses in which gravity is balanced, ", *_minima(*zip(*found, strict=True)))
    return told(why, table=Table(("pose", *_HEADER), tuple(rows)), outcome=outcome)


def _balanced(context: Context) -> list[Pose]:
    """The poses of quarter turns in which g is zero."""
    g = context.values["g"].entries
    names = turning_in(context.robot, *g)
    if not names:
        return []
    return [pose for pose in poses(names, QUARTER_TURNS) if all(at(x.ring, x, pose).is_zero for x in g)]


# -- joints that gravity does not load: their axes are vertical, or they slide level ---------------


def unloaded_step(context: Context) -> Step | None:
    """The entries of g that must be zero, by the axes of the joints alone."""
    robot = context.robot
    if not robot.has_table or robot.gravity.is_zero or robot.actions.springs or robot.given is not None:
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
