"""What leads from one line of a step to the next, as it is read."""

from __future__ import annotations

import re
from unicodedata import normalize

import dynsolve
from dynsolve.explain.forms import _without_minus
from dynsolve.explain.step import Detail
from dynsolve.notation import tree
from dynsolve.notation.text import read
from dynsolve.notation.unicode import to_unicode
from dynsolve.quantities import letters
from dynsolve.render.files import Format
from dynsolve.solution.reports import report


def page(problem: str, detail: Detail = Detail.NORMAL) -> str:
    """The worked solution as it stands on a terminal."""
    text = report(dynsolve.solve(problem), Format.TEXT, detail=detail).decode()
    return normalize("NFC", text)


def test_what_columns_of_the_jacobian_use_is_told_before_the_jacobian() -> None:
    _, *led = page("elbow-3r").split("With s₁² + c₁² = 1:\n\n")
    displays = [part.split("\n\n")[0] for part in led]
    assert any("𝐉_v =" in each for each in displays)
    assert not any("𝐨₃ - 𝐨₂" in each for each in displays)


TILTED = """
dh:
  - {theta: q1*, a: b, alpha: beta}
  - {d: q2*, alpha: -beta}
  - {theta: q3*, a: l}
masses: [{mass: m, link: 3, center: tip, shape: point}]
find: [K]
"""


def test_squares_are_multiplied_out_in_the_angles_that_they_have() -> None:
    _, squares = page(TILTED).split("The squares of its entries:")
    squares, *_ = squares.split("K_ω")
    assert "s₃" in squares and "s₁₃" not in squares


def test_squares_are_worked_out_along_axes_where_they_are_short() -> None:
    slide = "dh: [{theta: q1*, a: a, alpha: 90deg}, {d: q2* + d0, alpha: -90deg}, {theta: q3*, a: l}]\n"
    shown = page(slide + "masses: [{mass: m, link: 3, center: [-u, w, 0], inertia: {zz: I}}]\nfind: [K]\n")
    assert "(𝐑₂⁰)ᵀ 𝐯₁" in shown


def test_a_twist_about_another_axis_stands_in_products() -> None:
    shown = page(TILTED.replace("[K]", "[K, tau]"))
    assert "s₃ sin(β)" in shown
    assert "q₃ - β" not in shown and "q₃ + β" not in shown


def test_a_constant_angle_about_the_joints_axis_stands_in_sums() -> None:
    bent = """
dh: [{theta: q1*, a: l1}, {theta: beta, a: l2}, {theta: q2*, a: l3}]
masses: [{mass: m, link: 3, center: tip, shape: point}]
"""
    assert "cos(q₁ + q₂ + β)" in page(bent)
    turned = "dh: [{theta: q1*, alpha: 90deg}, {theta: 90deg, alpha: beta}, {theta: -90deg, d: d}]\n"
    assert "cos(q₁ + β)" in page(turned)


LEANING = """
gravity: [0, 0, -g]
dh:
  - {theta: q1*, alpha: 90deg}
  - {theta: q2*, d: e, a: l2}
  - {theta: q3*, a: l3}
masses:
  - {mass: m2, link: 2, center: midpoint, inertia: {xx: A, yy: B, zz: C, xy: E}}
  - {mass: m3, link: 3, center: tip, shape: point}
"""


def test_every_angle_that_a_force_is_collected_with_is_told() -> None:
    shown = " ".join(page(LEANING).split())
    assert "collected with c₂² - s₂² = cos(2q₂)." in shown
    assert "cos(2q₂)" in shown.partition("collected with")[2].partition("cos(2q₂)")[2]


def test_a_model_in_decimals_has_no_fractions_among_them() -> None:
    shown = page("""
gravity: [0, 0, -g]
dh:
  - {d: q1*, alpha: 60deg}
  - {theta: q2*, a: 0.4, alpha: 0}
  - {theta: q3*, a: 0.2, alpha: 0}
masses: [{mass: 2, link: 3, center: [-0.1, 0.05, 0], shape: point}]
find: [K]
""")
    _, energy = shown.split("The squares of its entries:")
    energy, *_ = energy.split("K_ω")
    without_roots = re.sub(r"√3 [^/]*/2", "", energy)  # of 60°
    assert "0.1" in energy and not re.search(r"/\d", without_roots)


