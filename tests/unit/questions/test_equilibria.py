"""Equilibria and their stability: by hand, from exams, and against numbers."""

from __future__ import annotations

import re
from functools import cache
from math import acos, cos, pi, sin
from typing import Any

import pytest
import sympy
from msgspec.structs import replace

import dynsolve
from dynsolve.derivation.rules import derive
from dynsolve.derivation.search_ring import search_ring
from dynsolve.errors import VerificationError
from dynsolve.explain.forms import Forms
from dynsolve.notation.tree import Function, Number, Product, Quotient, Relation, Symbol, equation, walk
from dynsolve.notation.unicode import to_unicode
from dynsolve.problem import read_problem
from dynsolve.questions.equilibria import solving
from dynsolve.questions.equilibria.check import Case, holding, in_balance, verify_equilibria, verify_excluded
from dynsolve.questions.equilibria.forms import EquilibriaForms
from dynsolve.questions.equilibria.stability import Stability
from dynsolve.render.files import Format
from dynsolve.solution.leading import leading
from dynsolve.solution.reports import report
from tests.unit.answers.judging.test_equilibria import ARM, ELASTIC, FLAT, HELD, LIFT, MASSES, POLE

SPRUNG = """
gravity: [0, -g, 0]
dh: [{theta: q1*, a: l1}, {theta: q2*, a: l2}]
masses: [{mass: m1, link: 1}, {mass: m2, link: 2}]
springs: [{stiffness: k, of: q1 + q2}]
find: [equilibria]
"""


@pytest.mark.parametrize(
    ("problem", "equilibria"),
    [
        (ARM, [["cos(q1) = 0", "sin(q2) = 0"]]),
        (POLE, [["sin(theta) = 0"]]),
        (MASSES, [["q1 - q3 = 0", "q2 - q3 = 0"]]),  # Sapienza, Robotics 2, 28 October 2016: q1 = q2 = q3
        (ELASTIC, [["sin(q1) = 0", "q1 - q2 = 0"]]),
        (HELD, [["k*(q1 - q2) + m*g*l*sin(q1) = 0"]]),
        (SPRUNG, [["cos(q1) = 0", "k*(q1 + q2) + m2*g*l2*cos(q1 + q2) = 0"]]),  # and not with s₁s₂ for c₁₂
        (LIFT, []),
        (FLAT, [[]]),
    ],
)
def test_by_hand(problem: str, equilibria: list[list[str]]) -> None:
    assert dynsolve.solve(problem).to_json()["results"]["equilibria"] == equilibria


HUNG = """
gravity: [0, -9.81, 0]
dh: [{theta: q1*, a: l}]
masses: [{mass: m, link: 1, center: {near: [b, 0, 0]}}]
springs: [{stiffness: k, of: q1}]
find: [equilibria]
"""
LOADED = """
gravity: [0, 0, -9.81]
dh: [{d: d1*}]
masses: [{mass: m, link: 1}, {mass: M, link: 1, name: M}]
springs: [{stiffness: 120.5, of: d1, rest: 0.3}]
find: [equilibria]
"""


@pytest.mark.parametrize(
    ("problem", "lines"),
    [
        (HUNG, ["    k q₁ + 9.81 m b c₁ = 0", "stable where k > 9.81 m b s₁"]),
        (LOADED, ["    d₁ = (36.15 - 9.81 m - 9.81 M)/120.5"]),
    ],
)
def test_decimals_stand_as_they_were_typed(problem: str, lines: list[str]) -> None:
    text = report(dynsolve.solve(problem), Format.TEXT).decode()
    assert all(line in text for line in lines)


def test_a_given_model_is_stable_where_its_inertia_matrix_is_positive_definite() -> None:
    """D = [[1, 2], [2, 1]] and P = (x² + y²)/2: x - y grows as e^t."""
    model = (
        "model:\n  coordinates: {x: prismatic, y: prismatic}\n  D: [[a, b], [b, a]]\n  P: k*(x^2 + y^2)/2\n"
    )
    proviso = "All this is where 𝐃 is positive definite."
    assert proviso in read(f"{model}find: [equilibria]\n")
    assert proviso not in read(f"{model.replace('a, b], [b, a', 'a + b, b], [b, b')}find: [equilibria]\n")


def test_the_summary_says_that_forces_from_outside_are_left_out() -> None:
    arm = "dh: [{theta: q1*, a: l}]\nmasses: [{mass: m, link: 1}]\n"
    pushed = "gravity: none\nforces: [{link: 1, at: tip, force: [0, F, 0]}]\nfind: [equilibria]\n"
    assert "The equilibria without the forces from outside:" in read(arm + pushed).partition("Summary")[2]


@pytest.mark.parametrize(
    "assumed",
    ["l > 3", "m > 1000", "m > 5, g > 20*l", "m*g > 10000*l", "m > 10*g, m < 11*g, l > 60, l < 60.5"],
)
def test_what_is_assumed_may_be_far_from_one(assumed: str) -> None:
    """It is met by none of the values that parameters have otherwise."""
    arm = "gravity: [0, -g, 0]\ndh: [{theta: q1*, a: l}]\nmasses: [{mass: m, link: 1}]\n"
    found = dynsolve.solve(f"{arm}assume: [{assumed}]\nfind: [equilibria]\n").to_json()["results"]
    assert found["equilibria"] == [["cos(q1) = 0"]]


@pytest.mark.parametrize("assumed", ["m > l, l > m", "m < 0"])
def test_what_no_positive_values_satisfy_is_not_called_wrong(assumed: str) -> None:
    arm = "gravity: [0, -g, 0]\ndh: [{theta: q1*, a: l}]\nmasses: [{mass: m, link: 1}]\n"
    found = dynsolve.solve(f"{arm}assume: [{assumed}]\nfind: [equilibria]\n").to_json()["results"]
    assert "no positive values" in found["equilibria"]["skipped"]


def test_a_hanging_arm_is_stable_and_no_other() -> None:
    (points,) = dynsolve.solve(ARM).to_json()["results"]["equilibria_stability"]
    stable = [point for point in points if point["stability"] == "stable"]
    assert stable == [{"q1": "-pi/2", "q2": "0", "stability": "stable"}]
    assert len(points) == 4 and all(p["stability"] == "unstable" for p in points if p not in stable)


def test_a_pole_is_stable_below_wherever_the_cart_is() -> None:
    solution = dynsolve.solve(POLE)
    (points,) = solution.to_json()["results"]["equilibria_stability"]
    assert points == [
        {"theta": "0", "stability": "unstable"}, {"theta": "pi", "stability": "stable"},
    ]  # fmt: skip
    (step,) = (step for step in solution.steps if step.id == "equilibria_stability")
    assert "along which nothing changes" in str(step.concluding)


def test_an_elastic_joint_holds_below() -> None:
    (points,) = dynsolve.solve(ELASTIC).to_json()["results"]["equilibria_stability"]
    assert [point["stability"] for point in points] == ["stable", "unstable"]


def test_where_a_tangent_is_known_the_sign_of_its_cosine_decides() -> None:
    """By hand: with tan φ = -b/a the curvature a cos φ - b sin φ is (a² + b²) cos φ / a."""
    leaning = (
        "gravity: none\nmodel: {coordinates: {phi: revolute}, D: [[1]], P: '-a*cos(phi) + b*sin(phi)'}\n"
    )
    ((point,),) = dynsolve.solve(f"{leaning}find: [equilibria]\n").to_json()["results"][
        "equilibria_stability"
    ]
    assert (point["stable_if"], point["unstable_if"]) == (["cos(phi) > 0"], ["cos(phi) < 0"])
    tilted = ARM.replace("gravity: [0, -g, 0]", "gravity: [3*g/5, -4*g/5, 0]")
    (points,) = dynsolve.solve(tilted).to_json()["results"]["equilibria_stability"]
    assert [point.get("stable_if") for point in points] == [["cos(q1) > 0"], None]
    assert points[1] == {"q2": "pi", "stability": "unstable"}


def test_an_angle_that_is_given_ahead_of_a_coordinate_has_its_quarter_turns() -> None:
    """Along gravity, 30° from the vertical; and beside a spring that is at rest in both of its angles."""
    tilted = ARM.replace("gravity: [0, -g, 0]", "gravity: [g/2, -g*sqrt(3)/2, 0]")
    (points,) = dynsolve.solve(tilted).to_json()["results"]["equilibria_stability"]
    assert {"q1": "-pi/3", "q2": "0", "stability": "stable"} in points
    hands = """
gravity: [0, -g, 0]
dh: [{theta: q1*, a: a}, {theta: q2* + 30deg, a: b}, {from: 1, theta: q3* - 30deg, a: b}]
masses: [{mass: m, link: 2, shape: point}, {mass: m, link: 3, shape: point}]
springs: [{stiffness: k, of: q2 + q3}]
find: [equilibria]
"""
    found = dynsolve.solve(hands)
    (points,) = found.to_json()["results"]["equilibria_stability"]
    assert {"q1": "-pi/2", "q2": "-pi/6", "q3": "pi/6", "stability": "stable"} in points
    assert "For which parameters" not in str(told_of(hands).outcome)


def test_a_disk_on_a_slope_in_numbers_is_told_by_the_angle_from_the_vertical() -> None:
    """By hand: m e sin(φ + 20°) = -(M + m) R sin 20°, and stable where cos(φ + 20°) < 0."""
    disk = """
gravity: [g*sin(20deg), -g*cos(20deg), 0]
model:
  coordinates: {phi: revolute}
  bodies: [{mass: M, at: [R*phi, R, 0]}, {mass: m, at: [R*phi + e*sin(phi), R + e*cos(phi), 0]}]
find: [equilibria]
"""
    told = read(disk)
    assert "sin(φ + 20°) = -R (M + m) sin(20°)/(m e) Note: This has solutions" in told
    assert "stable where cos(φ + 20°) < 0, not stable where cos(φ + 20°) > 0." in told
    assert "solutions where m e - R (M + m) sin(20°) ≥ 0. Where the matrix" in told


def test_all_equilibria_of_an_angle_in_numbers_are_told() -> None:
    """By Newton's method: sin q = q/2 at q = 0 and q = ±1.89549; and with a spring at rest at 40°."""
    soft = """
gravity: [0, -10, 0]
model: {coordinates: {q: revolute}, bodies: [{mass: 2, at: [sin(q)/2, cos(q)/2, 0]}]}
springs: [{stiffness: 5, of: q}]
find: [equilibria]
"""
    assert "2sin(q) - q is 0 at q = 0, q ≈ 108.6° and q ≈ -108.6° alone." in read(soft)
    (found,) = re.findall(r"is 0 at (.*) alone", read(soft.replace("of: q", "of: q, rest: 40deg")))[:1]
    for angle in re.findall(r"-?[0-9.]+(?=°)", found):
        q = float(angle) * pi / 180
        assert abs(5 * (q - 40 * pi / 180) - 10 * sin(q)) < 0.02
    assert "° alone" not in read(soft.replace("stiffness: 5", "stiffness: k"))
    assert "alone" not in read(soft.replace("stiffness: 5", "stiffness: 1/10"))  # at too many


QUARTIC = """
gravity: none
model: {coordinates: {x: prismatic}, bodies: [{mass: m, at: [x, 0, 0]}]}
springs: [{energy: a*x^4/4 + b*x^2/2 - c*x^3/3}]
find: [equilibria]
"""


def test_a_quadratic_is_solved_and_each_root_is_judged() -> None:
    """By hand: x = 0 and the roots of a x² - c x + b, of which the greater is a minimum again."""
    told = read(QUARTIC)
    assert "x = c/(2a) ± √(c² - 4a b)/(2a)" in told
    assert "Case 2 has solutions where c² ≥ 4a b." in told
    apart = "In case 2: stable where c x > 2b, not stable where c x < 2b, in this order with + and -."
    assert apart in told


def test_a_case_that_is_assumed_not_to_be_there_is_none() -> None:
    assumed = QUARTIC.replace("find:", "assume: [4*a*b > c^2]\nfind:")
    assert dynsolve.solve(assumed).to_json()["results"]["equilibria"] == [["x = 0"]]
    assert "a x² + b - c x is not 0: its discriminant is negative." in read(assumed)


def test_the_greater_root_of_a_falling_quadratic_is_not_stable() -> None:
    """V = c y + b y²/2 - a y³/3: V'' = b - 2a y, which is negative at the greater root."""
    falling = QUARTIC.replace("a*x^4/4 + b*x^2/2 - c*x^3/3", "c*x + b*x^2/2 - a*x^3/3")
    told = read(falling)
    assert "x = b/(2a) ± √(4c a + b²)/(2a)" in told
    assert "stable where b > 2a x, not stable where b < 2a x, in this order with - and +." in told


def test_what_has_a_coefficient_of_its_own_is_solved_for() -> None:
    """s (k - m W²) = k l₀ + m g of a bead that falls along a turning rod; q₂ = n q₁ of two gears."""
    bead = """
gravity: [-g, 0, 0]
model: {coordinates: {s: prismatic}, D: [[m]], P: "k*(s - l0)^2/2 - 3*m*W^2*s^2/8 - m*g*s/2"}
find: [equilibria]
"""
    assert "s = 2(m g + 2k l₀)/(4k - 3m W²)" in read(bead)
    geared = ARM.replace("find:", "constraints: [q2 - n*q1]\nfind:")
    told = read(geared)
    assert "q₂ = n q₁" in told
    assert "has solutions" not in told  # the moments swing about 0 along this line


def test_a_length_at_rest_is_a_sum() -> None:
    hung = """
gravity: [0, -g, 0]
model: {coordinates: {s: prismatic}, bodies: [{mass: M, at: [0, s, 0]}, {mass: m, at: [0, s, 0]}]}
springs: [{stiffness: k, of: s, rest: s0}]
find: [equilibria]
"""
    assert "s = s₀ - g (M + m)/k" in read(hung)


