"""The lines from ½ ωᵀ 𝓘 ω to the kinetic energy of rotation, along the axes in which they are short.

𝓘 = R I Rᵀ is the tensor along the axes of the base.  Where it varies with the configuration, ω is
brought to the body's own axes instead (`own_axes`), along which the tensor is the constant one that is given:
ωᵀ 𝓘 ω = (Rᵀ ω)ᵀ I (Rᵀ ω), and in the same way J_ωᵀ 𝓘 J_ω.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from dynsolve.algebra.expr import Expr
from dynsolve.algebra.matrix import Matrix
from dynsolve.explain.context import Context
from dynsolve.explain.forms import is_numeric
from dynsolve.explain.working.identities import identities, said
from dynsolve.explain.working.kinetic import collected, without_signs
from dynsolve.explain.working.proved import SILENT, Way, chain
from dynsolve.explain.writing import sum_of
from dynsolve.notation.build import number_in_front, times
from dynsolve.notation.tree import Node, Product, equation
from dynsolve.quantities import letters
from dynsolve.robot.model import Body


def along_own_axes(context: Context, body: Body) -> bool:
    """Whether the energy of a body is worked out along its own axes, without 𝓘; not of long arms.

    All bodies of an arm are treated alike: along their own axes, if that is the shorter way for one.
    Where the moments about all axes are equal, 𝓘 is known without any rotation.
    """
    if not context.is_short or not _is_turned(context, body):
        return False
    return any(_is_shorter(context, each) for each in context.robot.bodies if _is_turned(context, each))


def _is_turned(context: Context, body: Body) -> bool:
    """Whether a body turns, and the moments about its axes are not all equal."""
    if body.is_point or context.values[f"w{body.name}"].is_zero:
        return False
    return factor_of_identity(context.values[f"I_body{body.name}"]) is None


def factor_of_identity(tensor: Matrix) -> Expr | None:
    """a where a tensor is a E, the same about every axis; None for others."""
    a = tensor[0, 0]
    return a if tensor == Matrix.identity(a.ring, 3).scale(a) else None


def _is_shorter(context: Context, body: Body) -> bool:
    """Whether the tensor along the axes of the base takes longer than the given one, or varies."""
    values, b = context.values, body.name
    tensor, w = values[f"I{b}"], values[f"w{b}"]
    own = values[f"R{b}"].T @ w
    is_short = _terms_needed(w, tensor) <= _terms_needed(own, values[f"I_body{b}"])
    return not (is_short and _is_constant(context, tensor))


def _terms_needed(w: Matrix, tensor: Matrix) -> int:
    """The terms that wᵀ I w is made of: of the tensor, the entries that meet rows of w that are not zero."""
    turning = [k for k, row in enumerate(w.rows) if any(not entry.is_zero for entry in row)]
    met = sum(len(tensor[i, j]) for i in turning for j in turning)
    return met + sum(len(entry) for k in turning for entry in w.rows[k])


def _is_constant(context: Context, tensor: Matrix) -> bool:
    """Whether a tensor is the same in every configuration."""
    ring, count = context.robot.ring, context.robot.n
    return all(ring.diff(entry, k).is_zero for entry in tensor.entries for k in range(count))


def multiplied_out(context: Context, body: Body) -> tuple[Node, Way]:
    """K_ω = ½ [row] [tensor] [column] along the axes that are chosen, and the lines from there."""
    values, b = context.values, body.name
    base = values[f"w{b}"]
    if along_own_axes(context, body):
        w, tensor = values[f"R{b}"].T @ base, values[f"I_body{b}"]
    else:
        w, tensor = base, values[f"I{b}"]
    row, column, factor = context.show(w.T), context.show(w), factor_of_identity(tensor)
    product = Product((letters.HALF, row, context.show(tensor), column))
    if factor is not None:
        product = Product((letters.HALF, number_in_front(context.show(factor)), row, column))
    name = letters.energy_part("omega", body)
    is_long = not context.is_short
    return equation(name, product), SILENT if is_long else _lines(context, body, w, tensor)


def _lines(context: Context, body: Body, w: Matrix, tensor: Matrix) -> Way:
    """½ Σ I_ij ω_i ω_j, and how it becomes the result."""
    value, result = context.values[f"Kw{body.name}"], context.form(f"Kw{body.name}")
    terms = tuple(_terms(context, w, tensor))
    if len(terms) < 2:
        return SILENT
    factor = factor_of_identity(tensor)
    shared = () if factor is None else (number_in_front(context.show(factor)),)
    form = Product((letters.HALF, *shared, sum_of(terms)))
    used = identities(value.ring, form, result)
    name = letters.energy_part("omega", body)
    return chain(
        value,
        [(("Multiplied out:",), form)],
        lambda tree: equation(name, tree),
        ("By ", *said(used), ":") if used else collected(form, result),
    )


def _terms(context: Context, w: Matrix, tensor: Matrix) -> Iterator[Node]:
    """I_ij ω_i ω_j; of a multiple of the identity the squares alone, its factor standing before them."""
    components, of_all = w.entries, factor_of_identity(tensor)
    for i in range(3):
        for j in range(i, 3):
            if not (tensor[i, j].is_zero or components[i].is_zero or components[j].is_zero):
                first, second = context.show(components[i]), context.show(components[j])
                rates = [(without_signs(first), 2)] if i == j else [(first, 1), (second, 1)]
                moment = tensor[i, j] if of_all is None else of_all.ring.one
                yield _term(context, 1 if i == j else 2, moment, rates)


def _term(context: Context, count: int, moment: Expr, rates: Sequence[tuple[Node, int]]) -> Node:
    """count · I_ij · rates"""
    shown = context.show(moment)
    return times(count, [(shown, 1), *rates], decimal=is_numeric(context.robot))
