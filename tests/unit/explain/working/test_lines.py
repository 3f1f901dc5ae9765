"""The lines between a formula and its result: each is true, and those that matter are there."""

from __future__ import annotations

import re

import pytest
from hypothesis import example, given, settings

import dynsolve
from dynsolve.algebra.ring import Expr
from dynsolve.document import Prose
from dynsolve.explain.step import Detail, Step
from dynsolve.explain.working.identities import are_alike, identities
from dynsolve.notation.tree import Cross, Relation
from dynsolve.notation.tree_values import evaluate
from dynsolve.notation.unicode import to_unicode
from dynsolve.render.files import Format
from dynsolve.solution.reports import report
from tests.robots import robots
from tests.support import STEMS, solved
from tests.unit.explain.working.evaluated import members

FAMILIAR = sorted(STEMS - {"puma560", "panda-7r", "stanford-6"})


def step(problem: str, id: str) -> Step:
    (found,) = (step for step in solved(problem).steps if step.id == id)
    return found


def said(prose: Prose, problem: str) -> str:
    style = solved(problem).style
    return "".join(part if isinstance(part, str) else to_unicode(part, style) for part in prose)


def lines(problem: str, id: str) -> list[str]:
    """The lines of a step, each with its operation, and the last operation."""
    found, style = step(problem, id), solved(problem).style
    shown = [
        text
        for line in found.lines
        for text in (said(line.by, problem), *(to_unicode(formula, style) for formula in line.formulas))
    ]
    return [*shown, said(found.concluding, problem)] if found.concluding else shown


def assert_true(solution: dynsolve.Solution) -> None:
    """Every line is an equation of equals; a line of one value that the step's result has, has that one."""
    ring = solution.robot.ring
    for each in solution.steps:
        for line in each.lines:
            for formula in line.formulas:
                values = members(ring, formula)
                assert all(value == values[0] for value in values), (each.id, line)
                if each.id.startswith(("Kv", "ddt", "dLdq")) and isinstance(values[0], Expr):
                    assert values[0] in members(ring, each.result[0]), (each.id, line)


@pytest.mark.parametrize("problem", FAMILIAR)
def test_every_line_is_true(problem: str) -> None:
    assert_true(solved(problem))


def assert_named(solution: dynsolve.Solution) -> None:
    """Identities that lead from one line of an energy to the next are named, and none leads to itself."""
    ring = solution.robot.ring
    for each in solution.steps:
        if not each.id.startswith("K") or not each.result:
            continue
        equations = [*each.working[-1:], *(line.formulas[-1] for line in each.lines), each.result[0]]
        words = [*(line.by for line in each.lines), each.concluding][-len(equations) + 1 :]
        for before, after, by in zip(equations, equations[1:], words, strict=False):
            assert isinstance(before, Relation) and isinstance(after, Relation)
            pair = (before.parts[-1], after.parts[-1])
            is_told = any(isinstance(part, Relation) for part in by) or "identities" in str(by)
            assert not by or is_told or not identities(ring, *pair), (each.id, by, pair)
            assert not by or not are_alike(*pair), (each.id, by)


TILTED_TWICE = """
title: tilted twice by one angle, whose sine squared is 1 - cos² in the ring
convention: modified
base: Ry(17deg)
dh: [{theta: q1*, alpha: 17deg}]
masses: [{mass: m1, link: 1, center: [x1, 0, 0]}]
"""


SIX_TIMES = """
title: lines with 6 · 17° = 90° + 12°
gravity: [0, 0, -g]
dh:
  - {theta: q1*}
  - {theta: 90deg, d: q2*, alpha: 17deg}
  - {theta: q3* + 17deg}
masses:
  - {mass: m1, link: 1, center: origin, shape: {box: {x: b1, y: 0.2, z: 2*b1}}}
  - mass: m2
    link: 3
    center: origin
    shape: {hollow_cylinder: {outer: 0.3, inner: 0.1, length: r2, axis: x}}
    axes: base
"""


@settings(max_examples=5, deadline=None)
@example(problem=TILTED_TWICE)
@example(problem=SIX_TIMES)
@given(robots(max_joints=3))
def test_every_line_of_any_robot_is_true_and_its_identities_are_named(problem: str) -> None:
    solution = dynsolve.solve(problem)
    assert_true(solution)
    assert_named(solution)


@pytest.mark.parametrize("problem", FAMILIAR)
def test_every_identity_is_named(problem: str) -> None:
    assert_named(solved(problem))