LOADED = """
gravity: [0, -g, 0]
model:
  coordinates: {x: prismatic, q: revolute}
  bodies: [{mass: M, at: [x, 0, 0]}, {mass: m, at: [x + L*sin(q), L*cos(q), 0]}]
springs: [{stiffness: c, of: x, rest: d}, {energy: "k*q^2/2 + k*(x - d)*q"}, {stiffness: K, of: q}]
find: [equilibria]
"""


def test_where_a_spring_is_at_rest_is_told_beside_equations_with_parameters() -> None:
    """By hand: c (x - d) + k q = 0 and (K + k - k²/c) q = m g L sin q, which q = 0 solves."""
    ((point, _),) = dynsolve.solve(LOADED).to_json()["results"]["equilibria_stability"]
    assert point["q"] == "0"


@pytest.mark.parametrize(
    ("assumed", "equilibria"),
    [
        ("k > m*g*L", ["x - d = 0", "q = 0"]),
        ("2*k > m*g*L", ["x - d = 0", "m*g*L*sin(q) - k*q = 0"]),
    ],
)
def test_the_only_zero_of_what_grows_everywhere_is_the_equilibrium(
    assumed: str, equilibria: list[str]
) -> None:
    """|sin q| ≤ |q|: m g L sin q = k q at q = 0 alone where k > m g L."""
    alone = LOADED.replace(', {energy: "k*q^2/2 + k*(x - d)*q"}, {stiffness: K', ", {stiffness: k")
    problem = alone.replace("find:", f"assume: [{assumed}]\nfind:")
    assert dynsolve.solve(problem).to_json()["results"]["equilibria"] == [equilibria]
    told = read(problem)
    assert "k q - m g L sin(q) grows with q everywhere: it is 0 at q = 0 alone." in told
    assert ("Where k ≥ m g L, k q - m g L sin(q) grows" in told) == ("q = 0" not in equilibria)


def test_parameters_with_which_the_cases_say_the_same_are_not_special() -> None:
    """Where a c = b² both cases are x = y = 0, as the equations are then."""
    energy = "a*x^2/2 - b*x*y + c*y^2/2 + d*x^4/4"
    text = f"""
gravity: none
model: {{coordinates: {{x: prismatic, y: prismatic}}, K: m*(x'^2 + y'^2)/2, P: {energy}}}
find: [equilibria]
"""
    assert "Case 2 has solutions where b² ≥ a c." in read(text) and "a c = b²" not in read(text)


def test_where_a_sum_of_angles_is_known_stability_is_told_at_its_quarter_turns() -> None:
    """By hand: of k l² (1 - cos(a - b)) the angle between is held at 0 and falls from 180°."""
    angles = "coordinates: {a: revolute, b: revolute}, D: [[1, 0], [0, 1]]"
    model = f"gravity: none\nmodel: {{{angles}, P: '-k*l^2*cos(a - b)'}}\nfind: [equilibria]\n"
    (points,) = dynsolve.solve(model).to_json()["results"]["equilibria_stability"]
    assert points == [{"b - a": "0", "stability": "stable"}, {"b - a": "pi", "stability": "unstable"}]


def test_the_check_finds_what_is_wrong() -> None:
    robot = read_problem(ARM).robot
    values = derive(robot)
    forms, shown = Forms(robot, values), EquilibriaForms(robot, values).equilibria
    g = forms("g")
    zeros = in_balance(forms, g)
    (points,) = values["equilibria"].points
    right = Case(shown[0], points)
    verify_equilibria(robot, g, zeros, [right])
    with pytest.raises(VerificationError, match="missing"):
        verify_equilibria(robot, g, zeros, [])
    with pytest.raises(VerificationError, match="moves"):
        verify_equilibria(robot, g, zeros, [Case((shown[0][0],), ())])
    turned = tuple(replace(point, stability=Stability.STABLE) for point in points)
    with pytest.raises(VerificationError, match="stability"):
        verify_equilibria(robot, g, zeros, [Case(shown[0], turned)])
    assert Symbol("q1") not in shown[0]


SEESAW = """
gravity: [0, -g, 0]
model:
  coordinates: {q1: revolute, q2: revolute}
  bodies:
    - {mass: m1, at: [l1*cos(q1), l1*sin(q1), 0]}
    - {mass: m2, at: [l3*cos(q2) - l2*cos(q1), l3*sin(q2) - l2*sin(q1), 0]}
find: [equilibria]
"""


def of_energy(energy: str, names: str = "xyz") -> dict[str, Any]:
    """What is told of unit masses on lines in this potential energy."""
    kinds = ", ".join(f"{name}: prismatic" for name in names)
    D = [[int(i == j) for j in names] for i in names]
    model = f"model: {{coordinates: {{{kinds}}}, D: {D}, P: '{energy}'}}"
    return dynsolve.solve(f"gravity: none\n{model}\nfind: [equilibria]\n").to_json()["results"]


def test_a_factor_that_may_be_0_is_told_with_the_equilibria_there() -> None:
    solution = dynsolve.solve(SEESAW)
    results = solution.to_json()["results"]
    assert results["equilibria"] == [["cos(q1) = 0", "cos(q2) = 0"]]
    assert results["equilibria_special"] == [{"where": "m1*l1 = m2*l2", "equilibria": [["cos(q2) = 0"]]}]
    (step,) = (step for step in solution.steps if step.id == "equilibria")
    assert [str(note[0]) for note in step.notes] == ["These are the equilibria where ", "Where "]
    assert "≠" in str(step.notes[0]) and "equilibria_special" not in dynsolve.solve(ARM).to_json()["results"]


def test_that_parameters_may_forbid_a_case_is_said_where_it_is_not_seen() -> None:
    """φ stands outside of a sine, so that it is not seen how far the others reach."""
    energy = "k1*(r*phi - b)^2/2 + k2*phi - m*g*r"
    model = "model: {coordinates: {r: prismatic, phi: revolute}, D: [[m, 0], [0, J]], P: '%s'}\n"
    for text, is_said in ((model % energy, True), (ARM, False)):
        shown = report(dynsolve.solve(text + "find: [equilibria]\n" * is_said), Format.TEXT).decode()
        assert ("For which parameters this has solutions is not told here." in shown) == is_said


CROSSING = """
gravity: [0, -g, 0]
dh: [{theta: q1*, a: L}, {theta: q2*, a: L}]
masses: [{mass: m, link: 1, center: midpoint}, {mass: m, link: 2, center: midpoint}]
constraints: [tip.y]
find: [equilibria]
"""


def test_where_curves_meet_the_energy_is_looked_at_along_each() -> None:
    """By hand: s₁ + s₁₂ = 0 where q₂ = 180° or q₂ = -2q₁; along both curves P = m g L sin q₁."""
    solution = dynsolve.solve(CROSSING)
    (points,) = solution.to_json()["results"]["equilibria_stability"]
    assert {point["q1"]: point["stability"] for point in points} == {"pi/2": "unstable", "-pi/2": "stable"}
    (points,) = dynsolve.solve(CROSSING.replace("-g", "g")).to_json()["results"]["equilibria_stability"]
    assert {point["q1"]: point["stability"] for point in points} == {"pi/2": "stable", "-pi/2": "unstable"}


def test_the_check_would_see_another_stability_where_curves_meet() -> None:
    solution = dynsolve.solve(CROSSING)
    found = solution.values["equilibria"]
    turned = {Stability.STABLE: Stability.UNSTABLE, Stability.UNSTABLE: Stability.STABLE}
    points = tuple(replace(point, stability=turned[point.stability]) for point in found.points[0])
    assert all(point.is_crossing for point in points)
    forms = solution.forms
    zeros = in_balance(forms, forms("g"))
    shown = EquilibriaForms(solution.robot, solution.values)
    case = Case(tuple(shown.equilibria[0]), points)
    with pytest.raises(VerificationError, match="the stability told is another"):
        verify_equilibria(solution.robot, forms("g"), zeros, [case], constraints=forms("Ac"))


SPRUNG_JOINTS = """
gravity: [0, -g, 0]
dh: [{theta: q1*, a: l1}, {theta: q2*, a: l2}]
masses: [{mass: m1, link: 1}, {mass: m2, link: 2}]
springs: [{of: q1, stiffness: k1}, {of: q2, stiffness: k2}]
find: [equilibria]
"""
HELD_BY_TORQUE = """
model:
  coordinates: {t: revolute, s: revolute}
  D: [[J, 0], [0, M]]
  P: A*cos(t) + B*cos(t - s) + e*s*cos(t) + k*s^2/2 - T*t
find: [equilibria]
"""
"""Along t the energy falls without end; without T it is periodic there."""
CURVED = HELD_BY_TORQUE.replace("k*s^2/2 - T*t", "k*s^2*cos(t)/2")
"""The stiffness is negative where cos t is."""


@pytest.mark.parametrize(
    ("problem", "is_there"),
    [
        (SPRUNG_JOINTS, True),
        (SPRUNG_JOINTS.replace("of: q2", "of: q1 - q2"), True),
        (
            SPRUNG_JOINTS.replace(
                "{of: q1, stiffness: k1}, {of: q2, stiffness: k2}", "{of: q1 + q2, stiffness: k}"
            ),
            None,
        ),
        (HELD_BY_TORQUE, False),
        (HELD_BY_TORQUE.replace(" - T*t", " - T*s"), True),
        (CURVED, False),
    ],
)
def test_an_energy_that_grows_beyond_all_bounds_is_least_somewhere(
    problem: str, is_there: bool | None
) -> None:
    """By hand: two springs whose deflections give both angles; one alone leaves a line without any."""
    told = str(told_of(problem).outcome)
    assert ("is least somewhere: this always has solutions" in told) is bool(is_there)
    if is_there is not None:
        assert ("is not told here" in told.split("How stable")[0]) is not is_there


HANGING = """
gravity: [0, -g, 0]
dh: [{theta: q1*, a: l1}, {theta: q2*, alpha: 90deg}, {d: q3*}]
masses: [{mass: m1, link: 1}, {mass: m3, link: 3, center: origin}]
constraints: [tip.x, tip.y + h]
find: [equilibria]
"""
"""The tip below the base, an elbow above or below it: the third joint is as long as that asks for."""


@pytest.mark.parametrize("problem", [SPRUNG, HANGING])
def test_an_equation_that_a_coordinate_of_its_own_solves_forbids_nothing(problem: str) -> None:
    """By hand: k q₂ + m₂ g l₂ cos(q₁ + q₂) + k q₁ goes from -∞ to ∞; l₁ + q₃ + h = 0 gives q₃."""
    assert "is not told here" not in str(told_of(problem).notes)


def test_what_nothing_changes_along_is_left_out_of_the_matrix_and_of_what_is_not_stable() -> None:
    mast = "dh: [{theta: q1*, alpha: 90deg}, {theta: q2*, a: l}]\nmasses: [{mass: m, link: 2}]\n"
    shown = " ".join(report(dynsolve.solve(mast + "find: [equilibria]\n"), Format.TEXT).decode().split())
    assert "energy, without the row and column of q₁, which are 0 there, is positive definite" in shown
    assert "At q₂ = 90°: not stable. At q₂ = -90°: stable, but for q₁, along which" in shown


def test_what_is_left_out_of_the_matrix_may_stand_in_the_rest() -> None:
    """At a = 0 the rest is m g l: positive for l > 0, of which nothing is told, as l may change."""
    hoist = """
gravity: [0, -g, 0]
model:
  coordinates: {l: prismatic, a: revolute}
  bodies: [{mass: m, at: [l*sin(a), -l*cos(a), 0]}]
passive: [a]
inputs: given
find: [equilibria]
"""
    shown = " ".join(report(dynsolve.solve(hoist), Format.TEXT).decode().split())
    assert "column of l, which are 0 there, for every l is positive definite, the equilibrium" in shown
    assert "At a = 0: not stable where l < 0. At a = 180°" in shown


def test_an_answer_for_parameters_that_are_special_is_judged_by_the_forces() -> None:
    values = "values: {m1: 2, l1: 1, m2: 1, l2: 2}\n"
    for written, verdict in (("cos(q2) = 0", "correct"), ("cos(q1) = 0 and cos(q2) = 0", "wrong")):
        report = dynsolve.check(SEESAW + values, f"answers:\n  equilibria: ['{written}']\n")
        assert str(report.answers[0].verdict) == verdict


@pytest.mark.parametrize(
    ("energy", "special"),
    [
        ("a*x*y + b*x^2/2 + c*y^2/2 - d*x - e*y",
         [{"where": "a**2 = b*c", "equilibria": [["a*y + b*x - d = 0"]], "exist": ["a*d = b*e"]}]),
        ("a*x*y + b*x^2/2 + c*y^2/2 - d*x", [{"where": "a**2 = b*c", "equilibria": []}]),
        ("(a - b)*x^2 + (a - b)*y^2", [{"where": "a = b", "equilibria": [[]]}]),
        ("(a - b)*x^2*y^2/2 + (a - b)*x*y", [{"where": "a = b", "equilibria": [[]]}]),
        ("(a - b)*x^2 + c*y^2 + d*x", [{"where": "a = b", "equilibria": []}]),
    ],
)  # fmt: skip
def test_what_is_multiplied_by_counts_too(energy: str, special: list[dict[str, Any]]) -> None:
    assert of_energy(energy, "xy").get("equilibria_special", []) == special


SLOPE = """
gravity: [0, -g, 0]
model: {coordinates: {x: prismatic, y: prismatic}, bodies: [{mass: m, at: [x, y, 0]}]}
constraints: [x*sin(alpha) - y*cos(alpha)]
find: [equilibria]
"""
PULLEYS = """
gravity: [0, -g, 0]
model:
  coordinates: {x: prismatic, y: prismatic, z: prismatic}
  bodies: [{mass: m1, at: [0, -x, 0]}, {mass: m2, at: [0, -y, 0]}, {mass: m3, at: [0, -z, 0]}]
constraints: [x + 2*y + z - L]
find: [equilibria]
"""
CONE = """
gravity: [0, 0, -g]
model:
  coordinates: {psi: revolute, r: prismatic}
  bodies: [{mass: m, at: [r*sin(alpha)*cos(psi), r*sin(alpha)*sin(psi), r*cos(alpha)]}]
steady: {psi: W}
find: [equilibria]
"""


