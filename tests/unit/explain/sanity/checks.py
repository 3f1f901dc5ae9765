"""What a check of a finished model says of a robot: its words, its lines, the rows of its table."""

from __future__ import annotations

import random
from functools import lru_cache

from dynsolve.document import Prose, Reference
from dynsolve.explain.context import Context
from dynsolve.explain.sanity import CHECKS, CHECKS_OF_LONGER_ARMS
from dynsolve.explain.step import Step
from dynsolve.notation.unicode import to_unicode
from tests.support import solved


@lru_cache
def context(problem: str) -> Context:
    solution = solved(problem)
    return Context(solution.robot, solution.values, solution.forms, solution.agreement)


def check(problem: str, id: str) -> Step | None:
    step_of = next(made for made in (*CHECKS, *CHECKS_OF_LONGER_ARMS) if made.__name__ == f"{id}_step")
    return step_of(context(problem))


def words(prose: Prose) -> str:
    parts = (part for part in prose if not isinstance(part, Reference))
    return "".join(part if isinstance(part, str) else to_unicode(part) for part in parts)


def said(problem: str, id: str) -> str:
    step = check(problem, id)
    assert step is not None
    return words(step.why)


def lines(problem: str, id: str) -> list[str]:
    step = check(problem, id)
    assert step is not None
    style = solved(problem).style
    return [to_unicode(node, style) for line in step.lines for node in line.formulas]


def rows(problem: str, id: str) -> list[list[str]]:
    step = check(problem, id)
    assert step is not None and step.table is not None
    style = solved(problem).style
    return [
        [part if isinstance(part, str) else to_unicode(part, style) for part in row]
        for row in step.table.rows
    ]


def values_of(context: Context, seed: int) -> dict[str, float]:
    """A random state with positive parameters."""
    draw, ring = random.Random(seed), context.robot.ring
    return {
        **{name: draw.uniform(0.5, 2) for name in ring.parameters},
        **{name + dots: draw.uniform(-3, 3) for name in ring.names for dots in ("", "_dot", "_ddot")},
    }
