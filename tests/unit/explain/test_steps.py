"""Steps: all there, in order, and every sentence true of the robot at hand."""

from __future__ import annotations

import pytest

from dynsolve.explain.step import Detail
from dynsolve.notation.unicode import to_unicode
from dynsolve.quantities.stages import COURSE
from tests.support import solved
from tests.unit.explain.told import SMALL, everything_said, formula, said, shown, shown_working, step


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


@pytest.mark.parametrize(
    ("problem", "is_diagonal"), [("in3140-rp", True), ("box-cylinder-rod-sphere", True), ("planar-2r", False)]
)
def test_an_inertia_matrix_without_coupling_is_called_diagonal(problem: str, is_diagonal: bool) -> None:
    why = said(step(problem, "D").why, problem)
    assert (
        why.endswith(" Here it is diagonal: no acceleration enters the force of another coordinate.")
        is is_diagonal
    )


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
    assert wanted <= {name for each in solved(problem).steps for name in (each.id, *each.also)}


def test_a_momentum_in_decimals_is_collected_by_rates() -> None:
    """The factors of the rates are the row of D; 0.167 stands at both, and is not drawn together."""
    assert shown("numeric-2r", "dLdqd2") == ["∂ℒ/∂q̇₂ = (0.167 + 0.24 c₂) q̇₁ + 0.167 q̇₂"]


def test_the_course_s_manipulator_comes_out_right_where_its_document_slips() -> None:
    """IN3140 dynamics overview: (22) has cos 2θ_1 for 1, (37) and (41) drop I_1zz and m_2."""
    assert shown("in3140-rp", "Kv2") == ["K_v2 = ½ m₂ (L₂² θ̇₁² + L̇₂²)"]
    assert shown("in3140-rp", "tau1") == ["τ₁ = (m₂ L₂² + I_1zz) θ̈₁ + 2m₂ L₂ θ̇₁ L̇₂"]
    assert shown("in3140-rp", "tau2") == ["f₂ = m₂ L̈₂ - m₂ L₂ θ̇₁²"]
    note, remark = step("in3140-rp", "Kv2").notes
    assert said(note, "in3140-rp") == "The speed does not depend on θ₁."
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
        prose = (each.why, *each.notes)
        text = "\n".join(shown(problem, "christoffel")) + "".join(said(part, problem) for part in prose)
        lowered = str.maketrans("0123456789", "₀₁₂₃₄₅₆₇₈₉")
        for i in range(1, n + 1):
            for j in range(i, n + 1):
                for k in range(1, n + 1):
                    assert f"c{i}{j}{k}".translate(lowered) in text


def test_christoffel_symbols_by_the_slopes_that_are_not_zero() -> None:
    assert shown("planar-2r", "christoffel") == [
        "c₁₂₁ = c₂₁₁ = ½ ∂d₁₁/∂q₂ = -m₂ l₁ l_c2 s₂",
        "c₂₂₁ = ½ (∂d₁₂/∂q₂ + ∂d₁₂/∂q₂) = ∂d₁₂/∂q₂ = -m₂ l₁ l_c2 s₂",
        "c₁₁₂ = -½ ∂d₁₁/∂q₂ = m₂ l₁ l_c2 s₂",
    ]


def test_an_arm_that_only_slides_is_not_said_to_turn() -> None:
    text = everything_said("cartesian-pp")
    assert "revolute" not in text and "an angle" not in text and "torque is" not in text
    assert "lengths (prismatic joints)" in text
    assert "𝐃 is constant, so every Christoffel symbol is zero." in text
    assert "is a length, so what drives it is the force " in text


def test_an_arm_that_only_turns_is_not_said_to_slide() -> None:
    text = everything_said("planar-2r")
    assert "prismatic" not in text and "the force " not in text


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
    assert "q₂ does not move it." in said(step("planar-2r", "Jv1").why, "planar-2r")
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
    assert "The column of each coordinate" in everything_said("planar-2r-remote")


MOVED = """
base: {rotate: Rx(90deg), move: [0, 0, h]}
dh: [{theta: 30deg, d: L0}, {theta: q1*, a: l1}]
masses:
  - {mass: m1, link: 2, center: {near: [lc, 0, 0]}, inertia: {zz: I1}, about: joint}
  - {name: p, mass: mp, link: 2, center: tip}
"""


def test_joints_are_counted_without_fixed_rows() -> None:
    problem = """
gravity: [0, 0, -g]
dh: [{d: l1}, {theta: q1*, a: l2}, {theta: q2*, a: l3, alpha: 90deg}]
masses:
  - {mass: m2, link: 2, center: midpoint, inertia: {zz: I2}}
  - {mass: m3, link: 3, center: tip, inertia: {yy: I3}}
find: [D, J]
"""
    text = everything_said(problem)
    assert "of all that joint 1 moves, joint 2 held" in text
    assert "joint 3" not in text
    assert "In the standard convention the joint of row i turns about" in text


