"""What a reader who checks each line asks of the words: that they are true, needed and plain."""

from __future__ import annotations

import re
from unicodedata import normalize

import pytest

import dynsolve
from dynsolve.explain.step import Detail
from dynsolve.notation.unicode import width
from dynsolve.render import terminal
from dynsolve.render.files import Format
from dynsolve.solution.documents import solution_documents
from dynsolve.solution.reports import report
from tests.support import solved

TWO_LINKS = "dh: [{theta: q1*, a: l1}, {theta: q2*, a: l2}]\n"
SCARA = """
gravity: none
dh:
  - {theta: q1*, a: a1}
  - {theta: q2*, a: a2, alpha: 180deg}
  - {d: q3*}
  - {theta: q4*, d: d4}
task: pose
"""
MASSES = "masses: [{mass: m1, link: 1}, {mass: m2, link: 2}]\n"


def page(problem: str, detail: Detail = Detail.NORMAL) -> str:
    """The worked solution as it stands on a terminal."""
    text = report(dynsolve.solve(problem), Format.TEXT, detail=detail).decode()
    return normalize("NFC", text)


def in_one_line(problem: str) -> str:
    return " ".join(page(problem).split())


def test_what_is_lost_in_every_configuration_is_not_lost_in_a_singular_one_alone() -> None:
    text = in_one_line(SCARA + "find: [singular]")
    assert "orthogonal to 𝐰: that motion is lost" in text
    assert "2 more motions are impossible in every configuration" in text


def test_a_target_pose_stands_in_a_display() -> None:
    problem = (
        "gravity: none\ndh: [{theta: q1*, a: 1}, {theta: q2*, a: 1}, {theta: q3*, a: 1/2}]\ntask: pose\n"
    )
    text = page(problem + "reach: [1, 1, 0, 0, -1, 0, 1, 0, 0, 0, 0, 1]\nfind: [inverse]")
    assert "To be reached:\n\n          ⎡0  -1  0  1⎤\n    𝐇₃⁰ = ⎢1" in text


def test_a_coordinate_in_a_heading_is_a_formula() -> None:
    text = page("gravity: none\n" + TWO_LINKS + "find: [inverse]")
    assert re.search(r"Solving for q₂\n", text) and "Solving for q2" not in text
    latex = report(dynsolve.solve("gravity: none\n" + TWO_LINKS + "find: [inverse]"), Format.LATEX).decode()
    assert re.search(r"subsection\*\{.*Solving for \\?.*q_", latex)


def test_no_table_repeats_what_stands_above() -> None:
    text = page(SCARA + "find: [inverse]")
    assert "as above" not in text and "with +" not in text
    assert "q₂ has two values: there are 2 solutions where -1 ≤ " in text
    told = text[text.index("Summary") :]
    assert "u₁₁ = r₂₁ s₁₂ + r₁₁ c₁₂" in told  # what the formulas there are written in


def test_parameters_of_what_is_asked_are_told_by_what_they_are() -> None:
    text = page(
        "gravity: [g*sin(beta), -g*cos(beta), 0]\n"
        + TWO_LINKS
        + MASSES
        + "springs: [{stiffness: k, of: q2, rest: delta}]\n"
        + "forces: [{link: 2, at: tip, force: [F, 0, 0], moment: [0, 0, M]}]\n"
        + "velocity: [v, 0]\nstate: {q1: gamma, q1': w}\nfind: [Q, qd, g]"
    )
    for line in (
        "k: stiffness of a spring (N m/rad)",
        "δ: rest position of a spring (rad)",
        "F: force from outside (N)",
        "M: moment from outside (N m)",
        "v: given velocity of the task (m/s)",
        "w: rate of a coordinate in the given state (rad/s)",
        "γ: value of a coordinate in the given state (rad)",
        "β: angle in the direction of gravity (rad)",
    ):
        assert f"• {line}\n" in text
    assert "parameter of the problem" not in text and "parameters of the problem" not in text
    assert "The potential energy is minus the mass times 𝐠₀ᵀ 𝐫_c1." in " ".join(text.split())


