"""Steps of what is asked of the task, and of how Jacobians change."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace

from dynsolve.derivation.kinematics import rotation
from dynsolve.document import Prose
from dynsolve.explain.context import Context
from dynsolve.explain.jacobian_columns import ZERO, coordinate_column
from dynsolve.explain.rates import determinant_step
from dynsolve.explain.step import Detail, Group, Step
from dynsolve.explain.working.identities import said, used_in_product
from dynsolve.explain.writing import is_small, listed, spong, sum_over_coordinates
from dynsolve.notation.tree import (
    Derivative,
    Letter,
    Matrix,
    Node,
    Number,
    Product,
    Reference,
    Sum,
    Symbol,
    Transpose,
    Words,
    column,
    equation,
)
from dynsolve.notation.walk import mapped
from dynsolve.quantities import letters
from dynsolve.quantities.stages import Stage
from dynsolve.robot.questions import TIP, NamedPoint, Task, points_of

STAGE = Stage.TASK

TASK = Group("r", "The task and its Jacobian")

_POINTS, _TASK, _RATES = spong("4.6"), spong("4.8"), spong("4.11")


def steps(context: Context) -> Iterator[Step]:
    """What is asked, and what that is derived from: the points, how the arm's Jacobian changes, the task."""
    wanted = context.wanted
    for point in context.robot.questions.points:
        yield from point_steps(context, point, wanted)
    for name, letter in (("Jv", letters.JV), ("Jw", letters.JW)):
        if f"{name}_dot" in wanted:
            yield _rate(context, name, letter)
    if "J_dot" in wanted:
        yield _whole_rate(context)
    task = context.robot.questions.task
    if task is not None:
        yield from _task(context, task, wanted)


# -- the task --------------------------------------------------------------------------------------


def _task(context: Context, task: Task, wanted: frozenset[str]) -> Iterator[Step]:
    if "r" in wanted:
        yield replace(_map(context, task), group=TASK)
    if "Jr" in wanted:
        yield replace(_twist(context) if task.is_twist else _jacobian(context, task), group=TASK)
    if "Jr_dot" in wanted:
        yield _rate(context, "Jr", letters.J_TASK)
    if "det" in wanted:
        yield determinant_step(context)


