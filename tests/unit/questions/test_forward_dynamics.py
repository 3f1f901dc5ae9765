"""Forward dynamics: published accelerations, what acts in them, when there are none, and judged answers."""

from __future__ import annotations

import json
import random
from itertools import islice
from pathlib import Path

import numpy as np
import pytest

import dynsolve
from dynsolve.algebra.compact.proof import plain_form
from dynsolve.derivation.arm_values import states_with
from dynsolve.derivation.graph import Skipped, known
from dynsolve.errors import VerificationError
from dynsolve.explain.step import Detail
from dynsolve.explain.terms import with_force_letters
from dynsolve.notation.python import to_python
from dynsolve.notation.tree import Matrix, Negative, Symbol, mapped, walk
from dynsolve.notation.tree_values import compile_trees
from dynsolve.notation.unicode import to_unicode
from dynsolve.quantities import letters
from dynsolve.questions.constraints.check import verify_constraints
from dynsolve.questions.forward_dynamics.check import COMPARED, verify_forward
from dynsolve.render.files import Format
from dynsolve.solution.reports import report
from tests.support import numbers, solve_json

CART = """
gravity: [0, -g, 0]
model:
  coordinates: {x: prismatic, theta: revolute}
  bodies:
    - {mass: mc, at: [x, 0, 0]}
    - {mass: mp, at: [x + l*sin(theta), -l*cos(theta), 0]}
passive: [theta]
find: [qdd_forward]
"""
PUBLISHED = [
    "(f1 + mp*sin(theta)*(l*theta_dot**2 + g*cos(theta)))/(mc + mp*sin(theta)**2)",
    "(-f1*cos(theta) - mp*l*theta_dot**2*cos(theta)*sin(theta) - (mc + mp)*g*sin(theta))"
    "/(l*(mc + mp*sin(theta)**2))",
]
"""R. Tedrake, Underactuated Robotics, section 3.2.1, cart and pole, the angle from hanging."""

ELBOW = """
gravity: [0, -g, 0]
dh: [{theta: q1*, a: l1}, {theta: q2*, a: l2}]
masses: [{mass: m1, link: 1}, {mass: m2, link: 2}]
friction: {q1: {viscous: fv, coulomb: fc}}
springs: [{stiffness: k, of: q2}]
passive: [q2]
forces: [{link: 2, at: tip, force: [F, 0, 0]}]
find: [qdd_forward]
"""
LARGE = """
gravity: [0, 0, -g]
dh: [{theta: q1*, alpha: 90deg}, {theta: q2*, a: l2}, {theta: q3*, a: l3}, {theta: q4*, a: l4}]
masses: [{mass: m2, link: 2}, {mass: m3, link: 3}, {mass: m4, link: 4}]
find: [qdd_forward]
"""


def test_the_published_accelerations_come_out() -> None:
    ours = solve_json(CART)["results"]["qdd_forward"]
    draw = random.Random("Tedrake")
    for _ in range(3):
        names = ("f1", "mc", "mp", "l", "g", "theta", "theta_dot")
        at = {name: draw.uniform(0.5, 2.0) for name in names}
        assert numbers(ours, at) == pytest.approx([numbers(entry, at) for entry in PUBLISHED])


def test_everything_that_acts_stands_in_them() -> None:
    found = str(solve_json(ELBOW)["results"]["qdd_forward"])
    assert all(name in found for name in ("fv", "sgn", "k*q2", "F", "g", "tau1"))
    assert "tau2" not in found


@pytest.mark.parametrize("text", [CART, ELBOW])
def test_a_wrong_result_is_found(text: str) -> None:
    solution = dynsolve.solve(text)
    right = {name: solution.forms(name) for name in COMPARED if name != "Q" or "forces" in text}
    verify_forward(solution.robot, right)
    shown = right["qdd_forward"]
    assert isinstance(shown, Matrix)
    wrong = Matrix((shown.rows[0], tuple(map(Negative, shown.rows[1]))))
    with pytest.raises(VerificationError):
        verify_forward(solution.robot, {**right, "qdd_forward": wrong})


ARM = """
gravity: [0, 0, -g]
dh: [{theta: q1*, alpha: 90deg}, {theta: q2*, a: l2}, {theta: q3*, a: l3}]
masses: [{mass: m2, link: 2}, {mass: m3, link: 3}]
find: [qdd_forward]
"""
PLANE = """
gravity: [0, -g, 0]
dh: [{theta: q1*, a: l}, {theta: q2*, a: l}, {theta: q3*, a: l}]
masses: [{mass: m, link: 1}, {mass: m, link: 2}, {mass: m, link: 3}]
passive: [q3]
find: [qdd_forward]
"""


