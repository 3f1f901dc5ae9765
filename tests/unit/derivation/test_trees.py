"""Tables whose rows start from earlier frames: the derivation goes by the links, not by the rows."""

from __future__ import annotations

import pytest

import dynsolve
from dynsolve.errors import ProblemError
from dynsolve.problem import read_problem

TWO_ARMS = """
gravity: [0, -g, 0]
dh:
  - {theta: q1*, a: l1}
  - {theta: q2*, a: l2}
  - {from: 1, theta: q3*, a: l3}
  - {from: 3, d: q4*, alpha: beta}
masses:
  - {mass: m1, link: 1}
  - {mass: m2, link: 2, center: {near: [lc2, 0, 0]}, inertia: {zz: I2}}
  - {mass: m3, link: 3, center: midpoint, inertia: {zz: I3}}
  - {mass: m4, link: 4, center: [x, y, 0]}
"""
APART = """
gravity: [0, -g, 0]
dh: [{theta: q1*, a: l1}, {from: 0, theta: q2*, a: l2}]
masses: [{mass: m1, link: 1}, {mass: m2, link: 2}]
"""


MODIFIED = """
convention: modified
gravity: [0, -g, 0]
dh:
  - {theta: q1*}
  - {a: l1, theta: q2*}
  - {from: 1, a: l1, theta: q3*}
  - {from: 3, a: l3, alpha: beta, d: q4*}
masses:
  - {mass: m1, link: 1, center: [lc1, 0, 0]}
  - {mass: m2, link: 2, center: [lc2, 0, 0], inertia: {zz: I2}}
  - {mass: m3, link: 3, center: [lc3, 0, 0], inertia: {zz: I3}}
  - {mass: m4, link: 4, center: [x, y, 0]}
"""


@pytest.mark.parametrize("text", [TWO_ARMS, MODIFIED], ids=["standard", "modified"])
def test_both_ways_and_the_check_agree(text: str) -> None:
    """The textbook's Jacobians, those in the links' frames, the recursions, and the check on numbers."""
    problem = read_problem(text, "tree.yaml")
    solution = dynsolve.solve(problem)
    assert solution.agreement is not None
    assert solution.agreement.holds
    by_recursions = dynsolve.solve(problem, method="newton-euler")
    assert solution.values["tau"] == by_recursions.values["tau"]


def test_two_pendulums_on_one_base_do_not_know_of_each_other() -> None:
    results = dynsolve.solve(APART).to_json()["results"]
    assert results["D"] == [["m1*l1**2", "0"], ["0", "m2*l2**2"]]
    assert results["g"] == ["m1*g*l1*cos(q1)", "m2*g*l2*cos(q2)"]
    assert results["H"][1][0] == ["cos(q2)", "-sin(q2)", "0", "l2*cos(q2)"]


def test_a_branch_leaves_the_rest_of_the_arm_alone() -> None:
    """Joint 2 moves neither link 3 nor link 4."""
    solution = dynsolve.solve(TWO_ARMS)
    assert all(entry == 0 for entry in solution.symbolic("Jv3")[:, 1])
    assert solution.D[1, 2] == solution.D[1, 3] == 0


@pytest.mark.parametrize(
    ("start", "message"),
    [
        ("1", "none of frame 0"),
        ("-1", "none of frame 0"),
        ("base", "none of frame 0"),
        ("[0]", "none of frame 0"),
    ],
)
def test_a_row_starts_from_an_earlier_frame(start: str, message: str) -> None:
    with pytest.raises(ProblemError, match=message) as raised:
        read_problem(f"dh: [{{from: {start}, theta: q1*, a: l1}}]\n", "tree.yaml")
    assert raised.value.findings[0].line == 1


def test_the_frame_before_may_be_named() -> None:
    problem = read_problem("dh: [{from: 0, theta: q1*, a: l1}, {from: 1, theta: q2*, a: l2}]\n", "chain.yaml")
    assert not problem.robot.is_tree
