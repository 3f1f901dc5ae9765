"""The step of the rotational kinetic energy of a body."""

from __future__ import annotations

from dataclasses import replace

from dynsolve.document import Prose
from dynsolve.explain.context import Context
from dynsolve.explain.step import STATED, Detail, Line, Part, Step
from dynsolve.explain.working import own_axes, rotational
from dynsolve.explain.writing import is_small, name_of, spong
from dynsolve.notation.tree import Parenthesized, Product, Relation, Transpose, equation
from dynsolve.quantities import letters
from dynsolve.quantities.stages import Stage
from dynsolve.robot.model import Body


def rotational_step(context: Context, body: Body) -> Step:
    """K_ω = ½ ωᵀ 𝓘 ω, along the axes of the base or of the body."""
    b = body.name
    Kw, w = letters.energy_part("omega", body), letters.of_body("omega", body, "bold")
    step = Step(
        id=f"Kw{b}",
        stage=Stage.ENERGY,
        title=f"Rotational kinetic energy of {name_of(body)}",
        source=spong("7.2"),
        normal=STATED,
        result=(equation(Kw, context.form(f"Kw{b}")),),
    )
    if body.is_point:
        none: Prose = ("A point mass has no rotational energy.",)
        return replace(step, why=none, said="point mass", normal=Part.WHY | Part.RESULT)
    half = Product(
        (letters.HALF, letters.transposed_product(w, letters.base_tensor(letters.index_of(body.name))))
    )
    why: Prose = (w, f" and the tensor, both in {context.ground} coordinates.")
    step = replace(step, why=why, hint=why, formula=equation(Kw, half))
    if context.values[f"w{b}"].is_zero:
        return replace(step, why=("The body does not turn.",), normal=STATED | Part.WHY)
    product, way = rotational.multiplied_out(context, body)
    step = replace(step, working=(product,) if is_small(product) else (), lines=way.lines)
    step = replace(step, concluding=way.concluding)
    return _turned(context, body, step) if rotational.along_own_axes(context, body) else step


def _turned(context: Context, body: Body, step: Step) -> Step:
    """K_ω along the axes of the body: ω is brought there, and the tensor is the given one."""
    b, w = body.name, letters.of_body("omega", body, "bold")
    R, tensor = letters.of_body("R", body, "bold"), letters.tensor(context.robot, body)
    own = own_axes.turned(context, body, "w", w)
    half = Product((letters.HALF, Transpose(Parenthesized(own.name)), tensor, Parenthesized(own.name)))
    assert isinstance(step.formula, Relation)
    why: Prose = (
        equation(letters.base_tensor(letters.index_of(body.name)), Product((R, tensor, Transpose(R)))),
        f" is the tensor along the axes of the {context.ground}. Along the body's own axes it is ",
        tensor,
        ", and the angular velocity is ",
        own.name,
        ".",
    )
    put_in = Line(("The tensor along the body's own axes put in:",), step.working, (f"I_body{b}",))
    return replace(
        step,
        why=why,
        formula=equation(*step.formula.parts, half),
        working=(),
        lines=(
            *own.lines,
            *(replace(line, detail=Detail.FULL) for line in (put_in, *step.lines) if line.formulas),
        ),
        normal=STATED | Part.WHY | Part.LINES,
        said="own axes",
        uses=(f"v{b}", own.uses),
    )
