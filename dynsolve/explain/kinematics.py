"""Steps of the forward kinematics: the table, A_i row by row, H_i as products."""

from __future__ import annotations

from collections.abc import Iterator

from dynsolve.document import Prose, Reference, Table
from dynsolve.explain.base_frame import base_step, motion
from dynsolve.explain.context import Context
from dynsolve.explain.forms import is_numeric
from dynsolve.explain.step import STATED, WORKED, Detail, Group, Part, Step
from dynsolve.explain.working.products import product_named
from dynsolve.explain.writing import craig, is_small, listed, side_by_side, spong, turns
from dynsolve.notation.tree import (
    Degrees,
    Function,
    Letter,
    Matrix,
    Negative,
    Node,
    Number,
    Product,
    Symbol,
    column,
    equation,
    number,
)
from dynsolve.notation.unicode import lowered
from dynsolve.quantities import letters
from dynsolve.quantities.stages import Stage
from dynsolve.robot.model import Joint, JointType

STAGE = Stage.KINEMATICS

ROWS = Group("A", "The matrices of the rows")

_ZERO, _ONE, _I = Number(0), Number(1), Symbol("i")


def steps(context: Context) -> Iterator[Step]:
    """The table, the base frame where it is turned, the general matrix, A_i and H_i."""
    yield _table(context)
    if letters.has_base(context.robot):
        yield base_step(context)
    yield _general(context)
    for joint in context.robot.joints:
        yield _row(context, joint)
    frames = Group("H", f"The frames seen from the {context.ground}", (*OUTWARDS, *_ORIGINS))
    for joint in context.robot.joints:
        yield _frame(context, joint.index, frames)


def table_of(context: Context) -> Table:
    """The rows of the table as they are written."""
    header: Prose = (_I, *letters.columns(context.robot, _I))
    if context.robot.is_tree:
        rows = ((str(joint.index), str(joint.parent), *joint.written) for joint in context.robot.joints)
        return Table((header[0], "from", *header[1:]), tuple(rows))
    return Table(header, tuple((str(joint.index), *joint.written) for joint in context.robot.joints))


def _table(context: Context) -> Step:
    robot, why = context.robot, _four_motions(context)
    if any(joint.type for joint in robot.joints):
        why += ("The star only marks a joint variable, and may be left out. Here ", *_kinds(context))
    if is_numeric(context.robot):
        why += (" Lengths are in m.",)
    return Step(
        id="dh",
        stage=STAGE,
        title="Denavit-Hartenberg table",
        why=why,
        source=spong("3.2") if context.standard else craig("3.4"),
        result=(equation(letters.Q, column(*(Symbol(q.name) for q in robot.coordinates))),),
        notes=tuple(_table_notes(context)),
        table=table_of(context),
        detail=Detail.FULL if context.normals else Detail.BRIEF,
        normal=Part.WHY | Part.NOTES,
        is_task=False,
    )


def _four_motions(context: Context) -> Prose:
    """How a row leads from a frame to the next, in the order of its convention."""
    theta, d, a, alpha = letters.columns(context.robot, _I)
    is_tree = context.robot.is_tree
    start = "the frame in the column `from`" if is_tree else "frame i-1"
    of = " of the former" if is_tree else ""
    x, z = (letters.bold(name, None if is_tree else letters.BEFORE) for name in "xz")
    if context.standard:
        return (f"In the standard convention (Spong) row i leads from {start} to frame i by a rotation by ",
                theta, " about ", z, f"{of}, a translation by ", d, " along it, a translation by ", a,
                " along ", letters.bold("x", _I), " and a rotation by ", alpha, " about that. ")  # fmt: skip
    return (f"In the modified convention (Craig) row i leads from {start} to frame i by a rotation by ",
            alpha, " about ", x, f"{of}, a translation by ", a, " along it, a rotation by ", theta, " about ",
            letters.bold("z", _I), " and a translation by ", d, " along that. Craig numbers ", a, " and ",
            alpha, " of row i by ", letters.BEFORE, ". ")  # fmt: skip


def _kinds(context: Context) -> Prose:
    """Which coordinates are angles, which lengths."""
    robot = context.robot
    turning = [Symbol(q.name) for q in robot.coordinates if turns(q)]
    sliding = [Symbol(q.name) for q in robot.coordinates if not turns(q)]
    prose: Prose = ()
    if turning:
        what = "is an angle (revolute joint)" if len(turning) == 1 else "are angles (revolute joints)"
        prose += (*listed(turning), f" {what}")
    if sliding:
        what = "is a length (prismatic joint)" if len(sliding) == 1 else "are lengths (prismatic joints)"
        prose += (*(("; ",) if turning else ()), *listed(sliding), f" {what}")
    return (*prose, ".")


