"""Steps of the end-effector Jacobian: axes and origins, column by column, J_v and J_ω.

And the columns z × (p - o) of any point, in letters and with the axes and levers of a robot put in.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from fractions import Fraction
from itertools import groupby, pairwise
from operator import itemgetter

from msgspec.structs import replace

from dynsolve.algebra import matrix as algebra
from dynsolve.algebra.ring import Expr
from dynsolve.derivation.kinematics import axis, joint_frame, origin
from dynsolve.document import Prose, Reference
from dynsolve.document.books import spong
from dynsolve.document.sentences import say
from dynsolve.explain.context import Context
from dynsolve.explain.matrix_factors import factored, matrix_width
from dynsolve.explain.step import Detail, Group, Part, Step
from dynsolve.explain.working import squares
from dynsolve.explain.working.identities import Identity, said, used_in_product
from dynsolve.explain.writing import (
    and_joined,
    block_of,
    column_of,
    is_small,
    listed,
    side_by_side,
    sum_of,
    turns,
)
from dynsolve.notation.build import cost, times, total
from dynsolve.notation.template import formula
from dynsolve.notation.tree import (
    Cross,
    Letter,
    Matrix,
    Negative,
    Node,
    Number,
    Parenthesized,
    Product,
    Relation,
    Row,
    Sum,
    Symbol,
    Transpose,
    Words,
    column,
    equation,
    number,
    walk,
)
from dynsolve.quantities import letters
from dynsolve.robot.model import Coordinate, Joint, JointType, Robot

ZERO = Letter("0", style="bold")
"""The zero vector."""

BESIDE = 2
"""Up to this number of columns J_v and J_ω, and v and ω, stand on one line."""

_WIDEST_ROW = 66
"""The characters up to which a column is written as one row, which fits the lines of an article."""


def steps(context: Context) -> Iterator[Step]:
    """Axes and origins, a column a coordinate, and J."""
    yield _axes(context)
    whole = _whole(context)
    concluding = _identities(context, range(context.robot.n))
    group = Group("J", whole.title, whole.why, whole.formula, whole.source, concluding)
    for q in context.robot.coordinates:
        yield replace(_column(context, q), normal=Part.WORKING, group=group)
    yield replace(whole, group=group)


# -- the step of axes and origins ------------------------------------------------------------------


def _axes(context: Context) -> Step:
    moving, told = _moving_frames(context.robot), told_frames(context.robot)
    shown: dict[int, list[Node]] = {i: [_origin(context, i, moving)] for i in told}
    for i in moving:
        shown[i].insert(0, equation(letters.z(i), frame_parts(context, i)[0]))
    matrices: Prose = ("each ", replace(letters.H(context.robot, 0), sub=letters.COUNT))
    if context.is_short:  # of a long arm not all of them are printed
        matrices = say("$𝐇${where}", where=Reference(tuple(f"H{i}" for i in told if i), " in "))
    is_frame_0 = 0 in moving and not letters.has_base(context.robot)
    read_off = told_read_off(context)
    is_chain = not context.robot.is_tree and not letters.has_base(context.robot)
    return Step(
        id="axes",
        title="Axes and origins of the frames",
        why=say(
            "{products}In the first three rows of {matrices} the third column is $𝐳$, the fourth "
            "$𝐨${frame_0}. {about}{same}{wrist}{read_off}",
            products=say("Frame i is $𝐇_i^0 = 𝐀_1 '…' 𝐀_i$. ") if is_chain and context.is_in_letters else "",
            matrices=matrices,
            frame_0=say("; $𝐳_0$ and $𝐨_0$ are those of frame 0 itself") if is_frame_0 else (),
            about=_about(context),
            same=_same_origins(context, moving),
            wrist=_wrist(context),
            read_off=say(" {how}.", how=how_read_off(context, read_off[1])) if read_off else (),
        ),
        source=context.by_convention("4.6", "3.4"),
        result=tuple(map(side_by_side, shown.values())),
        uses=(),
    )


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
    entries = origin(context.values[f"H{i}"]).entries
    if any(map(context.robot.ring.depends_on_coordinates, entries)):
        for j in moving:
            if j < i and frame_parts(context, j)[1] == point:
                return equation(letters.o(i), letters.o(j))
    return equation(letters.o(i), point)


def _about(context: Context) -> Prose:
    """About or along whose axis a joint moves."""
    robot = context.robot
    kinds = {JointType.REVOLUTE: "turns about", JointType.PRISMATIC: "slides along"}
    moves = " or ".join(words for kind, words in kinds.items() if any(j.type is kind for j in robot.joints))
    if robot.is_tree:
        frame = "the frame that its row starts from" if context.standard else "its own frame"
        return say("A joint {moves} the $𝐳$ of {frame}.", moves=moves, frame=frame)
    own = "$𝐳_(i-1)$, the axis of the frame before it."
    if not context.standard:
        own = "$𝐳_i$, the axis of its own frame: where Spong, in the standard convention, has $𝐳_(i-1)$ and "
        own += "$𝐨_(i-1)$, here stand $𝐳_i$ and $𝐨_i$."
    joint = "joint i" if all(joint.type for joint in robot.joints) else "the joint of row i"
    return say(f"In the {robot.convention.value} convention {joint} {moves} {own}")


def _same_origins(context: Context, moving: Sequence[int]) -> Prose:
    """Why origins are equal: a row whose d and a are 0 leaves the origin where it is."""
    robot = context.robot
    origins = {i: _origin(context, i, moving) for i in told_frames(robot) if i}
    rows = [robot.joints[i - 1] for i, named in origins.items() if isinstance(named.parts[1], Letter)]
    if not rows or robot.is_tree or any(not (row.a.is_zero and row.d.is_zero) for row in rows):
        return ()
    _, d, a, _ = letters.columns(robot, letters.COUNT)
    return say(
        " In {rows} of the table {d} and {a} are 0, so {equal}.",
        rows=f"row{'s' if len(rows) > 1 else ''} {and_joined([str(row.index) for row in rows])}",
        d=d,
        a=a,
        equal=listed([origins[row.index] for row in rows]),
    )


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
            words = " The last three axes, {axes}, meet in {o}: a spherical wrist."
            return say(words, axes=listed([letters.z(k) for k in frames]), o=letters.o(i))
    return ()


# -- the columns -----------------------------------------------------------------------------------


def _plain_joint(context: Context, k: int) -> Joint | None:
    """The one joint up to the end that coordinate k (from 0) moves, at its own rate; None for several."""
    moved = joints_moved(context, k, len(context.robot.joints))
    return moved[0][1] if len(moved) == 1 and moved[0][0] == 1 else None


def _column(context: Context, q: Coordinate) -> Step:
    k, last, point = q.index - 1, len(context.robot.joints), end_of(context)
    in_letters = coordinate_column(context, k, last, letters.o(last))
    name = letters.bold("J", Number(q.index))
    step = Step(
        id=f"J{q.index}",
        title=f"Column {q.index} of the Jacobian",
        source=spong("4.6.3"),
        result=(equation(name, ZERO),),
        uses=("axes",),
    )
    if in_letters is None:
        drives = not context.robot.joints_of(q) and any(m.turns == k for m in context.robot.actions.rotors)
        why = " turns a rotor alone and moves no link" if drives else f" does not move {context.end}"
        return replace(step, why=(Symbol(q.name), why, ": its column is zero."))
    linear, angular = (column_of(context.matrix(name), k) for name in ("Jv", "Jw"))
    return replace(
        step,
        why=(Symbol(q.name), *_column_why(context, q, _plain_joint(context, k))),
        formula=equation(name, column(*in_letters)),
        working=column_shown(context, joints_moved(context, k, last), point, in_letters[0], linear),
        concluding=_identities(context, [k]),
        result=(equation(name, _on_one_line(context, linear.rows + angular.rows)),),
    )


def _identities(context: Context, columns: Iterable[int]) -> Prose:
    """What leads to columns (from 0) by the identities that they use."""
    used: dict[Identity, None] = {}
    for k in columns if context.is_short else ():
        joint = _plain_joint(context, k)
        if joint and joint.type is not JointType.PRISMATIC:
            used |= dict.fromkeys(used_in_cross(context, joint, end_of(context)))
    return ("With ", *said(list(used)), ":") if used else ()


def _on_one_line(context: Context, rows: tuple[tuple[Node, ...], ...]) -> Node:
    """A column, written as a transposed row where those of all coordinates fit."""
    linear, angular = context.matrix("Jv").rows, context.matrix("Jw").rows
    in_rows = [Matrix((entries,)) for entries in zip(*linear, *angular, strict=True)]
    fits = all(matrix_width(context, row) <= _WIDEST_ROW for row in in_rows)
    return Transpose(Matrix((tuple(entry for (entry,) in rows),))) if fits else Matrix(rows)


def _column_why(context: Context, q: Coordinate, joint: Joint | None) -> Prose:
    robot = context.robot
    if joint is None:
        moved = joints_moved(context, q.index - 1, len(robot.joints))
        if len(moved) == 1:
            words = " moves the joint of row {row} at {rate} times its own rate, and so its column."
            return say(words, row=moved[0][1].index, rate=number(moved[0][0]))
        return say(
            " moves the joints of rows {rows}{way}; its column is the sum of theirs, each times the rate at "
            "which that joint moves with {q}.",
            rows=listed([str(j.index) for _, j in moved]),
            way=f" on the way to {context.end}" if robot.is_tree else "",
            q=Symbol(q.name),
        )
    i = joint_frame(robot, joint)
    return say(
        " turns everything after it about the axis {z}. At unit rate the velocity of {end} is the cross "
        "product of the axis and the vector to that point from {o} on the axis; the angular velocity is the "
        "axis."
        if turns(q)
        else " moves everything after it along the axis {z}. At unit rate the velocity of {end} is that "
        "axis, and nothing turns.",
        z=letters.z(i),
        o=letters.o(i),
        end=context.end,
    )


def told_read_off(context: Context) -> tuple[int, Joint] | None:
    """The column of which it is told how it is read off, z being an axis of the base, and its joint."""
    robot = context.robot
    if not (context.is_short and robot.has_table and robot.bodies):
        return None
    joint = read_off(context, len(robot.joints), end_of(context))
    alone = [_plain_joint(context, k) for k in range(robot.n)]
    return (alone.index(joint) + 1, joint) if joint and joint in alone else None


# -- the whole -------------------------------------------------------------------------------------


def _whole(context: Context) -> Step:
    n, last = context.robot.n, len(context.robot.joints)
    in_letters = [letters.J, column(letters.JV, letters.JW)]
    if context.is_short or n <= MOST_COLUMNS:
        columns = (coordinate_column(context, k, last, letters.o(last)) or (ZERO, ZERO) for k in range(n))
        in_letters.append(Matrix(tuple(zip(*columns, strict=True))))
    shown = _by_columns(context) if context.is_in_letters else None
    return Step(
        id="J",
        title=f"The Jacobian of {context.end}",
        why=say(
            "The columns side by side. ${Jv} 𝐪̇$ is the velocity of {end}, $𝐉_ω 𝐪̇$ the angular velocity of "
            "frame {last}{of_tree}.{shared}{still}",
            Jv=letters.JV,
            of_tree=", the end that the last row leads to" if context.robot.is_tree else "",
            end=context.end,
            last=last,
            shared=_shared(context),
            still=_still(context),
        ),
        formula=equation(*in_letters),
        source=spong("4.6.3"),
        concluding=()
        if shown is None
        else say("The columns of {Jv} from the first to the last, and {Jw}:", Jv=letters.JV, Jw=letters.JW),
        result=(shown or equation(letters.JV, context.form("Jv")), equation(letters.JW, context.form("Jw"))),
        together=n <= BESIDE,
        also=("Jv", "Jw"),
        uses=tuple(f"J{q.index}" for q in context.robot.coordinates),
        detail=Detail.BRIEF,
    )


MOST_COLUMNS = 5
"""Up to this number the columns of a long Jacobian stand side by side in letters."""

LONGEST_ENTRY = 40
"""The operations in an entry of the Jacobian up to which three columns stand on a line or two."""


def _by_columns(context: Context) -> Node | None:
    """J_v by its columns, equal neighbours in one chain: all side by side are too wide for a page."""
    J, last = context.matrix("Jv"), len(context.robot.joints)
    names = [coordinate_column(context, k, last, letters.o(last)) for k in range(context.robot.n)]
    if None in names or max(cost(entry) for row in J.rows for entry in row) > LONGEST_ENTRY:
        return None
    return side_by_side(list(columns_shown(names, J)))


def columns_shown(names: Sequence[tuple[Node, Node] | None], J: Matrix) -> Iterator[Node]:
    """The columns of J_v that have a name, equal neighbours in one chain."""
    named = [(column_of(J, k), name[0]) for k, name in enumerate(names) if name is not None]
    for value, equal in groupby(named, itemgetter(0)):
        is_zero = all(row == (Number(0),) for row in value.rows)
        yield equation(*(name for _, name in equal), ZERO if is_zero else value)


def _shared(context: Context) -> Prose:
    """What the columns of coordinates are that move several joints, or one at another rate."""
    last = len(context.robot.joints)
    moved = [joints_moved(context, k, last) for k in range(context.robot.n)]
    if all(rate == 1 for one in moved for rate, _ in one) and all(len(one) < 2 for one in moved):
        return ()
    return say(
        " Where a coordinate moves several joints, its column is the sum of theirs, each times the rate at "
        "which that joint moves with it."
    )


def _still(context: Context) -> Prose:
    """Why J_v is zero, where nothing slides and the point is on the axes of all joints."""
    frames = [context.values[f"H{i}"] for i in _moving_frames(context.robot)]
    slides = any(joint.type is JointType.PRISMATIC for joint in context.robot.joints)
    if slides or not all(algebra.cross(axis(H), end_of(context) - origin(H)).is_zero for H in frames):
        return ()
    which = "all joint axes" if len(frames) > 1 else "the joint axis"
    o = letters.o(len(context.robot.joints))
    return say(" {zero}, as {o} lies on {which}.", zero=equation(letters.JV, ZERO), o=o, which=which)


# -- columns z × (p - o) of a point p: in letters ---------------------------------------------------


def frame_parts(context: Context, i: int) -> tuple[Matrix, Matrix]:
    """(z_i, o_i) as trees."""
    H = context.matrix(f"H{i}")
    return block_of(H, 3, 2, 3), block_of(H, 3, 3, 4)


def end_of(context: Context) -> algebra.Matrix:
    """o_n, the end of the arm."""
    return origin(context.values[f"H{len(context.robot.joints)}"])


def joints_moved(context: Context, k: int, link: int) -> list[tuple[Fraction, Joint]]:
    """The joints up to a link that coordinate k (from 0) moves, each with its rate."""
    return [(rate, joint) for joint in context.robot.path(link) for i, rate in joint.rates if i == k]


def column_letters(context: Context, joint: Joint, point: Node) -> tuple[Node, Node]:
    """(J_v, J_ω) of one joint in letters: z × (p - o) and z, or z and 0."""
    i = joint_frame(context.robot, joint)
    z = letters.z(i)
    if joint.type is JointType.REVOLUTE:
        return formula("{z} × ({p} - {o})", z=z, p=point, o=letters.o(i)), z
    return z, ZERO


def coordinate_column(context: Context, k: int, link: int, point: Node) -> tuple[Node, Node] | None:
    """(J_v, J_ω) of coordinate k (from 0) in letters, None where no joint up to `link` moves with it."""
    moved = joints_moved(context, k, link)
    if not moved:
        return None
    columns = [(rate, *column_letters(context, joint, point)) for rate, joint in moved]
    linear = _total([(rate, linear) for rate, linear, _ in columns])
    return linear, _total([(rate, angular) for rate, _, angular in columns if angular != ZERO])


def _total(terms: Sequence[tuple[Fraction, Node]]) -> Node:
    return sum_of([_rated(rate, part) for rate, part in terms]) if terms else ZERO


def _rated(rate: Fraction, node: Node) -> Node:
    if abs(rate) == 1:
        return node if rate == 1 else Negative(node)
    return Product((number(rate), node))


# -- those that are a look: z is an axis of the base and o a fixed point, so that two coordinates of p - o
# change places


def _axis_and_lever(
    context: Context, joint: Joint, point: algebra.Matrix
) -> tuple[algebra.Matrix, algebra.Matrix]:
    """z of a joint, and p - o, from its axis to a point."""
    H = context.values[f"H{joint_frame(context.robot, joint)}"]
    return axis(H), point - origin(H)


def _is_fixed(context: Context, joint: Joint) -> bool:
    """Whether the axis of a joint is one of those of the base, through a point that does not move."""
    H = context.values[f"H{joint_frame(context.robot, joint)}"]
    moves = any(map(context.robot.ring.depends_on_coordinates, origin(H).entries))
    return sum(not entry.is_zero for entry in axis(H).entries) == 1 and not moves


def _looks(context: Context, link: int, point: algebra.Matrix) -> Iterator[tuple[Joint, bool]]:
    """The joints up to a link whose column is a look, p not being o, and whether z and p - o are parallel."""
    for joint in context.robot.path(link):
        z, lever = _axis_and_lever(context, joint, point)
        if joint.type is JointType.REVOLUTE and _is_fixed(context, joint) and not lever.is_zero:
            yield joint, algebra.cross(z, lever).is_zero


def read_off(context: Context, link: int, point: algebra.Matrix) -> Joint | None:
    """The first joint whose column is a look and not zero; None without any."""
    return next((joint for joint, is_zero in _looks(context, link, point) if not is_zero), None)


def how_read_off(context: Context, joint: Joint) -> Prose:
    """z₀ × (u₁, u₂, u₃)ᵀ = (-u₂, u₁, 0)ᵀ, by which a column of this joint is a look."""
    i = joint_frame(context.robot, joint)
    u = [letters.any_vector(Number(k)) for k in (1, 2, 3)]
    turned: list[Node] = []
    for row in algebra.skew(axis(context.values[f"H{i}"])).rows:
        signed = [(sign.number, e) for sign, e in zip(row, u, strict=True) if not sign.is_zero]
        turned.append(total([e if sign > 0 else Negative(e) for sign, e in signed]))
    return (equation(Cross(letters.z(i), _in_a_row(u)), _in_a_row(turned)), " for any vector")


def _in_a_row(entries: Sequence[Node]) -> Node:
    """(a, b, c)ᵀ, a column within a sentence."""
    a, b, c = entries
    return Transpose(Parenthesized(Row((a, Words(", "), b, Words(", "), c))))


def parallel(context: Context, link: int, name: Node, point: algebra.Matrix) -> Prose:
    """Why a column z × (p - o) that is a look is zero: p is on the axis; nothing of others."""
    for joint, is_zero in _looks(context, link, point):
        if is_zero:
            i = joint_frame(context.robot, joint)
            words = " ${p} - {o}$ is parallel to {z}, so their cross product is zero."
            return say(words, p=name, o=letters.o(i), z=letters.z(i))
    return ()


# -- and with the axes and levers of this robot ----------------------------------------------------


def crosses(
    context: Context, link: int, name: Node, point: algebra.Matrix, J: Matrix
) -> tuple[tuple[Node, ...], Prose]:
    """The columns z × (p - o) of a point p of a link that are more than a look, and their identities."""
    if not context.is_short:
        return (), ()
    shown: list[Node] = []
    for k in range(context.robot.n):
        moved = joints_moved(context, k, link)
        turning = [joint for _, joint in moved if joint.type is JointType.REVOLUTE]
        if not all(_is_fixed(context, joint) for joint in turning):
            in_letters = coordinate_column(context, k, link, name)
            assert in_letters is not None
            shown += column_shown(context, moved, point, in_letters[0], column_of(J, k), of_body=True)
    turning = [joint for joint in context.robot.path(link) if joint.type is JointType.REVOLUTE]
    used = dict.fromkeys(each for joint in turning for each in used_in_cross(context, joint, point))
    words = "With " if shown else "The cross products, with "
    return tuple(shown), (words, *said(list(used)), ":") if used else ()


def used_in_cross(context: Context, joint: Joint, point: algebra.Matrix) -> list[Identity]:
    """The identities by which z × (p - o) of a joint becomes what is printed."""
    z, lever = _axis_and_lever(context, joint, point)
    return used_in_product(context, algebra.skew(z), lever, algebra.cross(z, lever))


def column_shown(
    context: Context,
    moved: Sequence[tuple[Fraction, Joint]],
    point: algebra.Matrix,
    in_letters: Node,
    linear: Matrix,
    *,
    of_body: bool = False,
) -> tuple[Node, ...]:
    """A column of J_v with this robot's axes and levers put in, where there is anything to work out.

    Its value stands at the end, behind the products where terms of them add up; where an identity leads
    to it, the product as it is multiplied out.  What its entries share stands in front of that `of_body`.
    """
    turning = [joint for _, joint in moved if joint.type is JointType.REVOLUTE]
    if not turning:
        return ()
    alone = moved[0][1] if len(moved) == 1 else None
    if alone and (nothing := _zero_column(context, alone, point, in_letters)) is not None:
        return nothing
    parts: list[tuple[Fraction, Node]] = []
    small: list[Node] = []
    for rate, joint in moved:
        part: Node = frame_parts(context, joint_frame(context.robot, joint))[0]
        small.append(part)
        if joint.type is JointType.REVOLUTE:
            small.append(context.show(_axis_and_lever(context, joint, point)[1]))
            part = Cross(part, small[-1])
        parts.append((rate, part))
    if not is_small(*small):
        return ()
    values: list[Node] = [linear]
    if any(used_in_cross(context, joint, point) for joint in turning):
        values = [_multiplied_out(context, alone, point)] if alone else []
    elif alone and any(map(_adds_up, _products(context, alone, point))):
        values.insert(0, _multiplied_out(context, alone, point))
    shown = [equation(in_letters, _total(parts), *values)]
    if alone and (difference := _difference(context, alone, point, in_letters)):
        shown.insert(0, equation(*difference))
    if of_body:
        return tuple(equation(*(factored(context, part) for part in each.parts)) for each in shown)
    return tuple(shown)


def _zero_column(
    context: Context, joint: Joint, point: algebra.Matrix, in_letters: Node
) -> tuple[Node, ...] | None:
    """Why a column z × (p - o) is zero: p - o is, or is a multiple of z; None where it is neither."""
    z, lever = _axis_and_lever(context, joint, point)
    if lever.is_zero:
        difference = _difference_in(in_letters)
        end, start = difference.terms
        return () if start == Negative(end) else (equation(difference, ZERO),)
    pairs = zip(lever.entries, z.entries, strict=True)
    factor = next(filter(None, (a.quotient(b) for a, b in pairs if not b.is_zero)), None)
    if factor is None or z.scale(factor) != lever:
        return None
    own = letters.z(joint_frame(context.robot, joint))
    multiple = times(1, [(context.show(factor), 1), (own, 1)])
    return (equation(in_letters, Cross(own, Parenthesized(multiple)), ZERO),)


def _difference_in(in_letters: Node) -> Sum:
    """p - o in z × (p - o)."""
    between = next(part.argument for part in walk(in_letters) if isinstance(part, Parenthesized))
    assert isinstance(between, Sum)
    return between


def _difference(context: Context, joint: Joint, point: algebra.Matrix, in_letters: Node) -> tuple[Node, ...]:
    """The members of p - o with both put in, where it is more than leaving out the terms of o."""
    start = frame_parts(context, joint_frame(context.robot, joint))[1]
    end, lever = context.show(point), context.show(_axis_and_lever(context, joint, point)[1])
    assert isinstance(end, Matrix) and isinstance(lever, Matrix)
    rows = zip(end.rows, start.rows, lever.rows, strict=True)
    if all(set(_terms(p)) == {*_terms(o), *_terms(rest)} for (p,), (o,), (rest,) in rows):
        return ()
    between = _difference_in(in_letters)
    if (before := _same_origin(context, joint)) is not None:
        return between, Sum((between.terms[0], Negative(letters.o(before))))
    both = (Sum((end, Negative(start))),) if is_small(end, start) else ()
    return between, *both, lever


def _same_origin(context: Context, joint: Joint) -> int | None:
    """The frame of an earlier joint whose axis meets this one's in one origin, and whose p - o is shown."""
    own = origin(context.values[f"H{joint_frame(context.robot, joint)}"])
    for before in context.robot.path(joint.index - 1):
        i = joint_frame(context.robot, before)
        turns = before.type is JointType.REVOLUTE and not _is_fixed(context, before)
        if turns and origin(context.values[f"H{i}"]) == own:
            return i
    return None


