"""A set that is right for the student's own determinant or forces follows; where these wait, it waits."""

from __future__ import annotations

import pytest

from dynsolve.answers.verdict import JudgedAnswer
from tests.unit.answers.hands import checker

ARM = """
gravity: [0, -g, 0]
dh: [{theta: q1*, a: l1}, {theta: q2*, a: l2}]
masses: [{mass: m1, link: 1}, {mass: m2, link: 2}]
find: [det, singular, P, g, equilibria]
"""
REDUNDANT = """
dh: [{theta: q1*, a: l}, {theta: q2*, a: l}, {theta: q3*, a: l}]
task: [tip.x, tip.y]
find: [Jr, det, singular]
"""
PENDULUM = """
gravity: [0, -g, 0]
dh: [{theta: q1*, a: l}]
masses: [{mass: m, link: 1}]
find: [P, g, equilibria]
"""
OWN_DET = "l1*l2*cos(q2)"
OWN_G = "[m1*g*l1*sin(q1), m2*g*l2*cos(q1 + q2)]"


def judged(problem: str, text: str, name: str) -> JudgedAnswer:
    check = checker(problem)
    report = check(check.reader(f"answers:\n{text}", "a.yaml"))
    return next(answer for answer in report.answers if answer.name == name)


@pytest.mark.parametrize(
    ("problem", "text", "name", "verdict", "sources"),
    [
        (ARM, f"  det: {OWN_DET}\n  singular: [cos(q2) = 0]", "singular", "follows", ("det",)),
        (ARM, f"  det: {OWN_DET}\n  singular: [q2 = pi/2, q2 = -pi/2]", "singular", "follows", ("det",)),
        (ARM, f"  det: {OWN_DET}\n  singular: [q2 = pi/2]", "singular", "wrong", ()),
        (ARM, f"  det: {OWN_DET}\n  singular: [cos(q2) = 0, q1 = 0]", "singular", "wrong", ()),
        (ARM, f"  det: {OWN_DET}\n  singular: [sin(q2) = 0]", "singular", "correct", ()),
        (ARM, "  det: l1*l2*sin(q2)\n  singular: [cos(q2) = 0]", "singular", "wrong", ()),
        (ARM, "  singular: [cos(q2) = 0]", "singular", "wrong", ()),
        (ARM, f"  g: {OWN_G}\n  equilibria: [sin(q1) = 0 and cos(q1 + q2) = 0]", "equilibria", "follows",
         ("g",)),
        (ARM, f"  g: {OWN_G}\n  equilibria: [q1 = 0 and q2 = pi/2]", "equilibria", "wrong", ()),
        (PENDULUM, '  P: m*g*l*cos(q1)\n  equilibria: "q1 = 0, pi"', "equilibria", "follows", ("P",)),
        (PENDULUM, '  g: [m*g*l*sin(q1)]\n  equilibria: "q1 = 0, pi"', "equilibria", "follows", ("g",)),
        (PENDULUM, '  g: [0]\n  equilibria: "q1 = 0"', "equilibria", "wrong", ()),
        (ARM, "  det: X_7\n  singular: [cos(q2) = 0]", "singular", "unreadable", ()),
        (ARM, "  det: X_7\n  singular: [sin(q2) = 0]", "singular", "correct", ()),
        (ARM, f"  det: {OWN_DET}\n  P: X_7\n  singular: [cos(q1) = 0]", "singular", "wrong", ()),
        (REDUNDANT, "  Jr: X_7\n  singular: [cos(q2) = 0]", "singular", "unreadable", ()),
        (REDUNDANT, "  det: l^4*sin(q2)^2\n  singular: [sin(q2) = 0]", "singular", "follows", ("det",)),
        (PENDULUM, '  P: X_7\n  equilibria: "q1 = 0, pi"', "equilibria", "unreadable", ()),
        (PENDULUM, '  P: X_7\n  g: [m*g*l*cos(q1)]\n  equilibria: "q1 = 0"', "equilibria", "wrong", ()),
    ],
)  # fmt: skip
def test_a_set_from_own_answers(
    problem: str, text: str, name: str, verdict: str, sources: tuple[str, ...]
) -> None:
    answer = judged(problem, text, name)
    assert (str(answer.verdict), answer.follows_from) == (verdict, sources)
    if verdict == "unreadable":
        assert "may follow from" in answer.fault
