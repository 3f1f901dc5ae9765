"""A velocity, or the columns of a Jacobian, brought to the axes of frame i by (R_i^w)ᵀ.

A rotation leaves lengths and products of vectors unchanged: where the entries are long in the world, their
squares and products are worked out along the axes of a frame in which they come apart.
"""

from __future__ import annotations

from dynsolve.algebra.matrix import Matrix
from dynsolve.derivation.kinematics import rotation
from dynsolve.document import Prose
from dynsolve.explain.context import Context
from dynsolve.explain.step import Line
from dynsolve.explain.working.identities import said
from dynsolve.explain.working.products import used_in_product
from dynsolve.explain.writing import block_of, is_small
from dynsolve.notation import tree
from dynsolve.notation.tree import Letter, Node, Product, Transpose, equation
from dynsolve.quantities import letters


def turned_name(context: Context, i: int, letter: Letter) -> Product:
    """(R_i^w)ᵀ v, in letters."""
    return Product((Transpose(letters.R(context.robot, i)), letter))


def turning_line(
    context: Context, i: int, letter: Letter, value: Matrix, written: tree.Matrix, kept: Prose
) -> Line:
    """(R_i^w)ᵀ v with both matrices, and what it is; `kept` says what the rotation leaves unchanged."""
    R = rotation(context.values[f"H{i}"])
    turned = R.T @ value
    block = block_of(context.matrix(f"H{i}"), 3, 0, 3)
    members: list[Node] = [turned_name(context, i, letter)]
    if is_small(block, written):
        members.append(Product((Transpose(block), written)))
    used = used_in_product(context, R.T, value, turned)
    by: Prose = ("A rotation leaves ", *kept, f" unchanged; along the axes of frame {i}")
    by += (", with ", *said(used), ":") if used else (":",)
    return Line(by, (equation(*members, context.show(turned)),))
