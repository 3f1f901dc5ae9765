"""One row of τ in full, at the end of a long model."""

from __future__ import annotations

from dataclasses import replace

from dynsolve.document import Reference
from dynsolve.explain.closing import driving_row, has_friction
from dynsolve.explain.long_model.model import LongModel
from dynsolve.explain.step import Line, Step
from dynsolve.notation.tree import Node, Sum, equation

MOST_TERMS = 30
"""The terms up to which a row of τ is shown."""


def shortest_row(model: LongModel, step: Step) -> Step:
    """The closing step with the row of τ of the fewest terms, of equally short ones the last."""
    context = model.context
    if has_friction(context):
        return step
    rows = [(q, model.formulas.force(q.index - 1)) for q in reversed(context.robot.coordinates)]
    q, row = min(rows, key=lambda each: _terms(each[1]))
    if _terms(row) > MOST_TERMS:
        return step
    by = ("The shortest row as an example", Reference(("D", "christoffel", "g"), ", "), ":")
    return replace(step, lines=(Line(by, (equation(driving_row(context, q), row),)),))


def _terms(node: Node) -> int:
    return len(node.terms) if isinstance(node, Sum) else 1
