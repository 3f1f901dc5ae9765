"""Equilibria and their stability: by hand, from exams, and against numbers."""

from __future__ import annotations

from dataclasses import replace

import pytest

import dynsolve
from dynsolve.derivation.equilibrium_check import Case, verify_equilibria
from dynsolve.derivation.rules import derive
from dynsolve.derivation.stability import Stability
from dynsolve.errors import VerificationError
from dynsolve.explain.forms import Forms
from dynsolve.explain.inverse_formulas import ConfigurationForms
from dynsolve.notation.tree import Symbol
from dynsolve.problem import read_problem
from tests.unit.answers.judging.test_equilibria import ARM, ELASTIC, FLAT, HELD, LIFT, MASSES, POLE


@pytest.mark.parametrize(
    ("problem", "equilibria"),
    [
        (ARM, [["cos(q1) = 0", "sin(q2) = 0"]]),
        (POLE, [["sin(theta) = 0"]]),
        (MASSES, [["q1 - q3 = 0", "q2 - q3 = 0"]]),  # Sapienza, Robotics 2, 28 October 2016: q1 = q2 = q3
        (ELASTIC, [["sin(q1) = 0", "q1 - q2 = 0"]]),
        (HELD, [["k*(q1 - q2) + m*g*l*sin(q1) = 0"]]),
        (LIFT, []),
        (FLAT, [[]]),
    ],
)
def test_by_hand(problem: str, equilibria: list[list[str]]) -> None:
    assert dynsolve.solve(problem).to_json()["results"]["equilibria"] == equilibria


def test_a_hanging_arm_is_stable_and_no_other() -> None:
    (points,) = dynsolve.solve(ARM).to_json()["results"]["equilibria_stability"]
    stable = [point for point in points if point["stability"] == "stable"]
    assert stable == [{"q1": "-pi/2", "q2": "0", "stability": "stable"}]
    assert len(points) == 4 and all(p["stability"] == "unstable" for p in points if p not in stable)


def test_a_pole_is_stable_below_wherever_the_cart_is() -> None:
    solution = dynsolve.solve(POLE)
    (points,) = solution.to_json()["results"]["equilibria_stability"]
    assert points == [
        {"theta": "0", "stability": "unstable"}, {"theta": "pi", "stability": "stable"},
    ]  # fmt: skip
    (step,) = (step for step in solution.steps if step.id == "equilibria_stability")
    assert "along which nothing changes" in str(step.concluding)


def test_an_elastic_joint_holds_below() -> None:
    (points,) = dynsolve.solve(ELASTIC).to_json()["results"]["equilibria_stability"]
    assert [point["stability"] for point in points] == ["stable", "unstable"]


def test_the_check_finds_what_is_wrong() -> None:
    robot = read_problem(ARM).robot
    values = derive(robot)
    g, shown = Forms(robot, values)("g"), ConfigurationForms(robot, values).equilibria
    (points,) = values["equilibria"].points
    right = Case(shown[0], points)
    verify_equilibria(robot, g, [right])
    with pytest.raises(VerificationError, match="missing"):
        verify_equilibria(robot, g, [])
    with pytest.raises(VerificationError, match="moves"):
        verify_equilibria(robot, g, [Case((shown[0][0],), ())])
    turned = tuple(replace(point, stability=Stability.STABLE) for point in points)
    with pytest.raises(VerificationError, match="stability"):
        verify_equilibria(robot, g, [Case(shown[0], turned)])
    assert Symbol("q1") not in shown[0]
