"""Steps of constraints: what is kept at 0, A_c and its rate, the multipliers, the equations without them.

And of forward dynamics: the accelerations that forces make, and the inertia Λ that a force at the task meets.
"""

from __future__ import annotations

from collections.abc import Iterator

from dynsolve.algebra.linear_systems import adjugate, nullspace, quotient
from dynsolve.algebra.matrix import determinant
from dynsolve.derivation.graph import Skipped
from dynsolve.derivation.link_frame import velocities
from dynsolve.document.sentences import say
from dynsolve.explain.context import Context
from dynsolve.explain.step import Detail, Line, Step, not_derived
from dynsolve.explain.terms import (
    acting_side,
    driving_side,
    equations_of_motion,
    motors_prose,
    moving_side,
    with_force_letters,
)
from dynsolve.explain.writing import is_small, mls, scalar
from dynsolve.notation.template import formula
from dynsolve.notation.tree import Node, Parenthesized, Sum, column, equation, mapped
from dynsolve.quantities import letters
from dynsolve.questions.constraints.derive import holonomic
from dynsolve.questions.forward_dynamics.derive import Reduced, outside_names, reduced
from dynsolve.questions.forward_dynamics.explain import inverse_of_inertia
from dynsolve.questions.task.explain import with_letters

_KEPT = formula("𝐀_c 𝐪̈ + 𝐀̇_c 𝐪̇ = 𝟎")
"""What the constraints ask of the accelerations."""


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
            why=say(
                "The constraint differentiated once more: {kept}. Every entry by the chain rule.", kept=_KEPT
            ),
            formula=formula("𝐀̇_c = d/dt 𝐀_c"),
            source=mls("6.1.2"),
            result=(formula("𝐀̇_c = {rate}", rate=context.form("Ac_dot")),),
            detail=Detail.BRIEF,
        )
    found = context.values["lambda"] if "lambda" in wanted else None
    has_multipliers = found is not None and not isinstance(found, Skipped)
    if isinstance(found, Skipped):
        yield not_derived("lambda", "The multipliers", found.why)
    elif has_multipliers:
        yield _multipliers(context)
    if has_multipliers or "reduced" in wanted:
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
            each="Each entry" if many else "It",
            points=", with the coordinates of the points from the forward kinematics" if has_points else "",
        ),
        formula=equation(letters.H_C, column(*entries) if many else entries[0]),
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
        why=say(f"{of_functions * slopes}{of_rates}$𝐀_c 𝐪̇ = 𝟎$."),
        formula=formula("𝐀_c = ∂𝐡/∂𝐪" if slopes and not has_rates else "𝐀_c 𝐪̇ = 𝟎"),
        source=mls("6.1.1"),
        result=(equation(letters.A_C, context.form("Ac")),),
        uses=("hc",) if slopes else (),
        detail=Detail.BRIEF,
    )


def _multipliers(context: Context) -> Step:
    lines = (*_rates(context), *_products(context))
    acting = acting_side(context)
    value = mapped(scalar(context.form("lambda")), with_force_letters(context.robot))
    return Step(
        id="lambda",
        title="The multipliers",
        why=say(
            "The forces of constraint do no work, so they are combinations of the rows of $𝐀_c$: "
            "{equations}. That gives the accelerations, {accelerations}; put into {kept} they give {put_in}, "
            "which is solved for $𝛌$.{motors}",
            equations=equations_of_motion(context),
            accelerations=formula("𝐪̈ = 𝐃⁻¹ ({acting} + 𝐀_cᵀ 𝛌)", acting=acting),
            kept=_KEPT,
            put_in=formula("𝐀_c 𝐃⁻¹ 𝐀_cᵀ 𝛌 + 𝐀_c 𝐃⁻¹ ({acting}) + 𝐀̇_c 𝐪̇ = 𝟎", acting=acting),
            motors=motors_prose(context),
        ),
        formula=formula("𝛌 = -(𝐀_c 𝐃⁻¹ 𝐀_cᵀ)⁻¹ (𝐀_c 𝐃⁻¹ ({acting}) + 𝐀̇_c 𝐪̇)", acting=acting),
        source=mls("6.1.2"),
        lines=lines,
        concluding=("Put in, and cancelled:",) if lines else (),
        result=(equation(letters.LAMBDA, value),),
        detail=Detail.BRIEF,
    )


