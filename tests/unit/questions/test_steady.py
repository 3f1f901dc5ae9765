"""Steady motions, what is assumed of parameters, and for which of them equilibria are there."""

from __future__ import annotations

from typing import Any

import pytest

import dynsolve
from dynsolve.render.files import Format
from dynsolve.solution.reports import report

ARM = """
gravity: [0, 0, -g]
dh: [{theta: q1*, alpha: 90deg}, {theta: q2*, a: l}]
masses: [{mass: m, link: 2}]
steady: {q1: W}
find: [equilibria]
"""
SLIDER = """
gravity: none
dh: [{theta: q1*, alpha: 90deg}, {d: q2*}]
masses: [{mass: m, link: 2}]
springs: [{stiffness: k, of: q2, rest: r}]
steady: {q1': 2}
find: [equilibria]
"""
PLATE = """
gravity: none
model:
  coordinates: {phi: revolute, x: prismatic, y: prismatic}
  bodies: [{mass: m, at: [x*cos(phi) - y*sin(phi), x*sin(phi) + y*cos(phi), 0]}]
springs: [{stiffness: k, of: x}, {stiffness: k, of: y}]
steady: {phi: W}
find: [equilibria]
"""
TILTED = """
gravity: [0, 0, -g]
dh: [{theta: q1*, alpha: 90deg}, {theta: q2* + 90deg, alpha: 90deg}, {d: q3*}]
masses: [{mass: m, link: 3, center: origin}]
springs: [{stiffness: k, of: q3, rest: r}]
assume: [k*r > m*g]
steady: {q1: W}
find: [equilibria]
"""
SPRING = """
gravity: none
model: {coordinates: {q: revolute}, D: [[m]], P: a1*cos(q) - b*q}
find: [equilibria]
"""


def equilibria(problem: str) -> dict[str, Any]:
    results = dynsolve.solve(problem).to_json()["results"]
    return {name.removeprefix("equilibria"): value for name, value in results.items() if name[:5] == "equil"}


def test_an_arm_that_is_turned_about_its_waist() -> None:
    """At sin q2 = -g/(l W²) below the shoulder, or hanging, or upright (by hand)."""
    found = equilibria(ARM)
    assert found[""] == [["g + l*W**2*sin(q2) = 0"], ["cos(q2) = 0"]]
    assert found["_exist"] == [["l*W**2 >= g"], []]
    assert found["_stability"] == [
        [{"stability": "undecided", "stable_if": ["l*W**2 > g"]}],
        [{"q2": "pi/2", "stability": "unstable"},
         {"q2": "-pi/2", "stability": "undecided", "stable_if": ["g > l*W**2"],
          "unstable_if": ["l*W**2 > g"]}],
    ]  # fmt: skip


@pytest.mark.parametrize(
    ("assumed", "count", "hanging"), [("l*W^2 > g", 2, "unstable"), ("g > l*W^2", 1, "stable")]
)
def test_what_is_assumed_decides(assumed: str, count: int, hanging: str) -> None:
    found = equilibria(f"{ARM}assume: [{assumed}]\n")
    assert len(found[""]) == count and "_exist" not in found
    assert found["_stability"][-1][-1] == {"q2": "-pi/2", "stability": hanging}


def test_a_slider_leaves_the_spring_where_it_turns_too_fast() -> None:
    """k (q2 - r) = m 2² q2, stable where k > 4m (by hand)."""
    found = equilibria(SLIDER)
    assert found[""] == [["(4*m - k)*q2 + k*r = 0"]]
    point = {"stability": "undecided", "stable_if": ["k > 4*m"], "unstable_if": ["4*m > k"]}
    assert found["_stability"] == [[point]]


