"""Configurations that reach a target in numbers: exact, each once, with what is free and what is not real."""

from __future__ import annotations

import math

import pytest

from dynsolve import solve
from dynsolve.derivation.rules import derive
from dynsolve.notation.python import to_python
from dynsolve.notation.tree import Relation, Symbol, names_in
from dynsolve.problem import read_problem
from dynsolve.questions.inverse.forms import InverseForms
from dynsolve.questions.inverse.target import TargetForms
from tests.support import solve_json

UNIT = "dh: [{theta: q1*, a: 1}, {theta: q2*, a: 1}]"
TWO = "dh: [{theta: q1*, a: l1}, {theta: q2*, a: l2}]\nvalues: {l1: 2, l2: 1}"
ELBOW = "dh: [{theta: q1*, d: 1, alpha: 90deg}, {theta: q2*, a: 1}, {theta: q3*, a: 1}]"
ORTHOGONAL = "dh: [{theta: q1*, a: 1, alpha: 90deg}, {theta: q2*, a: 1, alpha: 90deg}, {theta: q3*, a: 1}]"
POLAR = "dh: [{theta: q1* + 90deg, alpha: 90deg}, {d: d2*}]"
CROSSED = TWO.replace("]", ", {theta: q3*}]\npoints: {P: {link: 2}}\ntask: [P.x, P.y, q1 + q3]")
DIRECTED = UNIT.replace("]", ", {theta: q3*, a: 1}]\ntask: [tip.x, tip.y, q1 + q2 + q3]")


def target(text: str, reach: str, more: str = "") -> TargetForms:
    robot = read_problem(f"gravity: none\n{text}\nreach: {reach}\n{more}\nfind: [inverse]\n").robot
    found = InverseForms(robot, derive(robot)).target
    assert found is not None
    return found


WRIST = """
dh: [{theta: q1*, alpha: -90deg}, {theta: q2*, alpha: 90deg}, {theta: q3*}]
task: pose"""

# (the arm, the target, the configurations)
EXACT = [
    (TWO, "[1, l1]", "q1: atan2(3, 4), q2: pi/2 | q1: pi/2, q2: -pi/2"),
    (UNIT, "[sqrt(2), 0]", "q1: -pi/4, q2: pi/2 | q1: pi/4, q2: -pi/2"),
    (UNIT, "[2, 0]", "q1: 0, q2: 0"),
    (UNIT, "[2*cos(20deg), 2*sin(20deg)]", "q1: pi/9, q2: 0"),
    (UNIT, "[sqrt(2)*cos(20deg), sqrt(2)*sin(20deg)]", "q1: -5*pi/36, q2: pi/2 | q1: 13*pi/36, q2: -pi/2"),
    (TWO, "[cos(0), 2 + sin(0) - tan(0)]", "q1: atan2(3, 4), q2: pi/2 | q1: pi/2, q2: -pi/2"),
    (CROSSED, "[1, 2, 0]", "q1: atan2(3, 4), q2: pi/2, q3: atan2(-3, 4) | q1: pi/2, q2: -pi/2, q3: -pi/2"),
    (UNIT, "[0, 0]", "q2: pi"),
    (ELBOW, "[0, 0, 2]", "q2: pi/6, q3: 2*pi/3 | q2: 5*pi/6, q3: -2*pi/3"),
    (WRIST, "[0, 0, 0, 0, 0, 1, 0, 1, 0, -1, 0, 0]", "q1: 0, q2: pi/2, q3: 0 | q1: pi, q2: -pi/2, q3: pi"),
    (POLAR, "[3, 4]", "d2: 5, q1: atan2(4, 3) | d2: -5, q1: atan2(-4, -3)"),
    (
        DIRECTED,
        "[1 + 3/5, 1 + 4/5, atan2(4, 3)]",
        "q1: 0, q2: pi/2, q3: atan2(-3, 4) | q1: pi/2, q2: -pi/2, q3: atan2(4, 3)",
    ),
    (DIRECTED, "[1, 1, 60deg]", "q1: -pi/3, q2: 5*pi/6, q3: -pi/6 | q1: pi/2, q2: -5*pi/6, q3: 2*pi/3"),
]


@pytest.mark.parametrize(("arm", "reach", "wanted"), EXACT)
def test_configurations_are_exact(arm: str, reach: str, wanted: str) -> None:
    found = target(arm, reach)
    texts = [
        ", ".join(f"{name}: {to_python(one.formulas[name])}" for name in sorted(one.formulas))
        for one in found.configurations
    ]
    assert sorted(texts) == sorted(wanted.split(" | "))
    assert not found.is_searched