@pytest.mark.parametrize(
    ("problem", "special"),
    [
        (SLOPE, {"where": "sin(alpha) = 0", "equilibria": [["y = 0"]]}),  # level: wherever it lies
        (PULLEYS, {"where": "2*m1 = m2", "equilibria": [["x + 2*y + z - L = 0"]], "exist": ["m2 = 2*m3"]}),
        (CONE, {"where": "sin(alpha) = 0", "equilibria": []}),  # upright: it falls
    ],
)
def test_what_special_parameters_ask_of_others_is_no_equation_of_the_set(
    problem: str, special: dict[str, Any]
) -> None:
    assert dynsolve.solve(problem).to_json()["results"]["equilibria_special"] == [special]


def test_what_is_divided_by_and_changes_nothing_is_not_special() -> None:
    """Two masses on a turning rod, by hand: with M W² = k, too, r = -m b/M and s = b."""
    rod = """
gravity: none
model:
  coordinates: {psi: revolute, r: prismatic, s: prismatic}
  bodies:
    - {mass: M, at: [r*cos(psi), r*sin(psi), 0]}
    - {mass: m, at: [s*cos(psi), s*sin(psi), 0]}
springs: [{stiffness: k, of: s - r, rest: b}]
steady: {psi: W}
find: [equilibria]
"""
    (special,) = dynsolve.solve(rod).to_json()["results"]["equilibria_special"]
    assert special == {"where": "M*m*W**2 = k*(M + m)", "equilibria": []}


def test_a_negative_minor_of_any_size_decides() -> None:
    """The minors of sizes 1 and 2 are positive, and x + y + z falls (by hand: 1 - 2·3/4 < 0)."""
    energy = "x^2 + y^2 + z^2 - 3*(x*y + y*z + x*z)/2"
    assert of_energy(energy)["equilibria_stability"] == [[{"stability": "unstable"}]]


def test_only_where_both_sides_are_equal_nothing_is_decided() -> None:
    (points,) = of_energy("a*x^2/2 - b*x^2/2 + (c - d)*y^2/2", "xy")["equilibria_stability"]
    (point,) = points
    assert point["stability"] == "undecided" and len(point["stable_if"]) == len(point["unstable_if"]) == 2


def test_a_row_that_is_0_at_a_point_alone_leaves_nothing_neutral() -> None:
    """P = y²/2 - x⁴ falls along x, where its second derivatives are 0."""
    assert of_energy("c*y^2/2 - b*x^4", "xy")["equilibria_stability"] == [[{"stability": "unstable"}]]


PUSHED = (
    "gravity: [0, -g, 0]\ndh: [{theta: q1*, a: l1}, {theta: q2*, a: l2}]\n"
    "masses: [{mass: m1, link: 1}, {mass: m2, link: 2}]\nfind: [equilibria]\n"
)


def test_that_forces_from_outside_are_left_out_is_said() -> None:
    force = "forces: [{link: 2, at: tip, force: [F, 0, 0]}]\n"
    for problem, is_told in ((PUSHED, False), (PUSHED + force, True)):
        (step,) = (s for s in dynsolve.solve(problem).explain(["equilibria"]) if s.id == "equilibria")
        words = "".join(part for part in step.why if isinstance(part, str))
        assert ("The forces from outside do not act." in words) is is_told
        assert step.concluding == ("All are 0 where:",)


def test_alternatives_are_said_to_be_cases() -> None:
    (step,) = (s for s in dynsolve.solve(HOOP).explain(["equilibria"]) if s.id == "equilibria")
    assert len(step.result) == 2 and step.concluding == ("It is 0 in these cases:",)


HOOP = """
gravity: [0, 0, -g]
model:
  coordinates: {phi: revolute, theta: revolute}
  bodies:
    - {mass: m, at: [R*sin(theta)*cos(phi), R*sin(theta)*sin(phi), -R*cos(theta)]}
    - {mass: M, at: [0, 0, 0], turn: phi, about: [0, 0, 1], inertia: {zz: I}}
passive: [theta]
steady: {phi: W}
find: [equilibria]
"""


LOOP = """
gravity: [0, -g, 0]
dh: [{theta: q1*, a: l}, {theta: q2*, a: l}]
masses: [{mass: m1, link: 1}, {mass: m2, link: 2}]
constraints: [tip.x - k]
find: [equilibria]
"""
NUMBERS = {"l": 0.7, "k": 0.9, "m1": 1.3, "m2": 0.4, "g": 9.8}


def test_constraints_hold_what_they_can_in_an_equilibrium() -> None:
    solution = dynsolve.solve(LOOP)
    (case,) = solution.to_json()["results"]["equilibria"]
    sides = [equation.removesuffix(" = 0") for equation in case]
    length, k, m1, m2, g = NUMBERS.values()

    def elbow(a: float) -> float:
        return acos(k / length - cos(a)) - a  # the tip on the wall

    def energy(a: float) -> float:
        return g * length * ((m1 + m2) * sin(a) + m2 * sin(a + elbow(a)))

    low, high = 0.1, 1.27
    for _ in range(100):
        x, y = low + (high - low) / 3, high - (high - low) / 3
        low, high = (x, high) if energy(x) < energy(y) else (low, y)
    a, b = low, elbow(low)
    assert 0.2 < a < 1.2  # the greatest energy, inside
    at = {**NUMBERS, "q1": a, "q2": b}
    values = [sympy.sympify(side).subs(at) for side in sides]
    assert all(abs(value) < 1e-6 for value in values)
    assert all(abs(sympy.sympify(side).subs({**at, "q1": a + 0.1})) > 1e-3 for side in sides)
    assert solution.to_json()["results"]["equilibria_stability"] == [[{"stability": "undecided"}]]


BEAD = """
gravity: [0, -g, 0]
model:
  coordinates: {x: prismatic, y: prismatic, theta: revolute}
  bodies:
    - {mass: m, at: [x, y, 0]}
    - {mass: M, at: [l*cos(theta), l*sin(theta), 0], turn: theta, about: [0, 0, 1], inertia: {zz: I}}
constraints: [x - a*cos(theta), y - a*sin(theta)]
find: [equilibria]
"""


def test_a_rod_that_carries_a_bead_hangs_or_stands() -> None:
    (case,) = dynsolve.solve(BEAD).to_json()["results"]["equilibria"]
    assert sorted(case) == ["a*sin(theta) - y = 0", "cos(theta) = 0", "x = 0"]
    held = f"{BEAD}inputs: given\npassive: [x]\n"  # motors hold the rest: what the constraints allow
    (case,) = dynsolve.solve(held).to_json()["results"]["equilibria"]
    assert sorted(case) == ["a*cos(theta) - x = 0", "a*sin(theta) - y = 0"]


def test_a_skate_stands_across_its_slope() -> None:
    skate = """
gravity: [-g, 0, 0]
model:
  coordinates: {x: prismatic, y: prismatic, phi: revolute}
  bodies: [{mass: m, at: [x, y, 0], turn: phi, about: [0, 0, 1], inertia: {zz: J}}]
constraints: [{rates: "x'*sin(phi) - y'*cos(phi)"}]
find: [equilibria]
"""
    solution = dynsolve.solve(skate)
    assert solution.to_json()["results"]["equilibria"] == [["cos(phi) = 0"]]
    (step,) = (step for step in solution.steps if step.id == "equilibria")
    assert "are arbitrary" in str(step.notes)


def test_one_angle_is_told_by_its_tangent() -> None:
    bent = """
gravity: [0, -g, 0]
dh: [{theta: q1*, a: l}]
masses: [{mass: m, link: 1, center: {near: [b, c, 0]}, inertia: {zz: I}}]
find: [equilibria]
"""
    (step,) = (step for step in dynsolve.solve(bent).steps if step.id == "equilibria")
    b, c = Symbol("b"), Symbol("c")
    (result,) = step.result
    assert [*walk(result)].count(equation(Function("tan", Symbol("q1")), Quotient(b, c))) == 1


def test_no_number_stands_before_what_is_zero() -> None:
    wire = """
gravity: [0, -g, 0]
model: {coordinates: {x: prismatic, y: prismatic}, bodies: [{mass: m, at: [x, y, 0]}]}
springs: [{stiffness: k, of: x - y}]
constraints: [y - b*x*x]
find: [equilibria]
"""
    (step,) = (step for step in dynsolve.solve(wire).steps if step.id == "equilibria")
    sides = [node.parts[0] for one in step.result for node in walk(one) if isinstance(node, Relation)]
    assert len(sides) == 4
    assert not any(isinstance(side, Product) and isinstance(side.factors[0], Number) for side in sides)
    assert not any(isinstance(side, Quotient) for side in sides)


def test_masses_on_a_spring_drift_together_and_hold_their_distance() -> None:
    chain = """
gravity: none
model:
  coordinates: {x: prismatic, y: prismatic}
  bodies: [{mass: m1, at: [x, 0, 0]}, {mass: m2, at: [y, 0, 0]}]
springs: [{stiffness: k, of: x - y}]
find: [equilibria]
"""
    solution = dynsolve.solve(chain)
    assert solution.to_json()["results"]["equilibria_stability"] == [[{"stability": "stable"}]]
    (step,) = (step for step in solution.steps if step.id == "equilibria_stability")
    assert "but for motions along the equilibria" in str(step.concluding)
    pushed = chain.replace("of: x - y", "energy: -k*(x - y)^2/2").replace("stiffness: k, ", "")
    (points,) = dynsolve.solve(pushed).to_json()["results"]["equilibria_stability"]
    assert points == [{"stability": "unstable"}]


def test_equilibria_where_a_constraint_loses_its_rank_are_found() -> None:
    """Two links of one length, the tip on a level line: g and ∂h/∂q are 0 where one lies on the other."""
    arm = """
gravity: [0, -g, 0]
dh: [{theta: q1*, a: l}, {theta: q2*, a: l}]
masses: [{mass: m1, link: 1}, {mass: m2, link: 2}]
constraints: [tip.y]
find: [equilibria]
"""
    (alternative,) = dynsolve.solve(arm).to_json()["results"]["equilibria"]
    known = {"sin": sin, "cos": cos, "q1": pi / 2, "q2": pi}
    for one in alternative:
        assert abs(eval(one.removesuffix(" = 0"), known)) < 1e-9  # noqa: S307


LINE = """
gravity: [0, -g, 0]
dh: [{theta: q1*, a: l}, {theta: q2*, a: l2}]
masses:
  - {mass: m1, link: 1, center: {near: [lc1, 0, 0]}}
  - {mass: m2, link: 2, center: {near: [lc2, 0, 0]}}
constraints: [tip.y]
find: [equilibria]
"""
WALL = LINE.replace("l2}]", "l}]").replace("tip.y", "tip.x")
"""Links of one length, the tip on an upright line: folded, the row of A_c is 0 where the links are level."""


@cache
def results_of(problem: str) -> dict[str, Any]:
    """What is asked of in several poses, or by several tests."""
    return dynsolve.solve(problem).to_json()["results"]


def at_pose(problem: str, **pose: float) -> list[bool]:
    """Of each alternative whether its equations hold in a pose, and those of no set that is left out."""
    results = results_of(problem)
    values = {
        "l": 0.7,
        "m1": 1.3,
        "m2": 0.4,
        "lc1": 0.3,
        "lc2": 0.6,
        "k": 0.9,
        "sin": sin,
        "cos": cos,
        **pose,
    }

    def hold(equations: list[str]) -> bool:
        return all(abs(eval(one.removesuffix(" = 0"), dict(values))) < 1e-9 for one in equations)  # noqa: S307

    sets = results["equilibria"]
    left_out = results.get("equilibria_except", [[]] * len(sets))
    return [hold(one) and not any(map(hold, without)) for one, without in zip(sets, left_out, strict=True)]


def test_where_a_constraint_holds_nothing_is_no_equilibrium() -> None:
    """By hand: upright g is 0; folded and level A_c is 0, and g is not."""
    assert results_of(WALL)["equilibria"] == [
        ["cos(q2/2) = 0", "cos(q1) = 0"],
        ["cos(q1) = 0", "sin(q2/2) = 0"],
    ]
    for upright in (pi / 2, -pi / 2):
        assert any(at_pose(WALL, q1=upright, q2=0.0)) and any(at_pose(WALL, q1=upright, q2=pi))
    for level in (0.0, pi):
        assert not any(at_pose(WALL, q1=level, q2=pi))
    upright = "answers:\n  equilibria: ['cos(q1) = 0 and sin(q2) = 0']\n"
    level = "answers:\n  equilibria: ['cos(q1) = 0 and sin(q2) = 0', 'sin(q1) = 0 and cos(q2) = -1']\n"
    for written, verdict in ((upright, "correct"), (level, "wrong")):
        assert str(dynsolve.check(WALL, written).answers[0].verdict) == verdict


REACH = """
gravity: [0, -g, 0]
dh:
  - {theta: q1*, a: l1}
  - {theta: q2*, a: l2}
masses:
  - {mass: m1, link: 1}
  - {mass: m2, link: 2}
constraints: [tip.x - l1]
find: [equilibria]
"""


def test_where_lengths_let_the_rows_be_dependent_what_is_none_is_told() -> None:
    """By hand: with l₂ = 2 l₁ the arm may fold back on x = l₁, where A_c is 0, and g is not."""
    solution = dynsolve.solve(REACH)
    results = solution.to_json()["results"]
    folded = [["1 + cos(q1) = 0", "1 + cos(q2) = 0"]]
    assert results["equilibria_special"] == [{"where": "2*l1 = l2", "equilibria_except": folded}]
    (step,) = (step for step in solution.steps if step.id == "equilibria")
    _, note = step.notes  # before it: that lengths may be too short is not told
    assert "no equilibrium" in str(note)
    results = dynsolve.solve(REACH.replace("a: l2", "a: 2*l1")).to_json()["results"]
    assert results["equilibria_except"] == [folded] and "equilibria_special" not in results