def _table_notes(context: Context) -> Iterator[Prose]:
    robot = context.robot
    fixed = [str(joint.index) for joint in robot.joints if joint.type is None]
    if len(fixed) == 1:
        yield (f"Row {fixed[0]} has no star: a fixed frame, which keeps its place in the frame before it.",)
    elif fixed:
        yield ("Rows ", *listed(fixed), " have no star: frames that are each fixed in the one before it.")
    shared = [str(joint.index) for joint in robot.joints if len(joint.rates) > 1]
    if len(shared) == 1:
        yield (f"The joint variable of row {shared[0]} is not a coordinate itself but a combination of "
               "coordinates: its column of the Jacobian is shared out among them.",)  # fmt: skip
    elif shared:
        yield ("The joint variables of rows ", *listed(shared), " are not coordinates themselves but "
               "combinations of coordinates: their columns of the Jacobian are shared out among "
               "these.")  # fmt: skip
    for joint in robot.joints:
        if len(joint.rates) == 1 and joint.rates[0][1] != 1:
            ((k, rate),) = joint.rates
            name = Symbol(robot.coordinates[k].name)
            yield (
                f"The joint of row {joint.index} moves at ",
                number(rate),
                " times the rate of ",
                name,
                ".",
            )


def _cos(angle: Node) -> Node:
    return Function("cos", angle)


def _sin(angle: Node) -> Node:
    return Function("sin", angle)


def _times(*factors: Node) -> Node:
    return Product(factors)


def _general(context: Context) -> Step:
    theta, d, a, alpha = letters.columns(context.robot, _I)
    if context.standard:
        rows: tuple[tuple[Node, ...], ...] = (
            (_cos(theta), Negative(_times(_sin(theta), _cos(alpha))), _times(_sin(theta), _sin(alpha)),
             _times(a, _cos(theta))),
            (_sin(theta), _times(_cos(theta), _cos(alpha)), Negative(_times(_cos(theta), _sin(alpha))),
             _times(a, _sin(theta))),
            (_ZERO, _sin(alpha), _cos(alpha), d),
        )  # fmt: skip
        motions = (("z", theta), ("z", d), ("x", a), ("x", alpha))
    else:
        rows = (
            (_cos(theta), Negative(_sin(theta)), _ZERO, a),
            (_times(_sin(theta), _cos(alpha)), _times(_cos(theta), _cos(alpha)), Negative(_sin(alpha)),
             Negative(_times(d, _sin(alpha)))),
            (_times(_sin(theta), _sin(alpha)), _times(_cos(theta), _sin(alpha)), _cos(alpha),
             _times(d, _cos(alpha))),
        )  # fmt: skip
        motions = (("x", alpha), ("x", a), ("z", theta), ("z", d))
    product = Product(tuple(motion(axis, amount, amount in (theta, alpha)) for axis, amount in motions))
    in_full = Product(tuple(_motion(axis, amount, amount in (theta, alpha)) for axis, amount in motions))
    matrix = Matrix((*rows, (_ZERO, _ZERO, _ZERO, _ONE)))
    name = Letter("A", _I, style="bold")
    return Step(
        id="A",
        stage=STAGE,
        title="The matrix of a row",
        why=("The product of the four motions, into which the entries of each row are put.",),
        formula=equation(name, product),
        source=spong("3.2") if context.standard else craig("3.5"),
        working=(equation(name, in_full),) if context.is_short else (),
        normal=STATED | Part.WHY,
        task=equation(name, product, matrix),
        result=(equation(name, matrix),),
    )


def _motion(axis: str, amount: Node, turns: bool) -> Matrix:
    """The 4×4 matrix of a rotation about an axis, x or z, or of a translation along it."""
    rows: list[list[Node]] = [[_ONE if i == j else _ZERO for j in range(4)] for i in range(4)]
    first, second, along = (1, 2, 0) if axis == "x" else (0, 1, 2)
    if turns:
        rows[first][first] = rows[second][second] = _cos(amount)
        rows[first][second], rows[second][first] = Negative(_sin(amount)), _sin(amount)
    else:
        rows[along][3] = amount
    return Matrix(tuple(map(tuple, rows)))


