"""The step that closes a derivation: D q̈ + C q̇ + g = τ, with this robot's matrices where they fit.

Friction stands beside g, forces from outside and of constraint beside τ, where there are any.
"""

from __future__ import annotations

from collections.abc import Callable

from dynsolve.document import Prose, Reference
from dynsolve.explain.citations import spong
from dynsolve.explain.context import Context
from dynsolve.explain.entry_formulas import ChristoffelSymbols, collected_coriolis_force
from dynsolve.explain.step import Detail, Line, Step
from dynsolve.explain.widths import matrix_width
from dynsolve.explain.writing import listed, sum_of
from dynsolve.notation.build import times, total
from dynsolve.notation.tree import (
    ZERO,
    Entry,
    Negative,
    Node,
    Number,
    Product,
    Relation,
    Sum,
    Symbol,
    Transpose,
    column,
    equation,
)
from dynsolve.quantities import letters
from dynsolve.quantities.stages import Stage
from dynsolve.robot.model import Coordinate, Robot

ID = "model"
"""The closing step; reports show it in their last section, with what it is made of."""


WIDEST = 84
"""The characters up to which matrices are written out in the equation; wider ones stand by themselves."""


def closing_step(context: Context) -> Step:
    """D q̈ + C q̇ + g = τ, with friction on the left, Q and A_cᵀ λ on the right where there are any."""
    robot, rubs = context.robot, has_friction(context)
    parts = [context.matrix(name) for name in ("D", "C", *(("friction",) if rubs else ()), "g")]
    qd = column(*(Symbol(q.name, 1) for q in robot.coordinates))
    qdd = column(*(Symbol(q.name, 2) for q in robot.coordinates))
    passive = robot.actions.passive
    forces = column(*(ZERO if k in passive else letters.force(q) for k, q in enumerate(robot.coordinates)))
    result: tuple[Node, ...] = ()
    if context.is_short and all(matrix_width(context, part) <= WIDEST for part in parts):
        left = Sum((Product((parts[0], qdd)), Product((parts[1], qd)), *parts[2:]))
        result = (equation(left, sum_of([forces, *_beside_motors(context)])),)
    return Step(
        id=ID,
        stage=Stage.VECTORIZED,
        title="The dynamical model",
        why=_meanings(context),
        formula=equations_of_motion(context),
        source=spong("7.3"),
        result=result,
        detail=Detail.BRIEF,
    )


def rows_in_names(context: Context, symbol: ChristoffelSymbols) -> Line:
    """Σ_j d_kj q̈_j + Σ_ij c_ijk q̇_i q̇_j + g_k = τ_k with this robot's D and g, its symbols in names."""
    robot, (D, g) = context.robot, (context.matrix(name) for name in ("D", "g"))
    names = robot.ring.names
    friction = context.matrix("friction") if has_friction(context) else None

    def row(k: int) -> Node:
        entries = zip(D.rows[k], names, strict=True)
        inertial = [times(1, [(d, 1), (Symbol(name, 2), 1)]) for d, name in entries if d != ZERO]
        rubbing = () if friction is None else (friction.rows[k][0],)
        heights = [part for part in (g.rows[k][0],) if part != ZERO]
        return total([*inertial, collected_coriolis_force(names, symbol, k), *rubbing, *heights])

    rows = (equation(driving_row(context, q), row(k)) for k, q in enumerate(robot.coordinates))
    forces = Reference(tuple(f"tau{q.index}" for q in robot.coordinates), ", ")
    return Line(("Row by row", forces, ":"), tuple(rows))


def has_friction(context: Context) -> bool:
    """Whether friction is a term of its own."""
    return "friction" in context.values.rules


def _beside_motors(context: Context) -> list[Node]:
    """Q and A_cᵀ λ, as far as there are forces from outside and constraints."""
    asked = context.robot.questions
    outside: list[Node] = [letters.Q_FORCES] if asked.loads else []
    held: list[Node] = [Product((Transpose(letters.A_C), letters.LAMBDA))] if asked.constraints else []
    return [*outside, *held]


def driving_side(context: Context, constrained: bool = True) -> Node:
    """τ + Q + A_cᵀ λ, or without the last where that is put elsewhere."""
    beside = _beside_motors(context)
    if not constrained and context.robot.questions.constraints:
        beside.pop()
    return sum_of([letters.TAU, *beside])


def driving_row(context: Context, q: Coordinate) -> Node:
    """τ_k + Q_k + (A_cᵀ λ)_k: what a row of the left side comes to, with everything that acts."""
    k, asked = Number(q.index), context.robot.questions
    outside: list[Node] = [letters.entry("Q", q.index)] if asked.loads else []
    held: list[Node] = []
    if asked.constraints:
        held = [Entry(Product((Transpose(letters.A_C), letters.LAMBDA)), k)]
    return sum_of([letters.force(q), *outside, *held])


def moving_side(context: Context) -> Sum:
    """D q̈ + C q̇ + g, and friction."""
    rubs = (letters.FRICTION,) if has_friction(context) else ()
    inertial, coriolis = Product((letters.D, letters.QDD)), Product((letters.C, letters.QD))
    return Sum((inertial, coriolis, *rubs, letters.G))


def acting_side(context: Context) -> Node:
    """τ + Q - C q̇ - friction - g: everything that acts but constraints, beside D q̈."""
    _, *rest = moving_side(context).terms
    driving = driving_side(context, constrained=False)
    return sum_of([*(driving.terms if isinstance(driving, Sum) else (driving,)), *map(Negative, rest)])


def equations_of_motion(context: Context) -> Relation:
    """D q̈ + C q̇ + g = τ in letters, with everything that acts."""
    return equation(moving_side(context), driving_side(context))


def _meanings(context: Context) -> Prose:
    """What the terms of the equation are."""
    asked = context.robot.questions
    why: Prose = (Product((letters.D, letters.QDD)), " are the inertial terms, ")
    why += (Product((letters.C, letters.QD)), " the Coriolis and centrifugal ones, ")
    why += (letters.FRICTION, " those of friction, ") if has_friction(context) else ()
    why += (letters.G, " those of gravity", " and springs." if context.robot.actions.springs else ".")
    why += (" ", letters.Q_FORCES, " are the forces from outside.") if asked.loads else ()
    if asked.constraints:
        why += (" ", Product((Transpose(letters.A_C), letters.LAMBDA)), " are the forces of the constraints.")
    if context.robot.actions.passive:
        from dynsolve.explain.actions import passive_prose

        why += passive_prose(context)
    return why


def motors_prose(context: Context) -> Prose:
    """Which names stand for what the motors do."""
    robot = context.robot
    forces = [letters.force(q) for k, q in enumerate(robot.coordinates) if k not in robot.actions.passive]
    if not forces:
        return ()
    return (
        " ",
        *listed(forces),
        " is what the motor does." if len(forces) == 1 else " are what the motors do.",
    )


def with_force_letters(robot: Robot) -> Callable[[Node], Node]:
    """The names of generalized forces as the letters that they are printed with elsewhere."""
    forces = {q.force: letters.force(q) for q in robot.coordinates if q.force in robot.inputs}
    return lambda part: forces.get(part.name, part) if isinstance(part, Symbol) else part