def test_what_an_inequality_says_is_not_said_once_more() -> None:
    """By hand: below V has the curvature m g + l k - m l W² along both angles; where > 0, it is not 0."""
    double = """
gravity: [0, 0, -g]
model:
  coordinates: {psi: revolute, q1: revolute, q2: revolute}
  bodies:
    - {mass: m, at: [l*sin(q1)*cos(psi), l*sin(q1)*sin(psi), -l*cos(q1)]}
    - {mass: m, at: [l*sin(q2)*cos(psi), l*sin(q2)*sin(psi), -l*cos(q2)]}
springs: [{energy: k*l^2*(1 - cos(q1)*cos(q2))}]
steady: {psi: W}
find: [equilibria]
"""
    told = dynsolve.solve(double).to_json()["results"]["equilibria_stability"][-1]
    below = next(point for point in told if (point["q1"], point["q2"]) == ("0", "0"))
    assert below["stable_if"] == ["m*g + l*k > m*l*W**2"]


PARALLELOGRAM = """
gravity: [0, -g, 0]
dh: [{theta: q1*, a: l1}, {theta: q2*, a: l2}, {theta: q3*, a: l1}]
masses:
  - {mass: m1, link: 1, center: midpoint}
  - {mass: m2, link: 2, center: midpoint}
  - {mass: m1, name: c, link: 3, center: midpoint}
constraints: [tip.x - l2, tip.y]
find: [equilibria]
"""


def test_for_special_lengths_what_is_left_out_may_be_an_equilibrium() -> None:
    """By hand: with l₁ = l₂ it folds to q = (0, 90°, 180°), where A_c is singular and holds g."""
    solution = dynsolve.solve(PARALLELOGRAM)
    (step,) = (step for step in solution.steps if step.id == "equilibria")
    assert "no equilibrium, but for special values of the parameters." in str(step.notes[-1])
    robot = read_problem(PARALLELOGRAM).robot
    values = derive(robot)
    forms, found = Forms(robot, values), values["equilibria"]
    g, sets = forms("g"), EquilibriaForms(robot, values).excluded[0]
    given = (sets, in_balance(forms, g), holding(forms, g))
    verify_excluded(robot, found, *given)
    with pytest.raises(VerificationError, match="special"):
        verify_excluded(robot, replace(found, may_be_others=False), *given)


def test_a_cusp_holds_nothing() -> None:
    """y² = x³: where gᵀ and the row of A_c are dependent, that row is 0, and g is not."""
    cusp = """
gravity: [0, -g, 0]
model: {coordinates: {x: prismatic, y: prismatic}, bodies: [{mass: m, at: [x, y, 0]}]}
constraints: [y*y - x*x*x]
find: [equilibria]
"""
    solution = dynsolve.solve(cusp)
    assert solution.to_json()["results"]["equilibria"] == []
    (step,) = (step for step in solution.steps if step.id == "equilibria")
    assert "no configuration" not in str(step.notes) and "are dependent" in str(step.notes)


def test_equal_links_on_a_level_line_are_solved_for() -> None:
    level = LINE.replace("l2}]", "l}]")
    assert dynsolve.solve(level).to_json()["results"]["equilibria"] == [["cos(q1) = 0", "cos(q2/2) = 0"]]


def test_a_sum_of_sines_is_taken_apart() -> None:
    """By hand: sin q₁ + sin(q₁ + q₂) is 2 sin(q₁ + q₂/2) cos(q₂/2), and where the latter is 0 A_c is, too.

    With q₂ = -2q₁ the rest is cos q₁ times 4k sin q₁ - g (m₁ l_c1 + m₂ (l - l_c2)).
    """
    level = LINE.replace("l2}]", "l}]") + "springs: [{energy: k*(cos(q1) + cos(q1 + q2))^2/2}]\n"
    bent, folded = dynsolve.solve(level).to_json()["results"]["equilibria"]
    assert bent == ["sin(q1 + q2/2) = 0", "4*k*sin(q1) - g*(m1*lc1 + m2*(l - lc2)) = 0"]
    assert folded == ["cos(q1) = 0", "cos(q2/2) = 0"]


def test_a_sum_of_angles_that_is_known_is_put_into_what_is_left() -> None:
    """By hand: with q₂ = -2q₁ it is sin q₁ (m g l + 2k d cos q₁); where the bracket is 0 the energy falls."""
    text = """
gravity: [0, -g, 0]
dh: [{theta: q1* - 90deg, a: l}, {theta: q2*, a: l}]
masses: [{mass: m, link: 2}]
springs: [{energy: -k*d*cos(q2)}]
find: [equilibria]
"""
    found = results_of(text)
    bent, straight = found["equilibria"]
    assert bent == ["sin(q1 + q2/2) = 0", "m*g*l + 2*k*d*cos(q1) = 0"]
    assert straight == ["sin(q1) = 0", "sin(q2/2) = 0"]
    assert found["equilibria_exist"] == [["2*k*d >= m*g*l"], []]
    assert {one["stability"] for one in found["equilibria_stability"][0]} == {"unstable"}


@pytest.mark.parametrize(
    ("problem", "exist"),
    [
        (LINE, [["l2 >= l"], ["l >= l2"]]),
        (LINE.replace("l2}]", "l}]").replace("tip.y", "tip.y - k"), [["2*l >= k"], ["2*l >= k"]]),
        (
            LINE.replace("tip.y", "tip.y - k"),
            [["l + l2 >= k", "k + l2 >= l"], ["k + l >= l2", "l + l2 >= k"]],
        ),
    ],
)
def test_equilibria_are_told_where_they_are(problem: str, exist: list[list[str]]) -> None:
    """By hand: one link is upright, and the other reaches the line of the tip from its end."""
    found = results_of(problem)["equilibria_exist"]
    assert [sorted(one) for one in found] == [sorted(one) for one in exist]


def test_what_constraints_hold_is_stable_where_the_energy_is_least_along_them() -> None:
    """One link upright, the other level with it: P = g sin q₁ (m₁ l_c1 + m₂ l - m₂ l_c2 l/l₂) on the line."""
    results = results_of(LINE)
    up, down = results["equilibria_stability"][0]
    assert (up["q1"], down["q1"]) == ("pi/2", "-pi/2")
    for m1, lc2 in ((0.2, 1.4), (2.0, 0.3)):
        at = {"m1": m1, "m2": 1.0, "l": 0.6, "l2": 0.9, "lc1": 0.3, "lc2": lc2}
        slope = m1 * 0.3 + 0.6 - lc2 * 0.6 / 0.9
        for point, is_stable in ((up, slope < 0), (down, slope > 0)):
            assert all(eval(one, dict(at)) for one in point["stable_if"]) is is_stable  # noqa: S307
            assert any(eval(one, dict(at)) for one in point["unstable_if"]) is not is_stable  # noqa: S307


def test_the_check_of_what_constraints_hold_finds_another_stability() -> None:
    robot = read_problem(LINE).robot
    values = derive(robot)
    forms, shown, found = Forms(robot, values), EquilibriaForms(robot, values), values["equilibria"]
    g = forms("g")
    given = (robot, g, in_balance(forms, g))
    cases = [Case(*one) for one in zip(shown.equilibria, found.points, strict=True)]
    verify_equilibria(*given, cases, constraints=forms("Ac"))
    turned = [
        replace(
            case, points=tuple(replace(p, conditions=(), stability=Stability.STABLE) for p in case.points)
        )
        for case in cases
    ]
    with pytest.raises(VerificationError, match="stability"):
        verify_equilibria(*given, turned, constraints=forms("Ac"))


def test_a_matrix_that_is_0_on_its_diagonal_is_a_saddle() -> None:
    saddle = """
gravity: [0, 0, -g]
dh: [{theta: q1*, alpha: -90deg, a: l1}, {theta: q2*, a: l2}]
base: Ry(90deg)
masses: [{mass: m1, link: 1}, {mass: m2, link: 2}]
assume: [m2*l2 > (m1 + m2)*l1]
find: [equilibria]
"""
    _, points = dynsolve.solve(saddle).to_json()["results"]["equilibria_stability"]
    assert [point["stability"] for point in points] == ["unstable", "unstable"]


def test_an_angle_that_a_spring_holds_at_0_has_no_sine_there() -> None:
    """With q1 = 0 or 180° the spring alone acts on q2; where that is 0 the arm is stretched, and falls."""
    arm = """
dh:
  - {theta: q1*, a: l, alpha: 90deg}
  - {theta: q2*, d: 0, a: 0, alpha: -90deg}
  - {theta: 0, d: q3*}
base: Rx(90deg)
masses: [{mass: m1, link: 1}, {mass: m, link: 3}]
springs: [{stiffness: k, of: q2}]
find: [equilibria]
"""
    (held,) = dynsolve.solve(arm).to_json()["results"]["equilibria"]
    assert held == ["m*g*q3*sin(q1)*cos(q2) - k*q2 = 0", "sin(q2) = 0", "cos(q1) = 0"]


PARABOLA = """
gravity: [0, -g, 0]
model:
  coordinates: {x: prismatic, y: prismatic}
  bodies: [{mass: m, at: [x, y, 0]}]
constraints: [y - a*x^2]
springs: [{stiffness: k, of: y, rest: h}]
find: [equilibria]
"""


def test_second_derivatives_along_the_constraints_are_shown_with_their_values() -> None:
    """A bead on a wire: P = m g a x² + ½ k (a x² - h)² along x (by hand)."""
    solution = dynsolve.solve(PARABOLA)
    (step,) = (step for step in solution.steps if step.id == "equilibria_stability")
    shown = [to_unicode(node) for line in step.lines for node in line.formulas]
    assert [text.split(" = ")[-1] for text in shown if "∂" in text] == [
        "2a (m g - k h)",
        "-4a (m g - k h)",
    ]
    lowest, others = solution.to_json()["results"]["equilibria_stability"]
    assert lowest == [{"stability": "undecided", "stable_if": ["m*g > k*h"], "unstable_if": ["k*h > m*g"]}]
    assert others == [{"stability": "undecided", "stable_if": ["k*h > m*g"]}]


def test_the_check_finds_other_second_derivatives_along_the_constraints() -> None:
    robot = read_problem(PARABOLA).robot
    values = derive(robot)
    forms, shown, found = Forms(robot, values), EquilibriaForms(robot, values), values["equilibria"]
    g = forms("g")
    given = (robot, g, in_balance(forms, g))
    cases = [Case(*one) for one in zip(shown.equilibria, found.points, strict=True)]
    verify_equilibria(*given, cases, constraints=forms("Ac"))
    (point,) = cases[0].points
    wrong = replace(point.along, second=-point.along.second)
    turned = [replace(cases[0], points=(replace(point, along=wrong),)), *cases[1:]]
    with pytest.raises(VerificationError, match="curved along"):
        verify_equilibria(*given, turned, constraints=forms("Ac"))


def test_where_rows_of_the_constraint_are_dependent_nothing_is_said_of_stability() -> None:
    """A crank and its rod fold onto each other where they are as long: then the rod alone may turn."""
    crank = """
gravity: [0, -g, 0]
dh: [{theta: q1*, a: r}, {theta: q2*, a: l}]
masses: [{mass: m1, link: 1}, {mass: m2, link: 2}]
constraints: [tip.y]
find: [equilibria]
"""
    above, below = dynsolve.solve(crank).to_json()["results"]["equilibria_stability"][0]
    assert (above["stability"], below["stability"]) == ("undecided", "undecided")
    assert above["unstable_if"] == ["l > r"] and "stable_if" not in above
    assert below["stable_if"] == ["l > r"] and "unstable_if" not in below


def test_second_derivatives_do_not_decide_only_where_no_minor_is_negative() -> None:
    """A bead on a pendulum: in case 1 ∂²P/∂q₁² = 0, and the determinant is -(m g c₁)², which does decide."""
    told = dynsolve.solve(
        "gravity: [0, -g, 0]\n"
        "dh: [{theta: q1* + 90deg, alpha: 90deg}, {d: q2*}]\n"
        "masses: [{mass: M, link: 1, shape: point, center: [0, 0, b]}, {mass: m, link: 2}]\n"
        "springs: [{stiffness: k, of: q2, rest: b0}]\nfind: [equilibria]\n"
    ).to_markdown()
    assert "do not decide" not in told
    assert re.search(r"In case 1, where \$m\^\{2\} g > k .*\$: not\s+stable", told)


def test_on_a_slope_angles_are_told_by_that_of_the_slope() -> None:
    """cos(q1 - a) = 0, and q2 = 0 or 180°; of links whose base is turned it is the angle of that."""
    links = "dh: [{theta: q1*, a: l1}, {theta: q2*, a: l2}]\n"
    masses = ", ".join(f"{{mass: m{k}, link: {k}, center: tip, shape: point}}" for k in (1, 2))
    arm = f"{links}masses: [{masses}]\nfind: [equilibria]\n"
    tilted = dynsolve.solve(f"gravity: [g*sin(a), -g*cos(a), 0]\n{arm}")
    (points,) = tilted.to_json()["results"]["equilibria_stability"]
    assert [point for point in points if point["stability"] == "stable"] == [
        {"q1": "a - pi/2", "q2": "0", "stability": "stable"}
    ]
    assert [point["stability"] for point in points].count("unstable") == 3
    assert r"At $q_{1} = a - 90^{\circ}$, $q_{2} = 0$: stable" in " ".join(tilted.to_markdown().split())
    cart = "coordinates: {x: prismatic, theta: revolute}, bodies: [{mass: m1, at: [x, 0, 0]}, {mass: m2, at: "
    rod = f"model: {{{cart}[x + l*sin(theta), -l*cos(theta), 0]}}]}}\nsprings: [{{of: x, stiffness: k}}]\n"
    sliding = dynsolve.solve(f"gravity: [g*sin(b), -g*cos(b), 0]\n{rod}find: [equilibria]\n")
    assert sliding.to_json()["results"]["equilibria_stability"] == [
        [{"theta": "b", "stability": "stable"}, {"theta": "b + pi", "stability": "unstable"}]
    ]
    turned = dynsolve.solve(f"gravity: [0, -g, 0]\nbase: {{rotate: Rz(a)}}\n{arm}")
    (points,) = turned.to_json()["results"]["equilibria_stability"]
    assert {"q1": "-a - pi/2", "q2": "0", "stability": "stable"} in points


