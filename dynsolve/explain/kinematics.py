"""Steps of the forward kinematics: the table, A_i row by row, H_i as products."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from dynsolve.algebra.matrix import Matrix
from dynsolve.derivation import inertia
from dynsolve.derivation.kinematics import rotation
from dynsolve.document import Prose, Reference, Table
from dynsolve.explain.context import Context
from dynsolve.explain.forms import is_numeric
from dynsolve.explain.step import STATED, WORKED, Detail, Group, Part, Step
from dynsolve.explain.working.identities import product_named
from dynsolve.explain.writing import craig, is_small, listed, name_of, side_by_side, spong, turns
from dynsolve.notation import tree
from dynsolve.notation.tree import (
    Degrees,
    Function,
    Letter,
    Negative,
    Node,
    Number,
    Product,
    Row,
    Symbol,
    Words,
    column,
    equation,
    number,
)
from dynsolve.notation.unicode import lowered
from dynsolve.quantities import letters
from dynsolve.quantities.stages import Stage
from dynsolve.robot.model import Body, Joint, JointType, Robot

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
    matrix = tree.Matrix((*rows, (_ZERO, _ZERO, _ZERO, _ONE)))
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


def _motion(axis: str, amount: Node, turns: bool) -> tree.Matrix:
    """The 4×4 matrix of a rotation about an axis, x or z, or of a translation along it."""
    rows: list[list[Node]] = [[_ONE if i == j else _ZERO for j in range(4)] for i in range(4)]
    first, second, along = (1, 2, 0) if axis == "x" else (0, 1, 2)
    if turns:
        rows[first][first] = rows[second][second] = _cos(amount)
        rows[first][second], rows[second][first] = Negative(_sin(amount)), _sin(amount)
    else:
        rows[along][3] = amount
    return tree.Matrix(tuple(map(tuple, rows)))


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


# -- the step of the base frame, H_0 in the world, and the elementary motions that matrices are products of


def motion(axis: str, amount: Node, turns: bool) -> Node:
    """Rot_{z,θ} or Trans_{z,d}: how far is a value, and set as values are, not as what names an index."""
    return Letter("Rot" if turns else "Trans", _along(axis, amount), style="upright")


def elementary_rotation(axis: str, angle: Node) -> Node:
    """R_{z,θ}: the 3×3 part of Rot_{z,θ}."""
    return Letter("R", _along(axis, angle), style="bold")


def turned(turns: Sequence[tuple[str, Node]]) -> Node:
    """R_{z,θ} R_{x,α}: elementary rotations one after the other."""
    factors = tuple(elementary_rotation(axis, angle) for axis, angle in turns)
    return Product(factors) if len(factors) > 1 else factors[0]


def _along(axis: str, amount: Node) -> Row:
    return Row((Words(axis), Words(","), Row((amount,))))


def base_step(context: Context) -> Step:
    """H_0, the product of how frame 0 is moved and turned, as the problem writes it."""
    robot = context.robot
    H, turned = letters.H(robot, 0), robot.base_rotation
    moved = tuple(
        motion(axis, context.show(entry), False)
        for axis, entry in zip("xyz", robot.base_position.entries, strict=True)
        if not entry.is_zero
    )
    is_turned = turned != turned.identity(robot.ring, 3)
    how = " and ".join([*["turned"] * is_turned, *["moved"] * bool(moved)])
    why: Prose = (f"Gravity is given in the world w, in which frame 0 is {how}. ",)
    factors = (*moved, *(motion(axis, angle, True) for axis, angle in robot.base_turns))
    is_whole = bool(robot.base_turns) or not is_turned
    if not is_whole:
        why += ("Its axes are the columns of the rotation that the problem gives. ",)
    elif len(factors) > 1:
        why += ("Each motion is along or about an axis of the frame that those before it have led to. ",)
    why += ("The heights, and the vectors below where nothing else is said, are in world coordinates.",)
    return Step(
        id="H0",
        stage=Stage.KINEMATICS,
        title="The base frame in the world",
        why=why,
        formula=equation(H, Product(factors) if len(factors) > 1 else factors[0]) if is_whole else None,
        source=spong("2.7"),
        result=(equation(H, context.form("H0")),),
        notes=tuple(_matters_to(robot)),
        detail=Detail.BRIEF,
    )


def _matters_to(robot: Robot) -> Iterator[Prose]:
    """Where frame 0 is turned against gravity: which of the results depend on how."""
    if robot.bodies and robot.base_rotation @ robot.gravity != robot.gravity:
        yield (
            "In the results, how the base is turned matters to the potential energy and the gravity terms "
            "alone: a constant rotation leaves lengths unchanged, so it cancels in the kinetic energy.",
        )


# -- of axes of a body that a problem gives from the base: which frame of the arm they belong to, and how


def product_of_axes(context: Context, body: Body) -> Node | None:
    """The rotation as the problem writes it, behind that of the base where there is one; None of a matrix."""
    robot = context.robot
    base = (letters.R(robot, 0),) if letters.has_base(robot) else ()
    turns = tuple(elementary_rotation(axis, angle) for axis, angle in body.axes.turns)
    turns = turns or ((context.show(body.axes.rotation),) if base else ())
    factors = (*base, *turns)
    return None if not factors else Product(factors) if len(factors) > 1 else factors[0]


def why_axes(context: Context, body: Body) -> Prose:
    """That the problem gives the axes, and how they lie in the frame of the link."""
    given = f"The problem gives the axes of {name_of(body)} from the base. "
    frame = f"frame {body.link}"
    H = context.values[f"H{body.link}"]
    if not inertia.turns_with_link(context.robot, body, H):
        return (given, f"They do not turn with link {body.link}.")
    relative = rotation(H).T @ inertia.body_rotation(context.robot, body, H)
    if relative == Matrix.identity(relative.ring, 3):
        return (given, f"They are those of {frame}.")
    not_equal: Prose = (letters.of_body("R", body, "bold"), " is not ", letters.R(context.robot, body.link))
    told = list(_parallel(relative, body.link))
    if len(told) < 3:
        return (given, f"They are turned in {frame}, and fixed in the same link: ", *not_equal, ".")
    return (given, f"They are not those of {frame}: ", *listed(told), ", so ", *not_equal, ".")


def _parallel(relative: Matrix, link: int) -> Iterator[Prose]:
    """Of each axis of the frame, the axis of the body that it lies along; none where one is oblique."""
    one = relative.ring.one
    for i, axis in enumerate("xyz"):
        along = [(j, entry) for j, entry in enumerate(relative.rows[i]) if not entry.is_zero]
        if len(along) != 1:
            return
        ((j, entry),) = along
        lies, whose = ("lies along", "the body's") if i == 0 else ("along", "its")
        name = Letter(axis, letters.index_of(str(link)), style="bold")
        yield (name, f" {lies} {whose} {'' if entry == one else '-'}{'xyz'[j]}")
