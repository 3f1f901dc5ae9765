"""Steps from joint axes as they are drawn to the table: each frame with the reason for its choice."""

from __future__ import annotations

from collections.abc import Iterator

from msgspec.structs import replace

from dynsolve.algebra.angles import Angle, angle_node
from dynsolve.algebra.compact.compactor import Compactor
from dynsolve.algebra.factors import is_nonnegative
from dynsolve.algebra.matrix import Matrix
from dynsolve.document import Prose, Table
from dynsolve.document.sentences import say
from dynsolve.explain.context import Context
from dynsolve.explain.kinematics import table_of
from dynsolve.explain.step import Detail, Group, Step
from dynsolve.explain.writing import listed, side_by_side
from dynsolve.notation.tree import Node, Number, Row, Symbol, Words, column, equation
from dynsolve.quantities import letters
from dynsolve.robot.drawing.angles import sign
from dynsolve.robot.drawing.normals import Drawing, NoAngle, Normals, Relation, dot, frames
from dynsolve.robot.drawing.rows import rows_of
from dynsolve.robot.model import Convention

FRAMES = Group("frames", "The frames")

_HINT = (
    "See how the two axes lie, the one of the joint and the next one. Skew axes have one common normal: x "
    "lies along it. Where they meet, x is perpendicular to both, through that point. Of parallel axes, or of "
    "two on one line, any common normal will do: take the one with which d is 0. The origin is where x "
    "meets z."
)

_MEASURED = {
    Convention.STANDARD: (
        "In the standard convention (Spong) {theta} turns $𝐱_(i-1)$ to $𝐱_i$ about $𝐳_(i-1)$, and {d} is the "
        "way along it; {a} is the distance from $𝐳_(i-1)$ to $𝐳_i$ along $𝐱_i$, and {alpha} the angle "
        "between them about it."
    ),
    Convention.MODIFIED: (
        "In the modified convention (Craig) {theta} turns $𝐱_(i-1)$ to $𝐱_i$ about $𝐳_i$, and {d} is the way "
        "along it; {a_before} is the distance from $𝐳_(i-1)$ to $𝐳_i$ along $𝐱_(i-1)$, and {alpha_before} "
        "the angle between them about it."
    ),
}

_ZERO_DRAWN = (
    "Turning joints are at 0 as drawn, so that {theta} is the coordinate plus the angle that is drawn. The "
    "star marks the joint variables."
)
_ZERO_OF_TABLE = "The coordinates are the variables of the table, marked by a star: nothing is added to them."

_LIE = {
    Relation.SKEW: "are skew",
    Relation.INTERSECTING: "meet",
    Relation.PARALLEL: "are parallel",
    Relation.COINCIDENT: "lie on one line",
}
"""How two axes lie."""

_CHOSEN = {
    Relation.SKEW: (
        ": they have one common normal. {x} lies along it, from the first to the second{where}, and {o} is "
        "where it meets {foot}."
    ),
    Relation.INTERSECTING: (
        ", so that {a} is 0: {o} is the point where they do, and {x} is perpendicular to both. Of its two "
        "directions the one {which} is taken."
    ),
    Relation.PARALLEL: (
        ": every line across is a common normal. The one with {d} = 0 is taken, and {x} points from the "
        "first to the second{where}."
    ),
    Relation.COINCIDENT: (
        ": {x} may point anywhere across, and {o} be anywhere on it. Taken are {x_before}, and the origin "
        "with which {d} has no constant part."
    ),
}
"""What is chosen for the axes of two joints that lie so."""

_CHOSEN_FOR_HAND = _CHOSEN | {
    Relation.PARALLEL: (
        ": every line across is a common normal. The one through the hand is taken, and {x} points from the "
        "first to the second{where}."
    ),
    Relation.COINCIDENT: ": {o} is the hand, and {x}, which may point anywhere across, is {x_before}.",
}
"""What is chosen for the axis of the last joint and the z of the hand."""

