"""Which results would fill pages, and what stands in their place."""

from __future__ import annotations

from dataclasses import replace

from dynsolve.document import Prose
from dynsolve.explain.step import Step
from dynsolve.notation import tree
from dynsolve.notation.build import cost
from dynsolve.notation.tree import Node, Relation
from dynsolve.quantities.stages import Stage

LONGEST = 80
"""The operations up to which a result on the way to D, c_ijk and g is written out."""


def is_too_long(step: Step) -> bool:
    """Whether a step on the way would fill pages."""
    on_the_way = step.stage is Stage.INERTIA or step.stage is Stage.ENERGY
    return on_the_way and max(map(_size, step.result), default=0) > LONGEST


def _size(node: Node) -> int:
    """The operations in a result."""
    value = node.parts[-1] if isinstance(node, Relation) else node
    if isinstance(value, tree.Matrix):
        return sum(_size(entry) for row in value.rows for entry in row)
    try:
        return cost(value)
    except TypeError:  # a formula in letters
        return 0


def left_out(step: Step) -> Step:
    """The step with its formula as its result."""
    if step.formula is None:
        return step
    note: Prose = ("Written out it would be too long to be useful; the formula defines it.",)
    return replace(step, result=(), notes=(*step.notes, note))
