"""Sines and cosines of sums: a constant angle adds to those of the joints that turn what it stands in."""

from __future__ import annotations

import pytest

from dynsolve.explain.forms import parallel_coordinates
from dynsolve.notation.unicode import to_unicode
from tests.support import solved

CORNER = "points: {P: {link: %d, at: [a*cos(beta), a*sin(beta), 0]}}\nfind: [pP]\n"
FLAT = "gravity: none\ndh: [{theta: q1*, a: l1}, {theta: q2*, a: l2}]\n" + CORNER % 2
UPRIGHT = (
    "gravity: none\ndh: [{theta: q1*, alpha: 90deg}, {theta: q2*, a: l2}, {theta: q3*, a: l3}]\n" + CORNER % 3
)
SLOPE = """
gravity: [g*sin(beta), -g*cos(beta), 0]
dh: [{theta: q1*, a: l1}]
masses: [{mass: m1, link: 1}]
"""


@pytest.mark.parametrize(
    ("problem", "name", "part"),
    [
        (FLAT, "pP", "a cos(q₁ + q₂ + β)"),
        (UPRIGHT, "pP", "a sin(q₂ + q₃ + β)"),
        (SLOPE, "g", "cos(q₁ - β)"),
    ],
)
def test_an_angle_of_a_corner_or_of_gravity_adds_to_those_of_the_joints(
    problem: str, name: str, part: str
) -> None:
    solution = solved(problem)
    (step,) = (one for one in solution.steps if one.id == name)
    assert part in to_unicode(step.result[-1], solution.style)


def test_of_several_groups_of_parallel_joints_a_constant_angle_is_with_those_that_turn_it() -> None:
    assert parallel_coordinates(solved(UPRIGHT).robot) == [{"q1"}, {"q2", "q3", "beta"}]
    on_the_first = UPRIGHT.replace("link: 3", "link: 1")
    assert parallel_coordinates(solved(on_the_first).robot) == [{"q1", "beta"}, {"q2", "q3"}]


def test_what_a_disk_rolls_adds_to_the_angle_of_its_beam() -> None:
    rolling = """
gravity: none
model:
  coordinates: {theta: revolute, x: prismatic}
  bodies:
    - {mass: m, at: [x*cos(theta), x*sin(theta), 0], turn: theta - x/R, inertia: {zz: J}}
"""
    forms = solved(rolling).forms
    assert to_unicode(forms.matrix("R1").rows[0][0]) == "cos(θ - x/R)"


@pytest.mark.parametrize("degrees", [50, 40, 72])
def test_an_angle_in_degrees_stays_the_one_that_was_written(degrees: int) -> None:
    forms = solved(f"dh: [{{theta: q1*, alpha: {degrees}deg}}, {{d: q2*, alpha: -{degrees}deg}}]\n").forms
    row = [to_unicode(entry) for entry in forms.matrix("A1").rows[2]]
    assert row == ["0", f"sin({degrees}°)", f"cos({degrees}°)", "0"]
