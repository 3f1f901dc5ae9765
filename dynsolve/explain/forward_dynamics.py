"""The step of forward dynamics: the accelerations that given forces make."""

from __future__ import annotations

from collections.abc import Iterator

from dynsolve.algebra.fraction_matrix import quotient
from dynsolve.algebra.minors import determinant
from dynsolve.algebra.pseudoinverse import adjugate
from dynsolve.derivation.graph import Skipped
from dynsolve.explain.citations import LYNCH_PARK
from dynsolve.explain.closing import acting_side, equations_of_motion, motors_prose, with_force_letters
from dynsolve.explain.context import Context
from dynsolve.explain.step import Detail, Line, Step
from dynsolve.explain.writing import is_small
from dynsolve.notation.tree import Negative, Number, Parenthesized, Power, Product, equation
from dynsolve.notation.walk import mapped
from dynsolve.quantities import letters
from dynsolve.quantities.stages import Stage

STAGE = Stage.FORWARD_DYNAMICS
NAME = "qdd_forward"
_INVERSE = Power(letters.D, Negative(Number(1)))


def steps(context: Context) -> Iterator[Step]:
    """q̈ from the forces, where it is asked for."""
    if NAME not in context.wanted:
        return
    value = context.values[NAME]
    if isinstance(value, Skipped):
        yield Step(NAME, STAGE, "Not derived", (value.why.capitalize() + ".",), detail=Detail.BRIEF)
        return
    lines = _inverse(context)
    shown = mapped(context.form(NAME), with_force_letters(context.robot))
    yield Step(
        id=NAME,
        stage=STAGE,
        title="The accelerations that the forces make",
        why=(
            "The equations of motion, ", equations_of_motion(context), ", are linear in the accelerations; ",
            letters.D, " is positive definite, so that it has an inverse.", *motors_prose(context),
        ),
        formula=equation(letters.QDD, Product((_INVERSE, Parenthesized(acting_side(context))))),
        source=LYNCH_PARK.section("8.5"),
        lines=lines,
        concluding=("Multiplied out, and cancelled:",) if lines else (),
        result=(equation(letters.QDD, shown),),
        detail=Detail.BRIEF,
    )  # fmt: skip


def _inverse(context: Context) -> tuple[Line, ...]:
    """D⁻¹ as an adjugate over a determinant, where it can be read."""
    D = context.values["D"]
    shown = context.forms.of(quotient(adjugate(D), determinant(D)))
    if not is_small(shown):
        return ()
    return (
        Line(
            (
                "The inverse of ",
                letters.D,
                ", its adjugate over its determinant:",
            ),
            (equation(_INVERSE, shown),),
        ),
    )
