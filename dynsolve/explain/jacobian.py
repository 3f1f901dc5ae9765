"""Steps of the end-effector Jacobian: axes and origins, column by column, J_v and J_ω."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from fractions import Fraction
from itertools import pairwise

from dynsolve.algebra import matrix as algebra
from dynsolve.derivation.jacobian import joint_frame
from dynsolve.derivation.kinematics import axis, origin
from dynsolve.document import Prose
from dynsolve.explain.context import Context
from dynsolve.explain.step import Detail, Step
from dynsolve.explain.working.identities import Identity, said
from dynsolve.explain.working.products import used_in_product
from dynsolve.explain.working.proved import MOST_JOINTS
from dynsolve.explain.writing import block_of, column_of, craig, is_small, listed, side_by_side, spong, turns
from dynsolve.notation.tree import (
    Cross,
    Letter,
    Matrix,
    Negative,
    Node,
    Number,
    Parenthesized,
    Product,
    Sum,
    Symbol,
    Words,
    column,
    equation,
    number,
)
from dynsolve.notation.walk import walk
from dynsolve.quantities import letters
from dynsolve.quantities.stages import Stage
from dynsolve.robot.model import Coordinate, Joint, JointType, Robot

STAGE = Stage.JACOBIAN

ZERO = Letter("0", style="bold")
"""The zero vector."""


def steps(context: Context) -> Iterator[Step]:
    """Axes and origins, a column a coordinate, and J."""
    yield _axes(context)
    for q in context.robot.coordinates:
        yield _column(context, q)
    yield _whole(context)


def frame_parts(context: Context, i: int) -> tuple[Matrix, Matrix]:
    """(z_i, o_i) as trees."""
    H = context.matrix(f"H{i}")
    return block_of(H, 3, 2, 3), block_of(H, 3, 3, 4)


def _axes(context: Context) -> Step:
    robot = context.robot
    moving = sorted({joint_frame(robot, joint) for joint in robot.joints if joint.type})
    last = len(robot.joints)
    pairs: list[Node] = []
    for i in moving:
        z = equation(letters.z(i), frame_parts(context, i)[0])
        pairs.append(side_by_side([z, _origin(context, i, moving)]))
    if last not in moving:
        pairs.append(_origin(context, last, moving))
    return Step(
        id="axes",
        stage=STAGE,
        title="Axes and origins of the frames",
        why=(
            Letter("z", style="bold"),
            " is the third column of ",
            Letter("H", style="bold"),
            " (its first three entries), ",
            Letter("o", style="bold"),
            f" the fourth. In the {robot.convention.value} convention joint i {_motions(robot)} ",
            Letter("z", Words("i-1" if context.standard else "i"), style="bold"),
            *_whose(context),
            *_wrist(context),
        ),
        source=spong("4.6") if context.standard else craig("3.4"),
        result=tuple(pairs),
        uses=(),
    )


def _origin(context: Context, i: int, moving: Sequence[int]) -> Node:
    """o_i with its value, or the earlier origin in the same moving point."""
    point = frame_parts(context, i)[1]
    ring, entries = context.robot.ring, origin(context.values[f"H{i}"]).entries
    if any(map(ring.depends_on_coordinates, entries)):
        for j in moving:
            if j < i and frame_parts(context, j)[1] == point:
                return equation(letters.o(i), letters.o(j))
    return equation(letters.o(i), point)


def _motions(robot: Robot) -> str:
    """How the joints move along or about their axes."""
    kinds = {JointType.REVOLUTE: "turns about", JointType.PRISMATIC: "slides along"}
    return " or ".join(words for kind, words in kinds.items() if any(j.type is kind for j in robot.joints))


def _wrist(context: Context) -> Prose:
    """That the last three axes meet in one point, where they do."""
    robot = context.robot
    joints = [joint for joint in robot.joints if joint.type][-3:]
    if robot.is_tree or robot.n < 4 or any(joint.type is not JointType.REVOLUTE for joint in joints):
        return ()
    frames = [joint_frame(robot, joint) for joint in joints]
    lines = [(axis(H), origin(H)) for H in (context.values[f"H{i}"] for i in frames)]
    turned = all(not algebra.cross(one, other).is_zero for (one, _), (other, _) in pairwise(lines))
    for i, (_, point) in zip(frames, lines, strict=True):
        if turned and all(algebra.cross(z, point - o).is_zero for z, o in lines):
            axes = listed([letters.z(k) for k in frames])
            return (" The last three axes, ", *axes, ", meet in ", letters.o(i), ": a spherical wrist.")
    return ()


def _whose(context: Context) -> Prose:
    if context.standard:
        return (", the axis of the frame before it.",)
    return (
        ", the axis of its own frame: where Spong, in the standard convention, has ",
        Letter("z", Words("i-1"), style="bold"),
        " and ",
        Letter("o", Words("i-1"), style="bold"),
        ", here stand ",
        Letter("z", Words("i"), style="bold"),
        " and ",
        Letter("o", Words("i"), style="bold"),
        ".",
    )


def column_letters(context: Context, joint: Joint, point: Node) -> tuple[Node, Node]:
    """(J_v, J_ω) of one joint in letters: z × (p - o) and z, or z and 0."""
    i = joint_frame(context.robot, joint)
    if joint.type is JointType.REVOLUTE:
        arm = Parenthesized(Sum((point, Negative(letters.o(i)))))
        return Cross(letters.z(i), arm), letters.z(i)
    return letters.z(i), ZERO


def coordinate_column(context: Context, k: int, link: int, point: Node) -> tuple[Node, Node] | None:
    """(J_v, J_ω) of coordinate k (from 0) in letters, None where no joint up to `link` moves with it."""
    terms = [
        (rate, column_letters(context, joint, point))
        for joint in context.robot.path(link)
        for i, rate in joint.rates
        if i == k
    ]
    if not terms:
        return None
    return (
        _total([(rate, linear) for rate, (linear, _) in terms]),
        _total([(rate, angular) for rate, (_, angular) in terms if angular != ZERO]),
    )


def _total(terms: Sequence[tuple[Fraction, Node]]) -> Node:
    """Σ rate·part"""
    if not terms:
        return ZERO
    rated = tuple(_rated(rate, part) for rate, part in terms)
    return rated[0] if len(rated) == 1 else Sum(rated)


def _rated(rate: Fraction, node: Node) -> Node:
    if rate == 1:
        return node
    if rate == -1:
        return Negative(node)
    return Product((number(rate), node))


def _plain_joint(robot: Robot, k: int) -> Joint | None:
    """The one joint that coordinate k (from 0) moves, at its own rate; None for several, or scaled."""
    moved = [(joint, rate) for joint in robot.joints for i, rate in joint.rates if i == k]
    return moved[0][0] if len(moved) == 1 and moved[0][1] == 1 else None


def _column(context: Context, q: Coordinate) -> Step:
    robot, k = context.robot, q.index - 1
    last = len(robot.joints)
    in_letters = coordinate_column(context, k, last, letters.o(last))
    if in_letters is None:
        return _still_column(context, q)
    linear, angular = (column_of(context.matrix(name), k) for name in ("Jv", "Jw"))
    name = Letter("J", Number(q.index), style="bold")
    joint = _plain_joint(robot, k)
    named = _turning_named(context, joint)
    return Step(
        id=f"J{q.index}",
        stage=STAGE,
        title=f"Column {q.index} of the Jacobian",
        why=(Symbol(q.name), *_column_why(context, q, joint)),
        formula=equation(name, column(*in_letters)),
        source=spong("4.6.3"),
        working=_working(
            context, _moved(context, k, last), end_of(context), in_letters[0], None if named else linear
        ),
        concluding=named,
        result=(equation(name, Matrix(linear.rows + angular.rows)),),
        uses=("axes",),
    )


def _still_column(context: Context, q: Coordinate) -> Step:
    """The column of a coordinate that moves no joint: the angle of a motor behind an elastic joint."""
    name = Letter("J", Number(q.index), style="bold")
    return Step(
        id=f"J{q.index}",
        stage=STAGE,
        title=f"Column {q.index} of the Jacobian",
        why=(Symbol(q.name), " turns a rotor alone and moves no link: its column is zero."),
        source=spong("4.6.3"),
        result=(equation(name, ZERO),),
        uses=("axes",),
    )


def _turning_named(context: Context, joint: Joint | None) -> Prose:
    """The identities by which z × (o_n - o), worked out, becomes what is printed."""
    if joint is None or joint.type is JointType.PRISMATIC or context.robot.n > MOST_JOINTS:
        return ()
    used = _used_in_cross(context, joint, end_of(context))
    return ("With ", *said(used), ":") if used else ()


def crosses(
    context: Context, link: int, name: Node, point: algebra.Matrix, J: Matrix
) -> tuple[tuple[Node, ...], Prose]:
    """The columns z × (p - o) of a point p of a link that are more than a look, and their identities.

    Where z is an axis of the base the product is one: two coordinates of p - o change places.
    """
    shown: list[Node] = []
    for k in range(context.robot.n):
        moved = _moved(context, k, link)
        turning = [joint for _, joint in moved if joint.type is JointType.REVOLUTE]
        if all(_is_along_the_base(context, joint) for joint in turning):
            continue
        in_letters = coordinate_column(context, k, link, name)
        assert in_letters is not None
        named = any(_used_in_cross(context, joint, point) for joint in turning)
        shown += _working(context, moved, point, in_letters[0], None if named else column_of(J, k))
    used = _used_in_crosses(context, link, point)
    words = "With " if shown else "The cross products, with "
    return tuple(shown), (words, *said(used), ":") if used else ()


def _moved(context: Context, k: int, link: int) -> list[tuple[Fraction, Joint]]:
    """The joints up to a link that coordinate k (from 0) moves, each with its rate."""
    return [(rate, joint) for joint in context.robot.path(link) for i, rate in joint.rates if i == k]


def _is_along_the_base(context: Context, joint: Joint) -> bool:
    """Whether the axis of a joint is one of those of the base."""
    z = axis(context.values[f"H{joint_frame(context.robot, joint)}"])
    return sum(not entry.is_zero for entry in z.entries) == 1


def _used_in_cross(context: Context, joint: Joint, point: algebra.Matrix) -> list[Identity]:
    """The identities by which z × (p - o) of a joint becomes what is printed."""
    z, lever = axis(context.values[f"H{joint_frame(context.robot, joint)}"]), _lever(context, joint, point)
    return used_in_product(context, algebra.skew(z), lever, algebra.cross(z, lever))


def _used_in_crosses(context: Context, link: int, point: algebra.Matrix) -> list[Identity]:
    """Those of all columns up to a link, each once; none of longer arms."""
    used: dict[Identity, None] = {}
    if context.robot.n <= MOST_JOINTS:
        for joint in context.robot.path(link):
            if joint.type is JointType.REVOLUTE:
                used |= dict.fromkeys(_used_in_cross(context, joint, point))
    return list(used)


def _working(
    context: Context,
    moved: Sequence[tuple[Fraction, Joint]],
    point: algebra.Matrix,
    in_letters: Node,
    linear: Matrix | None,
) -> tuple[Node, ...]:
    """A column of J_v with this robot's axes and levers put in, where there is anything to work out.

    Its value stands at the end, unless it is None: then an identity is named before the result.
    """
    robot = context.robot
    if all(joint.type is JointType.PRISMATIC for _, joint in moved):
        return ()
    if len(moved) == 1 and _lever(context, moved[0][1], point).is_zero:
        between = next(part.argument for part in walk(in_letters) if isinstance(part, Parenthesized))
        return (equation(between, ZERO),)
    parts: list[tuple[Fraction, Node]] = []
    small: list[Node] = []
    for rate, joint in moved:
        z = frame_parts(context, joint_frame(robot, joint))[0]
        if joint.type is JointType.REVOLUTE:
            lever = context.show(_lever(context, joint, point))
            small += [z, lever]
            parts.append((rate, Cross(z, lever)))
        else:
            small.append(z)
            parts.append((rate, z))
    members = [in_letters, _total(parts), *([linear] if linear else [])]
    return (equation(*members),) if is_small(*small) else ()


def _lever(context: Context, joint: Joint, point: algebra.Matrix) -> algebra.Matrix:
    """p - o, from the joint's axis to a point."""
    return point - origin(context.values[f"H{joint_frame(context.robot, joint)}"])


