"""Conditions of branches, general branches beside numbers, exact angles: in the JSON and in words."""

from __future__ import annotations

import pytest

import dynsolve
from dynsolve import solve
from dynsolve.explain.step import Detail, Step
from dynsolve.notation.tree import Number, Symbol, equation
from dynsolve.notation.unicode import to_unicode
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
    (
        TWO.replace("l1", "l").replace("l2", "l"),
        "[tip.x, tip.y, q1 + q2]",
        ["r1**2 + r2**2 = 2*l*(r2*sin(r3) + r1*cos(r3))"],
    ),
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


def test_the_summary_has_the_conditions_and_what_is_free() -> None:
    slide = "base: Rx(90deg)\ndh: [{theta: 90deg, d: s1*, alpha: 90deg}, {theta: phi*, a: b}]"
    solution = solve(text(slide, "task: [tip.x, tip.z]\nreach: [X, Z]"))
    shown = " ".join(report(solution, Format.TEXT, detail=Detail.RESULTS).decode().split())
    assert "there are 2 solutions for each value of s₁ where -1 ≤ Z/b ≤ 1, which coincide on the" in shown
    assert "boundary, and none elsewhere. They hold where X = 0 alone" in shown
    assert "s₁ does not change the task, and may be anything." in shown


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
    (step,) = (step for step in solve(redundant).steps if step.title == "Infinitely many configurations")
    why = "The arm can move and keep the task: infinitely many configurations reach what is inside its reach."
    assert step.why == (why,)


def test_a_component_that_no_joint_moves_has_one_value_alone() -> None:
    rail = """
dh: [{d: q1*, alpha: 90deg}, {theta: q2*, a: l2}, {theta: q3*, a: l3}]
task: [tip.x, tip.y]
reach: [px, py]
find: [inverse]
"""
    (step,) = (step for step in solve(rail).steps if step.title == "Infinitely many configurations")
    assert any(part == equation(Symbol("py"), Number(0)) for part in step.why)


# -- what is told of an unknown, and of the rotation that is left ------------------------------------


def steps_of(text: str) -> dict[str, Step]:
    return {step.id: step for step in solve(f"gravity: none\n{text}\nfind: [inverse]\n").steps}


def lines_of(step: Step) -> list[str]:
    return [to_unicode(node) for node in step.result]


ANGLE_GIVEN = "dh: [{theta: q1*, a: l1}, {theta: q2*, a: l2}]\ntask: [tip.x, tip.y, q1]\n"


def test_an_angle_of_the_task_is_no_sum_and_stands_as_itself() -> None:
    """The direction of (cos r3, sin r3) is r3."""
    steps = steps_of(ANGLE_GIVEN)
    assert steps["inverse_q1"].why == ("The task gives this angle.",)
    assert lines_of(steps["inverse_q2"]) == ["q₂ = atan2(r₂ - l₁ sin(r₃), r₁ - l₁ cos(r₃)) - r₃"]


def test_one_solution_has_no_table_of_choices() -> None:
    steps = steps_of(f"{ANGLE_GIVEN}values: {{l1: 1, l2: 1}}\nreach: [1, 1, 0]")
    assert steps["inverse_branches"].table is None and steps["inverse"].table is not None


def test_two_angles_about_one_that_is_known_are_one_line() -> None:
    arm = "dh: [{theta: q1*, a: l1}, {theta: q2*, a: l2}, {theta: q3*, a: l3, from: 1}]\n"
    steps = steps_of(f"{arm}points: {{P: {{link: 2}}}}\ntask: [P.x, P.y, tip.x]")
    assert lines_of(steps["inverse_q3"]) == ["q₃ = -q₁ ± atan2(√(l₃² - (r₃ - l₁ cos(q₁))²), r₃ - l₁ cos(q₁))"]


FIVE = """dh: [{theta: q1*, a: l1}, {theta: q2*, a: l2, alpha: 90deg}, {theta: q3*, a: l3},
  {theta: q4*, alpha: 90deg}, {theta: q5*, d: d5}]
task: pose"""


def test_each_rotation_that_is_left_has_a_letter_of_its_own() -> None:
    first, second = (step for name, step in steps_of(FIVE).items() if name.startswith("inverse_turn"))
    assert to_unicode(first.working[0])[0] == "U" and to_unicode(second.working[0])[0] == "V"


def test_what_a_cosine_is_divided_by_must_not_be_0() -> None:
    needs, _ = steps_of(FIVE)["inverse_q2"].notes
    assert [to_unicode(part) for part in needs if not isinstance(part, str)] == ["l₂ + l₃ cos(q₃) ≠ 0"]


def test_conditions_that_are_the_pose_itself_are_not_written_out() -> None:
    *_, note = steps_of(FIVE)["inverse"].notes
    assert len(note) < 10 and note[0] == "They hold only where "


def test_a_task_of_a_multiple_of_an_angle_is_read() -> None:
    """q₁ - 2 q₂: half of it stands beside q₁/2 in the others."""
    arm = "gravity: none\ndh: [{theta: q1*, a: r}, {theta: q2*, a: s}]\n"
    for task in ("[tip.x, q1 - 2*q2]", "[tip.x, tip.y, q1 + 2*q2]"):
        assert solve_json(arm + f"task: {task}\nfind: [inverse, Jr]\n")["results"]["Jr"]


def test_an_angle_is_free_where_its_factors_and_what_they_give_are_0() -> None:
    """Two equal links folded back reach the height 0 however they are turned."""
    folded = """
gravity: none
dh: [{theta: q1*, a: L}, {theta: q2*, a: L}]
task: [tip.y, q2]
find: [inverse]
"""
    notes = [str(step.notes) for step in dynsolve.solve(folded).steps]
    assert any("is free: infinitely many" in note for note in notes)
    offset = """
gravity: none
dh: [{theta: q1*, alpha: 90deg}, {theta: q2*, a: L, d: e}]
task: [tip.x, tip.y]
find: [inverse]
"""
    assert not any("q₁ is free" in str(step.notes) for step in dynsolve.solve(offset).steps)


def test_a_condition_has_the_squares_of_the_vector_that_is_turned() -> None:
    """The wrist of two links is on a circle (by hand): its squares are not multiplied out."""
    arm = "gravity: none\ndh: [{theta: q1*, a: a}, {theta: q2*, a: b}]\n"
    asked = "task: [tip.x, tip.y, q1 + q2]\nreach: [x, y, phi]\nfind: [inverse]\n"
    told = dynsolve.solve(arm + asked).to_markdown()
    assert r"$(x - b \cos(\phi))^{2} + (y - b \sin(\phi))^{2} = a^{2}$ alone" in " ".join(told.split())
