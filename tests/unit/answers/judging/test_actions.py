"""Answers on friction, springs and rotors: what is right, what follows, what may be written otherwise."""

from __future__ import annotations

import pytest

from dynsolve.answers.judge import check
from dynsolve.answers.reading.files import FileReader
from dynsolve.problem import read_problem
from tests.unit.answers.hands import judge, judged, verdicts

ARM = """
gravity: [0, -g, 0]
dh: [{theta: q1*, a: l}]
masses: [{mass: m, link: 1}]
friction: {q1: {viscous: fv, coulomb: fc}}
springs: [{stiffness: k, of: q1, rest: delta}]
motors: [{turns: q1, inertia: Im, ratio: kr}]
forces: [{link: 1, force: [0, F, 0]}]
find: [tau, friction, Ps, Km]
"""
LEFT = "(m*l^2 + Im*kr^2)*q1_ddot + m*g*l*cos(q1) + k*(q1 - delta)"


@pytest.mark.parametrize(
    ("name", "text", "verdict"),
    [
        ("friction", "fv*q1_dot + fc*sgn(q1_dot)", "correct"),
        ("friction", "fv*q1_dot - fc*sgn(-q1_dot)", "correct"),
        ("friction", "fv*q1_dot + fc*sgn(3*q1_dot)", "correct"),
        ("friction", "fv*q1_dot + fc", "wrong"),
        ("friction", "fv*q1_dot + fc*sgn(q1)", "wrong"),
        ("friction1", "fv*q1_dot + fc*sgn(q1_dot)", "correct"),
        ("Ps", "k*(delta - q1)^2/2", "correct"),
        ("Km", "Im*kr^2*q1_dot^2/2", "correct"),
        ("g", "m*g*l*cos(q1) + k*(q1 - delta)", "correct"),
        ("g", "m*g*l*cos(q1)", "wrong"),
    ],
)
def test_verdicts(name: str, text: str, verdict: str) -> None:
    vector = name in ("friction", "g")
    assert judged(ARM, name, [[text]] if vector else text).verdict == verdict


@pytest.mark.parametrize(
    ("text", "verdict", "note"),
    [
        (LEFT + " + fv*q1_dot + fc*sgn(q1_dot)", "correct", ""),
        (LEFT + " + fv*q1_dot + fc*sgn(q1_dot) - F*l*cos(q1)", "correct", "moved over"),
        (LEFT + " + fv*q1_dot + fc*sgn(q1_dot) + F*l*cos(q1)", "wrong", ""),
    ],
)
def test_forces_from_outside_may_be_moved_over(text: str, verdict: str, note: str) -> None:
    found = judged(ARM, "tau1", text)
    assert found.verdict == verdict
    assert note in "".join(found.notes)


@pytest.mark.parametrize(
    ("name", "text", "verdict"),
    [
        ("P", "m*g*l*sin(q1) + k*q1^2/2 - k*delta*q1", "correct"),
        ("P", "m*g*l*sin(q1) + k*(q1 - delta)^2/2 + k", "correct"),
        ("P", "m*g*l*sin(q1) + k*(q1 - delta)^2/2 + delta", "wrong"),
        ("P", "m*g*l*sin(q1) + k*(q1 - delta)^2/2 + m*k", "wrong"),
        ("P", "m*g*l*sin(q1) + k*(q1 - delta)^2/2 + 1", "wrong"),
        ("P", "m*g*l*sin(q1) + k*q1^2/2", "wrong"),
    ],
)
def test_a_constant_of_springs_is_free(name: str, text: str, verdict: str) -> None:
    assert judged(ARM, name, text).verdict == verdict


def test_forces_follow_from_friction_that_is_wrong() -> None:
    answers = {"friction": [["-fv*q1_dot - fc*sgn(q1_dot)"]], "tau1": LEFT + " - fv*q1_dot - fc*sgn(q1_dot)"}
    assert verdicts(judge(ARM, answers)) | {"tau": ""} == {
        "friction": "wrong", "tau1": "follows", "tau": "", "Ps": "missing", "Km": "missing",
    }  # fmt: skip


