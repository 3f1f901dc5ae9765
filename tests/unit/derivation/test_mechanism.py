"""Models without a table: motion of bodies by turns, and the check that shares no formula with it."""

from __future__ import annotations

import pytest

import dynsolve
from dynsolve.derivation.mechanism_check import HyperDual, cos, sin
from dynsolve.derivation.rules import derive
from dynsolve.derivation.verification import verify
from dynsolve.errors import VerificationError
from dynsolve.explain.forms import Forms
from dynsolve.problem import read_problem
from tests.support import assert_close, numbers, solve_json

TUMBLING = """
gravity: [g, 0, -g]
model:
  coordinates: {x: prismatic, phi: revolute, th: revolute, psi: revolute}
  bodies:
    - mass: m
      at: [x + l*sin(th)*cos(phi), l*sin(th)*sin(phi), l*cos(th)]
      turn:
        - {by: phi, about: [0, 0, 1]}
        - {by: 2*th - x/R, about: [3/5, 4/5, 0]}
        - {by: psi + phi/2, about: [0, 1, 0]}
      inertia: {xx: A, yy: B, zz: C, xy: F, xz: G, yz: H}
"""
GIVEN = "model:\n  coordinates: {r: prismatic, th: revolute}\n"
FORMS = {
    "D and P": "  D: [[m, 0], [0, m*r^2]]\n  P: -m*g*r*cos(th)\n",
    "K and P": "  K: m*(r'^2 + r^2*th'^2)/2\n  P: -m*g*r*cos(th)\n",
    "L": "  L: m*(r'^2 + r^2*th'^2)/2 + m*g*r*cos(th)\n",
}


def test_a_tumbling_body_is_verified() -> None:
    assert dynsolve.solve(TUMBLING).verification.max_relative_error < 1e-9


def test_the_textbook_s_energy_of_a_tumbling_body_is_that_along_its_own_axes() -> None:
    robot = read_problem(TUMBLING).robot
    values = derive(robot)
    w, tensor = values["w1"], values["I1"]
    assert values["Kw1"] * 2 == robot.ring.dot(w.entries, (tensor @ w).entries)


@pytest.mark.parametrize("form", FORMS)
def test_the_same_model_follows_from_all_that_may_be_given(form: str) -> None:
    of_bodies = f"gravity: [0, -g, 0]\n{GIVEN}  bodies: [{{mass: m, at: [r*sin(th), -r*cos(th), 0]}}]\n"
    names = "m g r th r_dot th_dot r_ddot th_ddot".split()
    state = dict(zip(names, (1.3, 9.8, 0.7, 0.4, -0.3, 1.1, 0.2, -0.6), strict=True))
    ours, wanted = (solve_json(text)["results"] for text in (GIVEN + FORMS[form], of_bodies))
    for name in ("K", "P", "L", "tau", "D", "C", "g"):
        assert_close(numbers(ours[name], state), numbers(wanted[name], state), name)


@pytest.mark.parametrize("text", [TUMBLING, GIVEN + FORMS["K and P"]])
def test_a_wrong_result_is_found(text: str) -> None:
    robot = read_problem(text).robot
    values = derive(robot)
    forms = Forms(robot, values)
    results = {name: forms(name) for name in ("D", "C", "g", "tau", "K", "P")}
    verify(robot, results, 2)
    for name in results:
        twice = values[name] + values[name]
        with pytest.raises(VerificationError, match=f"^{'Cqd' if name == 'C' else name} differs"):
            verify(robot, {**results, name: forms.of(twice)}, 2)


def test_numbers_for_parameters_go_into_positions_and_turns() -> None:
    valued = dynsolve.solve(TUMBLING).with_values(R=2, l="1/2", m=3)
    assert "R" not in str(valued.tau)
    assert valued.verification.max_relative_error < 1e-9


def test_hyper_dual_numbers_carry_two_derivatives() -> None:
    t = HyperDual(0.7, 1.0, 1.0)
    value = sin(t) * cos(t) / (t * t + 1.0)
    step = 1e-4

    def f(x: float) -> float:
        at = HyperDual(x)
        return (sin(at) * cos(at) / (at * at + 1.0)).value

    assert value.first == pytest.approx((f(0.7 + step) - f(0.7 - step)) / (2 * step), rel=1e-7)
    assert value.mixed == pytest.approx((f(0.7 + step) - 2 * f(0.7) + f(0.7 - step)) / step**2, rel=1e-5)
    assert (t**-2).mixed == pytest.approx((1.0 / (t * t)).mixed)


def test_a_body_that_turns_about_an_axis_without_a_moment_leaves_only_rounding() -> None:
    rod = """
gravity: none
model:
  coordinates: {p: revolute}
  bodies: [{mass: m, at: [0, 0, 0], turn: p, about: [0, -3, 4], inertia: {xx: A}}]
find: [D]
"""
    assert dynsolve.solve(rod).to_json()["results"]["D"] == [["0"]]
