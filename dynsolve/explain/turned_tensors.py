"""How the tensor of a body along the axes of the base comes about: R I Rᵀ, or why it stays as it is."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from dynsolve.algebra import matrix as algebra
from dynsolve.document import Prose
from dynsolve.explain.context import Context
from dynsolve.explain.working.products import product_named
from dynsolve.explain.working.rotational import factor_of_identity
from dynsolve.explain.writing import is_small
from dynsolve.notation.build import number_in_front
from dynsolve.notation.tree import Letter, Node, Product, Transpose
from dynsolve.quantities import letters
from dynsolve.robot.model import Body


@dataclass(frozen=True, slots=True)
class Turning:
    """How R I Rᵀ comes about: what is said of it, its lines, and the identities that lead to the result.

    `same` is the tensor that it is equal to, where the rotation does not change it, being about its `axis`.
    """

    lines: tuple[Node, ...]
    why: Prose = ()
    concluding: Prose = ()
    notes: tuple[Prose, ...] = ()
    same: Letter | None = None
    axis: str = ""


def turning_of(context: Context, body: Body, R: Letter) -> Turning:
    """By the factor of the identity, by an axis of symmetry, or by two products of matrices."""
    factor, axis = factor_of_identity(context.values[f"I_body{body.name}"]), _axis_of_symmetry(context, body)
    if factor is not None:
        line = Product((number_in_front(context.show(factor)), R, Transpose(R)))
        why: Prose = ("The tensor is a multiple of the identity matrix: whatever ", R, " is, ")
        why += (Product((R, Transpose(R))), " is the identity matrix, and the rotation keeps the tensor.")
        return Turning((line,), why, same=letters.tensor(context.robot, body))
    if axis is not None:
        tensor = context.values[f"I_body{body.name}"]
        alone = sum(not entry.is_zero for entry in tensor.entries) == 1
        kept = f"the moment about {axis} alone enters" if alone else f"the moments across {axis} are equal"
        why = (
            " Here ",
            R,
            f" is a rotation about {axis}, and {kept}, so the tensor stays as it is.",
        )
        return Turning((), why, same=letters.tensor(context.robot, body), axis=axis)
    lines = tuple(_turned(context, body))
    is_kept = context.form(f"I{body.name}") == context.form(f"I_body{body.name}")
    notes: tuple[Prose, ...] = (("This rotation does not change the tensor.",),) if is_kept else ()
    return Turning(lines, (), _turned_named(context, body) if lines else (), notes)


def _axis_of_symmetry(context: Context, body: Body) -> str | None:
    """The axis of the body that R turns about, where the tensor is the same about all axes across it."""
    R, tensor = context.values[f"R{body.name}"], context.values[f"I_body{body.name}"]
    one, unturned = R[0, 0].ring.one, algebra.Matrix.identity(R[0, 0].ring, 3)
    if R @ tensor @ R.T != tensor or unturned == R:
        return None
    return next((name for k, name in enumerate("xyz") if R[k, k] == one), None)


def _turned(context: Context, body: Body) -> Iterator[Node]:
    """R I Rᵀ with their entries, then R (I Rᵀ): one product of matrices from a line to the next."""
    b = body.name
    rotation, given = context.form(f"R{b}"), context.form(f"I_body{b}")
    if not is_small(rotation, rotation, given):
        return
    yield Product((rotation, given, Transpose(rotation)))
    R, tensor, base = (context.values[name] for name in (f"R{b}", f"I_body{b}", f"I{b}"))
    half = tensor @ R.T
    if context.is_short and half not in (tensor, R.T, base):
        shown = context.show(half)
        if is_small(rotation, shown):
            yield Product((rotation, shown))


def _turned_named(context: Context, body: Body) -> Prose:
    """The identities by which R (I Rᵀ) becomes what is printed."""
    R, given, base = (context.values[f"{letter}{body.name}"] for letter in ("R", "I_body", "I"))
    return product_named(context, R, given @ R.T, base)