def test_many_zeros_are_told_in_words() -> None:
    cart = """
gravity: [0, -g, 0]
model:
  coordinates: {x: prismatic, theta: revolute, phi: revolute}
  bodies:
    - {mass: M, at: [x, 0, 0]}
    - {mass: m1, at: [x + l1*sin(theta), -l1*cos(theta), 0]}
    - {mass: m2, at: [x + l2*sin(phi), -l2*cos(phi), 0]}
springs: [{stiffness: k, of: theta - phi}]
linearize: {x: 0, theta: 0, phi: 0}
find: [linear_A, equilibria]
"""
    text = page(cart)
    assert "every other entry = 0" in text and text.count("(𝐀_lin)₁₁") == 0
    told = text[text.index("Summary") :]
    assert told.count("= 0 and") == 1 and "stable where k + m₁ g l₁ cos(θ) > 0" in " ".join(told.split())


@pytest.mark.parametrize(
    ("find", "there", "left_out"),
    [
        ("inverse", "Inverse kinematics", "The Jacobian|Lagrang|matrix form|Total kinetic"),
        ("singular", "Singular configurations", "The Jacobian\n|Lagrang|matrix form|Total kinetic"),
        ("K", "Total kinetic energy", "Lagrang|matrix form"),
        ("D", "The matrix form", "Points and tasks"),
    ],
)
def test_only_what_is_asked_has_a_section(find: str, there: str, left_out: str) -> None:
    problem = "gravity: [0, -g, 0]\n" + TWO_LINKS + MASSES + f"find: [{find}]"
    headings = re.findall(r"^\d[\d.]* .*\n", page(problem), re.MULTILINE)
    assert any(there in heading for heading in headings)
    assert not any(re.search(left_out, heading) for heading in headings)
    assert "Lagrangian" in page(problem, Detail.FULL)


def test_a_row_within_a_sentence_has_blanks_after_its_commas() -> None:
    text = in_one_line("gravity: [0, -g, 0]\n" + TWO_LINKS + MASSES)
    assert "(u₁, u₂, u₃)ᵀ = (-u₂, u₁, 0)ᵀ" in text


def test_rates_are_told_with_one_blank_and_their_own_sections() -> None:
    problem = "gravity: none\ndh: [{theta: q1*, a: l1}, {theta: q2*, a: l2}, {theta: q3*, a: l3}]\n"
    text = page(problem + "velocity: [0, 0]\nacceleration: [0, 0]\nstate: {q1: 0}\nfind: [qdd, nullspace]")
    assert not re.search(r"[a-z]  [a-z]", text)
    assert re.search(r"𝐉_r 𝐪̇ = 𝟎 +\(§4.11\)", text)
    wrist = (
        "dh: [{theta: q1*, alpha: -90deg}, {theta: q2*, alpha: 90deg}, {theta: q3*, d: d6}]\ntask: twist\n"
    )
    assert re.search(r"det \(𝐉_rᵀ 𝐉_r\) = .*\(§4.12\)", page("gravity: none\n" + wrist + "find: [det]"))


def test_for_which_parameters_configurations_are_all_that_are_singular() -> None:
    folded = "gravity: none\ndh: [{theta: q1*, a: l1}, {theta: q2*, a: l2}, {theta: 180deg, a: l3}]\n"
    assert "This is so where l₂ ≠ l₃" in in_one_line(folded + "find: [singular]")
    assert "This is so where" not in in_one_line("gravity: none\n" + TWO_LINKS + "find: [singular]")


def test_what_both_sides_share_is_cancelled() -> None:
    arm = "dh: [{theta: q1*, d: 1/2, alpha: 90deg}, {theta: q2*, a: 1/2}, {theta: q3*, a: 1/2}]\n"
    text = page("gravity: none\n" + arm + "find: [inverse]")
    assert "atan2(s₃, 1 + c₃)" in text and "atan2(s₃/2" not in text


@pytest.mark.parametrize("problem", ["puma560-first3", "elbow-3r", "spherical-rrp", "planar-rrp-task"])
def test_no_line_is_wider_than_a_terminal(problem: str) -> None:
    solution = solved(problem)
    for document in solution_documents(solution, tuple(Detail)):
        for line in terminal.render(document, style=solution.style):
            assert width(line.text) <= 100, line.text