@pytest.mark.parametrize("text", [ELBOW, ARM, PLANE])
def test_coupled_accelerations_in_entries_of_the_inertia_matrix_are_those_multiplied_out(text: str) -> None:
    solution = dynsolve.solve(text)
    (step,) = (step for step in solution.steps if step.id == "qdd_forward")
    assert "Δ = " in report(solution, Format.TEXT).decode()
    (result,) = step.result
    shown = result.parts[-1]
    for meaning in reversed(step.defines):
        shown = mapped(shown, lambda node, one=meaning: one.parts[-1] if node == one.parts[0] else node)
    expanded = mapped(solution.forms("qdd_forward"), with_force_letters(solution.robot))
    inputs = zip(solution.robot.inputs, map(letters.force, solution.robot.coordinates), strict=True)
    names = {letter: Symbol(name) for name, letter in inputs}
    one, other = (mapped(tree, lambda node: names.get(node, node)) for tree in (shown, expanded))
    program = compile_trees([one, other])
    for _, (found, right) in islice(states_with(solution.robot.ring, program.run), 3):
        assert np.allclose(found, right, rtol=1e-9)


def test_the_summary_tells_the_entries_of_an_inertia_matrix_that_it_has_not() -> None:
    def told(text: str) -> str:
        return report(dynsolve.solve(text), Format.TEXT, detail=Detail.RESULTS).decode()

    assert "d₃₃ = m₃ l₃²" in told(ARM)
    with_inertia = told(ARM.replace("[qdd", "[D, qdd"))
    assert with_inertia.count("d₃₃ = m₃ l₃²") == 1 and "b₂ = " in with_inertia
    assert "Δ" not in told(CART)  # as short multiplied out


DISK = """
gravity: [g*sin(alpha), -g*cos(alpha), 0]
model:
  coordinates: {x: prismatic, theta: revolute}
  bodies: [{mass: m, at: [x, R, 0], turn: -theta, inertia: {zz: m*R^2/2}}]
constraints: [x - R*theta]
passive: [x, theta]
find: [qdd_forward]
"""


def test_a_disk_rolls_down_with_two_thirds_of_gravity() -> None:
    assert solve_json(DISK)["results"]["qdd_forward"] == ["2*g*sin(alpha)/3", "2*g*sin(alpha)/(3*R)"]
    text = report(dynsolve.solve(DISK.replace("[qdd", "[lambda, qdd")), Format.TEXT).decode()
    assert "𝛌 is known, and is put into the first" in text


def test_accelerations_with_constraints_are_held_and_judged_where_these_hold(tmp_path: Path) -> None:
    """On the circle x² + y² = l² of a pendulum in coordinates of its mass."""
    text = """
gravity: [0, -g, 0]
model: {coordinates: {x: prismatic, y: prismatic}, bodies: [{mass: m, at: [x, y, 0]}]}
constraints: [x^2 + y^2 - l^2]
passive: [x, y]
find: [qdd_forward]
"""
    solution = dynsolve.solve(text)
    right = {name: solution.forms(name) for name in ("hc", "Ac", "Ac_dot", "D", "Cqd", "g", "qdd_forward")}
    verify_constraints(solution.robot, right)
    shown = right["qdd_forward"]
    assert isinstance(shown, Matrix)
    with pytest.raises(VerificationError):
        wrong = Matrix((shown.rows[0], tuple(map(Negative, shown.rows[1]))))
        verify_constraints(solution.robot, {**right, "qdd_forward": wrong})
    on_it = '["x*(g*y - xdot^2 - ydot^2)/l^2", "(-g*x^2 - y*(xdot^2 + ydot^2))/l^2"]'
    for written, verdict in ((on_it, "correct"), (on_it.replace("g*y", "2*g*y"), "wrong")):
        (tmp_path / "answers.yaml").write_text(f"answers: {{qdd_forward: {written}}}\n", encoding="utf-8")
        (found,) = dynsolve.check(text, tmp_path / "answers.yaml").answers
        assert str(found.verdict) == verdict


@pytest.mark.parametrize(
    ("text", "why"),
    [
        (ELBOW + "constraints: [tip.x - c, 2*tip.x - 2*c]\n", "follows from the others"),
        (CART.replace("l*sin(theta)", "l").replace("l*cos(theta)", "l"), "no inverse"),
    ],
)
def test_where_there_are_none_it_is_told_why(text: str, why: str) -> None:
    solution = dynsolve.solve(text)
    assert why in solution.to_json()["results"]["qdd_forward"]["skipped"]
    assert any("qdd_forward" in str(warning) for warning in solution.warnings)