def _rates(context: Context) -> Iterator[Line]:
    """C q̇ and the rate of the constraint along q̇, where they can be read."""
    values = context.values
    turned = context.forms("Cqd")
    along = context.show(values["Ac_dot"] @ velocities(context.robot))
    nodes = [formula("𝐂 𝐪̇ = {turned}", turned=turned)] if is_small(turned) else []
    nodes += [formula("𝐀̇_c 𝐪̇ = {along}", along=scalar(along))] if is_small(along) else []
    if nodes:
        yield Line(("The terms of the rates:",), tuple(nodes), is_kept=True)


def _products(context: Context) -> tuple[Line, ...]:
    """D⁻¹ as an adjugate over a determinant, and A D⁻¹ Aᵀ, where they can be read."""
    D, A = context.values["D"], context.values["Ac"]
    inverse, scale = adjugate(D), determinant(D)
    if scale.is_zero:
        return ()
    square = scalar(context.forms.of(quotient(A @ inverse @ A.T, scale)))
    over = context.forms.of(quotient(inverse, scale))
    if is_small(square, over):
        return (
            inverse_of_inertia(over),
            Line(("With it:",), (formula("𝐀_c 𝐃⁻¹ 𝐀_cᵀ = {square}", square=square),), is_kept=True),
        )
    parts = context.show(inverse), context.show(scale), scalar(context.show(A @ inverse @ A.T))
    if not all(map(is_small, parts)):
        return ()
    adjoint, size, square = parts
    return (
        Line(
            say("The inverse of $𝐃$ is its adjugate over its determinant:"),
            (formula("adj 𝐃 = {adjoint}", adjoint=adjoint), formula("det 𝐃 = {size}", size=size)),
            is_kept=True,
        ),
        Line(("With them:",), (formula("𝐀_c adj 𝐃 𝐀_cᵀ = {square}", square=square),), is_kept=True),
    )


def _reduced(context: Context) -> Iterator[Step]:
    """The equations of motion along what the constraints leave free, without the multipliers."""
    values, is_asked = context.values, "reduced" in context.wanted
    loads = (values[name] for name in outside_names(context.robot))
    found = reduced(context.robot, values["Ac"], values["tau"], *loads)
    Z = nullspace(values["Ac"]) if isinstance(found, Skipped) else found.free
    shown = context.forms.of(Z)
    if not Z.shape[1] or not (is_small(shown) or is_asked):
        return
    right = driving_side(context, constrained=False)
    free, rows = formula("𝐙 = {shown}", shown=shown), _free_rows(context, found)
    yield Step(
        id="reduced",
        title="The equations without the multipliers",
        why=say(
            "The columns of $𝐙$ are the rates that the constraints leave free: $𝐀_c 𝐙 = 𝟎$. "
            "Multiplied by $𝐙ᵀ$ the equations of motion lose the forces of constraint."
        ),
        formula=formula(
            "𝐙ᵀ ({moving}) = 𝐙ᵀ {right}",
            moving=moving_side(context),
            right=Parenthesized(right) if isinstance(right, Sum) else right,
        ),
        source=mls("6.1.3"),
        lines=(Line(("The free rates:",), (free,)),) if rows else (),
        concluding=("Row by row:" if len(rows) > 1 else "Multiplied out:",) if rows else (),
        result=rows or (free,),
        uses=("Ac",),
        is_task=is_asked,
    )


def _free_rows(context: Context, found: Reduced | Skipped) -> tuple[Node, ...]:
    """Zᵀ (D q̈ + C q̇ + g) = Zᵀ (τ + Q), row by row; none where they are too long to be read."""
    if isinstance(found, Skipped):
        return ()
    named = with_force_letters(context.robot)
    rows = tuple(
        equation(context.show(left), mapped(context.show(right), named)) for left, right in found.equations
    )
    return rows if "reduced" in context.wanted or is_small(*rows) else ()


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
