"""Answers after a table in other frames are judged in these frames and coordinates."""

from __future__ import annotations

from math import pi

import pytest

import dynsolve
from dynsolve.answers.table_verdict import TableJudge
from dynsolve.problem import read_problem
from tests.support import assert_close, numbers
from tests.unit.answers.hands import Text, answer, checker, submission

# A waist and a shoulder; lengths from the floor
ARM = """
dh:
  - {theta: q1*, d: h, a: 0, alpha: 90deg}
  - {theta: q2*, a: l2}
masses:
  - {mass: m1, link: 1, center: origin, inertia: {yy: I1}}
  - {mass: m2, link: 2, center: {near: [lc2, 0, 0]}, inertia: {yy: I2}, axes: base}
find: [DH, H2, D, g, P]
"""
D_LEVEL: Text = [["I1 + m2*lc2^2*cos(q2)^2", "0"], ["0", "m2*lc2^2 + I2"]]

HAND_INS: dict[str, dict[str, Text]] = {
    # θ_2 from the vertical: q2 = 0 points up
    "from elsewhere": {
        "DH": [["q1", "h", "0", "90deg"], ["q2 + 90deg", "0", "l2", "0"]],
        "H2": [["-cos(q1)*sin(q2)", "-cos(q1)*cos(q2)", "sin(q1)", "-l2*cos(q1)*sin(q2)"],
               ["-sin(q1)*sin(q2)", "-sin(q1)*cos(q2)", "-cos(q1)", "-l2*sin(q1)*sin(q2)"],
               ["cos(q2)", "-sin(q2)", "0", "h + l2*cos(q2)"], ["0", "0", "0", "1"]],
        "D": [["I1 + m2*lc2^2*sin(q2)^2", "0"], ["0", "m2*lc2^2 + I2"]],
        "g": [["0"], ["-m2*lc2*g*sin(q2)"]],
    },
    # z_1 the other way, frame 0 in the shoulder: q2 counts downwards, heights from the shoulder
    "the other way, from the shoulder": {
        "DH": [["q1", "0", "0", "-90deg"], ["q2", "0", "l2", "0"]],
        "H2": [["cos(q1)*cos(q2)", "-cos(q1)*sin(q2)", "-sin(q1)", "l2*cos(q1)*cos(q2)"],
               ["sin(q1)*cos(q2)", "-sin(q1)*sin(q2)", "cos(q1)", "l2*sin(q1)*cos(q2)"],
               ["-sin(q2)", "-cos(q2)", "0", "-l2*sin(q2)"], ["0", "0", "0", "1"]],
        "D": D_LEVEL,
        "g": [["0"], ["-m2*lc2*g*cos(q2)"]],
        "P": "-m2*g*lc2*sin(q2)",
    },
    # x_0 to the side
    "frame 0 turned": {
        "DH": [["q1 + 90deg", "h", "0", "90deg"], ["q2", "0", "l2", "0"]],
        "H1": [["-sin(q1)", "0", "cos(q1)", "0"], ["cos(q1)", "0", "sin(q1)", "0"],
               ["0", "1", "0", "h"], ["0", "0", "0", "1"]],
        "D": D_LEVEL,
        "g": [["0"], ["m2*lc2*g*cos(q2)"]],
    },
}  # fmt: skip


@pytest.mark.parametrize("answers", HAND_INS.values(), ids=HAND_INS)
def test_what_follows_is_right_in_the_students_own_frames(answers: dict[str, Text]) -> None:
    report = checker(ARM)(submission(answers))
    given = {answer.name: answer.verdict for answer in report.answers if answer.given}
    assert given == dict.fromkeys(answers, "correct")
    assert report.first_wrong == ""


def test_without_the_table_they_are_wrong() -> None:
    answers = {name: value for name, value in HAND_INS["from elsewhere"].items() if name != "DH"}
    verdicts = {a.name: a.verdict for a in checker(ARM)(submission(answers)).answers if a.given}
    assert verdicts["H2"] == "wrong" and "correct" not in (verdicts["D"], verdicts["g"])


def test_a_slip_is_still_wrong_in_ones_own_frames() -> None:
    answers = HAND_INS["from elsewhere"] | {"g": [["0"], ["m2*lc2*g*sin(q2)"]]}
    report = checker(ARM)(submission(answers))
    assert report.first_wrong == "g"


def test_what_is_right_in_the_keys_frames_stays_right() -> None:
    answers = HAND_INS["from elsewhere"] | {"g": [["0"], ["m2*lc2*g*cos(q2)"]]}
    assert checker(ARM)(submission(answers)).first_wrong == ""


def test_the_robot_in_other_frames_has_the_same_inertia_and_energy() -> None:
    """With q₁' = q₁ and q₂' = 90° - q₂: z_1 points the other way, and θ_2 starts from the vertical."""
    problem = read_problem(ARM)
    table = answer("DH", [["q1", "h", "0", "-90deg"], ["q2 - 90deg", "0", "l2", "180deg"]])
    own = TableJudge(problem).own_problem(table)
    assert own is not None
    ours, theirs = dynsolve.solve(own).to_json()["results"], dynsolve.solve(problem).to_json()["results"]
    values = {
        "h": 0.7,
        "l2": 0.9,
        "lc2": 0.4,
        "m1": 2.0,
        "m2": 3.0,
        "I1": 0.3,
        "I2": 0.2,
        "g": 9.81,
        "q1": 0.4,
    }
    mine, keys = values | {"q2": 1.1}, values | {"q2": pi / 2 - 1.1}
    assert_close(numbers(ours["D"], mine), numbers(theirs["D"], keys), "D")
    assert_close(numbers(ours["P"], mine), numbers(theirs["P"], keys), "P")
