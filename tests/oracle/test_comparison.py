"""The oracle itself: it takes what the textbooks print, and does not take a slip."""

from __future__ import annotations

import copy
import json
from typing import Any

import numpy as np
import pytest

from tests.oracle.comparison import assert_agrees, random_state
from tests.oracle.pinocchio_arm import dynamics
from tests.oracle.reading import coordinates_of, load, read
from tests.support import ROOT, assert_close, numbers, problem_file, solve_json

PUBLISHED = json.loads((ROOT / "tests" / "golden" / "published.json").read_text(encoding="utf-8"))
MATRICES = [case for case in PUBLISHED if case["quantity"] in ("D", "g", "tau", "C")]


@pytest.mark.parametrize("case", MATRICES, ids=lambda case: f"{case['problem']}-{case['quantity']}")
def test_the_oracle_agrees_with_the_book(case: dict[str, Any]) -> None:
    problem = load(problem_file(case["problem"]))
    values, q, qd, qdd = random_state(problem, seed=3)
    theirs = dynamics(read(problem, values), q, qd, qdd)
    book = numbers(case["value"], values)
    if case["quantity"] == "C":
        assert_close(book @ qd, theirs.Cqd, case["source"])
    else:
        assert_close(book, getattr(theirs, case["quantity"]), case["source"])


@pytest.mark.parametrize(
    ("quantity", "slip"),
    [
        ("K", "I1zz*theta1_dot**2/2 + m2*(cos(2*theta1)*L2**2*theta1_dot**2 + L2_dot**2)/2"),
        ("P", "m1*g*L1 + m2*g*L1"),
        (
            "tau",
            ["(I1zz + m2*L2**2)*theta1_ddot + m2*L2*L2_dot*theta1_dot", "m2*L2_ddot - m2*L2*theta1_dot**2"],
        ),
        ("D", [["m2*L2**2", "0"], ["0", "m2"]]),
        ("C", [["m2*L2*L2_dot", "0"], ["-m2*L2*theta1_dot", "0"]]),
        ("g", ["0", "m2*g/1000000"]),
    ],
)
def test_a_slip_is_noticed(quantity: str, slip: Any) -> None:
    path = ROOT / "problems" / "in3140-rp.yaml"
    solution = copy.deepcopy(solve_json(path))
    solution["results"][quantity] = slip
    with pytest.raises(AssertionError):
        assert_agrees(load(path), solution)


def test_coupled_coordinates_are_mapped() -> None:
    """D in absolute angles is Eᵀ D E of the one in joint angles, q = E p."""
    masses = "masses: [{mass: m1, link: 1}, {mass: m2, link: 2}]"
    joint = load(f"dh: [{{theta: q1*, a: l1}}, {{theta: q2*, a: l2}}]\n{masses}")
    absolute = load(f"dh: [{{theta: p1*, a: l1}}, {{theta: p2* - p1*, a: l2}}]\n{masses}")
    assert coordinates_of(absolute) == ("p1", "p2")
    values = dict.fromkeys(("m1", "m2", "l1", "l2", "g"), 0.7)
    E, p, rates, still = np.array([[1, 0], [-1, 1]]), np.array([0.4, 1.1]), np.array([0.3, -0.8]), np.zeros(2)
    in_joints = dynamics(read(joint, values), E @ p, E @ rates, still)
    in_absolute = dynamics(read(absolute, values), p, rates, still)
    assert_close(in_absolute.D, E.T @ in_joints.D @ E, "D")
    assert_close(in_absolute.Cqd, E.T @ in_joints.Cqd, "C q_dot")
