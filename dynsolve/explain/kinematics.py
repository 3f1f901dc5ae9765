"""Steps of the forward kinematics: the table, A_i row by row, H_i as products, the base in the world."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from operator import itemgetter

from msgspec.structs import replace

from dynsolve.algebra.matrix import Matrix
from dynsolve.derivation import link_frame
from dynsolve.derivation.kinematics import rotation
from dynsolve.document import Prose, Reference, Table
from dynsolve.document.books import spong
from dynsolve.document.sentences import say
from dynsolve.explain.context import Context
from dynsolve.explain.last_frame import by_halves
from dynsolve.explain.step import STATED, WORKED, Detail, Group, Part, Step
from dynsolve.explain.working.identities import product_named
from dynsolve.explain.writing import is_small, listed, name_of, side_by_side, turns
from dynsolve.notation.template import formula
from dynsolve.notation.tree import (
    Degrees,
    Function,
    Letter,
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
from dynsolve.robot.model import Body, Convention, Joint, JointType, Robot

ROWS = Group("A", "The matrices of the rows")

_I = letters.COUNT


def steps(context: Context) -> Iterator[Step]:
    """The table, the base frame where it is turned, the general matrix, A_i and H_i."""
    yield _table(context)
    if letters.has_base(context.robot):
        yield base_step(context)
    yield _general(context)
    for joint in context.robot.joints:
        yield _row(context, joint)
    joints = context.robot.joints
    outwards = (*OUTWARDS, " ") if _are_multiplied(context.robot, joints) else ()
    own = [] if letters.has_base(context.robot) else [one.index for one in joints[:-1] if not one.parent]
    rows = listed([equation(letters.H(context.robot, i), letters.A(i)) for i in own])
    first = say(" {rows}.", rows=rows) if own else ()
    why = (*outwards, "The fourth column is the origin of the frame, the first three are its axes.", *first)
    group = Group("H", f"The frames seen from the {context.ground}", why)
    for joint in joints:
        yield replace(_frame(context, joint.index), group=group)


# -- the table -------------------------------------------------------------------------------------


def table_of(context: Context) -> Table:
    """The rows of the table as they are written, their columns in the order of the convention's motions."""
    robot, order = context.robot, _COLUMNS[context.robot.convention]
    rows: list[Prose] = [
        (str(joint.index), *([str(joint.parent)] if robot.is_tree else []), *order(joint.written))
        for joint in robot.joints
    ]
    header = _I, *(["from"] if robot.is_tree else []), *order(letters.columns(robot, _I))
    return Table(header, tuple(rows))


_COLUMNS = {Convention.STANDARD: itemgetter(0, 1, 2, 3), Convention.MODIFIED: itemgetter(3, 2, 1, 0)}
"""Spong has θ, d, a, α; Craig α, a, d, θ (figure 3.6)."""


def _table(context: Context) -> Step:
    robot = context.robot
    stars: Prose = ()
    if any(joint.type for joint in robot.joints):
        stars = say(
            "The star only marks a joint variable, and may be left out. Here {kinds}.", kinds=_kinds(robot)
        )
    lengths = (length for joint in robot.joints for length in (joint.d, joint.a))
    has_units = any(length.is_number and not length.is_zero for length in lengths)
    return Step(
        id="dh",
        title="Denavit-Hartenberg table",
        why=say(
            "{motions} {stars}{numbers}",
            motions=_four_motions(context),
            stars=stars,
            numbers=" Lengths are in m." if has_units else "",
        ),
        source=context.by_convention("3.2", "3.4"),
        result=(equation(letters.Q, column(*(Symbol(q.name) for q in robot.coordinates))),),
        notes=tuple(_table_notes(robot)),
        table=table_of(context),
        detail=Detail.FULL if context.normals else Detail.BRIEF,
        normal=Part.WHY | Part.NOTES,
        is_task=False,
    )


def _four_motions(context: Context) -> Prose:
    """How a row leads from a frame to the next, in the order of its convention."""
    theta, d, a, alpha = letters.columns(context.robot, _I)
    is_tree = context.robot.is_tree
    x, z = (letters.bold(name, None if is_tree else letters.BEFORE) for name in "xz")
    return say(
        "In the standard convention (Spong) row i leads from {start} to frame i by a rotation by {theta} "
        "about {z}{of}, a translation by {d} along it, a translation by {a} along $𝐱_i$ and a rotation by "
        "{alpha} about that."
        if context.standard
        else "In the modified convention (Craig) row i leads from {start} to frame i by a rotation by "
        "{alpha} about {x}{of}, a translation by {a} along it, a rotation by {theta} about $𝐳_i$ and a "
        "translation by {d} along that. Craig numbers {a} and {alpha} of row i by $i - 1$.",
        start="the frame in the column “from”" if is_tree else "frame i-1",
        of=" of the former" if is_tree else "",
        theta=theta,
        d=d,
        a=a,
        alpha=alpha,
        x=x,
        z=z,
    )


