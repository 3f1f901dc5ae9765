"""How the steps get to their results: what is put in, and what comes out."""

from __future__ import annotations

import re

import pytest

from dynsolve.explain.step import Detail
from dynsolve.notation.unicode import to_unicode
from dynsolve.problem.reader import find
from dynsolve.render.files import Format
from dynsolve.solution.reports import report
from tests.support import solved
from tests.unit.explain.told import everything_said, formula, said, shown, shown_working, step


def test_the_tensor_in_base_coordinates_is_shown_where_it_is_used() -> None:
    """crustcrawler-2r turns its second body's angular velocity into that body's axes, and needs no 𝓘₂."""
    assert step("crustcrawler-2r", "I2").detail is Detail.FULL
    assert formula("crustcrawler-2r", "Kw2") == "K_ω2 = ½ 𝛚₂ᵀ 𝓘₂ 𝛚₂ = ½ (𝐑₂ᵀ 𝛚₂)ᵀ 𝐈₂ (𝐑₂ᵀ 𝛚₂)"
    assert "I2" not in (step("crustcrawler-2r", "Kw2").uses or ())
    assert step("box-cylinder-rod-sphere", "I4").detail < Detail.FULL, "a sphere keeps its tensor"


def test_of_a_body_that_turns_about_one_of_its_axes_one_moment_enters() -> None:
    """Whichever way the axis lies, and whatever the tensor is: no product of matrices is needed."""
    link = "base: {base}\ndh: [{{theta: q1*, a: l, alpha: {alpha}}}]\nmasses: [{body}]"
    for alpha, base, moments, axis in (
        ("180deg", "Rz(0)", "{zz: J}", "zz"),
        ("0", "Rx(90deg)", "{zz: J}", "zz"),
        ("0", "Rx(60deg)", "{xx: A, yy: B, zz: J, xz: E}", "zz"),
        ("90deg", "Rz(0)", "{xx: A, yy: J, zz: C}", "yy"),
    ):
        body = f"{{mass: m, link: 1, center: tip, inertia: {moments}}}"
        problem = link.format(alpha=alpha, base=base, body=body)
        assert formula(problem, "Kw1") == f"K_ω1 = ½ (𝐈₁)_{axis} 𝛚₁ᵀ 𝛚₁"
        assert said(step(problem, "Kw1").why, problem).startswith(
            f"𝛚₁ is parallel to {'𝐳𝐲'[axis == 'yy']}₁, so"
        )
        assert shown(problem, "Kw1") == ["K_ω1 = ½ J q̇₁²"]
        assert "𝓘" not in report(solved(problem), Format.TEXT).decode()
    assert formula("elbow-3r", "Kw2").startswith("K_ω2 = ½ 𝛚₂ᵀ 𝓘₂ 𝛚₂"), "two joints across each other"


def test_a_tensor_is_turned_by_one_product_after_the_other() -> None:
    _, half = shown_working("elbow-3r", "I1")
    assert half.endswith("[[I_1xx c₁, I_1xx s₁, 0], [0, 0, I_1yy], [I_1zz s₁, -I_1zz c₁, 0]]"), half


NAMED = """
gravity: [0, 0, -G]
dh: [{theta: q1*, d: h1, alpha: 90deg}, {theta: q2*, a: l}]
masses:
  - {mass: m2, link: 1, center: midpoint}
  - {mass: m1 + M, link: 2, center: {along: 1/3}}
"""


def test_a_letter_of_the_formula_is_not_another_thing_of_the_problem() -> None:
    assert formula(NAMED, "P1") == "P₁ = -m₂ 𝐠₀ᵀ 𝐫_c1 = m₂ G η₁"
    assert shown_working(NAMED, "P1") == ["η₁ = h₁/2"]
    assert formula(NAMED, "P2").endswith(" = (m₁ + M) G η₂")
    assert shown_working("box-cylinder-rod-sphere", "P2")[0] == "η₂ = h + l₂ s₂/2"
    (summed,) = step(NAMED, "D_direct").further
    assert to_unicode(summed, solved(NAMED).style) == "𝐃 = m₂ 𝐉_v1ᵀ 𝐉_v1 + (m₁ + M) 𝐉_v2ᵀ 𝐉_v2"


