"""Steps: all there, in order, and every sentence true of the robot at hand."""

from __future__ import annotations

import pytest

from dynsolve.document import Prose
from dynsolve.explain.step import Detail, Step
from dynsolve.notation.unicode import to_unicode
from dynsolve.quantities.stages import COURSE
from tests.support import STEMS, solved

SMALL = sorted(STEMS - {"puma560", "panda-7r", "stanford-6"})


def step(problem: str, id: str) -> Step:
    (found,) = (step for step in solved(problem).steps if step.id == id)
    return found


def said(prose: Prose, problem: str) -> str:
    style = solved(problem).style
    return "".join(part if isinstance(part, str) else to_unicode(part, style) for part in prose)


def shown(problem: str, id: str) -> list[str]:
    return [to_unicode(node, solved(problem).style) for node in step(problem, id).result]


def everything_said(problem: str) -> str:
    parts = [said(text, problem) for step in solved(problem).steps for text in (step.why, *step.notes)]
    return "\n".join(parts + [step.title for step in solved(problem).steps])


@pytest.mark.parametrize("problem", SMALL)
def test_every_stage_in_the_order_of_the_course(problem: str) -> None:
    stages = dict.fromkeys(step.stage for step in solved(problem).steps)
    assert [stage for stage in stages if not stage.asked_for] == list(COURSE)


@pytest.mark.parametrize("problem", SMALL)
def test_a_step_is_named_once_and_says_why(problem: str) -> None:
    steps = solved(problem).steps
    assert len({step.id for step in steps}) == len(steps)
    for each in steps:
        assert each.title and each.source
        assert said(each.why, problem).strip().endswith((".", ":")), each.id


@pytest.mark.parametrize("problem", SMALL)
def test_every_quantity_of_the_course_has_its_step(problem: str) -> None:
    robot = solved(problem).robot
    wanted = {"dh", "axes", "J", "P", "K", "L", "D", "D_direct", "christoffel", "C", "g", "agreement", "skew"}
    for joint in robot.joints:
        wanted |= {f"A{joint.index}", f"H{joint.index}"}
    for q in robot.coordinates:
        wanted |= {f"{name}{q.index}" for name in ("J", "dLdqd", "ddt", "dLdq", "tau")}
    for body in robot.bodies:
        wanted |= {f"{name}{body.name}" for name in ("rc", "P", "Jv", "v", "Kv", "Kw", "K", "I")}
        wanted |= set() if body.is_point else {f"I_body{body.name}", f"R{body.name}"}
    assert wanted <= {step.id for step in solved(problem).steps}


def test_the_course_s_manipulator_comes_out_right_where_its_document_slips() -> None:
    """IN3140 dynamics overview: (22) has cos 2θ_1 for 1, (37) and (41) drop I_1zz and m_2."""
    assert shown("in3140-rp", "Kv2") == ["K_v2 = ½ m₂ (L₂² θ̇₁² + L̇₂²)"]
    assert shown("in3140-rp", "tau1") == ["τ₁ = (m₂ L₂² + I_1zz) θ̈₁ + 2m₂ L₂ θ̇₁ L̇₂"]
    assert shown("in3140-rp", "tau2") == ["f₂ = m₂ L̈₂ - m₂ L₂ θ̇₁²"]
    note, remark = step("in3140-rp", "Kv2").notes
    assert "s₁² + c₁² = 1" in said(note, "in3140-rp")
    assert "(22)" in said(remark, "in3140-rp")  # the author's, in the problem file


def test_a_row_of_the_table_is_put_into_the_general_matrix() -> None:
    working = [to_unicode(node, solved("in3140-rp").style) for node in step("in3140-rp", "A1").working]
    assert working == [
        "θ = θ₁⋆ + 90°, d = L₁, a = 0, α = 90°",
        "cos(θ₁⋆ + 90°) = -s₁, sin(θ₁⋆ + 90°) = c₁, cos(90°) = 0, sin(90°) = 1",
    ]


def test_every_christoffel_symbol_is_shown_or_named_as_zero() -> None:
    for problem in ("in3140-rp", "planar-2r", "puma560-first3"):
        each = step(problem, "christoffel")
        n = solved(problem).robot.n
        text = "\n".join(shown(problem, "christoffel")) + "".join(said(note, problem) for note in each.notes)
        lowered = str.maketrans("0123456789", "₀₁₂₃₄₅₆₇₈₉")
        for i in range(1, n + 1):
            for j in range(i, n + 1):
                for k in range(1, n + 1):
                    assert f"c{i}{j}{k}".translate(lowered) in text


