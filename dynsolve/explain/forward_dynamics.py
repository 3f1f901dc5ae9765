"""The step of forward dynamics: the accelerations that given forces make."""

from __future__ import annotations

from collections.abc import Iterator

from dynsolve.algebra.fraction_matrix import quotient
from dynsolve.algebra.minors import determinant
from dynsolve.algebra.pseudoinverse import adjugate
from dynsolve.derivation.graph import Skipped
from dynsolve.explain.context import Context
from dynsolve.explain.step import Detail, Line, Step
from dynsolve.explain.terms import acting_side, equations_of_motion, motors_prose, with_force_letters
from dynsolve.explain.writing import LYNCH_PARK, is_small
from dynsolve.notation.tree import (
    Negative,
    Node,
    Number,
    Parenthesized,
    Power,
    Product,
    Row,
    Transpose,
    Words,
    equation,
)
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


# -- the step of Λ, the inertia that a force at the task meets -------------------------------------

STAGE_OF_TASK_INERTIA = Stage.TASK_INERTIA
_J, _MINUS = letters.J_TASK, Negative(Number(1))


def task_inertia_steps(context: Context) -> Iterator[Step]:
    """Λ, where it is asked for."""
    if "Lambda" not in context.wanted:
        return
    value = context.values["Lambda"]
    if isinstance(value, Skipped):
        yield Step(
            "Lambda",
            STAGE_OF_TASK_INERTIA,
            "Not derived",
            (value.why.capitalize() + ".",),
            detail=Detail.BRIEF,
        )
        return
    (rows, columns), D = context.values["Jr"].shape, context.values["D"]
    size = context.show(determinant(D))
    F, inverse = letters.bold("F"), Power(letters.D, _MINUS)
    forms: list[Node] = [Power(Parenthesized(Product((_J, inverse, Transpose(_J)))), _MINUS)]
    if rows == columns:
        forms.append(Product((Power(_J, Row((_MINUS, Words("T")))), letters.D, Power(_J, _MINUS))))
    yield Step(
        id="Lambda",
        stage=STAGE_OF_TASK_INERTIA,
        title="The inertia matrix of the task",
        why=("A force ", F, " at the task acts on the joints as ", Product((Transpose(_J), F)), ", ",
             inverse, " makes accelerations of that, and ", _J, " the acceleration of the task. The matrix "
             "between force and acceleration, inverted, is the inertia. "
             + ("The Jacobian is square, and has an inverse itself." if rows == columns else "")),
        formula=equation(letters.TASK_INERTIA, *forms),
        source=LYNCH_PARK.section("8.6"),
        working=(equation(Row((Words("det "), letters.D)), size),) if is_small(size) else (),
        result=(equation(letters.TASK_INERTIA, context.form("Lambda")),),
        notes=(("It exists where the rows of the Jacobian are independent.",),),
        detail=Detail.BRIEF,
    )  # fmt: skip
