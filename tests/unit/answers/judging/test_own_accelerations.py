"""Accelerations and multipliers that are written by other accelerations of the same motion."""

from __future__ import annotations

import pytest

from dynsolve.answers.answer_verdict import NOT_FOUND
from dynsolve.answers.judging.own_accelerations import BY_OTHERS, IN_A_CIRCLE
from dynsolve.answers.verdict import JudgedAnswer
from dynsolve.questions.constraints.judge import IN_MOTION, OTHER_SIDE
from tests.unit.answers.hands import Text, codes, judge, judged

ARM = """
gravity: none
dh: [{theta: q1*, a: l1}, {theta: q2*, a: l2}]
masses: [{mass: m1, link: 1}, {mass: m2, link: 2}]
find: [qdd_forward]
"""
FIRST = (
    "(l2*tau1 - (l2 + l1*cos(q2))*tau2 + m2*l1*l2*sin(q2)*(l2*(q1_dot+q2_dot)^2 + l1*cos(q2)*q1_dot^2))"
    "/(l1^2*l2*(m1 + m2*sin(q2)^2))"
)
SECOND = "tau2/(m2*l2^2) - l1*sin(q2)*q1_dot^2/l2 - (1 + l1*cos(q2)/l2)*q1_ddot"
BACK = "(tau2/(m2*l2^2) - l1*sin(q2)*q1_dot^2/l2 - q2_ddot)/(1 + l1*cos(q2)/l2)"
"""The second row of the equations of motion, solved for the one and for the other."""

DISK = """
gravity: [g*sin(beta), 0, 0]
model:
  coordinates: {x: prismatic, theta: revolute}
  bodies: [{mass: m, at: [x, 0, 0], turn: theta, inertia: {zz: m*R^2/2}}]
passive: [x, theta]
constraints: [x - R*theta]
find: [lambda, qdd_forward]
"""
ROLLS: dict[str, Text] = {"qdd_forward": [["2*g*sin(beta)/3"], ["2*g*sin(beta)/(3*R)"]]}


def accelerations(*rows: str) -> JudgedAnswer:
    return judged(ARM, "qdd_forward", [[row] for row in rows])


def test_one_acceleration_by_another_that_is_found() -> None:
    right = accelerations(FIRST, SECOND)
    assert right.verdict == "correct" and BY_OTHERS in right.notes


def test_accelerations_by_one_another_wait() -> None:
    circle = accelerations(BACK, SECOND)
    assert circle.waits and circle.fault == IN_A_CIRCLE


@pytest.mark.parametrize(
    ("rows", "verdicts", "told"),
    [
        ((FIRST, SECOND.replace("- l1", "+ l1")), [], ["equation"]),
        ((FIRST.replace("- (l2", "+ (l2"), SECOND), ["wrong", "correct"], None),
        ((BACK, SECOND.replace("- l1", "+ l1")), [], ["equation"]),
        (("q1_ddot + 1", "q2_ddot"), [], ["equation"]),
    ],
)
def test_no_slip_is_told_of_a_row_with_accelerations(
    rows: tuple[str, str], verdicts: list[str], told: list[str] | None
) -> None:
    wrong = accelerations(*rows)
    assert [str(entry.verdict) for entry in wrong.entries] == verdicts
    assert told is None or codes(wrong) == told


@pytest.mark.parametrize(
    ("value", "side"),
    [("-m*R*theta_ddot/2", ""), ("m*x_ddot - m*g*sin(beta)", ""), ("m*x_ddot/2", OTHER_SIDE)],
)
def test_multipliers_by_accelerations(value: str, side: str) -> None:
    alone, beside = judged(DISK, "lambda", value), judged(DISK, "lambda", value, **ROLLS)
    assert alone.waits and alone.fault == NOT_FOUND
    assert beside.verdict == "correct" and any(IN_MOTION in note for note in beside.notes)
    assert not side or any(side in note for note in beside.notes)


def test_wrong_multipliers_by_accelerations_miss_the_equations_of_motion() -> None:
    report = judge(DISK, {**ROLLS, "lambda": "m*R*theta_ddot/3"})
    wrong = next(a for a in report.answers if a.name == "lambda")
    assert wrong.verdict == "wrong" and codes(wrong) == ["equation"]