def test_squares_of_absolute_angles_by_the_cosine_of_a_difference() -> None:
    assert lines("planar-2r", "Kv2") == [
        "The squares multiplied out:",
        "K_v2 = ½ m₂ (l₁² (s₁² + c₁²) q̇₁² + l_c2² (s₁₂² + c₁₂²)(q̇₁ + q̇₂)² "
        "+ 2l₁ l_c2 (s₁ s₁₂ + c₁ c₁₂) q̇₁ (q̇₁ + q̇₂))",
        "By s₁² + c₁² = 1, s₁₂² + c₁₂² = 1 and the cosine of a difference, c₁ c₁₂ + s₁ s₁₂ = c₂:",
        "K_v2 = ½ m₂ (l₁² q̇₁² + l_c2² (q̇₁ + q̇₂)² + 2l₁ l_c2 c₂ q̇₁ (q̇₁ + q̇₂))",
        "The sums of rates multiplied out, and collected:",
    ]


def test_a_velocity_turned_with_the_waist_has_the_square_of_the_velocity() -> None:
    assert lines("elbow-3r", "Kv3")[:2] == [
        "By (U s₁ + V c₁)² + (U c₁ - V s₁)² = U² + V² with (L₂ c₂ + l_c3 c₂₃) θ̇₁ "
        "and L₂ s₂ θ̇₂ + l_c3 s₂₃ (θ̇₂ + θ̇₃) for U and V:",
        "K_v3 = ½ m₃ (((L₂ c₂ + l_c3 c₂₃) θ̇₁)² + (L₂ s₂ θ̇₂ + l_c3 s₂₃ (θ̇₂ + θ̇₃))² "
        "+ (L₂ c₂ θ̇₂ + l_c3 c₂₃ (θ̇₂ + θ̇₃))²)",
    ]


def test_a_velocity_is_written_so_that_its_square_is_seen() -> None:
    """By the sine and the cosine of the waist: V c₁ - U s₁ and U c₁ + V s₁."""
    shown = to_unicode(step("spherical-rrp", "v3").result[0], solved("spherical-rrp").style)
    assert shown == (
        "𝐯₃ = [[c₁ (c₂ d\u0307₃ - d₃ s₂ θ̇₂) - d₃ s₁ c₂ θ̇₁], [d₃ c₁ c₂ θ̇₁ + s₁ (c₂ d\u0307₃ - d₃ s₂ θ̇₂)], "
        "[d₃ c₂ θ̇₂ + s₂ d\u0307₃]]"
    )
    assert lines("spherical-rrp", "Kv3")[0] == (
        "By (V c₁ - U s₁)² + (U c₁ + V s₁)² = U² + V² with d₃ c₂ θ̇₁ and c₂ d\u0307₃ - d₃ s₂ θ̇₂ for U and V:"
    )
    plain = to_unicode(step("elbow-3r", "v2").result[0], solved("elbow-3r").style)
    assert "-l_c2 (s₁ c₂ θ̇₁ + c₁ s₂ θ̇₂)" in plain, "each stands once: nothing is hidden"


def test_the_energies_of_the_bodies_are_added_before_they_are_collected() -> None:
    _, plain, concluding = lines("spherical-rrp", "K")
    assert plain == (
        "𝒦 = ½ I₁ θ̇₁² + ½ (m₂ l_c2² + I₂)(c₂² θ̇₁² + θ̇₂²) + ½ m₃ (d₃² (c₂² θ̇₁² + θ̇₂²) + d\u0307₃²)"
    )
    assert concluding == "Collected:"
    assert lines("spherical-rrp", "K2") == [], "its terms stand just above"
    crust = "K₂ = ⅛ m₂ L₂² (c₂² θ̇₁² + θ̇₂²) + (1/24) m₂ L₂² (c₂² θ̇₁² + θ̇₂²)"
    assert lines("crustcrawler-2r", "K2") == ["", crust, "Collected:"], "numbers are added"
    elbow = "K₂ = ½ m₂ l_c2² (c₂² θ̇₁² + θ̇₂²) + ½ ((I_2xx s₂² + I_2yy c₂²) θ̇₁² + I_2zz θ̇₂²)"
    assert lines("elbow-3r", "K2") == ["", elbow, "Collected:"], "its brackets are others"
    assert lines("planar-2r", "P") == [], "it is the plain sum"


def test_what_the_components_of_a_velocity_share_is_taken_out_of_the_squares() -> None:
    crust, style = "crustcrawler-2r", solved("crustcrawler-2r").style
    (squares,) = (to_unicode(node, style) for node in step(crust, "Kv2").working)
    assert squares.startswith("K_v2 = ½ m₂ (L₂/2)² ((s₁ c₂ θ̇₁ + c₁ s₂ θ̇₂)² + ")
    (with_rate,) = (to_unicode(node, solved("planar-2r").style) for node in step("planar-2r", "Kv1").working)
    assert with_rate == "K_v1 = ½ m₁ l_c1² q̇₁² (s₁² + c₁²)"
    (unshared,) = (to_unicode(node) for node in step("in3140-rp", "Kv2").working)
    assert unshared.startswith("K_v2 = ½ m₂ ((cos(θ₁) ")
    (decimal,) = (to_unicode(node) for node in step("numeric-2r", "Kv1").working)
    assert decimal.startswith("K_v1 = ½·2.5 ((0.25 sin(q₁)")