def test_what_forces_across_the_motion_may_hold_is_not_called_unstable() -> None:
    """A mass on a turning plate is stable also where W is large (Whirling shaft: gyroscopic stability)."""
    (point,) = equilibria(f"{PLATE}assume: [m*W^2 > k]\n")["_stability"][0]
    assert point == {"stability": "undecided"}
    (point,) = equilibria(f"{PLATE}assume: [k > m*W^2]\n")["_stability"][0]
    assert point == {"stability": "stable"}
    found = equilibria(PLATE)
    assert found["_stability"] == [[{"stability": "undecided", "stable_if": ["k > m*W**2"]}]]
    assert found["_special"] == [{"where": "m*W**2 = k", "equilibria": [[]]}]


def test_angles_that_no_parameters_allow_are_left_out() -> None:
    assert equilibria(SPRING)["_exist"] == [["a1 >= b"]]
    assert equilibria(f"{SPRING}assume: [b > a1]\n") == {"": [], "_stability": []}


@pytest.mark.parametrize(
    ("problem", "why"),
    [
        (ARM.replace("q1: W", "q2: W"), "change as q₂ moves: it is not cyclic"),
        (f"{ARM}friction: {{q1: b}}\npassive: [q1]\n", "friction acts on q₁"),
        (f"{ARM}dampers: [{{damping: b, of: q1 - q2}}]\n", "friction acts on q₂"),
    ],
)
def test_a_motion_that_is_not_steady_is_refused(problem: str, why: str) -> None:
    solution = dynsolve.solve(problem)
    assert why in solution.to_json()["results"]["equilibria"]["skipped"]
    assert any(why in warning.message for warning in solution.warnings)


def test_the_step_says_what_is_left_of_the_equations() -> None:
    steps = {step.id: step for step in dynsolve.solve(ARM).steps}
    assert steps["equilibria"].title == "Where nothing else moves"
    assert "has solutions where" in str(steps["equilibria"].notes)
    assert "the kinetic energy of the motion" in str(steps["equilibria_stability"].why)


def test_the_step_and_the_hint_say_what_is_assumed_and_what_the_motion_leaves() -> None:
    solution = dynsolve.solve(f"{ARM}assume: [l*W^2 > g]\n")
    (why,) = (step.why for step in solution.steps if step.id == "equilibria")
    assert "Let all parameters be positive, and " in str(why)
    hint = str(solution.hint("equilibria"))
    assert "The rates that are constant stay" in hint and "The inverse of D" not in hint


def test_where_conditions_shorten_each_other_what_they_need_is_seen() -> None:
    """q3 = k r/(k - m W²) and sin q2 = -g/(W² q3), stable where that is a pull outwards (by hand)."""
    found = equilibria(TILTED)
    tilted = ["(m*W**2 - k)*q3 + k*r = 0", "k*(g + r*W**2*sin(q2)) - m*g*W**2 = 0"]
    assert found[""][0] == tilted
    assert found["_exist"] == [["W**2*(m*g + k*r) >= g*k"], []]
    assert found["_stability"][0] == [
        {"stability": "undecided", "stable_if": ["W**2*(m*g + k*r) > g*k", "k > m*W**2"],
         "unstable_if": ["m*W**2 > k"]},
    ]  # fmt: skip


def test_why_a_factor_is_no_case_is_said() -> None:
    shown = " ".join(report(dynsolve.solve(TILTED), Format.TEXT).decode().split())
    assert "Where q₃ = 0, m g s₂ - k r is not 0." in shown
    assert "In case 1, where W² (m g + k r) > g k: stable where k > m W², not stable where k < m W²." in shown


def test_two_long_equations_of_a_motion_are_two_lines() -> None:
    three = (
        "dh: [{theta: phi*, d: h, alpha: 90deg}, {theta: q2*, a: a}, {theta: q3*, a: b}]\n"
        "masses: [{mass: m, link: 3}]\nsteady: {phi: W}\nfind: [equilibria]\n"
    )
    told = report(dynsolve.solve(three), Format.TEXT).decode()
    assert "    τ₃ = " in told
    assert "and τ₃" not in told


