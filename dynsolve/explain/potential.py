"""Steps of the potential energy of each body: by its height, and by the vectors."""

from __future__ import annotations

from collections.abc import Iterator

from dynsolve.algebra.expr import Expr
from dynsolve.document import Prose
from dynsolve.explain.context import Context
from dynsolve.explain.step import Step
from dynsolve.explain.writing import is_small, name_of, side_by_side, spong
from dynsolve.notation.tree import (
    Letter,
    Matrix,
    Negative,
    Node,
    Number,
    Product,
    Symbol,
    Transpose,
    equation,
)
from dynsolve.quantities import letters
from dynsolve.quantities.stages import Stage
from dynsolve.robot.model import Body

STAGE = Stage.ENERGY


def potential_steps(context: Context) -> Iterator[Step]:
    """P_i of every body; the vector of gravity is written out where it is used first."""
    heavy = [body for body in context.robot.bodies if not body.mass.is_zero]
    for body in context.robot.bodies:
        yield _potential(context, body, tells=heavy[:1] == [body])


def _potential(context: Context, body: Body, tells: bool) -> Step:
    P = letters.of_body("P", body)
    general = equation(
        P, Negative(Product((context.mass(body), Transpose(letters.GRAVITY), letters.rc(body))))
    )
    formula: Node = general
    working: tuple[Node, ...] = ()
    if context.robot.gravity.is_zero:
        why: Prose = ("There is no gravity.",)
    elif body.mass.is_zero:
        why = (f"{name_of(body).capitalize()} has inertia but no mass, so gravity does not act on it.",)
    else:
        why, formula, working = _weight(context, body, general)
        if tells:
            working = (equation(letters.GRAVITY, _gravity(context)), *working)
    return Step(
        id=f"P{body.name}",
        stage=STAGE,
        title=f"Potential energy of {name_of(body)}",
        why=why,
        formula=formula,
        source=spong("7.2.3"),
        working=working,
        result=(equation(P, context.form(f"P{body.name}")),),
    )


def _weight(context: Context, body: Body, general: Node) -> tuple[Prose, Node, tuple[Node, ...]]:
    """By the height, where gravity lies along an axis, and by the vectors: why, the formula, the working."""
    P = letters.of_body("P", body)
    center = context.form(f"rc{body.name}")
    vectors = equation(P, Negative(Product((context.show(body.mass), _gravity(context).argument, center))))
    working: tuple[Node, ...] = (vectors,) if is_small(center) else ()
    product: Prose = (
        Product((Transpose(letters.GRAVITY), letters.rc(body))),
        ", ",
        letters.GRAVITY,
        " being the acceleration of gravity, which points down (",
        spong("7.2.3"),
        " writes a plus: its vector points up).",
    )
    height = _height(context, body)
    if height is None:
        return ("Minus the mass times ", *product), general, working
    h, g = letters.height(context.robot, letters.index_of(body.name)), _acceleration(context)
    why: Prose = (
        "The mass times ",
        g,
        " times the height ",
        h,
        f" above the origin of the {context.ground}: ",
    )
    why += (*_entry_of_height(context, body), " The same with vectors: minus the mass times ", *product)
    formula = side_by_side([equation(P, Product((context.mass(body), g, h))), general])
    return why, formula, (*_numbers(context, body, g), equation(h, height), *working)


def _numbers(context: Context, body: Body, g: Node) -> tuple[Node, ...]:
    """What the mass and g are where they are numbers: m_2 = 1.2, g = 9.81."""
    (entry,) = (entry for entry in context.robot.gravity.entries if not entry.is_zero)
    size = context.show(-entry if _leads_with_minus(entry) else entry)
    named = ((context.mass(body), context.show(body.mass)), (g, size))
    given = [equation(letter, value) for letter, value in named if letter != value]
    return (side_by_side(given),) if given else ()


def _gravity(context: Context) -> Transpose:
    """The vector of gravity as the transpose of a row."""
    return Transpose(Matrix((tuple(map(context.show, context.robot.gravity.entries)),)))


def _entry_of_height(context: Context, body: Body) -> Prose:
    """Which axis points up, and so which entry of r_c is the height."""
    ((i, entry),) = ((i, entry) for i, entry in enumerate(context.robot.gravity.entries) if not entry.is_zero)
    is_up = _leads_with_minus(entry)
    axis = Letter("xyz"[i], Number(0), style="bold")
    of_ground: Prose = (axis,) if context.ground == "base" else (f"the axis {'xyz'[i]} of the world",)
    place = ("first", "second", "third")[i]
    sense = "up, so it is the" if is_up else "down, so it is minus the"
    return (*of_ground, f" points {sense} {place} entry of ", letters.rc(body), ".")


def _height(context: Context, body: Body) -> Node | None:
    """The height of the mass centre, where gravity lies along an axis of the base."""
    along = [(i, entry) for i, entry in enumerate(context.robot.gravity.entries) if not entry.is_zero]
    if len(along) != 1:
        return None
    i, entry = along[0]
    center: Expr = context.values[f"rc{body.name}"][i, 0]
    return context.show(center if _leads_with_minus(entry) else -center)


def _acceleration(context: Context) -> Node:
    """The size of gravity along its axis: the problem's symbol, g for a number."""
    (entry,) = (entry for entry in context.robot.gravity.entries if not entry.is_zero)
    size = context.show(-entry if _leads_with_minus(entry) else entry)
    named = "g" in context.robot.parameters
    return size if named or not entry.is_number else Symbol("g")


def _leads_with_minus(expr: Expr) -> bool:
    return bool(expr.poly.leading_coefficient() < 0)