def test_it_is_said_which_squares_are_multiplied_out() -> None:
    found = lines("elbow-3r", "Kv3")
    assert found[2] == "The last two squares multiplied out:"
    assert "½ m₃ (((L₂ c₂ + l_c3 c₂₃) θ̇₁)² + L₂² (s₂² + c₂²) θ̇₂²" in found[3], "the first stays"
    assert found[-1] == "The sums of rates multiplied out, and collected:"


CRANE = """
dh:
  - {theta: q1*, d: h, alpha: 90deg}
  - {theta: q2*, a: b, alpha: 90deg}
  - {d: s3*}
masses:
  - {mass: m1, link: 1, center: [e, 0, 0]}
  - {mass: m3, link: 3}
"""


def test_squares_that_need_no_identity_become_the_result_in_one_line() -> None:
    found = lines(CRANE, "Kv2")
    assert found[-1] == "The square of the sum multiplied out, and collected:"
    assert not any("sorted" in words for words in found)


FLOATING = """
dh:
  - {theta: q1*, d: h}
  - {d: q2*, alpha: -90deg}
masses:
  - {mass: m2, link: 2, center: [x2, y2, z2]}
"""


def test_squares_that_do_not_stand_first_are_kept_by_name_and_what_cancels_is_told() -> None:
    found = lines(FLOATING, "Kv1")
    assert found[0] == "All but q̇₂² multiplied out; the terms with s₁ c₁ cancel:"
    assert found[2] == "By s₁² + c₁² = 1, and collected:"


def test_a_sign_that_a_square_loses_is_no_step() -> None:
    offset = CRANE.replace("d: h,", "d: h, a: a,").replace("[e, 0, 0]", "[-e, 0, 0]")
    (square,) = (to_unicode(node) for node in step(offset, "Kv1").result)
    assert square == "K_v1 = ½ m₁ (a - e)² q̇₁²"
    assert lines(offset, "Kv1") == ["By sin²(q₁) + cos²(q₁) = 1:"]


def test_all_bodies_of_an_arm_are_worked_out_along_the_same_axes() -> None:
    for problem, bodies in (("spherical-rrp", "2"), ("crustcrawler-2r", "2"), ("elbow-3r", "23")):
        assert all("own axes it is" in said(step(problem, f"Kw{body}").why, problem) for body in bodies)
    assert not any(lines("planar-2r", f"Kw{body}") for body in "12")


def test_what_a_line_needs_is_referred_to_where_it_goes_in() -> None:
    found = step("elbow-3r", "Kw2")
    assert found.uses == ("v2", "R2") and [line.uses for line in found.lines[:2]] == [(), ("I_body2",)]
    text = report(solved("elbow-3r"), Format.MARKDOWN, detail=Detail.FULL).decode()
    of_rotation = re.findall(r"With \(\d+\) and \(\d+\), along the body's own axes", text)
    of_tensor = re.findall(r"With \(\d+\), the tensor along the body's own axes put in:", text)
    assert len(of_rotation) == 4, "R and what is turned first"
    assert len(of_tensor) == 4, "and the tensor a line later, in the energies and in D"


def test_where_one_identity_does_all_it_is_named_and_no_line_is_spent() -> None:
    assert lines("planar-2r", "Kv1") == ["By s₁² + c₁² = 1:"]
    turned = "By (U s₁ + V c₁)² + (U c₁ - V s₁)² = U² + V² with c₂ θ̇₁ and s₂ θ̇₂ for U and V:"
    assert lines("crustcrawler-2r", "Kvp")[0] == turned


def test_a_turned_vector_of_two_products_is_multiplied_out() -> None:
    assert lines("in3140-rp", "Kv2") == [
        "The squares multiplied out; the terms with θ̇₁ L̇₂ cancel:",
        "K_v2 = ½ m₂ (L₂² (s₁² + c₁²) θ̇₁² + (s₁² + c₁²) L̇₂²)",
        "By s₁² + c₁² = 1:",
    ]


def test_squares_of_products_with_one_rate_are_collected_at_once() -> None:
    tilted = """
gravity: [0, -g, 0]
base: Rx(60deg)
dh: [{theta: q1*, a: r, alpha: 45deg}, {theta: q2*, d: t}]
masses: [{mass: m, link: 2, center: origin}]
"""
    _, _, opened, squares, collected = lines(tilted, "Kv1")
    assert opened == "The squares of its entries:"
    assert squares.startswith("K_v1 = ½ m ((√2 t q̇₁/2)² + ")
    assert collected == "Collected:"


