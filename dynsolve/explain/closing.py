"""The step that closes a derivation: D q̈ + C q̇ + g = τ, with this robot's matrices where they fit."""

from __future__ import annotations

from dynsolve.document import Prose
from dynsolve.explain.citations import spong
from dynsolve.explain.context import Context
from dynsolve.explain.step import Detail, Step
from dynsolve.explain.style import style_of
from dynsolve.explain.working.proved import MOST_JOINTS
from dynsolve.notation.tree import Matrix, Node, Product, Sum, Symbol, column, equation
from dynsolve.notation.unicode import UnicodePrinter, width
from dynsolve.quantities import letters
from dynsolve.quantities.stages import Stage

ID = "model"
"""The closing step; reports show it in their last section, with what it is made of."""


WIDEST = 84
"""The characters up to which matrices are written out in the equation; wider ones stand by themselves."""


def closing_step(context: Context) -> Step:
    """D q̈ + C q̇ + g = τ"""
    robot = context.robot
    inertial, coriolis = Product((letters.D, letters.QDD)), Product((letters.C, letters.QD))
    parts = [context.matrix(name) for name in ("D", "C", "g")]
    qd = column(*(Symbol(q.name, 1) for q in robot.coordinates))
    qdd = column(*(Symbol(q.name, 2) for q in robot.coordinates))
    forces = column(*(letters.force(q) for q in robot.coordinates))
    result: tuple[Node, ...] = ()
    if robot.n <= MOST_JOINTS and all(_width(context, part) <= WIDEST for part in parts):
        result = (equation(Sum((Product((parts[0], qdd)), Product((parts[1], qd)), parts[2])), forces),)
    why: Prose = (inertial, " are the inertial forces, ", coriolis)
    why += (" the Coriolis and centrifugal ones, ", letters.G, " those of gravity.")
    return Step(
        id=ID,
        stage=Stage.VECTORIZED,
        title="The dynamical model",
        why=why,
        formula=equation(Sum((inertial, coriolis, letters.G)), letters.TAU),
        source=spong("7.3"),
        result=result,
        detail=Detail.BRIEF,
    )


def _width(context: Context, matrix: Matrix) -> int:
    """How wide a matrix is in characters, two blanks between its columns."""
    printer = UnicodePrinter(style_of(context.robot))
    columns = zip(*matrix.rows, strict=True)
    return sum(max(width(printer.text(entry)) for entry in column) + 2 for column in columns)
