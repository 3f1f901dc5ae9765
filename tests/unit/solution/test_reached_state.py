"""`state: reach`: what is asked at the configuration within the limits, held against the same state given."""

from __future__ import annotations

import pytest

import dynsolve
from dynsolve.answers.judge import check
from dynsolve.answers.reading.files import FileReader
from dynsolve.errors import ProblemError
from dynsolve.problem import read_problem

TWO_LINKS = """
gravity: [0, -g, 0]
dh: [{theta: q1*, a: l1}, {theta: q2*, a: l2}]
masses: [{mass: m1, link: 1, center: midpoint}, {mass: m2, link: 2, center: midpoint}]
velocity: [1, 0]
acceleration: [0, 0]
forces: [{link: 2, at: tip, force: [F, 0, 0]}]
find: [qd, qdd, Q, tau_static, lost]
"""
TARGET = TWO_LINKS + "values: {l1: 2, l2: 1}\nstate: reach\n"
POLAR = """
gravity: none
dh: [{theta: q1* + 90deg, alpha: 90deg}, {d: d2*}]
reach: [3, 4]
limits: {d2: [0, 10]}
state: reach
velocity: [vx, vy]
find: [qd]
"""


def results(text: str) -> dict[str, object]:
    return dynsolve.solve(text).to_json()["results"]


def test_it_is_the_state_itself() -> None:
    """[1, 2] is reached by q1 = 90°, q2 = -90°."""
    reached = results(TARGET + "reach: [1, 2]\nlimits: {q2: [-180deg, 0]}\n")
    given = results(TWO_LINKS + "state: {q1: 90deg, q2: -90deg}\n")
    assert all(reached[name] == given[name] for name in ("qd", "qdd", "Q", "tau_static", "lost"))


def test_an_angle_of_zero_is_exact() -> None:
    """[2, 1] is reached by q1 = 0, q2 = 90°."""
    reached = results(TARGET + "reach: [2, 1]\nlimits: {q2: [0, 180deg]}\n")
    given = results(TWO_LINKS + "state: {q1: 0, q2: 90deg}\n")
    assert all(reached[name] == given[name] for name in ("qd", "qdd", "Q", "tau_static", "lost"))


def test_an_angle_of_known_sine_is_exact() -> None:
    """In q1 = atan2(4, 3), d2 = 5 the hand moves by (c1 d2' - s1 d2 q1', s1 d2' + c1 d2 q1')."""
    assert results(POLAR)["qd"] == ["-0.04*(4*vx - 3*vy)", "(3*vx + 4*vy)/5"]


def test_answers_are_judged_there() -> None:
    problem = read_problem(POLAR, "own.yaml")
    for value, verdict in (("[(3*vy - 4*vx)/25, 0.6*vx + 0.8*vy]", "correct"), ("[0, vx]", "wrong")):
        (answer,) = check(problem, FileReader(problem)(f"answers:\n  qd: {value}\n", "answer.yaml")).answers
        assert answer.verdict == verdict


# (what is added to the file, what is wrong, the remedy)
FAULTS = [
    ("reach: [1, 2]\n", "2 configurations reach the target: {q1: atan2(3, 4), q2: pi/2} and", "limits"),
    ("reach: [1, 2]\nlimits: {q1: [0, 10deg]}\n", "no configuration within the limits", "find: [inverse]"),
    ("reach: [1, 5]\n", "no configuration within the limits", "find: [inverse]"),
]


@pytest.mark.parametrize(("more", "message", "help"), FAULTS)
def test_not_exactly_one_configuration_is_a_fault_at_the_state(more: str, message: str, help: str) -> None:
    text = TARGET + more
    with pytest.raises(ProblemError) as error:
        dynsolve.solve(text)
    (finding,) = error.value.findings
    assert (message in finding.message, help in finding.help) == (True, True), finding
    assert finding.excerpt == "state: reach"


def test_a_coordinate_that_is_free_leaves_no_state() -> None:
    text = TARGET.replace("l1: 2", "l1: 1") + "reach: [0, 0]\n"
    with pytest.raises(ProblemError, match="q1 may be anything"):
        dynsolve.solve(text)
