"""Steps of the inverse kinematics of a pose: what they begin with, where it is singular, hints."""

from __future__ import annotations

import pytest

from dynsolve import solve
from dynsolve.explain.step import Step
from dynsolve.render.terminal import render

ELBOW = """
dh: [{theta: q1*, d: d1, alpha: 90deg}, {theta: q2*, a: a2}, {theta: q3*, alpha: 90deg},
     {theta: q4*, d: d4, alpha: -90deg}, {theta: q5*, alpha: 90deg}, {theta: q6*, d: d6}]"""
PARALLEL = """
dh: [{theta: q1*, d: d1, alpha: 90deg}, {theta: q2*, a: a2}, {theta: q3*, a: a3},
     {theta: q4*, d: d4, alpha: 90deg}, {theta: q5*, d: d5, alpha: -90deg}, {theta: q6*, d: d6}]"""
ASKED = "\ngravity: none\ntask: pose\nfind: [inverse]\n"


def told(table: str) -> dict[str, Step]:
    return {step.id: step for step in solve(table + ASKED).explain(["inverse"])}


def words(step: Step) -> str:
    return "".join(part for part in step.why if isinstance(part, str))


# (the arm, the steps that say what the others start from, what is said in the first)
BEGINNINGS = [
    (ELBOW, ["point_1", "turn_2"], "joints 4, 5 and 6 meet in one point"),
    (PARALLEL, ["parallel_1", "point_1", "turn_2", "point_2", "turn_3"], "joints 2, 3 and 4 are parallel"),
]


@pytest.mark.parametrize(("table", "beginnings", "said"), BEGINNINGS)
def test_what_the_steps_start_from(table: str, beginnings: list[str], said: str) -> None:
    steps = told(table)
    found = [name for name in steps if name.startswith(("inverse_point", "inverse_turn", "inverse_parallel"))]
    assert found == [f"inverse_{name}" for name in beginnings]
    assert said in words(steps[found[0]])


def test_a_singular_wrist_is_told() -> None:
    notes = [str(note) for note in told(ELBOW)["inverse_q4"].notes]
    assert any("the wrist is singular" in note for note in notes)


def test_a_hint_says_how_it_falls_into_parts_and_gives_no_result() -> None:
    solution = solve(ELBOW + ASKED)
    text = "\n".join(line.text for line in render(solution.hint("inverse"), 200, solution.style))
    assert "The wrist centre" in text
    assert "The rotation of the wrist" in text
    assert "x_c" not in text
    assert "r₁₃" not in text
