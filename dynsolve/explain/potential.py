"""Steps of the potential energy of each body: by its height, or by the vectors."""

from __future__ import annotations

from collections.abc import Iterator

from dynsolve.algebra.expr import Expr
from dynsolve.document import Inline, Prose
from dynsolve.explain.context import Context
from dynsolve.explain.step import WORKED, Part, Step
from dynsolve.explain.writing import is_small, measured, name_of, side_by_side, spong
from dynsolve.notation.tree import (
    Letter,
    Matrix,
    Negative,
    Node,
    Number,
    Product,
    Symbol,
    Transpose,
    Words,
    equation,
)
from dynsolve.quantities import letters
from dynsolve.quantities.stages import Stage
from dynsolve.robot.model import Body

STAGE = Stage.ENERGY


def potential_steps(context: Context) -> Iterator[Step]:
    """P_i of every body; what gravity is, and which way is up, is told where it is used first."""
    heavy = [body for body in context.robot.bodies if not body.mass.is_zero]
    for body in context.robot.bodies:
        yield _potential(context, body, tells=heavy[:1] == [body])


def _potential(context: Context, body: Body, tells: bool) -> Step:
    P, pull = letters.of_body("P", body), Product((Transpose(letters.GRAVITY), letters.rc(body)))
    parts: tuple[Node, ...] = (P, Negative(Product((context.mass(body), pull))))
    working: tuple[Node, ...] = ()
    numbers: tuple[Node, ...] = ()
    is_pulled = not context.robot.gravity.is_zero
    if not is_pulled:
        why: Prose = ("There is no gravity.",)
    elif body.mass.is_zero:
        why = (f"{name_of(body).capitalize()} has inertia but no mass, so gravity does not act on it.",)
    else:
        why = _of_gravity(context) if tells else ()
        height = _height(context, body)
        if height is None:
            why += ("Minus the mass times ", pull, ".")
            working = _by_vectors(context, body)
        else:
            h, g = letters.height(letters.index_of(body.name)), _acceleration(context)
            why += _entry_of_height(context, body, h, tells)
            parts += (Product((context.mass(body), g, h)),)
            working, numbers = (equation(h, height),), _numbers(context, body, g, tells)
    return Step(
        id=f"P{body.name}",
        stage=STAGE,
        title=f"Potential energy of {name_of(body)}",
        why=why,
        formula=equation(*parts),
        source=spong("7.2.3"),
        further=(
            *((equation(letters.GRAVITY, gravity_row(context)),) if tells and is_pulled else ()),
            *numbers,
        ),
        working=working,
        result=(equation(P, context.form(f"P{body.name}")),),
        said="" if is_pulled else "no gravity",
        normal=WORKED | Part.WHY if tells or not is_pulled or body.mass.is_zero else WORKED,
    )


def _of_gravity(context: Context) -> Prose:
    """What the vector of gravity is, and which axis points up where one does."""
    why: Prose = (
        letters.GRAVITY,
        " is the acceleration of gravity, which points down (",
        spong("7.2.3"),
        " writes a plus, for which the vector must point up). ",
    )
    along = _along(context)
    if along is None:
        return why
    i, entry = along
    axis: Inline = Letter("xyz"[i], Number(0), style="bold")
    if letters.has_base(context.robot):
        axis = letters.bold("xyz"[i], Words("w"))
    elif context.ground != "base":
        axis = f"The axis {'xyz'[i]} of the world"
    return (*why, axis, f" points {'up' if leads_with_minus(entry) else 'down'}, so ")


def _by_vectors(context: Context, body: Body) -> tuple[Node, ...]:
    """-m g_0ᵀ r_c with this robot's vectors."""
    P, center = letters.of_body("P", body), context.form(f"rc{body.name}")
    product = Product((context.show(body.mass), gravity_row(context).argument, center))
    return (equation(P, Negative(product)),) if is_small(center) else ()


def _entry_of_height(context: Context, body: Body, h: Node, tells: bool) -> Prose:
    """Which entry of r_c the height is."""
    along = _along(context)
    assert along is not None
    i, entry = along
    what = f", the height above the origin of the {context.ground}," if tells else ""
    minus = "" if leads_with_minus(entry) else "minus "
    return (h, f"{what} is {minus}the {('first', 'second', 'third')[i]} entry of ", letters.rc(body), ".")


def _numbers(context: Context, body: Body, g: Node, tells: bool) -> tuple[Node, ...]:
    """What the mass is, and g of the first body, where they are numbers: m_1 = 2.5 kg, g = 9.81 m/s²."""
    (entry,) = (entry for entry in context.robot.gravity.entries if not entry.is_zero)
    size = context.show(-entry if leads_with_minus(entry) else entry)
    named = [(context.mass(body), context.show(body.mass), "kg"), *([(g, size, "m/s²")] if tells else [])]
    given = [equation(letter, measured(value, unit)) for letter, value, unit in named if letter != value]
    return (side_by_side(given),) if given else ()


def gravity_row(context: Context) -> Transpose:
    """The vector of gravity as the transpose of a row."""
    return Transpose(Matrix((tuple(map(context.show, context.robot.gravity.entries)),)))


def _along(context: Context) -> tuple[int, Expr] | None:
    """The axis, from 0, along which gravity lies, and its entry there; None where it lies along none."""
    along = [(i, entry) for i, entry in enumerate(context.robot.gravity.entries) if not entry.is_zero]
    return along[0] if len(along) == 1 else None


def _height(context: Context, body: Body) -> Node | None:
    """The height of the mass centre, where gravity lies along an axis of the base."""
    along = _along(context)
    if along is None:
        return None
    i, entry = along
    center: Expr = context.values[f"rc{body.name}"][i, 0]
    return context.show(center if leads_with_minus(entry) else -center)


def _acceleration(context: Context) -> Node:
    """The size of gravity along its axis: the problem's symbol, g for a number."""
    (entry,) = (entry for entry in context.robot.gravity.entries if not entry.is_zero)
    size = context.show(-entry if leads_with_minus(entry) else entry)
    named = "g" in context.robot.parameters
    return size if named or not entry.is_number else Symbol("g")


def leads_with_minus(expr: Expr) -> bool:
    """Whether a value is written with a minus: of gravity along an axis, whether that points up."""
    return bool(expr.poly.leading_coefficient() < 0)
