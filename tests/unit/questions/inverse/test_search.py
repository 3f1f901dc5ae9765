"""Arms whose inverse kinematics has a closed form: in which order, in which forms, how many branches."""

from __future__ import annotations

from itertools import islice
from math import exp
from random import Random

import pytest

from dynsolve.algebra.sampling import samples
from dynsolve.derivation.reached import same_configuration
from dynsolve.derivation.rules import derive
from dynsolve.problem import read_problem
from dynsolve.questions.inverse.search import solve_task
from dynsolve.questions.inverse.solving import MOST, Solving, branches, configuration, reach_of, solves_task

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
    ("dh: [{theta: q1*, a: l, alpha: beta}, {d: q2*, alpha: -90deg}, {d: q3*}]", "",
     "OneLine q1, Length q3, Length q2", 2),
    ("dh: [{d: q1* + h, theta: 45deg, a: e, alpha: 90deg}, {d: q2* - e, theta: -45deg, alpha: -90deg}, "
     "{theta: q3*, a: l, d: h}]", "", "OneLine q3, Length q2, Length q1", 2),
    ("dh: [{theta: q1*, alpha: 90deg, d: h}, {theta: q2*, a: l}, {d: q3*, theta: 90deg, alpha: 90deg}]",
     "task: [tip.x, tip.y, q1 + q2]", "OneLine q1, Length q3, Remainder q2", 2),
    ("dh: [{theta: q1*, a: l}, {theta: q2* + 90deg, alpha: 90deg}, {d: q3*}]",
     "task: [tip.x, tip.y, q1 + q2]", "RootLength q3, TwoLines q1, Remainder q2", 2),
    ("dh: [{theta: q1*, a: l1}, {theta: q2*, a: l2}, {theta: q3*, a: l3}]",
     "task: [tip.x, tip.y, q1 + q2]", "OneLine q1, TwoLines q3, Remainder q2", 2),
    ("dh: [{theta: q1*, alpha: 90deg}, {d: q2*, alpha: -90deg}, {theta: q3*, a: l}]",
     "task: [tip.x, tip.y, q1]", "OneLine q3, Length q2, Remainder q1", 2),
    ("dh: [{theta: q1*, alpha: 90deg, a: l1}, {theta: q2*, a: l2}]",
     "task: [tip.z, q1 - 2*q2]", "OneLine q2, Remainder q1", 2),
    ("dh: [{d: q1*, alpha: 30deg}, {d: q2*, theta: 45deg, alpha: 60deg}, {d: q3*}]",
     "task: [tip.x + tip.y, tip.z + tip.x, tip.y - 2*tip.z]", "Length q3, Length q2, Length q1", 1),
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
    for state in islice(samples(found.ring, first=MOST), 20):
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


SELDOM = [
    "dh: [{theta: q1*, d: d1, a: a1}, {d: q2*, a: a2, alpha: 90deg}, {theta: q3* + 180deg, d: d3, a: a3}]",
    "dh: [{theta: q1* + 90deg, a: a1, alpha: 90deg}, {theta: q2*, a: a2}, {theta: q3*, d: d3, a: a3}]",
    "dh: [{theta: 90deg, d: q1*, a: a1, alpha: 180deg}, {theta: q2* + 180deg, a: a2, alpha: 90deg}, "
    "{theta: q3* - 90deg, d: d3, a: a3}]",
    "dh: [{theta: q1* - 90deg, a: a1}, {d: q2*, a: a2, alpha: 90deg}, {theta: q3*, d: d3, a: a3}]",
]


@pytest.mark.parametrize("table", SELDOM)
def test_a_branch_that_exists_for_some_lengths_only_is_not_lost(table: str) -> None:
    """Every configuration is on a branch, as where a3 > a1 + a2; lengths are of every size."""
    found = solving(table)
    assert found is not None
    kept = branches(found)
    assert kept is not None
    random = Random(7)
    for _ in range(200):
        state = {name: exp(random.uniform(-1.5, 1)) for name in found.ring.parameters}
        state |= {name: random.uniform(-3, 3) for name in found.ring.names}
        state |= reach_of(found, state)
        there = [q for q in (configuration(found, branch, state) for branch in kept) if q is not None]
        assert any(same_configuration(found.ring, q, state, 1e-5) for q in there)
