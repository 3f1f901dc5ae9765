"""Steps of what is asked of the task and of named points, and of how Jacobians change."""

from __future__ import annotations

from collections.abc import Iterator

from msgspec.structs import replace

from dynsolve.algebra import matrix as algebra
from dynsolve.algebra.matrix import determinant
from dynsolve.derivation.graph import Skipped
from dynsolve.derivation.kinematics import rotation
from dynsolve.document import Prose
from dynsolve.document.books import spong
from dynsolve.document.sentences import Value, opened, say
from dynsolve.explain.context import Context
from dynsolve.explain.jacobian import ZERO, coordinate_column
from dynsolve.explain.step import NOTED, Detail, Group, Line, Step
from dynsolve.explain.working.identities import SILENT, Identity, Way, by, identities, said, used_in_product
from dynsolve.explain.writing import agreeing, and_joined, is_small, listed, sum_over_coordinates
from dynsolve.notation.build import times, total
from dynsolve.notation.template import formula
from dynsolve.notation.tree import (
    Derivative,
    Letter,
    Matrix,
    Node,
    Reference,
    Symbol,
    Words,
    column,
    equation,
    mapped,
)
from dynsolve.notation.unicode import to_unicode
from dynsolve.quantities import letters
from dynsolve.questions.rates.derive import squared, whole_or_task
from dynsolve.questions.set_forms import SetForms
from dynsolve.robot.model import Robot
from dynsolve.robot.questions import TIP, NamedPoint, Task, points_of

TASK = Group("r", "The task and its Jacobian")


def steps(context: Context) -> Iterator[Step]:
    """What is asked, and what that is derived from: the points, how the arm's Jacobian changes, the task."""
    wanted = context.wanted
    for point in context.robot.questions.points:
        group = Group(f"point{point.name}", f"The point {point.name}")
        yield from (replace(step, group=group) for step in _of_point(context, point))
    for name in ("Jv", "Jw"):
        if f"{name}_dot" in wanted:
            yield _rate(context, name)
    if "J_dot" in wanted:
        yield _whole_rate(context)
    task = context.robot.questions.task
    if task is None:
        return
    if "r" in wanted:
        yield replace(_map(context, task), group=TASK)
    if "Jr" in wanted:
        yield replace(_jacobian(context, task), group=TASK)
    if "Jr_dot" in wanted:
        yield _rate(context, "Jr")
    if "det" in wanted:
        yield _determinant(context)


# -- the task --------------------------------------------------------------------------------------


def _map(context: Context, task: Task) -> Step:
    points = ["the tip" if point == TIP else point for point in points_of(task)]
    why = say(
        "The components of the task as functions of the joint variables.{points}",
        points=say(" The coordinates of {points} are put in.", points=listed(points)) if points else "",
    )
    if task.is_default:
        o = letters.o(len(context.robot.joints))
        tip = say("the tip, {o}", o=o) if context.robot.is_tree else "the tip"
        moving = "" if context.values["Jr"].is_zero else ", of which these are the coordinates that move"
        why = say("The task is the position of {tip}{moving}.", tip=tip, moving=moving)
    return Step(
        id="r",
        title="The task",
        why=why,
        formula=equation(letters.TASK, column(*(mapped(entry, with_letters) for entry in task.entries))),
        source=spong("4.8"),
        result=(equation(letters.TASK, context.form("r")),),
        detail=Detail.BRIEF,
    )


def with_letters(part: Node) -> Node:
    """A coordinate of a point as it is printed: x_tip, y_P."""
    if not isinstance(part, Reference) or part.row is None:
        return part
    index = Words(TIP) if part.quantity == TIP else Symbol(part.quantity)
    return Letter("xyz"[part.row - 1], index)


