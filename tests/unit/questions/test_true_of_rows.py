"""What stands before a row, a gradient, a condition: it is that of this robot, and of this row."""

from __future__ import annotations

import dynsolve
from dynsolve.notation.unicode import to_unicode
from dynsolve.render.files import Format
from dynsolve.solution.reports import report

ARM = """
gravity: [0, -g, 0]
dh: [{theta: q2*, a: l1}, {theta: q1*, a: l2}]
masses: [{mass: m1, link: 1}, {mass: m2, link: 2}]
"""


def text(problem: str) -> str:
    return report(dynsolve.solve(problem), Format.TEXT).decode()


def test_the_rows_of_accelerations_have_the_names_of_their_coordinates() -> None:
    friction = "friction: {q1: {viscous: f, coulomb: c}}\n"
    told = text(f"{ARM}{friction}find: [qdd_forward]\n")
    assert 0 < told.index("d₂₂ b₁ - d₁₂ b₂") < told.index("d₁₁ b₂ - d₁₂ b₁")
    assert "(2q̇₂ q̇₁ + q̇₁²)" in told[told.index("b₁ = ") : told.index("b₂ = ")]


def test_a_row_in_rates_is_no_gradient() -> None:
    of_both = f"{ARM}constraints: [tip.y, {{rates: q1' + q2'}}]\nfind: [Ac]\n"
    steps = {step.id: step for step in dynsolve.solve(of_both).steps}
    assert to_unicode(steps["Ac"].formula) == "A_c q̇ = 0"


def test_only_what_motors_do_not_hold_must_be_in_balance() -> None:
    told = text(f"{ARM}passive: [q1]\ninputs: given\nfind: [equilibria]\n")
    assert "g₂ = " in told and "⎤ = 0" not in told


def test_a_matrix_has_its_own_assumptions_and_the_conditions_of_its_verdict() -> None:
    told = text(
        "coordinates: {q1: revolute, q2: revolute}\n"
        "candidates: {A: [[a, 0], [0, b]], B: [[c, d], [d, c]]}\n"
        "assume: {A: [a > 0, b > 0], B: [c > 0]}\n"
    )
    assert "Assumed of A: a > 0 and b > 0. Assumed of B: c > 0." in " ".join(told.split())
    assert "B: it can be an inertia matrix exactly if " in told


STATED = f"""{ARM}linearize: {{q1: 0, q2: 90deg}}
forces: [{{link: 2, at: tip, force: [0, -F, 0]}}]
velocity: [vx, vy]
state: {{q1: 30deg, q2: 0, q1': w}}
"""


def test_a_state_is_given_where_something_is_asked_for_there() -> None:
    without_force = "".join(line for line in STATED.splitlines(keepends=True) if "forces" not in line)
    alone = " ".join(text(f"{without_force}find: [D]\n").split())
    assert "linearized" not in alone and "The state" not in alone
    linear = " ".join(text(f"{STATED}find: [linear_A]\n").split())
    assert "To be linearized at q₁ = 0, q₂ = 90°." in linear and "The equilibrium:" not in linear


def test_a_state_is_told_once_in_a_section_and_without_rates_at_rest() -> None:
    told = " ".join(text(f"{STATED}find: [Q, tau_static, qd, nullspace]\n").split())
    assert told.count("The state is") == 2
    assert "There is only one force. The state is q₁ = 30°, q₂ = 0. " in told


def test_a_number_that_is_never_0_stands_for_no_equation() -> None:
    """A block on a wedge, held together by a rod: x + s = c, and only gravity along the wedge is left."""
    told = text(
        "gravity: [0, -g, 0]\n"
        "model:\n"
        "  coordinates: {x: prismatic, s: prismatic}\n"
        "  bodies: [{mass: M, at: [x, 0, 0]}, {mass: m, at: [x + s*cos(beta), -s*sin(beta), 0]}]\n"
        "constraints: [x + s - c]\nfind: [equilibria]\n"
    )
    assert "1 = 0" not in told and "x + s = 0" not in told
    assert "Where sin(β) = 0, the equilibria are where x = c - s." in " ".join(told.split())