def _kinds(robot: Robot) -> Prose:
    told: list[Prose] = []
    for turning, one, many in (
        (True, "is an angle (revolute joint)", "are angles (revolute joints)"),
        (False, "is a length (prismatic joint)", "are lengths (prismatic joints)"),
    ):
        own = (q for q in robot.coordinates if not robot.is_of_motor(q))
        names = [Symbol(q.name) for q in own if turns(q) is turning]
        if names:
            told.append(say("{names} {are}", names=listed(names), are=one if len(names) == 1 else many))
    return say("{one}; {other}", one=told[0], other=told[1]) if len(told) == 2 else told[0]


def _table_notes(robot: Robot) -> Iterator[Prose]:
    fixed = [str(joint.index) for joint in robot.joints if joint.type is None]
    if len(fixed) == 1:
        yield (
            f"Row {fixed[0]} has no star: a fixed frame, which keeps its place in the one it starts from.",
        )
    elif fixed:
        yield (
            "Rows ",
            *listed(fixed),
            " have no star: frames that are each fixed in the one they start from.",
        )
    shared = [str(joint.index) for joint in robot.joints if len(joint.rates) > 1]
    if len(shared) == 1:
        yield say(
            "The joint variable of row {row} is not a coordinate itself but a combination of coordinates: "
            "its column of the Jacobian is shared out among them.",
            row=shared[0],
        )
    elif shared:
        yield say(
            "The joint variables of rows {rows} are not coordinates themselves but combinations of "
            "coordinates: their columns of the Jacobian are shared out among these.",
            rows=listed(shared),
        )
    for joint in robot.joints:
        if len(joint.rates) == 1 and joint.rates[0][1] != 1:
            ((k, rate),) = joint.rates
            words = "The joint of row {row} moves {way} {q}."
            way: Prose = (
                ("at ", number(abs(rate)), " times the rate of") if abs(rate) != 1 else ("as fast as",)
            )
            way = ("the other way ", *way) if rate < 0 else way
            yield say(words, row=joint.index, way=way, q=Symbol(robot.coordinates[k].name))


# -- the matrices of the rows ----------------------------------------------------------------------

_MATRIX = {
    Convention.STANDARD: "[cos {theta}, -sin {theta} cos {alpha}, sin {theta} sin {alpha}, {a} cos {theta};"
    "sin {theta}, cos {theta} cos {alpha}, -cos {theta} sin {alpha}, {a} sin {theta};"
    "0, sin {alpha}, cos {alpha}, {d}; 0, 0, 0, 1]",
    Convention.MODIFIED: "[cos {theta}, -sin {theta}, 0, {a};"
    "sin {theta} cos {alpha}, cos {theta} cos {alpha}, -sin {alpha}, -{d} sin {alpha};"
    "sin {theta} sin {alpha}, cos {theta} sin {alpha}, cos {alpha}, {d} cos {alpha}; 0, 0, 0, 1]",
}
"""The product of the four motions of a row."""

_MOTION = {
    ("x", True): "[1, 0, 0, 0; 0, cos {x}, -sin {x}, 0; 0, sin {x}, cos {x}, 0; 0, 0, 0, 1]",
    ("z", True): "[cos {x}, -sin {x}, 0, 0; sin {x}, cos {x}, 0, 0; 0, 0, 1, 0; 0, 0, 0, 1]",
    ("x", False): "[1, 0, 0, {x}; 0, 1, 0, 0; 0, 0, 1, 0; 0, 0, 0, 1]",
    ("z", False): "[1, 0, 0, 0; 0, 1, 0, 0; 0, 0, 1, {x}; 0, 0, 0, 1]",
}
"""The rotation about an axis, or the translation along it."""


def _general(context: Context) -> Step:
    theta, d, a, alpha = letters.columns(context.robot, _I)
    z, x = (("z", theta, True), ("z", d, False)), (("x", a, False), ("x", alpha, True))
    motions = (*z, *x) if context.standard else (*reversed(x), *z)
    product = Product(tuple(motion(*each) for each in motions))
    in_full = Product(tuple(formula(_MOTION[axis, turns], x=amount) for axis, amount, turns in motions))
    matrix = formula(_MATRIX[context.robot.convention], theta=theta, d=d, a=a, alpha=alpha)
    name = formula("𝐀_i")
    return Step(
        id="A",
        title="The matrix of a row",
        why=("The product of the four motions, into which the entries of each row are put.",),
        formula=equation(name, product),
        source=context.by_convention("3.2", "3.5"),
        working=(equation(name, in_full),) if context.is_short else (),
        normal=STATED | Part.WHY,
        task=equation(name, product, matrix),
        result=(equation(name, matrix),),
    )


