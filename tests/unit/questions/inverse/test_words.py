"""What is said of the steps of inverse kinematics is true of this arm, and of what it is said."""

from __future__ import annotations

from unicodedata import normalize

import pytest

import dynsolve
from dynsolve.render.files import Format
from dynsolve.solution.reports import report


def told(arm: str) -> str:
    """The worked solution in one line."""
    text = report(dynsolve.solve(f"gravity: none\n{arm}\nfind: [inverse]\n"), Format.TEXT).decode()
    return " ".join(normalize("NFC", text).split())


def test_no_angle_is_free_where_its_sine_and_its_cosine_would_be_0() -> None:
    wrist = """
dh: [{theta: q1*, alpha: 45deg, d: d1}, {theta: q2*, alpha: -45deg}, {theta: q3*, d: e}]
task: pose"""
    text = told(wrist)
    assert "q₁ is free" in text and "q₃ is free" not in text


def test_an_equation_that_is_not_divided_by_what_may_vanish_is_taken_first() -> None:
    """Divided by cos q1 there would be no solution where r1 = 0, and there are."""
    text = told("dh: [{theta: q1*, a: l1}, {d: q2*, a: l2, alpha: 90deg}, {theta: q3*, a: l3}]")
    assert "arccos((r₂ s₁ + r₁ c₁ - l₁ - l₂)/l₃)" in text and "needs" not in text


def test_what_is_divided_by_stands_in_the_summary() -> None:
    arm = "dh: [{theta: q1*, a: l}, {d: q2*, theta: 90deg, alpha: 90deg}, {d: q3*}]\n"
    text = told(arm + "task: [tip.x + tip.y, q2*cos(q1), q3]")
    assert "q₂ = r₂/c₁ Note: This needs c₁ ≠ 0." in text
    assert "where a coordinate is free. The solutions need c₁ ≠ 0." in text.partition("Summary")[2]


def test_branches_that_are_one_because_an_angle_is_free_are_on_no_boundary() -> None:
    arm = "dh: [{theta: q1*, a: 0.5}, {d: q2*, a: 0.5, alpha: 90deg}, {theta: q3*, a: 2}]\n"
    text = told(arm + "reach: [0, 0, 0.2]")
    assert "Branches 1 and 3 with these numbers: they are one. q₃ =" in text


def test_an_arm_that_can_move_and_keep_its_task_is_not_said_to_have_four_configurations() -> None:
    text = told("dh: [{theta: q1*, alpha: 90deg}, {theta: q2*, alpha: -90deg}, {theta: q3*, a: l}]")
    assert "infinitely many configurations" in text and "at most four" not in text


def test_angles_that_are_found_in_numbers_are_rounded_in_the_table() -> None:
    arm = "dh: [{theta: q1*, a: 1, alpha: 90deg}, {theta: q2*, a: 1, alpha: 90deg}, {theta: q3*, a: 1}]\n"
    assert "1 ≈ 83.13° ≈ 77.32° ≈ 119.18° 2" in told(arm + "reach: [1, 1, 0.5]")


def test_a_component_that_stands_in_two_equations_is_one() -> None:
    text = told("dh: [{theta: q1*, alpha: 90deg, a: b}, {theta: q2*, d: c, a: l}]")
    assert "Component 3 of the task has no other unknown. Turning a vector" in text
    assert "subproblem 3). Two equations" in text


def test_what_always_is_and_what_never_is_are_no_conditions() -> None:
    """√(A² + B²) is real; s s2 + b c2 and s c2 - b s2 are 0 together only where s² + b² is."""
    shoulder = "dh: [{theta: q1*, a: l}, {theta: q2* + 90deg, alpha: 90deg}, {d: q3*}]\n"
    text = told(shoulder + "task: [tip.x, tip.y, q1]\nreach: [u, v, w]")
    assert "q₃ = ± √((u - l cos(w))² + (v - l sin(w))²)" in text and "has solutions where" not in text
    text = told("dh: [{theta: q1*, alpha: 45deg}, {theta: q2*, a: b, alpha: 90deg}, {d: q3*}]")
    assert "q₁ is free" not in text