def test_a_mass_without_a_symbol_is_called_after_its_body() -> None:
    assert formula("numeric-2r", "P1") == "P₁ = -m₁ 𝐠₀ᵀ 𝐫_c1 = m₁ g η₁"
    assert formula("numeric-2r", "Kvp") == "K_vp = ½ m_p 𝐯_pᵀ 𝐯_p"


def lines(problem: str, id: str) -> list[str]:
    """The lines of a step, each with what leads to it."""
    found, style = step(problem, id), solved(problem).style
    return [
        text
        for line in found.lines
        for text in (said(line.by, problem), *(to_unicode(each, style) for each in line.formulas))
        if text
    ]


def test_where_a_centre_comes_from() -> None:
    assert "from the near end of link 1, 𝐨₀" in said(step("planar-2r", "rc1").why, "planar-2r")
    assert formula("planar-2r", "rc2") == "𝐫_c2 = 𝐑₂⁰ 𝐫_{1,c2}² + 𝐨₁"
    (given,) = step("planar-2r", "rc2").further
    assert to_unicode(given, solved("planar-2r").style) == "𝐫_{1,c2}² = [[l_c2], [0], [0]]"
    assert shown_working("planar-2r", "rc2") == [
        "𝐫_c2 = [[c₁₂, -s₁₂, 0], [s₁₂, c₁₂, 0], [0, 0, 1]] [[l_c2], [0], [0]] + [[l₁ c₁], [l₁ s₁], [0]]"
    ]
    assert formula("in3140-rp", "rc1") == "𝐫_c1 = ½ (𝐨₀ + 𝐨₁)"
    assert shown_working("in3140-rp", "rc1") == ["𝐫_c1 = ½ ([[0], [0], [0]] + [[0], [0], [L₁]])"]
    text = report(solved("planar-2r"), Format.MARKDOWN, detail=Detail.FULL).decode()
    mass_center = text[text.index("### 3.1 ") : text.index("### 3.2 ")]
    assert re.search(r"With \(\d+\) and \(\d+\):", mass_center), "H₁⁰ and o₀"


def test_a_cross_product_is_worked_out_before_an_identity_is_used() -> None:
    lever = "[[s₁], [-c₁], [0]] × [[d₃ c₁ c₂], [d₃ s₁ c₂], [d₃ s₂]]"
    worked_out = "[[-d₃ c₁ s₂], [-d₃ s₁ s₂], [d₃ c₂ (s₁² + c₁²)]]"
    assert shown_working("spherical-rrp", "J2") == [f"𝐳₁ × (𝐨₃ - 𝐨₁) = {lever} = {worked_out}"]
    assert shown_working("spherical-rrp", "Jv2")[0].endswith("[-l_c2 s₁ s₂], [l_c2 c₂ (s₁² + c₁²)]]")
    assert shown_working("numeric-2r", "Jv2") == [  # about an axis of the base, but through a moving point
        "𝐳₁ × (𝐫_c2 - 𝐨₁) = [[0], [0], [1]] × [[0.15 c₁₂], [0.15 s₁₂], [0]] = [[-0.15 s₁₂], [0.15 c₁₂], [0]]"
    ]
    assert not shown_working("numeric-2r", "Jv1"), "two coordinates change places"


def test_numbers_that_go_in_are_named() -> None:
    assert shown_working("numeric-2r", "P2")[0] == "η₂ = 0.5 s₁ + 0.15 s₁₂"
    assert shown_working("planar-2r", "P2")[0].startswith("η₂ = ")
    assert "the bodies 1, 2 and p, counted in this order" in said(
        step("numeric-2r", "D_direct").why, "numeric-2r"
    )
    assert "is ⅓ of the way along link 2, from 𝐨₁ to 𝐨₂." in said(step(NAMED, "rc2").why, NAMED)
    assert "given by its coordinates in frame 1" in said(step("rp-vertical", "rc1").why, "rp-vertical")


