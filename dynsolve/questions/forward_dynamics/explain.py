"""The step of the accelerations that given forces make."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from msgspec.structs import replace

from dynsolve.algebra.linear_systems import FractionMatrix, adjugate, fraction_of, inverse_times, is_diagonal
from dynsolve.algebra.lowest_terms import is_decided
from dynsolve.algebra.matrix import Matrix, determinant
from dynsolve.derivation.graph import Skipped
from dynsolve.document import Prose
from dynsolve.document.books import LYNCH_PARK, mls
from dynsolve.document.sentences import say
from dynsolve.explain.context import Context
from dynsolve.explain.step import NOTED, Detail, Line, Step, not_derived
from dynsolve.explain.terms import (
    acting_side,
    equations_of_motion,
    motors_prose,
    with_force_letters,
)
from dynsolve.explain.writing import is_small, scalar
from dynsolve.notation.template import formula
from dynsolve.notation.tree import Node, Number, Quotient, Symbol, equation, mapped
from dynsolve.quantities import letters
from dynsolve.questions.forward_dynamics.derive import TOO_LARGE, acting_names
from dynsolve.questions.forward_dynamics.named import OfEntries, named
from dynsolve.questions.independent_rows import where_independent

LETTERS = "* b_i | what acts on coordinate i beside its inertia | {force}"
"""The line of its letter in the list of notation."""


def steps(context: Context) -> Iterator[Step]:
    """q̈ from the forces, where it is asked for."""
    if "qdd_forward" not in context.wanted:
        return
    value = context.values["qdd_forward"]
    if is_not_derived(value):
        yield not_derived("qdd_forward", "The accelerations", value.why)
        return
    if context.robot.questions.constraints:
        yield as_far_as_read(_constrained(context, value), value)
        return
    step = Step(
        id="qdd_forward",
        title="The accelerations that the forces make",
        why=say(
            "The equations of motion, {equations}, are linear in the accelerations; $𝐃$ has an inverse "
            "where its determinant is not 0.{motors}",
            equations=equations_of_motion(context),
            motors=motors_prose(context),
        ),
        formula=formula("𝐪̈ = 𝐃⁻¹ {acting}", acting=acting_side(context)),
        source=LYNCH_PARK.section("8.5"),
        detail=Detail.BRIEF,
        **_result(context),
    )
    if found := named(context):
        yield replace(
            step,
            lines=found.lines,
            concluding=("Put in:",),
            result=(equation(letters.QDD, found.shown),),
            defines=(*found.entries, *found.meanings),
        )
        return
    lines = () if is_too_large(value) else inverse_of_inertia(context)
    cancelled = "" if is_diagonal(context.values["D"]) else and_cancelled(value)
    step = replace(step, lines=lines, concluding=(f"Multiplied out{cancelled}:",) if lines else ())
    yield as_far_as_read(step, value)


def _result(context: Context) -> dict[str, Any]:
    """The accelerations, and the letters of their entries."""
    accelerations = tuple((Symbol(q.name, 2),) for q in context.robot.coordinates)
    shown = mapped(context.form("qdd_forward"), with_force_letters(context.robot))
    letter = accelerations[0][0] if len(accelerations) == 1 else letters.QDD
    return {"result": (equation(letter, scalar(shown)),), "entries": accelerations}


def _constrained(context: Context, value: Matrix | FractionMatrix | Skipped) -> Step:
    """With the multipliers where these are told, else together with them."""
    found, acting = context.values["lambda"] if "lambda" in context.wanted else None, acting_side(context)
    is_known = found is not None and not isinstance(found, Skipped)
    is_known = is_known and not determinant(context.values["D"]).is_zero
    together = formula("[𝐃, -𝐀_cᵀ; 𝐀_c, 𝟎] [𝐪̈; 𝛌] = [{acting}; -𝐀̇_c 𝐪̇]", acting=acting)
    where = where_independent(context, context.values["Ac"], letters.A_C)
    exists: Prose = say("This is so {where}.", where=where) if where and and_cancelled(value) else ()
    return Step(
        id="qdd_forward",
        title="The accelerations that the forces make",
        why=say(
            "The equations of motion, {equations}, and $𝐀_c 𝐪̈ + 𝐀̇_c 𝐪̇ = 𝟎$ are linear in the accelerations "
            "and the multipliers.{known}{motors}",
            equations=equations_of_motion(context),
            known=say(" $𝛌$ is known, and is put into the first.") if is_known else "",
            motors=motors_prose(context),
        ),
        formula=formula("𝐪̈ = 𝐃⁻¹ ({acting} + 𝐀_cᵀ 𝛌)", acting=acting) if is_known else together,
        source=mls("6.1.2"),
        concluding=(
            f"Multiplied out{and_cancelled(value)}:" if is_known else "Solved for the accelerations:",
        ),
        notes=(exists,) if exists else (),
        holds=exists,
        uses=("lambda", "D") if is_known else ("Ac", "Ac_dot", "D", *acting_names(context.robot)),
        detail=Detail.BRIEF,
        normal=NOTED,
        **_result(context),
    )


def is_not_derived(value: Matrix | FractionMatrix | Skipped) -> bool:
    """Whether there is no result, and not one that is too long to be read."""
    return isinstance(value, Skipped) and value.why != TOO_LARGE


def is_too_large(value: Matrix | FractionMatrix | Skipped) -> bool:
    """Whether a result was not even multiplied out."""
    return isinstance(value, Skipped) and value.value is None


def as_far_as_read(step: Step, value: Matrix | FractionMatrix | Skipped) -> Step:
    """A step that stops at its formula where its result is too long to be read."""
    if not isinstance(value, Skipped):
        return step
    told = "Multiplied out this is too long to be read."
    return replace(step, why=(*step.why, " ", told), concluding=(), result=(), entries=(), outcome=(told,))


def and_cancelled(value: Matrix | FractionMatrix | Skipped) -> str:
    """That nothing is left above and below, where that is known."""
    if isinstance(value, Skipped):
        return ""
    entries = [fraction_of(entry) for entry in value.entries]
    fractions = [(one.numerator, one.divisor) for one in entries if one.divisor is not None]
    return ", and cancelled" * all(is_decided(above, below) for above, below in fractions)


def inverse_of_inertia(context: Context) -> tuple[Line, ...]:
    """D⁻¹, as a line, where it can be read."""
    D = context.values["D"]
    inverse = inverse_times(D, Matrix.identity(D.ring, len(D.rows)))
    if inverse is None:
        return ()
    told = "The inverse of $𝐃$, its adjugate over its determinant:"
    size = determinant(D)
    if is_diagonal(D):
        told = "$𝐃$ is diagonal; its inverse has the reciprocals:"
    elif len(size) > 1 and all(len(fraction_of(entry).denominator) == len(size) for entry in inverse.entries):
        adjoint, value = context.show(adjugate(D)), context.show(size)
        over = Quotient(Number(1), letters.DET_D)
        parts = (
            formula("𝐃⁻¹ = {over} {adjoint}", over=over, adjoint=adjoint),
            equation(letters.DET_D, value),
        )
        return (Line(say(told), parts, is_kept=True),) if is_small(adjoint, value) else _in_entries(D)
    shown = context.forms.of(inverse)
    if is_small(shown):
        return (Line(say(told), (formula("𝐃⁻¹ = {shown}", shown=shown),), is_kept=True),)
    return _in_entries(D)


def _in_entries(D: Matrix) -> tuple[Line, ...]:
    """D⁻¹ by the entries of D, where these are too long to be put in."""
    of = OfEntries(D, range(len(D.rows)))
    over = Quotient(Number(1), letters.DET_D)
    parts = (
        formula("𝐃⁻¹ = {over} {adjoint}", over=over, adjoint=of.adjugate),
        equation(letters.DET_D, of.determinant),
    )
    told = "The inverse of $𝐃$, its adjugate over its determinant, in the entries of $𝐃$:"
    return (Line(say(told), parts, is_kept=True),) if is_small(of.adjugate, of.determinant) else ()


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
