"""Singular configurations and equilibria of a robot with numbers: in these, letters beside them."""

from __future__ import annotations

from typing import Any

import pytest

from dynsolve import solve
from dynsolve.solution.numbers.given import of_call

ARM = "dh: [{theta: q1*, a: l1}, {theta: q2*, a: l2, alpha: 90deg}, {theta: q3*, a: l3}]\nfind: [singular]\n"
"""Where l2 + l3 cos q3 = 0 the tip is on the axis of joint 2, which it reaches where l3 ≥ l2."""

HOOP = """gravity: [0, 0, -g]
model:
  coordinates: {phi: revolute, theta: revolute}
  bodies:
    - {mass: m, at: [a*sin(theta)*cos(phi), a*sin(theta)*sin(phi), -a*cos(theta)]}
steady: {phi: W}
find: [equilibria]
"""
"""Goldstein, Poole, Safko (2002), exercise 2.18: off the axis where a W² > g, at cos θ = g/(a W²)."""


def with_values(text: str, **values: str) -> tuple[dict[str, Any], dict[str, Any]]:
    """The results in letters, and those with values."""
    found = solve(f"title: Sets\n{text}").beside(of_call(values)).to_json()
    return found["results"], found["values"]["results"]


@pytest.mark.parametrize(
    ("l2", "l3", "singular"),
    [
        ("1", "2", [["1 + 2*cos(q3) = 0"], ["sin(q2) = 0"], ["cos(q3) = 0"]]),
        ("0.5", "4", [["1 + 8*cos(q3) = 0"], ["sin(q2) = 0"], ["cos(q3) = 0"]]),
        ("2", "1", [["sin(q2) = 0"], ["cos(q3) = 0"]]),
    ],
)
def test_where_an_arm_of_these_lengths_is_singular(l2: str, l3: str, singular: list[list[str]]) -> None:
    letters, numbers = with_values(f"gravity: none\n{ARM}", l1="3", l2=l2, l3=l3)
    assert ["l2 + l3*cos(q3) = 0"] in letters["singular"]
    assert letters["singular_exist"]
    assert sorted(numbers["singular"]) == sorted(singular)
    assert "singular_exist" not in numbers


@pytest.mark.parametrize(
    ("rate", "equilibria", "below"),
    [
        ("1", [["sin(theta) = 0"]], "stable"),
        ("3", [["cos(theta) - 109/300 = 0"], ["sin(theta) = 0"]], "unstable"),
    ],
)
def test_where_a_hoop_of_this_rate_has_its_bead(rate: str, equilibria: list[list[str]], below: str) -> None:
    letters, numbers = with_values(HOOP, a="3", m="1", g="9.81", W=rate)
    assert letters["equilibria"] == [["a*W**2*cos(theta) - g = 0"], ["sin(theta) = 0"]]
    assert numbers["equilibria"] == equilibria
    assert numbers["equilibria_stability"][-1][0] == {"theta": "0", "stability": below}
    assert "equilibria_exist" not in numbers


def test_inequalities_that_are_assumed_go_with_the_numbers() -> None:
    spring = """gravity: [0, -g, 0]
dh: [{theta: q1* + 90deg, a: l}]
masses: [{mass: m, link: 1}]
springs: [{energy: k*(1 - cos(q1))}]
assume: [k > m*g*l]
find: [equilibria]
"""
    letters, numbers = with_values(spring, m="2", l="1/2")
    for results in (letters, numbers):
        points = [point for one in results["equilibria_stability"] for point in one]
        assert {point["q1"]: point["stability"] for point in points}["0"] == "stable"
