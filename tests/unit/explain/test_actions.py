"""What is printed of friction, springs, motors and passive coordinates: steps, terms, the closing step."""

from __future__ import annotations

import pytest

from dynsolve.explain.step import Detail
from dynsolve.notation.tree import Node
from dynsolve.notation.unicode import to_unicode
from dynsolve.render.files import Format
from dynsolve.solution.reports import report
from tests.support import solved

ACTING = """
gravity: [0, -g, 0]
dh: [{theta: q1*, a: l1}, {theta: q2*, a: l2}]
masses: [{mass: m1, link: 1}, {mass: m2, link: 2}]
friction: {q1: {viscous: b1, coulomb: c1}}
springs: [{stiffness: k, of: q2 - q1, rest: delta}]
dampers: [{damping: b, of: q2 - q1}]
motors: [{turns: q1, inertia: J1, ratio: n1}, {turns: q2, inertia: J2, ratio: n2, carrier: 1}]
passive: [q2]
forces: [{link: 2, force: [F, 0, 0]}]
"""


def shown(node: Node, problem: str = ACTING) -> str:
    return " ".join(to_unicode(node, solved(problem).style).split())


def step(id: str, problem: str = ACTING):
    (found,) = (one for one in solved(problem).steps if one.id == id)
    return found


@pytest.mark.parametrize(
    ("id", "formula"),
    [
        ("Ps", "P_s = ½ k (q₂ - q₁ - δ)²"),
        ("P", "𝒫 = P₁ + P₂ + P_s = -Σᵢ₌₁² mᵢ 𝐠₀ᵀ 𝐫_ci + P_s"),
        ("Km", "K_m = Σᵢ₌₁² ½ I_mi (k_ri q̇ₖ + 𝐳ᵀ 𝛚_link)²"),
        ("friction", "τ_fk = ∂ℛ/∂q̇ₖ + f_ck sgn(q̇ₖ)"),
        ("tau1", "τ₁ + Q₁ = d/dt (∂ℒ/∂q̇₁) - ∂ℒ/∂q₁ + τ_f1"),
        ("Cqd", "𝐂 𝐪̇ + 𝐠 = 𝛕 + 𝐐 - 𝐃 𝐪̈ - 𝛕_f"),
        ("model", "𝐃 𝐪̈ + 𝐂 𝐪̇ + 𝛕_f + 𝐠 = 𝛕 + 𝐐"),
    ],
)
def test_each_stands_in_the_formula_of_its_step(id: str, formula: str) -> None:
    found = step(id).formula
    assert found is not None
    assert shown(found) == formula


@pytest.mark.parametrize(
    ("id", "working"),
    [
        ("Km", "K_m = ½ J₁ (n₁ q̇₁)² + ½ J₂ (n₂ q̇₂ + q̇₁)²"),
        ("friction", "ℛ = ½ b₁ q̇₁² + ½ b (q̇₂ - q̇₁)²"),
    ],
)
def test_what_the_problem_gives_is_put_in(id: str, working: str) -> None:
    found = step(id)
    assert shown((*found.working, *found.result)[0]) == working


def test_a_passive_coordinate_has_no_drive() -> None:
    words = "".join(part if isinstance(part, str) else shown(part) for part in step("tau2").why)
    assert "no motor drives: its torque τ₂ = 0" in words
    assert "No motor drives q₂: τ₂ = 0." in "".join(
        part if isinstance(part, str) else shown(part) for part in step("model").why
    )


def test_the_rotor_of_a_passive_coordinate_does_not_drive_it() -> None:
    told = page(ACTING)
    assert "The rotor that drives q₁ has" in told
    assert "The rotor geared to q₂ has" in told
    assert "that drives q₂" not in told


def test_the_terms_of_a_force_say_what_they_are() -> None:
    table = step("terms").table
    assert table is not None
    assert [row[2] for row in table.rows if row[2] not in ("inertial", "coupling inertia")] == [
        "Coriolis", "centrifugal", "friction", "gravity and spring",
        "centrifugal", "friction", "gravity and spring",
    ]  # fmt: skip


def test_a_robot_on_which_nothing_acts_has_none_of_it() -> None:
    plain = ACTING.split("friction:")[0]
    assert not {"Ps", "Km", "friction", "Dm"} & {one.id for one in solved(plain).steps}
    formula = step("model", plain).formula
    assert formula is not None
    assert shown(formula, plain) == "𝐃 𝐪̈ + 𝐂 𝐪̇ + 𝐠 = 𝛕"


def page(problem: str, detail: Detail = Detail.NORMAL) -> str:
    return " ".join(report(solved(problem), Format.TEXT, detail=detail).decode().split())


def test_what_is_alike_of_joints_and_bodies_is_told_once() -> None:
    arm = """
gravity: [0, -g, 0]
dh: [{theta: q1*, alpha: 90deg}, {theta: q2*, a: l}]
masses:
  - {mass: m1, link: 1, center: [0, c1, 0], inertia: {xx: A1, yy: B1, zz: A1}, about: origin}
  - {mass: m2, link: 2, center: {near: [c2, 0, 0]}, inertia: {xx: A2, yy: B2, zz: C2}, about: joint}
friction: {q1: {viscous: b}, q2: {viscous: %s}}
"""
    alike, others = page(arm % "b"), page(arm % "c")
    assert "On q₁ and q₂ acts viscous friction of coefficient b." in alike
    assert (
        "On q₁ acts viscous friction of coefficient b. On q₂ acts viscous friction of coefficient c."
        in others
    )
    assert alike.count("needs the tensor about the mass centre") == 1


