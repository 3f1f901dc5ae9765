"""Steps of constraints: what is kept at 0, A_c and its rate, the multipliers, the equations without them."""

from __future__ import annotations

from collections.abc import Iterator

from dynsolve.algebra.fraction_matrix import quotient
from dynsolve.algebra.minors import determinant
from dynsolve.algebra.pseudoinverse import adjugate
from dynsolve.algebra.spans import nullspace
from dynsolve.derivation.constraints import holonomic
from dynsolve.derivation.graph import Skipped
from dynsolve.derivation.reduced import Reduced, reduced
from dynsolve.document import Prose
from dynsolve.explain.context import Context
from dynsolve.explain.step import Detail, Line, Step
from dynsolve.explain.task import with_letters
from dynsolve.explain.terms import (
    acting_side,
    driving_side,
    equations_of_motion,
    motors_prose,
    moving_side,
    with_force_letters,
)
from dynsolve.explain.writing import is_small, mls, scalar
from dynsolve.notation.tree import (
    Derivative,
    Negative,
    Node,
    Number,
    Parenthesized,
    Power,
    Product,
    Sum,
    Transpose,
    column,
    equation,
)
from dynsolve.notation.walk import mapped
from dynsolve.quantities import letters
from dynsolve.quantities.stages import Stage

STAGE = Stage.CONSTRAINTS

_A, _A_DOT, _L = letters.A_C, letters.rate(letters.A_C), letters.LAMBDA
_MINUS_ONE = Negative(Number(1))


def steps(context: Context) -> Iterator[Step]:
    """What is kept at 0, the matrix, and where they are asked for its rate and the multipliers."""
    wanted = context.wanted
    if holonomic(context.robot):
        yield _functions(context)
    yield _matrix(context)
    if "Ac_dot" in wanted:
        yield _rate(context)
    if "lambda" in wanted:
        yield _multipliers(context)
    has_multipliers = "lambda" in wanted and not isinstance(context.values["lambda"], Skipped)
    if has_multipliers or "reduced" in wanted:
        yield from _reduced(context)


def _functions(context: Context) -> Step:
    entries = [mapped(one.entry, with_letters) for one in holonomic(context.robot)]
    many = len(entries) > 1
    return Step(
        id="hc",
        stage=STAGE,
        title="What the motion keeps at zero",
        why=("Each entry" if many else "It", " stays 0 in every motion, with the coordinates of the points "
             "from the forward kinematics." if _with_points(context) else " stays 0 in every motion."),
        formula=equation(letters.H_C, column(*entries) if many else entries[0]),
        source=mls("6.1.1"),
        result=(equation(letters.H_C, scalar(context.form("hc"))),),
        detail=Detail.BRIEF,
    )  # fmt: skip


def _with_points(context: Context) -> bool:
    return bool(context.values.rules["hc"].inputs)


def _matrix(context: Context) -> Step:
    rates = any(one.in_rates for one in context.robot.questions.constraints)
    slopes = bool(holonomic(context.robot))
    why: Prose = ()
    if slopes:
        why += ("The functions stay 0, so their rates are 0: a row of partial derivatives each. ",)
    if rates:
        why += ("The constraint on the rates is linear in them: a row of their factors. ",)
    rate = equation(Product((_A, letters.QD)), Number(0))
    formula = equation(_A, Derivative(letters.H_C, letters.Q)) if slopes else rate
    return Step(
        id="Ac",
        stage=STAGE,
        title="The constraint matrix",
        why=(*why, rate, "."),
        formula=formula,
        source=mls("6.1.1"),
        result=(equation(_A, context.form("Ac")),),
        uses=("hc",) if slopes else (),
        detail=Detail.BRIEF,
    )


def _rate(context: Context) -> Step:
    return Step(
        id="Ac_dot",
        stage=STAGE,
        title="Its rate",
        why=("The constraint differentiated once more: ", _kept(), ". Every entry by the chain rule."),
        formula=equation(_A_DOT, letters.time_derivative(_A)),
        source=mls("6.1.2"),
        result=(equation(_A_DOT, context.form("Ac_dot")),),
        detail=Detail.BRIEF,
    )


