"""Answers on forces at rest: what is right, what follows, whose name a bare tau is."""

from __future__ import annotations

import pytest

from dynsolve.answers.judge import check
from dynsolve.answers.judging.key_comparison import AT_STATE
from dynsolve.answers.reading.files import FileReader
from dynsolve.problem import read_problem
from tests.unit.answers.hands import Text, codes, judge, judged, verdicts

HELD = """
dh: [{theta: q1*, a: l1}, {theta: q2*, a: l2}]
forces: [{link: 2, force: [0, F, 0]}]
state: {q1: 90deg}
values: {l2: 0.5}
find: [Jv, Q, tau_static]
"""


@pytest.mark.parametrize(
    ("name", "entries", "verdict"),
    [
        ("Q", ["-F*l2*sin(q2)", "-F*l2*sin(q2)"], "correct"),
        ("Q", ["-F*sin(q2)/2", "-0.5*F*sin(q2)"], "correct"),
        ("Q", ["F*l2*sin(q2)", "F*l2*sin(q2)"], "wrong"),
        ("tau_static", ["F*l2*sin(q2)", "F*l2*sin(q2)"], "correct"),
        ("tau_static", ["-F*l2*sin(q2)", "-F*l2*sin(q2)"], "wrong"),
    ],
)
def test_verdicts(name: str, entries: list[str], verdict: str) -> None:
    assert judged(HELD, name, [[entry] for entry in entries]).verdict == verdict


def test_torques_follow_from_a_jacobian_that_is_wrong() -> None:
    J = [["-l1*sin(q1)", "0"], ["l1*cos(q1) + l2*cos(q2)", "l2*cos(q2)"], ["0", "0"]]
    Q = [["F*l2*cos(q2)"], ["F*l2*cos(q2)"]]
    held = [["-F*l2*cos(q2)"], ["-F*l2*cos(q2)"]]
    found = verdicts(judge(HELD, {"Jv": J, "Q": Q, "tau_static": held}))
    assert (found["Jv"], found["Q"], found["tau_static"]) == ("wrong", "follows", "follows")


def test_the_torque_of_a_robot_without_masses_is_the_one_that_holds_it() -> None:
    problem = read_problem(HELD, "own.yaml")
    text = b"$$\\tau = [F l_2 s_2, F l_2 s_2]$$\n"
    report = check(problem, FileReader(problem)(text, "report.md"))
    assert verdicts(report)["tau_static"] == "correct"


PLANAR = """
dh: [{theta: q1*, a: l1}, {theta: q2*, a: l2}]
task: [tip.x, tip.y, q1 + q2]
forces: [{link: 2, force: [0, F, 0], moment: [0, 0, M]}]
find: [Jv, Jr, Q]
"""


def test_forces_may_go_to_the_joints_by_the_jacobian_of_the_task() -> None:
    J = [["-l1*sin(q1)", "-l2*sin(q2)"], ["l1*cos(q1)", "l2*cos(q2)"], ["1", "1"]]
    found = verdicts(judge(PLANAR, {"Jr": J, "Q": [["F*l1*cos(q1) + M"], ["F*l2*cos(q2) + M"]]}))
    assert (found["Jr"], found["Q"]) == ("wrong", "follows")


def test_the_jacobian_of_the_task_may_be_made_of_rows_of_that_of_the_arm() -> None:
    J = [["-l1*sin(q1)", "-l2*sin(q2)"], ["l1*cos(q1)", "l2*cos(q2)"], ["0", "0"]]
    found = verdicts(judge(PLANAR.replace(", q1 + q2]", "]"), {"Jv": J, "Jr": J[:2]}))
    assert (found["Jv"], found["Jr"]) == ("wrong", "follows")


def test_entries_may_be_written_alone() -> None:
    problem = read_problem(HELD, "own.yaml")
    text = b"$$\\tau_1 = F l_2 s_2$$\n\n$$\\tau_2 = F l_2 s_2$$\n\n$$Q_1 = F l_2 s_2$$\n"
    found = verdicts(check(problem, FileReader(problem)(text, "report.md")))
    assert found["tau_static"] == "correct"
    assert found["Q1"] == "wrong"


AT_A_STATE = """
gravity: [0, -g, 0]
dh: [{theta: q1*, a: l}, {theta: q2*, a: l}]
masses: [{mass: m, link: 1, center: midpoint}, {mass: m, link: 2, center: midpoint}]
forces: [{link: 2, at: tip, force: [F, 0, 0]}]
state: {q1: 90deg, q2: -90deg}
velocity: [v, 0]
find: [Q, tau_static, qd]
"""


@pytest.mark.parametrize(
    ("name", "value", "verdict", "is_noted"),
    [
        ("Q", [["-F*l*(sin(q1) + sin(q1+q2))"], ["-F*l*sin(q1+q2)"]], "correct", True),
        ("Q", [["-F*l"], ["0"]], "correct", False),
        ("Q", [["F*l*(sin(q1) + sin(q1+q2))"], ["F*l*sin(q1+q2)"]], "wrong", False),
        ("tau_static", [["m*g*l*(3*cos(q1) + cos(q1+q2))/2 + F*l*(sin(q1) + sin(q1+q2))"],
                        ["m*g*l*cos(q1+q2)/2 + F*l*sin(q1+q2)"]], "correct", True),
        ("tau_static1", "m*g*l*(3*cos(q1) + cos(q1+q2))/2 + F*l*(sin(q1) + sin(q1+q2))", "correct", True),
        ("qd", [["v*cos(q1+q2)/(l*sin(q2))"], ["-v*(cos(q1) + cos(q1+q2))/(l*sin(q2))"]], "correct", True),
        ("qd", [["v*cos(q1+q2)/(l*cos(q2))"], ["0"]], "unreadable", False),
    ],
)  # fmt: skip
def test_the_state_may_be_put_in_by_the_reader(name: str, value: Text, verdict: str, is_noted: bool) -> None:
    found = judged(AT_A_STATE, name, value)
    assert found.verdict == verdict
    assert (AT_STATE in found.notes) == is_noted


def test_what_is_wrong_for_every_q_is_told_of_the_state() -> None:
    wrong = judged(AT_A_STATE, "Q", [["F*l*(sin(q1) + sin(q1+q2))"], ["F*l*sin(q1+q2)"]])
    assert [str(entry.verdict) for entry in wrong.entries] == ["wrong", "correct"]
    assert codes(wrong) == ["load_sign"] or codes(wrong) == ["sign_all"]