def test_c_and_g_are_read_off_too() -> None:
    assert shown("in3140-rp", "Cqd") == ["𝐂 𝐪̇ = [[2m₂ L₂ θ̇₁ L̇₂], [-m₂ L₂ θ̇₁²]]", "𝐠 = [[0], [0]]"]
    assert "No term remains at rest here." in said(step("in3140-rp", "Cqd").why, "in3140-rp")
    assert "Nothing remains" not in said(step("planar-2r", "Cqd").why, "planar-2r")
    assert "No term has rates here." in said(step("cartesian-pp", "Cqd").why, "cartesian-pp")


def test_a_constant_d_has_no_list_of_zeros_and_no_other_c() -> None:
    assert step("cartesian-pp", "christoffel").notes == step("cartesian-pp", "C").notes == ()
    assert shown("cartesian-pp", "C") == ["𝐂 = 𝟎"]
    normal, full = (
        report(solved("cartesian-pp"), Format.TEXT, detail=detail).decode()
        for detail in (Detail.NORMAL, Detail.FULL)
    )
    assert normal.count("zero.") == full.count("so every Christoffel symbol is zero.") == 1
    assert "cᵢⱼₖ = ½" in full and "cᵢⱼₖ" not in normal
    assert "With the matrices of the arm and 𝐂 = 𝟎:" in normal
    weightless = solved(find("cartesian-pp").read_text().replace("[0, 0, -g]", "none"))
    assert "With the matrices of the arm, 𝐂 = 𝟎 and 𝐠 = 𝟎:" in report(weightless, Format.TEXT).decode()
    (note,) = step("planar-2r", "christoffel").notes
    assert said(note, "planar-2r") == "c₁₁₁ and c₂₂₂ are zero."
    (note,) = step("rp-vertical", "christoffel").notes
    assert said(note, "rp-vertical") == "c₁₁₁, c₂₂₁, c₁₂₂ and c₂₂₂ are zero."


DRUM = """
gravity: [0, -g, 0]
model:
  coordinates: {x: prismatic}
  bodies:
    - {mass: m, at: [0, -x, 0]}
    - {mass: 0, at: [0, 0, 0], turn: x/r, inertia: {zz: I1}}
"""


def test_a_disk_whose_axis_stands_still_needs_no_rotation_matrix() -> None:
    normal, full = (
        report(solved(DRUM), Format.TEXT, detail=detail).decode() for detail in (Detail.NORMAL, Detail.FULL)
    )
    assert "K_ω2 = ½ (𝐈₂^b)_zz 𝛚₂ᵀ 𝛚₂ = ½ I₁ " in normal
    assert "cos(x/r)" not in normal and "𝓘" not in normal
    assert "𝓘₂ = 𝐑₂ 𝐈₂^b 𝐑₂ᵀ" in full and "cos(x/r)" in full


ONE = "dh: [{theta: q*, a: l}]\nmasses: [{mass: m, link: 1}]\n"


def test_of_one_coordinate_there_is_one_equation() -> None:
    asked = f"gravity: [0, -g, 0]\n{ONE}find: [tau, D, C, g, qdd_forward]\n"
    summary = report(solved(asked), Format.TEXT).decode().split("Summary")[1]
    assert "[" not in summary and "τ₁ = m l² q̈ + m g l cos(q)\n" in summary
    assert shown(asked, "qdd_forward") == ["q̈ = (τ₁ - m g l cos(q))/(m l²)"]
    assert "𝐃 = [m l²]" in report(solved(asked), Format.TEXT, detail=Detail.RESULTS).decode()