_HAND_BESIDE = (
    "The hand lies beside the axis of joint {n}: {x} points from the axis across to it, and {z} stays "
    "parallel to the axis."
)
_HAND_ON = (
    "The hand lies on the axis of joint {n}. {z} stays along it, and {x} may point anywhere across: it is "
    "that of frame {before}, so that nothing is turned in the pose that is drawn."
)


def steps(context: Context) -> Iterator[Step]:
    """The drawn axes, the frames one by one, the table."""
    if context.normals is None:
        return
    yield _drawn_axes(context, context.normals)
    for i in range(len(context.normals.all)):
        yield replace(_drawn_frame(context, context.normals, i), group=FRAMES)
    yield _measured_table(context, context.normals)


def _drawn_axes(context: Context, normals: Normals) -> Step:
    """The joint axes and the hand, as they are given."""
    drawing = normals.drawing
    form = Compactor(drawing.ring).form

    def in_a_row(vector: Matrix) -> Node:
        x, y, z = map(form, vector.entries)
        return Row((Words("("), x, Words(", "), y, Words(", "), z, Words(")")))

    rows = [
        (str(i), Symbol(axis.coordinate), "slides along" if axis.slides else "turns about",
         in_a_row(axis.line.direction), in_a_row(axis.line.point) if axis.is_placed else "anywhere")
        for i, axis in enumerate(drawing.axes, 1)
    ]  # fmt: skip
    return Step(
        id="axes",
        title="The joint axes",
        why=say(
            "The joint axes in the pose that is drawn, in world coordinates; the hand is at {hand}. $𝐳$ lies "
            "along each joint axis in the direction that is given.{places}",
            hand=in_a_row(drawing.hand.at),
            places=_open_places(drawing),
        ),
        source=context.by_convention("3.2", "3.4"),
        notes=(_OF_LETTERS,) if drawing.ring.parameters else (),
        table=Table(("joint", "", "", "direction", "through"), tuple(rows)),
        detail=Detail.BRIEF,
        is_task=False,
    )


_OF_LETTERS = (
    "Letters are positive and independent of each other: what vanishes for some of their values alone does "
    "not count as 0.",
)


def _open_places(drawing: Drawing) -> Prose:
    """Where the axes of slides are laid that have no place."""
    joints = [str(i) for i, axis in enumerate(drawing.axes, 1) if not axis.is_placed]
    if not joints:
        return ()
    return say(
        " {axes} {joints} may be anywhere along the direction, for a slide has no place. The line is taken "
        "with which fewest lengths of the table differ from 0.",
        axes="The axes of joints" if len(joints) > 1 else "The axis of joint",
        joints=listed(joints),
    )


def _drawn_frame(context: Context, normals: Normals, i: int) -> Step:
    """One frame: how the axes lie, and what follows for it."""
    form = Compactor(normals.drawing.ring).form
    placed = list(frames(normals, not context.standard))[i]
    names = [letters.bold(letter, Number(i)) for letter in "oxz"]
    shown = [equation(n, column(*map(form, v.entries))) for n, v in zip(names, placed, strict=True)]
    return Step(
        id=f"frame{i}",
        title=f"Frame {i}",
        why=_why_frame(context, normals, i),
        source=context.by_convention("3.2", "3.4"),
        result=(side_by_side(shown),),
        hint=(_HINT,) if i else (),
    )