def _jacobian(context: Context, task: Task) -> Step:
    """∂r/∂q; of the twist of the last frame it is J."""
    why = say("One column for each coordinate: the derivatives of all components by it. Then $𝐫̇ = 𝐉_r 𝐪̇$.")
    columns = tuple(Derivative(letters.TASK, Symbol(q.name)) for q in context.robot.coordinates)
    general = formula("𝐉_r = ∂𝐫/∂𝐪 = {columns}", columns=Matrix((columns,)))
    if task.is_twist:
        why = say(
            "The task is the twist of the last frame, its velocity and its angular velocity: $𝐉_r = 𝐉$."
        )
        general = formula("𝐉_r = 𝐉")
    moving = {entry.row for entry in task.entries if isinstance(entry, Reference)}
    still = [axis for row, axis in enumerate("xyz", 1) if row not in moving]
    left_out = agreeing(
        "This is ${Jv}$ without the row|rows of {axes}, zero in every configuration.", len(still)
    )
    is_part = task.is_default and not task.is_twist and bool(still)
    notes = (say(left_out, Jv=letters.JV, axes=listed(still)),) if is_part else ()
    if not (still or task.is_twist) and context.values["Jr"] == context.values["Jv"]:
        notes = (say("This is ${Jv}$.", Jv=letters.JV),)
    return Step(
        id="Jr",
        title="The Jacobian of the task",
        why=why,
        formula=general,
        source=spong("4.6.3" if task.is_twist else "4.8"),
        result=(equation(letters.J_TASK, context.form("Jr")),),
        notes=notes,
        normal=NOTED,
        detail=Detail.BRIEF,
    )


def _determinant(context: Context) -> Step:
    """det J_r, or that of J_r J_rᵀ or J_rᵀ J_r where J_r is not square."""
    name = whole_or_task(context.robot)
    J = letters.J if name == "J" else letters.J_TASK
    rows, columns = context.values[name].shape
    why = say("Where it is 0 the Jacobian has no inverse: some motion of the task is lost there.")
    if rows != columns:
        why = say(
            "${J}$ is {rows}×{columns} and has no determinant. The determinant of its product with its "
            "transpose is the sum of the squares of its minors: it is 0 where the {lines} are dependent.",
            J=J,
            rows=rows,
            columns=columns,
            lines="rows" if rows < columns else "columns",
        )
    shown = context.show(squared(context.values[name]))
    letter = letters.determinant(J, rows, columns)
    value = context.values["det"]
    general, still = why, zero_lines(context.values[name])
    if not isinstance(value, Skipped) and value.is_zero:
        reason = f"{opened(still)}, so the" if still else "The"
        why = (f"{reason} determinant is 0 in every configuration: the Jacobian has no inverse.",)
        if rows != columns:
            why = (*general, f" Here they are dependent in every configuration{f': {still}' * bool(still)}.")
    by_minors = not isinstance(value, Skipped) and context.form("det") != context.forms.products.form(value)
    way = (
        determinant_way(context, letter, context.values[name], context.form("det"))
        if rows == columns and not still
        else SILENT
    )
    return Step(
        id="det",
        title="The determinant of the Jacobian",
        why=why,
        formula=equation(letter, formula("det {matrix}", matrix=shown))
        if is_small(shown) and not by_minors
        else None,
        source=spong("4.9" if rows == columns else "4.12"),
        lines=way.lines,
        concluding=way.concluding,
        result=(equation(letter, context.form("det")),),
        detail=Detail.BRIEF,
        hint=general,
        task=letter,
    )


def zero_lines(matrix: algebra.Matrix) -> str:
    """`column 3 is 0`: the columns, else the rows, that are 0 in every configuration; none of them: empty."""
    for what, lines in (("column", matrix.T.rows), ("row", matrix.rows)):
        zero = [str(k) for k, line in enumerate(lines, 1) if all(entry.is_zero for entry in line)]
        if zero:
            return agreeing(f"{what}|{what}s {and_joined(zero)} is|are 0", len(zero))
    return ""


