"""Checks that a person can do: those that speak, of whom, and that what they say is true."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
import pytest
from hypothesis import given, settings

from dynsolve.algebra.linear_systems import blocks
from dynsolve.algebra.matrix import determinant
from dynsolve.algebra.ring import Expr
from dynsolve.algebra.ring_values import evaluate
from dynsolve.explain.context import Context
from dynsolve.explain.sanity import CHECKS, CHECKS_OF_LONGER_ARMS, sanity_steps
from dynsolve.explain.sanity.definite import definite_step
from dynsolve.explain.sanity.determinant import is_nonnegative, is_positive, masses_and_moments
from dynsolve.explain.step import Step
from dynsolve.notation.text import read
from dynsolve.notation.tree import Relation
from dynsolve.notation.unicode import to_unicode
from tests.robots import robots
from tests.support import solved
from tests.unit.explain.sanity.checks import check, context, lines, rows, said, values_of, words

# -- what is said of familiar robots -----------------------------------------------------------------


def test_the_moments_of_inertia_of_the_planar_arm_in_poses_of_right_angles() -> None:
    assert rows("planar-2r", "inertia_poses") == [
        ["q₂ = 0", "d₁₁ = m₁ l_c1² + m₂ (l₁ + l_c2)² + I₁ + I₂"],
        ["q₂ = 90°", "d₁₁ = m₁ l_c1² + m₂ (l₁² + l_c2²) + I₁ + I₂"],
        ["q₂ = 180°", "d₁₁ = m₁ l_c1² + m₂ (l₁ - l_c2)² + I₁ + I₂"],
    ]


def test_an_upright_elbow_has_no_mass_away_from_its_waist() -> None:
    assert ["θ₂ = 90°, θ₃ = 0", "d₁₁ = I_1yy + I_2xx + I_3xx"] in rows("elbow-3r", "inertia_poses")


def test_a_moment_of_inertia_in_letters_is_told_body_by_body() -> None:
    assert [row[-1] for row in rows("box-cylinder-rod-sphere", "inertia_poses")] == [
        "d₁₁ = m₁ r₁²/2 + m₂ l₂²/4 + m₂ (l₂² + b²)/12 + m₃ (d₃ - l₃/2)² + m₃ l₃²/12 + m₄ d₃² + 2m₄ r₄²/5",
        "d₁₁ = m₁ r₁²/2 + m₂ b²/6 + 2m₄ r₄²/5",
    ]


GIMBAL = """
gravity: none
dh: [{theta: q1*, alpha: 90deg}, {theta: q2*%s}]
masses: [{link: 2, mass: m, center: tip, inertia: {xx: A, yy: B, zz: C}}]
"""


@pytest.mark.parametrize(("row", "gives"), [("", False), (", a: l", True)])
def test_the_parallel_axis_theorem_is_for_mass_centers_off_the_axis(row: str, gives: bool) -> None:
    step = check(GIMBAL % row, "inertia_poses")
    assert step is not None
    theorem = ": in simple poses the parallel-axis theorem gives the same" if gives else ""
    assert words(step.outcome) == f"d₁₁ is the moment of inertia of all that joint 1 moves{theorem}."


@pytest.mark.parametrize(
    ("problem", "told"),
    [
        ("in3140-rp", "the momentum ∂ℒ/∂θ̇₁ (the angular momentum of the arm about z₀) is conserved."),
        ("scara-rrpr", "∂ℒ/∂θ̇₄ (the angular momentum about z₃ of all that joint 4 moves) are conserved:"),
        ("cart-pole", " (the total linear momentum along x) is conserved."),
        ("planar-2r", "The energy changes by the power of τ alone: as long as τ = 0 it is conserved. "),
        (
            "planar-2r-friction",
            "The energy changes by the power of τ and of friction, which takes energy away. ",
        ),
    ],
)
def test_what_is_conserved(problem: str, told: str) -> None:
    step = check(problem, "conserved") or next(sanity_steps(context(problem)))
    assert words((*step.why, *step.concluding)).endswith(told)


@pytest.mark.parametrize(
    ("friction", "told"),
    [
        ("", "the energy is conserved. "),
        ("friction: {x: c}\n", "friction alone changes the energy, and takes it away. "),
    ],
)
def test_where_no_motor_drives_there_is_no_power_of_one(friction: str, told: str) -> None:
    cart = "gravity: none\nmodel: {coordinates: {x: prismatic}, bodies: [{mass: M, at: [x, 0, 0]}]}\n"
    step = next(sanity_steps(context(f"{cart}passive: [x]\n{friction}")))
    assert f"No motor drives: {told}" in words((*step.why, *step.concluding))


SKATE = """
gravity: [-g, 0, 0]
model:
  coordinates: {x: prismatic, y: prismatic, phi: revolute}
  bodies: [{mass: m, at: [x, y, 0], turn: phi, about: [0, 0, 1], inertia: {zz: J}}]