def _why_frame(context: Context, normals: Normals, i: int) -> Prose:
    normal, n = normals.all[i], len(normals.drawing.axes)
    if normal.relation is Relation.BASE:
        return say(
            "$𝐳_0$ lies along the axis of joint 1; the origin may be anywhere on it, and $𝐱_0$ may point "
            "anywhere across it. The origin is {which} of the world, and $𝐱_0$ an axis of the world.",
            which="that" if normal.end.is_zero else "the point nearest to that",
        )
    x, o = letters.bold("x", Number(i)), letters.o(i)
    if i == n and normals.drawing.hand.z is None:
        is_on = normal.relation is Relation.COINCIDENT
        return say(_HAND_ON if is_on else _HAND_BESIDE, n=n, x=x, z=letters.z(n), before=n - 1)
    has_own_x = i == n and normals.drawing.hand.x is not None
    before = "the x of the hand" if has_own_x else letters.bold("x", Number(i - 1))
    own, following = f"the axis of joint {i}", f"the axis of joint {i + 1}" if i < n else "the z of the hand"
    is_nearer = _is_nearer(normals, i)
    chosen = _CHOSEN if i < n else _CHOSEN_FOR_HAND
    is_told = (
        not has_own_x
        and chosen[normal.relation] == _CHOSEN[normal.relation]
        and any(
            each.relation is normal.relation
            and (normal.relation is not Relation.INTERSECTING or _is_nearer(normals, j) is is_nearer)
            for j, each in enumerate(normals.all[1:i], 1)
        )
    )
    _, d, a, alpha = letters.columns(context.robot, Number(i))
    nearer, positive = say("nearer to {x}", x=before), say("with a positive {alpha}", alpha=alpha)
    return say(
        f"The axis of joint {i} and {following} {_LIE[normal.relation]}"
        + (", too." if is_told else chosen[normal.relation]),
        x=x,
        o=o,
        x_before=before,
        which=nearer if is_nearer else positive,
        where=()
        if is_nonnegative(normal.a)
        else say(" where ${way} > 0$", way=Compactor(normals.drawing.ring).form(normal.a)),
        d=d,
        a=a,
        foot=following if context.standard else own,
    )


def _is_nearer(normals: Normals, i: int) -> bool:
    """Whether the x of a normal is nearer than its opposite to the x that it is compared with."""
    x, own = normals.all[i].x, normals.drawing.hand.x
    before = normals.all[i - 1].x if own is None or i < len(normals.all) - 1 else own
    return sign(dot(before, x)) > 0


def _measured_table(context: Context, normals: Normals) -> Step:
    """The rows, measured from frame to frame."""
    drawing, robot = normals.drawing, context.robot
    theta, d, a, alpha = letters.columns(robot, letters.COUNT)
    _, _, a_before, alpha_before = letters.columns(robot, letters.BEFORE)
    zero = _ZERO_DRAWN if drawing.zero_is_drawn else _ZERO_OF_TABLE
    more = " One row more, without a joint, takes the last frame to the hand."
    return Step(
        id="DH",
        title="The Denavit-Hartenberg table",
        why=say(
            f"{_MEASURED[drawing.convention]} {zero}{more if len(robot.joints) > len(drawing.axes) else ''}"
            "{drawn}",
            drawn=_angles_as_drawn(normals),
            theta=theta,
            d=d,
            a=a,
            alpha=alpha,
            a_before=a_before,
            alpha_before=alpha_before,
        ),
        source=context.by_convention("3.2", "3.4"),
        notes=(
            (
                "At random joint values this table moves the hand as the product of the exponentials of the "
                "drawn axes does.",
            ),
        ),
        table=table_of(context),
        detail=Detail.BRIEF,
        hint=("Measure from frame to frame: about z, along z, along x, about x.",),
    )


def _angles_as_drawn(normals: Normals) -> Prose:
    """The coordinates that turn and are not 0 in the pose that is drawn, as far as they are known there."""
    drawing = normals.drawing
    if drawing.zero_is_drawn:
        return ()
    try:
        rows = rows_of(replace(normals, drawing=replace(drawing, zero_is_drawn=True)))
    except NoAngle:
        return ()
    turned = [(row.axis.coordinate, row.theta) for row in rows if row.axis and not row.axis.slides]
    told = [equation(Symbol(name), angle_node(theta)) for name, theta in turned if theta != Angle.zero()]
    return say(" In the pose that is drawn, {values}.", values=listed(told)) if told else ()


# -- hints -----------------------------------------------------------------------------------------

AT_HAND = "You have the joint axes as they are drawn:"

PITFALLS = """
    d is measured along z, the axis of a joint, and a across it, along x.
    Every angle has a sense: θ is seen against z, α against x, counterclockwise.
    slides? The axis of a sliding joint has a direction and no place: lay it where lengths vanish.
    A z may also point the other way, and frame 0 be anywhere on the first axis.
"""
