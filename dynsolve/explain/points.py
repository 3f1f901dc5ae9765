"""Steps of points that an exercise names: where they are, how they move, and along whose axes."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace

from dynsolve.derivation.kinematics import rotation
from dynsolve.document import Prose
from dynsolve.explain.context import Context
from dynsolve.explain.jacobian_columns import ZERO, coordinate_column
from dynsolve.explain.step import Detail, Group, Step
from dynsolve.explain.working.identities import said
from dynsolve.explain.working.products import used_in_product
from dynsolve.explain.writing import is_small, listed, spong
from dynsolve.notation.tree import (
    Letter,
    Matrix,
    Node,
    Number,
    Product,
    Sum,
    Symbol,
    Transpose,
    column,
    equation,
)
from dynsolve.quantities import letters
from dynsolve.quantities.stages import Stage
from dynsolve.robot.questions import NamedPoint

STAGE = Stage.TASK

_POINTS = spong("4.6")


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
        source=_POINTS,
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
        source=_POINTS,
        working=(equation(v, Product((jacobian, rates))),) if is_small(jacobian) else (),
        result=(equation(v, context.form(f"v{p}")),),
        detail=Detail.BRIEF,
    )
