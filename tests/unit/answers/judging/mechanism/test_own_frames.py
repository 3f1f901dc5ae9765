"""Answers after a table in other frames are judged in these frames and coordinates."""

from __future__ import annotations

from math import pi

import numpy as np
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


def test_forces_and_reference_rates_that_an_answer_may_hold_are_there_too() -> None:
    """The key of the accelerations holds τ as symbols, that of Y_r the rates of a reference."""
    arm = ARM.replace("D, g, P", "D, qdd_forward, Yr, a")
    answers = {name: HAND_INS["from elsewhere"][name] for name in ("DH", "H2", "D")}
    report = checker(arm)(submission(answers))
    assert {one.name: one.verdict for one in report.answers if one.given} == dict.fromkeys(answers, "correct")


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
    own = next(TableJudge(problem).own_problems(table), None)
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


# What is asked in the student's own frames, of arms with all that moves with the coordinates: a body
# whose axes are given from the base, joints driven from afar, forces, a task and a state in coordinates.
FROM_BASE = """
dh: [{theta: q1*, d: h, alpha: 90deg}, {theta: q2*, a: l2}]
masses:
  - {mass: m1, link: 1, center: origin, inertia: {zz: I1}, axes: {base: Rz(q1)}}
  - {mass: m2, link: 2, center: {near: [lc2, 0, 0]}, inertia: {yy: I2}, axes: {base: [
      [cos(q1)*cos(q2), -sin(q1), -cos(q1)*sin(q2)], [sin(q1)*cos(q2), cos(q1), -sin(q1)*sin(q2)],
      [sin(q2), 0, cos(q2)]]}}
find: [DH, D, g, K, P]
"""
REMOTE = """
gravity: [0, -g, 0]
dh: [{theta: p1*, a: l1}, {theta: p2* - p1*, a: l2}]
masses:
  - {mass: m1, link: 1, center: {near: [lc1, 0, 0]}, inertia: {zz: I1}}
  - {mass: m2, link: 2, center: {near: [lc2, 0, 0]}, inertia: {zz: I2}}
find: [DH, D, g, K, P]
"""
LOADED = """
dh: [{theta: q1*, d: h, alpha: 90deg}, {theta: q2*, a: l2}, {theta: q3*, a: l3}]
masses: [{mass: m3, link: 3, center: {along: 1/2}}]
points: {A: {link: 2, at: {along: 1/2}}}
task: [tip.x, tip.z, q2 + q3]
velocity: [0, sin(q1), 1]
forces:
  - {link: 3, at: tip, force: [Fx, Fy, -cos(q2)], moment: [0, 0, M]}
  - {link: 2, at: {along: 1/2}, force: [0, N, 0], in: link}
find: [DH, r, Jr, Jr_dot, det, qd, pA, JvA, Q, tau_static, D, g]
"""
SPRUNG = """
gravity: [0, -g, 0]
dh: [{theta: q1*, a: l1}, {theta: q2*, a: l2}]
masses: [{mass: m1, link: 1}, {mass: m2, link: 2}]
friction: {q2: {viscous: fv, coulomb: fc}}
springs: [{stiffness: k, of: q2 - q1, rest: delta}]
motors: [{turns: q2, inertia: Im, ratio: kr}]
find: [DH, D, g]
"""
CRAIG = """
convention: modified
gravity: [0, -g, 0]
dh: [{theta: q1*}, {theta: q2*, a: l1}, {a: l2}]
masses: [{mass: m1, link: 1, center: [lc1, 0, 0]}, {mass: m2, link: 2, center: [lc2, 0, 0]}]
find: [DH, D, g]
"""
OTHER: dict[str, tuple[str, list[list[str]], dict[str, tuple[int, float]]]] = {
    # problem, table, the key's coordinates in the student's: q = sense q' + shift
    "axes from the base": (
        FROM_BASE, [["q1 + 90deg", "0", "0", "-90deg"], ["q2 - 90deg", "0", "l2", "0"]],
        {"q2": (-1, pi / 2)}),
    "driven from afar": (
        REMOTE, [["p1 + 90deg", "0", "l1", "0"], ["p2 - p1", "0", "l2", "0"]], {}),
    "driven from afar, the other way": (
        REMOTE, [["p1", "0", "l1", "180deg"], ["p1 - p2 + 90deg", "0", "l2", "0"]], {"p2": (1, -pi / 2)}),
    "springs, friction and a motor": (
        SPRUNG, [["q1", "0", "l1", "180deg"], ["q2 + 90deg", "0", "l2", "0"]], {"q2": (-1, -pi / 2)}),
    "the modified convention, z_1 turned over": (
        CRAIG, [["q1", "0", "0", "180deg"], ["q2", "0", "l1", "180deg"], ["0", "0", "l2", "0"]],
        {"q1": (-1, 0)}),
    "a task and forces": (
        LOADED, [["q1", "h", "0", "-90deg"], ["q2 - 90deg", "0", "l2", "0"], ["q3", "0", "l3", "180deg"]],
        {"q2": (-1, pi / 2), "q3": (-1, 0)}),
}  # fmt: skip
"""θ_1 + 90° of the arm that is driven from afar turns frame 0 alone: its coordinates are the key's."""