def end_of(context: Context) -> algebra.Matrix:
    """o_n, the end of the arm."""
    return origin(context.values[f"H{len(context.robot.joints)}"])


def _column_why(context: Context, q: Coordinate, joint: Joint | None) -> Prose:
    robot = context.robot
    if joint is None:
        joints = [j for j in robot.joints if any(i == q.index - 1 for i, _ in j.rates)]
        where = listed([str(j.index) for j in joints])
        if len(joints) > 1:
            return (
                " moves the joints of rows ",
                *where,
                "; its column is the sum of theirs, each times the rate at which that joint moves with ",
                Symbol(q.name),
                ".",
            )
        (rate,) = (rate for joint in joints for i, rate in joint.rates if i == q.index - 1)
        return (
            " moves the joint of row ",
            *where,
            " at ",
            number(rate),
            " times its own rate, and so its column.",
        )
    if turns(q):
        return (
            " turns everything after it about the axis ",
            letters.z(joint_frame(robot, joint)),
            f". At unit rate the velocity of {context.end} is the cross product of the axis "
            "and the vector from ",
            letters.o(joint_frame(robot, joint)),
            ", a point of the axis, to it; the angular velocity is the axis.",
        )
    z = letters.z(joint_frame(robot, joint))
    return (
        " moves everything after it along the axis ", z,
        f". At unit rate the velocity of {context.end} is that axis, and nothing turns.",
    )  # fmt: skip