def _row(context: Context, joint: Joint) -> Step:
    i = joint.index
    columns = letters.columns(context.robot, Number(i))
    given = side_by_side([equation(*pair) for pair in zip(columns, joint.written, strict=True)])
    general = Reference(("A",), " in ")
    match joint.type:
        case JointType.REVOLUTE:
            why: Prose = ("Only ", columns[0], " varies", general, ": a revolute joint.")
        case JointType.PRISMATIC:
            why = ("Only ", columns[1], " varies", general, ": a prismatic joint.")
        case None:
            why = ("Nothing varies", general, ": a fixed frame.")
    return Step(
        id=f"A{i}",
        stage=STAGE,
        title=f"Row {i} of the table: A{lowered(str(i))}",
        why=why,
        source=spong("3.2") if context.standard else craig("3.4"),
        working=(given, *_folded(context, joint)),
        task=given,
        result=(equation(letters.A(i), context.form(f"A{i}")),),
        normal=Part.RESULT,
        group=ROWS,
    )


def _folded(context: Context, joint: Joint) -> Iterator[Node]:
    """cos(θ₁ + 90°) = -s₁ and the like, where the row holds an angle that is not a bare variable."""
    ring = context.robot.ring
    shown: list[Node] = []
    for node, angle in ((joint.written[0], joint.theta), (joint.written[3], joint.alpha)):
        if isinstance(node, Symbol) or not (angle.degrees or angle.terms):
            continue
        if isinstance(node, Number | Degrees) or angle.degrees:
            shown.append(equation(_cos(node), context.show(ring.cos(angle))))
            shown.append(equation(_sin(node), context.show(ring.sin(angle))))
    if shown:
        yield side_by_side(shown)


def _frame(context: Context, i: int, frames: Group) -> Step:
    robot = context.robot
    last = i == len(robot.joints)
    start = robot.joints[i - 1].parent
    A, before, H = context.form(f"A{i}"), context.form(f"H{start}"), context.form(f"H{i}")
    name = letters.H(robot, i)
    detail = Detail.BRIEF if last else Detail.NORMAL
    if start == 0 and not letters.has_base(robot):
        which = "The first frame" if i == 1 else f"Frame {i}"
        return Step(
            id=f"H{i}",
            stage=STAGE,
            title=f"Frame {i} seen from the base",
            why=(f"{which} is seen from frame 0 itself, so no product is needed.",),
            source=_products(context),
            result=(equation(name, letters.A(i), H),),
            detail=Detail.BRIEF if last else Detail.FULL,
            group=frames,
        )
    chain = [letters.A(joint.index) for joint in robot.path(i)]
    if letters.has_base(robot):
        chain = [letters.H(robot, 0), *chain]
    is_row = len(robot.path(start)) == 1 and not letters.has_base(robot)  # of which H is A itself
    working = Product((letters.A(start) if is_row else letters.H(robot, start), letters.A(i)))
    members: list[Node] = [name, working]
    if is_small(A, before):
        members.append(Product((before, A)))
    return Step(
        id=f"H{i}",
        stage=STAGE,
        title=f"Frame {i} seen from the {context.ground}",
        why=_frame_why(context, tells=not _multiplied_before(context, i)) if last else OUTWARDS,
        formula=equation(name, Product(tuple(chain))) if last or len(chain) > 2 else None,
        source=_products(context),
        working=(equation(*members),),
        concluding=product_named(context, *(context.values[key] for key in (f"H{start}", f"A{i}", f"H{i}"))),
        result=(equation(name, H),),
        uses=(f"A{start}", f"A{i}") if is_row else None,
        task=equation(name, working) if i > 1 else None,
        detail=detail,
        normal=WORKED,
        group=frames,
    )


def _products(context: Context) -> str:
    """Where the textbook of the convention multiplies the rows' matrices."""
    return spong("3.1") if context.standard else craig("3.5")


def _multiplied_before(context: Context, i: int) -> bool:
    """Whether a frame before frame i is a product too."""
    return letters.has_base(context.robot) or any(joint.parent for joint in context.robot.joints[: i - 1])


OUTWARDS: Prose = (
    "Each ",
    Letter("A", style="bold"),
    " leads one frame further along the arm, so it multiplies from the right.",
)
"""Why the matrices of the rows stand in this order."""


_ORIGINS: Prose = (" The fourth column is the origin of the frame, the first three are its axes.",)


def _frame_why(context: Context, tells: bool) -> Prose:
    """What the last frame tells, and of which point; with `tells` why the matrices stand in this order."""
    why: Prose = (f"The fourth column is where {context.end} is, the first three ",)
    why = (*OUTWARDS, " ", *why) if tells else why
    if not context.robot.ends_in_a_joint:
        return (*why, "how that frame is turned." if context.robot.is_tree else "how it is turned.")
    return (
        *why,
        "how that frame is turned. In the modified convention it lies in the last joint: the end of the arm "
        "would need a row of its own, without a star.",
    )
