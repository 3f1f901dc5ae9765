"""The motion of the arm tells right results of the kinematics from wrong ones."""

from __future__ import annotations

from functools import cache

import pytest

import dynsolve
from dynsolve.derivation.rules import derive
from dynsolve.errors import VerificationError
from dynsolve.explain.forms import Forms
from dynsolve.notation.tree import Matrix, Negative, Node
from dynsolve.problem import read_problem
from dynsolve.questions.task.check import checked_names, verify_kinematics

RRP = """
base: {rotate: Rx(90deg), move: [0, 0, h]}
dh:
  - {theta: q1*, d: d1, a: l1, alpha: 90deg}
  - {theta: 2*q2* - q1*/2, a: l2, alpha: 30deg}
  - {d: q3*, alpha: beta}
points: {P: {link: 1, at: [x, y, 0]}, E: {link: 3, at: [0, 0, z]}}
find: [pP, vP, JvP, JwP, pE, vE, JvE, JwE, J_dot, r, Jr, Jr_dot]
"""
FREE = "task: [tip.x*E.z, P.y + 2*q1 - q3, sin(q1)*tip.z]\n"


@cache
def forms(text: str) -> tuple[object, dict[str, Node]]:
    robot = read_problem(text).robot
    values = derive(robot)
    made = Forms(robot, values)
    names = checked_names(robot, values.leading_to(robot.questions.asked))
    return robot, {name: made(name) for name in names}


TURNED = RRP.replace("[x, y, 0]", "[x, y, 0], in: link").replace("[0, 0, z]", "[0, 0, z], in: 2")


@pytest.mark.parametrize(
    "text",
    [RRP, RRP + FREE, TURNED, "convention: modified\n" + RRP + FREE, "convention: modified\n" + TURNED],
)
def test_what_is_derived_agrees(text: str) -> None:
    verify_kinematics(*forms(text))


def test_a_twist_agrees() -> None:
    verify_kinematics(*forms(RRP.replace(" r,", "") + "task: twist"))


@pytest.mark.parametrize("name", ["pP", "vE", "JvP", "JwE", "Jv_dot", "Jw_dot", "r", "Jr", "Jr_dot"])
def test_one_wrong_sign_is_found(name: str) -> None:
    robot, results = forms(RRP + FREE)
    matrix = results[name]
    assert isinstance(matrix, Matrix)
    rows = tuple(tuple(Negative(entry) for entry in row) for row in matrix.rows)
    with pytest.raises(VerificationError, match="differs from the motion of the arm"):
        verify_kinematics(robot, {**results, name: Matrix(rows)})


@pytest.mark.parametrize(
    "asked", ["r, Jr, det", "singular, inverse", "nullspace, rangespace, lost", "Jr_dot"]
)
def test_a_tip_that_never_moves_has_a_task_all_the_same(asked: str) -> None:
    arm = "gravity: none\ndh: [{theta: q1*, d: d1, alpha: 180deg}, {theta: q2*, d: d2}]\n"
    assert dynsolve.solve(f"{arm}find: [{asked}]\n").steps