def test_what_is_left_of_the_forces_is_less_the_students_own_friction() -> None:
    """C q̇ from a wrong τ: with friction of one's own, and with the key's."""
    tau = LEFT + " + 2*fv*q1_dot"
    own = {"friction": [["2*fv*q1_dot"]], "tau1": tau, "Cqd": [["0"]]}
    assert verdicts(judge(ARM, own))["Cqd"] == "correct"
    none = {"tau1": tau, "Cqd": [["fv*q1_dot - fc*sgn(q1_dot)"]]}
    assert verdicts(judge(ARM, none))["Cqd"] == "follows"


@pytest.mark.parametrize(
    "text",
    [
        r"$$\tau_f = f_v \dot{q}_1 + f_c \operatorname{sgn}(\dot{q}_1)$$",
        r"$$\boldsymbol{\tau}_f = f_v \dot q_1 + f_c \mathrm{sgn}(\dot q_1)$$",
        "friction = fv*q1' + fc*sign(q1')",
        "friction = fv*q1' + fc*q1'/abs(q1')",
        "friction = fv*q1' + fc*Abs(q1')/q1'",
        r"$$\tau_f = f_v \frac{|\dot{q}_1|^2}{\dot{q}_1} + f_c \frac{\dot{q}_1}{|\dot{q}_1|}$$",
        r"$$\tau_f = f_v \dot{q}_1 + f_c \frac{\left|\dot{q}_1\right|}{\dot{q}_1}$$",
    ],
)
def test_the_sign_of_a_rate_is_read_as_people_write_it(text: str) -> None:
    problem = read_problem(ARM, "own.yaml")
    found = verdicts(check(problem, FileReader(problem)(text.encode(), "report.md")))
    assert found["friction"] == "correct"


@pytest.mark.parametrize("text", ["friction = fv*abs(q1') + fc*sgn(q1')", "friction = fv*q1' + fc*abs(q1')"])
def test_an_absolute_value_is_no_rate_and_no_sign(text: str) -> None:
    problem = read_problem(ARM, "own.yaml")
    found = verdicts(check(problem, FileReader(problem)(text.encode(), "report.md")))
    assert found["friction"] == "wrong"


CART = """
gravity: [0, -g, 0]
model:
  coordinates: {x: prismatic, theta: revolute}
  bodies: [{mass: M, at: [x, 0, 0]}, {mass: m, at: [x + l*sin(theta), l*cos(theta), 0]}]
passive: [theta]
find: [tau]
"""


@pytest.mark.parametrize(
    ("text", "verdict", "note"),
    [
        ("m*l*x''*cos(theta) + m*l^2*theta'' - m*g*l*sin(theta) = 0", "correct", ""),
        ("x''*cos(theta) + l*theta'' - g*sin(theta) = 0", "correct", "factor"),
        ("theta'' + x''*cos(theta)/l = g*sin(theta)/l", "correct", "factor"),
        ("x''*cos(theta) + l*theta'' + g*sin(theta) = 0", "wrong", ""),
        ("x''*cos(theta) = g*sin(theta)", "wrong", ""),
        ("tau2 = x''*cos(theta) + l*theta'' - g*sin(theta)", "wrong", ""),
    ],
)
def test_the_equation_of_a_passive_coordinate_may_be_multiplied_by_a_factor(
    text: str, verdict: str, note: str
) -> None:
    cart = read_problem(CART, "cart.yaml")
    report = check(cart, FileReader(cart)(f"$${text}$$", "report.md"))
    found = next(answer for answer in report.answers if answer.name == "tau2")
    assert found.verdict == verdict
    assert note in "".join(found.notes)


def test_friction_may_be_counted_in_c() -> None:
    found = judged(ARM, "C", [["fv"]])
    assert found.verdict == "wrong"
    viscous = ARM.replace(", coulomb: fc", "")
    found = judged(viscous, "C", [["fv"]])
    assert found.verdict == "correct"
    assert "friction" in "".join(found.notes)
    assert judged(viscous, "Cqd", [["-fv*q1_dot"]]).verdict == "wrong"
