"""What is lost at singular configurations: as many directions as the rank is less, Jᵀ w = 0 for each."""

from __future__ import annotations

import pytest

import dynsolve
from dynsolve.derivation.singular.sets import SingularSet

WRIST = "{theta: q1*, alpha: -90deg}, {theta: q2*, alpha: 90deg}, {theta: q3*}"
ARMS = {
    # table, task, rows of J, the rank of each case
    "two links": ("{theta: q1*, a: l1}, {theta: q2*, a: l2}", "[tip.x, tip.y]", 2, [1]),
    "a wrist, all six rates": (WRIST, "twist", 6, [2]),
    "two links and a slide, all six rates": (
        "{theta: q1*, a: l1}, {theta: q2*, a: l2, alpha: 180deg}, {d: d3*}, {theta: q4*}", "twist", 6, [3]),
}  # fmt: skip


@pytest.mark.parametrize(("table", "task", "rows", "ranks"), ARMS.values(), ids=ARMS)
def test_every_direction_that_is_lost_is_found(table: str, task: str, rows: int, ranks: list[int]) -> None:
    """The verification of `solve` holds each of them against the Jacobian in numbers."""
    solution = dynsolve.solve(f"dh: [{table}]\ntask: {task}\nfind: [singular]\n")
    found = solution.values["singular"]
    assert isinstance(found, SingularSet)
    assert [loss.rank for loss in found.losses] == ranks
    assert [len(loss.directions) for loss in found.losses] == [rows - rank for rank in ranks]


def test_a_wrench_is_a_force_and_a_moment() -> None:
    solution = dynsolve.solve(f"dh: [{WRIST}]\ntask: twist\nfind: [singular]\n")
    why = next(step.why for step in solution.steps if step.id == "singular_1")
    assert "A force and a moment along " in "".join(part for part in why if isinstance(part, str))