def test_the_rotation_along_the_axes_of_the_body_where_that_is_shorter() -> None:
    found = lines("elbow-3r", "Kw2")
    assert found[0] == "Along the body's own axes, with s₁² + c₁² = 1 (the terms with s₁ c₁ cancel):"
    assert found[1].endswith(" = [[s₂ θ̇₁], [c₂ θ̇₁], [θ̇₂]]")
    assert found[-3:] == [
        "Multiplied out:",
        "K_ω2 = ½ (I_2xx (s₂ θ̇₁)² + I_2yy (c₂ θ̇₁)² + I_2zz θ̇₂²)",
        "Collected:",
    ]
    assert lines("elbow-3r", "Kw3")[-1] == "Collected:", "(θ̇₂ + θ̇₃)² stays as it is"
    assert not lines("planar-2r", "Kw2")


def test_longer_arms_stay_as_short_as_they_are() -> None:
    of_each = re.compile(r"(H|J|v|Kv|K|dLdqd|ddt|dLdq|tau)\d")
    steps = [each for each in solved("stanford-6").steps if of_each.fullmatch(each.id)]
    assert steps and not any(each.lines for each in steps)
    squares = "Multiplied out, with s₁² + c₁² = 1 and s₂² + c₂² = 1, and collected:"
    assert lines("stanford-6", "Kv3") == [squares]
    turning = [each for each in solved("stanford-6").steps if re.fullmatch(r"Kw\d", each.id)]
    assert all(len(each.lines) <= 2 for each in turning), "the angular velocity along the body's own axes"


def test_an_arm_of_four_joints_with_parallel_axes_is_worked_out() -> None:
    """Its last frame has fewer terms than that of a spatial arm of three joints."""
    assert lines("scara-rrpr", "H2") == [
        "With the cosine of a sum, c₁ c₂ - s₁ s₂ = c₁₂ and the sine of a sum, s₁ c₂ + c₁ s₂ = s₁₂:"
    ]
    assert lines("scara-rrpr", "Kv2")[-1] == "The sums of rates multiplied out, and collected:"


WRIST = """
gravity: [0, 0, -g]
dh:
  - {theta: q1*, d: h, alpha: 90deg}
  - {theta: q2*, a: l2}
  - {theta: q3*, alpha: 90deg}
  - {theta: q4*, d: l4}
masses:
  - {mass: m2, link: 2, center: tip}
  - {mass: m4, link: 4, center: tip, inertia: {xx: A, yy: A, zz: G}}
"""


def test_a_spatial_arm_of_four_joints_is_worked_out_where_its_D_C_and_g_are_not_long() -> None:
    """Its last frame is long, and tells nothing of its dynamics."""
    for name in ("Kv2", "ddt1", "C"):
        assert lines(WRIST, name), name
    assert lines(WRIST, "ddt1")[0] == "Term by term:"
    assert lines(WRIST, "C")[1] == "C₁₁ = c₂₁₁ q̇₂ + c₃₁₁ q̇₃"


def test_a_derivative_term_by_term_where_several_factors_move() -> None:
    assert lines("planar-2r", "ddt1") == [
        "Term by term:",
        "d/dt (∂ℒ/∂q̇₁) = (m₁ l_c1² + m₂ (l₁² + l_c2² + 2l₁ l_c2 c₂) + I₁ + I₂) q̈₁ - 2m₂ l₁ l_c2 s₂ q̇₁ q̇₂ "
        "+ (m₂ (l_c2² + l₁ l_c2 c₂) + I₂) q̈₂ - m₂ l₁ l_c2 s₂ q̇₂²",
        "Collected:",
    ]
    assert lines("planar-2r", "ddt2") == [], "its two lines would be the same"
    assert lines("in3140-rp", "ddt2") == lines("rp-vertical", "dLdq2") == []
    assert lines("planar-2r", "dLdq2") == [
        "Term by term:",
        "∂ℒ/∂q₂ = -m₂ l₁ l_c2 s₂ q̇₁² - m₂ l₁ l_c2 s₂ q̇₁ q̇₂ - m₂ g l_c2 c₁₂",
        "Collected:",
    ]
    assert lines("in3140-rp", "ddt1") == lines("spherical-rrp", "ddt2") == [], "terms in another order"


def test_the_root_of_a_number_stands_before_the_lengths_of_a_derivative() -> None:
    tilted = TILTED.replace("Rx", "Ry")
    assert "√3 l₂" in "".join(lines(tilted, "dLdq2")) and "l₂ √3" not in "".join(lines(tilted, "dLdq2"))


def test_the_addition_theorem_of_a_derivative_is_named() -> None:
    sine = "the sine of a sum, s₂ c₂₃ + c₂ s₂₃ = sin(2θ₂ + θ₃)"
    assert lines("elbow-3r", "ddt1")[-1] == lines("elbow-3r", "dLdq2")[-1] == f"Collected, with {sine}:"
    assert lines("elbow-3r", "ddt1")[2] == "Multiplied out, and sorted by the products of the rates:"
    derived, *slopes = lines("elbow-3r", "christoffel")[:5]
    assert derived == (
        f"The derivatives of 𝐃 that are not zero, term by term, multiplied out, and collected with {sine}:"
    )
    assert [text.split(" = ")[0] for text in slopes] == ["∂d₁₁/∂θ₂", "∂d₁₁/∂θ₃", "∂d₂₂/∂θ₃", "∂d₂₃/∂θ₃"]


