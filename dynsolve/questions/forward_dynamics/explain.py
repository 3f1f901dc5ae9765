"""The step of the accelerations that given forces make."""

from __future__ import annotations

from collections.abc import Iterator

from dynsolve.algebra.linear_systems import adjugate, quotient
from dynsolve.algebra.matrix import determinant
from dynsolve.derivation.graph import Skipped
from dynsolve.document.sentences import say
from dynsolve.explain.context import Context
from dynsolve.explain.step import Detail, Line, Step, not_derived
from dynsolve.explain.terms import (
    acting_side,
    equations_of_motion,
    motors_prose,
    with_force_letters,
)
from dynsolve.explain.writing import LYNCH_PARK, is_small
from dynsolve.notation.template import formula
from dynsolve.notation.tree import Node, Symbol, equation, mapped
from dynsolve.quantities import letters


def steps(context: Context) -> Iterator[Step]:
    """q̈ from the forces, where it is asked for."""
    if "qdd_forward" not in context.wanted:
        return
    value = context.values["qdd_forward"]
    if isinstance(value, Skipped):
        yield not_derived("qdd_forward", "The accelerations", value.why)
        return
    D = context.values["D"]
    inverse = context.forms.of(quotient(adjugate(D), determinant(D)))
    lines = (inverse_of_inertia(inverse),) if is_small(inverse) else ()
    shown = mapped(context.form("qdd_forward"), with_force_letters(context.robot))
    yield Step(
        id="qdd_forward",
        title="The accelerations that the forces make",
        why=say(
            "The equations of motion, {equations}, are linear in the accelerations, and $𝐃$ has an "
            "inverse.{motors}",
            equations=equations_of_motion(context),
            motors=motors_prose(context),
        ),
        formula=formula("𝐪̈ = 𝐃⁻¹ ({acting})", acting=acting_side(context)),
        source=LYNCH_PARK.section("8.5"),
        lines=lines,
        concluding=("Multiplied out, and cancelled:",) if lines else (),
        result=(equation(letters.QDD, shown),),
        entries=tuple((Symbol(q.name, 2),) for q in context.robot.coordinates),
        detail=Detail.BRIEF,
    )


def inverse_of_inertia(inverse: Node) -> Line:
    """D⁻¹, as a line."""
    told = say("The inverse of $𝐃$, its adjugate over its determinant:")
    return Line(told, (formula("𝐃⁻¹ = {inverse}", inverse=inverse),), is_kept=True)


# -- hints -----------------------------------------------------------------------------------------

AT_HAND = "You have the matrices of the equations of motion:"

PITFALLS = """
    The inverse of $𝐃$ stands before the whole sum of forces, from the left.
    What stands beside the inertial forces, on their side, goes over with a minus sign.
    passive? What no motor drives is accelerated, too: its force is 0, and its row stays.
"""


def inputs(context: Context) -> list[tuple[Node, str]]:
    """The results that it starts from, by letter and name."""
    return [(letters.D, "D"), (letters.C, "C"), (letters.G, "g")]