def test_a_turned_base_fixed_rows_and_a_tensor_about_the_joint() -> None:
    text = everything_said(MOVED)
    assert "above the origin of the world" in text and "above the origin of the base" not in text
    assert "Row 1 has no star: a fixed frame" in text
    assert "Of the tensor of body 1 about the near end of its link the moment" in text
    assert "Parallel axis: the moment of body 1 about its mass centre" in text
    assert to_unicode(step(MOVED, "H2").result[0]).startswith("H₂^w = ")


def test_what_the_parallel_axis_theorem_takes_away() -> None:
    assert formula(MOVED, "I_body1").endswith("(𝐈_{1,given})_zz - m₁ (𝐝ᵀ 𝐝 𝐄 - 𝐝 𝐝ᵀ)_zz")
    assert shown(MOVED, "I_body1") == ["(𝐈₁^b)_zz = I₁ - m₁ l_c²"], "what is not given takes nothing away"
    tensor = MOVED.replace("inertia: {zz: I1}", "inertia: {xx: Ix, yy: Iy, zz: I1}")
    assert shown_working(tensor, "I_body1")[1].endswith("= [[0, 0, 0], [0, m₁ l_c², 0], [0, 0, m₁ l_c²]]")


def test_no_parallel_axis_where_the_point_is_the_centre() -> None:
    body = "{mass: m1, link: 1, center: tip, inertia: {zz: I1}, about: origin}"
    text = f"dh: [{{theta: q1*, a: l1}}]\nmasses: [{body}]\n"
    assert "Parallel axis" not in everything_said(text)
    assert "Of the tensor of body 1 about its mass centre the moment" in everything_said(text)


def test_a_tensor_is_not_called_like_its_entry() -> None:
    assert shown("planar-2r", "I_body1") == ["(𝐈₁^b)_zz = I₁"]
    assert shown("elbow-3r", "I_body2")[0].startswith("𝐈₂ = ")


def test_a_shape_with_its_formula_in_its_own_letters() -> None:
    each = step("box-cylinder-rod-sphere", "I_body1")
    assert each.formula is not None
    assert to_unicode(each.formula) == "I_1xx = I_1zz = m₁ (3r₁² + h²)/12, I_1yy = m₁ r₁²/2"
    assert each.task is not None and each.working == ()
    assert to_unicode(each.task) == "I_1xx = I_1zz = m (3r² + l²)/12, I_1yy = m r²/2"  # what a hint tells
    assert "uniform solid cylinder" in said(each.why, "box-cylinder-rod-sphere")


def test_axes_given_from_the_base_are_held_to_the_frame_of_the_link() -> None:
    """The source gives I_zz2 about the normal of the plane, and z_2 lies along the arm."""
    assert "𝐱₂ lies along the body's y, 𝐲₂ along its z and 𝐳₂ along its x, so 𝐑₂ is not 𝐑₂⁰." in said(
        step("rp-vertical", "R2").why, "rp-vertical"
    )
    assert formula("rp-vertical", "R2") == "𝐑₂ = 𝐑_{z,θ1}"
    for turn, told in {"0": "They are those of frame 1.", "30deg": "They are turned in frame 1"}.items():
        axes = f"{{base: Rz(q1) Rx({turn})}}"
        body = f"{{mass: m, link: 1, center: tip, inertia: {{zz: I}}, axes: {axes}}}"
        assert told in everything_said(f"dh: [{{theta: q1*, d: L}}]\nmasses: [{body}]\n")


def test_the_axis_that_points_up_is_named() -> None:
    told = {
        "[0, -g, 0]": "𝐲₀ points up, so η₁, the height above the origin of the base, is the second entry",
        "[g, 0, 0]": "𝐱₀ points down, so η₁, the height above the origin of the base, is minus the first",
    }
    for gravity, words in told.items():
        text = f"gravity: {gravity}\ndh: [{{theta: q1*, a: l1}}]\nmasses: [{{mass: m, link: 1}}]\n"
        assert words in everything_said(text)


def test_of_a_given_tensor_it_is_said_what_does_not_enter() -> None:
    why = said(step("planar-2r", "I_body1").why, "planar-2r")
    assert why == (
        "Of the tensor of body 1 about its mass centre the moment about the axis parallel to 𝐳₁ is given. "
        "The angular velocity is parallel to that axis, so nothing else enters the energy, and the other "
        "entries are taken as 0. The superscript b is for the body's own axes."
    )
    assert "angular velocity" not in said(
        step("elbow-3r", "I_body2").why, "elbow-3r"
    )  # about all of its axes
    assert "turns about" not in said(step("rp-vertical", "I_body1").why, "rp-vertical")  # all are given