def _row(context: Context, joint: Joint) -> Step:
    i = joint.index
    columns = letters.columns(context.robot, Number(i))
    given = side_by_side([equation(*pair) for pair in zip(columns, joint.written, strict=True)])
    what, kind = {
        JointType.REVOLUTE: (say("Only {theta} varies", theta=columns[0]), "a revolute joint"),
        JointType.PRISMATIC: (say("Only {d} varies", d=columns[1]), "a prismatic joint"),
        None: (("Nothing varies",), "a fixed frame"),
    }[joint.type]
    return Step(
        id=f"A{i}",
        title=f"Row {i} of the table: A{lowered(str(i))}",
        why=(*what, Reference(("A",), " in "), f": {kind}."),
        source=context.by_convention("3.2", "3.4"),
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
        cosine, sine = context.show(ring.cos(angle)), context.show(ring.sin(angle))
        stays = isinstance(cosine, Function) and cosine.name == "cos"  # cos(θ₁ + 30°) is itself
        if (isinstance(node, Number | Degrees) or angle.degrees) and not stays:
            shown.append(formula("cos {x} = {c}", x=node, c=cosine))
            shown.append(formula("sin {x} = {s}", x=node, s=sine))
    if shown:
        yield side_by_side(shown)


# -- the frames seen from the base -----------------------------------------------------------------

OUTWARDS = say("Each $𝐀$ leads one frame further along the arm, so it multiplies from the right.")
"""Why the matrices of the rows stand in this order."""


def _are_multiplied(robot: Robot, joints: Sequence[Joint]) -> bool:
    """Whether some of these frames is seen by a product, not by the matrix of its row alone."""
    return letters.has_base(robot) or any(joint.parent for joint in joints)


def _frame(context: Context, i: int) -> Step:
    robot, has_base = context.robot, letters.has_base(context.robot)
    last, is_end, start = i == len(robot.joints), not robot.links_after(i), robot.joints[i - 1].parent
    name, H = letters.H(robot, i), context.form(f"H{i}")
    step = Step(
        id=f"H{i}",
        title=f"Frame {i} seen from the {context.ground}",
        source=context.by_convention("3.1", "3.5"),
        result=(equation(name, H),),
        detail=Detail.BRIEF if is_end else Detail.NORMAL,
    )
    if start == 0 and not has_base:
        return replace(
            step,
            why=(
                f"{'The first frame' if i == 1 else f'Frame {i}'} is seen from frame 0 itself, so no product "
                "is needed.",
            ),
            result=(equation(name, letters.A(i), H),),
            detail=Detail.BRIEF if is_end else Detail.FULL,
        )
    chain: list[Node] = [letters.A(joint.index) for joint in robot.path(i)]
    if has_base:
        chain.insert(0, letters.H(robot, 0))
    is_row = len(robot.path(start)) == 1 and not has_base  # of which H is A itself
    product = Product((letters.A(start) if is_row else letters.H(robot, start), letters.A(i)))
    task = equation(name, product) if i > 1 else None
    uses = (f"A{start}", f"A{i}") if is_row else None
    if last and context.is_in_letters:
        by = by_halves(context)
        why = _last_why(context)
        return replace(
            step,
            why=why if why[: len(OUTWARDS)] == OUTWARDS else (*OUTWARDS, " ", *why),
            formula=equation(name, Product(tuple(chain)), by.formula),
            lines=by.lines,
            concluding=by.concluding,
            notes=by.notes,
            uses=uses,
            task=task,
            normal=WORKED,
        )
    A, before = context.form(f"A{i}"), context.form(f"H{start}")
    values = (Product((before, A)),) if is_small(A, before) else ()
    return replace(
        step,
        why=_last_why(context) if last else OUTWARDS,
        formula=equation(name, Product(tuple(chain))) if is_end or len(chain) > 2 else None,
        working=(equation(name, product, *values),),
        concluding=product_named(context, *(context.values[key] for key in (f"H{start}", f"A{i}", f"H{i}"))),
        uses=uses,
        task=task,
        normal=WORKED,
    )


_ENDS_IN_A_JOINT = (
    " In the modified convention it lies in the last joint: the end of the arm would need a row of its own, "
    "without a star."
)


def _last_why(context: Context) -> Prose:
    """What the last frame tells, and of which point; if no frame before it is a product, why this order."""
    robot = context.robot
    is_told = _are_multiplied(robot, robot.joints[:-1])
    return say(
        "{outwards}The fourth column is where {end} is, the first three how {what} is turned.{ends}",
        outwards=() if is_told else (*OUTWARDS, " "),
        end=context.end,
        what="that frame" if robot.is_tree or robot.ends_in_a_joint else "it",
        ends=_ENDS_IN_A_JOINT if robot.ends_in_a_joint else "",
    )


# -- the step of the base frame, H_0 in the world, and the elementary motions that matrices are products of


def motion(axis: str, amount: Node, turns: bool) -> Node:
    """Rot_{z,θ} or Trans_{z,d}: how far is a value, and set as values are, not as what names an index."""
    return Letter("Rot" if turns else "Trans", _along(axis, amount), style="upright")


def turned(turns: Sequence[tuple[str, Node]]) -> Node:
    """R_{z,θ} R_{x,α}: elementary rotations, 3×3 parts of Rot_{z,θ}, one after the other."""
    return _product([letters.bold("R", _along(axis, angle)) for axis, angle in turns])


def _product(factors: Sequence[Node]) -> Node:
    return Product(tuple(factors)) if len(factors) > 1 else factors[0]


def _along(axis: str, amount: Node) -> Row:
    return Row((Words(axis), Words(","), Row((amount,))))


def base_step(context: Context) -> Step:
    """H_0, the product of how frame 0 is moved and turned, as the problem writes it."""
    robot, H = context.robot, letters.H(context.robot, 0)
    along = zip("xyz", robot.base_position.entries, strict=True)
    moved = [motion(axis, context.show(entry), False) for axis, entry in along if not entry.is_zero]
    is_turned = robot.base_rotation != Matrix.identity(robot.ring, 3)
    factors = [*moved, *(motion(axis, angle, True) for axis, angle in robot.base_turns)]
    is_whole = bool(robot.base_turns) or not is_turned
    is_heavy = robot.has_dynamics and not robot.gravity.is_zero
    way = ""
    if not is_whole:
        way = "" if context.normals else " Its axes are the columns of the rotation that the problem gives."
    elif len(factors) > 1:
        way = " Each motion is along or about an axis of the frame that those before it have led to."
    return Step(
        id="H0",
        title="The base frame in the world",
        why=say(
            "Frame 0 is {how} in the world w{gravity}.{way} What follows, where nothing else is said, is in "
            "world coordinates.",
            gravity=", in which gravity is given" if is_heavy else "",
            how=" and ".join([*["turned"] * is_turned, *["moved"] * bool(moved)]),
            way=way,
        ),
        formula=equation(H, _product(factors)) if is_whole else None,
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
    """The rotation as the problem writes it, behind that of the base where there is one; None of a matrix.

    Of a drawing it is given from the world.
    """
    from_frame = letters.has_base(context.robot) and context.normals is None
    base = [letters.R(context.robot, 0)] if from_frame else []
    own = [turned([turn]) for turn in body.axes.turns]
    if base and not own:
        own = [context.show(body.axes.rotation)]
    return _product([*base, *own]) if own else None


def why_axes(context: Context, body: Body) -> Prose:
    """That the problem gives the axes, and how they lie in the frame of the link."""
    origin = "base" if context.normals is None else "world"
    given = f"The problem gives the axes of {name_of(body)} from the {origin}. "
    H, frame = context.values[f"H{body.link}"], f"frame {body.link}"
    if not link_frame.turns_with_link(context.robot, body, H):
        return (given, f"They do not turn with link {body.link}.")
    relative = rotation(H).T @ link_frame.body_rotation(context.robot, body, H)
    if relative == Matrix.identity(relative.ring, 3):
        return (given, f"They are those of {frame}.")
    told = list(_parallel(relative, body.link))
    words = "They are turned in {frame}, and fixed in the same link: {R} is not {of_link}."
    if len(told) == 3:
        words = "They are not those of {frame}: {told}, so {R} is not {of_link}."
    R, of_link = letters.of_body("R", body, "bold"), letters.R(context.robot, body.link)
    return (given, *say(words, frame=frame, told=listed(told), R=R, of_link=of_link))


def _parallel(relative: Matrix, link: int) -> Iterator[Prose]:
    """Of each axis of the frame, the axis of the body that it lies along; none where one is oblique."""
    for i, axis in enumerate("xyz"):
        along = [(j, entry) for j, entry in enumerate(relative.rows[i]) if not entry.is_zero]
        if len(along) != 1:
            return
        ((j, entry),) = along
        lies, whose = ("lies along", "the body's") if i == 0 else ("along", "its")
        minus = "" if entry == relative.ring.one else "-"
        yield (letters.bold(axis, Number(link)), f" {lies} {whose} {minus}{'xyz'[j]}")