def test_the_sums_of_the_entries_of_c() -> None:
    shown = lines("planar-2r", "C")
    assert shown[0] == "The sums, without what is zero:"
    assert [text.split(" = ")[1] for text in shown[1:]] == ["c₂₁₁ q̇₂", "c₁₂₁ q̇₁ + c₂₂₁ q̇₂", "c₁₁₂ q̇₁"]


def test_the_rate_of_d_in_the_check_of_skewness() -> None:
    assert [text.partition(" = ")[2] for text in lines("planar-2r", "skew")[1:]] == [
        "(∂d₁₁/∂q₂) q̇₂ = -2m₂ l₁ l_c2 s₂ q̇₂",
        "ḋ₂₁ = (∂d₁₂/∂q₂) q̇₂ = -m₂ l₁ l_c2 s₂ q̇₂".replace("ḋ", "d\u0307"),
    ]


TILTED = """
base: Rx(30deg)
dh: [{theta: q1*, a: l1, alpha: 90deg}, {theta: q2*, a: l2}]
masses: [{mass: m, link: 2}]
"""


def test_a_velocity_is_squared_along_the_axes_in_which_that_is_plain() -> None:
    found = lines(TILTED, "Kv1")
    assert found[0] == "A rotation leaves the length of 𝐯₁ unchanged; along the axes of frame 0:"
    assert found[1].startswith("(𝐑₀^w)ᵀ 𝐯₁ = [[1, 0, 0], [0, √3/2, -½], [0, ½, √3/2]]ᵀ [[")
    assert found[2] == "The squares of its entries:"
    assert not step(TILTED, "Kv1").working
    assert found[4].startswith("By (U s₁ + V c₁)² + (U c₁ - V s₁)² = U² + V² with ")
    assert found[4].endswith(" for U and V:")
    assert "√" not in found[1].rpartition(" = ")[2] and "√" not in "".join(found[2:])


def test_the_columns_of_a_leaning_arm_are_multiplied_along_axes_in_which_that_is_plain() -> None:
    found = lines(TILTED, "D_direct1")
    turned = "[[-s₁ (l₁ + l₂ c₂), -l₂ c₁ s₂], [c₁ (l₁ + l₂ c₂), -l₂ s₁ s₂], [0, l₂ c₂]]"
    assert found[0] == "A rotation leaves the products of the columns unchanged; along the axes of frame 0:"
    assert found[1].startswith("(𝐑₀^w)ᵀ 𝐉_v1 = [[1, 0, 0], [0, √3/2, -½], [0, ½, √3/2]]ᵀ [[")
    assert found[1].endswith(f" = {turned}")
    assert found[2] == "Their products:"
    assert found[3] == f"m 𝐉_v1ᵀ 𝐉_v1 = m ((𝐑₀^w)ᵀ 𝐉_v1)ᵀ ((𝐑₀^w)ᵀ 𝐉_v1) = m {turned}ᵀ {turned}"
    assert (
        found[4] == "With s₁² + c₁² = 1 (the terms with s₁ c₁ cancel):" and found[-1] == "By s₂² + c₂² = 1:"
    )
    assert not step(TILTED, "D_direct1").working
    assert "√" not in "".join(found[2:])


TILTED_BODIES = """
convention: modified
base: Rx(30deg)
dh: [{theta: q1*, d: d1}, {theta: q2*, alpha: 90deg}]
masses:
  - {mass: m1, link: 1, center: [0, 0, 0], inertia: {xx: Ixx1, yy: Iyy1, zz: Izz1}}
  - {mass: m2, link: 2, center: [lc2, 0, 0], inertia: {xx: Ixx2, yy: Iyy2, zz: Izz2}}
"""