def test_on_the_boundary_two_branches_are_one() -> None:
    (one,) = target(UNIT, "[2, 0]").configurations
    assert (one.branches, one.free) == ((1, 2), ())


def test_what_may_be_anything_is_free() -> None:
    assert [one.free for one in target(UNIT, "[0, 0]").configurations] == [("q1",)]
    assert [one.free for one in target(ELBOW, "[0, 0, 2]").configurations] == [("q1",), ("q1",)]


def test_out_of_reach_says_what_is_not_real() -> None:
    found = target(UNIT, "[2, 1]")
    assert found.configurations == ()
    lost = [(one.branch, one.coordinate, one.function, to_python(one.argument)) for one in found.lost]
    assert lost == [(1, "q2", "acos", "3/2"), (2, "q2", "acos", "3/2")]


def test_without_a_closed_form_they_are_found_in_numbers() -> None:
    found = target(ORTHOGONAL, "[1, 1, 0.5]")
    assert found.branches is None and found.is_searched and not found.is_family
    assert len(found.configurations) == 2
    # the arm is symmetric about the plane of its first two axes: q3 changes its sign alone
    first, second = (one.numbers for one in found.configurations)
    assert math.isclose(first["q3"], -second["q3"], abs_tol=1e-9)
    for q in (first, second):
        radius = 1 + math.cos(q["q2"]) * (1 + math.cos(q["q3"]))
        x = math.cos(q["q1"]) * radius + math.sin(q["q1"]) * math.sin(q["q3"])
        assert math.isclose(x, 1, abs_tol=1e-9)
        assert math.isclose(math.sin(q["q2"]) * (1 + math.cos(q["q3"])), 0.5, abs_tol=1e-9)


def test_a_redundant_arm_has_infinitely_many() -> None:
    found = target(UNIT.replace("]", ", {theta: q3*, a: 1}]"), "[1, 1]")
    assert (found.configurations, found.is_family) == ((), True)


SIX_JOINTS = """
dh:
  - {theta: q1*, d: 1, alpha: 90deg}
  - {theta: q2*, a: 1}
  - {theta: q3*, alpha: 90deg}
  - {theta: q4*, d: 1, alpha: -90deg}
  - {theta: q5*, alpha: 90deg}
  - {theta: q6*, d: 1/2}
task: pose"""


def test_where_the_axes_of_a_wrist_are_one_line_an_angle_gives_another() -> None:
    """The hand points down below the elbow: with a vertical forearm q5 = 180°, facing it or turned round."""
    found = target(SIX_JOINTS, "[1, 0, 3/2, 1, 0, 0, 0, -1, 0, 0, 0, -1]")
    assert not found.is_searched
    one, other = (one for one in found.configurations if one.free)
    assert one.free == other.free == ("q4",)
    assert to_python(other.formulas["q1"]) == "pi"
    assert {name: to_python(formula) for name, formula in one.formulas.items()} == {
        "q1": "0", "q2": "0", "q3": "pi", "q5": "pi", "q6": "q4"
    }  # fmt: skip
    for q4 in (0.0, 0.4, -2.0):
        assert found.reaches({**one.numbers, "q4": q4, "q6": q4})
        assert not found.reaches({**one.numbers, "q4": q4, "q6": q4 + 0.1})


def test_eight_configurations_of_six_joints() -> None:
    found = target(SIX_JOINTS, "[1, 1, 3/2, 1, 0, 0, 0, 1, 0, 0, 0, 1]")
    assert len(found.configurations) == 8
    assert all(found.reaches(one.numbers) for one in found.configurations)


# (the ranges, which of the two configurations of [1, 2] lie outside: q1 = 36.87°, 90° and q2 = ±90°)
LIMITS = [
    ("{q1: [0, 45deg]}", [(), ("q1",)]),
    ("{q1: [0, 90deg], q2: [-pi/2, 0]}", [("q2",), ()]),
    ("{q2: [180deg, 300deg]}", [("q2",), ()]),
    ("{q1: [370deg, 400deg]}", [(), ("q1",)]),
]


@pytest.mark.parametrize(("limits", "outside"), LIMITS)
def test_limits_mark_and_remove_none(limits: str, outside: list[tuple[str, ...]]) -> None:
    found = target(TWO, "[1, 2]", f"limits: {limits}")
    assert [one.outside for one in found.configurations] == outside


