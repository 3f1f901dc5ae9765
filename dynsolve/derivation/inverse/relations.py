"""Equations between values of the task that hold at every configuration, from what a search has made.

A component that no joint moves has one value; the tip of a single joint is on a circle.  Such relations
are among the equations of the search, and two equations for one angle leave one (c² + s² = 1).
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from itertools import chain

from dynsolve.algebra.expr import Expr
from dynsolve.derivation.inverse.equations import Equation
from dynsolve.derivation.inverse.solving import Relation
from dynsolve.derivation.inverse.subproblems import Solved, TwoLines

MOST_TERMS = 200
"""Longer relations help no reader, and are not looked at."""

MOST_RELATIONS = 100
"""So many are looked at."""

_LARGEST_LINES = 20
"""Two equations with more terms are not squared."""


def relations(steps: Iterable[Solved], equations: Iterable[Equation]) -> tuple[Relation, ...]:
    """What holds between the values of the task at every configuration, the shortest first."""
    found: dict[Expr, Relation] = {}
    made = list(equations)
    first = {e.right: e.left for e in reversed(made)}
    twice = (Relation(e.left, first[e.right]) for e in made if e.left != first[e.right])
    for one in chain((Relation(e.left, e.right) for e in made), twice, _of_lines(steps)):
        is_free = not one.left.ring.depends_on_coordinates(one.expr)
        if is_free and len(one.expr) <= MOST_TERMS and not one.expr.is_zero and -one.expr not in found:
            found.setdefault(one.expr, one)
    return tuple(sorted(found.values(), key=length)[:MOST_RELATIONS])


def length(one: Relation) -> int:
    """What a relation costs its reader."""
    return len(one.left) + len(one.right)


def _of_lines(steps: Iterable[Solved]) -> Iterator[Relation]:
    """c² + s² = 1 of two equations for one angle."""
    for step in steps:
        if isinstance(step, TwoLines) and step.size <= _LARGEST_LINES:
            (a, b, x), (c, d, y) = step.first, step.second
            if step.is_rotation:
                yield Relation(x * x + y * y, a * a + b * b)
            else:
                sine, cosine, below = a * y - c * x, d * x - b * y, step.determinant
                yield Relation(sine * sine + cosine * cosine, below * below)