def test_the_rotation_of_a_leaning_base_is_taken_out_before_that_of_the_body() -> None:
    first, shown, axes, seen, by, second = lines(TILTED_BODIES, "Kw2")[:6]
    assert first == "Along the axes of frame 0:"
    assert shown.startswith("(𝐑₀^w)ᵀ 𝛚₂ = [[1, 0, 0], [0, √3/2, -½], [0, ½, √3/2]]ᵀ [[")
    assert shown.endswith(" = [[s₁ q̇₂], [-c₁ q̇₂], [q̇₁]]")
    assert axes == "The body's axes seen from frame 0, the rotation of 𝐀₁ 𝐀₂:"
    assert seen.startswith("(𝐑₀^w)ᵀ 𝐑₂ = [[1, 0, 0], [0, √3/2, -½], [0, ½, √3/2]]ᵀ [[")
    assert seen.endswith(" = [[c₁ c₂, -c₁ s₂, s₁], [s₁ c₂, -s₁ s₂, -c₁], [s₂, c₂, 0]]")
    assert by == (
        "From there along the body's own axes, by (𝐑₀^w)ᵀ 𝐑₂, with s₁² + c₁² = 1 "
        "(the terms with s₁ c₁ cancel):"
    )
    assert second == (
        "𝐑₂ᵀ 𝛚₂ = ((𝐑₀^w)ᵀ 𝐑₂)ᵀ ((𝐑₀^w)ᵀ 𝛚₂) = [[c₁ c₂, -c₁ s₂, s₁], [s₁ c₂, -s₁ s₂, -c₁], [s₂, c₂, 0]]ᵀ"
        " [[s₁ q̇₂], [-c₁ q̇₂], [q̇₁]] = [[s₂ q̇₁], [c₂ q̇₁], [q̇₂]]"
    )
    assert lines(TILTED_BODIES, "Kw1")[0] == "Multiplied out:"  # ω lies along an axis of body 1


def test_the_numbers_that_add_up_in_a_cross_product_are_shown() -> None:
    """¼ + ¾, the squares of sin 30° and cos 30°, stand before their sum; rows without such terms do not."""
    style = solved(TILTED_BODIES).style
    _, first, _, second = (to_unicode(node, style) for node in step(TILTED_BODIES, "Jv2").working)
    *_, products, value = first.split(" = ")
    assert products == (
        "[[-√3 l_c2 (√3 s₁ c₂ - s₂)/4 - l_c2 (s₁ c₂ + √3 s₂)/4], [√3 l_c2 c₁ c₂/2], [l_c2 c₁ c₂/2]]"
    )
    assert value == "½ l_c2 [[-2s₁ c₂], [√3 c₁ c₂], [c₁ c₂]]"
    assert "[[l_c2 c₁ (√3 s₁ c₂ - s₂)/4 - √3 l_c2 c₁ (s₁ c₂ + √3 s₂)/4], [" in second


def working(problem: str, name: str) -> list[str]:
    """The formulas of a step with the robot's matrices put in."""
    return [to_unicode(node, solved(problem).style) for node in step(problem, name).working]


def test_a_difference_that_is_more_than_terms_left_out_stands_before_its_product() -> None:
    """Where two axes meet in one origin it is worked out once."""
    first, _, second, _ = (each.split(" = ")[:2] for each in working(TILTED_BODIES, "Jv2"))
    assert first[0] == "𝐫_c2 - 𝐨₁" and "] - [" in first[1]
    assert second == ["𝐫_c2 - 𝐨₂", "𝐫_c2 - 𝐨₁"]
    assert [each.split(" = ")[0] for each in working("elbow-3r", "Jv3")] == [
        "𝐳₁ × (𝐫_c3 - 𝐨₁)",  # L₁ is left out
        "𝐫_c3 - 𝐨₂",
        "𝐳₂ × (𝐫_c3 - 𝐨₂)",
    ]


@pytest.mark.parametrize("problem", [TILTED, TILTED_BODIES])
def test_every_line_of_a_leaning_arm_is_true(problem: str) -> None:
    assert_true(solved(problem))


@pytest.mark.parametrize(
    ("base", "is_told"),
    [("Rx(30deg)", True), ("Rz(30deg)", False), ("{move: [0, 0, h]}", False)],
)
def test_what_a_turned_base_changes_is_told_where_it_is_turned_against_gravity(
    base: str, is_told: bool
) -> None:
    """The kinetic energy of a leaning arm is that of the upright one (a rotation keeps lengths)."""
    leaning = TILTED.replace("Rx(30deg)", base)
    told = [said(note, leaning) for note in step(leaning, "H0").notes]
    assert (
        any(
            note.startswith("In the results, how the base is turned matters to the potential energy")
            for note in told
        )
        is is_told
    )
    upright = TILTED.replace("base: Rx(30deg)", "base: {move: [0, 0, 0]}")
    for name in ("K", "D", "C"):
        assert step(leaning, name).result == step(upright, name).result


def test_squares_of_sums_of_lengths_are_multiplied_out_by_the_rates() -> None:
    """One operation a line: squares, products of rates, and then the brackets one by one."""
    assert lines("puma560-first3", "Kv2")[-3:] == [
        "Multiplied out, and sorted by the products of the rates:",
        "K_v2 = ½ m₂ (((z₂ c₂)² + (z₂ s₂)² + (y₂ s₂ - (a₂ + x₂) c₂)²) θ̇₁² "
        "- 2(y₂ z₂ c₂ + z₂ (a₂ + x₂) s₂) θ̇₁ θ̇₂ + (y₂² + (a₂ + x₂)²) θ̇₂²)",
        "With s₂² + c₂² = 1, and collected:",
    ]
    assert lines("puma560-first3", "Kv3")[-1] == (
        "Multiplied out, with s₂₃² + c₂₃² = 1, s₃² + c₃² = 1 and the sine of a difference, "
        "s₂₃ c₃ - c₂₃ s₃ = s₂, and collected:"
    )


