"""What is said of equilibria, constraints and rates: no more than holds, and in the number that there is."""

from __future__ import annotations

import pytest

import dynsolve
from dynsolve.explain.step import Step
from tests.unit.explain.sanity.checks import words

BEAM = """
gravity: [0, -g, 0]
model:
  coordinates: {a: revolute}
  bodies: [{mass: m, at: [l*sin(a), l*cos(a), 0]}]
springs: [{stiffness: k, of: a}]
find: [equilibria]
"""

COUNTERWEIGHT = """
gravity: [0, -g, 0]
dh: [{theta: q1*, a: l1}, {theta: q2*, a: l2}]
masses:
  - {mass: m1, link: 1, center: {near: [-d1, 0, 0]}}
  - {mass: m2, link: 2, center: {near: [d2, 0, 0]}}
  - {mass: mp, name: p, link: 2}
find: [equilibria]
"""

CRANK = """
gravity: [0, -g, 0]
dh: [{theta: q1*, a: r}, {theta: q2*, a: l}]
masses: [{mass: m, link: 2}]
passive: [q2]
constraints: [tip.y]
forces: [{link: 2, at: tip, force: [-F, 0, 0]}]
find: [Ac, reduced, Q]
"""

PENDUBOT = """
gravity: [0, -g, 0]
dh: [{theta: q1*, a: l1}, {theta: q2*, a: l2}]
masses: [{mass: m1, link: 1}, {mass: m2, link: 2}]
passive: [q2]
linearize: {q1: 90deg, q2: 0}
find: [qdd_forward, linear_A, linear_B]
"""


def steps(problem: str) -> dict[str, Step]:
    return {step.id: step for step in dynsolve.solve(problem).steps}


@pytest.mark.parametrize(
    ("assumed", "verdict"),
    [("assume: [k > m*g*l]", ": stable."), ("", "not stable where k < m g l cos(a).")],
)
def test_what_is_assumed_decides_stability(assumed: str, verdict: str) -> None:
    found = steps(BEAM + assumed)
    assert words(found["equilibria_stability"].concluding).strip().endswith(verdict)
    assert not found["equilibria"].lines  # the only row is the result


def test_a_condition_that_another_implies_is_not_told() -> None:
    told = words(steps(COUNTERWEIGHT)["equilibria_stability"].concluding)
    assert "At q₁ = 90°, q₂ = 180°: stable where m₁ d₁ > l₁ (m₂ + m_p), not stable where" in told


def test_gravity_alone_does_not_balance_what_is_held() -> None:
    found = steps(CRANK)
    assert "equilibrium" not in found
    assert words(found["Ac"].why).startswith("The function stays 0, so its rate is 0: ")
    assert words(found["reduced"].concluding).startswith("Multiplied out")


def test_no_spring_and_one_input() -> None:
    found = steps(PENDUBOT)
    assert "in the equilibrium gravity does not move it" in words(found["linear_A"].why)
    assert words(found["linear_B"].why) == "One column, of the only input: τ₁. S has a 1 in its row."
    assert found["qdd_forward"].lines[0].is_kept


STATIC = """
gravity: [0, -g, 0]
dh: [{theta: q1*, a: l}]
masses: [{mass: m, link: 1}]
forces: [{link: 1, at: tip, force: [F, 0, 0]}]
state: {q1: 90deg}
find: [tau_static, tau]
"""


@pytest.mark.parametrize("depth", ["results", "brief"])
def test_the_summary_says_at_which_state_a_result_holds(depth: str) -> None:
    text = dynsolve.solve(STATIC).to_markdown(depth)
    closing = text[text.rindex("Summary") :]
    assert closing.index("At $") < closing.index("static")


def test_the_summary_of_a_long_model_shows_what_is_asked_for() -> None:
    disk = """
gravity: none
model:
  coordinates: {x: prismatic, y: prismatic, phi: revolute, psi: revolute}
  bodies: [{mass: m, at: [x, y, R], turn: [{by: phi, about: [0,0,1]}], inertia: {zz: Id}}]
passive: [x, y]
find: [D]
"""
    text = dynsolve.solve(disk).to_markdown("brief")
    assert "pmatrix" in text[text.rindex("Summary") :] or "bmatrix" in text[text.rindex("Summary") :]
