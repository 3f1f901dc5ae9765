"""What is said of every equilibrium: the step itself, what is assumed, which coordinates are free."""

from __future__ import annotations

from collections.abc import Collection, Sequence

from dynsolve.document import Prose, Table
from dynsolve.explain.closing import driving_side
from dynsolve.explain.context import Context
from dynsolve.explain.step import Line, Step
from dynsolve.explain.writing import listed, spong
from dynsolve.notation.tree import Symbol, equation
from dynsolve.quantities import letters
from dynsolve.quantities.stages import Stage


def told(
    why: Prose,
    lines: Sequence[Line] = (),
    concluding: Prose = (),
    table: Table | None = None,
    outcome: Prose = (),
) -> Step:
    """The step, by what is said before its lines and after them; its `outcome` may be what it says itself."""
    return Step(
        id="equilibrium",
        stage=Stage.VECTORIZED,
        title="Check: where gravity is balanced",
        why=why,
        source=spong("7.2.3"),
        lines=tuple(lines),
        concluding=concluding,
        table=table,
        table_last=bool(lines),
        outcome=outcome or concluding or why,
        is_task=False,
    )


def at_rest(context: Context) -> Prose:
    """What an equilibrium is."""
    without_force = equation(driving_side(context), letters.bold("0"))
    zero = equation(letters.G, letters.bold("0"))
    return (
        f"In an equilibrium the {context.machine} stays at rest with ",
        without_force,
        ", so ",
        zero,
        ". ",
    )


def assumed(context: Context) -> Prose:
    """That lengths and masses are positive, where there are any in letters."""
    return ("Let all parameters be positive. ",) if context.robot.parameters else ()


def in_no_others(poses: str) -> str:
    """That there are no other poses than those: `this pose`, `the poses of the table`."""
    return f"Gravity is balanced in {poses} alone (up to full turns)"


def free(context: Context, names: Collection[str]) -> Prose:
    """The coordinates but those that are named, which may have any value."""
    others = [Symbol(q.name) for q in context.robot.coordinates if q.name not in names]
    return (", whatever ", *listed(others), " is" if len(others) == 1 else " are") if others else ()