def test_the_product_of_two_rows_names_the_sums_of_angles() -> None:
    assert lines("planar-2r", "H2") == [
        "With the cosine of a sum, c₁ c₂ - s₁ s₂ = c₁₂ and the sine of a sum, s₁ c₂ + c₁ s₂ = s₁₂:"
    ]
    assert not lines("in3140-rp", "H2") and not lines("stanford-6", "H2")


def test_the_identity_of_a_turned_tensor_and_of_a_lever_is_named() -> None:
    assert lines("crustcrawler-2r", "I1") == lines("elbow-3r", "J2") == ["With s₁² + c₁² = 1:"]
    assert lines("planar-2r", "I1") == []
    axis_and_lever = to_unicode(step("elbow-3r", "J2").working[0], solved("elbow-3r").style)
    assert axis_and_lever.endswith(
        " = [[-c₁ (L₂ s₂ + L₃ s₂₃)], [-s₁ (L₂ s₂ + L₃ s₂₃)], [(L₂ c₂ + L₃ c₂₃)(s₁² + c₁²)]]"
    )


def test_the_products_that_make_up_the_inertia_matrix_are_shown() -> None:
    """Spong, Hutchinson, Vidyasagar, 7.2.2: m J_vᵀ J_v and J_ωᵀ 𝓘 J_ω, along the shorter axes."""
    part, style = step("elbow-3r", "D_direct3"), solved("elbow-3r").style
    (linear,) = (to_unicode(node, style) for node in part.working)
    assert linear.startswith("m₃ 𝐉_v3ᵀ 𝐉_v3 = m₃ [[")
    along, turned, put_in, angular, concluding = lines("elbow-3r", "Dw3")
    assert along == "Along the body's own axes, with s₁² + c₁² = 1 (the terms with s₁ c₁ cancel):"
    assert turned.endswith(" = [[s₂₃, 0, 0], [c₂₃, 0, 0], [0, 1, 1]]")
    assert put_in == "The tensor along the body's own axes put in:"
    in_letters, product = "𝐉_ω3ᵀ 𝓘₃ 𝐉_ω3 = (𝐑₃ᵀ 𝐉_ω3)ᵀ 𝐈₃ (𝐑₃ᵀ 𝐉_ω3)", "[[s₂₃, 0, 0], [c₂₃, 0, 0], [0, 1, 1]]"
    assert angular.startswith(f"{in_letters} = {product}ᵀ [[I_3xx, ")
    assert concluding == "Multiplied out:"
    assert part.uses == ("Jv3#1",)
    assert [line.uses for line in step("elbow-3r", "Dw3").lines] == [("Jv3#2", "R3"), ("I_body3",)]


def test_the_columns_of_a_jacobian_are_multiplied_by_one_identity_after_the_other() -> None:
    """s₁² + c₁² = 1 leaves products without θ₁; these are multiplied out; then come the other identities."""
    first, *entries = lines("elbow-3r", "D_direct3")[:5]
    assert first == (
        "With s₁² + c₁² = 1 (the terms with s₁ c₁ cancel), entry by entry, then multiplied out "
        "(the matrix is symmetric, all other entries are 0):"
    )
    assert entries == [
        "(𝐉_v3ᵀ 𝐉_v3)₁₁ = (L₂ c₂ + l_c3 c₂₃)²",
        "(𝐉_v3ᵀ 𝐉_v3)₂₂ = (L₂ s₂ + l_c3 s₂₃)² + (L₂ c₂ + l_c3 c₂₃)² = L₂² (s₂² + c₂²) "
        "+ l_c3² (s₂₃² + c₂₃²) + 2L₂ l_c3 (s₂ s₂₃ + c₂ c₂₃)",
        "(𝐉_v3ᵀ 𝐉_v3)₂₃ = l_c3 s₂₃ (L₂ s₂ + l_c3 s₂₃) + l_c3 c₂₃ (L₂ c₂ + l_c3 c₂₃) "
        "= l_c3² (s₂₃² + c₂₃²) + L₂ l_c3 (s₂ s₂₃ + c₂ c₂₃)",
        "(𝐉_v3ᵀ 𝐉_v3)₃₃ = l_c3² (s₂₃² + c₂₃²)",
    ]
    assert lines("elbow-3r", "D_direct3")[-1] == (
        "By s₂² + c₂² = 1, s₂₃² + c₂₃² = 1 and the cosine of a difference, c₂ c₂₃ + s₂ s₂₃ = c₃:"
    )


