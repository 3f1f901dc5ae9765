"""Arms whose inverse kinematics has a closed form: in which order, in which forms, how many branches."""

from __future__ import annotations

from itertools import islice

import pytest

from dynsolve.algebra.sampling import ENOUGH, samples
from dynsolve.derivation.inverse.branches import branches, configuration, reach_of, solves_task
from dynsolve.derivation.inverse.search import solve_task
from dynsolve.derivation.inverse.solving import Solving
from dynsolve.derivation.rules import derive
from dynsolve.problem import read_problem

ELBOW = "dh: [{theta: q1*, d: L1, alpha: 90deg}, {theta: q2*, a: L2}, {theta: q3*, a: L3}]"
ORTHOGONAL = "dh: [{theta: q1*, a: L1, alpha: 90deg}, {theta: q2*, a: L2, alpha: 90deg}, {theta: q3*, a: L3}]"

# (the table, the task, (form, coordinate) step by step, the number of branches)
ARMS = [
    ("dh: [{theta: q1*, a: l1}, {theta: q2*, a: l2}]", "", "OneLine q2, TwoLines q1", 2),
    ("dh: [{theta: q1*, alpha: 90deg}, {d: d2*}]", "", "OneLine q1, Length d2", 2),
    (ELBOW, "", "OneLine q1, OneLine q3, TwoLines q2", 4),
    (
        "dh: [{theta: q1*, a: l1}, {theta: q2*, a: l2}, {theta: q3*, a: l3}]",
        "task: [tip.x, tip.y, q1 + q2 + q3]",
        "OneLine q2, TwoLines q1, Remainder q3",
        2,
    ),
    ("dh: [{d: d1*, alpha: -90deg}, {d: d2*, a: l1, alpha: 60deg}, {theta: q3*, a: l2}]", "",
     "OneLine q3, Length d2, Length d1", 2),
    ("dh: [{theta: q1*, d: L1, alpha: -90deg}, {theta: q2* - 90deg, d: h, a: L2, alpha: -90deg}, "
     "{theta: 90deg, d: d3*}]", "", "RootLength d3, OneLine q2, TwoLines q1", 4),
]  # fmt: skip


def solving(table: str, task: str = "") -> Solving | None:
    robot = read_problem(f"{table}\n{task}\nfind: [r]\n").robot
    r = derive(robot)["r"]
    return solve_task(r, [f"r{k}" for k in range(1, len(r.rows) + 1)])


@pytest.mark.parametrize(("table", "task", "steps", "count"), ARMS)
def test_the_steps_and_the_branches(table: str, task: str, steps: str, count: int) -> None:
    found = solving(table, task)
    assert found is not None
    assert ", ".join(f"{type(step).__name__} {step.coordinate}" for step in found.solved) == steps
    kept = branches(found)
    assert kept is not None
    assert len(kept) == count


@pytest.mark.parametrize(("table", "task", "steps", "count"), ARMS)
def test_every_branch_solves_the_task(table: str, task: str, steps: str, count: int) -> None:
    found = solving(table, task)
    assert found is not None
    kept = branches(found)
    assert kept is not None
    for state in islice(samples(found.ring), ENOUGH, ENOUGH + 20):
        reached = reach_of(found, state)
        there = [q for q in (configuration(found, b, {**state, **reached}) for b in kept) if q is not None]
        assert there
        assert all(solves_task(found, q, reached) for q in there)


def test_an_arm_whose_equation_is_of_the_fourth_degree_has_no_closed_form_here() -> None:
    assert solving(ORTHOGONAL) is None


def test_a_coordinate_that_does_not_occur_is_free() -> None:
    found = solving("dh: [{theta: q1*, a: l1}, {theta: q2*}]")
    assert found is not None
    assert found.free == ("q2",)
