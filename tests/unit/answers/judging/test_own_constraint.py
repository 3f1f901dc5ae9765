"""Answers about constraints: other forms of the same, and what belongs to the student's own matrix."""

from __future__ import annotations

from pathlib import Path

import pytest

import dynsolve
from dynsolve.questions.constraints.judge import ON_CONSTRAINT
from tests.unit.answers.hands import Text, judge, verdicts

LINE = """
gravity: none
dh: [{theta: q1* + 90deg, alpha: 90deg}, {d: q2*}]
masses: [{mass: m, link: 2, center: origin}]
constraints: [tip.x - k]
find: [Ac, Ac_dot, lambda]
"""
AC = [["-q2*sin(q1)", "cos(q1)"]]
RATE = [["-q2_dot*sin(q1) - q2*cos(q1)*q1_dot", "-sin(q1)*q1_dot"]]
FORCE = "(tau1*sin(q1)/q2 - f2*cos(q1))"
"""λ by hand: m q2² q̈1 + 2 m q2 q̇1 q̇2 = τ1 - q2 s1 λ and m q̈2 - m q2 q̇1² = f2 + c1 λ, with A q̈ + Ȧ q̇ = 0."""


@pytest.mark.parametrize(
    ("answers", "expected"),
    [
        ({"Ac": AC, "Ac_dot": RATE}, ["correct", "correct"]),
        ({"Ac": [["q2*sin(q1)", "-cos(q1)"]]}, ["correct"]),
        ({"Ac": [["-q2*tan(q1)", "1"]]}, ["correct"]),
        ({"Ac": [["-k*tan(q1)", "cos(q1)"]]}, ["correct"]),
        ({"Ac": [["q2*sin(q1)", "cos(q1)"]]}, ["wrong"]),
        ({"Ac": [["-q2*cos(q1)", "-sin(q1)"]]}, ["wrong"]),
        ({"Ac": [["0", "0"]]}, ["wrong"]),
        ({"Ac": [["-q2*sin(q1)", "sqrt(1 - sin(q1)^2)"]]}, ["wrong"]),
        ({"Ac": [["-k*sqrt(1/cos(q1)^2 - 1)", "cos(q1)"]]}, ["wrong"]),
        ({"Ac": [["-sqrt(q2^2 - k^2)", "cos(q1)"]]}, ["wrong"]),
        ({"Ac": [["-sqrt(q2^2)*sin(q1)", "cos(q1)"]]}, ["wrong"]),
        ({"Ac": [["q2*sin(q1)", "-cos(q1)"]],
          "Ac_dot": [["q2_dot*sin(q1) + q2*cos(q1)*q1_dot", "sin(q1)*q1_dot"]]}, ["correct", "correct"]),
        ({"Ac": [["-q2*tan(q1)", "1"]],
          "Ac_dot": [["-q2_dot*tan(q1) - q2*q1_dot/cos(q1)^2", "0"]]}, ["correct", "correct"]),
        ({"Ac": AC, "Ac_dot": [["-q2_dot*sin(q1)", "-sin(q1)*q1_dot"]]}, ["correct", "wrong"]),
    ],
)  # fmt: skip
def test_the_matrix_and_its_rate(answers: dict[str, Text], expected: list[str]) -> None:
    found = verdicts(judge(LINE, answers))
    assert [found[name] for name in answers] == expected


@pytest.mark.parametrize(
    ("matrix", "multiplier", "expected"),
    [
        (AC, FORCE, "correct"),
        ([["q2*sin(q1)", "-cos(q1)"]], f"-{FORCE}", "correct"),
        ([["-q2*tan(q1)", "1"]], f"cos(q1)*{FORCE}", "correct"),
        (AC, FORCE.replace("q2 -", "q2 +"), "wrong"),
        (AC, FORCE.replace("/q2", ""), "wrong"),
    ],
)
def test_the_multipliers_go_with_the_matrix(matrix: Text, multiplier: str, expected: str) -> None:
    found = verdicts(judge(LINE, {"Ac": matrix, "lambda": multiplier}))
    assert (found["Ac"], found["lambda"]) == ("correct", expected)


@pytest.mark.parametrize(
    ("more", "multiplier", "expected"),
    [
        ("", FORCE, "correct"),
        ("", f"[{FORCE}]", "correct"),
        ("  tau: [m*q2^2*q1_ddot + 2*m*q2*q1_dot*q2_dot, m*q2_ddot - m*q2*q1_dot^2]\n", FORCE, "correct"),
        ("", FORCE.replace("q2 -", "q2 +"), "wrong"),
    ],
)
def test_names_of_forces_are_inputs_in_what_is_handed_in(more: str, multiplier: str, expected: str) -> None:
    """Also beside an answer τ of the student's own, which holds accelerations."""
    report = dynsolve.check(LINE, f"answers:\n  lambda: {multiplier}\n{more}")
    assert verdicts(report)["lambda"] == expected


def test_a_coordinate_without_a_motor_has_no_input() -> None:
    report = dynsolve.check(f"{LINE}passive: [q1]\n", f"answers:\n  lambda: {FORCE}\n")
    assert verdicts(report)["lambda"] == "correct"


def test_what_holds_on_the_constraint_alone_is_told() -> None:
    """q2 cos q1 = k there, and so q̇2 = q2 tan(q1) q̇1."""
    rate = [["-k*q1_dot - q2_dot*sin(q1)", "-sin(q1)*q1_dot"]]
    (answer,) = [a for a in judge(LINE, {"Ac_dot": rate}).answers if a.name == "Ac_dot"]
    assert ON_CONSTRAINT in answer.notes


def test_the_names_of_forces_in_a_file_are_inputs(tmp_path: Path) -> None:
    hand_in = tmp_path / "answers.yaml"
    lines = ["tau: [m*q2^2*q1_ddot + 2*m*q2*q1_dot*q2_dot, m*q2_ddot - m*q2*q1_dot^2]", f"lambda: {FORCE}"]
    hand_in.write_text("".join(f"{line}\n" for line in ["answers:", *(f"  {one}" for one in lines)]))
    found = {answer.name: str(answer.verdict) for answer in dynsolve.check(LINE, hand_in).answers}
    assert (found["tau"], found["lambda"]) == ("correct", "correct")


TWICE = """
gravity: [0, -g, 0]
model:
  coordinates: {x: prismatic, y: prismatic}
  bodies: [{mass: m, at: [x, y, 0]}]
constraints: [x - y, 2*x - 2*y]
find: [lambda]
"""
"""m ẍ = f1 + λ1 + 2 λ2 and m ÿ + m g = f2 - λ1 - 2 λ2 with ẍ = ÿ: λ1 + 2 λ2 = -(f1 - f2 + m g)/2."""


@pytest.mark.parametrize(
    ("entries", "is_right"),
    [
        (["-(f1 - f2 + m*g)/2", "0"], True),
        (["0", "-(f1 - f2 + m*g)/4"], True),
        (["-(f1 - f2 + m*g)/2 - 2*x", "x"], True),
        (["-(f1 - f2 + m*g)/2", "-(f1 - f2 + m*g)/4"], False),
    ],
)
def test_of_multipliers_that_are_not_determined_each_that_balances_is_right(
    entries: list[str], is_right: bool
) -> None:
    (found,) = judge(TWICE, {"lambda": [[entry] for entry in entries]}).answers
    assert found.verdict == ("correct" if is_right else "wrong")
    told = [] if is_right else ["Your answer does not satisfy D q̈ + C q̇ + g = τ + A_cᵀ λ."]
    assert [one.message for one in found.diagnosis] == told