def test_a_spring_has_one_order_of_its_terms() -> None:
    spring = "springs: [{stiffness: k, of: q2 - q1, rest: delta}, {stiffness: k2, of: q1}]\nfind: [Ps]"
    text = page("gravity: [0, -g, 0]\n" + TWO_LINKS + MASSES + spring)
    assert len(set(re.findall(r"k \(.*?\)²", text))) == 1


@pytest.mark.parametrize("masses", [MASSES, "masses: [{mass: m2, link: 2}]\n"])  # with h, and without
def test_the_row_of_a_passive_coordinate_is_0(masses: str) -> None:
    asked = "gravity: [0, -g, 0]\n" + TWO_LINKS + masses + "passive: [q2]\nfind: [tau, D, C, g]"
    _, rows = in_one_line(asked).split("Row by row: τ₁ = ")
    assert " 0 = " in rows and "τ₂" not in rows
    assert dynsolve.solve(asked).to_json()["results"]["tau"][1].endswith("m2*g*l2*cos(q1 + q2)")


ARM = "gravity: [0, -g, 0]\n" + TWO_LINKS + MASSES


def summary_of(problem: str) -> str:
    text = page(problem)
    return text[text.index("Summary") :]


def test_what_is_asked_of_a_whole_is_answered_alone_and_zeros_too() -> None:
    problem = ARM + "find: [d12, g2, C22, c111, c121, c122]\n"
    told = " ".join(summary_of(problem).split())
    assert "d₁₂ = m₂ (l₂² + l₁ l₂ c₂)" in told and "g₂ = m₂ g l₂ c₁₂" in told
    assert "c₁₂₁ = -m₂ l₁ l₂ s₂ " in told  # not how it is derived
    assert "C₂₂, c₁₁₁ and c₁₂₂ are 0." in told
    assert "Note: c₁₁₁ and c₂₂₂ are zero." in in_one_line(problem)


def test_symbols_in_which_derivatives_cancel_are_told_in_a_worked_example() -> None:
    assert "left out. In c₁₂₂ the others cancel, 𝐃 being symmetric." in in_one_line(ARM)
    assert "the others cancel" not in in_one_line(FLOATING), "none does"


def test_asked_symbols_stand_in_the_json_as_the_derivatives_of_the_inertia_matrix_give_them() -> None:
    import sympy

    names = [f"c{i}{j}{k}" for i in (1, 2) for j in (1, 2) for k in (1, 2) if i <= j]
    solution = dynsolve.solve(ARM + f"find: [{', '.join(names)}]\n")
    found, D = solution.to_json()["results"], solution.D
    q = [sympy.Symbol(name, real=True) for name in ("q1", "q2")]
    for name in names:
        i, j, k = (int(digit) - 1 for digit in name[1:])
        slopes = D[k, j].diff(q[i]) + D[k, i].diff(q[j]) - D[i, j].diff(q[k])
        here = sympy.sympify(found[name], locals={str(s): s for s in D.free_symbols})
        assert sympy.simplify(here - slopes / 2) == 0
    assert found["c111"] == "0"


def test_with_numbers_there_is_what_is_asked_and_nothing_else() -> None:
    values = "values: {l1: 0.5, l2: 0.4, m1: 2, m2: 1.5, g: 9.81}\n"
    solution = dynsolve.solve(ARM + values + "find: [rc2, K2, d12, c111]\n").beside()
    text = normalize("NFC", report(solution, Format.TEXT).decode())
    numbers = text[text.index("With numbers") :]
    assert text.index("Summary") < text.index("With numbers")
    assert "⎡0.5 c₁ + 0.4 c₁₂⎤" in numbers and "K₂ = 0.5 (" in numbers
    assert "d₁₂ = 0.24 + 0.3 c₂ in kg m²" in numbers and "c₁₁₁" not in numbers  # 0 is 0
    assert not re.search(r"𝐇|𝐉|𝒫|𝒦|ℒ|τ₁|𝐃|value", numbers)  # the values stand in what is given


def test_after_the_recursions_no_matrix_is_read_off_that_nobody_asks_for() -> None:
    from dynsolve.robot.questions import Method

    solution = dynsolve.solve(ARM + "find: [tau]\n", method=Method.NEWTON_EULER)
    told = report(solution, Format.TEXT).decode()
    assert "The matrix form" not in told and "The generalized forces:" in told[told.index("Summary") :]
    asked = dynsolve.solve(ARM + "find: [nl1, wl2]\n")
    told = report(asked, Format.TEXT).decode()
    assert "Newton-Euler recursions" in told and "Lagrang" not in told


