"""Where gravity is balanced: what is said of familiar robots, and that it is true of any."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from hypothesis import given, settings

from dynsolve.algebra.ring_values import evaluate
from dynsolve.explain.context import Context
from dynsolve.explain.sanity.determinant import cases
from dynsolve.explain.sanity.equilibrium import (
    QUARTER_TURNS,
    Kind,
    kind_of,
    leading_minors,
    signs_of,
    zeros,
)
from dynsolve.explain.sanity.poses import Pose, poses, turning_in
from tests.robots import robots
from tests.unit.explain.sanity.checks import check, context, lines, rows, said, values_of, words


def test_where_the_planar_arm_hangs_and_where_it_stands() -> None:
    assert said("planar-2r", "equilibrium") == (
        "In an equilibrium the arm stays at rest with τ = 0, so g = 0. Let all parameters be positive. The "
        "rows of g, from the last row up, each result put into the row above:"
    )
    assert lines("planar-2r", "equilibrium") == [
        "g₂ = m₂ g l_c2 c₁₂ = 0, so c₁₂ = 0, q₁ + q₂ = 90° or -90°",
        "g₁ = g (m₁ l_c1 + m₂ l₁) c₁ = 0, so c₁ = 0, q₁ = 90° or -90°",
        "∂g₁/∂q₁ = -g ((m₁ l_c1 + m₂ l₁) s₁ + m₂ l_c2 s₁₂)",
        "∂g₁/∂q₂ = ∂g₂/∂q₁ = ∂g₂/∂q₂ = -m₂ g l_c2 s₁₂",
        "det = (∂g₁/∂q₁) ∂g₂/∂q₂ - (∂g₁/∂q₂)² = g ((m₁ l_c1 + m₂ l₁) s₁ + m₂ l_c2 s₁₂) m₂ g l_c2 s₁₂ "
        "- (m₂ g l_c2 s₁₂)² = m₂ g² l_c2 (m₁ l_c1 + m₂ l₁) s₁ s₁₂",
    ]
    assert rows("planar-2r", "equilibrium") == [
        ["q₁ = 90°, q₂ = 0", "< 0", "> 0", "maximum: the arm stands upright", "unstable"],
        ["q₁ = 90°, q₂ = 180°", "> 0", "< 0", "saddle point", "unstable"],
        ["q₁ = -90°, q₂ = 0", "> 0", "> 0", "minimum: the arm hangs", "stable"],
        ["q₁ = -90°, q₂ = 180°", "< 0", "< 0", "saddle point", "unstable"],
    ]


def test_a_waist_is_balanced_in_any_pose() -> None:
    step = check("elbow-3r", "equilibrium")
    assert step is not None
    assert words(step.concluding).startswith(
        "Gravity is balanced in the poses of the table alone (up to full turns), whatever θ₁ is. "
    )
    assert ["θ₂ = -90°, θ₃ = 0", "> 0", "> 0", "minimum", "stable in θ₂ and θ₃"] in rows(
        "elbow-3r", "equilibrium"
    )
    assert lines("elbow-3r", "equilibrium")[1].startswith("g₂ = g (m₂ l_c2 + m₃ L₂) c₂ = 0, so c₂ = 0")


def test_one_second_derivative_tells_of_one_angle() -> None:
    assert said("crustcrawler-2r", "equilibrium").endswith(
        "Of the entries of g only g₂ is not identically 0:"
    )
    assert rows("crustcrawler-2r", "equilibrium") == [
        ["θ₂ = 90°", "< 0", "maximum", "unstable"],
        ["θ₂ = -90°", "> 0", "minimum", "stable in θ₂"],
    ]


TILTED_BASE = """
convention: modified
base: Rx(30deg)
dh: [{theta: q1*}, {theta: q2*, alpha: 90deg}]
masses: [{mass: m2, link: 2, center: [lc2, 0, 0], inertia: {zz: I2}}]
"""
"""Gravity lies in the plane of x_0 = 0, at 60° to y_0: the arm is upright along (0, 1/2, √3/2)."""


def test_a_row_with_two_factors_is_zero_in_two_cases() -> None:
    assert lines(TILTED_BASE, "equilibrium")[:5] == [
        "g₁ = m₂ g l_c2 c₁ c₂/2 = 0, so c₁ = 0 or c₂ = 0",
        "q₁ = 90°: g₂ = m₂ g l_c2 (√3 c₂ - s₂)/2 = 0, so tan(q₂) = √3, q₂ = 60° or -120°",
        "q₁ = -90°: g₂ = m₂ g l_c2 (s₂ + √3 c₂)/2 = 0, so tan(q₂) = -√3, q₂ = -60° or 120°",
        "q₂ = 90°: g₂ = -m₂ g l_c2 s₁/2 = 0, so s₁ = 0, q₁ = 0 or 180°",
        "q₂ = -90°: g₂ = m₂ g l_c2 s₁/2 = 0, so s₁ = 0, q₁ = 0 or 180°",
    ]
    assert [(row[0], row[3]) for row in rows(TILTED_BASE, "equilibrium")] == [
        ("q₁ = 90°, q₂ = 60°", "maximum: the arm stands upright"),
        ("q₁ = 90°, q₂ = -120°", "minimum: the arm hangs"),
        ("q₁ = -90°, q₂ = -60°", "minimum: the arm hangs"),
        ("q₁ = -90°, q₂ = 120°", "maximum: the arm stands upright"),
        ("q₁ = 0, q₂ = 90°", "saddle point"),
        ("q₁ = 180°, q₂ = 90°", "saddle point"),
        ("q₁ = 0, q₂ = -90°", "saddle point"),
        ("q₁ = 180°, q₂ = -90°", "saddle point"),
    ]
    assert [row[1] for row in rows(TILTED_BASE, "equilibrium")] == [
        "< 0", "> 0", "> 0", "< 0",
        "< 0", "< 0", "> 0", "> 0",  # -m₂ g l_c2 (s₁ c₂ + √3 s₂)/2
    ]  # fmt: skip


def test_an_arm_hangs_only_where_all_of_it_is_vertical() -> None:
    leaning = TILTED_BASE.replace("{theta: q1*}", "{theta: q1*, d: d1}")
    said = [row[3] for row in rows(leaning, "equilibrium")]
    assert said == ["maximum", "minimum", "minimum", "maximum", *["saddle point"] * 4]


def test_the_poses_of_all_cases_are_those_of_a_search() -> None:
    """g changes its sign in both rows at 8 places of a fine grid of angles, and at these."""
    found = context(TILTED_BASE)
    solved_by_cases = cases(found, ["q1", "q2"])
    assert solved_by_cases is not None
    state, g = values_of(found, seed=4), found.values["g"].entries
    steps = range(-180, 180, 15)
    balanced = {
        (q1, q2)
        for q1 in steps
        for q2 in steps
        if all(
            abs(evaluate(entry, {**state, "q1": np.radians(q1), "q2": np.radians(q2)})) < 1e-9 for entry in g
        )
    }
    assert {((p["q1"] + 180) % 360 - 180, p["q2"]) for p in solved_by_cases.poses} == balanced


def test_nothing_is_said_where_the_poses_are_not_all_known() -> None:
    """Upright at q2 = 70°, which has no tangent that a person knows."""
    assert check(TILTED_BASE.replace("30deg", "20deg"), "equilibrium") is None


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
    assert said("cartesian-pp", "equilibrium").endswith(
        "But g₁ = g (m₁ + m₂) > 0 in every pose, so gravity is balanced in none."
    )
    assert "g₃ = -g (m₃ + m₄) < 0 in every pose" in said("scara-rrpr", "equilibrium")


def test_where_an_axis_of_sliding_turns_one_length_balances_it() -> None:
    assert lines("spherical-rrp", "equilibrium") == [
        "g₃ = m₃ g s₂ = 0, so s₂ = 0, θ₂ = 0 or 180°",
        "θ₂ = 0: g₂ = g (m₂ l_c2 + m₃ d₃) = 0",
        "θ₂ = 180°: g₂ = -g (m₂ l_c2 + m₃ d₃) = 0",
    ]
    for problem, length in (
        ("spherical-rrp", "d₃ = -m₂ l_c2/m₃"),
        ("box-cylinder-rod-sphere", "d₃ = (m₃ l₃ - m₂ l₂)/(2(m₃ + m₄))"),
        ("rp-parameters", "q₂ = 0"),
    ):
        step = check(problem, "equilibrium")
        assert step is not None and words(step.concluding).startswith(f"So {length} in both. Gravity is ")


@pytest.mark.parametrize(
    ("problem", "angle", "degrees", "length"),
    [
        ("spherical-rrp", "theta2", (0, 180), lambda p: -p["m2"] * p["lc2"] / p["m3"]),
        ("rp-vertical", "theta1", (0, 180), lambda p: -p["m1"] * p["l1"] / p["m2"]),
        ("rp-parameters", "q1", (90, -90), lambda p: 0),
    ],
)
def test_an_arm_with_a_balanced_length_is_at_a_saddle_point(
    problem: str, angle: str, degrees: tuple[int, int], length: Callable[[dict[str, float]], float]
) -> None:
    """g is 0 in numbers where the check says so, and the second derivatives have both signs."""
    found = context(problem)
    ring, g = found.robot.ring, found.values["g"]
    moving = (name for k, name in enumerate(ring.names) if not ring.diff(found.values["P"], k).is_zero)
    (d,) = (name for name in moving if name != angle)
    for value in degrees:
        state = values_of(found, seed=5)
        state |= {angle: np.radians(value), d: length(state)}
        assert all(abs(evaluate(entry, state)) < 1e-9 for entry in g.entries)
        places = [ring.names.index(name) for name in (angle, d)]
        second = [[evaluate(ring.diff(g[i, 0], j), state) for j in places] for i in places]
        assert np.linalg.eigvalsh(np.array(second)).tolist()[0] < 0 < np.linalg.eigvalsh(np.array(second))[1]
    step = check(problem, "equilibrium")
    assert step is not None and "So they are unstable." in words(step.concluding)


def test_a_length_that_balances_on_the_other_side_of_zero_is_said_to() -> None:
    """Where m₂ and m₃ decide on which side it is, it is said how."""
    found = {name: check(name, "equilibrium") for name in ("spherical-rrp", "box-cylinder-rod-sphere")}
    said_of = {name: words(step.concluding) for name, step in found.items() if step is not None}
    assert said_of["spherical-rrp"].endswith("So they are unstable. With d₃ > 0 no pose is balanced.")
    assert said_of["box-cylinder-rod-sphere"].endswith("unstable. Here d₃ > 0 only if m₂ l₂ < m₃ l₃.")


def test_a_determinant_that_differs_from_case_to_case_is_said_in_derivatives() -> None:
    assert lines(TILTED_BASE, "equilibrium")[-1] == "det = (∂g₁/∂q₁) ∂g₂/∂q₂ - (∂g₁/∂q₂)²"


def test_one_row_is_put_into_no_other() -> None:
    pendulum = "base: Rx(90deg)\ndh: [{theta: q1*, a: a1}]\nmasses: [{mass: m1, link: 1, center: tip}]\n"
    assert said(pendulum, "equilibrium").endswith("The only row of g:")


# -- what is said is true, of any robot ------------------------------------------------------------


@settings(max_examples=5, deadline=None)
@given(robots(max_joints=3, physical=True))
def test_what_the_minors_say_of_a_balanced_pose_is_true(problem: str) -> None:
    found = context.__wrapped__(problem)
    state = values_of(found, seed=1)
    names = turning_in(found.robot, *found.values["g"].entries)
    for pose in poses(names, QUARTER_TURNS) if names else ():
        minors = leading_minors(found, list(pose))
        kind = kind_of(signs_of(found, minors, pose))
        if kind is not None and is_balanced(found, state, pose):
            assert kinds_of(found, state, pose) == [kind]


def is_balanced(found: Context, state: dict[str, float], pose: Pose) -> bool:
    there = {**state, **{name: np.radians(angle) for name, angle in pose.items()}}
    return all(abs(evaluate(entry, there)) < 1e-9 for entry in found.values["g"].entries)


def kinds_of(found: Context, state: dict[str, float], pose: Pose) -> list[Kind]:
    """What P has in a pose, by the eigenvalues of its second derivatives; nothing where g is not 0."""
    ring, g = found.robot.ring, found.values["g"]
    there = {**state, **{name: np.radians(angle) for name, angle in pose.items()}}
    if not is_balanced(found, state, pose):
        return []
    places = [ring.names.index(name) for name in pose]
    second = [[evaluate(ring.diff(g[i, 0], j), there) for j in places] for i in places]
    curvatures = np.linalg.eigvalsh(np.array(second))
    rises, falls = bool((curvatures > 0).any()), bool((curvatures < 0).any())
    kinds = {(True, False): Kind.MINIMUM, (False, True): Kind.MAXIMUM, (True, True): Kind.SADDLE}
    return [kinds[rises, falls]] if (rises, falls) in kinds else []


def test_a_false_kind_would_be_noticed() -> None:
    """A pose that is not balanced, and a minimum told from a maximum."""
    arm = context("planar-2r")
    state = values_of(arm, seed=1)
    assert kinds_of(arm, state, {"q1": 0, "q2": 0}) == []
    assert kinds_of(arm, state, {"q1": 90, "q2": 0}) == [Kind.MAXIMUM]
    assert kinds_of(arm, state, {"q1": -90, "q2": 0}) == [Kind.MINIMUM]


def test_a_row_is_zero_where_it_is_said_to_be() -> None:
    found = context("elbow-3r")
    told = zeros(found)
    assert told is not None and [zero.row for zero in told] == [2, 1]
    state = {**values_of(found, seed=3), "theta2": np.pi / 2, "theta3": np.pi}
    assert all(abs(evaluate(found.values["g"][zero.row, 0], state)) < 1e-9 for zero in told)
    assert zeros(context("spherical-rrp")) is None  # a length stands in its rows
    assert zeros(context(TILTED_BASE)) is None  # two factors of a row may be 0