constraints: [{rates: "x'*sin(phi) - y'*cos(phi)"}]
"""
"""A skate on a slope: what keeps it on its edge does no work, and pushes along y."""


def test_constraints_do_no_work_and_change_momenta() -> None:
    step = check(SKATE, "conserved")
    assert step is not None
    told = words(step.concluding)
    assert "as long as τ = 0 it is conserved" in told
    assert "A_c" not in told and "ẏ" not in told and "∂ℒ/∂φ̇" in told
    alone = check(f"{SKATE}passive: [x, y, phi]\n", "conserved")
    assert alone is not None and words(alone.concluding).startswith(
        "No motor drives: the energy is conserved. "
    )


CART = """
gravity: [0, 0, -g]
dh: [{theta: 0, d: p1*, alpha: 90deg}, {theta: q2*, a: l}]
masses: [{mass: m1, link: 1}, {mass: m2, link: 2}]
"""
"""A cart on a vertical rail, which is not cyclic, and without gravity is."""


def test_the_momentum_of_a_sliding_joint_is_linear() -> None:
    assert "cyclic" not in words(check(CART, "conserved").concluding)  # type: ignore[union-attr]
    free = check(CART.replace("[0, 0, -g]", "none"), "conserved")
    assert free is not None
    assert "the linear momentum of the arm along z₀" in words(free.concluding)


def test_a_momentum_that_stands_above_as_it_is_is_not_written_again() -> None:
    short, long = (check(problem, "conserved") for problem in ("in3140-rp", "elbow-3r"))
    assert short is not None and long is not None
    assert short.result == ()
    (shown,) = long.result
    assert to_unicode(shown, solved("elbow-3r").style) == "∂ℒ/∂θ̇₁ = d₁₁ θ̇₁"


def test_the_determinant_of_the_planar_arm() -> None:
    step = check("planar-2r", "definite")
    assert step is not None
    (shown,) = step.lines[-1].formulas
    assert to_unicode(shown, solved("planar-2r").style).startswith("d₁₁ d₂₂ - d₁₂² = ")
    assert said("planar-2r", "definite") == (
        "Let all parameters be positive. On the diagonal of D, d₂₂ = m₂ l_c2² + I₂ > 0. By Sylvester's "
        "criterion, which may start from either end of the diagonal, it remains to show that the determinant "
        "below is positive."
    )
    assert words(step.concluding) == (
        "In the last expression no term is negative, and I₁ I₂ > 0. So D is positive definite."
    )
    assert said("in3140-rp", "definite") == (
        "Let all parameters be positive. On the diagonal of D, d₁₁ ≥ I_1zz > 0 and d₂₂ = m₂ > 0. All "
        "other entries are zero, so D is positive definite."
    )


def test_the_determinant_of_an_arm_in_numbers_is_written_without_a_minus() -> None:
    """0.116204 is more than 0.0576, so the sign is seen once c₂² = 1 - s₂² is put in."""
    step = check("numeric-2r", "definite")
    assert step is not None
    (shown,) = step.lines[-1].formulas
    assert to_unicode(shown, solved("numeric-2r").style).endswith(
        " = (0.862833 + 0.48 c₂)·0.167 - (0.167 + 0.24 c₂)² = 0.116204 - 0.0576 c₂² = 0.0586042 + 0.0576 s₂²"
    )


def test_a_body_shows_that_an_entry_is_positive_where_its_terms_do_not() -> None:
    """m₂ (4l₂² - b²)/12 c₂² stands in d₁₁ of the box, and is negative where b > 2l₂; so in no other entry."""
    assert "d₂₂ > m₂ (4l₂² + b²)/12 > 0 and d₃₃ = m₃ + m₄ > 0." in said("box-cylinder-rod-sphere", "definite")
    assert "body 1 adds m₁ r₁²/2 to d₁₁" in said("box-cylinder-rod-sphere", "definite")


TILTING = """
gravity: [0, 0, -g]
dh: [{theta: q1*, alpha: -90deg}, {theta: q2*, a: c, alpha: 90deg}]
masses: [{mass: m, link: 2, center: [0, 0, f], inertia: {xx: Ix, yy: Iy, zz: Iz}}]
"""
ENERGY = """
model:
  coordinates: {a: revolute, b: revolute}
  K: m*L^2*(2*a'^2 + b'^2 + 2*a'*b'*cos(a - b))/2
  P: -m*g*L*(2*cos(a) + cos(b))