def test_christoffel_symbols_by_the_slopes_that_are_not_zero() -> None:
    assert shown("planar-2r", "christoffel") == [
        "c₁₂₁ = c₂₁₁ = ½ ∂d₁₁/∂q₂ = -m₂ l₁ l_c2 s₂",
        "c₂₂₁ = ∂d₁₂/∂q₂ = -m₂ l₁ l_c2 s₂",
        "c₁₁₂ = -½ ∂d₁₁/∂q₂ = m₂ l₁ l_c2 s₂",
    ]


def test_an_arm_that_only_slides_is_not_said_to_turn() -> None:
    text = everything_said("cartesian-pp")
    assert "revolute" not in text and "an angle" not in text and "torque is" not in text
    assert "lengths (prismatic joints)" in text
    assert "𝐃 is constant, so every Christoffel symbol is zero." in text
    assert "is a length, so what drives it is a force." in text


def test_an_arm_that_only_turns_is_not_said_to_slide() -> None:
    text = everything_said("planar-2r")
    assert "prismatic" not in text and "a force." not in text


def test_the_convention_in_play_is_the_one_explained() -> None:
    assert "the axis of its own frame" in everything_said("rp-vertical")
    assert "the axis of the frame before it" not in everything_said("rp-vertical")
    assert "the axis of the frame before it" in everything_said("planar-2r")
    assert step("rp-vertical", "A").source == "Craig §3.5"


def test_a_point_mass_is_said_to_have_no_rotational_energy() -> None:
    assert "A point mass has no rotational energy." in said(step("in3140-rp", "Kw2").why, "in3140-rp")
    assert shown("in3140-rp", "Kw2") == ["K_ω2 = 0"]
    assert not {f"R{b}" for b in "2"} & {step.id for step in solved("in3140-rp").steps}


def test_columns_after_the_link_of_a_body_are_zero_and_said_to_be() -> None:
    assert "the column of q₂ is zero." in said(step("planar-2r", "Jv1").why, "planar-2r")
    assert "zero" not in said(step("planar-2r", "Jv2").why, "planar-2r")


def test_a_pitfall_is_told_once() -> None:
    told = [said(note, "planar-2r") for each in solved("planar-2r").steps for note in each.notes]
    assert sum("is not the origin" in note for note in told) == 1
    assert sum("Frame 2 is the one to take" in note for note in told) == 1


def test_a_centre_on_the_origin_is_not_said_to_be_elsewhere() -> None:
    assert not any("is not the origin" in text for text in everything_said("cartesian-pp").splitlines())
    assert "at the far end of link 2, 𝐨₂" in said(step("cartesian-pp", "rc2").why, "cartesian-pp")


COUPLED = """
dh: [{theta: q1*, a: l1}, {theta: q2* - q1*, a: l2}, {theta: q2*/2}]
gravity: none
masses: [{mass: m1, link: 3}]
"""


def test_a_coordinate_that_moves_several_joints() -> None:
    assert "moves the joints of rows 1 and 2" in said(step(COUPLED, "J1").why, COUPLED)
    (formula,) = (each.formula for each in solved(COUPLED).steps if each.id == "J2")
    assert formula is not None
    assert to_unicode(formula) == "J₂ = [[z₁ × (o₃ - o₁) + ½ (z₂ × (o₃ - o₂))], [z₁ + ½ z₂]]"
    assert "There is no gravity." in everything_said(COUPLED)


MOVED = """
base: {rotate: Rx(90deg), move: [0, 0, h]}
dh: [{theta: 30deg, d: L0}, {theta: q1*, a: l1}]
masses:
  - {mass: m1, link: 2, center: {near: [lc, 0, 0]}, inertia: {zz: I1}, about: joint}
  - {name: p, mass: mp, link: 2, center: tip}
"""


def test_a_turned_base_fixed_rows_and_a_tensor_about_the_joint() -> None:
    text = everything_said(MOVED)
    assert "above the origin of the world" in text and "above the origin of the base" not in text
    assert "Row 1 has no star: a fixed frame" in text
    assert "given, about the near end of its link" in text
    assert "Parallel axis: the tensor of body 1 about its mass centre" in text
    assert to_unicode(step(MOVED, "H2").result[0]).startswith("H₂^w = ")