def test_the_json_has_the_reason() -> None:
    solution = solve_json(f"gravity: none\n{UNIT}\nreach: [3, 0]\nfind: [inverse]\n")
    results = solution["results"]
    assert solution["values"]["results"]["inverse"] == results["inverse_decimals"] == []
    assert results["inverse_why"] == "No configuration reaches this: no branch is real."


def test_a_hint_does_not_tell_what_is_reached() -> None:
    reached = [
        f"gravity: none\n{UNIT}\nreach: {reach}\nfind: [inverse]\n"
        for reach in ("[1, 1]", "[2, 0]", "[3, 0]")
    ]
    hints = [solve(text).hint("inverse") for text in reached]
    assert hints[0] == hints[1] == hints[2]


def test_a_hint_does_not_tell_the_singular_configurations() -> None:
    """The elbow has two cases, two links have one: neither is told, nor how many there are."""
    for arm in (ELBOW, UNIT):
        text = repr(solve(f"gravity: none\n{arm}\nfind: [singular]\n").hint("singular").blocks[3:])
        assert "case 1" not in text and "likewise" not in text.lower() and "instead of" not in text


def test_an_angle_of_a_singular_wrist_is_free() -> None:
    """Its outer axes are one line: every q1 reaches the target with a q3 of its own."""
    found = target(WRIST, "[0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1]")
    (one,) = found.configurations
    assert one.free == ("q1",)
    assert one.numbers["q2"] == pytest.approx(0)
    assert to_python(one.formulas["q3"]) == "-q1"
    assert found.reaches(one.numbers)


def test_without_numbers_for_the_lengths_the_branches_are_those_of_names() -> None:
    text = "gravity: none\ndh: [{theta: q1*, a: a1}, {theta: q2*, a: a2}]\nreach: [1, 1]\nfind: [inverse]\n"
    found = solve(text)
    results = found.to_json()["results"]
    assert [set(branch) for branch in results["inverse"]] == [{"q1", "q2"}] * 2
    assert "r1" in results["inverse"][0]["q1"] and "inverse_decimals" not in results
    assert "a1 has none" in found.warnings[0].message


def test_three_turning_joints_without_a_closed_form_say_how_many_solutions_there_are() -> None:
    arm = """
gravity: none
dh:
  - {theta: q1*, d: d1, a: a1, alpha: 90deg}
  - {theta: q2*, d: d2, a: a2, alpha: 90deg}
  - {theta: q3*, a: a3}
find: [inverse]
"""
    (step,) = [step for step in solve(arm).steps if step.title == "No closed form was found"]
    assert "at most four configurations" in str(step.notes)


def test_in_numbers_each_value_stands_beside_the_formula_that_gives_it() -> None:
    """The coordinates come as they are solved for, and a sum of angles that is put in is said."""
    arm = """
gravity: none
dh: [{theta: q1*, a: l1}, {theta: q2*, a: l2}, {theta: q3*, a: l3}]
task: [tip.x, tip.y, q1 + q2 + q3]
values: {l1: 1, l2: 0.8, l3: 0.3}
reach: [1.1, 0.5, 40deg]
find: [inverse]
"""
    solution = solve(arm)
    steps = {step.id: step for step in solution.steps}
    members = [node.parts for node in steps["inverse_1"].result if isinstance(node, Relation)]
    assert [parts[0] for parts in members] == [Symbol("q2"), Symbol("q1"), Symbol("q3")]
    for name in ("inverse_q1", "inverse_q2"):
        told = names_in(*(part for part in steps[name].why if not isinstance(part, str)))
        assert {"q1", "q2", "q3", "r3"} <= told
    for parts in members:
        assert {"r1", "r3"} & names_in(parts[1]) and not {"r1", "r3"} & names_in(*parts[2:])


def test_a_rounded_length_in_the_table_has_its_sign_once() -> None:
    sliding = """
gravity: none
dh: [{d: q1*, theta: 0, alpha: -90deg}, {theta: q2*, a: l}, {theta: q3*, a: l}]
task: [tip.x, tip.z, q2 + q3]
values: {l: 2}
reach: [3, l, 60deg]
find: [inverse]
"""
    page = solve(sliding).to_latex()
    assert r"\approx 3.732" in page and r"\approx \approx" not in page


def test_a_model_in_numbers_keeps_all_digits_until_they_are_printed() -> None:
    """acos(-1/40) = 1.595799."""
    arm = "gravity: [0, -9.81, 0]\ndh: [{theta: q1*, a: 1/2}, {theta: q2*, a: 2/5}]\n"
    arm += "masses: [{mass: 2, link: 2}]\nreach: [3/5, 1/5]\nfind: [inverse]\n"
    assert "1.59580" in solve(arm).to_markdown()