def _whole(context: Context) -> Step:
    Jv, Jw = context.form("Jv"), context.form("Jw")
    in_letters: list[Node] = [letters.J, column(letters.JV, letters.JW)]
    if context.robot.n <= MOST_JOINTS:
        in_letters.append(_columns_in_letters(context))
    return Step(
        id="J",
        stage=STAGE,
        title=f"The Jacobian of {context.end}",
        why=(
            "The columns side by side: ",
            equation(letters.bold("v"), Product((letters.JV, letters.QD))),
            " and ",
            equation(letters.bold("omega"), Product((letters.JW, letters.QD))),
            " for all velocities of the joints.",
        ),
        formula=equation(*in_letters),
        source=spong("4.6.3"),
        result=(equation(letters.JV, Jv), equation(letters.JW, Jw)),
        also=("Jw",),
        uses=tuple(f"J{q.index}" for q in context.robot.coordinates),
        notes=tuple(_notes(context)),
        detail=Detail.BRIEF,
    )


def _columns_in_letters(context: Context) -> Matrix:
    """[z × (o_n - o) ...; z ...], a column a coordinate."""
    last = len(context.robot.joints)
    columns = [coordinate_column(context, k, last, letters.o(last)) for k in range(context.robot.n)]
    return Matrix(tuple(zip(*(column for column in columns if column), strict=True)))


def _notes(context: Context) -> Iterator[Prose]:
    if context.robot.bodies:
        yield (
            f"This Jacobian belongs to {context.end}. Each body has its own, at its mass centre; they "
            "follow below.",
        )