MOTOR = ARM + "springs: [{stiffness: k, of: q2 - th}]\nmotors: [{turns: th*, inertia: Im%s}]\npassive: [q2]\n"


@pytest.mark.parametrize(
    ("gear", "called"), [("", "angle of a motor"), (", ratio: n", "angle of a motor behind")]
)
def test_the_angle_of_a_motor_is_no_angle_of_a_joint(gear: str, called: str) -> None:
    text = in_one_line(MOTOR % gear + "find: [Km]\n")
    assert "q₁, q₂: joint angles: generalized coordinates" in text and f"θ: {called}" in text
    assert "Here q₁ and q₂ are angles (revolute joints)." in text
    assert "The rotor of θ has the moment of inertia I_m" in text
    assert "half its moment of inertia, I_mi, times" in text and ("k_ri" in text) is bool(gear)


def test_a_model_without_frames_has_gravity_by_an_axis_of_the_world() -> None:
    model = """
gravity: [0, 0, -g]
model:
  coordinates: {s: prismatic}
  bodies: [{mass: m, at: [s*cos(beta), 0, s*sin(beta)]}]
find: [g]
"""
    text = in_one_line(model)
    assert "Gravity g acts against the axis z; there is no friction." in text
    assert "β: angle in the given positions (rad)" in text and "parameter of the problem" not in text


def test_numbers_to_be_reached_and_heights_have_their_units() -> None:
    arm = "gravity: none\ndh: [{theta: q1*, a: 0.3}, {theta: q2*, a: 0.2}]\n"
    text = in_one_line(arm + "task: [tip.x, tip.y]\nreach: [0.1, -0.35]\nfind: [inverse]\n")
    assert "To be reached: 𝐫 = (0.1, -0.35) m." in text
    text = in_one_line(arm + "task: [tip.x, q1 + q2]\nreach: [0.1, 30deg]\nfind: [inverse]\n")
    assert "To be reached: 𝐫 = (0.1 m, 30°)." in text
    lift = "gravity: [0, 0, -9.81]\ndh: [{theta: q1*, d: 0.05}]\nmasses: [{mass: 2, link: 1}]\nfind: [P]\n"
    assert "η₁ = 0.05 m" in in_one_line(lift)


def test_the_base_of_the_modified_recursions_accelerates_along_its_own_axes() -> None:
    arm = "convention: modified\ngravity: [0, 0, -g]\nbase: Ry(90deg)\ndh: [{theta: q1*}, {a: l1}]\n"
    text = in_one_line(arm + "masses: [{mass: m1, link: 2, center: [lc, 0, 0]}]\nfind: [al1]\n")
    assert "𝐚₀⁰ = -(𝐑₀^w)ᵀ 𝐠₀ = (-g, 0, 0)ᵀ" in text


def test_the_entries_of_the_coriolis_matrix_have_one_letter() -> None:
    for stem in ("in3140-rp", "planar-2r"):
        text = page(stem, Detail.FULL)
        assert "Cₖⱼ" in text and "cₖⱼ" not in text


def test_what_holds_at_the_state_is_told_to_with_numbers_too() -> None:
    asked = "velocity: [0.1, 0]\nstate: {q1: 30deg, q2: 60deg}\nfind: [r, qd]\n"
    solution = dynsolve.solve("gravity: none\n" + TWO_LINKS + "values: {l1: 0.5, l2: 0.3}\n" + asked).beside()
    text = normalize("NFC", report(solution, Format.TEXT).decode())
    before, _, after = text[text.index("With numbers") :].partition("At q₁ = 30°, q₂ = 60°:")
    assert "𝐫 = " in before and "𝐪̇ ≈ " in after  # -0.1/0.3 rad/s


def test_only_a_motor_with_a_gear_is_behind_one() -> None:
    motors = "motors: [{turns: q1, inertia: I1, ratio: n}, {turns: th*, inertia: I2}]\n"
    text = in_one_line(ARM + motors + "find: [Km]\n")
    assert "θ: angle of a motor: generalized coordinate" in text


