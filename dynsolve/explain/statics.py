"""Steps of forces from outside: their generalized forces, their sum, the torques that hold them."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from dynsolve.derivation import statics
from dynsolve.derivation.kinematics import frame_names
from dynsolve.derivation.static_rules import jacobians
from dynsolve.document import Prose
from dynsolve.explain.context import Context
from dynsolve.explain.step import NOTED, Detail, Group, Step
from dynsolve.explain.writing import is_small, side_by_side, spong, sum_of
from dynsolve.notation.tree import (
    Letter,
    Negative,
    Node,
    Number,
    Product,
    Sum,
    Symbol,
    Transpose,
    equation,
)
from dynsolve.quantities import letters
from dynsolve.quantities.stages import Stage
from dynsolve.robot.questions import TIP, Load

STAGE = Stage.STATICS

HELD = Group("Q", "The sum, and the torques that hold it")


def steps(context: Context) -> Iterator[Step]:
    """Force by force what it does to the joints, the sum, and what holds it at rest."""
    wanted = context.wanted
    for index, load in enumerate(context.robot.questions.loads, 1):
        if f"load{index}" in wanted:
            yield _load(context, index, load)
    if "Q" in wanted:
        yield replace(_total(context), group=HELD)
    if "tau_static" in wanted:
        yield replace(_holding(context), group=HELD)


def state_prose(context: Context) -> Prose:
    """The state that something is asked for at, as words: At q₁ = 90°, q̇₁ = 1."""
    values = context.robot.questions.state.values
    if not values:
        return ()
    return ("At ", side_by_side([equation(Symbol(name, dots), value) for name, dots, value in values]), ".")


# -- one force -------------------------------------------------------------------------------------


def _load(context: Context, index: int, load: Load) -> Step:
    Q = letters.of_load(index)
    where: Prose = ("the tip",) if load.point == TIP else (load.point,) if load.point else ("its point",)
    return Step(
        id=f"load{index}",
        stage=STAGE,
        title=f"What force {index} does to the joints",
        why=(
            "In every motion its power is ", *_power(index, load), ", and that of its generalized forces ",
            Product((Transpose(Q), letters.QD)), ": so the transpose of the Jacobian of ", *where,
            " gives its effect on the joints.",
        ),
        formula=equation(Q, sum_of(_in_letters(index, load))),
        source=spong("4.10"),
        working=tuple(_working(context, index, load)),
        result=(equation(Q, context.form(f"load{index}")),),
        notes=tuple(_notes(load)),
        normal=NOTED,
    )  # fmt: skip


def _force(index: int) -> Letter:
    return letters.bold("F", Number(index))


def _moment(index: int) -> Letter:
    return letters.bold("M", Number(index))


def _j(part: str, load: Load) -> Letter:
    """J_v or J_ω of the point that a force acts at."""
    if load.point and load.point != TIP:
        return letters.j_of_point(part, load.point)
    return letters.JV if part == "v" else letters.JW


def _in_letters(index: int, load: Load) -> list[Node]:
    """J_vᵀ F and J_ωᵀ M, of which one may be absent."""
    parts: list[Node] = []
    if not load.force.is_zero or load.moment.is_zero:
        parts.append(Product((Transpose(_j("v", load)), _force(index))))
    if not load.moment.is_zero:
        parts.append(Product((Transpose(_j("omega", load)), _moment(index))))
    return parts


def _power(index: int, load: Load) -> Prose:
    force = Product((Transpose(_force(index)), letters.bold("v")))
    moment = Product((Transpose(_moment(index)), letters.bold("omega")))
    if load.moment.is_zero:
        return (force,)
    return (moment,) if load.force.is_zero else (Sum((force, moment)),)


def _working(context: Context, index: int, load: Load) -> Iterator[Node]:
    """The force in the world, the Jacobians of a point without a name, and the product with matrices."""
    frames = tuple(context.values[name] for name in frame_names(load.link))
    force, moment = statics.wrench(load, frames[load.link])
    linear, angular = jacobians(context.robot, load, frames)
    shown = [
        (letter, context.show(vector), _j(part, load), context.show(jacobian))
        for letter, vector, part, jacobian in (
            (_force(index), force, "v", linear),
            (_moment(index), moment, "omega", angular),
        )
        if not vector.is_zero
    ]
    for letter, vector, J, jacobian in shown:
        yield equation(letter, vector)
        if not load.point:
            yield equation(J, jacobian)
    if shown and is_small(*(node for _, vector, _, jacobian in shown for node in (vector, jacobian))):
        products = [Product((Transpose(jacobian), vector)) for _, vector, _, jacobian in shown]
        yield equation(letters.of_load(index), sum_of(products))


def _notes(load: Load) -> Iterator[Prose]:
    if load.by_robot:
        yield ("The robot exerts it, so what acts on the robot is its opposite.",)
    if load.axes is not None:
        yield ("It is given along axes of its link, and turned into the world.",)


# -- all of them -----------------------------------------------------------------------------------


def _total(context: Context) -> Step:
    loads = context.robot.questions.loads
    parts: list[Node] = [letters.of_load(i) for i, _ in enumerate(loads, 1)]
    values = [context.values[f"load{i}"] for i, _ in enumerate(loads, 1)]
    at = state_prose(context)
    general = context.show(statics.total(context.robot, tuple(values)))
    return Step(
        id="Q",
        stage=STAGE,
        title="The generalized forces from outside",
        why=(("The sum over the forces. " if len(parts) > 1 else "There is only one force. "), *at),
        formula=equation(letters.Q_FORCES, sum_of(parts)),
        source=spong("4.10"),
        working=(equation(letters.Q_FORCES, general),) if at and len(parts) > 1 else (),
        result=(equation(letters.Q_FORCES, context.form("Q")),),
        detail=Detail.BRIEF,
    )


def _holding(context: Context) -> Step:
    Q, g = letters.Q_FORCES, letters.G
    heavy = bool(context.robot.bodies) and not context.robot.gravity.is_zero
    why: Prose = ("At rest only gravity and these forces are left in the equations of motion. ",)
    if not heavy:
        why = ("At rest, and without gravity, only these forces are left in the equations of motion. ",)
    right: Node = Sum((g, Negative(Q))) if heavy else Negative(Q)
    return Step(
        id="tau_static",
        stage=STAGE,
        title="The torques that hold it at rest",
        why=(*why, *state_prose(context)),
        formula=equation(letters.TAU_STATIC, right),
        source=spong("4.10"),
        working=((equation(g, context.form("g")),) if heavy and is_small(context.form("g")) else ()),
        result=(equation(letters.TAU_STATIC, context.form("tau_static")),),
        detail=Detail.BRIEF,
    )
