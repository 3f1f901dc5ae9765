"""The step of Λ, the inertia that a force at the task meets."""

from __future__ import annotations

from collections.abc import Iterator

from msgspec.structs import replace

from dynsolve.algebra.factors import is_never_zero, trig_factors
from dynsolve.algebra.linear_systems import adjugate, quotient
from dynsolve.algebra.matrix import determinant
from dynsolve.document import Prose
from dynsolve.document.books import LYNCH_PARK
from dynsolve.document.sentences import say
from dynsolve.explain.context import Context
from dynsolve.explain.step import NOTED, Detail, Step, not_derived
from dynsolve.explain.writing import as_row, is_small, scalar
from dynsolve.notation.build import split_sign, times
from dynsolve.notation.template import formula
from dynsolve.notation.tree import ZERO, Negative, Node, Number, Power, Relation, equation
from dynsolve.quantities import letters
from dynsolve.questions.forward_dynamics.explain import as_far_as_read, is_not_derived, is_too_large
from dynsolve.questions.independent_rows import where_independent

_SQUARE = "The Jacobian is square, and has an inverse itself where its determinant is not 0."


LETTERS = """
* 𝚲 | inertia matrix of the task
"""
"""The lines of its letters in the list of notation."""


def steps(context: Context) -> Iterator[Step]:
    """Λ, where it is asked for."""
    if "Lambda" not in context.wanted:
        return
    value = context.values["Lambda"]
    if is_not_derived(value):
        yield not_derived("Lambda", "The inertia matrix of the task", value.why)
        return
    rows, columns = context.values["Jr"].shape
    transposed = Power(letters.J_TASK, as_row((Negative(Number(1)), "T")))
    square = " = {transposed} 𝐃 𝐉_r⁻¹" if rows == columns else ""
    step = Step(
        id="Lambda",
        title="The inertia matrix of the task",
        why=say(
            "A force $𝐅$ at the task acts on the joints as $𝐉_rᵀ 𝐅$, $𝐃⁻¹$ makes accelerations of that, and "
            "$𝐉_r$ the acceleration of the task. The matrix between force and acceleration, inverted, is the "
            "inertia. {square}",
            square=_SQUARE if rows == columns else "",
        ),
        formula=formula(f"𝚲 = (𝐉_r 𝐃⁻¹ 𝐉_rᵀ)⁻¹{square}", transposed=transposed),
        source=LYNCH_PARK.section("8.6"),
        working=() if is_too_large(value) else _working(context),
        result=(equation(letters.TASK_INERTIA, context.form("Lambda")),),
        detail=Detail.BRIEF,
    )
    if exists := _exists(context):
        step = replace(step, notes=(exists,), holds=exists, normal=NOTED)
    yield as_far_as_read(step, value)


def _exists(context: Context) -> Prose:
    """Where the rows of the Jacobian are independent; nothing where they always are."""
    J = context.values["Jr"]
    if J.shape[0] != J.shape[1]:
        where = where_independent(context, J, letters.J_TASK)
        return say("It exists {where}.", where=where) if where else ()
    moving = [f for f, _ in trig_factors(determinant(J)) if f.ring.depends_on_coordinates(f)]
    if all(map(is_never_zero, moving)):
        return ()
    _, product = split_sign(times(1, [(context.forms.of(factor), 1) for factor in moving]))
    return say("It exists where {unequal}.", unequal=Relation((product, ZERO), ("≠",)))


def _working(context: Context) -> tuple[Node, ...]:
    """J_r⁻¹, or what is inverted, where it can be read."""
    J, D = context.values["Jr"], context.values["D"]
    if J.shape[0] == J.shape[1]:
        inverse = context.forms.of(quotient(adjugate(J), determinant(J)))
        return (equation(formula("𝐉_r⁻¹"), inverse),) if is_small(inverse) else ()
    mobility = scalar(context.forms.of(quotient(J @ adjugate(D) @ J.T, determinant(D))))
    return (equation(formula("𝐉_r 𝐃⁻¹ 𝐉_rᵀ"), mobility),) if is_small(mobility) else ()


# -- hints -----------------------------------------------------------------------------------------

AT_HAND = "You have the Jacobian of the task and the inertia matrix:"

PITFALLS = """
    Where the Jacobian is not square only the whole product has an inverse.
    Where the Jacobian is square its inverse stands on the right, the transpose of that on the left.
"""


def inputs(context: Context) -> list[tuple[Node, str]]:
    """The results that it starts from, by letter and name."""
    return [(letters.J_TASK, "Jr"), (letters.D, "D")]
