"""The lines that give the parts of a sum before it is added up."""

from __future__ import annotations

from collections.abc import Sequence

from dynsolve.algebra.matrix import Matrix
from dynsolve.document import Prose
from dynsolve.explain.context import Context
from dynsolve.explain.step import Line
from dynsolve.notation.tree import Node, equation

Part = tuple[Node, Matrix]
"""A term of a formula, and its value."""


def lines_of(context: Context, parts: Sequence[Part]) -> tuple[Line, ...]:
    """The parts that are not zero, each with its value; none where there is one or none."""
    shown = [(name, value) for name, value in parts if not value.is_zero]
    if len(shown) < 2:
        return ()
    formulas = tuple(equation(name, context.show(value)) for name, value in shown)
    zero = "; the others are zero" if len(shown) < len(parts) else ""
    return (Line((f"Its parts{zero}:",), formulas),)


def concluding(lines: Sequence[Line]) -> Prose:
    """What leads from the parts to the result."""
    return ("Added:",) if lines else ()
