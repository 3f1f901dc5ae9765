"""Steps of constraints: what is kept at 0, A_c and its rate, the multipliers, the equations without them.

And of forward dynamics: the accelerations that forces make, and the inertia Λ that a force at the task meets.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from msgspec.structs import replace

from dynsolve.algebra.linear_systems import adjugate, quotient
from dynsolve.algebra.lowest_terms import zero_of_all
from dynsolve.algebra.matrix import Matrix, determinant, minors
from dynsolve.algebra.ring import Expr
from dynsolve.algebra.spaces import dependent_where, nullspace
from dynsolve.derivation.allowed import NOT_SHOWN
from dynsolve.derivation.graph import Skipped
from dynsolve.derivation.link_frame import velocities
from dynsolve.document import Prose
from dynsolve.document.books import mls
from dynsolve.document.sentences import say
from dynsolve.explain.context import Context
from dynsolve.explain.forms import Forms
from dynsolve.explain.sanity.determinant import sign_of
from dynsolve.explain.step import NOTED, Detail, Line, Step, not_derived
from dynsolve.explain.terms import (
    acting_side,
    driving_side,
    equations_of_motion,
    motors_prose,
    moving_side,
    with_force_letters,
)
from dynsolve.explain.writing import is_small, listed, scalar
from dynsolve.notation.template import formula
from dynsolve.notation.tree import (
    ONE,
    ZERO,
    Node,
    Number,
    Parenthesized,
    Sum,
    Symbol,
    column,
    equation,
    mapped,
)
from dynsolve.quantities import letters
from dynsolve.questions.constraints.closed import Closed, closed
from dynsolve.questions.constraints.derive import bordered, holonomic
from dynsolve.questions.forward_dynamics.derive import Reduced, acting_names
from dynsolve.questions.forward_dynamics.explain import (
    and_cancelled,
    as_far_as_read,
    inverse_of_inertia,
    is_not_derived,
    is_too_large,
)
from dynsolve.questions.independent_rows import where_independent
from dynsolve.questions.set_forms import SetForms, without_number
from dynsolve.questions.task.explain import with_letters

_KEPT = formula("𝐀_c 𝐪̈ + 𝐀̇_c 𝐪̇ = 𝟎")
"""What the constraints ask of the accelerations."""

_ZERO = formula("𝟎")


def given(forms: Forms) -> Iterator[Prose]:
    """What every motion keeps."""
    constraints = forms.robot.questions.constraints
    if kept := [equation(mapped(one.entry, with_letters), ZERO) for one in constraints]:
        yield ("Every motion keeps ", *listed(kept), ".")


def steps(context: Context) -> Iterator[Step]:
    """What is kept at 0, the matrix, and where they are asked for its rate and the multipliers."""
    wanted = context.wanted
    if holonomic(context.robot):
        yield _functions(context)
    yield _matrix(context)
    if "Ac_dot" in wanted:
        yield Step(
            id="Ac_dot",
            title="Its rate",
            why=say("$𝐀_c 𝐪̇ = 𝟎$ differentiated: {kept}. Every entry by the chain rule.", kept=_KEPT),
            formula=formula("𝐀̇_c = d/dt 𝐀_c"),
            source=mls("6.1.2"),
            result=(formula("𝐀̇_c = {rate}", rate=context.form("Ac_dot")),),
            detail=Detail.BRIEF,
        )
    found = context.values["lambda"] if "lambda" in wanted else None
    if found is not None and is_not_derived(found):
        yield not_derived("lambda", "The multipliers", found.why)
    elif found is not None:
        yield _multipliers(context)
    if "reduced" in wanted:
        yield from _reduced(context)


def _functions(context: Context) -> Step:
    entries = [mapped(one.entry, with_letters) for one in holonomic(context.robot)]
    many = len(entries) > 1
    has_points = bool(context.values.rules["hc"].inputs)
    return Step(
        id="hc",
        title="What the motion keeps at zero",
        why=say(
            "{each} stays 0 in every motion{points}.",
            each=say("Each entry of {h}", h=letters.H_C) if many else letters.H_C,
            points=", with the coordinates of the points from the forward kinematics" if has_points else "",
        ),
        formula=equation(letters.H_C, column(*entries) if many else entries[0]) if has_points else None,
        source=mls("6.1.1"),
        result=(equation(letters.H_C, scalar(context.form("hc"))),),
        detail=Detail.BRIEF,
    )


def _matrix(context: Context) -> Step:
    slopes = bool(holonomic(context.robot))
    of_functions = "The functions stay 0, so their rates are 0: a row of partial derivatives each. "
    if len(holonomic(context.robot)) == 1:
        of_functions = "The function stays 0, so its rate is 0: a row of partial derivatives. "
    of_rates = "The constraint on the rates is linear in them: a row of their factors. "
    of_several = "The constraints on the rates are linear in them: a row of their factors each. "
    has_rates = sum(one.in_rates for one in context.robot.questions.constraints)
    of_rates = of_several if has_rates > 1 else of_rates * has_rates
    return Step(
        id="Ac",
        title="The constraint matrix",
        why=say(f"{of_functions * slopes}{of_rates}{'' if has_rates else '$𝐀_c 𝐪̇ = 𝟎$.'}"),
        formula=formula("𝐀_c 𝐪̇ = 𝟎" if has_rates else "𝐀_c = ∂𝐡/∂𝐪"),
        source=mls("6.1.1"),
        result=(equation(letters.A_C, context.form("Ac")),),
        uses=("hc",) if slopes else (),
        detail=Detail.BRIEF,
    )


def _multipliers(context: Context) -> Step:
    acting = acting_side(context)
    found = context.values["lambda"]
    is_regular = is_too_large(found) or not determinant(context.values["D"]).is_zero
    lines = tuple(_rates(context))
    if not is_too_large(found):
        lines = (*lines, *(_products(context) if is_regular else _both(context)))
    value = mapped(scalar(context.form("lambda")), with_force_letters(context.robot))
    equations = equations_of_motion(context)
    solved = say(
        "That gives the accelerations, {accelerations}; put into {kept} they give {put_in}, which is solved "
        "for $𝛌$.",
        accelerations=formula("𝐪̈ = 𝐃⁻¹ ({acting} + 𝐀_cᵀ 𝛌)", acting=acting),
        kept=_KEPT,
        put_in=formula("𝐀_c 𝐃⁻¹ 𝐀_cᵀ 𝛌 + 𝐀_c 𝐃⁻¹ {acting} + 𝐀̇_c 𝐪̇ = 𝟎", acting=acting),
    )
    explicit = formula("𝛌 = -(𝐀_c 𝐃⁻¹ 𝐀_cᵀ)⁻¹ (𝐀_c 𝐃⁻¹ {acting} + 𝐀̇_c 𝐪̇)", acting=acting)
    together = formula("[𝐃, -𝐀_cᵀ; 𝐀_c, 𝟎] [𝐪̈; 𝛌] = [{acting}; -𝐀̇_c 𝐪̇]", acting=acting)
    concluding = f"Put in{and_cancelled(found)}:"
    if not is_regular:
        concluding = "Solved for the multipliers:"
    if not is_regular and not sign_of(context, _determinant_of_both(context)):
        concluding = "Solved for the multipliers, where the determinant of the matrix is not 0:"
    if not is_regular:
        solved = say(
            "$𝐃$ has no inverse: its determinant is 0. So these equations and {kept} are solved together.",
            kept=_KEPT,
        )
    where = where_independent(context, context.values["Ac"], letters.A_C)
    determined = (
        say(
            "{they} determined {where}.",
            they="They are" if len(context.values["Ac"].rows) > 1 else "It is",
            where=where,
        )
        if where
        else ()
    )
    step = Step(
        id="lambda",
        title="The multipliers",
        why=say(
            "The forces of constraint do no work, so they are combinations of the rows of $𝐀_c$: "
            "{equations}. {solved}{motors}",
            equations=equations,
            solved=solved,
            motors=motors_prose(context),
        ),
        formula=explicit if is_regular else together,
        source=mls("6.1.2"),
        lines=lines,
        concluding=(concluding,) if lines else (),
        result=(equation(letters.LAMBDA, value),),
        notes=(determined,) if determined else (),
        holds=determined,
        detail=Detail.BRIEF,
        normal=NOTED,
    )
    return as_far_as_read(step, found)


def _both(context: Context) -> Iterator[Line]:
    """The determinant of the matrix of both systems, where it can be read."""
    shown = SetForms(context.robot, context.values).product(_determinant_of_both(context))
    if is_small(shown):
        yield Line(
            ("The determinant of the matrix:",), (formula("det [𝐃, -𝐀_cᵀ; 𝐀_c, 𝟎] = {shown}", shown=shown),)
        )


def _determinant_of_both(context: Context) -> Expr:
    return determinant(bordered(context.values["Ac"], context.values["D"]))


def _rates(context: Context) -> Iterator[Line]:
    """C q̇ and the rate of the constraint along q̇, where they can be read."""
    rate = context.values["Ac_dot"] @ velocities(context.robot)
    turned = context.values["Cqd"]
    along = _ZERO if rate.is_zero else context.show(rate)
    is_told = not turned.is_zero and is_small(context.forms("Cqd"))
    nodes = [formula("𝐂 𝐪̇ = {turned}", turned=context.forms("Cqd"))] if is_told else []
    nodes += [formula("𝐀̇_c 𝐪̇ = {along}", along=scalar(along))] if is_small(along) else []
    if nodes:
        yield Line(("The terms of the rates:",), tuple(nodes), is_kept=True)


def _products(context: Context) -> tuple[Line, ...]:
    """D⁻¹ and A D⁻¹ Aᵀ, where they can be read."""
    D, A = context.values["D"], context.values["Ac"]
    inverse = inverse_of_inertia(context)
    square = scalar(context.forms.of(quotient(A @ adjugate(D) @ A.T, determinant(D)))) if inverse else _KEPT
    if not inverse or not is_small(square):
        return ()
    return (
        *inverse,
        Line(("With it:",), (formula("𝐀_c 𝐃⁻¹ 𝐀_cᵀ = {square}", square=square),), is_kept=True),
    )


def _reduced(context: Context) -> Iterator[Step]:
    """The equations of motion along what the constraints leave free, without the multipliers."""
    found, title = context.values["reduced"], "The equations without the multipliers"
    if isinstance(found, Skipped) and found.why == NOT_SHOWN:
        yield not_derived("reduced", title, found.why)
        return
    Z = nullspace(context.values["Ac"]) if isinstance(found, Skipped) else found.free
    if not Z.shape[1]:
        return
    right = driving_side(context, constrained=False)
    whole = formula(
        "𝐙ᵀ {moving} = 𝐙ᵀ {right}",
        moving=moving_side(context),
        right=Parenthesized(right) if isinstance(right, Sum) else right,
    )
    equations = () if isinstance(found, Skipped) else found.equations
    free, rows = formula("𝐙 = {shown}", shown=context.show(Z)), _free_rows(context, equations)
    led = "Row by row" if len(rows) > 1 else "Multiplied out"
    zeros = [equation(without_number(context.show(zero)), Number(0)) for zero in found.zeros] if rows else []
    step = Step(
        id="reduced",
        title=title,
        why=say(
            "The columns of $𝐙$ are the rates that the constraints leave free: $𝐀_c 𝐙 = 𝟎$. "
            "Multiplied by $𝐙ᵀ$ the equations of motion lose the forces of constraint. {more}",
            more=_freer(context, Z) if rows else "Multiplied out they are too long to be read.",
        ),
        formula=whole if rows else None,
        source=mls("6.1.3"),
        lines=(Line(("The free rates:",), (free,), is_kept=True),) if rows else (),
        concluding=say(
            "{led}{zeros}{divided}:",
            led=led,
            zeros=say(", with {zeros}", zeros=listed(zeros)) if zeros else "",
            divided=", divided by what both sides share" * found.is_divided,
        )
        if rows
        else (),
        result=rows or (whole, free),
        uses=("Ac", "D", *acting_names(context.robot)),
    )
    A = context.values["Ac"]
    short = closed(context.robot, A, found) if isinstance(found, Reduced) else None
    if short is not None:
        step = _in_free_accelerations(context, step, short)
    elif rows and len(rows) + len(A.rows) == context.robot.n:
        told = "With {kept} these are as many equations as there are accelerations."
        step = replace(step, notes=(say(told, kept=_KEPT),))
    yield step


def _in_free_accelerations(context: Context, step: Step, found: Closed) -> Step:
    """The same step, going on to the equations in which what the constraints give is put in."""
    coordinates = context.robot.coordinates
    given = [
        equation(Symbol(coordinates[k].name, dots), context.show(value))
        for dots, values in ((1, found.rates), (2, found.accelerations))
        for k, value in values
    ]
    told = say("$𝐀_c 𝐪̇ = 𝟎$ and, differentiated, $𝐀_c 𝐪̈ + 𝐀̇_c 𝐪̇ = 𝟎$ give:")
    return replace(
        step,
        lines=(*step.lines, Line(step.concluding, step.result, is_kept=True), Line(told, tuple(given))),
        concluding=("Put in:",),
        result=_free_rows(context, found.equations),
    )


def _freer(context: Context, Z: Matrix) -> Prose:
    """Where the columns of Z, or the rows of A_c, are dependent: where more is free than these columns."""
    A, free = context.values["Ac"], Z.shape[1]
    lost = dependent_where(Z), zero_of_all(list(minors(A, A.shape[1] - free)))
    forms = SetForms(context.robot, context.values)
    where = [shown for value in lost if value is not None and (shown := forms.vanishing(value)) != ONE]
    zeros = [equation(one, ZERO) for one in dict.fromkeys(where)]
    text = "Where {zeros}, more is free than the columns of $𝐙$ span, and the equations are too few."
    return say(text, zeros=listed(zeros, "or")) if zeros else ()


def _free_rows(context: Context, equations: Iterable[tuple[Expr, Expr]]) -> tuple[Node, ...]:
    """Zᵀ (D q̈ + C q̇ + g) = Zᵀ (τ + Q), row by row."""
    named = with_force_letters(context.robot)
    return tuple(
        equation(context.show(left), mapped(context.show(right), named)) for left, right in equations
    )


# -- hints -----------------------------------------------------------------------------------------

AT_HAND = "You have the forward kinematics, and the matrices of the model:"

PITFALLS = """
    The matrix moves: the constraint, differentiated twice, has a term with its rate, too.
    Neither the coordinates nor the rates are free: results may be written otherwise with the constraint
        put in.
"""


def inputs(context: Context) -> list[tuple[Node, str]]:
    """The results that it starts from, by letter and name."""
    last = context.robot.joints[-1:]
    frames = [(letters.H(context.robot, joint.index), f"H{joint.index}") for joint in last]
    matrices = [(letters.D, "D"), (letters.C, "C"), (letters.G, "g")]
    return [*frames, *([] if context.wanted.isdisjoint(("lambda", "reduced")) else matrices)]
