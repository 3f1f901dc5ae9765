"""A coordinate that does not appear in L: its momentum is conserved (Goldstein, Classical Mechanics, 2.6)."""

from __future__ import annotations

from dynsolve.document import Prose
from dynsolve.explain.closing import driving_row
from dynsolve.explain.context import Context
from dynsolve.explain.step import Step
from dynsolve.explain.writing import listed, spong, sum_of
from dynsolve.notation.build import cost
from dynsolve.notation.tree import Node, Number, Product, Symbol, equation
from dynsolve.quantities import letters
from dynsolve.quantities.stages import Stage
from dynsolve.robot.model import Coordinate

LONGEST = 30
"""The operations up to which a momentum is written again."""


def _written(context: Context, q: Coordinate) -> Node:
    """A momentum: its formula, or the entries of D times the rates where that is long."""
    form = context.form(f"dLdqd{q.index}")
    if cost(form) <= LONGEST:
        return form
    row, k = context.values["D"].rows[q.index - 1], q.index
    coupled = [other for other in context.robot.coordinates if not row[other.index - 1].is_zero]
    return sum_of([Product((letters.entry("d", k, j.index), letters.velocity(j))) for j in coupled])


def cyclic_step(context: Context) -> Step | None:
    """The momenta that stay constant as long as nothing acts on them."""
    values = context.values
    free = [
        q
        for q in context.robot.coordinates
        if values[f"dLdq{q.index}"].is_zero
        and ("friction" not in values.rules or values["friction"][q.index - 1, 0].is_zero)
    ]
    if not free:
        return None
    one = len(free) == 1
    momenta = [letters.partial_derivative(letters.L, letters.velocity(q)) for q in free]
    why: Prose = (*listed([Symbol(q.name) for q in free]), f" {'does' if one else 'do'} not appear in ")
    why += (letters.L, f": {'a cyclic coordinate' if one else 'cyclic coordinates'}. As long as ")
    why += (
        *listed([equation(driving_row(context, q), Number(0)) for q in free]),
        ", the Euler-Lagrange equation",
    )
    why += (" says" if one else "s say",)
    why += (f" that the {'momentum' if one else 'momenta'} ", *listed(momenta))
    why += (" is conserved." if one else " are conserved.",)
    shown = (equation(p, _written(context, q)) for p, q in zip(momenta, free, strict=True))
    return Step(
        id="cyclic",
        stage=Stage.VECTORIZED,
        title="Check: what is conserved",
        why=why,
        source=spong("7.1"),
        result=tuple(shown),
        is_task=False,
    )