def test_a_single_joint_has_no_other_rates() -> None:
    assert said(step(ONE, "dLdqd1").why, ONE).endswith("alone: the coordinate is held fixed.")
    text = everything_said(ONE)
    assert "other rates" not in text and "Coriolis terms" not in text and "may be swapped" not in text


ODD = """
base: Rx(90deg)
dh:
  - {d: h0}
  - {theta: q1*/2, a: l1}
  - {a: l2}
  - {theta: 0, d: 2*s1*}
masses:
  - {mass: mg, link: 1, center: midpoint}
  - {mass: 0, link: 3, center: tip, inertia: {zz: J}, axes: {base: Rz(q1/2)}}
  - {mass: m1, link: 4, center: tip}
"""


def test_fixed_rows_scaled_joints_and_the_world() -> None:
    text = everything_said(ODD)
    assert "Rows 1 and 3 have no star: frames that are each fixed" in text
    assert "The joint of row 2 moves at ½ times the rate of q₁." in text
    fingers = everything_said("dh: [{theta: q1*}, {from: 0, theta: -q1*, a: l}, {from: 0, theta: -2*q1*}]\n")
    assert "The joint of row 2 moves the other way as fast as q₁." in fingers
    assert "The joint of row 3 moves the other way at 2 times the rate of q₁." in fingers
    assert "leads from the frame in the column “from” to frame i" in fingers and "`" not in fingers
    assert "combination of coordinates" not in text
    assert "the body belongs to the ground and does not move." in said(step(ODD, "rc1").why, ODD)
    assert "belongs to the ground" not in said(step(ODD, "rc2").why, ODD)
    assert "world coordinates" in text and "base coordinates" not in text
    assert formula(ODD, "R2") == "𝐑₂ = 𝐑₀^w 𝐑_{z,q₁/2}"
    assert formula(ODD, "H0") == "𝐇₀^w = Rot_{x,90°}"
    assert "Frame 0 is turned in the world w" in text
    assert formula(ODD, "J2") == "𝐉₂ = [[2𝐳₃], [𝟎]]"  # J is a moment of inertia here


def test_a_body_without_mass_has_no_weight() -> None:
    assert said(step(ODD, "P2").why, ODD) == "Body 2 has inertia but no mass, so gravity does not act on it."
    assert said(step(ODD, "Kv2").why, ODD) == "The body has no mass, only inertia."
    assert not step(ODD, "P2").working and not step(ODD, "Kv2").working


def test_several_joints_that_do_not_move_a_body_are_listed_as_in_a_sentence() -> None:
    why = said(step("box-cylinder-rod-sphere", "Jv1").why, "box-cylinder-rod-sphere")
    assert "; θ₂ and d₃ do not move it." in why
    assert why.endswith("𝐫_c1 - 𝐨₀ is parallel to 𝐳₀, so their cross product is zero.")


def test_a_shared_column_is_worked_out() -> None:
    (working,) = shown_working("planar-2r-remote", "J1")
    assert working.startswith("𝐳₀ × (𝐨₂ - 𝐨₀) - 𝐳₁ × (𝐨₂ - 𝐨₁) = ") and working.endswith(
        "[[-l₁ s₁], [l₁ c₁], [0]]"
    )


def test_the_moments_of_a_shape_stand_where_they_are_said_to() -> None:
    sources = [step("box-cylinder-rod-sphere", f"I_body{b}").source for b in "1234"]
    assert sources == [
        "Lynch and Park §8.2.1",
        "§7.2.1",
        "by the integrals of §7.2.1",
        "from Lynch and Park §8.2.1",  # of the ellipsoid
    ]


def test_a_long_list_of_zeros_is_not_printed() -> None:
    (note,) = step("scara-rrpr", "christoffel").notes
    assert said(note, "scara-rrpr") == "All the others are zero."


