"""Arms that are to reach a full pose: what is solved for from what, how many branches, each put in."""

from __future__ import annotations

from functools import cache
from itertools import islice

import pytest

from dynsolve.algebra.sampling import samples
from dynsolve.derivation.rules import derive
from dynsolve.problem import read_problem
from dynsolve.questions.inverse.pose import solve_pose
from dynsolve.questions.inverse.solving import MOST, Solving, branches, configuration, reach_of, solves_task
from dynsolve.questions.inverse.subproblems import TwoLines

WRIST = "{theta: q4*, d: d4, alpha: -90deg}, {theta: q5*, alpha: 90deg}, {theta: q6*, d: d6}"

# (the table, the coordinates of each part in their order, the number of branches)
ARMS = {
    # Spong, Hutchinson, Vidyasagar (2006), 3.3.4: an elbow arm with a spherical wrist, 4 times 2
    "elbow": (
        "{theta: q1*, d: d1, alpha: 90deg}, {theta: q2*, a: a2}, {theta: q3*, alpha: 90deg}, " + WRIST,
        "q1 q3 q2, q4 q5 q6",
        8,
    ),
    # Spong, example 3.5: the Stanford arm; d3 of either sign
    "Stanford": (
        "{theta: q1*, alpha: -90deg}, {theta: q2*, d: d2, alpha: 90deg}, {d: q3*}, "
        "{theta: q4*, alpha: -90deg}, {theta: q5*, alpha: 90deg}, {theta: q6*, d: d6}",
        "q3 q2 q1, q4 q5 q6",
        8,
    ),
    # Craig, 4.7: the PUMA 560 has eight solutions
    "PUMA": (
        "{theta: q1*, alpha: 90deg}, {theta: q2*, a: a2}, {theta: q3*, d: d3, a: a3, alpha: -90deg}, "
        "{theta: q4*, d: d4, alpha: 90deg}, {theta: q5*, alpha: -90deg}, {theta: q6*}",
        "q1 q3 q2, q4 q5 q6",
        8,
    ),
    # Spong, example 3.4: a cylindrical arm with a spherical wrist; d3 of either sign
    "cylindrical": (
        "{theta: q1*, d: d1}, {d: q2*, alpha: -90deg}, {d: q3*}, "
        "{theta: q4*, alpha: -90deg}, {theta: q5*, alpha: 90deg}, {theta: q6*, d: d6}",
        "q2 q1 q3, q4 q5 q6",
        4,
    ),
    "SCARA": (
        "{theta: q1*, a: a1}, {theta: q2*, a: a2, alpha: 180deg}, {d: q3*}, {theta: q4*, d: d4}",
        "q3 q2 q1, q4",
        2,
    ),
    "planar": ("{theta: q1*, a: a1}, {theta: q2*, a: a2}, {theta: q3*, a: a3}", "q2 q1, q3", 2),
    # three parallel axes, 2 to 4, as of the Universal Robots: 8 solutions (Hawkins, Analytic Inverse
    # Kinematics for the Universal Robots, 2013)
    "parallel": (
        "{theta: q1*, d: d1, alpha: 90deg}, {theta: q2*, a: a2}, {theta: q3*, a: a3}, "
        "{theta: q4*, d: d4, alpha: 90deg}, {theta: q5*, d: d5, alpha: -90deg}, {theta: q6*, d: d6}",
        "q1 q5 q6, q3 q2, q4",
        8,
    ),
    # twists that are no right angles in the wrist, and a hand beside its last axis
    "oblique": (
        "{theta: q1*, d: d1, alpha: 90deg}, {theta: q2*, a: a2}, {theta: q3*, alpha: 90deg}, "
        "{theta: q4*, d: d4, alpha: -60deg}, {theta: q5*, alpha: 60deg}, {theta: q6*, a: a6, d: d6}",
        "q1 q3 q2, q5 q4 q6",
        8,
    ),
    # the second axis at any angle to the first: the height along the first is seen from the second
    "tilted": (
        "{theta: q1*, d: d1, alpha: tilt}, {theta: q2*, a: a2}, {theta: q3*, alpha: 90deg}, " + WRIST,
        "q3 q1 q2, q4 q5 q6",
        8,
    ),
    # axes 3 to 5 meet: what is behind and before them comes first
    "middle": (
        "{theta: q1*, d: d1, alpha: 90deg}, {theta: q2*, a: a2}, {theta: q3*, alpha: 90deg}, "
        "{theta: q4*, alpha: -90deg}, {theta: q5*, a: a5, alpha: 90deg}, {theta: q6*, d: d6}",
        "q6, q1 q2, q3 q4 q5",
        8,
    ),
    # the first three axes meet: the same from the other end
    "shoulder": (
        "{theta: q1*, alpha: -90deg}, {theta: q2*, alpha: 90deg}, {theta: q3*, d: d3, a: a3, alpha: -90deg}, "
        "{theta: q4*, a: a4}, {theta: q5*, a: a5, alpha: 90deg}, {theta: q6*, d: d6}",
        "q6 q4 q5, q1 q2 q3",
        8,
    ),
}


@cache
def solving(name: str) -> Solving:
    robot = read_problem(f"dh: [{ARMS[name][0]}]\ngravity: none\ntask: pose\nfind: [inverse]\n").robot
    found = solve_pose(robot, derive(robot)["pose"], robot.questions.reached)
    assert found is not None
    return found


@pytest.mark.parametrize("name", ARMS)
def test_the_parts_and_the_branches(name: str) -> None:
    _, steps, count = ARMS[name]
    parts = [" ".join(step.coordinate for step in part.solved) for part in solving(name).parts]
    assert ", ".join(parts) == steps
    kept = branches(solving(name))
    assert kept is not None
    assert len(kept) == count
    for state in islice(samples(solving(name).ring, first=MOST), 3):
        reached = reach_of(solving(name), state)
        found = [configuration(solving(name), branch, {**state, **reached}) for branch in kept]
        there = [q for q in found if q is not None]
        assert there
        assert all(solves_task(solving(name), q, reached) for q in there)


def test_a_right_angled_wrist_has_no_denominators() -> None:
    """So that its formulas say which angle is free where it is singular."""
    for step in solving("elbow").parts[1].solved:
        assert not (isinstance(step, TwoLines) and step.may_be_free)


def test_an_arm_of_seven_joints_has_no_finite_number_of_branches() -> None:
    rows = ", ".join(f"{{theta: q{k}*, alpha: 90deg}}" for k in range(1, 8))
    robot = read_problem(f"dh: [{rows}]\ngravity: none\ntask: pose\nfind: [inverse]\n").robot
    assert solve_pose(robot, derive(robot)["pose"], robot.questions.reached) is None
