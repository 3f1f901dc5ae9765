"""A chain of lines, each of which is proved equal to the value it claims before it is shown.

`chain` is the only way by which the stages get their lines: what it cannot prove in the ring is
not said.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass

from dynsolve.algebra.expr import Expr
from dynsolve.algebra.ring_values import value_of
from dynsolve.document import Prose
from dynsolve.errors import AlgebraError
from dynsolve.explain.step import Line
from dynsolve.notation.tree import Node


@dataclass(frozen=True, slots=True)
class Way:
    """The lines to a result, and what is said of the last operation.

    With a `frame` they begin afresh from the formula, along the axes of that frame.
    """

    lines: tuple[Line, ...] = ()
    concluding: Prose = ()
    frame: int | None = None


SILENT = Way()


def equals(tree: Node, value: Expr) -> bool:
    """Whether a scalar tree has an exact value, and this one."""
    try:
        return value_of(value.ring, tree) == value
    except AlgebraError:
        return False


def chain(
    value: Expr, lines: Iterable[tuple[Prose, Node]], written: Callable[[Node], Node], concluding: Prose
) -> Way:
    """The lines as they are written, if each of them is the value; else nothing."""
    lines = tuple(lines)
    if not all(equals(tree, value) for _, tree in lines):
        return SILENT
    return Way(tuple(Line(by, (written(tree),)) for by, tree in lines), concluding)
