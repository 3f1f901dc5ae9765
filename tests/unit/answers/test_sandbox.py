"""The net beneath: what goes over the limits is unreadable, and the others are judged."""

from __future__ import annotations

import time
from typing import Any

import pytest
from msgspec.structs import replace

from dynsolve.answers import limits
from dynsolve.answers.judge import Checker
from dynsolve.answers.verdict import Report, Submission
from dynsolve.derivation.rules import derive
from dynsolve.problem import read_problem
from tests.unit.answers.hands import answer, checker

G2 = "m2*lc2*g*cos(q1 + q2)"


def test_the_work_of_a_child_comes_back() -> None:
    assert limits.limited(lambda: [1, "two"], 2) == [1, "two"]


def test_an_error_of_a_child_is_raised() -> None:
    def fail() -> None:
        raise ValueError("of the child")

    with pytest.raises(ValueError, match="of the child") as raised:
        limits.limited(fail, 2)
    assert "in fail" in raised.value.__notes__[0]


def test_memory_has_a_limit() -> None:
    with pytest.raises(limits.Stopped):
        limits.limited(lambda: bytearray(3 << 30), 2)


def test_time_has_a_limit() -> None:
    def spin() -> None:
        while True:
            pass

    start = time.process_time()
    with pytest.raises(limits.Stopped):
        limits.limited(spin, 1)
    assert time.process_time() - start < 1


def test_the_answer_that_goes_over_is_unreadable_and_the_others_are_judged(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    real = Checker.__call__

    def heavy(self: Checker, submission: Submission) -> Report:
        if any(a.name == "P1" and a.node is not None for a in submission.answers):
            bytearray(3 << 30)
        return real(self, submission)

    monkeypatch.setattr(Checker, "__call__", heavy)
    hand = Submission("", "", "", (answer("P1", "0", 0), answer("g2", G2, 1)))
    report = limits.check_within(checker("planar-2r"), hand)
    found = {a.name: a for a in report.answers}
    assert (found["P1"].verdict, found["P1"].fault) == ("unreadable", limits.TOO_MUCH)
    assert found["g2"].verdict == "correct"


def test_a_report_comes_back_as_it_was_made() -> None:
    hand = Submission("", "", "", (answer("g2", "0", 0), answer("K", "m1*q1_dot", 1)))
    report = limits.check_within(checker("planar-2r"), hand)
    direct = checker("planar-2r")(hand)
    assert report == direct


PENDULUM = """
gravity: [0, -g, 0]
dh: [{theta: q1*, a: l}]
masses: [{mass: m, link: 1, shape: point, center: tip}]
find: [g1, D, equilibria]
"""


@pytest.mark.parametrize("name", ["D", "equilibria"])
def test_what_the_key_costs_is_not_counted_on_an_answer(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """What is asked for takes more than an answer may, and another answer is right."""
    problem = read_problem(PENDULUM)
    derived = derive(problem.robot)
    rule = derived.rules[name]

    def slowly(*values: Any) -> Any:
        start = time.process_time()
        while time.process_time() - start < 1:
            pass
        return rule.compute(*values)

    derived.rules[name] = replace(rule, compute=slowly)
    monkeypatch.setattr(limits, "SECONDS", 0.25)
    hand = Submission("", "", "", (answer("g1", "m*g*l*cos(q1)", 0),))
    report = limits.check_within(Checker(problem, derived), hand)
    assert {a.name: str(a.verdict) for a in report.answers} == {
        "g1": "correct",
        "D": "missing",
        "equilibria": "missing",
    }