def _map(context: Context, task: Task) -> Step:
    entries = column(*(mapped(entry, with_letters) for entry in task.entries))
    points = ["the tip" if point == TIP else point for point in points_of(task)]
    where: Prose = (" The coordinates of ", *listed(points), " are put in.") if points else ()
    why: Prose = ("The components of the task as functions of the joint variables.", *where)
    if task.is_default:
        why = ("The task is the position of the tip, of which these are the coordinates that move.",)
    return Step(
        id="r",
        stage=STAGE,
        title="The task",
        why=why,
        formula=equation(letters.TASK, entries),
        source=_TASK,
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
    columns = tuple(Derivative(letters.TASK, Symbol(q.name)) for q in context.robot.coordinates)
    return Step(
        id="Jr",
        stage=STAGE,
        title="The Jacobian of the task",
        why=(
            "One column for each coordinate: the derivatives of all components by it. Then ",
            equation(letters.rate(letters.TASK), Product((letters.J_TASK, letters.QD))),
            ".",
        ),
        formula=equation(letters.J_TASK, Derivative(letters.TASK, letters.Q), Matrix((columns,))),
        source=_TASK,
        result=(equation(letters.J_TASK, context.form("Jr")),),
        notes=tuple(_left_out(task)),
        detail=Detail.BRIEF,
    )


def _left_out(task: Task) -> Iterator[Prose]:
    """Which rows of J_v the default task does not have."""
    moving = {entry.row for entry in task.entries if isinstance(entry, Reference)}
    still = [axis for row, axis in enumerate("xyz", 1) if row not in moving]
    if task.is_default and still:
        rows = "row of " if len(still) == 1 else "rows of "
        yield (
            "This is ",
            letters.JV,
            f" without the {rows}",
            *listed(still),
            ", zero in every configuration.",
        )


def _twist(context: Context) -> Step:
    return Step(
        id="Jr",
        stage=STAGE,
        title="The Jacobian of the task",
        why=("The task is the twist of the last frame, its velocity and its angular velocity: ",
             equation(letters.J_TASK, letters.J), "."),
        formula=equation(letters.J_TASK, letters.J),
        source=spong("4.6.3"),
        result=(equation(letters.J_TASK, context.form("Jr")),),
        detail=Detail.BRIEF,
    )  # fmt: skip


# -- how a Jacobian changes ------------------------------------------------------------------------


def _rate(context: Context, name: str, letter: Letter) -> Step:
    changed = letters.rate(letter)
    k = Symbol("k")
    term = Product((Derivative(letter, Letter("q", k)), Letter("q", k, dots=1)))
    total = sum_over_coordinates(term, k, context.robot)
    moved = Product((letter, letters.QDD))
    return Step(
        id=f"{name}_dot",
        stage=STAGE,
        title=f"How {_CALLED[name]} changes",
        why=(
            "Entry by entry, by the chain rule: every joint variable in an entry moves. It stands in the "
            "acceleration, ",
            equation(_acceleration(name), Sum((moved, Product((changed, letters.QD))))),
            ".",
        ),
        formula=equation(changed, total),
        source=_RATES,
        result=(equation(changed, context.form(f"{name}_dot")),),
        detail=Detail.BRIEF,
    )


_CALLED = {
    "Jv": "the linear part of the Jacobian",
    "Jw": "its angular part",
    "Jr": "the Jacobian of the task",
}


def _acceleration(name: str) -> Node:
    """What a Jacobian gives the acceleration of."""
    if name == "Jr":
        return letters.bold("r", dots=2)
    return letters.bold("v" if name == "Jv" else "omega", dots=1)


def _whole_rate(context: Context) -> Step:
    changed = letters.rate(letters.J)
    parts = column(letters.rate(letters.JV), letters.rate(letters.JW))
    return Step(
        id="J_dot",
        stage=STAGE,
        title="How the Jacobian changes",
        why=("The two parts, one above the other.",),
        formula=equation(changed, parts),
        source=_RATES,
        result=(equation(changed, context.form("J_dot")),),
        detail=Detail.BRIEF,
    )


# -- steps of points that an exercise names: where they are, how they move, and along whose axes ---

_AT_POINTS = spong("4.6")


def point_steps(context: Context, point: NamedPoint, wanted: frozenset[str]) -> Iterator[Step]:
    """Its position, its Jacobians and its velocity, as far as they are wanted."""
    p = point.name
    group = Group(f"point{p}", f"The point {p}")
    yield from (replace(step, group=group) for step in _steps(context, point, wanted))


def _steps(context: Context, point: NamedPoint, wanted: frozenset[str]) -> Iterator[Step]:
    p = point.name
    if f"p{p}" in wanted:
        yield _position(context, point)
    if f"Jv{p}" in wanted or f"Jw{p}" in wanted:
        yield _jacobians(context, point, wanted)
    if f"v{p}" in wanted:
        yield _velocity(context, point)


def _position(context: Context, point: NamedPoint) -> Step:
    link, p = point.link, letters.of_point("p", point.name)
    local = context.show(point.position)
    if point.position.is_zero:
        formula: Node = equation(p, letters.o(link))
        why: Prose = (f"{point.name} is the origin of frame {link}.",)
        working: tuple[Node, ...] = ()
    else:
        in_frame = Letter("p", Symbol(point.name), Number(link), "bold")
        formula = equation(p, Sum((Product((letters.R(context.robot, link), in_frame)), letters.o(link))))
        why = (
            f"{point.name} is fixed in link {link}: its coordinates in frame {link} are constant, and it "
            "moves with the frame.",
        )
        working = (equation(in_frame, local),)
    return Step(
        id=f"p{point.name}",
        stage=STAGE,
        title=f"The point {point.name}",
        why=why,
        formula=formula,
        source=spong("2.6"),
        working=working,
        result=(equation(p, context.form(f"p{point.name}")),),
        uses=(f"H{link}",),
        detail=Detail.BRIEF,
    )


def _jacobians(context: Context, point: NamedPoint, wanted: frozenset[str]) -> Step:
    p, robot = point.name, context.robot
    columns = [
        coordinate_column(context, k, point.link, letters.of_point("p", p)) or (ZERO, ZERO)
        for k in range(robot.n)
    ]
    late = [Symbol(q.name) for q, both in zip(robot.coordinates, columns, strict=True) if both[0] == ZERO]
    why: Prose = (f"Column by column, as for the end of the arm, but taken at {p}",)
    if late:
        what = " comes after its link and does not move it." if len(late) == 1 else (
            " come after its link and do not move it."
        )  # fmt: skip
        why += ("; ", *listed(late), what)
    else:
        why += (".",)
    names = [name for name in (f"Jv{p}", f"Jw{p}") if name in wanted]
    parts = {f"Jv{p}": ("v", [v for v, _ in columns]), f"Jw{p}": ("omega", [w for _, w in columns])}
    formulas = [
        equation(letters.j_of_point(parts[name][0], p), Matrix((tuple(parts[name][1]),))) for name in names
    ]
    turned = [line for name in names for line in _turned(context, name, parts[name][0], point)]
    if turned:
        why += (" What is seen from the world is then written along the axes of ", f"frame {point.axes}.")
    return Step(
        id=names[0],
        stage=STAGE,
        title=f"The Jacobian of {p}",
        why=why,
        formula=formulas[0],
        source=_AT_POINTS,
        working=(*formulas[1:], *turned),
        concluding=_named(context, names, point),
        result=tuple(
            equation(letters.j_of_point(parts[name][0], p, point.axes), context.form(name)) for name in names
        ),
        also=tuple(names[1:]),
        uses=("axes", *((f"p{p}",) if f"p{p}" in wanted else ())),
        detail=Detail.BRIEF,
    )


def _named(context: Context, names: Sequence[str], point: NamedPoint) -> Prose:
    """The identities by which what is turned gets shorter."""
    if point.axes is None or not context.is_short:
        return ()
    R = rotation(context.values[f"H{point.axes}"])
    jacobians = [context.values[name] for name in names]
    used = dict.fromkeys(one for J in jacobians for one in used_in_product(context, R.T, R @ J, J))
    return ("With ", *said(list(used)), ":") if used else ()


def _turned(context: Context, name: str, part: str, point: NamedPoint) -> Iterator[Node]:
    """The Jacobian in the world, and how it is turned into the frame along whose axes it is asked."""
    if point.axes is None:
        return
    R = rotation(context.values[f"H{point.axes}"])
    world = context.show(R @ context.values[name])
    J = letters.j_of_point(part, point.name)
    yield equation(J, world)
    product: tuple[Node, ...] = (Product((Transpose(letters.R(context.robot, point.axes)), J)),)
    if is_small(world):
        product += (Product((context.show(R.T), world)),)
    yield equation(letters.j_of_point(part, point.name, point.axes), *product)


def _velocity(context: Context, point: NamedPoint) -> Step:
    p = point.name
    v, J = letters.of_point("v", p, point.axes), letters.j_of_point("v", p, point.axes)
    jacobian = context.form(f"Jv{p}")
    rates = column(*(letters.velocity(q) for q in context.robot.coordinates))
    return Step(
        id=f"v{p}",
        stage=STAGE,
        title=f"The velocity of {p}",
        why=("Each joint adds its column times its rate.",),
        formula=equation(v, Product((J, letters.QD))),
        source=_AT_POINTS,
        working=(equation(v, Product((jacobian, rates))),) if is_small(jacobian) else (),
        result=(equation(v, context.form(f"v{p}")),),
        detail=Detail.BRIEF,
    )