def _kept() -> Node:
    """A_c q̈ + Ȧ_c q̇ = 0: what the constraints ask of the accelerations."""
    return equation(Sum((Product((_A, letters.QDD)), Product((_A_DOT, letters.QD)))), Number(0))


# -- the multipliers -------------------------------------------------------------------------------


def _multipliers(context: Context) -> Step:
    inverse = Power(letters.D, _MINUS_ONE)
    square = Product((_A, inverse, Transpose(_A)))
    inside = Sum((Product((_A, inverse, Parenthesized(acting_side(context)))), Product((_A_DOT, letters.QD))))
    formula = equation(
        _L, Negative(Product((Power(Parenthesized(square), _MINUS_ONE), Parenthesized(inside))))
    )
    lines = _products(context)
    return Step(
        id="lambda",
        stage=STAGE,
        title="The multipliers",
        why=(
            "The forces of constraint do no work, so they are combinations of the rows of ", _A, ": ",
            equations_of_motion(context),
            ". Put the accelerations that follow into ", _kept(), ", and solve.",
            *motors_prose(context),
        ),
        formula=formula,
        source=mls("6.1.2"),
        lines=lines,
        concluding=("Put in, and cancelled:",) if lines else (),
        result=(equation(_L, mapped(scalar(context.form("lambda")), with_force_letters(context.robot))),),
        detail=Detail.BRIEF,
    )  # fmt: skip


def _products(context: Context) -> tuple[Line, ...]:
    """D⁻¹ as an adjugate over a determinant, and A D⁻¹ Aᵀ, where they can be read."""
    D, A = context.values["D"], context.values["Ac"]
    inverse, scale = adjugate(D), determinant(D)
    if scale.is_zero:
        return ()
    square = quotient(A @ inverse @ A.T, scale)
    shown = scalar(context.forms.of(square))
    over = context.forms.of(quotient(inverse, scale))
    if not is_small(shown, over):
        return ()
    name = Product((_A, Power(letters.D, _MINUS_ONE), Transpose(_A)))
    return (
        Line(("The inverse of ", letters.D, ", its adjugate over its determinant:",),
             (equation(Power(letters.D, _MINUS_ONE), over),)),
        Line(("With it:",), (equation(name, shown),)),
    )  # fmt: skip


def _reduced(context: Context) -> Iterator[Step]:
    """The equations of motion along what the constraints leave free, without the multipliers."""
    values = context.values
    loads = (values["Q"],) if context.robot.questions.loads else ()
    found = reduced(context.robot, values["Ac"], values["tau"], *loads)
    Z = nullspace(values["Ac"]) if isinstance(found, Skipped) else found.free
    if not Z.shape[1]:
        return
    name = letters.bold("Z")
    T = Transpose(name)
    right = driving_side(context, constrained=False)
    if isinstance(right, Sum):
        right = Parenthesized(right)
    shown = context.forms.of(Z)
    if not is_small(shown) and "reduced" not in context.wanted:
        return
    motion = equation(letters.QD, Product((name, letters.bold("nu"))))
    free, rows = equation(name, shown), _free_rows(context, found)
    yield Step(
        id="reduced",
        stage=STAGE,
        title="The equations without the multipliers",
        why=(
            "The columns of ", name, " are the rates that the constraints leave free: ",
            equation(Product((_A, name)), Number(0)), " and ", motion,
            ". Multiplied by ", T, " the equations of motion lose the forces of constraint.",
        ),
        formula=equation(Product((T, Parenthesized(moving_side(context)))), Product((T, right))),
        source=mls("6.1.3"),
        lines=(Line(("The free rates:",), (free,)),) if rows else (),
        concluding=("Row by row:",) if rows else (),
        result=rows or (free,),
        uses=("Ac",),
        is_task="reduced" in context.wanted,
    )  # fmt: skip


def _free_rows(context: Context, found: Reduced | Skipped) -> tuple[Node, ...]:
    """Zᵀ (D q̈ + C q̇ + g) = Zᵀ (τ + Q), row by row; none where they are too long to be read."""
    if isinstance(found, Skipped):
        return ()
    named = with_force_letters(context.robot)
    rows = tuple(
        equation(context.show(left), mapped(context.show(right), named)) for left, right in found.equations
    )
    return rows if "reduced" in context.wanted or is_small(*rows) else ()
