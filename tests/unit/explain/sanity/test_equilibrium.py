"""Where gravity is balanced in every pose, and where in none."""

from __future__ import annotations

from tests.unit.explain.sanity.checks import check, said


def test_an_arm_in_the_horizontal_plane_needs_nothing_against_gravity() -> None:
    assert "no mass centre changes its height" in said("in3140-rp", "equilibrium")


COUNTERWEIGHT = """
gravity: [0, -g, 0]
dh: [{theta: q1*, a: l}]
masses: [{mass: m, link: 1, center: tip}, {mass: m, link: 1, center: [-2*l, 0, 0]}]
"""


def test_a_counterweight() -> None:
    assert "rise as others fall" in said(COUNTERWEIGHT, "equilibrium")


def test_a_vertical_sliding_joint_is_balanced_nowhere() -> None:
    assert said("cartesian-pp", "equilibrium") == (
        "Let all parameters be positive. g₁ = g (m₁ + m₂) > 0 in every pose, so gravity is balanced in none."
    )
    assert "g₃ = -g (m₃ + m₄) < 0 in every pose" in said("scara-rrpr", "equilibrium")


def test_the_poses_are_a_question_of_their_own() -> None:
    assert check("planar-2r", "equilibrium") is None
    assert check(f"{COUNTERWEIGHT}find: [equilibria]\n", "equilibrium") is None