def test_a_formula_that_is_the_result_stands_once() -> None:
    spring = "dh: [{theta: q1*, a: l1}]\nmasses: [{mass: m1, link: 1}]\nsprings: [{stiffness: k, of: q1}]\n"
    for detail in (Detail.NORMAL, Detail.FULL):
        text = page(spring, detail)
        assert "P_s = ½ k q₁² (Siciliano et al. §7.1.2)" in text
        assert "P_s = ½ k q₁² P_s" not in text and "§7.1.2) P_s = ½ k q₁²" not in text


def test_a_spring_in_numbers_is_not_added_to_a_weight() -> None:
    slide = """
gravity: [0, 0, -9.81]
dh: [{d: z*}]
masses: [{mass: 0.5, link: 1}]
springs: [{stiffness: 250, of: z, rest: 0.4}]
"""
    forms = solved(slide).forms
    assert to_unicode(forms("P")) == "4.905 z + 125(z - 0.4)²"
    assert to_unicode(forms.matrix("g").rows[0][0]) == "4.905 + 250(z - 0.4)"
    assert to_unicode(forms("dLdq1")) == "-4.905 - 250(z - 0.4)"
    assert to_unicode(forms("tau1")) == "0.5 z̈ + 4.905 + 250(z - 0.4)"


@pytest.mark.parametrize(
    ("friction", "function"),
    [("4", "2q̇₁²"), ("3", "(3/2) q̇₁²"), ("1", "½ q̇₁²"), ("c", "½ c q̇₁²"), ("0.05", "½·0.05 q̇₁²")],
)
def test_half_of_a_whole_number_is_one_number(friction: str, function: str) -> None:
    problem = f"dh: [{{theta: q1*, a: l}}]\nmasses: [{{mass: m, link: 1}}]\nfriction: {{q1: {friction}}}\n"
    (found,) = step("friction", problem).working
    assert shown(found, problem) == f"ℛ = {function}"


def test_each_of_several_dampers_has_its_own_rate() -> None:
    """Not (b₁ + b) q̇₁ - b q̇₂: a damper is written as a spring is, before what has no rate."""
    row = "model: {coordinates: {x: prismatic, y: prismatic}, bodies: [{mass: m1, at: [x, 0, 0]}, "
    row += "{mass: m2, at: [y, 0, 0]}]}\nfriction: {x: b1}\nsprings: [{stiffness: k, of: y - x}]\n"
    forms = solved(row + "dampers: [{damping: b, of: y - x}, {damping: c, of: x + y}]\n").forms
    assert list(map(to_unicode, (entry for (entry,) in forms.matrix("friction").rows))) == [
        "b₁ ẋ - b (ẏ - ẋ) + c (ẋ + ẏ)",
        "b (ẏ - ẋ) + c (ẋ + ẏ)",
    ]
    assert to_unicode(forms("tau2")) == "m₂ ÿ + b (ẏ - ẋ) + c (ẋ + ẏ) + k (y - x)"


def test_each_of_several_springs_has_its_own_pull() -> None:
    row = "gravity: none\ndh: [{d: q1*}, {d: q2*}]\nmasses: [{mass: m1, link: 1}, {mass: m2, link: 2}]\n"
    springs = "springs: [{stiffness: k, of: q1, rest: a}, {stiffness: 2*k, of: q2 - q1, rest: b}]\n"
    forms = solved(row + springs).forms
    assert to_unicode(forms("dLdq1")) == "2k (q₂ - q₁ - b) - k (q₁ - a)"
    assert to_unicode(forms.matrix("g").rows[0][0]) == "k (q₁ - a) - 2k (q₂ - q₁ - b)"


@pytest.mark.parametrize(
    ("springs", "energy"),
    [
        (
            "{stiffness: 30, of: q1, rest: 0.2}, {stiffness: 20, of: q2 - q1, rest: 0.3}",
            "P_s = 15(q₁ - 0.2)² + 10(q₂ - q₁ - 0.3)²",
        ),
        (
            "{stiffness: 30, of: q1, rest: 1}, {stiffness: 20, of: q1, rest: -1}",
            "P_s = 15(q₁ - 1)² + 10(q₁ + 1)²",
        ),
        ("{stiffness: 30, of: q1}, {stiffness: 20, of: q1}", "P_s = 25q₁²"),
        ("{stiffness: k, of: q1}, {stiffness: k, of: q2 - q1}", "P_s = ½ k q₁² + ½ k (q₂ - q₁)²"),
        ("{energy: k*q1^2/2 + k3*q1^4/4}", "P_s = ½ k q₁² + ¼ k₃ q₁⁴"),
        ("{energy: k*(q1 - a*q2 - d)^2/2}", "P_s = ½ k (q₁ - a q₂ - d)²"),
        ("{energy: k*(q2 + a*q1 + d)^2/2}", "P_s = ½ k (q₂ + a q₁ + d)²"),
        ("{energy: k*(a*sin(q1) - d)^2/2 + u*q1}", "P_s = u q₁ + ½ k (a s₁ - d)²"),
        ("{stiffness: 40, of: q1, rest: 2*l - 0.3}", "P_s = 20(q₁ - 2l + 0.3)²"),
        ("{stiffness: k, of: a*q1, rest: a - 0.1}", "P_s = ½ k (a q₁ - a + 0.1)²"),
        (
            "{stiffness: 2*k, of: q2 - q1, rest: l + 1/2}",
            "P_s = k (q₂ - q₁ - ½ - l)²",
        ),
    ],
)
def test_a_spring_keeps_its_square_in_the_energy_of_all(springs: str, energy: str) -> None:
    arm = "gravity: none\ndh: [{d: q1*}, {d: q2*}]\nmasses: [{mass: m1, link: 1}, {mass: m2, link: 2}]\n"
    text = f"{arm}springs: [{springs}]\n"
    (result,) = step("Ps", text).result
    assert shown(result, text) == energy