def determinant_way(context: Context, letter: Node, matrix: algebra.Matrix, form: Node) -> Way:
    """A determinant along the row or the column that has most zeros; none of large matrices."""
    size, ring = len(matrix.rows), matrix.ring
    if size == 1 or not is_small(context.show(matrix)):
        return SILENT
    both = (matrix.rows, matrix.T.rows)
    ways = [(lines, place) for lines in both for place in range(size)]
    lines, place = max(ways, key=lambda way: sum(entry.is_zero for entry in way[0][way[1]]))
    others = [line for k, line in enumerate(lines) if k != place]
    terms = []
    used = dict[Identity, None]()
    forms = SetForms(context.robot, context.values)
    for k, entry in enumerate(lines[place]):
        left = algebra.Matrix.of(ring, ([*line[:k], *line[k + 1 :]] for line in others))
        minor = determinant(left)
        if not (entry.is_zero or minor.is_zero):
            shown = forms.product(minor)
            if size == 3:
                (a, b), (c, d) = ([context.show(each) for each in row] for row in left.rows)
                products = formula("{a} {d} - {b} {c}", a=a, b=b, c=c, d=d)
                used |= dict.fromkeys(identities(ring, products, shown) or ())
            terms.append(times((-1) ** (place + k), [(context.show(entry), 1), (shown, 1)]))
    which = f"{'row' if lines == matrix.rows else 'column'} {place + 1}"
    along = f"Along {which}, each entry times the determinant that is left, signs in turn"
    expanded = equation(letter, total(terms))
    is_new = to_unicode(expanded) != to_unicode(equation(letter, context.show(determinant(matrix))))
    if not ((is_new or size > 2) and is_small(expanded)):
        return SILENT
    then = identities(ring, total(terms), form)
    line = Line(by(along, used) if size > 2 else (), (expanded,))
    return Way((line,), say("By {used}:", used=said(then)) if then else ())


# -- how a Jacobian changes ------------------------------------------------------------------------

_CHANGING = {
    "Jv": (letters.JV, "the linear part of the Jacobian", formula("𝐯̇")),
    "Jw": (letters.JW, "its angular part", formula("𝛚̇")),
    "Jr": (letters.J_TASK, "the Jacobian of the task", formula("𝐫̈")),
}
"""The letter of a Jacobian, what it is called, and the acceleration that it gives."""


def _rate(context: Context, name: str) -> Step:
    letter, called, acceleration = _CHANGING[name]
    changed = letters.rate(letter)
    total = sum_over_coordinates(formula("∂{J}/∂q_k q̇_k", J=letter), Symbol("k"), context.robot)
    return Step(
        id=f"{name}_dot",
        title=f"How {called} changes",
        why=say(
            "Entry by entry, by the chain rule: every joint variable in an entry moves. It stands in the "
            "acceleration, ${a} = {J} 𝐪̈ + {J_dot} 𝐪̇$.",
            a=acceleration,
            J=letter,
            J_dot=changed,
        ),
        formula=equation(changed, total),
        source=spong("4.11"),
        result=(equation(changed, context.form(f"{name}_dot")),),
        detail=Detail.BRIEF,
    )


def _whole_rate(context: Context) -> Step:
    return Step(
        id="J_dot",
        title="How the Jacobian changes",
        why=("The two parts, one above the other.",),
        formula=formula("𝐉̇ = {parts}", parts=column(letters.rate(letters.JV), letters.rate(letters.JW))),
        source=spong("4.11"),
        result=(formula("𝐉̇ = {J}", J=context.form("J_dot")),),
        detail=Detail.BRIEF,
    )


# -- points that an exercise names: where they are, how they move, and along whose axes ------------


def _of_point(context: Context, point: NamedPoint) -> Iterator[Step]:
    """Its position, its Jacobians and its velocity, as far as they are wanted."""
    P, wanted = point.name, context.wanted
    if f"p{P}" in wanted:
        yield _position(context, point)
    if f"Jv{P}" in wanted or f"Jw{P}" in wanted:
        yield _jacobians(context, point)
    if f"v{P}" in wanted:
        jacobian = context.form(f"Jv{P}")
        v, J = letters.of_point("v", P, point.axes), letters.j_of_point("v", P, point.axes)
        rates = column(*(letters.velocity(q) for q in context.robot.coordinates))
        working = formula("{v} = {J} {rates}", v=v, J=jacobian, rates=rates)
        yield Step(
            id=f"v{P}",
            title=f"The velocity of {P}",
            why=("Each joint adds its column times its rate.",),
            formula=formula("{v} = {J} 𝐪̇", v=v, J=J),
            source=spong("4.6"),
            working=(working,) if is_small(jacobian) else (),
            result=(equation(v, context.form(f"v{P}")),),
            detail=Detail.BRIEF,
        )


