"""Steps of the end-effector Jacobian: axes and origins, column by column, J_v and J_ω."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import pairwise

from dynsolve.algebra import matrix as algebra
from dynsolve.derivation.jacobian import joint_frame
from dynsolve.derivation.kinematics import axis, origin
from dynsolve.document import Prose, Reference
from dynsolve.explain.context import Context
from dynsolve.explain.jacobian_columns import (
    BESIDE,
    ZERO,
    column_shown,
    coordinate_column,
    end_of,
    frame_parts,
    how_read_off,
    joints_moved,
    read_off,
    used_in_cross,
)
from dynsolve.explain.matrix_factors import matrix_width
from dynsolve.explain.step import Detail, Group, Part, Step
from dynsolve.explain.working.identities import said
from dynsolve.explain.writing import and_joined, column_of, craig, listed, side_by_side, spong, turns
from dynsolve.notation.tree import (
    Letter,
    Matrix,
    Node,
    Number,
    Product,
    Relation,
    Symbol,
    Transpose,
    column,
    equation,
    number,
)
from dynsolve.quantities import letters
from dynsolve.quantities.stages import Stage
from dynsolve.robot.model import Coordinate, Joint, JointType, Robot

STAGE = Stage.JACOBIAN


def steps(context: Context) -> Iterator[Step]:
    """Axes and origins, a column a coordinate, and J."""
    yield _axes(context)
    whole = _whole(context)
    group = Group("J", whole.title, whole.why, whole.formula, whole.source)
    for q in context.robot.coordinates:
        yield replace(_column(context, q), normal=Part.WORKING | Part.CONCLUDING, group=group)
    yield replace(whole, group=group)


def _axes(context: Context) -> Step:
    robot = context.robot
    moving, told = _moving_frames(robot), told_frames(robot)
    last = told[-1]
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
            "In the first three rows of ",
            *_matrices_of_frames(context, told),
            " the third column is ",
            Letter("z", style="bold"),
            ", the fourth ",
            Letter("o", style="bold"),
            *_of_frame_0(context, moving),
            *_about(context),
            *_same_origins(context, moving),
            *_wrist(context),
            *_read_off(context),
        ),
        source=spong("4.6") if context.standard else craig("3.4"),
        result=tuple(pairs),
        uses=(),
    )


def _matrices_of_frames(context: Context, told: Sequence[int]) -> Prose:
    """The matrices whose columns are looked at: of a long arm not all of them are printed."""
    if context.is_short:
        return (Letter("H", style="bold"), Reference(tuple(f"H{i}" for i in told if i), " in "))
    return ("each ", replace(letters.H(context.robot, 0), sub=letters.COUNT))


def _moving_frames(robot: Robot) -> list[int]:
    """The frames about or along whose axes joints move."""
    return sorted({joint_frame(robot, joint) for joint in robot.joints if joint.type})


def told_frames(robot: Robot) -> tuple[int, ...]:
    """The frames whose origins the step of axes and origins tells: those of the joints, and the last."""
    moving, last = _moving_frames(robot), len(robot.joints)
    return (*moving, *(() if last in moving else (last,)))


def _origin(context: Context, i: int, moving: Sequence[int]) -> Relation:
    """o_i with its value, or the earlier origin in the same moving point."""
    point = frame_parts(context, i)[1]
    ring, entries = context.robot.ring, origin(context.values[f"H{i}"]).entries
    if any(map(ring.depends_on_coordinates, entries)):
        for j in moving:
            if j < i and frame_parts(context, j)[1] == point:
                return equation(letters.o(i), letters.o(j))
    return equation(letters.o(i), point)


def _of_frame_0(context: Context, moving: Sequence[int]) -> Prose:
    """Whose z_0 and o_0 are: no product of matrices leads to frame 0 where it is the world."""
    if 0 not in moving or letters.has_base(context.robot):
        return ()
    return ("; ", letters.z(0), " and ", letters.o(0), " are those of frame 0 itself")


def _same_origins(context: Context, moving: Sequence[int]) -> Prose:
    """Why origins are equal: a row whose d and a are 0 leaves the origin where it is."""
    robot = context.robot
    told = told_frames(robot)
    origins = {i: _origin(context, i, moving) for i in told if i}
    rows = [robot.joints[i - 1] for i, named in origins.items() if isinstance(named.parts[1], Letter)]
    if not rows or robot.is_tree or any(not (row.a.is_zero and row.d.is_zero) for row in rows):
        return ()
    _, d, a, _ = letters.columns(robot, letters.COUNT)
    where = f"row {rows[0].index}" if len(rows) == 1 else f"rows {and_joined([str(r.index) for r in rows])}"
    equal = listed([origins[row.index] for row in rows])
    return (f" In {where} of the table ", d, " and ", a, " are 0, so ", *equal, ".")


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


def _about(context: Context) -> Prose:
    """About or along whose axis a joint moves."""
    robot = context.robot
    z = letters.bold("z")
    if robot.is_tree:
        frame = "the frame that its row starts from" if context.standard else "its own frame"
        return (". A joint ", f"{_motions(robot)} the ", z, f" of {frame}.")
    before = letters.bold("z", letters.BEFORE if context.standard else letters.COUNT)
    told: Prose = (f". In the {robot.convention.value} convention joint i {_motions(robot)} ", before)
    if context.standard:
        return (*told, ", the axis of the frame before it.")
    return (
        *told,
        ", the axis of its own frame: where Spong, in the standard convention, has ",
        letters.bold("z", letters.BEFORE),
        " and ",
        letters.bold("o", letters.BEFORE),
        ", here stand ",
        letters.bold("z", letters.COUNT),
        " and ",
        letters.bold("o", letters.COUNT),
        ".",
    )


def _plain_joint(context: Context, k: int) -> Joint | None:
    """The one joint up to the end that coordinate k (from 0) moves, at its own rate; None for several."""
    moved = joints_moved(context, k, len(context.robot.joints))
    return moved[0][1] if len(moved) == 1 and moved[0][0] == 1 else None


def _column(context: Context, q: Coordinate) -> Step:
    robot, k = context.robot, q.index - 1
    last = len(robot.joints)
    in_letters = coordinate_column(context, k, last, letters.o(last))
    if in_letters is None:
        return _still_column(context, q)
    linear, angular = (column_of(context.matrix(name), k) for name in ("Jv", "Jw"))
    name = Letter("J", Number(q.index), style="bold")
    joint = _plain_joint(context, k)
    return Step(
        id=f"J{q.index}",
        stage=STAGE,
        title=f"Column {q.index} of the Jacobian",
        why=(Symbol(q.name), *_column_why(context, q, joint)),
        formula=equation(name, column(*in_letters)),
        source=spong("4.6.3"),
        working=column_shown(context, joints_moved(context, k, last), end_of(context), in_letters[0], linear),
        concluding=_turning_named(context, joint),
        result=(equation(name, _on_one_line(context, linear.rows + angular.rows)),),
        uses=("axes",),
    )


_WIDEST_ROW = 66
"""The characters up to which a column is written as one row, which fits the lines of an article."""


def _on_one_line(context: Context, rows: tuple[tuple[Node, ...], ...]) -> Node:
    """A column, written as a transposed row where those of all coordinates fit."""
    linear, angular = context.matrix("Jv"), context.matrix("Jw")
    columns = zip(*linear.rows, strict=True), zip(*angular.rows, strict=True)
    fits = all(
        matrix_width(context, Matrix(((*v, *w),))) <= _WIDEST_ROW for v, w in zip(*columns, strict=True)
    )
    row = Matrix((tuple(entry for (entry,) in rows),))
    return Transpose(row) if fits else Matrix(rows)


def _still_column(context: Context, q: Coordinate) -> Step:
    """The column of a coordinate that does not move the end: the angle of a motor, or of another branch."""
    moved = context.robot.joints_of(q)
    why = f" does not move {context.end}: its column is zero."
    if not moved and any(motor.turns == q.index - 1 for motor in context.robot.actions.motors):
        why = " turns a rotor alone and moves no link: its column is zero."
    name = Letter("J", Number(q.index), style="bold")
    return Step(
        id=f"J{q.index}",
        stage=STAGE,
        title=f"Column {q.index} of the Jacobian",
        why=(Symbol(q.name), why),
        source=spong("4.6.3"),
        result=(equation(name, ZERO),),
        uses=("axes",),
    )


def _turning_named(context: Context, joint: Joint | None) -> Prose:
    """The identities by which z × (o_n - o), worked out, becomes what is printed."""
    if joint is None or joint.type is JointType.PRISMATIC or not context.is_short:
        return ()
    used = used_in_cross(context, joint, end_of(context))
    return ("With ", *said(used), ":") if used else ()


def _read_off(context: Context) -> Prose:
    """How a product with an axis of the base is read off: told once, as the mass centres have such too."""
    told = _told_read_off(context)
    return (" ", *how_read_off(context, told[1]), ".") if told else ()


def _told_read_off(context: Context) -> tuple[int, Joint] | None:
    """The coordinate (from 0) of whose column it is told how it is read off, and the joint that it moves."""
    robot = context.robot
    if not (context.is_short and robot.has_table and robot.bodies):
        return None
    joint = read_off(context, len(robot.joints), end_of(context))
    alone = [_plain_joint(context, k) for k in range(robot.n)]
    return (alone.index(joint), joint) if joint and joint in alone else None


def where_told_read_off(context: Context) -> str:
    """The column that tells how a product with an axis of the base is read off; "" where none does."""
    told = _told_read_off(context)
    return f"J{told[0] + 1}" if told else ""


def _column_why(context: Context, q: Coordinate, joint: Joint | None) -> Prose:
    robot = context.robot
    if joint is None:
        moved = joints_moved(context, q.index - 1, len(robot.joints))
        where = listed([str(j.index) for _, j in moved])
        if len(moved) > 1:
            return (
                " moves the joints of rows ",
                *where,
                *((f" on the way to {context.end}",) if robot.is_tree else ()),
                "; its column is the sum of theirs, each times the rate at which that joint moves with ",
                Symbol(q.name),
                ".",
            )
        return (
            " moves the joint of row ",
            *where,
            " at ",
            number(moved[0][0]),
            " times its own rate, and so its column.",
        )
    if turns(q):
        return (
            " turns everything after it about the axis ",
            letters.z(joint_frame(robot, joint)),
            f". At unit rate the velocity of {context.end} is the cross product of the axis "
            "and the vector to that point from ",
            letters.o(joint_frame(robot, joint)),
            " on the axis; the angular velocity is the axis.",
        )
    z = letters.z(joint_frame(robot, joint))
    return (
        " moves everything after it along the axis ", z,
        f". At unit rate the velocity of {context.end} is that axis, and nothing turns.",
    )  # fmt: skip


def _whole(context: Context) -> Step:
    Jv, Jw = context.form("Jv"), context.form("Jw")
    in_letters: list[Node] = [letters.J, column(letters.JV, letters.JW)]
    if context.is_short:
        in_letters.append(_columns_in_letters(context))
    return Step(
        id="J",
        stage=STAGE,
        title=f"The Jacobian of {context.end}",
        why=(
            "The columns side by side. ",
            Product((letters.JV, letters.QD)),
            f" is the velocity of {context.end}, ",
            Product((letters.JW, letters.QD)),
            f" the angular velocity of frame {len(context.robot.joints)}.",
            *_still(context),
        ),
        formula=equation(*in_letters),
        source=spong("4.6.3"),
        result=(equation(letters.JV, Jv), equation(letters.JW, Jw)),
        together=context.robot.n <= BESIDE,
        also=("Jw",),
        uses=tuple(f"J{q.index}" for q in context.robot.coordinates),
        detail=Detail.BRIEF,
    )


def _still(context: Context) -> Prose:
    """Why J_v is zero, where nothing slides and the point is on the axes of all joints."""
    frames = [context.values[f"H{i}"] for i in _moving_frames(context.robot)]
    slides = any(joint.type is JointType.PRISMATIC for joint in context.robot.joints)
    if slides or not all(algebra.cross(axis(H), end_of(context) - origin(H)).is_zero for H in frames):
        return ()
    which = "all joint axes" if len(frames) > 1 else "the joint axis"
    last = letters.o(len(context.robot.joints))
    return (" ", equation(letters.JV, ZERO), ", as ", last, f" lies on {which}.")


def _columns_in_letters(context: Context) -> Matrix:
    """[z × (o_n - o) ...; z ...], a column a coordinate."""
    last = len(context.robot.joints)
    columns = (coordinate_column(context, k, last, letters.o(last)) for k in range(context.robot.n))
    return Matrix(tuple(zip(*(column or (ZERO, ZERO) for column in columns), strict=True)))