def test_no_parallel_axis_where_the_point_is_the_centre() -> None:
    body = "{mass: m1, link: 1, center: tip, inertia: {zz: I1}, about: origin}"
    text = f"dh: [{{theta: q1*, a: l1}}]\nmasses: [{body}]\n"
    assert "Parallel axis" not in everything_said(text)
    assert "given, about the mass centre" in everything_said(text)


def test_a_tensor_is_not_called_like_its_entry() -> None:
    assert shown("planar-2r", "I_body1")[0].startswith("𝐈₁^b = ")
    assert shown("in3140-rp", "I_body1")[0].startswith("𝐈₁ = ")


def test_a_shape_with_its_formula_and_its_letters() -> None:
    each = step("box-cylinder-rod-sphere", "I_body1")
    assert each.formula is not None
    assert to_unicode(each.formula) == "I_xx = m (3r² + l²)/12, I_yy = m r²/2, I_zz = m (3r² + l²)/12"
    assert [to_unicode(node) for node in each.working] == ["m = m₁, r = r₁, l = h"]
    assert "uniform solid cylinder" in said(each.why, "box-cylinder-rod-sphere")


def test_axes_given_from_the_base_are_held_to_the_frame_of_the_link() -> None:
    """The source gives I_zz2 about the normal of the plane, and z_2 lies along the arm."""
    assert "𝐱₂ lies along the body's y, 𝐲₂ along its z and 𝐳₂ along its x, so 𝐑₂ is not 𝐑₂⁰." in said(
        step("rp-vertical", "R2").why, "rp-vertical"
    )
    assert formula("rp-vertical", "R2") == "𝐑₂ = Rot_{z,θ1}"
    for turn, told in {"0": "They are those of frame 1.", "30deg": "They are turned in frame 1"}.items():
        axes = f"{{base: Rz(q1) Rx({turn})}}"
        body = f"{{mass: m, link: 1, center: tip, inertia: {{zz: I}}, axes: {axes}}}"
        assert told in everything_said(f"dh: [{{theta: q1*, d: L}}]\nmasses: [{body}]\n")


def test_the_axis_that_points_up_is_named() -> None:
    told = {
        "[0, -g, 0]": "𝐲₀ points up, so it is the second entry of 𝐫_c1",
        "[g, 0, 0]": "𝐱₀ points down, so it is minus the first entry of 𝐫_c1",
    }
    for gravity, words in told.items():
        text = f"gravity: {gravity}\ndh: [{{theta: q1*, a: l1}}]\nmasses: [{{mass: m, link: 1}}]\n"
        assert words in everything_said(text)


def test_a_frame_that_does_not_turn_is_said_to_be_harmless() -> None:
    body = "{mass: m, link: 1, center: tip, inertia: {zz: I}, axes: {base: Rz(0)}}"
    text = f"dh: [{{theta: q1*, d: L}}]\nmasses: [{body}]\n"
    assert "They do not turn with link 1." in everything_said(text)
    assert [warning.code for warning in solved(text).warnings] == ["axes-fixed"]


def test_without_masses_it_ends_with_the_jacobian() -> None:
    text = "dh: [{theta: q1*, a: l1}, {d: d2*}]\n"
    assert [step.id for step in solved(text).steps][-1] == "J"
    assert "Each body gets its own" not in everything_said(text)


def test_the_checks_are_shown() -> None:
    assert "exactly equal" in said(step("planar-2r", "agreement").why, "planar-2r")
    assert shown("planar-2r", "skew")[-1] == "𝐍 + 𝐍ᵀ = 𝟎"


def test_the_parts_of_d_are_summed_up() -> None:
    assert shown("planar-2r", "D_sum") == [
        "d₁₁ = m₁ l_c1² + I₁ + m₂ (l₁² + l_c2² + 2l₁ l_c2 c₂) + I₂",
        "d₁₂ = d₂₁ = m₂ (l_c2² + l₁ l_c2 c₂) + I₂",
        "d₂₂ = m₂ l_c2² + I₂",
    ]
    (whole,) = shown("in3140-rp", "D_sum")  # small matrices stand side by side
    assert whole == "𝐃 = [[I_1zz, 0], [0, 0]] + [[m₂ L₂², 0], [0, m₂]]"
    first, *_ = shown("elbow-3r", "D_sum")  # collected where it is read off
    assert first.count(" = ") == 2
    assert "D_sum" not in {each.id for each in solved("puma560-first3").steps}  # no parts are shown