@pytest.mark.parametrize(("text", "table", "keys"), OTHER.values(), ids=OTHER)
def test_the_same_arm_in_other_frames(text: str, table: list[list[str]], keys: dict[str, str]) -> None:
    """Energies are the same at the same place; forces and D as the coordinates turn."""
    problem = read_problem(text)
    own = next(TableJudge(problem).own_problems(answer("DH", table)))
    ours, theirs = dynsolve.solve(own).to_json()["results"], dynsolve.solve(problem).to_json()["results"]
    names = [q.name for q in problem.robot.coordinates]
    mine = {name: 0.37 + 0.21 * k for k, name in enumerate([*problem.robot.parameters, *names])}
    there = mine | {name: sense * mine[name] + shift for name, (sense, shift) in keys.items()}
    senses = np.array([keys.get(name, (1, 0))[0] for name in names])
    D = np.array(numbers(theirs["D"], there)) * np.outer(senses, senses)
    assert_close(numbers(ours["D"], mine), D, "D")
    for name in {"g", "Q", "tau_static"} & theirs.keys():
        forces = np.array(numbers(theirs[name], there)).ravel() * senses
        assert_close(np.array(numbers(ours[name], mine)).ravel(), forces, name)


UPRIGHT = """
gravity: [0, -g, 0]
dh: [{theta: q1*, a: l1}, {theta: q2*, a: l2}]
masses: [{mass: m1, link: 1}, {mass: m2, link: 2}]
task: [tip.x, tip.y]
find: [DH, H1, r, g]
"""
BELOW: Text = [["l1*sin(q1) + l2*sin(q1 + q2)"], ["-l1*cos(q1) - l2*cos(q1 + q2)"]]
AS_DRAWN: Text = [["l1*cos(q1) + l2*cos(q1 + q2)"], ["l1*sin(q1) + l2*sin(q1 + q2)"]]
FROM_BELOW: list[list[str]] = [["q1 - 90deg", "0", "l1", "0"], ["q2", "0", "l2", "0"]]


@pytest.mark.parametrize(
    ("r", "g2"),
    [
        (BELOW, "m2*g*l2*sin(q1 + q2)"),  # q1 is counted from below, x_0 kept
        (BELOW, "m2*g*l2*cos(q1 + q2)"),  # x_0 points up, q1 is the key's
        (AS_DRAWN, "m2*g*l2*cos(q1 + q2)"),  # x_0 points up, positions seen as drawn
    ],
)
def test_a_table_may_be_meant_in_two_ways(r: Text, g2: str) -> None:
    """θ_1 - 90°: joint 1 counted from elsewhere, or frame 0 turned."""
    report = checker(UPRIGHT)(submission({"DH": FROM_BELOW, "r": r, "g2": g2}))
    given = {a.name: str(a.verdict) for a in report.answers if a.given}
    assert given == dict.fromkeys(("DH", "r", "g2"), "correct")


def test_a_wrong_sign_is_wrong_in_every_way() -> None:
    report = checker(UPRIGHT)(submission({"DH": FROM_BELOW, "g2": "-m2*g*l2*sin(q1 + q2)"}))
    assert report.first_wrong == "g2"