@pytest.mark.parametrize(("offset", "is_free"), [("1", True), ("3", False), ("a2 + a3 + h", False)])
def test_a_task_that_no_configuration_reaches_frees_nothing(offset: str, is_free: bool) -> None:
    """x = y = 0 is on the axis of joint 1, which links of lengths 1 and 1 do not reach from 3 away."""
    lengths = ("a2", "a3") if "a2" in offset else ("1", "1")
    rows = [f"a: {offset}, alpha: 90deg", *(f"a: {length}" for length in lengths)]
    table = ", ".join(f"{{theta: q{k}*, {row}}}" for k, row in enumerate(rows, 1))
    text = told(f"dh: [{table}]\nreach: [x, y, z]")
    assert ("q₁ is free" in text) == is_free


def test_where_an_angle_is_free_nothing_is_divided_by_0_and_positive_lengths_are_positive() -> None:
    """2b + d2 and d2 are 0 for b = 0 alone; d3 s2 and d3 c2 for d3 = 0, by which was divided."""
    plane = "dh: [{theta: q1*, a: b}, {theta: 30deg, alpha: 90deg}, {d: d2*}]\ntask: [tip.x, tip.y]"
    assert "is free" not in told(plane)
    assert "is free" not in told("dh: [{theta: q1*, alpha: 45deg}, {theta: q2*, alpha: 90deg}, {d: q3*}]")


def test_the_sign_of_a_sine_stands_before_its_angle() -> None:
    text = told("dh: [{theta: q1*, a: l, alpha: 90deg}]\ntask: [-tip.y]\nreach: [u]")
    assert "q₁ = -arcsin(u/l) q₁ = π + arcsin(u/l)" in text


def test_no_square_of_a_number_stands_under_a_root() -> None:
    text = told("dh: [{theta: q1*, a: b, alpha: 30deg}, {d: q2*, alpha: 60deg}, {d: q3*}]\nreach: [u, v, w]")
    assert "q₃ = -q₂/2 ± √(u² + v² - b²) Note: This equation has solutions where u² + v² - b² ≥ 0" in text


def test_a_sum_over_a_number_has_one_denominator() -> None:
    arm = "dh: [{theta: q1*, d: 1, alpha: 90deg}, {theta: q2*, a: 2}, {theta: q3*, a: 1}]\n"
    assert "arccos((r₁² + r₂² - 4 - r₃ (2 - r₃))/4)" in told(arm)


def test_columns_of_a_rotation_are_at_right_angles_in_what_must_hold() -> None:
    """The last frame sees the origin at (x r11 + ..., x r13 + ...): c (r11 r13 + ...) is 0."""
    wrist = """
dh: [{theta: q1*, alpha: -90deg}, {theta: q2*, alpha: 90deg, d: b}, {theta: q3*, a: c}]
task: pose"""
    assert "z - r₃₁ c = 0, x r₁₃ + y r₂₃ + z r₃₃ = 0, x =" in told(wrist)


def test_what_special_parameters_alone_make_0_is_divided_by_before_a_square_has_two_values() -> None:
    """r₃ = d₂ cos α says which sign d₂ has, and the sine of q₁ comes without its root, too."""
    text = told("dh: [{theta: q1*, a: b, alpha: alpha}, {d: d2*}]")
    assert "d₂ = r₃/cos(α)" in text and "There is one solution." in text
    assert "The solution needs cos(α) ≠ 0." in text
    text = told("dh: [{theta: 0, alpha: alpha}, {theta: q1*, a: l}]")
    assert "q₁ = atan2(r₂/(l cos(α)), r₁/l) Note: This needs cos(α) ≠ 0." in text


def test_of_two_values_that_are_put_into_conditions_not_both_are_said_to_hold() -> None:
    text = told("dh: [{theta: 60deg, alpha: 90deg}, {d: d1*}, {theta: q2*, a: l, alpha: 90deg}]")
    assert "q₂ has two values: there are at most 2 solutions." in text


def test_where_a_divisor_is_0_an_angle_that_moves_nothing_there_is_free() -> None:
    """At q₃ = 0 the tip of the arm with an offset is on the axis of joint 2."""
    text = told("dh: [{theta: q1*, alpha: -90deg}, {theta: q2*, d: h, alpha: 90deg}, {d: q3*}]")
    assert "This needs q₃ ≠ 0." in text
    assert "Where q₃ = 0 and r₃ = 0, q₂ is free: infinitely many solutions." in text