def test_half_angles_are_told_as_angles() -> None:
    """A spring along the chord, ½ k (2 R sin(θ/2))², beside gravity: V″ = (m g R + k R²) cos θ."""
    hoop = """
gravity: [0, 0, -g]
model:
  coordinates: {theta: revolute}
  bodies: [{mass: m, at: [R*sin(theta), 0, -R*cos(theta)]}]
springs: [{energy: k/2*(2*R*sin(theta/2))^2}]
find: [equilibria]
"""
    solution = dynsolve.solve(hoop)
    told = solution.to_json()["results"]["equilibria_stability"]
    assert {point["theta"]: point["stability"] for points in told for point in points} == {
        "0": "stable", "2*pi": "stable", "pi": "unstable", "-pi": "unstable"
    }  # fmt: skip
    assert r"At $\theta = 180^{\circ}$: not stable" in " ".join(solution.to_markdown().split())


def test_the_turn_of_a_disk_that_rolls_is_told_as_that() -> None:
    """A mass at the rim of a disk that has rolled x: y = r (1 + cos(x/r))."""
    disk = """
gravity: [0, -g, 0]
model:
  coordinates: {x: prismatic}
  bodies: [{mass: m, at: [x + r*sin(x/r), r + r*cos(x/r), 0]}]
find: [equilibria]
"""
    (points,) = dynsolve.solve(disk).to_json()["results"]["equilibria_stability"]
    assert [(point["x/r"], point["stability"]) for point in points] == [("0", "unstable"), ("pi", "stable")]


def told_of(text: str) -> Any:
    """The step of the equilibria."""
    (step,) = (step for step in dynsolve.solve(text).steps if step.id == "equilibria")
    return step


ELLIPSE = """
gravity: [0, -g, 0]
model: {coordinates: {x: prismatic, y: prismatic}, bodies: [{mass: m, at: [x, y, 0]}]}
springs: [{stiffness: k, of: x}]
constraints: [x^2/a^2 + y^2/b^2 - 1]
find: [equilibria]
"""


def test_a_product_over_lengths_is_taken_apart() -> None:
    """By hand: x (k y/b² - m g/a²) = 0."""
    step = told_of(ELLIPSE)
    assert [to_unicode(one).partition(" and ")[0] for one in step.result[:2]] == ["x = 0", "x = 0"]
    assert [to_unicode(one).partition(" and ")[2] for one in step.result[:2]] == ["y = b", "y = -b"]
    assert to_unicode(step.result[2]).startswith("y = m g b²/(a² k)")


def test_what_a_case_makes_no_zero_is_not_asked_to_be_none() -> None:
    """By hand: x² + y² = L², and with x = 0 the other equation has y = 0, too."""
    text = ELLIPSE.replace("x^2/a^2 + y^2/b^2 - 1", "x^2 + y^2 - L^2").replace("of: x", "of: x, rest: a")
    ((point,),) = dynsolve.solve(text).to_json()["results"]["equilibria_stability"]
    assert not any("!=" in one for one in point["stable_if"]) and "L**2" in str(point["stable_if"])


CRANK = """
gravity: [0, -g, 0]
dh: [{theta: q1*, a: r}, {theta: q2*, a: l}]
masses: [{mass: m, link: 1}]
constraints: [tip.y]
assume: [l > r]
find: [equilibria]
"""


def test_the_determinant_that_is_to_be_0_is_shown() -> None:
    """By hand: -m g r cos q₁ · l cos(q₁ + q₂)."""
    *_, size = told_of(CRANK).working
    assert to_unicode(size).startswith("det") and "m g r l cos(q₁) cos(q₁ + q₂)" in to_unicode(size)


def test_a_determinant_that_is_0_everywhere_is_shown() -> None:
    *_, size = told_of("""
    gravity: none
    dh: [{theta: q1*, a: l1}, {theta: q2*, a: l2}]
    masses: [{mass: m, link: 2}]
    constraints: [tip.x - tip.y]
    find: [equilibria]
    """).working
    assert to_unicode(size).startswith("det") and to_unicode(size).endswith("= 0")


def test_a_length_in_front_of_which_nothing_is_0_is_solved_for() -> None:
    """By hand: k (r - r₀) + m g cos b = 0, where b is a number of the problem."""
    text = """
gravity: [0, 0, -g]
model: {coordinates: {r: prismatic}, bodies: [{mass: m, at: [r*sin(b), 0, r*cos(b)]}]}
springs: [{stiffness: k, of: r, rest: r0}]
find: [equilibria]
"""
    (row,) = told_of(text).result
    assert to_unicode(row) == "r = r₀ - m g cos(b)/k"


def test_a_case_that_is_not_stable_inside_its_bounds_is_said_to_be_that() -> None:
    """At c2 = -b/a with a = 4 k, b = m2 g l2: the slope of g2 is (b² - a²)/a, which is negative."""
    arm = """
gravity: [g, 0, 0]
dh: [{theta: q1*, d: L, alpha: -90deg}, {theta: q2*, a: L, alpha: -90deg}]
masses: [{mass: m1, link: 1, center: {near: [l1, 0, 0]}}, {mass: m2, link: 2, center: {near: [l2, 0, 0]}}]
springs: [{energy: k*(1 - cos(2*q2))}]
find: [equilibria]
"""
    solution = dynsolve.solve(arm)
    found = solution.to_json()["results"]
    assert found["equilibria"][1] == ["sin(q1) = 0", "m2*g*l2*cos(q1) + 4*k*cos(q2) = 0"]
    at_0, _ = found["equilibria_stability"][1]
    assert at_0["stability"] == "undecided" and at_0["unstable_if"] == ["4*k > m2*g*l2"]
    opposite = next(
        point for point in found["equilibria_stability"][2] if point == {**point, "q1": "0", "q2": "pi"}
    )
    assert opposite["stable_if"] == ["m1*l1 > m2*l2", "4*k > m2*g*l2"]
    said = " ".join(solution.to_markdown().split())
    assert "In case 2 at $q_{1} = 0$, where $4 k > m_{2} g l_{2}$: not stable." in said


def test_what_each_equation_asks_for_is_not_said_to_be_enough_for_all() -> None:
    """At m1 = m2 = g = b = k = 1, a = 2, c = 20 each has a zero, but s1 = -1/2 makes s2 = 4."""
    two = """
gravity: [0, -g, 0]
model:
  coordinates: {q1: revolute, q2: revolute}
  bodies:
    - {mass: m1, at: [a*cos(q1), a*sin(q1), 0]}
    - {mass: m2, at: [b*cos(q2), b*sin(q2), 0]}
springs: [{energy: k*a*b*sin(q1)*sin(q2)}, {energy: c*sin(q1)^2/2}]
find: [equilibria]
"""
    told = " ".join(dynsolve.solve(two).to_markdown().split())
    assert "Case 1 has solutions only where" in told and "Case 1 has solutions where" not in told


def test_a_product_is_not_lost_when_rows_are_combined() -> None:
    """By hand: s2 (r c1 + l c12 - x0) = 0, and on the line s2 = 0 is s1 = 0; x0 < l - r is not reached."""
    crank = CRANK.replace("gravity: [0, -g, 0]", "gravity: none").replace("l > r", "l > r, x0 < l - r")
    spring = "springs: [{energy: k/2*(r*cos(q1) + l*cos(q1 + q2) - x0)^2}]\nfind:"
    solution = dynsolve.solve(crank.replace("find:", spring))
    assert solution.to_json()["results"]["equilibria"] == [["sin(q2) = 0", "sin(q1) = 0"]]
    assert "k r l (r + l) (x_{0} - r - l)" in solution.to_markdown()


def test_what_a_case_asks_for_is_no_factor_of_a_condition() -> None:
    """By hand, with u = m g - R k: sin(θ/2) = -k c/(2 u), and the slope of g there has the sign of -u."""
    chord = """
gravity: [0, -g, 0]
model: {coordinates: {theta: revolute}, bodies: [{mass: m, at: [R*sin(theta), R*cos(theta), 0]}]}
springs: [{energy: k/2*(2*R*sin(theta/2) - c)^2}]
assume: [c < 2*R]
find: [equilibria]
"""
    first, *_ = dynsolve.solve(chord).to_json()["results"]["equilibria_stability"][0]
    assert first["stable_if"][-1] == "R*k > m*g"


def test_what_no_coordinate_makes_0_is_told() -> None:
    text = """
model: {coordinates: {x: prismatic, y: prismatic}, bodies: [{mass: 1, at: [x, y, 0]}]}
gravity: none
springs: [{energy: "x^4/4 - 2*x^2 + x*y^2 + y^2"}]
find: [equilibria]
"""
    assert "Where 1 + x = 0, 3 + y² is not 0." in read(text)


def read(problem: str) -> str:
    """The text without its line breaks."""
    return " ".join(report(dynsolve.solve(problem), Format.TEXT).decode().split())


def test_on_a_set_without_end_or_edge_the_energy_is_least_somewhere() -> None:
    """A bead on a circle rests wherever a spring pulls it; on a line it may be pulled on and on."""
    bead = """
gravity: [0, -g, 0]
model: {coordinates: {x: prismatic, y: prismatic}, bodies: [{mass: m, at: [x, y, 0]}]}
springs: [{stiffness: k, of: x - y}]
constraints: [x^2 + y^2 - l^2]
find: [equilibria]
"""
    assert "not told here" not in str(told_of(bead).outcome)
    assert "not told here" in str(told_of(bead.replace("x^2 + y^2", "x^2 - y^2")).outcome)


def test_a_tip_that_just_reaches_its_wall_is_not_held() -> None:
    """By hand: b = 2l leaves q₁ = q₂ = 0 alone, where A_c is 0 and the weight is not: 2l > b says it."""
    arm = """
gravity: [0, -g, 0]
dh: [{theta: q1*, a: l}, {theta: q2*, a: l}]
masses: [{mass: m, link: 1}, {mass: m, link: 2}]
constraints: [tip.x - b]
find: [equilibria]
"""
    told = read(arm)
    assert "This has solutions where 2l > b." in told
    assert not any(words in told for words in ("b ≠ 2l", "b = 2l", "may be dependent"))


def test_that_coulomb_friction_holds_more_is_said() -> None:
    """With f_c = 1 a mass on a spring rests wherever the spring pulls with less than that."""
    spring = """
gravity: none
model: {coordinates: {x: prismatic}, bodies: [{mass: m, at: [x, 0, 0]}]}
springs: [{stiffness: k, of: x}]
find: [equilibria]
"""
    friction = spring.replace("find:", "friction: {x: {coulomb: fc}}\nfind:")
    assert "equilibria are where -f_c ≤ k x ≤ f_c." in read(friction)
    assert "In equilibrium: stable. All this is without Coulomb friction." in read(friction)
    assert "Coulomb" not in read(spring)
    slide = "model: {coordinates: {x: prismatic, y: prismatic}, bodies: [{mass: m, at: [x, y, 0]}]}"
    both = re.sub("model: .*", slide, friction).replace("of: x}", "of: x}, {stiffness: k, rest: d, of: y}")
    assert "equilibria are where -f_c ≤ k x ≤ f_c and y - d = 0." in read(both)


def test_what_is_not_stable_is_said_to_be_so_without_coulomb_friction() -> None:
    """Of a pendulum that is upright; with friction it stays wherever m g l |sin q| ≤ 2μ."""
    pendulum = """
gravity: [0, -g, 0]
model:
  coordinates: {x: prismatic, q: revolute}
  bodies: [{mass: M, at: [x, 0, 0]}, {mass: m, at: [x + l*sin(q), -l*cos(q), 0]}]
springs: [{stiffness: k, of: x}]
friction: {q: {coulomb: 2*mu}}
find: [equilibria]
"""
    told = read(pendulum)
    assert "the equilibria are where x = 0 and -2μ ≤ m g l sin(q) ≤ 2μ." in told
    assert "not stable. All this is without Coulomb friction, which can hold what is not stable." in told
    assert "All this" not in read(pendulum.replace("-l*cos(q)", "0"))
    on_the_slide = read(pendulum.replace("friction: {q:", "friction: {x:"))
    assert "not stable. All this is without Coulomb friction." in on_the_slide, (
        "the pendulum falls all the same"
    )
    loose = pendulum.replace("springs: [{stiffness: k, of: x}]\n", "").replace(
        "friction: {q:", "friction: {x:"
    )
    assert "With Coulomb friction" not in read(loose), "nothing pulls at the slide"
    held = pendulum.replace("find:", "inputs: given\npassive: [x]\nfind:")
    assert "Coulomb" not in str(told_of(held).outcome)


SPRUNG = """
gravity: {gravity}
model: {{coordinates: {{{coordinates}}}, bodies: [{{mass: m, at: [0, 0, 0]}}]}}
springs: [{{energy: "{energy}"}}]
find: [equilibria]
"""


@pytest.mark.parametrize(
    ("coordinates", "energy", "is_there"),
    [
        ("a: revolute", "k*(a^2/2 + L*sin(a))", True),  # far to both sides it has both signs
        ("a: revolute, b: revolute", "k*((a - b)^2/2 + L*cos(a + b) + cos(a))", True),  # a = b = 0
        ("x: prismatic, y: prismatic", "k*(x^2 + y^2 - L^2)^2 + x^2 - y*x", True),
        ("a: revolute, x: prismatic", "k*(a*x - L)^2/2 + c*x + d*a", False),
    ],
)
def test_that_there_are_solutions_for_all_parameters_is_seen(
    coordinates: str, energy: str, is_there: bool
) -> None:
    text = SPRUNG.format(gravity="none", coordinates=coordinates, energy=energy)
    assert ("not told here" not in str(told_of(text).outcome)) == is_there


def test_an_angle_that_a_spring_holds_is_solved_for() -> None:
    text = SPRUNG.format(gravity="none", coordinates="a: revolute", energy="k*(2*a - pi)^2/2")
    (row,) = told_of(text).result
    assert to_unicode(row) == "a = 90°" and not told_of(text).outcome