def _position(context: Context, point: NamedPoint) -> Step:
    P, link = point.name, point.link
    p, o = letters.of_point("p", P), letters.o(link)
    general: Node = equation(p, o)
    why = f"{P} is the origin of frame {link}."
    working: tuple[Node, ...] = ()
    if not point.position.is_zero:
        in_frame = letters.of_point("p", P, link)
        general = formula(
            "{p} = {R} {p_local} + {o}", p=p, R=letters.R(context.robot, link), p_local=in_frame, o=o
        )
        why = f"{P} is fixed in link {link}: its coordinates in frame {link} are constant, and it "
        why += "moves with the frame."
        working = (equation(in_frame, context.show(point.position)),)
    return Step(
        id=f"p{P}",
        title=f"The point {P}",
        why=(why,),
        formula=general,
        source=spong("2.6"),
        working=working,
        result=(equation(p, context.form(f"p{P}")),),
        uses=(f"H{link}",),
        detail=Detail.BRIEF,
    )


def _jacobians(context: Context, point: NamedPoint) -> Step:
    """J_v and J_ω of a point, in the world and turned into the frame along whose axes they are asked."""
    P, robot, axes = point.name, context.robot, point.axes
    p = letters.of_point("p", P)
    columns = [coordinate_column(context, k, point.link, p) or (ZERO, ZERO) for k in range(robot.n)]
    late = [Symbol(q.name) for q, both in zip(robot.coordinates, columns, strict=True) if both[0] == ZERO]
    names, formulas, results = list[str](), list[Node](), list[Node]()
    turned: list[Node] = []
    for part, of_part in zip(("v", "omega"), zip(*columns, strict=True), strict=True):
        name = f"J{'v' if part == 'v' else 'w'}{P}"
        if name not in context.wanted:
            continue
        J, result = letters.j_of_point(part, P), letters.j_of_point(part, P, axes)
        names.append(name)
        formulas.append(equation(J, Matrix((of_part,))))
        results.append(equation(result, context.form(name)))
        if axes is not None:
            R, of_world = rotation(context.values[f"H{axes}"]), context.values[name]
            world = context.show(R @ of_world)
            products = [formula("{R}ᵀ {J}", R=letters.R(robot, axes), J=J)]
            if is_small(world):
                products.append(formula("{RT} {J}", RT=context.show(R.T), J=world))
            turned += [equation(J, world), equation(result, *products)]
    why = say(
        "The column of each {moving}, taken at {P}{late}{turned}",
        moving="joint" if robot.moves_each_joint_alone else "coordinate",
        P=P,
        late=say(agreeing("; {q} does|do not move its link.", len(late)), q=listed(late)) if late else ".",
        turned=f" What is seen from the world is then written along the axes of frame {axes}."
        if turned
        else "",
    )
    return Step(
        id=names[0],
        title=f"The Jacobian of {P}",
        why=why,
        formula=formulas[0],
        source=spong("4.6"),
        working=(*formulas[1:], *turned),
        concluding=_identities(context, names, axes),
        result=tuple(results),
        also=tuple(names[1:]),
        uses=("axes", *((f"p{P}",) if f"p{P}" in context.wanted else ())),
        detail=Detail.BRIEF,
    )


def _identities(context: Context, names: list[str], axes: int | None) -> Prose:
    """The identities by which what is turned gets shorter."""
    if axes is None or not context.is_short:
        return ()
    R = rotation(context.values[f"H{axes}"])
    jacobians = [context.values[name] for name in names]
    used = dict.fromkeys(one for J in jacobians for one in used_in_product(context, R.T, R @ J, J))
    return say("With {identities}:", identities=said(list(used))) if used else ()


# -- hints -----------------------------------------------------------------------------------------

AT_HAND = "You have the frames of the forward kinematics:"

PITFALLS = """
    Joints after its link do not move a point: their columns are zero, for {inner_points}.
    $𝐉_r$ has a row a component and a column a coordinate: {task_size} here.
    rates? In the time derivative every joint variable of an entry moves: one term for each, with its
        rate.
"""


def inputs(context: Context) -> list[tuple[Node, str]]:
    """The results that it starts from, by letter and name."""
    return [(letters.H(context.robot, joint.index), f"H{joint.index}") for joint in context.robot.joints]


def facts(robot: Robot) -> dict[str, Value]:
    """What its pitfalls are about."""
    questions = robot.questions
    task = questions.task
    last = max((joint.index for joint in robot.joints if joint.type), default=0)
    return {
        "inner_points": and_joined([point.name for point in questions.points if point.link < last]),
        "task_size": f"{task.rows}×{robot.n}" if task is not None and task.rows != robot.n else "",
        "rates": any(name.endswith("_dot") for name in questions.asked),
    }
