"""The lines from ½ ωᵀ 𝓘 ω to the kinetic energy of rotation, along the axes in which they are short.

𝓘 = R I Rᵀ is the tensor along the axes of the base.  Where it varies with the configuration, ω is
brought to the body's own axes instead (`own_axes`), along which the tensor is the constant one that is given:
ωᵀ 𝓘 ω = (Rᵀ ω)ᵀ I (Rᵀ ω), and in the same way J_ωᵀ 𝓘 J_ω.
"""

from __future__ import annotations

from collections.abc import Iterator

from dynsolve.algebra.compact.matrix_factor import matrix_factor
from dynsolve.algebra.expr import Expr
from dynsolve.algebra.matrix import Matrix
from dynsolve.explain.context import Context
from dynsolve.explain.forms import is_numeric
from dynsolve.explain.working.identities import identities, said
from dynsolve.explain.working.kinetic import collected, without_signs
from dynsolve.explain.working.proved import SILENT, Way, chain
from dynsolve.explain.writing import sum_of
from dynsolve.notation import tree
from dynsolve.notation.build import factors_of, number_in_front, times
from dynsolve.notation.tree import ONE, ZERO, Node, Product, equation
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
    row, column, (front, inner) = context.show(w.T), context.show(w), _with_factor(context, tensor)
    product = Product((letters.HALF, *front, row, *([] if inner is None else [inner]), column))
    whole = equation(letters.energy_part("omega", body), product)
    return whole, _lines(context, body, w, tensor) if context.is_short else SILENT


def _with_factor(context: Context, tensor: Matrix) -> tuple[tuple[Node, ...], tree.Matrix | None]:
    """The factors that the moments share, and what is left of the tensor: of a multiple of E, nothing."""
    form, factor = context.show(tensor), factor_of_identity(tensor)
    assert isinstance(form, tree.Matrix)
    if factor is not None:
        return factors_of(number_in_front(context.show(factor))), None
    found = matrix_factor(context.forms.compactor.collector, form)
    return ((), form) if found is None else (factors_of(found[0]), found[1])


def _lines(context: Context, body: Body, w: Matrix, tensor: Matrix) -> Way:
    """½ Σ I_ij ω_i ω_j, and how it becomes the result."""
    value, result = context.values[f"Kw{body.name}"], context.form(f"Kw{body.name}")
    front, inner = _with_factor(context, tensor)
    terms = tuple(_terms(context, w, inner))
    if len(terms) < 2:
        return SILENT
    form = Product((letters.HALF, *front, sum_of(terms)))
    used = identities(value.ring, form, result)
    name = letters.energy_part("omega", body)
    return chain(
        value,
        [(("Multiplied out:",), form)],
        lambda tree: equation(name, tree),
        ("By ", *said(used), ":") if used else collected(form, result),
    )


def _terms(context: Context, w: Matrix, moments: tree.Matrix | None) -> Iterator[Node]:
    """I_ij ω_i ω_j; without a tensor, the squares alone."""
    for i in range(3):
        for j in range(i, 3):
            moment = (ONE if i == j else ZERO) if moments is None else moments.rows[i][j]
            if moment != ZERO and not (w[i, 0].is_zero or w[j, 0].is_zero):
                first, second = context.show(w[i, 0]), context.show(w[j, 0])
                rates = [(without_signs(first), 2)] if i == j else [(first, 1), (second, 1)]
                count = 1 if i == j else 2
                yield times(count, [(moment, 1), *rates], decimal=is_numeric(context.robot))