def test_the_rows_of_c_qd_are_multiplied_out() -> None:
    (line,) = step("planar-2r", "agreement").lines
    style = solved("planar-2r").style
    assert [to_unicode(node, style) for node in line.formulas] == [
        "(𝐂 𝐪̇)₁ = 2c₁₂₁ q̇₁ q̇₂ + c₂₂₁ q̇₂² = -m₂ l₁ l_c2 s₂ (2q̇₁ q̇₂ + q̇₂²)",
        "(𝐂 𝐪̇)₂ = c₁₁₂ q̇₁² = m₂ l₁ l_c2 s₂ q̇₁²",
    ]
    assert not step("cartesian-pp", "agreement").lines


def test_levels_of_detail() -> None:
    levels = {each.id: each.detail for each in solved("planar-2r").steps}
    assert levels["D"] is Detail.BRIEF and levels["Kv1"] is Detail.NORMAL
    assert levels["D_direct1"] is Detail.NORMAL  # the products of short arms alone
    assert {each.id: each.detail for each in solved("scara-rrpr").steps}["D_direct1"] is Detail.FULL


def shown_working(problem: str, id: str) -> list[str]:
    return [to_unicode(node, solved(problem).style) for node in step(problem, id).working]


def formula(problem: str, id: str) -> str:
    node = step(problem, id).formula
    assert node is not None
    return to_unicode(node, solved(problem).style)


def test_the_tensor_in_base_coordinates_is_shown_where_it_is_used() -> None:
    """crustcrawler-2r turns its second body's angular velocity into that body's axes, and needs no 𝓘₂."""
    assert step("crustcrawler-2r", "I2").detail is Detail.FULL
    assert formula("crustcrawler-2r", "Kw2") == "K_ω2 = ½ 𝛚₂ᵀ 𝓘₂ 𝛚₂ = ½ (𝐑₂ᵀ 𝛚₂)ᵀ 𝐈₂ (𝐑₂ᵀ 𝛚₂)"
    assert "I2" not in (step("crustcrawler-2r", "Kw2").uses or ())
    assert (
        step("planar-2r", "I2").detail is Detail.BRIEF and formula("planar-2r", "Kw2") == "K_ω2 = ½ 𝛚₂ᵀ 𝓘₂ 𝛚₂"
    )


def test_an_axis_that_a_rotation_leaves_in_place_needs_no_product() -> None:
    line = step("rp-vertical", "Kw1").lines[0]
    assert to_unicode(line.formulas[0], solved("rp-vertical").style) == "𝐑₁ᵀ 𝛚₁ = 𝛚₁"


def test_a_tensor_is_turned_by_one_product_after_the_other() -> None:
    _, half = shown_working("elbow-3r", "I1")
    assert half.endswith("[[I_1xx c₁, I_1xx s₁, 0], [0, 0, I_1yy], [I_1zz s₁, -I_1zz c₁, 0]]"), half
    assert len(shown_working("planar-2r", "I1")) == 1  # turned about z it stays what it is


NAMED = """
gravity: [0, 0, -G]
dh: [{theta: q1*, d: h1, alpha: 90deg}, {theta: q2*, a: l}]
masses:
  - {mass: m2, link: 1, center: midpoint}
  - {mass: m1 + M, link: 2, center: {along: 1/3}}
"""


def test_a_letter_of_the_formula_is_not_another_thing_of_the_problem() -> None:
    assert formula(NAMED, "P1") == "P₁ = m₂ G η₁, P₁ = -m₂ 𝐠₀ᵀ 𝐫_c1"
    assert shown_working(NAMED, "P1")[:2] == ["𝐠₀ = [[0, 0, -G]]ᵀ", "η₁ = h₁/2"]
    assert formula(NAMED, "P2").startswith("P₂ = (m₁ + M) G η₂, ")
    assert shown_working("box-cylinder-rod-sphere", "P2")[0] == "η₂ = h + l₂ s₂/2"
    (summed,) = step(NAMED, "D_direct").further
    assert to_unicode(summed, solved(NAMED).style) == "𝐃 = m₂ 𝐉_v1ᵀ 𝐉_v1 + (m₁ + M) 𝐉_v2ᵀ 𝐉_v2"


def test_a_mass_without_a_symbol_is_called_after_its_body() -> None:
    assert formula("numeric-2r", "P1") == "P₁ = m₁ g h₁, P₁ = -m₁ 𝐠₀ᵀ 𝐫_c1"
    assert formula("numeric-2r", "Kvp") == "K_vp = ½ m_p 𝐯_pᵀ 𝐯_p"


