"""Configurations that are to reach numbers: exact, rounded, in degrees, too few, none."""

from __future__ import annotations

import pytest

from dynsolve.answers.judge import check
from dynsolve.answers.reading.files import FileReader
from dynsolve.answers.verdict import JudgedAnswer
from dynsolve.problem import read_problem

TWO_LINKS = """
gravity: none
dh: [{theta: q1*, a: l1}, {theta: q2*, a: l2}]
values: {l1: 2, l2: 1}
find: [inverse]
"""


def judged(reach: str, value: str, more: str = "") -> JudgedAnswer:
    read = read_problem(f"{TWO_LINKS}reach: {reach}\n{more}", "own.yaml")
    report = check(read, FileReader(read)(f"{value}\n", "answer.yaml"))
    return next(answer for answer in report.answers if answer.name == "inverse")


# (the target, the configurations, the verdict, the notes or the code of the slip)
ANSWERS = [
    ("[1, 2]", "[{q1: 'atan2(3, 4)', q2: pi/2}, {q1: 90deg, q2: -90deg}]", "correct", []),
    ("[1, 2]", "[{q2: '±acos((5 - l1^2 - l2^2)/(2*l1*l2))', q1: 'atan2(2, 1) - atan2(l2*s2, l1 + l2*c2)'}]",
     "correct", []),
    ("[1, 2]", "[{q1: 90deg, q2: 270deg}, {q1: 'acos(0.8)', q2: 'asin(1)'}]", "correct", []),
    ("[1, 2]", "[{q1: 0.644, q2: 1.571}, {q1: 1.571, q2: -1.571}]", "correct", ["rounded"]),
    ("[1, 2]", "[{q1: 36.87deg, q2: 90deg}]", "correct", ["incomplete", "rounded"]),
    ("[1, 2]", "[[36.87, 90], [90, -90]]", "correct", ["in_degrees", "rounded"]),
    ("[1, 2]", "[0.644, 1.571]", "correct", ["incomplete", "rounded"]),
    ("[1, 2]", "[{q1: 0.64, q2: 1.571}]", "wrong", ["target_missed"]),
    ("[1, 2]", "[{q1: 0.645, q2: 1.571}]", "wrong", ["target_missed"]),
    ("[1, 2]", "[{q1: 'atan2(4, 3)', q2: pi/2}]", "wrong", ["atan2_order"]),
    ("[1, 2]", "[{q1: 'acos(2)', q2: pi/2}]", "wrong", ["branch_not_real"]),
    ("[1, 2]", "[{q1: pi/2}]", "wrong", ["branch_lacks_coordinate"]),
    ("[1, 2]", "[]", "wrong", ["is_reachable"]),
    ("[1, 5]", "[]", "correct", []),
    ("[1, 5]", "none", "correct", []),
    ("[1, 5]", "[{q1: 0, q2: 0}]", "wrong", ["out_of_reach"]),
]  # fmt: skip


@pytest.mark.parametrize(("reach", "value", "verdict", "said"), ANSWERS)
def test_configurations(reach: str, value: str, verdict: str, said: list[str]) -> None:
    answer = judged(reach, f"answers:\n  inverse: {value}")
    assert answer.verdict == verdict, (answer.fault, answer.diagnosis)
    assert (list(answer.notes) if verdict == "correct" else [one.code for one in answer.diagnosis]) == said


def test_every_configuration_where_all_are_asked_for() -> None:
    answer = judged("[1, 2]", "answers:\n  inverse: [{q1: pi/2, q2: -pi/2}]", "branches: all")
    assert (answer.verdict, answer.diagnosis[0].code) == ("wrong", "branches_missing")


def test_an_atan2_that_takes_x_first() -> None:
    answer = judged("[1, 2]", "atan2: xy\nanswers:\n  inverse: [{q1: 'atan2(4, 3)', q2: pi/2}]")
    assert answer.verdict == "correct"


def test_a_free_coordinate_may_be_left_out_or_be_anything() -> None:
    text = TWO_LINKS.replace("l1: 2", "l1: 1") + "reach: [0, 0]\n"
    read = read_problem(text, "own.yaml")
    for value in ("[{q2: pi}]", "[{q1: 0.3, q2: pi}]"):
        (answer,) = check(read, FileReader(read)(f"answers:\n  inverse: {value}\n", "answer.yaml")).answers
        assert answer.verdict == "correct", value


THREE_LINKS = """
gravity: none
dh: [{theta: q1*, a: 1}, {theta: q2*, a: 1}, {theta: q3*, a: 1}]
reach: [1, 1]
find: [inverse]
"""
# (a configuration, the verdict, the notes or the slip); with q1 = 0 two links lead from (1, 0) to (1, 1)
REDUNDANT = [
    ("[{q1: 0, q2: pi/6, q3: 2*pi/3}]", "correct", []),
    ("[{q1: 1.823, q2: -0.902, q3: -1.791}]", "correct", ["rounded"]),
    ("[{q1: 1.823, q2: -0.902, q3: -1.781}]", "wrong", ["target_missed"]),
    ("[]", "wrong", ["is_reachable"]),
]


@pytest.mark.parametrize(("value", "verdict", "said"), REDUNDANT)
def test_of_infinitely_many_any_is_right(value: str, verdict: str, said: list[str]) -> None:
    read = read_problem(THREE_LINKS, "own.yaml")
    (answer,) = check(read, FileReader(read)(f"answers:\n  inverse: {value}\n", "answer.yaml")).answers
    assert answer.verdict == verdict, (answer.fault, answer.diagnosis)
    assert (list(answer.notes) if verdict == "correct" else [one.code for one in answer.diagnosis]) == said
