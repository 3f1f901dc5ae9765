"""Conditions of branches, general branches beside numbers, exact angles: in the JSON and in words."""

from __future__ import annotations

import pytest

from dynsolve import solve
from dynsolve.notation.tree import Number, Symbol
from dynsolve.render.files import Format
from dynsolve.solution.reports import report
from tests.support import solve_json

TWO = "dh: [{theta: q1*, a: l1}, {theta: q2*, a: l2}]"
ONE = "dh: [{theta: q1*, a: l1}]"

# (the arm, the task, the conditions of every branch)
CONDITIONS = [
    (TWO, "[tip.x, tip.y, tip.z]", ["r3 = 0"]),
    ("dh: [{theta: q1*, d: h, a: l1}]", "[tip.x, tip.y, tip.z]", ["r3 = h", "r1**2 + r2**2 = l1**2"]),
    (ONE, "[tip.x, tip.y]", ["r1**2 + r2**2 = l1**2"]),
    (ONE, "[tip.z]", ["r1 = 0"]),
    (TWO, "[tip.x, tip.x, tip.y]", ["r2 = r1"]),
    (TWO, "[q1, q2, q1 + q2]", ["r3 = r1 + r2"]),
    (TWO, "[tip.x, tip.y]", []),
]


def text(arm: str, more: str) -> str:
    return f"gravity: none\n{arm}\n{more}\nfind: [inverse]\n"


@pytest.mark.parametrize(("arm", "task", "conditions"), CONDITIONS)
def test_the_conditions(arm: str, task: str, conditions: list[str]) -> None:
    branches = solve_json(text(arm, f"task: {task}"))["results"]["inverse"]
    assert branches
    for branch in branches:
        found = branch.get("when", [])
        assert sorted(found) == sorted(conditions)


def test_a_condition_that_does_not_hold_is_the_reason() -> None:
    more = "task: [tip.x, tip.y, tip.z]\nvalues: {l1: 1, l2: 1}\nreach: [1, 1, 1/2]"
    solution = solve_json(text(TWO, more))
    assert solution["values"]["results"]["inverse"] == solution["results"]["inverse_decimals"] == []
    assert "no joint gives" in solution["results"]["inverse_why"]
    page = " ".join(report(solve(text(TWO, more)), Format.MARKDOWN).decode().split())
    assert "which does not hold here" in page and " hold where " in page


@pytest.mark.parametrize("reach", ["[1, 1]", "[px, py]"])
def test_with_numbers_the_branches_stay_in_letters(reach: str) -> None:
    names = ["px", "py"] if "p" in reach else ["r1", "r2"]
    values = "{l1: 1, l2: 1, px: 1, py: 1}" if "p" in reach else "{l1: 1, l2: 1}"
    solution = solve_json(text(TWO, f"values: {values}\nreach: {reach}"))
    general = str(solution["results"]["inverse"])
    assert all(name in general for name in ("l1", "l2", *names))
    assert solution["values"]["results"]["inverse"] == [
        {"q1": "0", "q2": "pi/2"},
        {"q1": "pi/2", "q2": "-pi/2"},
    ]


def test_an_angle_in_degrees_is_exact() -> None:
    more = "task: [q1 + q2, tip.x]\nvalues: {l1: 2, l2: 1}\nreach: [45deg, 1]"
    solution = solve_json(text(TWO, more))
    found = solution["values"]["results"]["inverse"]
    assert [one["q2"] for one in found] == ["pi/4 - q1"] * 2
    assert "0." not in str(found) + str(solution["results"]["inverse"])


def test_a_formula_has_no_text_among_words() -> None:
    with pytest.raises(TypeError, match="printer"):
        f"{Symbol('q1')}"
    with pytest.raises(TypeError, match="printer"):
        str(Number(1))
    why = next(s for s in solve(text(TWO, "")).steps if s.id == "inverse").why
    assert not any(isinstance(part, str) and "Letter" in part for part in why)


def test_an_arm_that_can_move_and_keep_its_task_is_said_to_have_infinitely_many_solutions() -> None:
    redundant = """
dh: [{theta: q1*, d: h, alpha: 90deg}, {theta: q2*, a: l2, alpha: 90deg}, {theta: q3*, a: l3, d: d3},
  {theta: q4*, a: l4}]
find: [inverse]
"""
    (step,) = (step for step in solve(redundant).steps if step.title == "No closed form")
    assert step.why == ("The arm can move and keep the task: infinitely many configurations reach it.",)
