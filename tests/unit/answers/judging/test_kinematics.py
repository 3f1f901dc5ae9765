"""Answers on points and the task: what is right, what follows, and rows of zeros of a planar robot."""

from __future__ import annotations

import pytest

from dynsolve.answers.judge import check
from dynsolve.answers.reading.files import FileReader
from dynsolve.problem import read_problem
from tests.unit.answers.hands import Text, judge, judged, verdicts

RRP = """
dh:
  - {theta: q1*, a: l1}
  - {theta: q2* + 90deg, alpha: 90deg}
  - {d: q3*}
points: {P: {link: 1, at: {near: [lc1, 0, 0]}}}
task: [tip.x, tip.y, q1 + q2]
find: [r, Jr, Jr_dot, J_dot, pP, vP, JvP, JwP]
"""
R = ["l1*cos(q1) + q3*cos(q1+q2)", "l1*sin(q1) + q3*sin(q1+q2)", "q1 + q2"]
JR = [
    ["-l1*sin(q1) - q3*sin(q1+q2)", "-q3*sin(q1+q2)", "cos(q1+q2)"],
    ["l1*cos(q1) + q3*cos(q1+q2)", "q3*cos(q1+q2)", "sin(q1+q2)"],
    ["1", "1", "0"],
]
ACROSS = [["lc1*cos(q1)"], ["lc1*sin(q1)"]]


@pytest.mark.parametrize(
    ("name", "text", "verdict"),
    [
        ("r", [[entry] for entry in R], "correct"),
        ("r", [R], "correct"),
        ("r", [[R[0]], [R[1]], ["q1"]], "wrong"),
        ("Jr", JR, "correct"),
        ("Jr", [*JR[:2], ["1", "0", "0"]], "wrong"),
        ("pP", ACROSS, "correct"),
        ("pP", [*ACROSS, ["0"]], "correct"),
        ("pP", [["l1*cos(q1)"], ["l1*sin(q1)"]], "wrong"),
        ("JvP", [["-lc1*sin(q1)", "0", "0"], ["lc1*cos(q1)", "0", "0"]], "correct"),
        ("JwP", [["1", "0", "0"]], "correct"),
        ("vP", [["-lc1*sin(q1)*q1_dot"], ["lc1*cos(q1)*q1_dot"]], "correct"),
        ("Jw_dot", [["0", "0", "0"]], "correct"),
    ],
)
def test_verdicts(name: str, text: Text, verdict: str) -> None:
    assert judged(RRP, name, text).verdict == verdict


CRAIG = """
convention: modified
dh: [{theta: q1*}, {theta: q2*, a: l1}, {a: l2}]
points: {E: {link: 3, at: origin, in: link}}
find: [JvE, JwE, vE]
"""
"""The planar arm of Craig, Introduction to Robotics (3rd ed.), examples 5.3 and 5.4."""


def test_a_jacobian_is_asked_for_along_the_axes_of_a_frame() -> None:
    there = [["l1*sin(q2)", "0"], ["l1*cos(q2) + l2", "l2"], ["0", "0"]]  # Craig (5.55) and (5.66)
    world = [
        ["-l1*sin(q1) - l2*sin(q1+q2)", "-l2*sin(q1+q2)"],
        ["l1*cos(q1) + l2*cos(q1+q2)", "l2*cos(q1+q2)"],
    ]
    v = [["l1*sin(q2)*q1_dot"], ["l1*cos(q2)*q1_dot + l2*(q1_dot + q2_dot)"], ["0"]]
    right = verdicts(judge(CRAIG, {"JvE": there, "JwE": [["1", "1"]], "vE": v}))
    assert set(right.values()) == {"correct"}
    found = judged(CRAIG, "JvE", [*world, ["0", "0"]])
    assert found.verdict == "wrong"
    assert [one.code for one in found.diagnosis] == ["tool_frame"]
    assert "seen from the world; it is asked for along the axes of frame 3" in found.diagnosis[0].message