def test_the_step_has_the_letters_of_the_forces_and_the_book() -> None:
    solution = dynsolve.solve(CART)
    (step,) = (step for step in solution.steps if step.stage == "forward_dynamics")
    assert "Lynch and Park" in step.source
    assert letters.force(solution.robot.coordinates[0]) in list(walk(step.result[0]))


def test_its_hint_says_what_there_is_and_what_to_do() -> None:
    said = str(dynsolve.solve(CART).hint("forward_dynamics"))
    assert "matrices of the equations of motion" in said
    assert "its force is 0" in said


@pytest.mark.parametrize(
    ("name", "change", "verdict"),
    [
        ("qdd_forward", ("", ""), "correct"),
        ("forward_dynamics", ("", ""), "correct"),
        ("qdd", ("", ""), "correct"),
        ("qdd_forward", ("(-f1*", "(tau2/mp-f1*"), "correct"),
        ("qdd_forward", ("(mc + mp)", "(mc - mp)"), "wrong"),
        ("qdd_forward", ("-f1", "f1"), "wrong"),
    ],
)
def test_an_answer_is_judged(name: str, change: tuple[str, str], verdict: str, tmp_path: Path) -> None:
    entries = ", ".join(entry.replace(*change, 1) if change[0] else entry for entry in PUBLISHED)
    hand_in = tmp_path / "answers.yaml"
    hand_in.write_text(f"answers: {{{name}: [{entries}]}}\n", encoding="utf-8")
    (answer,) = dynsolve.check(CART, hand_in).answers
    assert (answer.name, str(answer.verdict)) == ("qdd_forward", verdict)


LONG = """
gravity: [0, -g, 0]
dh: [{theta: q1*, a: l1}, {theta: q2*, a: l2}, {theta: q3*, a: l3}]
masses: [{mass: m1, link: 1}, {mass: m2, link: 2}, {mass: m3, link: 3}]
"""


@pytest.mark.parametrize(
    ("text", "name", "formula"),
    [
        (LARGE, "qdd_forward", "𝐪̈ = 𝐃⁻¹ (𝛕 - 𝐂 𝐪̇ - 𝐠)"),
        (
            LONG + "constraints: [tip.y, tip.x - k]\nfind: [lambda]",
            "lambda",
            "𝛌 = -(𝐀_c 𝐃⁻¹ 𝐀_cᵀ)⁻¹ (𝐀_c 𝐃⁻¹",
        ),
        (
            f"{LARGE.replace('qdd_forward', 'Lambda')}task: [tip.x, tip.y, tip.z]",
            "Lambda",
            "𝚲 = (𝐉_r 𝐃⁻¹ 𝐉_rᵀ)⁻¹",
        ),
    ],
)
def test_what_is_too_long_stops_at_its_formula(text: str, name: str, formula: str) -> None:
    """The JSON has it, if it was multiplied out at all, and says elsewhere why not."""
    solution = dynsolve.solve(text)
    in_json, value = solution.to_json()["results"][name], known(solution.values[name])
    assert isinstance(value, Skipped) is ("skipped" in in_json) is bool(solution.warnings)
    told = " ".join(report(solution, Format.TEXT).decode().split())
    assert told.count(formula) == 2 and "not derived" not in told
    assert formula in told[told.index("Summary") :]


def test_what_is_too_long_is_judged(tmp_path: Path) -> None:
    asked = f"{LONG}find: [qdd_forward]"
    key = dynsolve.solve(asked).values["qdd_forward"].value
    parts = [(plain_form(one.numerator), plain_form(one.denominator)) for one in key.entries]
    first, *others = [f"({to_python(above)})/({to_python(below)})" for above, below in parts]
    hand_in = tmp_path / "answers.yaml"
    for sign, verdict in (("", "correct"), ("-", "wrong")):
        entries = json.dumps([sign + first, *others])
        hand_in.write_text(f"answers: {{qdd_forward: {entries}}}\n", encoding="utf-8")
        (answer,) = dynsolve.check(asked, hand_in).answers
        assert str(answer.verdict) == verdict


def test_what_is_not_derived_has_its_name_and_its_reason_in_the_summary() -> None:
    held = """
gravity: [0, -g, 0]
dh: [{theta: q1*, a: l1}, {theta: q2*, a: l2}]
masses: [{mass: m1, link: 1}, {mass: m2, link: 2}]
constraints: [tip.y - h, 2*tip.y - 2*h]
find: [qdd_forward]
"""
    told = " ".join(report(dynsolve.solve(held), Format.TEXT).decode().split())
    assert ": not derived. One constraint follows from the others" in told