def test_a_sum_has_one_spelling_in_a_formula() -> None:
    shown = page("""
dh: [{theta: q1*, a: a, alpha: 90deg}, {d: q2* + d0, alpha: -90deg}, {theta: q3*, a: l}]
masses: [{mass: m, link: 3, center: [-u, w, 0], inertia: {zz: I}}]
find: [K]
""")
    assert "w (d₀ + q₂) - a (l - u)" in shown
    assert "a (l - u) - w (d₀ + q₂)" not in shown


def test_a_sum_has_one_spelling_in_a_report() -> None:
    shown = page("""
gravity: [0, -g, 0]
dh:
  - {theta: q1* + 20deg, a: a1, alpha: 90deg}
  - {theta: 90deg, d: d2*, alpha: -90deg}
  - {theta: q3* - 20deg, a: b}
masses: [{mass: m, link: 3, center: origin, shape: point}]
""")
    *_, matrices = shown.split("Summary")
    assert matrices.count("d₂ - b sin(q₃ - 20°)") > 2, "the distance before the sine, though 𝐠 has it last"
    assert "b sin(q₃ - 20°) - d₂" not in shown


SKEW = """
dh:
  - {theta: q1*, a: a1, alpha: 90deg}
  - {theta: q2*, alpha: gamma}
  - {d: q3*}
masses:
  - {mass: m2, link: 2, center: [0, 0, p], inertia: {xx: A, yy: B, zz: C, xz: E}, about: origin}
  - {mass: m3, link: 3, center: origin, shape: point}
find: [K]
"""


def test_a_line_that_an_identity_leads_to_is_collected_at_once() -> None:
    shown = page(SKEW)
    assert "= 1, and collected:" in shown
    assert "\nCollected:" not in shown


def test_an_energy_has_no_minus_before_the_square_of_a_rate() -> None:
    energies = re.findall(r"K_(?:v|ω)1 = ½[^\n]*(?:\n {8,}[^\n]*)*", page(SKEW))
    assert energies and not any(re.search(r"\n *- \([^\n]*\) q̇₁²", each) for each in energies)


def test_an_energy_begins_with_no_minus() -> None:
    """Each term of its sum can take the minus, one in the sum of its own factor."""
    inner = read("((a - b)*s - 2*c)*x^2 + (d - f)*y^2").tree
    energy = tree.Negative(tree.Product((letters.HALF, inner)))
    assert to_unicode(_without_minus(energy)) == "½ (((b - a) s + 2c) x² + (f - d) y²)"
    assert to_unicode(_without_minus(tree.Negative(read("(a + b)*x^2").tree))) == "-(a + b) x²"


def test_the_tensor_of_a_body_that_does_not_turn_is_not_turned() -> None:
    body = "masses: [{mass: m, link: 1, center: origin, inertia: {xx: A, yy: B, zz: C}}]\n"
    assert "𝐈₁ 𝐑₁ᵀ" not in page("dh: [{theta: 90deg, d: q1*, alpha: 90deg}]\n" + body)


def test_a_mass_centre_at_the_near_end_is_its_origin() -> None:
    arm = "dh: [{theta: q1*, a: l1}]\nmasses: [{mass: m, link: 1, center: {near: [0, 0, 0]}}]\n"
    shown = page(arm)
    assert "The mass centre of body 1 is at the near end of link 1, 𝐨₀." in shown
    assert "𝐫_c1 = 𝐨₀" in shown


def test_a_difference_of_moments_in_decimals_has_no_minus_before_it() -> None:
    link = """
gravity: [0, -g, 0]
dh: [{theta: q*, a: l, alpha: 90deg}]
masses: [{mass: m, link: 1, center: [-l/2, 0.1, 0], inertia: {xx: A, yy: B, zz: C}, about: origin}]
find: [K]
"""
    assert "½ (B - m l²/4) q̇²" in page(link, Detail.FULL)


TRAILER = """
model:
  coordinates: {x: prismatic, y: prismatic, psi: revolute, delta: revolute}
  bodies:
    - {mass: M, at: [x, y, 0], turn: psi, inertia: {zz: J}}
    - {mass: m, at: [x - e*cos(psi + delta), y - e*sin(psi + delta), 0]}
"""


def test_what_is_not_shown_is_not_read_off_above() -> None:
    shown = page(TRAILER)
    assert "Coriolis, centrifugal and gravity terms, read off" not in shown
    assert "read off above" not in shown