"""
BOWL = """
gravity: [0, -g, 0]
model:
  coordinates: {t: revolute}
  bodies: [{mass: m, at: [(R - r)*sin(t), -(R - r)*cos(t), 0], turn: t - R*t/r, inertia: {zz: m*r^2/2}}]
"""


def test_terms_that_never_vanish_together_are_positive() -> None:
    """A s² + B c²: as a rigid body turns, one of its moments or another is always there."""
    assert "d₁₁ ≥ I_x sin²(q₂) + I_z cos²(q₂) > 0" in said(TILTING, "definite")


def test_a_factor_of_a_determinant_is_written_by_the_sine() -> None:
    """2 - cos² is 1 + sin²; of given energies all parameters may be masses."""
    step = check(ENERGY, "definite")
    assert step is not None
    (shown,) = step.lines[-1].formulas
    assert to_unicode(shown).endswith("= m² L⁴ + m² L⁴ sin²(b - a)")
    assert words(step.concluding).endswith("and m² L⁴ > 0. So D is positive definite.")


def test_where_parameters_leave_no_inertia_it_is_told() -> None:
    assert "D has no inverse where R = r:" in said(BOWL, "definite")
    assert check(BOWL + "assume: [R > r]\nfind: [equilibria, D]\n", "definite") is None


def test_without_moments_of_inertia_the_linear_parts_are_left() -> None:
    step = check("in3140-rp", "point_masses")
    assert step is not None
    style = solved("in3140-rp").style
    points, rest = (to_unicode(node, style) for node in step.result)
    assert step.formula is not None
    assert to_unicode(step.formula, style) == "𝐃_points = m₂ 𝐉_v2ᵀ 𝐉_v2"
    assert points == "𝐃_points = [[m₂ L₂², 0], [0, m₂]]"
    assert rest == "𝐃 - 𝐃_points = [[I_1zz, 0], [0, 0]]"
    assert said("in3140-rp", "point_masses").endswith(
        "turning of the bodies adds: the rotational parts; nothing for L₂, which turns no body."
    )


TILTED = """
convention: modified
base: Rx(30deg)
dh: [{theta: q1*}, {theta: q2*, a: a1, alpha: 90deg}, {theta: q3*, a: a2, d: e}]
masses:
  - {mass: m1, link: 1, center: [x1, 0, 0], inertia: {xx: A1, yy: B1, zz: C1}}
  - {mass: m2, link: 2, center: [x2, 0, 0], inertia: {xx: A2, yy: B2, zz: C2}}
  - {mass: m3, link: 3, center: [x3, 0, 0], inertia: {xx: A3, yy: B3, zz: C3}}
"""
"""All joints are coupled by the offset e: the determinants of D are no sums of squares."""


def test_body_by_body_where_the_determinants_are_long() -> None:
    step = check(TILTED, "definite")
    assert step is not None
    assert lines(TILTED, "definite") == [
        "2K₁ = (m₁ x₁² + C₁) q̇₁²",
        "2K₂ = (m₂ x₂² + C₂) q̇₂²",
        "2K₃ = (m₃ x₃² + C₃) q̇₃²",
    ]
    assert words(step.concluding).endswith("D is positive definite.")


def test_a_moment_of_inertia_in_numbers_is_summed_up() -> None:
    """Masses 2.5, 1.2 and 0.75 at 0.25, 0.5 + 0.15 and 0.5 + 0.4 of the axis."""
    assert rows("numeric-2r", "inertia_poses")[0][-1] == (
        "d₁₁ = 2.5·0.25² + 0.0520833 + 1.2·0.65² + 0.02 + 0.75·0.9² = 1.34283 kg m²"
    )
    assert rows("numeric-2r", "inertia_poses")[1][-1] == (  # bent: the distances by Pythagoras
        "d₁₁ = 2.5·0.25² + 0.0520833 + 1.2 (0.15² + 0.5²) + 0.02 + 0.75 (0.4² + 0.5²) = 0.862833 kg m²"
    )
    assert check("numeric-2r", "point_masses") is None


POINTS = "dh: [{theta: q1*, a: l1}, {theta: q2*, a: l2}]\nmasses: [{mass: m2, link: 2}]\n"
"""Without a mass at the elbow D is singular where the arm is stretched."""


def test_without_moments_nothing_is_said_of_points() -> None:
    assert check(POINTS, "point_masses") is None


OFFSET = "dh: [{theta: q1*, a: e, alpha: 90deg}, {theta: q2*, a: l2}]\nmasses: [{mass: m2, link: 2}]\n"
OFFSET_3 = """
dh: [{theta: q1*, a: e, alpha: 90deg}, {theta: q2*, a: f}, {theta: q3*, a: f}]
masses: [{mass: m, link: 2}, {mass: 2*m, link: 3}]
"""
LYING = """
axes:
  - {turn: u1, about: [0, 0, 1], through: [0, 0, 0]}
  - {turn: u2, about: [0, 1, 0], through: [0, 0, H]}
  - {slide: u3, along: [0, 0, 1], through: [W, 0, H]}