def test_the_jacobian_and_its_rate_follow_from_a_task_that_is_wrong() -> None:
    wrong = [["l1*cos(q1)"], ["l1*sin(q1)"], ["q1"]]
    J = [["-l1*sin(q1)", "0", "0"], ["l1*cos(q1)", "0", "0"], ["1", "0", "0"]]
    rate = [["-l1*cos(q1)*q1_dot", "0", "0"], ["-l1*sin(q1)*q1_dot", "0", "0"], ["0", "0", "0"]]
    found = verdicts(judge(RRP, {"r": wrong, "Jr": J, "Jr_dot": rate}))
    assert (found["r"], found["Jr"], found["Jr_dot"]) == ("wrong", "follows", "follows")


def test_velocities_follow_from_the_jacobian_of_a_point() -> None:
    J = [["-l1*sin(q1)", "0", "0"], ["l1*cos(q1)", "0", "0"], ["0", "0", "0"]]
    v = [["-l1*sin(q1)*q1_dot"], ["l1*cos(q1)*q1_dot"], ["0"]]
    found = verdicts(judge(RRP, {"JvP": J, "vP": v}))
    assert (found["JvP"], found["vP"]) == ("wrong", "follows")


@pytest.mark.parametrize(
    ("written", "name"),
    [
        (r"\mathbf{r} = [l_1 c_1 + q_3 c_{12}, l_1 s_1 + q_3 s_{12}, q_1 + q_2]", "r"),
        (r"J_r = \begin{bmatrix} -l_1 s_1 - q_3 s_{12} & -q_3 s_{12} & c_{12} \\ "
         r"l_1 c_1 + q_3 c_{12} & q_3 c_{12} & s_{12} \\ 1 & 1 & 0 \end{bmatrix}", "Jr"),
        (r"p_P = [l_{c1} c_1, l_{c1} s_1, 0]", "pP"),
        (r"\dot{p}_P = [-l_{c1} s_1 \dot q_1, l_{c1} c_1 \dot q_1, 0]", "vP"),
        (r"J_{\omega_P} = \begin{bmatrix} 0&0&0\\0&0&0\\1&0&0 \end{bmatrix}", "JwP"),
        (r"\dot{J}_\omega = \begin{bmatrix} 0&0&0\\0&0&0\\0&0&0 \end{bmatrix}", "Jw_dot"),
    ],
)  # fmt: skip
def test_notations(written: str, name: str) -> None:
    problem = read_problem(RRP, "own.yaml")
    submission = FileReader(problem)(f"$${written}$$\n".encode(), "report.md")
    assert {a.name: a.verdict for a in check(problem, submission).answers if a.given} == {name: "correct"}


def test_without_questions_no_such_answer_exists() -> None:
    report = judge("planar-2r", {"Jr": [["1"]]})
    assert "no quantity of this problem" in next(a for a in report.answers if a.name == "Jr").fault


REACHING = """
dh: [{theta: q1*, a: l1}, {theta: q2*, a: l2}]
points: {A: {link: 1, at: tip}}
task: [tip.x, A.y, q1 + q2]
find: [r]
"""


@pytest.mark.parametrize("names", [("r_1", "r_2", "r_3"), ("x", "y_A", "r_3"), ("p_x", "p_{A,y}", "r_3")])
def test_components_of_the_task_may_be_written_alone(names: tuple[str, ...]) -> None:
    values = ("l_1 c_1 + l_2 c_{12}", "l_1 s_1", "q_1 + q_2")
    text = "\n\n".join(f"$${name} = {value}$$" for name, value in zip(names, values, strict=True))
    problem = read_problem(REACHING, "own.yaml")
    found = verdicts(check(problem, FileReader(problem)(text, "report.md")))
    assert found == {"r": "correct", "r1": "correct", "r2": "correct", "r3": "correct"}