def test_a_multiple_of_the_identity_is_not_turned_by_its_entries() -> None:
    """Of a sphere R is not needed at all."""
    box = "box-cylinder-rod-sphere"
    assert shown_working(box, "I4") == ["𝓘₄ = (2/5) m₄ r₄² 𝐑₄ 𝐑₄ᵀ"]
    assert step(box, "R4").detail is Detail.FULL
    ((energy,),) = (line.formulas for line in step(box, "Kw4").lines)
    assert to_unicode(energy, solved(box).style) == ("K_ω4 = ½ (2/5) m₄ r₄² ((s₁ θ̇₂)² + (c₁ θ̇₂)² + θ̇₁²)")
    assert "𝐑₄" not in "".join(shown_working(box, "D_direct4"))


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
    assert said(step("planar-2r", "agreement").concluding, "planar-2r").endswith("the same 𝐃, 𝐂 𝐪̇ and 𝐠.")
    assert shown("planar-2r", "skew")[-1] == "𝐍 + 𝐍ᵀ = 𝟎"


def test_the_parts_of_d_are_summed_up() -> None:
    assert shown("planar-2r", "D_sum") == [
        "d₁₁ = m₁ l_c1² + I₁ + m₂ (l₁² + l_c2² + 2l₁ l_c2 c₂) + I₂",
        "d₁₂ = d₂₁ = m₂ (l_c2² + l₁ l_c2 c₂) + I₂",
        "d₂₂ = m₂ l_c2² + I₂",
    ]
    assert shown("in3140-rp", "D_sum") == ["d₁₁ = I_1zz + m₂ L₂²", "d₂₂ = m₂", "d₁₂ = d₂₁ = 0"]
    first, *_, zeros = shown("elbow-3r", "D_sum")
    assert first.count(" = ") == 2  # collected where it is read off
    assert zeros == "d₁₂ = d₁₃ = d₂₁ = d₃₁ = 0"
    assert "D_sum" not in {each.id for each in solved("puma560").steps}  # no parts are shown


def test_the_decisive_cross_products_of_a_mass_centre_are_shown() -> None:
    assert shown_working("elbow-3r", "Jv2") == [  # not about z₀, where two coordinates change places
        "𝐳₁ × (𝐫_c2 - 𝐨₁) = [[s₁], [-c₁], [0]] × [[l_c2 c₁ c₂], [l_c2 s₁ c₂], [l_c2 s₂]]"
        " = [[-l_c2 c₁ s₂], [-l_c2 s₁ s₂], [l_c2 c₂ (s₁² + c₁²)]]"
    ]
    assert shown_working("planar-2r", "Jv1") == []


def test_a_mass_centre_at_the_end_of_the_arm_has_its_jacobian() -> None:
    assert formula("in3140-rp", "Jv2") == "𝐉_v2 = 𝐉_v"  # a point: its 𝐉_ω is of no use
    assert len(step("in3140-rp", "Jv2").result) == 1
    assert step("in3140-rp", "Jv2").uses == ("J",)
    assert formula("in3140-rp", "Jv1").endswith("𝐉_ω1 = [[𝐳₀, 𝟎]]")


CANCELLING = [
    ("planar-2r", "tau1", ""),
    ("planar-2r", "tau2", "The terms with q̇₁ q̇₂ cancel:"),
    ("elbow-3r", "tau3", "The terms with θ̇₂ θ̇₃ cancel:"),
    ("rp-vertical", "tau1", ""),
]


@pytest.mark.parametrize(("problem", "name", "words"), CANCELLING)
def test_what_cancels_in_a_force_is_said(problem: str, name: str, words: str) -> None:
    assert said(step(problem, name).concluding, problem) == words


def test_the_gravity_terms_are_differentiated_term_by_term() -> None:
    """∂P/∂q as it is differentiated, and collected; two terms are a look."""
    (line,) = step("elbow-3r", "g").lines
    assert [to_unicode(node, solved("elbow-3r").style) for node in line.formulas] == [
        "g₂ = m₂ g l_c2 c₂ + m₃ g (L₂ c₂ + l_c3 c₂₃) = g ((m₂ l_c2 + m₃ L₂) c₂ + m₃ l_c3 c₂₃)"
    ]
    assert not step("in3140-rp", "g").lines


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
    assert levels["D_direct1"] is Detail.FULL  # the products of short arms alone
    assert "D_direct1" not in {each.id for each in solved("stanford-6").steps}


