"""Parameters that balance gravity: by hand, judged in other forms, and held in numbers."""

from __future__ import annotations

from pathlib import Path

import pytest

import dynsolve
from dynsolve.derivation.rules import derive
from dynsolve.errors import ProblemError, VerificationError
from dynsolve.explain.forms import Forms
from dynsolve.problem import read_problem
from dynsolve.questions.equilibria.check import verify_balance
from dynsolve.questions.equilibria.forms import EquilibriaForms
from dynsolve.render.files import Format
from dynsolve.solution.reports import report

ARM = """
gravity: [0, -g, 0]
dh: [{theta: q1*, a: l1}, {theta: q2*, a: l2}]
masses:
  - {mass: m1, link: 1, center: {near: [d1, 0, 0]}}
  - {mass: m2, link: 2, center: {near: [d2, 0, 0]}}
find: [balance]
"""
FRACTIONS = """
gravity: [0, -g, 0]
dh: [{theta: q1*, a: l1}, {theta: q2*, a: l2}]
masses: [{mass: m1, link: 1, center: {along: dc1}}, {mass: m2, link: 2, center: {along: dc2}}]
find: [balance]
"""
RIGID = ARM.replace("[d1, 0, 0]", "[l1/2, 0, 0]")


@pytest.mark.parametrize(
    ("problem", "conditions"),
    [
        (ARM, {"d2 = 0", "m1*d1 + m2*l1 = 0"}),
        (ARM.replace("[0, -g, 0]", "[0, 0, -g]"), set()),
        (FRACTIONS, {"dc2 = 0", "m1*dc1 + m2 = 0"}),
        (RIGID, {"d2 = 0", "l1 = 0"}),
        (ARM.replace("find:", "balance: {g: [m1*g*d1*cos(q1), 0]}\nfind:"), {"d2 = 0", "l1 = 0"}),
    ],
)
def test_by_hand(problem: str, conditions: set[str]) -> None:
    assert set(dynsolve.solve(problem).to_json()["results"]["balance"]) == conditions


@pytest.mark.parametrize(("problem", "is_possible"), [(ARM, True), (FRACTIONS, True), (RIGID, False)])
def test_what_asks_for_a_length_of_the_table_to_be_0_cannot_be(problem: str, is_possible: bool) -> None:
    (step,) = (step for step in dynsolve.solve(problem).steps if step.id == "balance")
    assert ("cannot hold" in str(step.outcome)) is not is_possible


def test_what_must_be_negative_is_told() -> None:
    """A counterweight: the mass centre of link 1 is behind its axis."""
    text = report(dynsolve.solve(ARM), Format.TEXT).decode()
    assert text.count("As masses and lengths of the table are positive, d₁ = -m₂ l₁/m₁ < 0.") == 2
    both = ARM.replace("[d1, 0, 0]", "[d1 - e1, 0, 0]")
    assert "lengths of the table are positive, d" not in report(dynsolve.solve(both), Format.TEXT).decode()


@pytest.mark.parametrize(
    ("problem", "written", "code"),
    [
        (FRACTIONS, "[dc2 = 0, m1*dc1 + m2 = 0]", ""),
        (FRACTIONS, "[l2*dc2 = 0, l1*(m1*dc1 + m2) = 0]", ""),
        (FRACTIONS, "[l2 = 0, m1*dc1 + m2 = 0]", "condition_too_much"),
        (RIGID, "[d2 = 0, l1 = 0]", ""),
        (ARM, '["d2 = 0", "m1*d1 + m2*l1 = 0"]', ""),
        (ARM, '["m2*d2 = 0 and d1 = -m2*l1/m1"]', ""),
        (ARM, "[d2 = 0]", "not_balanced"),
        (ARM, "[d2^2 + 1 = 0]", "balance_never_holds"),
        (ARM, "[d2 = 0, m1 = 0]", "balance_never_holds"),
        (ARM, '["d2 = 0", "m1*d1 + m2*l1 = 0", "m1 = m2"]', "condition_too_much"),
        (ARM, "[d2 = 0, d1 = 0]", "not_balanced"),
        (ARM, '["d2 = 0", "m1*d1 + m2*l1 = 0", "l2 = 1"]', "condition_too_much"),
    ],
)
def test_verdicts(problem: str, written: str, code: str, tmp_path: Path) -> None:
    (tmp_path / "problem.yaml").write_text(problem, encoding="utf-8")
    (tmp_path / "answer.yaml").write_text(f"answers:\n  balance: {written}\n", encoding="utf-8")
    (found,) = dynsolve.check(tmp_path / "problem.yaml", tmp_path / "answer.yaml").answers
    assert [one.code for one in found.diagnosis] == ([code] if code else [])
    assert str(found.verdict) == ("wrong" if code else "correct")


def test_the_check_finds_a_condition_that_is_missing() -> None:
    robot = read_problem(ARM).robot
    values = derive(robot)
    g, conditions = Forms(robot, values)("g"), EquilibriaForms(robot, values).balance
    verify_balance(robot, g, conditions)
    with pytest.raises(VerificationError):
        verify_balance(robot, g, conditions[:1])


def test_the_wanted_g_has_an_entry_for_each_coordinate() -> None:
    with pytest.raises(ProblemError, match="1 entries, for 2 coordinates"):
        read_problem(ARM.replace("find:", "balance: {g: [0]}\nfind:"))


SLOPE = """
gravity: [0, -g*sin(alpha), -g*cos(alpha)]
dh: [{d: q1*, alpha: 90deg}, {d: q2*, alpha: 90deg, theta: 90deg}, {d: q3*}]
masses: [{mass: m1, link: 1, center: origin}, {mass: m3, link: 3, center: origin}]
springs: [{stiffness: k, of: q2 - q3}]
find: [balance]
"""
IN_NUMBERS = """
gravity: [0, -9.81, 0]
dh: [{theta: q1*, a: 1}, {theta: q2*, a: 0.5}]
masses: [{mass: 2, link: 1}, {mass: 1, link: 2}]
find: [balance]
"""
LIFTED = """
gravity: [0, 0, -g]
dh: [{d: q1*}, {d: q2*}]
masses: [{mass: m, link: 1, center: origin}, {mass: m, link: 2, center: origin}]
springs: [{stiffness: k, of: q1}, {stiffness: k, of: q2, rest: d}]
find: [balance]
"""


@pytest.mark.parametrize(
    ("problem", "conditions", "said"),
    [
        (IN_NUMBERS, {"1 = 0"}, "is a number"),
        (SLOPE, {"cos(alpha) = 0", "sin(alpha) = 0", "k = 0"}, "exclude each other"),
        (LIFTED, {"m = 0", "k = 0"}, "cannot hold"),
    ],
)
def test_no_1_is_said_to_be_0(problem: str, conditions: set[str], said: str) -> None:
    solution = dynsolve.solve(problem)
    (step,) = (step for step in solution.steps if step.id == "balance")
    assert set(solution.to_json()["results"]["balance"]) == conditions
    assert said in str(step.outcome) and "1 = 0" not in solution.to_markdown()
