"""The inverse kinematics of the PUMA 560 as Craig prints it, judged as an answer: right, and all of it.

J. J. Craig, Introduction to Robotics, 3rd edition (2005), section 4.7, equations 4.67 to 4.87; the link
parameters are those of figure 3.21.
"""

from __future__ import annotations

from functools import cache
from itertools import product

import pytest

from dynsolve.answers.judge import Checker
from dynsolve.answers.verdict import JudgedAnswer
from dynsolve.problem import read_problem

PUMA = """
convention: modified
gravity: none
dh:
  - {theta: theta1*}
  - {alpha: -90deg, theta: theta2*}
  - {a: a2, theta: theta3*, d: d3}
  - {alpha: -90deg, a: a3, theta: theta4*, d: d4}
  - {alpha: 90deg, theta: theta5*}
  - {alpha: -90deg, theta: theta6*}
task: pose
reach: [px, py, pz, r11, r12, r13, r21, r22, r23, r31, r32, r33]
branches: all
find: [inverse]
"""

K = "((px^2 + py^2 + pz^2 - a2^2 - a3^2 - d3^2 - d4^2)/(2*a2))"
ANGLES = {
    "theta1": "atan2(py, px) - atan2(d3, {first}sqrt(px^2 + py^2 - d3^2))",
    "theta3": f"atan2(a3, d4) - atan2({K}, {{second}}sqrt(a3^2 + d4^2 - {K}^2))",
    "theta2": "atan2((-a3 - a2*c3)*pz - (c1*px + s1*py)*(d4 - a2*s3), "
    "(a2*s3 - d4)*pz + (a3 + a2*c3)*(c1*px + s1*py)) - theta3",
    "theta4": "atan2(-r13*s1 + r23*c1, -r13*c1*c23 - r23*s1*c23 + r33*s23){turned}",
    "theta5": "atan2(-(r13*(c1*c23*c4 + s1*s4) + r23*(s1*c23*c4 - c1*s4) - r33*s23*c4), "
    "-r13*c1*s23 - r23*s1*s23 - r33*c23)",
    "theta6": "atan2(-r11*(c1*c23*s4 - s1*c4) - r21*(s1*c23*s4 + c1*c4) + r31*s23*s4, "
    "r11*((c1*c23*c4 + s1*s4)*c5 - c1*s23*s5) + r21*((s1*c23*c4 - c1*s4)*c5 - s1*s23*s5) "
    "- r31*(s23*c4*c5 + c23*s5))",
}


@cache
def checker() -> Checker:
    return Checker(read_problem(PUMA, "puma.yaml"))


def judged(angles: dict[str, str], turned: tuple[str, ...] = ("", " + pi")) -> JudgedAnswer:
    signs = product(("", "-"), ("", "-"), turned)
    branches = [
        ", ".join(f"{name}: '{text.format(first=a, second=b, turned=c)}'" for name, text in angles.items())
        for a, b, c in signs
    ]
    written = "answers:\n  inverse:\n" + "".join(f"    - {{{branch}}}\n" for branch in branches)
    (answer,) = checker()(checker().reader(written, "answer.yaml")).answers
    return answer


def test_the_eight_published_solutions_are_right() -> None:
    answer = judged(ANGLES)
    assert (answer.verdict, answer.notes) == ("correct", ()), (answer.fault, answer.diagnosis)


def test_without_the_flipped_wrist_four_are_missing() -> None:
    answer = judged(ANGLES, ("",))
    assert [slip.code for slip in answer.diagnosis] == ["branches_missing"]


@pytest.mark.parametrize(
    ("angle", "right", "wrong"),
    [
        ("theta3", "- a3^2 - d3^2", "- a3^2 + d3^2"),
        ("theta4", "r33*s23", "r33*c23"),
        ("theta6", "c23*s5", "s23*s5"),
    ],
)
def test_a_slip_in_one_formula_is_seen(angle: str, right: str, wrong: str) -> None:
    slipped = ANGLES | {angle: ANGLES[angle].replace(right, wrong)}
    assert slipped != ANGLES
    assert [slip.code for slip in judged(slipped).diagnosis] == ["branch_misses"]