@pytest.mark.parametrize(
    ("problem", "body", "told"),
    [
        ("in3140-rp", "1", "R₁ leads from the body's axes to those of the base."),  # in full alone
        ("elbow-3r", "2", "Below the energy is worked out along the body's own axes"),  # in full alone
    ],
)
def test_what_the_tensor_along_the_base_is_for(problem: str, body: str, told: str) -> None:
    """Where K_ω is ½ (Rᵀω)ᵀ I (Rᵀω) or ½ I_zz ωᵀω, the tensor along the axes of the base is an aside."""
    said = step(problem, f"I{body}").why
    text = "".join(part if isinstance(part, str) else to_unicode(part) for part in said)
    assert told in text


WRIST = """
dh: [{theta: q1*, alpha: 90deg}, {theta: q2*, a: l}]
masses:
  - {mass: m1, link: 2, center: tip, inertia: {xx: A, yy: B, zz: C}}
  - {mass: m2, link: 2, name: p, shape: point}
"""


@pytest.mark.parametrize(
    ("problem", "told"),
    [
        ("in3140-rp", ""),  # K₁ + K₂, as the tensor of body 1 enters by one moment
        ("planar-2r", ""),
        (WRIST, " A point mass has no second term."),
        ("crustcrawler-2r", ""),
    ],
)
def test_of_the_total_kinetic_energy_it_is_said_what_points_have_not(problem: str, told: str) -> None:
    assert step(problem, "K").why == (f"The sum over the bodies.{told}",)


@pytest.mark.parametrize(
    ("problem", "printed"),
    [
        ("planar-2r", "𝒫 = P₁ + P₂ = -Σᵢ₌₁² mᵢ 𝐠₀ᵀ 𝐫_ci"),
        ("crustcrawler-2r", "𝒫 = P₁ + P₂ + P_p, Pᵢ = -mᵢ 𝐠₀ᵀ 𝐫_ci"),  # one body has a name, and no number
    ],
)
def test_a_total_says_what_its_parts_are(problem: str, printed: str) -> None:
    formula = step(problem, "P").formula
    assert formula is not None
    assert to_unicode(formula, solved(problem).style) == printed


def test_a_cosine_that_stays_is_no_step() -> None:
    """cos(q₁ + 30°) is itself; cos(q₂ + 180°) is not."""
    arm = "dh: [{theta: q1* + 30deg, alpha: 90deg}, {theta: q2* + 180deg, a: l2}]\nfind: [J]\n"
    told = solved(arm).to_markdown("full")
    assert r"\cos(q_{2}^{\star} + 180" in told and r"\cos(q_{1}^{\star} + 30" not in told


EQUAL_LINKS = """
gravity: [0, -g, 0]
dh: [{theta: q1*, a: l}, {theta: q2*, a: l}]
masses: [{mass: m, link: 1}, {mass: %s, link: 2}]
"""
TAPERED = """
gravity: [0, -g, 0]
dh: [{theta: q*, a: L}]
masses: [{link: 1, shape: {rod: {length: L, density: rho*(2 - x/L)}}}]
"""


@pytest.mark.parametrize(
    ("problem", "id", "told"),
    [
        (EQUAL_LINKS % "m", "P", "𝒫 = m g l (2s₁ + s₁₂)"),
        (EQUAL_LINKS % "M", "P", "𝒫 = m g l s₁ + M g l (s₁ + s₁₂)"),
        (EQUAL_LINKS % "m" + "springs: [{stiffness: k, of: q1}]\n", "P", "𝒫 = m g l (2s₁ + s₁₂) + ½ k q₁²"),
        (TAPERED, "P1", "P₁ = 2ρ g L² sin(q)/3"),
        (TAPERED, "K", "𝒦 = (5/24) ρ L³ q̇²"),
    ],
)
def test_potential_energies_of_shared_terms_are_collected_and_densities_stand_as_masses_do(
    problem: str, id: str, told: str
) -> None:
    assert shown(problem, id) == [told]


HANGING = """
gravity: [0, -g, 0]
model: {coordinates: {y: prismatic}, bodies: [{mass: m, at: [0, h - y, 0]}]}
"""
ABOUT_THE_JOINT = """
dh: [{theta: q1*, alpha: 90deg}, {theta: q2*, a: l}]
masses: [{mass: m, link: 2, center: {near: [c, 0, 0]}, inertia: {xx: A, yy: B, zz: G}, about: joint}]
"""


@pytest.mark.parametrize(
    ("problem", "id", "told"),
    [
        (HANGING, "P1", "P₁ = m g (h - y)"),
        (HANGING, "P", "𝒫 = m g (h - y)"),
        (ABOUT_THE_JOINT, "Kw1", "K_ω1 = ½ ((A s₂² + (B - m c²) c₂²) q̇₁² + (G - m c²) q̇₂²)"),
    ],
)
def test_no_sign_is_drawn_out_of_a_difference_of_an_energy(problem: str, id: str, told: str) -> None:
    assert shown(problem, id) == [told]