HOOP = """
model:
  coordinates: {phi: revolute, r: prismatic, z: prismatic}
  bodies: [{mass: m, at: [r*cos(phi), r*sin(phi), z]}]
constraints: [r^2 + z^2 - R^2]
steady: {phi: W}
find: [equilibria]
"""


def test_what_constraints_hold_in_a_steady_motion_is_found() -> None:
    """A bead on a hoop that turns: z = -g/W² where R W² ≥ g, stable where it is there (by hand)."""
    found = equilibria(HOOP)
    assert found[""] == [
        ["g + W**2*z = 0", "r**2 + z**2 - R**2 = 0"],
        ["r = 0", "z - R = 0"],
        ["r = 0", "R + z = 0"],
    ]
    turned, upper, lower = (one[0] for one in found["_stability"])
    assert turned == {"stability": "undecided", "stable_if": ["R*W**2 > g"]}
    assert upper == {"stability": "unstable"}
    assert lower == {"stability": "undecided", "stable_if": ["g > R*W**2"], "unstable_if": ["R*W**2 > g"]}
    told = report(dynsolve.solve(HOOP), Format.TEXT).decode()
    assert "a combination of the rows of 𝐀_c without the\ncolumn of φ" in told


def test_a_constraint_that_moves_with_what_is_kept_turning_is_refused() -> None:
    problem = HOOP.replace("r^2 + z^2 - R^2", "r*cos(phi) - R")
    why = dynsolve.solve(problem).to_json()["results"]["equilibria"]["skipped"]
    assert why == "the constraints change as φ moves: it stands in them"


SPIN = """
dh: [{theta: phi*, d: h, alpha: 90deg}, {theta: th*, alpha: 90deg}, {d: r*}]
masses: [{mass: m, link: 3, center: origin}]
springs: [{stiffness: k, of: r, rest: r0}]
steady: {phi: W}
find: [equilibria]
"""


def test_the_equilibria_of_special_parameters_are_solved_too() -> None:
    """With m W² = k, r cos θ = m g/k would leave k r₀ = 0 (by hand); two equal links may be folded."""
    assert equilibria(SPIN)["_special"] == [
        {"where": "m*W**2 = k", "equilibria": [["sin(th) = 0", "m*g*cos(th) - k*(r - r0) = 0"]]}
    ]
    level = (
        "dh: [{theta: phi*, d: h, alpha: 90deg}, {theta: q2*, a: a}, {theta: q3*, a: b}]\n"
        "masses: [{mass: m, link: 3}]\nconstraints: [tip.z - h]\nsteady: {phi: W}\nfind: [equilibria]\n"
    )
    folded = [["sin(q3) = 0", "sin(q2) = 0"], ["1 + cos(q3) = 0"]]
    assert equilibria(level)["_special"] == [{"where": "a = b", "equilibria": folded}]
    told = report(dynsolve.solve(level), Format.TEXT).decode()
    assert "Where a = b, the equilibria are where sin(q₃) = 0 and sin(q₂) = 0, or where q₃ = 180°." in (
        " ".join(told.split())
    )


def test_of_a_product_that_has_to_be_positive_both_factors_are_if_not_both_can_be_negative() -> None:
    """Drawn in by gravity, above: r = r₀ - m g/k is negative there; stable below m g k/(m W²) (by hand)."""
    above = equilibria(SPIN)["_stability"][1][-1]
    assert above["stable_if"] == ["m*g > k*r0", "k*(g + W**2*r0) > m*g*W**2"]


def test_a_case_is_there_where_the_weaker_of_two_conditions_holds() -> None:
    """Straight, W² (a + b) ≥ g, or folded, W² |a - b| ≥ g, of which the first follows (by hand)."""
    two = (
        "dh: [{theta: phi*, d: h, alpha: 90deg}, {theta: q2*, a: a}, {theta: q3*, a: b}]\n"
        "masses: [{mass: m, link: 3}]\nsteady: {phi: W}\nfind: [equilibria]\n"
    )
    assert equilibria(two)["_exist"] == [["W**2*(a + b) >= g"], []]