def test_what_agrees_is_said_in_a_sentence() -> None:
    assert said(step("planar-2r", "agreement").concluding, "planar-2r") == (
        "Read off and assembled directly: the same 𝐃, 𝐂 𝐪̇ and 𝐠."
    )


CRAIG = """
convention: modified
dh: [{theta: q1*}, {theta: q2*, a: l1}, {theta: q3*, a: l2}]
masses:
  - {mass: m1, link: 1, center: midpoint, inertia: {zz: I1}}
  - {mass: m2, link: 2, center: midpoint, inertia: {zz: I2}}
"""


def test_frame_i_is_before_the_mass_in_the_modified_convention() -> None:
    text = everything_said(CRAIG)
    assert "Frame 1 is the one to take: in the modified convention it is fixed in link 1" in text
    assert "frame 2 moves with the next link." in text
    assert "half-way along link 1, between 𝐨₁ and 𝐨₂" in said(step(CRAIG, "rc1").why, CRAIG)


TENSORS = [
    (
        "elbow-3r",
        "3",
        "along the axes of frame 3. They are principal axes: there are no products of inertia.",
    ),
    ("rp-vertical", "2", "along its own axes. They are principal axes: there are no products of inertia."),
    ("crustcrawler-2r", "1", "a uniform solid cylinder, its own axis along 𝐲₁. Its principal moments"),
]


@pytest.mark.parametrize(("problem", "body", "told"), TENSORS)
def test_a_tensor_is_said_to_be_along_the_axes_it_is_given_for(problem: str, body: str, told: str) -> None:
    """A body whose axes are not those of its link's frame is not said to be as one where they are."""
    assert told in said(step(problem, f"I_body{body}").why, problem)


def test_why_matrices_stand_in_their_order_is_said_once() -> None:
    """With the first product, of three joints; with the last frame where no other is shown."""
    assert everything_said("elbow-3r").count("so it multiplies from the right") == 1
    assert "so it multiplies from the right" in said(step("planar-2r", "H2").why, "planar-2r")


def test_a_table_without_a_row_for_the_tool_does_not_reach_the_end_of_the_arm() -> None:
    """In the modified convention the last frame lies in the last joint, unless a fixed row follows."""
    assert "the end of the arm" not in everything_said(CRAIG).replace(
        "the end of the arm would need a row", ""
    )
    assert "The Jacobian of the origin of frame 3" in everything_said(CRAIG)
    with_tool = CRAIG.replace("{theta: q3*, a: l2}]", "{theta: q3*, a: l2}, {a: l3}]")
    assert "The Jacobian of the end of the arm" in everything_said(with_tool)
    assert "The Jacobian of the end of the arm" in everything_said("planar-2r")


def test_a_coordinate_that_joints_share_has_a_force_of_several_joints() -> None:
    """p₁ and p₂ are absolute angles; joint 2 turns by p₂ - p₁, so τ₁ q̇₁ + τ₂ q̇₂ = τ₁ ṗ₁ + τ₂ (ṗ₂ - ṗ₁)."""
    why = said(step("planar-2r-remote", "tau1").why, "planar-2r-remote")
    assert why.endswith("its torque is the torque of joint 1 minus the torque of joint 2.")
    why = said(step("planar-2r-remote", "tau2").why, "planar-2r-remote")
    assert why.endswith("its torque is the torque of joint 2.")
    assert (
        said(step("planar-2r", "tau1").why, "planar-2r") == "q₁ is an angle, so what drives it is a torque."
    )


def test_one_polynomial_has_one_spelling_with_either_sign() -> None:
    """c₁₂₁ = -c₁₁₂ of a rod on a sliding joint: the square of the distance is completed in both."""
    shown_symbols = shown("box-cylinder-rod-sphere", "christoffel")
    with_square = [
        text for text in shown_symbols if "(m₂ (4l₂² - b²)/12 + m₃ ((d₃ - l₃/2)² + l₃²/12)" in text
    ]
    assert [text.split(" ")[0] for text in with_square] == ["c₁₂₁", "c₁₁₂"]


