"""The step of Λ, the inertia that a force at the task meets."""

from __future__ import annotations

from collections.abc import Iterator

from dynsolve.algebra.minors import determinant
from dynsolve.derivation.graph import Skipped
from dynsolve.explain.citations import LYNCH_PARK
from dynsolve.explain.context import Context
from dynsolve.explain.step import Detail, Step
from dynsolve.explain.writing import is_small
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
from dynsolve.quantities import letters
from dynsolve.quantities.stages import Stage

STAGE = Stage.TASK_INERTIA
_J, _MINUS = letters.J_TASK, Negative(Number(1))


def steps(context: Context) -> Iterator[Step]:
    """Λ, where it is asked for."""
    if "Lambda" not in context.wanted:
        return
    value = context.values["Lambda"]
    if isinstance(value, Skipped):
        yield Step("Lambda", STAGE, "Not derived", (value.why.capitalize() + ".",), detail=Detail.BRIEF)
        return
    (rows, columns), D = context.values["Jr"].shape, context.values["D"]
    size = context.show(determinant(D))
    F, inverse = letters.bold("F"), Power(letters.D, _MINUS)
    forms: list[Node] = [Power(Parenthesized(Product((_J, inverse, Transpose(_J)))), _MINUS)]
    if rows == columns:
        forms.append(Product((Power(_J, Row((_MINUS, Words("T")))), letters.D, Power(_J, _MINUS))))
    yield Step(
        id="Lambda",
        stage=STAGE,
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