FLOATING = """
dh:
  - {theta: q1*, d: h}
  - {d: q2*, alpha: -90deg}
masses:
  - {mass: m2, link: 2, center: [x2, y2, z2]}
"""
WRIST = """
dh:
  - {theta: q1*, d: l1, alpha: 90deg}
  - {theta: q2*, a: l2}
  - {theta: q3*, alpha: -90deg}
  - {theta: q4*, d: l4, alpha: 90deg}
masses:
  - {mass: m2, link: 2, center: [-lc2, 0, 0]}
  - {mass: m4, link: 4, center: [0, lc4, 0], inertia: {xx: Ix, yy: Iy, zz: Iz}}
"""


def test_a_line_that_an_identity_leads_to_is_collected_and_what_cancels_is_told() -> None:
    for shown in (in_one_line(FLOATING), " ".join(page(FLOATING, Detail.FULL).split())):
        assert "the terms with s₁ c₁ cancel: " in shown
        assert "By s₁² + c₁² = 1, and collected: K_v1" in shown and " Collected: K_v1" not in shown


def test_a_rate_of_a_momentum_that_is_the_force_has_one_line() -> None:
    rate = "d/dt (∂ℒ/∂q̇₁) = m₂"
    assert rate not in in_one_line(FLOATING)
    assert rate in " ".join(page(FLOATING, Detail.FULL).split())
    assert rate in in_one_line(FLOATING + "find: [ddt, tau]\n")
    falls = "gravity: [0, -g, 0]\n" + TWO_LINKS + MASSES
    assert "d/dt (∂ℒ/∂q̇₂) =" in in_one_line(falls), "gravity is taken off"


def test_of_a_force_alone_the_summary_has_its_equation() -> None:
    assert "The equation of motion:" in in_one_line(
        "dh: [{theta: q1*, a: l1}]\nmasses: [{mass: m1, link: 1}]\nfind: [tau]\n"
    )


FOUR_JOINTS = """
gravity: [0, 0, -g]
convention: modified
dh:
  - {theta: q1*, d: h}
  - {theta: q2*, alpha: 90deg}
  - {d: q3*, alpha: -90deg}
  - {theta: q4*, alpha: 0, d: t}
masses:
  - {mass: m1, link: 2, center: [c, 0, 0], inertia: {xx: A, yy: B, zz: B}}
  - {mass: m2, link: 4, center: origin, inertia: {xx: J, yy: J, zz: G}}
"""
"""An arm whose last frame is long, and whose D, C and g are short."""


@pytest.mark.parametrize("detail", [Detail.RESULTS, Detail.BRIEF, Detail.NORMAL])
def test_the_summary_of_a_short_model_of_many_joints_has_all_of_it(detail: Detail) -> None:
    whole = page(FOUR_JOINTS, detail)
    summary = whole.partition("Summary")[2]
    for name in ("d₁₁", "𝐂", "𝐠", "τ₁", "f₃"):
        assert f"    {name} = " in summary
    assert "those of section" not in summary
    if detail is not Detail.NORMAL:
        assert whole.count("    𝐂 = ") == 1


