"""The rows of rotations that give the heights of the mass centres of far links, where each fits a line."""

from __future__ import annotations

from collections.abc import Iterator

from dynsolve.algebra.matrix import Matrix
from dynsolve.derivation.kinematics import rotation
from dynsolve.explain.context import Context
from dynsolve.explain.long_model.halves import halves
from dynsolve.explain.step import Line
from dynsolve.explain.widths import matrix_width
from dynsolve.notation import tree
from dynsolve.notation.tree import Node, Product, Transpose, equation
from dynsolve.quantities import letters
from dynsolve.robot.model import Body

WIDEST = 80
"""The characters of a row up to which the rows are shown; wider ones would be a page of entries."""


def heights(context: Context) -> Iterator[Line]:
    """z₀ᵀ R of the links between the two frames that are shown, where gravity is along z₀."""
    robot = context.robot
    if robot.is_tree or not robot.has_table or letters.has_base(robot) or not _is_along_z0(robot.gravity):
        return
    inner, outer = halves(robot)
    shown = (1, inner[-1].index, outer[-1].index)  # the first row is its own frame
    between = [body for body in robot.bodies if body.link not in shown]
    rows = {body.link: _row(context, body) for body in between if _is_tilted(context, body)}
    if rows and all(matrix_width(context, row) <= WIDEST for row in rows.values()):
        named = tuple(equation(_name(context, link), row) for link, row in rows.items())
        yield Line(("The third rows of the rotations that give heights, where they were not shown:",), named)


def _is_along_z0(gravity: Matrix) -> bool:
    across = gravity.entries[0].is_zero and gravity.entries[1].is_zero
    return across and not gravity.entries[2].is_zero


def _is_tilted(context: Context, body: Body) -> bool:
    """Whether the height of a body off the origin of its frame changes as the frame turns."""
    ring, row = context.robot.ring, rotation(context.values[f"H{body.link}"]).rows[2]
    turned = any(not ring.diff(entry, k).is_zero for entry in row for k in range(context.robot.n))
    return turned and not body.center.is_zero


def _row(context: Context, body: Body) -> tree.Matrix:
    shown = context.show(Matrix.of(context.robot.ring, [rotation(context.values[f"H{body.link}"]).rows[2]]))
    assert isinstance(shown, tree.Matrix)
    return shown


def _name(context: Context, link: int) -> Node:
    """z₀ᵀ R"""
    return Product((Transpose(letters.z(0)), letters.R(context.robot, link)))
