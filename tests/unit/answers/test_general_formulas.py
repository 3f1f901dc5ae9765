"""Formulas of names alone count where what they need is given, and nothing else answers what is asked."""

from __future__ import annotations

import pytest

from tests.unit.answers.hands import checker

CART = """
gravity: [0, -g, 0]
model:
  coordinates: {x: prismatic, theta: revolute}
  bodies: [{mass: M, at: [x, 0, 0]}, {mass: m, at: [x + l*sin(theta), l*cos(theta), 0]}]
find: [D, C, g, tau]
"""
D = r"$$D = \begin{bmatrix} M + m & m l\cos\theta \\ m l\cos\theta & m l^2 \end{bmatrix}$$"
C = r"$$C = \begin{bmatrix} 0 & -m l\dot\theta\sin\theta \\ 0 & 0 \end{bmatrix}$$"
G = r"$$g = \begin{bmatrix} 0 \\ -m g l\sin\theta \end{bmatrix}$$"
TAU = r"$$\tau = D\ddot q + C\dot q + g$$"
TWICE = D.replace("m l^2", "2 m l^2")


@pytest.mark.parametrize(
    ("text", "tau"),
    [
        (D + C + G + TAU, "correct"),
        (TAU + D + C + G, "correct"),
        (D + C + G + TAU.replace("+ g", "- g"), "wrong"),
        (TWICE + C + G + TAU, "follows"),
        (TAU + TWICE + C + G, "follows"),
        (D + C + TAU, "missing"),
        (D + C + G + TAU + r"$$\tau_2 = 0$$", "missing"),
        (D + C + G, "missing"),
    ],
)
def test_the_torques_by_names_are_what_the_matrices_make_of_them(text: str, tau: str) -> None:
    one = checker(CART)
    report = one(one.reader(text, "report.md"))
    assert {answer.name: str(answer.verdict) for answer in report.answers}["tau"] == tau


def test_what_is_not_asked_for_stays_a_definition() -> None:
    one = checker(CART.replace(", tau]", "]"))
    report = one(one.reader(D + C + G + TAU, "report.md"))
    assert [answer.name for answer in report.answers] == ["D", "C", "g"]


def test_the_Jacobian_of_the_task_is_the_J_of_a_formula() -> None:
    one = checker(
        """
gravity: none
dh: [{theta: q1*, a: l1}, {theta: q2*, a: l2}]
masses: [{mass: m1, link: 1}, {mass: m2, link: 2}]
task: [tip.x, tip.y]
find: [Jr, D, Lambda]
"""
    )
    rows = r"-l_1 s_1 - l_2 s_{12} & -l_2 s_{12} \\ l_1 c_1 + l_2 c_{12} & l_2 c_{12}"
    text = rf"$$J = \begin{{bmatrix}} {rows} \end{{bmatrix}}$$ $$\Lambda = (J M^{{-1}} J^T)^{{-1}}$$"
    found = {answer.name: answer for answer in one(one.reader(text, "report.md")).answers}
    assert str(found["Jr"].verdict) == "correct"
    assert found["Lambda"].notes == ("D stands in it and is given nowhere: this is a definition",)