GEARED = """
gravity: [0, -g, 0]
model:
  coordinates: {a: revolute, b: revolute}
  bodies: [{mass: m, at: [l*sin(a), l*cos(a), 0]}, {mass: %s, at: [l*sin(b), l*cos(b), 0]}]
constraints: [a - b - 180deg]
find: [equilibria]
"""


def test_an_angle_that_a_gear_gives_by_others_is_put_in() -> None:
    """Of equal masses half a turn apart nothing falls; of others the heavier one hangs."""
    balanced = dynsolve.solve(GEARED % "m").to_json()["results"]
    assert balanced["equilibria"] == [["pi - a + b = 0"]]
    (points,) = dynsolve.solve(GEARED % "(2*m)").to_json()["results"]["equilibria_stability"]
    assert points == [{"a": "0", "stability": "stable"}, {"a": "pi", "stability": "unstable"}]


def test_a_determinant_that_vanishes_everywhere_is_shown_as_0() -> None:
    block = """
gravity: [0, -g, 0]
model: {coordinates: {x: prismatic, y: prismatic}, bodies: [{mass: m, at: [x, y, 0]}]}
constraints: [y]
find: [equilibria]
"""
    text = report(dynsolve.solve(block), Format.TEXT).decode()
    assert "det ⎡𝐀_c⎤ = 0" in text and "x is arbitrary" in text


def test_other_sets_for_special_parameters_are_not_paired_with_those_for_all() -> None:
    """By hand: on the circle z = h of a ball the spring lets x = 0 rest, and R = h leaves a point of it."""
    ball = """
gravity: [0, 0, -g]
model:
  coordinates: {x: prismatic, y: prismatic, z: prismatic}
  bodies: [{mass: m, at: [x, y, z]}]
constraints: [x^2 + y^2 + z^2 - R^2, z - h]
springs: [{stiffness: k, of: x}]
find: [equilibria]
"""
    results = dynsolve.solve(ball).to_json()["results"]
    assert [case[1] for case in results["equilibria"]] == ["y = 0", "x = 0"]


TWO_ARMS = """
gravity: [0, -g, 0]
model:
  coordinates: {a: revolute, b: revolute}
  bodies: [{mass: m, at: [l*sin(a), l*cos(a), 0]}, {mass: M, at: [l*sin(b), l*cos(b), 0]}]
constraints: [%s]
find: [equilibria, lambda, reduced]
"""


def test_the_rank_is_that_where_the_constraints_hold() -> None:
    """Two equations for the tips of equal arms: both swing as one, and hang or stand."""
    text = report(dynsolve.solve(TWO_ARMS % "sin(a) - sin(b), cos(a) - cos(b)"), Format.TEXT).decode()
    told = " ".join(text.split())
    assert "Where the constraints hold the rank of 𝐀_c is 1." in told
    assert "b = 0 and a = 0 b = 180° and a = 180°" in told
    assert "so that the multipliers are not determined" in told and "𝐙ᵀ" not in told


def test_of_a_zero_of_higher_order_it_is_not_seen_what_is_free() -> None:
    """(a - b)² = 0 has the rows of 0 = 0 where it holds; a + b = 0 beside it leaves nothing free."""
    for constraint in ("(a - b)^2", "(a - b)^2 + (a + b)^2", "cos(a) + cos(b) - 2"):
        results = dynsolve.solve(TWO_ARMS % constraint).to_json()["results"]
        assert all("skipped" in results[name] for name in ("equilibria", "lambda", "reduced"))


def test_that_a_number_is_not_0_is_not_said() -> None:
    arm = """
gravity: [0, -9.81, 0]
dh: [{theta: q1*, a: 0.3}, {d: d2*, alpha: 30deg}, {theta: q3*, a: 0.2}]
masses: [{mass: 2, link: 1}, {mass: 0.7, link: 3}]
springs: [{stiffness: 120, of: d2, rest: 0.1}]
find: [equilibria]
"""
    text = report(dynsolve.solve(arm), Format.TEXT).decode()
    assert "d₂ = 0.1, c₁ = 0 and s₃ = 0" in text and "is not 0" not in text


def test_cases_that_are_merged_are_not_told_twice() -> None:
    """sin a sin b = 0 by half angles: a = 0 and a = π of two choices come to the same."""
    results = dynsolve.solve(TWO_ARMS.replace("M,", "m,") % "sin(a)*sin(b)").to_json()["results"]
    assert [sorted(case) for case in results["equilibria"]] == [["sin(a) = 0", "sin(b) = 0"]]


ROPE = """
gravity: [0, -g, 0]
dh: [{theta: q1*, a: l}, {from: 0, theta: q2*, a: l}]
masses: [{mass: m1, link: 1}, {mass: m2, link: 2}]
constraints: [cos(q1 - q2) - cos(alpha)]
find: [equilibria]
"""
WEDGE = """
gravity: [0, -g, 0]
model:
  coordinates: {x: prismatic, s: prismatic}
  bodies: [{mass: M, at: [x, 0, 0]}, {mass: m, at: [x + s*cos(alpha), s*sin(alpha), 0]}]
constraints: [s*sin(alpha) - x*cos(alpha)]
find: [equilibria]
"""


def test_what_a_cosine_always_is_is_no_condition() -> None:
    assert "has solutions only where" not in dynsolve.solve(ROPE).to_markdown()


def test_a_factor_that_is_not_0_for_special_parameters_is_left_out() -> None:
    special = dynsolve.solve(WEDGE).to_json()["results"]["equilibria_special"]
    assert special == [
        {"where": "sin(alpha) = 0", "equilibria": [["x = 0"]]},
        {"where": "cos(alpha) = 0", "equilibria": [["s = 0"]]},
    ]


def test_the_square_of_a_length_that_a_case_gives_is_put_into_the_second_derivatives() -> None:
    """By hand: k⁴ a⁶ y² = k² a⁴ c² + c⁴, so that 3 k² a² y² is more than c²."""
    well = """
gravity: none
model: {coordinates: {x: prismatic, y: prismatic}, bodies: [{mass: m, at: [x, y, 0]}]}
springs: [{energy: "k*(x^2 - a^2)^2/4 + c*x*y + k*a^2*y^2/2"}]
assume: ["k*a^2 > c"]
find: [equilibria]
"""
    of_case = dynsolve.solve(well).to_json()["results"]["equilibria_stability"]
    assert of_case == [[{"stability": "unstable"}], [{"stability": "stable"}]]


def test_what_is_left_out_of_a_case_may_be_an_equilibrium_of_another() -> None:
    """sin a sin b = 0 and a spring of a: where both sines are 0, a = 0 alone rests."""
    sprung = (TWO_ARMS % "sin(a)*sin(b)").replace("[0, -g, 0]", "none")
    solution = dynsolve.solve(sprung.replace("find:", "springs: [{stiffness: k, of: a}]\nfind:"))
    assert ["a = 0", "sin(b) = 0"] in solution.to_json()["results"]["equilibria"]
    assert "no equilibrium but in case 1" in " ".join(solution.to_markdown().split())


@pytest.mark.parametrize("angle", ["x/L", "x/2", "x"])
def test_a_length_may_stand_in_an_angle_of_a_constraint_alone(angle: str) -> None:
    """A bead on the wire y = c cos(x/L) stands at its crests."""
    wire = f"""
gravity: [0, -g, 0]
model: {{coordinates: {{x: prismatic, y: prismatic}}, bodies: [{{mass: m, at: [x, y, 0]}}]}}
constraints: [y - c*cos({angle})]
find: [equilibria, lambda]
"""
    results = dynsolve.solve(wire).to_json()["results"]
    assert results["equilibria"][0][0] == f"sin({angle}) = 0" and isinstance(results["lambda"], list)


def test_conditions_of_a_model_in_numbers_are_exact() -> None:
    """sin(a) (1/3 - cos(a)) = 0: cos a = 1/3, and not 0.333333."""
    ring = """
gravity: none
model: {coordinates: {a: revolute}, bodies: [{mass: 2, at: [0, 0, 0]}]}
springs: [{energy: "-cos(a)/3 + cos(a)^2/2"}]
find: [equilibria]
"""
    assert "cos(a) = ⅓" in " ".join(map(to_unicode, told_of(ring).result))


MASS = """
gravity: {gravity}
model: {{coordinates: {{{coordinates}}}, bodies: [{{mass: m, at: {at}}}]}}
springs: [{{energy: "{energy}"}}]
find: [equilibria]
"""
POLAR = "[r*sin(a), -r*cos(a), 0]"
SPHERICAL = "[l*sin(t)*cos(p), l*sin(t)*sin(p), -l*cos(t)]"


@pytest.mark.parametrize(
    ("coordinates", "at", "energy", "count", "is_doubtful"),
    [
        ("r: prismatic, a: revolute", POLAR, "F*r*sin(a)", 0, True),  # a mass in a constant force
        ("r: prismatic, a: revolute", POLAR, "k*r^2/2", 1, True),
        ("p: revolute, t: revolute", SPHERICAL, "F*l*sin(t)*cos(p)", 1, True),
        ("p: revolute, t: revolute", SPHERICAL, "k*l^2*sin(t)^2", 2, False),  # it hangs, whatever p is
    ],
)
def test_where_coordinates_do_not_tell_how_bodies_move_nothing_need_be_in_equilibrium(
    coordinates: str, at: str, energy: str, count: int, is_doubtful: bool
) -> None:
    gravity = "[0, 0, -g]" if at == SPHERICAL else "[0, -g, 0]"
    text = MASS.format(gravity=gravity, coordinates=coordinates, at=at, energy=energy)
    assert len(dynsolve.solve(text).to_json()["results"]["equilibria"]) == count
    assert ("need not be an equilibrium" in str(told_of(text).outcome)) == is_doubtful


def test_it_is_told_which_coordinate_moves_no_body() -> None:
    """Stretched, with det D = 0, both do; folded on its joint, a mass at the tip is moved by q2 alone."""
    folded = """
gravity: [0, -g, 0]
dh: [{theta: q1*, a: l}, {theta: q2*, a: l}]
masses: [{mass: m, link: 2}]
find: [equilibria]
"""
    step = told_of(folded)
    assert list(map(to_unicode, step.result)) == ["cos(q₁) = 0 and q₂ = 0"]
    told = "".join(
        part if isinstance(part, str) else to_unicode(part) for note in step.notes for part in note
    )
    assert "Where cos(q₁) = 0 and q₂ = 180°, g = 0, too; but q₁ moves no body there, d₁₁ = 0, and" in told


def test_a_table_and_a_model_of_one_mechanism_have_the_same_equilibria() -> None:
    """At r = 0 the point mass is at the pivot, and what turns has no inertia."""
    table = """
gravity: [0, -g, 0]
dh: [{theta: q1* + 90deg, alpha: 90deg}, {d: r*}]
masses: [{mass: m, link: 2, center: origin}]
springs: [{stiffness: k, of: r, rest: r0}]
find: [equilibria]
"""
    assert dynsolve.solve(table).to_json()["results"]["equilibria"] == [
        ["k*(r - r0) + m*g*sin(q1) = 0", "cos(q1) = 0"]
    ]
    assert "need not be an equilibrium" in str(told_of(table).outcome)


FLAT = "x: prismatic, y: prismatic"


@pytest.mark.parametrize(
    ("coordinates", "energy", "told"),
    [
        # along the equilibria it comes to where the energy falls
        (FLAT, "k*x^2*y/2", [[{"stability": "undecided", "unstable_if": ["y < 0"]}]]),
        (FLAT, "k*x^2*(1 + y^2)/2", [[{"stability": "stable"}]]),
        # at a = 0 the same is told by the case cos a = 1, whatever b is
        (
            "a: revolute, b: revolute",
            "k*(1 - cos(a))*(2 - cos(b))",
            [
                [
                    {"b": "0", "a": "pi", "stability": "unstable"},
                    {"b": "pi", "a": "pi", "stability": "unstable"},
                ],
                [{"a": "0", "stability": "stable"}],
            ],
        ),
    ],
)
def test_what_is_stable_beside_coordinates_that_may_have_any_value(
    coordinates: str, energy: str, told: object
) -> None:
    text = SPRUNG.format(gravity="none", coordinates=coordinates, energy=energy)
    found = dynsolve.solve(text).to_json()["results"]["equilibria_stability"]
    assert found == told


def test_conditions_that_exclude_each_other_are_those_of_what_is_never_stable() -> None:
    """V'' has -m g (l + e) and m g e, up to sign, as principal minors, where e is anything."""
    arm = """
gravity: [0, -g, 0]
dh: [{theta: q1*, a: l1}, {theta: q2*, a: l2}]
masses: [{mass: m, link: 2, center: [x, y, 0]}]
find: [equilibria]
"""
    (up, down) = dynsolve.solve(arm).to_json()["results"]["equilibria_stability"][0]
    assert up == {"q1": "pi/2", "stability": "unstable"}
    assert down["stability"] == "undecided" and len(down["stable_if"]) == 2


def test_the_square_of_a_length_is_there_where_it_is_not_negative() -> None:
    text = SPRUNG.format(gravity="none", coordinates="x: prismatic", energy="k*(x^2 - a^2 + b^2)^2")
    results = dynsolve.solve(text).to_json()["results"]
    assert ["a > b"] in results["equilibria_exist"] or ["a >= b"] in results["equilibria_exist"]
    assert "not told here" not in str(told_of(text).outcome)
    (_, case) = [to_unicode(row) for row in told_of(text).result]
    assert case == "x² = a² - b²"


def test_a_length_is_solved_for_where_its_factor_is_told_to_be_other_than_0() -> None:
    """A bead that is turned with its rod, at the end of a spring: m W² r = k (r - a)."""
    turned = """
gravity: none
dh: [{theta: q*}, {alpha: 90deg}, {d: r*}]
masses: [{mass: m, link: 3, center: origin}]
springs: [{stiffness: k, of: r, rest: a}]
steady: {q: W}
find: [equilibria]
"""
    (row,) = told_of(turned).result
    assert to_unicode(row) == "r = k a/(k - m W²)"


