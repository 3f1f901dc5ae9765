"""The steps of points and the task: what is asked and what that needs, and nothing else."""

from __future__ import annotations

import re

import pytest

import dynsolve
from dynsolve.explain.step import Step
from dynsolve.notation.printing import PLAIN
from dynsolve.notation.unicode import to_unicode
from dynsolve.quantities.index import quantities
from dynsolve.render.terminal import render
from dynsolve.solution.documents import solution_document

ARM = """
title: An arm
dh:
  - {theta: q1*, a: l1}
  - {theta: q2* + 90deg, alpha: 90deg}
  - {d: q3*}
points: {P: {link: 1, at: {near: [lc1, 0, 0]}}, E: {link: 3}}
"""
TASK = "task: [tip.x, P.y, q1 + q2]\n"


def steps(text: str) -> dict[str, Step]:
    return {step.id: step for step in dynsolve.solve(text).steps if step.stage == "task"}


@pytest.mark.parametrize(
    ("asked", "shown"),
    [
        ("pP", ["pP"]),
        ("vP", ["pP", "JvP", "vP"]),
        ("JwE", ["JwE"]),
        ("J_dot", ["Jv_dot", "Jw_dot", "J_dot"]),
        ("r", ["pP", "r"]),
        ("Jr_dot", ["pP", "r", "Jr", "Jr_dot"]),
    ],
)
def test_what_is_asked_and_what_that_needs(asked: str, shown: list[str]) -> None:
    assert list(steps(f"{ARM}{TASK}find: [{asked}]")) == shown


def test_every_step_says_why_and_where_it_stands_in_the_book() -> None:
    found = steps(f"{ARM}{TASK}find: [vP, JvP, JwP, vE, JvE, JwE, J_dot, Jr_dot]")
    for step in found.values():
        assert step.why and step.title and re.fullmatch(r"§\d\.\d+", step.source)


def test_a_jacobian_along_other_axes_is_that_of_the_world_turned() -> None:
    step = steps(ARM.replace("E: {link: 3}", "E: {link: 3, in: 2}") + "find: [JvE, vE]")["JvE"]
    shown = [to_unicode(node, PLAIN) for node in (*step.working, *step.result)]
    assert shown[1].startswith("J_vE² = (R₂⁰)ᵀ J_vE = [") and shown[2].startswith("J_vE² = [")
    assert "the cosine of a difference, " in "".join(
        part for part in step.concluding if isinstance(part, str)
    )


def test_the_default_task_says_which_rows_it_leaves_out() -> None:
    (note,) = steps(ARM + "find: [Jr]")["Jr"].notes
    assert "without the row of " in "".join(part for part in note if isinstance(part, str))


def test_the_stages_are_numbered_as_they_come() -> None:
    bodies = "masses: [{mass: m1, link: 1}]\n"
    document = solution_document(dynsolve.solve(ARM + TASK + bodies + "find: [Jr, tau]"))
    lines = [line.text for line in render(document, 80)]
    assert {"3. Points and tasks", "4. The bodies: mass centres and inertia"} <= set(lines)


def test_a_hint_tells_no_result() -> None:
    solution = dynsolve.solve(ARM + TASK + "find: [Jr_dot, vP]")
    text = "\n".join(line.text for line in render(solution.hint("task"), 200, solution.style))
    assert "𝐉_r = ∂𝐫/∂𝐪" in text and "𝐯_P = 𝐉_vP 𝐪̇" in text and "Look out:" in text
    for name in ("r", "Jr", "Jr_dot", "JvP"):
        assert to_unicode(solution.forms(name).rows[0][0], solution.style) not in text.partition("\n1. ")[2]


def test_only_what_is_asked_is_exported() -> None:
    results = dynsolve.solve(ARM + TASK + "find: [Jr_dot, vP]").to_json()["results"]
    assert set(results) == {"A", "H", "Jv", "Jw", "bodies", "vP", "Jr_dot"}
    assert len(results["vP"]) == 3 and isinstance(results["vP"][0], str)


def test_every_quantity_has_its_letter() -> None:
    robot = dynsolve.solve(ARM + TASK).robot
    letters = [to_unicode(q.letter(robot), PLAIN) for q in quantities(robot).answers()]
    assert {"p_P", "v_P", "J_vP", "J_ωE", "J̇_v", "J̇", "r", "J_r", "J̇_r"} <= set(letters)


def test_latex_is_set_in_letters_that_latex_knows() -> None:
    everything = "velocity: [0, v, 0]\nacceleration: [0, 0, 0]\nforces: [{link: 3, force: [F, 0, 0]}]\n"
    asked = "find: [det, qd, qdd, nullspace, rangespace, lost, Q, tau_static, vP, Jr_dot]"
    steps = dynsolve.solve(ARM + TASK + everything + "state: {q1: 0, q2: 0}\n" + asked).to_json()["steps"]
    assert {"qdd", "lost", "tau_static"} <= {step["id"] for step in steps}
    assert all(step["latex"].isascii() for step in steps)


def test_a_determinant_is_expanded_before_it_is_simplified() -> None:
    arm = "dh: [{theta: q1*, a: l1}, {theta: q2*, a: l2}]\ntask: [tip.x, tip.y]\n"
    (line,) = steps(f"{arm}find: [det]")["det"].lines
    assert to_unicode(line.formulas[0], PLAIN).startswith("det J_r = ")
    arm = "dh: [{theta: q1*, d: l1, alpha: 90deg}, {theta: q2*, a: l2}, {theta: q3*, a: l3}]\n"
    (line,) = steps(f"{arm}task: [tip.x, tip.y, tip.z]\nfind: [det]")["det"].lines
    assert line.by[0] == "Along row 3, each entry times the determinant that is left, signs in turn, with "


def test_a_number_drawn_out_of_a_factor_leaves_no_fraction_in_it() -> None:
    arm = "dh: [{theta: a*, a: 3}, {theta: b*, a: 2}, {theta: c*, a: 1}]\ntask: [tip.x, tip.y, a + b + c]\n"
    (line,) = steps(f"{arm}find: [det]")["det"].lines
    assert "(3cos(a) + 2cos(a + b))" in to_unicode(line.formulas[0])


def test_a_determinant_names_the_identities_that_its_minors_need() -> None:
    """Of a spherical arm both minors are products with s₁² + c₁², and s₂² stands in one as it is."""
    arm = "dh: [{theta: q1*, alpha: 90deg}, {theta: q2*, alpha: -90deg}, {d: q3*}]\nfind: [det]\n"
    (line,) = steps(arm)["det"].lines
    told = "".join(part if isinstance(part, str) else to_unicode(part) for part in line.by)
    assert told.endswith("signs in turn, with sin²(q₁) + cos²(q₁) = 1:")