TELESCOPE = """
gravity: [0, -g, 0]
dh: [{theta: q1*, alpha: 90deg}, {d: d2*}]
masses: [{mass: m, link: 2, center: tip}]
forces: [{link: 2, at: tip, force: [Fx, Fy, 0]}]
"""


def test_a_state_is_where_forces_are_held_and_no_part_of_the_equations_of_motion() -> None:
    """Q, tau_static are asked for at the state; q̈, λ and the reduced equations are for every q."""
    held = "constraints: [tip.x - k]\nfind: [lambda, reduced, Q]\n"
    for asked, names in (("find: [qdd_forward, Q]\n", ["qdd_forward"]), (held, ["lambda", "reduced"])):
        general = solve_json(TELESCOPE + asked)["results"]
        there = solve_json(TELESCOPE + asked + "state: {q1: 30deg}\n")["results"]
        assert [there[name] for name in names] == [general[name] for name in names]
        assert there["Q"] != general["Q"]


@pytest.mark.parametrize(
    ("text", "told"),
    [
        (TELESCOPE + "find: [qdd_forward]\n", "𝐃 is diagonal; its inverse has the reciprocals:"),
        (CART, "The inverse of 𝐃, its adjugate over its determinant: 𝐃⁻¹ = 1/(det 𝐃)"),
    ],
)
def test_the_inverse_is_told_as_it_is_found(text: str, told: str) -> None:
    assert told in " ".join(report(dynsolve.solve(text), Format.TEXT).decode().split())


def test_what_a_length_divides_is_cancelled_as_any_other_factor() -> None:
    """A ball that rolls on a beam about its own centre: (m R + I/R)/(m + I/R²) is R (by hand)."""
    text = """
gravity: [0, -g, 0]
model:
  coordinates: {r: prismatic, theta: revolute}
  bodies:
    - {mass: M, at: [0, 0, 0], turn: theta, inertia: {zz: J}}
    - {mass: m, at: [r*cos(theta) - R*sin(theta), r*sin(theta) + R*cos(theta), 0], turn: theta - r/R,
       inertia: {zz: I}}
passive: [r]
linearize: {r: 0, theta: 0}
find: [linear_A, linear_B, qdd_forward]
"""
    found = solve_json(text)["results"]
    assert [row[0] for row in found["linear_B"]] == ["0", "0", "R/J", "1/J"]
    assert found["linear_A"][2][0] == "-m*g*R/J"
    assert "I" not in found["qdd_forward"][1]


BRANCHES = """
gravity: none
dh:
  - {theta: q1*, a: r}
  - {theta: q2*, a: l}
  - {from: 1, theta: q3* + beta, a: b}
masses:
  - {mass: m1, link: 1, center: {near: [0, 0, 0]}, shape: {disk: {radius: r}}}
  - {mass: m2, link: 2, center: midpoint, shape: {rod: {length: l}}}
  - {mass: m3, link: 3, center: tip}
motors: [{turns: q2, inertia: J, ratio: n, carrier: 1}]
find: [c, qdd_forward]
"""


def test_what_is_coupled_through_one_coordinate_is_in_entries_without_those_that_are_zero() -> None:
    shown = " ".join(report(dynsolve.solve(BRANCHES), Format.TEXT).decode().split())
    assert "(d₂₂ d₃₃ b₁ - d₁₂ d₃₃ b₂ - d₁₃ d₂₂ b₃)/Δ" in shown
    assert "Christoffel symbols Γ₁₁₁, Γ₁₁₂, …, Γ₃₃₃ and the accelerations" in shown
    one = "(b (4m₂ J (3r² n² + l² (1 + n² - 2n) + 3r l (n² - n) cos(q₂))"
    found = to_unicode(dynsolve.solve(BRANCHES).forms("qdd_forward"))
    assert found.count(one) == 2 and f"(m₃ b² {one[3:]}" in found  # one denominator


def test_a_denominator_is_the_determinant_and_not_its_opposite() -> None:
    text = """
model:
  coordinates: {u: prismatic, q: revolute}
  D: [[a1, a2*cos(q)], [a2*cos(q), a3 + a4*sin(q)^2]]
  P: k*u^2/2
assume: [a1*a3 > a2^2]
find: [qdd_forward]
"""
    found = dynsolve.solve(text).to_json()["results"]["qdd_forward"]
    assert all(one.endswith("/(a1*(a3 + a4*sin(q)**2) - a2**2*cos(q)**2)") for one in found)
