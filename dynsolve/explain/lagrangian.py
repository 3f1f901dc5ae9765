"""The step to the Lagrangian."""

from __future__ import annotations

from collections.abc import Iterator

from dynsolve.explain.context import Context
from dynsolve.explain.step import Detail, Step
from dynsolve.explain.writing import spong
from dynsolve.notation.tree import Negative, Sum, equation
from dynsolve.quantities import letters
from dynsolve.quantities.stages import Stage

STAGE = Stage.LAGRANGIAN


def steps(context: Context) -> Iterator[Step]:
    """L = K - P"""
    yield Step(
        id="L",
        stage=STAGE,
        title="Kinetic minus potential energy",
        why=("The one function from which every equation of motion follows.",),
        formula=equation(letters.L, Sum((letters.K, Negative(letters.P)))),
        source=spong("7.1"),
        result=(equation(letters.L, context.form("L")),),
        detail=Detail.BRIEF,
    )