def test_axes_of_frame_0_at_rest_are_worked_out() -> None:
    assert shown_working("spherical-rrp", "R1") == [
        "𝐑₁ = [[c₁, 0, s₁], [s₁, 0, -c₁], [0, 1, 0]] [[1, 0, 0], [0, 0, -1], [0, 1, 0]]ᵀ"
    ]


TWO_ARMS = """
gravity: none
dh: [{theta: a*, a: l}, {from: 0, theta: b*, a: k}]
masses: [{mass: m, link: 1}, {mass: M, link: 2}]
"""

ENDS_ON_ITS_AXIS = """
dh: [{theta: q1*, d: l1}]
masses: [{mass: m, link: 1, center: [lc, 0, 0]}]
"""


@pytest.mark.parametrize(("problem", "told"), [
    ("box-cylinder-rod-sphere", {"axes": "𝐳₀ × (u₁, u₂, u₃)ᵀ = (-u₂, u₁, 0)ᵀ"}),
    ("rp-vertical", {"axes": "𝐳₁ × (u₁, u₂, u₃)ᵀ = (-u₂, u₁, 0)ᵀ"}),
    (TWO_ARMS, {"axes": "𝐳₀ × (u₁, u₂, u₃)ᵀ = (-u₂, u₁, 0)ᵀ"}),
    (ENDS_ON_ITS_AXIS, {"Jv1": "𝐳₀ × (u₁, u₂, u₃)ᵀ = (-u₂, u₁, 0)ᵀ"}),
])  # fmt: skip
def test_how_a_product_with_an_axis_of_the_base_is_read_off_is_said_once(
    problem: str, told: dict[str, str]
) -> None:
    """Where the axes are told if a column of the end needs it, else for a mass centre."""
    steps = [each for each in solved(problem).steps if each.id.startswith(("J", "axes"))]
    said_of = {each.id: said((*each.why, *each.concluding), problem) for each in steps}
    found = {name: text for name, text in said_of.items() if "for any vector" in text}
    assert found.keys() == told.keys()
    assert all(formula in found[name] for name, formula in told.items())


def test_what_does_not_move_is_not_multiplied_by_the_rates() -> None:
    box = "box-cylinder-rod-sphere"
    assert not step(box, "v1").working and step(box, "v2").working


def test_what_the_moments_share_stands_before_the_tensor() -> None:
    box = "box-cylinder-rod-sphere"
    ((put_in,), (multiplied,)) = (line.formulas for line in step(box, "Kw3").lines[1:])
    style = solved(box).style
    assert to_unicode(put_in, style).startswith("K_ω3 = ½ (1/12) m₃ l₃² [[c₂ θ̇₁, θ̇₂, s₂ θ̇₁]] [[1, 0, 0]")
    assert to_unicode(multiplied, style) == "K_ω3 = ½ (1/12) m₃ l₃² ((c₂ θ̇₁)² + θ̇₂²)"


GANTRY = """
model:
  coordinates: {x: prismatic, y: prismatic, u: revolute}
  bodies:
    - {mass: M1, at: [x, 0, 0]}
    - {mass: M2, at: [x, y, 0]}
    - {mass: m, at: [x + l*sin(u), y, -l*cos(u)]}
"""


def test_what_is_0_of_several_bodies_is_told_once() -> None:
    """Bodies that stay at the height of the origin have one line."""
    text = report(solved(GANTRY + "find: [D, C, g]\n"), Format.TEXT).decode()
    assert "P₁ = P₂ = 0" in text and "η₁" not in text and "η₃ = -l cos(u)" in text
    level = GANTRY.replace("-l*cos(u)", "0")
    assert "P₁ = M₁ g η₁" in report(solved(level), Format.TEXT).decode().replace("-M₁ 𝐠₀ᵀ 𝐫_c1 = ", "")
    assert step(level, "P2").also == ("P3",), "the first tells what gravity is"