def test_the_quarter_turns_at_which_an_angle_and_its_sine_balance_are_told() -> None:
    """An inverted pendulum on a spring (V'' = k - m g b upright, by hand); another with a constant moment."""
    turned = """
gravity: [0, -g, 0]
model: {{coordinates: {{phi: revolute}}, bodies: [{{mass: m, at: [b*sin(phi), b*cos(phi), 0]}}]}}
springs: [{{energy: "k*phi^2/2 + {more}"}}]
find: [equilibria]
"""
    (upright, other), *_ = dynsolve.solve(turned.format(more="0*phi")).to_json()["results"][
        "equilibria_stability"
    ]
    assert upright == {
        "phi": "0",
        "stability": "undecided",
        "stable_if": ["k > m*g*b"],
        "unstable_if": ["m*g*b > k"],
    }
    assert other["stable_if"] == ["k > m*g*b*cos(phi)"]
    (alone,), *_ = dynsolve.solve(turned.format(more="c*phi")).to_json()["results"]["equilibria_stability"]
    assert "phi" not in alone


def test_a_mass_that_turns_steadily_does_not_rest_at_the_pole_of_its_coordinates() -> None:
    """In the middle the spring pulls with nothing, and the weight is not carried."""
    whirled = """
gravity: [0, 0, -g]
model:
  coordinates: {r: prismatic, t: revolute, p: revolute}
  bodies: [{mass: m, at: [r*sin(t)*cos(p), r*sin(t)*sin(p), -r*cos(t)]}]
springs: [{energy: "k*r^2/2"}]
steady: {p: W}
find: [equilibria]
"""
    results = dynsolve.solve(whirled).to_json()["results"]
    assert results["equilibria"] == [["sin(t) = 0", "m*g*cos(t) - k*r = 0"]]
    assert [point["t"] for point in results["equilibria_stability"][0]] == ["0", "pi"]
    assert "need not be an equilibrium" in str(told_of(whirled).outcome)


def test_what_squares_decide_is_no_condition(monkeypatch: pytest.MonkeyPatch) -> None:
    """On a slope at the angle b two links hang or stand across it; folded they are never stable.

    In a ring with q1 and b apart, as where q1 - b is no shorter.
    """
    monkeypatch.setattr(solving, "_search_ring", lambda ring, wanted: search_ring(ring, (), {}))
    slope = """
gravity: [g*sin(b), -g*cos(b), 0]
dh: [{theta: q1*, a: l1}, {theta: q2*, a: l2}]
masses: [{mass: m1, link: 1}, {mass: m2, link: 2}]
find: [equilibria]
"""
    along, folded = dynsolve.solve(slope).to_json()["results"]["equilibria_stability"][0]
    assert len(along["stable_if"]) == 1 and along["q2"] == "0"
    assert folded == {"q2": "pi", "stability": "unstable"}


APART = """
gravity: none
model: {{coordinates: {{x: prismatic, a: revolute}}, D: [[m, 0], [0, J]]}}
springs: [{{energy: "{energy}"}}]
find: [equilibria]
"""


@pytest.mark.parametrize(
    ("energy", "points", "said"),
    [
        ("c*x^4 + k*a^2", [{"stability": "stable"}], "by x that is not 0 there is the fourth, 24c, and"),
        ("c*x^3 + k*a^2", [{"stability": "unstable"}], "is the third, 6c: beside it the energy falls"),
        ("k*a^2 - c*x^6", [{"stability": "unstable"}], "is the sixth, -720c, and its sign decides"),
        (
            "(c - d)*x^4 + k*(1 - cos(a))^2",
            [
                {"a": "0", "stability": "undecided", "stable_if": ["c > d"], "unstable_if": ["d > c"]},
                {"a": "pi", "stability": "unstable"},
            ],
            "24(c - d), and its sign decides. The first derivative of the energy by a that is not 0",
        ),
        # what belongs to no coordinate alone
        (
            "c*x^2*a^2 + c*x^4 + c*a^4",
            [{"a": "0", "stability": "undecided"}, {"stability": "undecided"}],
            "second derivatives alone do not decide",
        ),
    ],
)
def test_where_a_second_derivative_is_0_the_first_that_is_not_decides(
    energy: str, points: list[dict[str, Any]], said: str
) -> None:
    solution = dynsolve.solve(APART.format(energy=energy))
    assert solution.to_json()["results"]["equilibria_stability"][0] == points
    assert said in " ".join(report(solution, Format.TEXT).decode().split())


@pytest.mark.parametrize(
    ("curve", "stability", "said"),
    [
        ("y - x^3", "unstable", "along 𝐙 that is not 0 there is the third, 6m g: beside it the energy falls"),
        ("a^3*y - x^4", "stable", "along 𝐙 that is not 0 there is the fourth, and its sign decides"),
        ("a^3*y + x^4", "unstable", "along 𝐙 that is not 0 there is the fourth, and its sign decides"),
    ],
)
def test_on_a_curve_the_first_derivative_that_is_not_0_decides(curve: str, stability: str, said: str) -> None:
    solution = dynsolve.solve(f"""
gravity: [0, -g, 0]
model: {{coordinates: {{x: prismatic, y: prismatic}}, bodies: [{{mass: m, at: [x, y, 0]}}]}}
constraints: [{curve}]
find: [equilibria]
""")
    assert solution.to_json()["results"]["equilibria_stability"] == [[{"stability": stability}]]
    assert said in " ".join(report(solution, Format.TEXT).decode().split())


@pytest.mark.parametrize(
    ("problem", "is_shown"),
    [
        ("dh: [{theta: q1*, a: l}]\nmasses: [{mass: m, link: 1}]\n", False),
        (
            f"model: {{coordinates: {{r: prismatic, a: revolute}}, bodies: [{{mass: m, at: {POLAR}}}]}}\n",
            True,
        ),
        ("model: {coordinates: {a: revolute}, bodies: [{mass: m, at: [l*sin(a), -l*cos(a), 0]}]}\n", False),
    ],
)
def test_the_inertia_is_shown_only_where_equilibria_speak_of_it(problem: str, is_shown: bool) -> None:
    solution = dynsolve.solve(f"gravity: [0, -g, 0]\n{problem}find: [equilibria]\n")
    shown = {step.id for step in leading(solution, solution.steps)}
    assert ("K" in shown) == is_shown and "equilibria" in shown


@pytest.mark.parametrize(
    ("energy", "unstable_if"),
    [("k*sin(u) + c*sin(u)*sin(v)", ["2*c > k"]), ("m*g*sin(u) + k*cos(u)^2", ["2*k > g*m"])],
)
def test_beside_a_bound_of_its_case_nothing_is_stable_where_that_fails(
    energy: str, unstable_if: list[str]
) -> None:
    """By hand: along sin u + sin v = 0 the energy is a downward parabola in sin u, greatest inside."""
    model = "{coordinates: {u: revolute, v: revolute}, K: J*(u'^2 + v'^2)/2, P: " + energy + "}"
    problem = f"model: {model}\nconstraints: [sin(u) + sin(v)]\nfind: [equilibria]\n"
    (told,), *_ = dynsolve.solve(problem).to_json()["results"]["equilibria_stability"]
    assert told == {"stability": "undecided", "unstable_if": unstable_if}


ON_AN_ARC = """
gravity: [0, -g, 0]
dh: [{theta: q1*, a: a}]
masses: [{mass: m, link: 1}]
springs: [{energy: k*((a*cos(q1) - b)^2 + (a*sin(q1) - h)^2)/2}]
find: [equilibria]
"""
ON_A_TURNING_CONE = """
gravity: [0, 0, -g]
model:
  coordinates: {phi: revolute, x: prismatic, th: revolute}
  bodies: [{mass: m, at: [x*sin(th)*cos(phi), x*sin(th)*sin(phi), x*cos(th)]}]
springs: [{stiffness: k, of: x, rest: a}]
steady: {phi: W}
find: [equilibria]
"""


@pytest.mark.parametrize(
    ("problem", "stable_if"),
    [
        # the curvature is that of -k a b cos q₁, times ((m g - k h)² + k² b²)/(k b)²
        (ON_AN_ARC, [["cos(q1) > 0"]]),
        # upright, at x = (k a - m g)/k, the curvature in θ is -m x (g + W² x)
        (
            ON_A_TURNING_CONE,
            [
                ["W**2*(m*g + k*a) > g*k", "k*(g + W**2*a) > m*g*W**2", "k > m*W**2"],
                ["m*g > k*a", "k*(g + W**2*a) > m*g*W**2"],
                ["g*k > W**2*(m*g + k*a)"],
            ],
        ),
    ],
)
def test_stability_is_told_by_its_factors(problem: str, stable_if: list[list[str]]) -> None:
    told = dynsolve.solve(problem).to_json()["results"]["equilibria_stability"]
    assert [point["stable_if"] for case in told for point in case] == stable_if


def test_multipliers_are_told_in_the_angles_of_their_own_ring() -> None:
    """By hand: the second row of 𝐠 = 𝐀_cᵀ 𝛌 is m g l₂ c₁₂ = λ; λ stands in no result of the JSON."""
    problem = """
gravity: [0, -g, 0]
dh: [{theta: q1*, a: l1}, {theta: q2*, a: l2}]
masses: [{mass: m, link: 2}]
constraints: [q2 + n*q1]
find: [equilibria]
"""
    assert "𝛌 = m g l₂ c₁₂" in report(dynsolve.solve(problem), Format.TEXT).decode()


ON_A_LINE = """
gravity: [0, -g, 0]
dh: [{theta: q1*, a: l1}, {theta: q2*, a: l2}, {theta: q3*, a: l3}]
masses: [{mass: m, link: 1}, {mass: M, link: 2}]
constraints: [tip.y]
find: [equilibria]
"""


def test_what_constraints_hold_is_told_at_sums_of_angles() -> None:
    """By hand: with q₁ + q₂ upright and q₃ = 0, P = m g l₁ s₁ + M g (l₁ s₁ + l₂ s₁₂) is least at +90°."""
    cases = dynsolve.solve(ON_A_LINE).to_json()["results"]["equilibria_stability"]
    (told,) = (points for points in cases if "q1 + q2" in points[0])
    known = {(point["q1 + q2"], point["q3"]): point.get("stable_if") for point in told}
    reached = ["l1 > l2 + l3"]  # at both sides equal the links reach back to the base, the row of A_c is 0
    assert known == {
        ("pi/2", "0"): reached,
        ("pi/2", "pi"): None,
        ("-pi/2", "0"): None,
        ("-pi/2", "pi"): None,
    }


def test_a_pose_is_told_once() -> None:
    """cos(q₃/2) = 0 at q₃/2 = 90° and -90°, which is one pose."""
    equal = (
        ON_A_LINE.replace("l1", "l").replace("l2", "l").replace("l3", "l").replace(", {mass: M, link: 2}", "")
    )
    told = dynsolve.solve(equal).to_json()["results"]["equilibria_stability"]
    assert [point["q3"] for point in told[1]] == ["pi"] * 4


@pytest.mark.parametrize(
    ("spring", "stable"),
    [
        ("{stiffness: k, of: a - b}", {("0", "0"): "stable", ("pi", "pi"): "unstable"}),
        (
            "{energy: k*l^2*(1 - cos(a - b))}",
            {
                ("0", "0"): "stable",
                ("0", "pi"): "unstable",
                ("pi", "0"): "unstable",
                ("pi", "pi"): "unstable",
            },
        ),
    ],
)
def test_the_quarter_turns_of_coupled_pendulums_are_told(
    spring: str, stable: dict[tuple[str, str], str]
) -> None:
    """By hand: hanging is least; upright -m g l + k on the diagonal makes the sum of the minors negative."""
    problem = f"""
gravity: [0, -g, 0]
model:
  coordinates: {{a: revolute, b: revolute}}
  bodies:
    - {{mass: m, at: [l*sin(a), -l*cos(a), 0]}}
    - {{mass: m, at: [d + l*sin(b), -l*cos(b), 0]}}
springs: [{spring}]
find: [equilibria]
"""
    (told,) = dynsolve.solve(problem).to_json()["results"]["equilibria_stability"]
    assert {(one["a"], one["b"]): one["stability"] for one in told if "a" in one} == stable


@pytest.mark.parametrize(
    ("first", "second", "pose"),
    [("- 30deg", "+ 60deg", "q₁ = -60°, q₂ = -60°"), ("+ 45deg", "+ 15deg", "q₁ = -135°, q₂ = -15°")],
)
def test_angles_that_the_table_adds_to_more_than_one_joint_give_points(
    first: str, second: str, pose: str
) -> None:
    """cos(q₁ - 30°) and cos(q₁ + q₂ + 30°), not tan(q₁ + 30°) = -√3/3."""
    text = read(f"""
gravity: [0, -g, 0]
dh: [{{theta: q1* {first}, a: b}}, {{theta: q2* {second}, a: c}}]
masses: [{{mass: m, link: 1}}, {{mass: m, link: 2}}]
find: [equilibria]
""")
    assert f"At {pose}: stable." in text and "tan(" not in text


@pytest.mark.parametrize(("assumed", "is_told"), [("4*m*g*l", True), ("3*m*g*l", False)])
def test_springs_that_are_stiffer_than_gravity_leave_one_equilibrium(assumed: str, is_told: bool) -> None:
    """By Gershgorin: k₁ - m g l (2c₁ + c₁₂) ± m g l c₁₂ > 0 where k₁ > 4 m g l."""
    text = read(f"""
gravity: [0, -g, 0]
dh: [{{theta: q1* + 90deg, a: l}}, {{theta: q2*, a: l}}]
masses: [{{mass: m, link: 1}}, {{mass: m, link: 2}}]
springs: [{{stiffness: k1, of: q1}}, {{stiffness: k2, of: q2}}]
assume: [k1 > {assumed}, k2 > 2*m*g*l]
find: [equilibria]
""")
    convex = "q₁ = 0 and q₂ = 0 Note: In every configuration each entry on the diagonal of ∂𝐠/∂𝐪 is more"
    assert (convex in text) == is_told
    assert ("In equilibrium: stable." in text) == is_told