def _terms(node: Node) -> tuple[Node, ...]:
    if node == number(0):
        return ()
    return node.terms if isinstance(node, Sum) else (node,)


def _products(context: Context, joint: Joint, point: algebra.Matrix) -> list[list[tuple[Expr, Expr]]]:
    """Of each entry of z × (p - o) the products that it is the sum of, an entry of each, none 0."""
    z, lever = _axis_and_lever(context, joint, point)
    pairs = [zip(row, lever.entries, strict=True) for row in algebra.skew(z).rows]
    return [[(a, b) for a, b in row if not (a.is_zero or b.is_zero)] for row in pairs]


def _adds_up(factors: Sequence[tuple[Expr, Expr]]) -> bool:
    """Whether terms of several products are alike, so that their numbers are added: ¼ and ¾."""
    products = [a * b for a, b in factors]
    return bool(products) and sum(map(len, products)) > len(sum(products[1:], start=products[0]))


def _multiplied_out(context: Context, joint: Joint, point: algebra.Matrix) -> Matrix:
    """z × (p - o) of a joint before s² + c² = 1 is used, and before the numbers of like terms are added."""
    ring, collector = context.robot.ring, context.forms.compactor.collector
    entries: list[Node] = []
    for factors in _products(context, joint, point):
        poly = ring.reduce_roots(sum((a.poly * b.poly for a, b in factors), start=ring.zero.poly))
        value = Expr(ring, ring.reduce(poly))
        if value.poly != poly:
            entries.append(squares.factored(context.forms, poly))
        elif _adds_up(factors):
            products = (Product((context.show(a), context.show(b))) for a, b in factors)
            entries.append(total([collector.product(*collector.decompose(each), ()) for each in products]))
        else:
            entries.append(context.show(value))
    return column(*entries)