tip: [W, 0, H + u3]
masses: [{mass: m2, link: 2, center: {drawn: [W/2, 0, H]}}, {mass: m3, link: 3}]
"""
GIVEN = "model:\n  {coordinates: {q: revolute, w: revolute}, D: [[a, b*cos(q)], [b*cos(q), c]]}\n"
GEARED = """
dh: [{theta: q1*, alpha: -90deg}, {d: q2*, alpha: 90deg}, {theta: q3*, a: l3}]
masses:
  - {mass: m2, link: 2}
  - {mass: m3, link: 3, center: {near: [c3, 0, 0]}, inertia: {zz: I3}}
motors:
  - {turns: q1, inertia: Im1, ratio: n1}
  - {turns: q2, inertia: Im2, ratio: n2, carrier: 1}
  - {turns: q3, inertia: Im3, ratio: n3, carrier: 2}
"""
POLAR = """
dh: [{theta: q1*, a: e, alpha: 90deg}, {theta: q2*, alpha: 90deg}, {d: q3*}]
masses: [{mass: m, link: 3}]
"""
CONE = "dh: [{theta: q1*, d: h, alpha: beta}, {theta: q2*, a: l}]\nmasses: [{mass: m, link: 2}]\n"
QUARTER = math.pi / 2


@pytest.mark.parametrize(
    ("problem", "told", "bound", "inside", "outside", "there"),
    [
        (OFFSET, "e + l₂ cos(q₂) = 0", "l₂ ≥ e", {"e": 0.6, "l2": 0.8}, {"e": 0.8, "l2": 0.6},
         {"q2": math.acos(-0.75)}),
        (OFFSET_3, "e + f cos(q₂) = 0 and cos(q₂ + q₃) = 0", "f ≥ e", {"e": 0.6, "f": 0.8},
         {"e": 0.8, "f": 0.6}, {"q2": math.acos(-0.75), "q3": QUARTER - math.acos(-0.75)}),
        (LYING, "cos(u₂) = 0 and u₃ = 0", "", {}, {}, {"u2": -QUARTER, "u3": 0}),
        (POLAR, "q₃ = 0 or where e + q₃ sin(q₂) = 0", "", {"e": 0.6}, {}, {"q2": -QUARTER, "q3": 0.6}),
        (CONE, "cos(q₂) = 0 or where sin(β) = 0", "", {}, {}, {"beta": math.pi}),
        (GIVEN, "b² cos²(q) - a c = 0", "b² ≥ a c", {"a": 2, "b": 2, "c": 1}, {"a": 2, "b": 1.4, "c": 1},
         {"q": math.acos(0.5**0.5)}),
    ],
)  # fmt: skip
def test_all_places_without_an_inverse_are_told(
    problem: str,
    told: str,
    bound: str,
    inside: dict[str, float],
    outside: dict[str, float],
    there: dict[str, float],
) -> None:
    """Several conditions at once, and those that need lengths: each held in numbers."""
    found, text = context(problem), said(problem, "definite")
    assert f"D has no inverse where {told}{f', which is possible if {bound}' * bool(bound)}: " in text
    assert text.endswith("For other parameters D is positive definite.") is bool(bound)
    state = {**values_of(found, seed=3), **inside}
    assert not is_definite(found, {**state, **there})
    assert is_definite(found, {**state, **there, **{name: value + 0.3 for name, value in there.items()}})
    if bound:
        outer = [{**values_of(found, seed=k), **outside} for k in range(20)]
        assert all(is_definite(found, each) for each in outer)


def test_what_is_assumed_may_leave_no_place() -> None:
    assert said(OFFSET + "assume: [e > l2]\nfind: [D, equilibria]\n", "definite").endswith(
        "in every configuration."
    )
    assert said(GIVEN + "assume: [a*c > b^2]\nfind: [D, equilibria]\n", "definite") == (
        "Let all parameters be positive, and a c > b². det D = a c - b² cos²(q) is 0 in no configuration, "
        "so that no eigenvalue of D changes its sign, and in some configuration all are positive. So D is "
        "positive definite."
    )


def test_rotors_may_be_what_moves_where_the_bodies_rest() -> None:
    assert "has rank 3 in every configuration" in said(GEARED, "definite")
    found = context(GEARED)
    assert all(is_definite(found, {**values_of(found, seed=k), "q2": 0}) for k in range(10))


ABOUT_ONE_AXIS = """
dh: [{theta: q1*}, {theta: q2*, a: l, alpha: 90deg}, {d: q3*}]
masses: [{mass: m, name: 3, link: 3}]
"""
THREE_IN_A_PLANE = """
dh: [{theta: q1*, a: l}, {theta: q2*, a: l}, {theta: q3*, a: l}]
masses: [{mass: m, name: 3, link: 3}]
"""
ITS_LAST = """
dh: [{theta: q1*, a: l}, {theta: q2*}]
masses: [{mass: m, name: 2, link: 2}]
"""
ALWAYS = (
    "some rates that are not 0 have no kinetic energy, and the forces do not determine all accelerations."
)


@pytest.mark.parametrize(
    ("problem", "reason"),
    [
        (ABOUT_ONE_AXIS, "In every pose rows 1 and 2 of D are equal, so det D = 0"),
        (THREE_IN_A_PLANE, "In every pose det D = 0"),
        (ITS_LAST, "In every pose row 2 of D is 0, so det D = 0"),
    ],
)
def test_of_a_matrix_that_is_always_singular_it_is_said(problem: str, reason: str) -> None:
    assert said(problem, "definite") == f"{reason}: {ALWAYS}"


def test_longer_arms_have_checks_of_their_own() -> None:
    assert [step.id for step in sanity_steps(context("stanford-6"))] == [
        "conserved",
        "dependence",
        "unloaded",
    ]


def test_what_a_joint_moves_is_one_body_to_it() -> None:
    """The last entry of D: the last link about its joint's axis."""
    step = check("stanford-6", "dependence")
    assert step is not None
    assert [to_unicode(line, solved("stanford-6").style) for line in step.result] == ["d₆₆ = I_6zz"]
    assert said("stanford-6", "dependence").endswith("it is the moment of inertia about its axis.")