def test_where_a_centre_comes_from() -> None:
    assert "from the near end of link 1, 𝐨₀" in said(step("planar-2r", "rc1").why, "planar-2r")
    assert shown_working("planar-2r", "rc1")[0] == (
        "𝐫_c1¹ = (𝐑₁⁰)ᵀ (𝐨₀ - 𝐨₁) + [[l_c1], [0], [0]] = [[-l₁], [0], [0]] + [[l_c1], [0], [0]]"
        " = [[l_c1 - l₁], [0], [0]]"
    )
    assert shown_working("in3140-rp", "rc1")[0] == (
        "𝐫_c1¹ = ½ (𝐑₁⁰)ᵀ (𝐨₀ - 𝐨₁) = ½ [[0], [-L₁], [0]] = [[0], [-L₁/2], [0]]"
    )


def test_numbers_that_go_in_are_named() -> None:
    assert shown_working("numeric-2r", "P2")[0] == "m₂ = 1.2, g = 9.81"
    assert shown_working("planar-2r", "P2")[0].startswith("h₂ = ")
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
    assert said(step("cartesian-pp", "C").why, "cartesian-pp").endswith("There are none here.")
    (note,) = step("planar-2r", "christoffel").notes
    assert said(note, "planar-2r") == (
        "c₁₁₁ and c₂₂₂ are zero. In c₁₂₂ the derivatives cancel, 𝐃 being symmetric."
    )
    (note,) = step("rp-vertical", "christoffel").notes
    assert said(note, "rp-vertical") == "c₁₁₁, c₂₂₁, c₁₂₂ and c₂₂₂ are zero."


ONE = "dh: [{theta: q*, a: l}]\nmasses: [{mass: m, link: 1}]\n"


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
    assert "combination of coordinates" not in text
    assert "the body belongs to the ground and does not move." in said(step(ODD, "rc1").why, ODD)
    assert "belongs to the ground" not in said(step(ODD, "rc2").why, ODD)
    assert "world coordinates" in text and "base coordinates" not in text
    assert formula(ODD, "R2") == "𝐑₂ = 𝐑₀^w Rot_{z,q₁/2}"
    assert formula(ODD, "H0") == "𝐇₀^w = Rot_{x,90°}"
    assert "frame 0 is turned." in text
    assert formula(ODD, "J2") == "𝐉₂ = [[2𝐳₃], [𝟎]]"  # J is a moment of inertia here


def test_a_body_without_mass_has_no_weight() -> None:
    assert said(step(ODD, "P2").why, ODD) == "Body 2 has inertia but no mass, so gravity does not act on it."
    assert said(step(ODD, "Kv2").why, ODD) == "The body has no mass, only inertia."
    assert not step(ODD, "P2").working and not step(ODD, "Kv2").working


def test_several_columns_that_are_zero_are_listed_as_in_a_sentence() -> None:
    why = said(step("box-cylinder-rod-sphere", "Jv1").why, "box-cylinder-rod-sphere")
    assert why.endswith("so the columns of θ₂ and d₃ are zero.")


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
        "Lynch and Park §8.2.1",
    ]


def test_what_the_parallel_axis_theorem_takes_away() -> None:
    assert shown_working(MOVED, "I_body1")[1].endswith("= [[0, 0, 0], [0, m₁ l_c², 0], [0, 0, m₁ l_c²]]")


def test_a_long_list_of_zeros_is_not_printed() -> None:
    (note,) = step("scara-rrpr", "christoffel").notes
    assert said(note, "scara-rrpr") == "All the others are zero."


def test_what_agrees_is_said_in_a_sentence() -> None:
    assert said(step("planar-2r", "agreement").why, "planar-2r") == (
        "𝐃, 𝐂 𝐪̇ and 𝐠, read off from the forces and assembled directly, are exactly equal."
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
    assert "comes after the mass" not in text and "before the mass" not in text
    assert "Frame 1 is the one to take: in the modified convention it is fixed in link 1" in text
    assert "frame 2 moves with the next link." in text
    assert "from 𝐨₁, half the way on" in said(step(CRAIG, "rc1").why, CRAIG)


def test_a_frame_comes_after_the_mass_where_the_mass_is_on_the_link() -> None:
    assert "comes after the mass" in said(step("planar-2r", "R2").why, "planar-2r")
    assert "comes after the mass" not in said(step("spherical-rrp", "R2").why, "spherical-rrp")


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
