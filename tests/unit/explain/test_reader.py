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
    assert "Beside it 2 motions are impossible in every configuration" in text


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
    assert "q₂ has two values: there are 2 solutions." in text
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
        "δ: where a spring is relaxed (rad)",
        "F: force from outside (N)",
        "M: moment from outside (N m)",
        "v: given velocity of the task (m/s)",
        "w: rate of a coordinate in the given state (rad/s)",
        "γ: value of a coordinate in the given state (rad)",
        "β: angle of gravity to the axes of the base (rad)",
    ):
        assert f"• {line}\n" in text
    assert "parameter of the problem" not in text and "parameters of the problem" not in text


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
    assert told.count("= 0 and") == 1 and "In these equilibria: the signs of" in " ".join(told.split())


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


def test_that_passive_forces_are_zero_is_said_where_rows_are_in_names_too() -> None:
    text = in_one_line("gravity: [0, -g, 0]\n" + TWO_LINKS + MASSES + "passive: [q2]\nfind: [tau, D, C, g]")
    assert "Row by row, with τ₂ = 0:" in text