@pytest.mark.parametrize(
    ("problem", "told"),
    [
        ("scara-rrpr", "g₁ = 0, g₂ = 0 and g₄ = 0: turning about a vertical axis changes no height. "),
        ("cylindrical-rpp", "g₁ = 0: turning about a vertical axis changes no height. "
         "g₃ = 0: sliding along a level axis changes no height. "),
        ("planar-2r", None),
    ],
)  # fmt: skip
def test_joints_that_gravity_does_not_load(problem: str, told: str | None) -> None:
    assert (check(problem, "unloaded") is None) if told is None else (said(problem, "unloaded") == told)


SINGLE = "dh: [{theta: q1*, a: l}]\nmasses: [{mass: m, link: 1}]\n"


@pytest.mark.parametrize("step_of", [*CHECKS[1:], *CHECKS_OF_LONGER_ARMS], ids=lambda made: made.__name__)
def test_a_check_speaks_of_some_robots_only(step_of: Callable[[Context], Step | None]) -> None:
    problems = ("planar-2r", "planar-2r-remote", "elbow-3r", "five-bar", "elastic-joint", POINTS, SINGLE)
    found = [step_of(context(problem)) for problem in problems]
    assert None in found and len({step.id for step in found if step is not None}) == 1


# -- signs ------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("formula", "nonnegative", "positive"),
    [
        ("m*l^2", True, True),
        ("m*(l - a)^2", True, False),
        ("m*l*a", False, False),
        ("m*sin(q)^2", True, False),
        ("m*sin(q)^2 + I", True, True),
        ("m*cos(q) + I", False, False),
        ("I - m*l^2", False, False),
        ("2*m/3", True, True),
    ],
)
def test_signs_that_can_be_seen(formula: str, nonnegative: bool, positive: bool) -> None:
    node, sure, constant = read(formula).tree, frozenset({"m", "I"}), frozenset({"m", "I", "l", "a"})
    assert is_nonnegative(node, sure) is nonnegative
    assert is_positive(node, sure, constant) is positive