def test_narrow_products_of_columns_stand_in_a_matrix_and_trivial_ones_take_no_line() -> None:
    by, matrix, concluding = lines("spherical-rrp", "D_direct3")
    assert (by, concluding) == ("With s₁² + c₁² = 1 (the terms with s₁ c₁ cancel):", "By s₂² + c₂² = 1:")
    assert "d₃² (s₂² + c₂²), d₃ s₂ c₂ - d₃ s₂ c₂" in matrix
    assert lines("planar-2r", "D_direct1")[-1] == "Multiplied out, with s₁² + c₁² = 1:"
    assert "𝐉_v1" not in "".join(lines("planar-2r", "D_direct1"))


def test_a_mass_in_numbers_is_multiplied_last() -> None:
    by, first, *_, concluding = lines("numeric-2r", "D_directp")
    assert by.startswith("The columns multiplied with each other, entry by entry")
    assert first == (
        "(m_p 𝐉_vpᵀ 𝐉_vp)₁₁ = 0.75 (0.25 (s₁² + c₁²) + 0.16 (s₁₂² + c₁₂²) + 0.4 (s₁ s₁₂ + c₁ c₁₂))"
    )
    assert concluding.endswith("c₁ c₁₂ + s₁ s₁₂ = c₂, and the numbers multiplied:")


def test_identities_of_cross_products_and_of_sums_of_energies_are_named() -> None:
    box = "box-cylinder-rod-sphere"
    assert lines(box, "Jv2") == ["With s₁² + c₁² = 1:"]
    assert lines(box, "K")[::2] == ["", "Collected:"]  # s₂² is gone since the energy of body 2
    assert lines("planar-2r", "Jv2") == []


def test_an_identity_leads_to_one_kind_of_square() -> None:
    """(l₂² + b²) c₂² + 2b² s₂² as what one substitution makes of it: c₂² alone, as beside l₂²."""
    box = "box-cylinder-rod-sphere"
    *_, concluding = lines(box, "Kw2")
    result = to_unicode(solved(box).forms("Kw2"), solved(box).style)
    assert concluding == "By s₂² + c₂² = 1:"
    assert result == "(1/24) m₂ ((2b² + (l₂² - b²) c₂²) θ̇₁² + (l₂² + b²) θ̇₂²)"


def test_a_fraction_that_the_columns_share_stays_in_front_of_their_products() -> None:
    _, matrix, _ = lines("crustcrawler-2r", "D_direct2")
    assert matrix == "m₂ 𝐉_v2ᵀ 𝐉_v2 = ¼ m₂ L₂² [[c₂², 0], [0, s₂² + c₂²]]"


def test_a_square_of_rates_is_opened_after_it_is_added() -> None:
    _, plain, concluding = lines("planar-2r", "K2")
    assert plain.endswith(" + ½ I₂ (q̇₁ + q̇₂)²")
    assert concluding == "The square (q̇₁ + q̇₂)² multiplied out, and collected:"


def test_a_cross_product_before_its_identity_has_the_roots_of_a_leaning_base() -> None:
    """z × (o₂ - o) with √3² = 3 put in, and s₁² + c₁² not yet 1: the same value as its column of J_v."""
    solution = solved(TILTED)
    shown = [node for found in solution.steps for node in found.working if isinstance(node, Relation)]
    values = [node.parts[-1] for node in shown if isinstance(node.parts[0], Cross)]
    state = {name: 0.3 + 0.2 * place for place, name in enumerate(("q1", "q2", "l1", "l2", "m", "g"))}
    columns = list(zip(*evaluate(solution.forms("J"), state)[:3], strict=True))
    assert any("√3" in to_unicode(value) for value in values)
    for value in values:
        column = tuple(row[0] for row in evaluate(value, state))
        assert any(column == pytest.approx(other) for other in columns)


def test_squares_of_an_angle_with_a_constant_are_added_as_they_stand() -> None:
    problem = """
dh: [{theta: phi*, a: l}]
masses:
  - {mass: m1, link: 1, center: {near: [e*cos(beta), -e*sin(beta), 0]}, inertia: {zz: J}}
"""
    assert lines(problem, "Kv1") == ["By sin²(φ - β) + cos²(φ - β) = 1:"]


TURNING = """
gravity: none
dh: [{theta: q1*, a: l1}]
masses: [{mass: m, link: 1}]
find: [D]
"""


def test_one_term_is_not_sorted() -> None:
    assert not any("sorted" in text or "collected" in text for text in lines(TURNING, "Kv1"))
    assert any("collected" in text for text in lines("planar-2r", "Kv2"))


def test_the_squares_of_a_velocity_stand_in_the_order_of_its_energy() -> None:
    """Of q̇₂ along x and q̇₁ along y, not m (q̇₂² + q̇₁²) and then the same in the other order."""
    found = step("cartesian-pp", "Kv2")
    assert list(map(to_unicode, found.working)) == list(map(to_unicode, found.result))