def test_a_spring_that_is_wound_up_holds_any_weight() -> None:
    """A cos(q₁ + q₂) is 0 for any q₁, and k q₁ outgrows what gravity does."""
    text = read("""
gravity: [0, -g, 0]
dh: [{theta: q1*, a: a}, {theta: q2*, a: b}]
masses: [{mass: m, link: 1, center: [x, y, 0]}, {mass: M, link: 2, center: [u, v, 0]}]
springs: [{stiffness: k, of: q1}]
find: [equilibria]
""")
    assert "k q₁ = 0 and" in text and "For which parameters" not in text


HELD_MASS = """
gravity: [0, -g, 0]
model: {{coordinates: {{r: prismatic, a: revolute}}, bodies: [{{mass: m, at: [r*sin(a), -r*cos(a), 0]}}]}}
{more}
find: [equilibria]
"""


@pytest.mark.parametrize(
    ("more", "equilibria", "told"),
    [
        ("constraints: [r*sin(a)]", [], "Where r = 0, there may be a λ, too; but a moves no body there"),
        (
            "constraints: [r*cos(a) + r*sin(a)]\nsprings: [{stiffness: k, of: r}]",
            [["sin(a) + cos(a) = 0", "2*k*r*cos(a) - m*g = 0"]],
            "Where r = 0, there may be a λ, too; but a moves no body there",
        ),
        ("passive: [a]\ninputs: given", [["sin(a) = 0"]], "Where r = 0, g₂ = 0, too; but a moves no body"),
    ],
)
def test_neither_a_constraint_nor_a_motor_along_a_rod_of_length_0_holds_across_it(
    more: str, equilibria: list[list[str]], told: str
) -> None:
    """The mass falls along x = 0; on y = x it is where k u = -m g/√2; on the rod below the pivot or above.

    In the case r = 0, which coordinates cannot tell, forces are not 0, whatever angle that leaves free.
    """
    text = HELD_MASS.format(more=more)
    assert dynsolve.solve(text).to_json()["results"]["equilibria"] == equilibria
    outcome = "".join(p if isinstance(p, str) else to_unicode(p) for p in told_of(text).outcome)
    assert told in outcome


def test_what_nothing_pulls_rests_at_r_0_with_a_constraint_too() -> None:
    free = HELD_MASS.format(more="constraints: [r*cos(a)]\nsprings: [{stiffness: k, of: r}]")
    text = free.replace("gravity: [0, -g, 0]", "gravity: none")
    assert dynsolve.solve(text).to_json()["results"]["equilibria"] == [["r = 0"]]


FOLDED = """
gravity: [0, -g, 0]
dh: [{theta: q1*, a: a}, {theta: q2*, a: b}]
masses: [%s]
constraints: [tip.x]
find: [equilibria]
"""


@pytest.mark.parametrize(
    ("masses", "told"),
    [
        ("{mass: m, link: 1}", {"stability": "stable"}),
        (
            "{mass: m, link: 1}, {mass: m, link: 2}",
            {"stability": "undecided", "stable_if": ["2*b > a"], "unstable_if": ["a > 2*b"]},
        ),
    ],
)
def test_an_exception_that_cannot_be_at_a_point_is_not_told_there(masses: str, told: dict[str, Any]) -> None:
    """At q1 = -90°, q2 = 180° A_c = (a - b, -b) has rank 1 where a = b, too; Zᵀ(...)Z is m g a³ > 0 there."""
    points = dynsolve.solve(FOLDED % masses).to_json()["results"]["equilibria_stability"][0]
    at = {"q1": "-pi/2", "q2": "pi"}
    assert [{**at, **told}] == [one for one in points if at.items() <= one.items()]


def test_that_stability_is_that_with_constant_forces_of_the_motors_is_said() -> None:
    """A motor that holds the length makes the hanging mass a pendulum; a force that stays lets it go."""
    hanging = HELD_MASS.format(more="passive: [a]\ninputs: given")
    assert "All this is with motors whose forces stay as they are." in read(hanging)
    assert "whose forces stay" not in read(hanging.replace("inputs: given", ""))


def exist_of(problem: str) -> list[list[str]]:
    """The inequalities of each case, of which the text does not say that they may not be enough."""
    told = read(problem)
    assert "only where" not in told and "solutions is not told" not in told
    found: list[list[str]] = dynsolve.solve(problem).to_json()["results"].get("equilibria_exist", [])
    return found


CLOSED = """
gravity: [0, -g, 0]
dh: [{theta: q1*, a: a}, {theta: q2*, a: b}%s]
masses: [{mass: M, link: 1}]
constraints: [%s]
find: [equilibria]
"""
BEHIND = ", {theta: q3*, a: c}"


@pytest.mark.parametrize(
    ("more", "closed", "exist"),
    [
        ("", "tip.x - c, tip.y", ["c + a >= b", "c + b >= a", "a + b >= c"]),
        ("", "tip.x - c, tip.y - d", ["(a + b)**2 >= c**2 + d**2", "c**2 + d**2 - (a - b)**2 >= 0"]),
        (BEHIND, "tip.x - d, tip.y, q3", ["d + a >= b + c", "d + b + c >= a", "a + b + c >= d"]),
    ],
)
def test_a_chain_closes_where_no_side_is_longer_than_the_others_together(
    more: str, closed: str, exist: list[str]
) -> None:
    """-1 <= cos q2 = (c² - a² - b²)/(2 a b) <= 1, by the law of cosines."""
    assert exist_of(CLOSED % (more, closed)) == [exist]


def test_a_chain_that_is_too_short_never_closes() -> None:
    told = read(CLOSED.replace("a: b", "a: 4*a") % ("", "tip.x - 2*a, tip.y"))
    assert "There is no equilibrium." in told


@pytest.mark.parametrize(("side", "angle"), [("[l, l, 0]", "2q₁ = 90°"), ("[l, -l, 0]", "2q₁ = -90°")])
def test_a_tangent_of_1_is_told_as_twice_the_angle(side: str, angle: str) -> None:
    arm = "gravity: [0, -g, 0]\ndh: [{theta: q1*}]\nmasses: [{mass: m, link: 1, center: %s}]\n"
    assert angle in read(arm % side + "find: [equilibria]\n")


def test_where_a_tangent_is_known_its_sine_and_cosine_are_not_0() -> None:
    """r = m g/(2 k cos θ) with tan θ = -1 is there for all parameters."""
    line = "constraints: [r*cos(a) + r*sin(a)]\nsprings: [{stiffness: k, of: r}]"
    assert exist_of(HELD_MASS.format(more=line)) == []


def test_no_stability_is_told_of_a_point_for_parameters_with_which_it_is_not_there() -> None:
    """sin q2 = -g/(W² (a + b)) at q3 = 0 is a maximum of the sine's size, and -g/(W² (a - b)) at 180°."""
    swing = """
dh: [{theta: phi*, d: h, alpha: 90deg}, {theta: q2*, a: a}, {theta: q3*, a: b}]
masses: [{mass: m, link: 3}]
steady: {phi: W}
find: [equilibria]
"""
    told = read(swing)
    assert "In case 1 at q₃ = 0: stable where W² (a + b) > g. In case 1" in told
    assert "In case 1 at q₃ = 180°, where W⁴ (a - b)² > g²: not stable." in told


LINEAR = {
    "what is told not to be 0 may stand below": (
        "dh: [{theta: phi*, alpha: beta}, {d: r*}]\n"
        "masses: [{mass: m, link: 2, center: origin}]\nsteady: {phi: W}\n",
        "r = g cos(β)/(W² sin²(β))",
    ),
    "one fraction, not k b/(k - m W²) - b": (
        "gravity: none\nmodel:\n  coordinates: {phi: revolute, x: prismatic}\n"
        "  bodies: [{mass: m, at: [(b + x)*cos(phi), (b + x)*sin(phi), 0]}]\n"
        "springs: [{stiffness: k, of: x}]\nsteady: {phi: W}\n",
        "x = m b W²/(k - m W²)",
    ),
    "not for what another equation says": (
        "gravity: [0, -g, 0]\ndh: [{theta: q1*, a: a}, {theta: q2*, a: b}, {theta: q3*, a: c}]\n"
        "masses: [{mass: m, link: 3}]\nconstraints: [q1 + q2 + q3]\n",
        "cos(q₁) = 0, q₃ = -q₁ - q₂ and sin(q₂) = 0",
    ),
    "a sine": (
        "gravity: [0, -g, 0]\nmodel:\n  coordinates: {theta: revolute}\n"
        "  bodies: [{mass: m, at: [l*sin(theta), -l*cos(theta), 0]}]\n"
        'springs: [{energy: "-T*theta"}]\n',
        "sin(θ) = T/(m g l)",
    ),
}


@pytest.mark.parametrize("name", LINEAR)
def test_an_equation_is_solved_for_what_is_linear_in_it(name: str) -> None:
    text, solved_for = LINEAR[name]
    (result,) = told_of(f"{text}find: [equilibria]\n").result
    assert to_unicode(result) == solved_for


def test_two_signs_are_told_by_themselves_and_not_by_a_sum_and_a_product() -> None:
    """By hand, with H = [[X + Y, Y], [Y, Y]]: X > 0 and Y > 0, which is s₁ < 0 and s₁₂ < 0."""
    three = (
        "gravity: [0, -g, 0]\ndh: [{theta: q1*, a: a}, {theta: q2*, a: b}, {theta: q3*, a: c}]\n"
        "masses: [{mass: m1, link: 1}, {mass: m2, link: 2}, {mass: m3, link: 3}]\n"
        "inputs: given\npassive: [q3]\nfind: [equilibria]\n"
    )
    assert "stable where s₁₂ < 0 and s₁ < 0, not stable where one" in read(three)


def test_a_condition_that_is_another_one_and_more_is_not_told() -> None:
    """m g (a + b c₂) + k > 0 where k + m g b c₂ > 0"""
    held = (
        "gravity: [0, -g, 0]\ndh: [{theta: q1*, a: a}, {theta: q2*, a: b}]\n"
        "masses: [{mass: m, link: 2}]\nsprings: [{stiffness: k, of: q1 + q2, rest: 90deg}]\n"
        "find: [equilibria]\n"
    )
    told = read(held)
    assert "at q₁ = -90°: stable where k + m g b c₂ > 0, not stable where" in told
    assert "In equilibrium at q₁ = 90°: not stable." in told
    assert "At q₁ = 90°, q₂ = 0: not stable." not in told  # the same of one of these points


def test_a_minor_that_is_a_product_is_left_one_where_equations_make_it_longer() -> None:
    """The upper link has no motor: both weights hang below their joints (by hand: s₁ < 0 and s₁₂ < 0)."""
    found = dynsolve.solve(
        "gravity: [0, -g, 0]\ndh: [{theta: q1*, a: a}, {theta: q2*, a: b}]\n"
        "masses: [{mass: m, link: 2, center: midpoint}]\npassive: [q1]\ninputs: given\nfind: [equilibria]\n"
    ).to_json()["results"]["equilibria_stability"]
    assert found[0][-1] == {
        "stability": "undecided",
        "stable_if": ["sin(q1 + q2) < 0", "sin(q1) < 0"],
        "unstable_if": ["sin(q1 + q2) > 0", "sin(q1) > 0"],
    }


def test_an_energy_that_a_whole_turn_of_all_leaves_as_it_is_is_least_somewhere() -> None:
    """Two weights on a shaft with a spring between them: both may turn once more (by hand)."""
    tree = (
        "dh: [{theta: p1*, d: h, alpha: 90deg}, {theta: p2*, a: a}, {theta: p3*, a: b, from: 1}]\n"
        "masses: [{mass: m, link: 2}, {mass: m, link: 3}]\nfind: [equilibria]\n"
    )
    between = f"{tree}springs: [{{stiffness: k, of: p2 - p3, rest: 90deg}}]\n"
    told = " ".join(report(dynsolve.solve(between), Format.TEXT).decode().split())
    assert "grows beyond all bounds in every direction in which it is not periodic" in told
    driven = between.replace("p2 - p3, rest: 90deg", "2*p2 - 3*p3")
    assert "this always has solutions" in report(dynsolve.solve(driven), Format.TEXT).decode().replace(
        "\n", " "
    )


def test_an_angle_that_is_the_only_one_is_in_degrees_where_all_angles_are() -> None:
    upright = (
        "gravity: [0, -g, 0]\ndh: [{theta: th*, a: l}]\nmasses: [{mass: m, link: 1}]\n"
        "springs: [{stiffness: k, of: th, rest: 90deg}]\nassume: [k > m*g*l]\nfind: [equilibria]\n"
    )
    told = report(dynsolve.solve(upright), Format.TEXT).decode()
    assert "is at rest at θ = 90°" in " ".join(told.split())
    assert "it is 0 at θ = 90° alone." in told and "θ = π/2" not in told


def test_where_constraints_leave_nothing_free_no_stability_is_spoken_of() -> None:
    closed = (
        "gravity: [0, -g, 0]\ndh: [{theta: q1*, a: a}, {theta: q2*, a: b}]\nmasses: [{mass: m, link: 1}]\n"
        "constraints: [tip.x - c, tip.y]\nfind: [equilibria]\n"
    )
    told = report(dynsolve.solve(closed), Format.TEXT).decode()
    assert "The constraints leave nothing free" in told and "stable" not in told


def test_an_angle_that_others_leave_is_told_with_degrees() -> None:
    tilted = (
        "gravity: [0, -g, 0]\ndh: [{theta: q1*, a: a}, {theta: q2*, a: b}, {theta: q3*, a: a}]\n"
        "masses: [{mass: m, link: 1}]\nconstraints: [tip.x - d, tip.y - a, q1 + q2 + q3 + pi/2]\n"
        "find: [equilibria]\n"
    )
    assert "q₃ = -q₁ - q₂ - 90°" in report(dynsolve.solve(tilted), Format.TEXT).decode()