# -- what is said is true, of any robot ------------------------------------------------------------


@settings(max_examples=5, deadline=None)
@given(robots(max_joints=3, physical=True))
def test_what_is_said_of_any_robot_is_true(problem: str) -> None:
    """Each check gives a step or none, and what two of them claim holds in numbers at a random state."""
    found = context.__wrapped__(problem)
    state = values_of(found, seed=1)
    assert {step.id for step in sanity_steps(found)} <= {
        made.__name__.removesuffix("_step") for made in (*CHECKS, *CHECKS_OF_LONGER_ARMS)
    }
    step = definite_step(found)
    if step is not None:
        value = determinant(found.values["D"])
        if "no inverse" in step.title:
            assert value.is_zero == step.title.endswith("no inverse")
        else:
            assert is_definite(found, state)


def is_definite(found: Context, state: dict[str, float]) -> bool:
    """Whether all eigenvalues of D are positive, and not by rounding."""
    matrix = np.array([[evaluate(entry, state) for entry in row] for row in found.values["D"].rows])
    return bool(np.linalg.eigvalsh(matrix).min() > 1e-12)


ELBOW = """
dh: [{theta: q1*, a: e, alpha: 90deg}, {theta: q2*, a: p}, {theta: q3*, a: r}]
masses: [{mass: m, link: 3}]
"""


@pytest.mark.parametrize(
    ("problem", "factors"),
    [
        (ELBOW, "m³ p² r² sin²(q₃) (e + p cos(q₂) + r cos(q₂ + q₃))²"),
        (POLAR, "m³ q₃² (e + q₃ sin(q₂))²"),
    ],
)
def test_a_determinant_shows_the_factors_that_may_be_0(problem: str, factors: str) -> None:
    assert said(problem, "definite").startswith(f"det D = {factors}, so D has no inverse where ")


@pytest.mark.parametrize(
    ("rows", "mass", "told"),
    [
        ("{theta: q1*, alpha: 90deg}, {theta: q2*, a: l}", "{mass: m, link: 2, shape: point}", "cos(q₂) = 0"),
        ("{theta: q1*, a: l1}, {theta: q2*, a: l2}", "{mass: m, link: 2, shape: point}", "sin(q₂) = 0"),
        ("{theta: q1*}, {d: q2*, alpha: 90deg}, {d: q3*}", "{mass: m, link: 3, shape: point}", "q₃ = 0"),
    ],
)
def test_where_a_factor_of_the_determinant_is_0_there_is_no_inverse(rows: str, mass: str, told: str) -> None:
    step = definite_step(context.__wrapped__(f"dh: [{rows}]\nmasses: [{mass}]\n"))
    assert step is not None and step.title == "Check: the inertia matrix has no inverse in some poses"
    assert [to_unicode(part) for part in step.why if isinstance(part, Relation)][-1] == told


def test_a_singular_matrix_would_be_noticed() -> None:
    points = context(POINTS)
    assert not is_definite(points, {**values_of(points, seed=1), "q2": 0.0})


def test_a_pose_puts_values_for_angles() -> None:
    found = context("elbow-3r")
    ring, entry = found.robot.ring, found.values["D"][0, 0]
    state = values_of(found, seed=2)
    there = ring.at_pose(entry, {"theta2": 90, "theta3": -90})
    expected = evaluate(entry, {**state, "theta2": np.pi / 2, "theta3": -np.pi / 2})
    assert evaluate(there, state) == pytest.approx(expected)


def test_blocks_and_determinants() -> None:
    D = context("elbow-3r").values["D"]
    assert sorted(blocks(D)) == [(0,), (1, 2)]
    whole: Expr = determinant(D)
    assert whole == D[0, 0] * (D[1, 1] * D[2, 2] - D[1, 2] * D[1, 2])
    assert masses_and_moments(context("elbow-3r").robot) >= {"m1", "I2xx", "I3zz"}