def test_what_is_too_long_to_stand_twice_is_where_it_was_written_out(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("dynsolve.solution.summary.MOST_TWICE", 100)
    for detail in (Detail.BRIEF, Detail.NORMAL):
        whole = page(FOUR_JOINTS, detail)
        assert "𝐃, 𝐂 and 𝐠 are those of section 7." in whole
        assert "The rows of 𝛕 are those of section 6." in whole
        assert "    𝐂 = " in whole and "    𝐠 = " not in whole.partition("Summary")[2]


def test_an_arm_of_numbers_and_letters_has_decimals_and_units_everywhere() -> None:
    shown = page(
        "gravity: [0, 0, -9.81]\n"
        "dh: [{theta: q1*, d: 0.4, alpha: 90deg}, {theta: q2*, a: 0.5}]\n"
        "masses:\n"
        "  - {mass: 3, link: 1, center: [0, -0.2, 0], inertia: {yy: 1/50}}\n"
        "  - {mass: m2, link: 2}\n"
    )
    assert "1   q₁⋆   0.4   0     90°" in shown and "2   q₂⋆   0     0.5   0" in shown
    assert "(𝐈₁)_yy = 0.02 kg m²" in shown and "Numbers are exact, in SI units" in shown


def test_the_energy_of_a_body_with_one_part_is_that_part() -> None:
    shown = in_one_line(ARM)
    assert "K₂ = K_v2 + K_ω2 = K_v2 " in shown and "K₂ = ½" not in shown
    assert "K₂ = ½ m₂" in in_one_line(ARM + "find: [K2]\n")


def test_a_doubled_angle_is_told_where_it_is_met_first() -> None:
    offset = """
dh:
  - {theta: q1*, a: a1, alpha: 90deg}
  - {theta: q2*, a: a2, alpha: 90deg}
  - {d: q3*}
masses:
  - {mass: m3, link: 3, center: tip, inertia: {xx: I3xx, yy: I3yy, zz: I3zz, xz: I3xz}}
"""
    shown = in_one_line(offset)
    told = "collected with c₂² - s₂² = cos(2q₂)"
    assert shown.count("cos(2q₂)") > 1
    assert shown.index("cos(2q₂)") == shown.index(told) + len(told) - len("cos(2q₂)")
    assert "collected with" not in in_one_line(ARM)


def test_names_in_a_summary_without_the_model_are_told_there() -> None:
    problem = (
        "dh: [{theta: q1*, alpha: 90deg}, {theta: q2*, a: a2}, {theta: q3*, a: a3}]\n"
        "masses: [{mass: m2, link: 2}, {mass: m3, link: 3}]\nfind: [D, Cqd]\n"
    )
    summary = page(problem).partition("Summary")[2]
    assert set("σ₁ σ₂ σ₃".split()) <= set(re.findall(r"σ.", summary))
    assert re.search(r"In the results below.*:\n\n    σ₁ = .*\n    σ₂ = .*\n    σ₃ = ", summary)


def test_as_many_solutions_are_promised_as_there_may_be() -> None:
    """With l2 < l1 the second value of q1 leaves no q2, by sqrt(r1² + r3²) + l1 ≤ l2."""
    lifted = "dh: [{d: z*}, {theta: q1*, a: l1, alpha: 90deg}, {theta: q2*, a: l2}]\n"
    text = in_one_line(f"gravity: none\n{lifted}task: [tip.x, tip.y, tip.z]\nfind: [inverse]")
    assert "every choice that exists gives a solution: there are at most 4 solutions." in text
    assert "The 4 solutions" not in text


def test_what_was_not_found_is_not_called_impossible_nor_verified() -> None:
    arm = """
dh:
  - {theta: q1*, d: h, a: a1, alpha: 90deg}
  - {theta: q2*, alpha: gamma}
  - {d: q3*}
masses: [{mass: m, link: 3}]
reach: [px, py, pz]
"""
    shown = in_one_line(arm + "find: [inverse]\n")
    assert "The values of the task, p_x, p_y and p_z, are given" in shown
    assert "That there is no closed form is not shown" in shown and "stay coupled" not in shown
    assert "The other results" not in shown and "The other results" in in_one_line(arm + "find: [r]\n")


def test_a_quotient_of_decimals_has_decimals_above_and_below() -> None:
    arm = """
gravity: [0, -9.81, 0]
dh: [{{theta: q1*, a: 0.5}}, {{theta: q2*, a: 0.3}}]
masses:
  - {{mass: 4, link: 1, center: {{along: 1/2}}}}
  - {{mass: m, link: 2, center: tip, inertia: {{zz: {zz}}}}}
linearize: {{q1: -90deg, q2: 0}}
find: [linear_B]
"""
    assert "(52 + 360m)/(13 + 103m)" in page(arm.format(zz="0.013"))
    assert "(0.500299 + 3.49970 m)/(0.125075 + m)" in page(arm.format(zz="0.012865934"))


def test_what_is_lost_is_told_before_its_formula() -> None:
    shown = page("dh: [{theta: q1*, a: l1}, {theta: q2*, a: l2}]\nfind: [singular]\n")
    assert shown.index("orthogonal to 𝐰") < shown.index("𝐰ᵀ𝐉") and shown.count("𝐰ᵀ𝐉") == 1


def test_products_of_rates_stand_in_the_order_of_the_coordinates() -> None:
    text = """
gravity: [0, -g, 0]
model:
  coordinates: {q1: revolute, q2: revolute}
  bodies: [{mass: m, at: [a*sin(q1) + a*sin(q2), a*cos(q1) + a*cos(q2), 0]}]
"""
    assert "2(s₁ s₂ + c₁ c₂) q̇₁ q̇₂" in page(text)


def test_the_force_of_a_slide_is_told_where_something_else_has_no_motor() -> None:
    cart = "dh: [{d: q1*, alpha: 90deg}, {theta: q2*, a: l}]\nmasses: [{mass: m, link: 2}]\npassive: [q2]\n"
    assert "q₁ is a length, so what drives it is the force f₁." in in_one_line(cart)


def test_of_one_parameter_it_is_not_said_that_fewer_are_not_enough() -> None:
    pendulum = "gravity: [0, -g, 0]\ndh: [{theta: q1*, a: l}]\nmasses: [{mass: m, link: 1}]\n"
    assert "are not enough" not in in_one_line(pendulum + "find: [Yg, ag]")


def test_what_is_left_out_of_an_energy_is_said_after_one_comma() -> None:
    arm = """
gravity: [0, 0, -g]
dh: [{d: p1*, alpha: 90deg}, {d: p2*, alpha: 45deg, a: a}, {theta: q3*, alpha: -90deg}]
masses: [{mass: m1, link: 1, center: origin}, {mass: m3, link: 3, center: [c, 0, 0]}]
convention: modified
passive: [q3]
inputs: given
find: [equilibria]
"""
    assert "staying as they are, without the rows" in in_one_line(arm)


def test_rates_stand_before_accelerations_alone() -> None:
    arm = "gravity: none\n" + TWO_LINKS + "velocity: [v, 0]\nacceleration: [a, 0]\n"
    text = in_one_line(arm + "state: {q1: 0, q2: 90deg, q1': 1, q2': 2}\nfind: [qd, qdd]").partition(
        "Summary"
    )[2]
    assert text.index("At q₁ = 0, q₂ = 90°: 𝐪̇") < text.index("At q₁ = 0, q₂ = 90°, q̇₁ = 1, q̇₂ = 2: 𝐪̈")


def test_decimals_of_a_file_stay_decimals_beside_masses_that_are_letters() -> None:
    shown = in_one_line(
        "gravity: [0, -g, 0]\n"
        "dh: [{theta: q1*, a: l}, {theta: q2*, a: 0.3}]\n"
        "masses:\n"
        "  - {mass: m, link: 1, center: midpoint, shape: {rod: {length: l}}}\n"
        "  - {mass: 2*m, link: 2, center: midpoint, inertia: {zz: 0.02}}\n"
    )
    assert "Numbers are exact, in SI units" in shown and "Lengths are in m." in shown
    assert "h = -0.3 m l s₂" in shown and "m g (2.5 l c₁ + 0.3 c₁₂)" in shown
    assert "7l²/3" in shown and "≈" not in shown, "what comes to no end is a fraction"
    half = "dh: [{theta: q1*, a: l}]\nmasses: [{mass: m, link: 1, center: {near: [0.5*l, 0, 0]}}]\n"
    assert "at l/2 from" in in_one_line("gravity: [0, -g, 0]\n" + half), "0.5 l is half of l, and no datum"


def test_a_part_of_a_turn_is_a_fraction_among_decimals() -> None:
    shown = in_one_line(
        "gravity: none\ndh: [{theta: q*, a: 0.5}]\nmasses: [{mass: 2, link: 1}]\n"
        "springs: [{stiffness: 20, of: q, rest: 30deg}]\nfind: [tau]\n"
    )
    assert "at rest at q = 30°" in shown and "10(q - π/6)²" in shown and "τ₁ = 0.5 q̈ + 20(q - π/6)" in shown


def test_sums_of_rates_are_multiplied_out_where_some_stood() -> None:
    slanted = """
gravity: none
model:
  coordinates: {x: prismatic, y: prismatic}
  bodies: [{mass: m, at: [x + y*sin(30deg), y*cos(30deg), 0]}]
find: [K]
"""
    text = in_one_line(slanted)
    assert "Collected: K_v1 = ½ m (ẋ² + ẋ ẏ + ẏ²)" in text and "sums of rates" not in text
    assert "The sums of rates multiplied out" in in_one_line(ARM + "find: [K]\n")


def test_why_matrices_multiply_from_the_right_stands_above_a_product() -> None:
    why = "Each 𝐀 leads one frame further along the arm"
    two_arms = "dh: [{theta: u*, a: a1}, {from: 0, theta: v*, a: a2}]\n"
    for detail in (Detail.NORMAL, Detail.FULL):
        assert why not in " ".join(page(two_arms, detail).split())
    assert why in " ".join(page(TWO_LINKS).split())


SPRING = "springs: [{stiffness: k, of: q1 - q2}]\n"
ENERGIES = """
model:
  coordinates: {q1: revolute, q2: revolute}
  K: J1*q1'^2/2 + J2*q2'^2/2
  P: k*(q2 - q1)^2/2
"""


@pytest.mark.parametrize(
    ("problem", "terms", "by"),
    [
        ("gravity: none\n" + TWO_LINKS + MASSES + SPRING, "spring", "springs"),
        ("gravity: [0, -g, 0]\n" + TWO_LINKS + MASSES + SPRING, "gravity and spring", "gravity and springs"),
        ("gravity: [0, -g, 0]\n" + TWO_LINKS + MASSES, "gravity", "gravity"),
        (ENERGIES, "potential", "the potential energy"),
    ],
)
def test_the_terms_without_rates_are_called_by_what_acts(problem: str, terms: str, by: str) -> None:
    text = " ".join(page(problem + "find: [D, C, g]\n", Detail.FULL).split())
    for told in (
        f"𝐂 and the {terms} terms 𝐠",
        f"The {terms} terms, from the potential energy",
        f"{terms} terms, read off",
        f"𝐠 those of {by}.",
        f"column of the {terms} terms",
    ):
        assert told in text, told
    assert "gravity" in by or not re.search("gravity (and spring )?terms", text)


def test_the_tensor_of_a_body_that_does_not_turn_does_not_enter() -> None:
    slide = "gravity: [0, -g, 0]\ndh: [{d: x*, alpha: 90deg}]\n"
    body = "masses: [{mass: m, link: 1, center: origin, inertia: {%s}}]\nfind: [tau]\n"
    text = in_one_line(slide + body % "zz: I")
    assert "Body 1 does not turn, so its tensor does not enter: what is not given is taken as 0." in text
    assert "principal axes" not in text and "is given, about" not in text
    assert "so its tensor does not enter. " in in_one_line(slide + body % "xx: A, yy: B, zz: I")


def test_what_several_things_share_is_told_of_all_of_them() -> None:
    model = """
gravity: [g*sin(beta), -g*cos(beta), 0]
model:
  coordinates: {x: prismatic, y: prismatic, phi: revolute, psi: revolute}
  bodies:
    - {mass: m, at: [x, 0, 0], turn: phi, inertia: {zz: J}}
    - {mass: m, at: [x, y, 0], turn: psi, inertia: {zz: J}}
springs: [{stiffness: k, of: x}, {stiffness: k, of: y}, {stiffness: K, of: x - y}]
dampers: [{damping: b, of: x}, {damping: b, of: y}]
find: [tau]
"""
    text = in_one_line(model)
    for told in (
        "J: moment of inertia of bodies 1 and 2 about axis z through their mass centres",
        "k: stiffness of springs",
        "K: stiffness of a spring",
        "b: coefficient of dampers",
        "β: angle in the direction of gravity",
    ):
        assert f"• {told} (" in text, told


def test_gravity_loads_no_joint_where_there_is_one() -> None:
    level = "gravity: [0, 0, -g]\n"
    free = level + "model: {coordinates: {x: prismatic}, bodies: [{mass: m, at: [x, 0, 0]}]}\n"
    assert "so gravity needs no force. " in " ".join(page(free, Detail.FULL).split())
    arm = level + TWO_LINKS + MASSES
    assert "so gravity needs no torque at any joint." in " ".join(page(arm, Detail.FULL).split())


def test_the_coordinates_of_a_mass_centre_are_told_from_one_origin() -> None:
    text = in_one_line(
        "dh: [{theta: q1*, a: l1}]\nmasses: [{mass: m1, link: 1, center: {near: [x1, y1, 0]}}]\nfind: [tau]\n"
    )
    assert "x₁, y₁: coordinates x and y of the mass centre of body 1 from 𝐨₀, in frame 1 (m)" in text
