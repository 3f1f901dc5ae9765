"""Answers to models without a table: read, judged with follow-through, typical slips told."""

from __future__ import annotations

import pytest

from tests.unit.answers.hands import Text, codes, judge, judged, verdicts

CART = """
gravity: [0, -g, 0]
model:
  coordinates: {x: prismatic, theta: revolute}
  bodies:
    - {mass: M, at: [x, 0, 0]}
    - {mass: m, at: [x + l*sin(theta), l*cos(theta), 0], turn: theta, inertia: {zz: J}}
"""
GIVEN = """
model:
  coordinates: {q1: prismatic, q2: revolute}
  D: [[a1, a2*sin(q2)], [a2*sin(q2), a3]]
"""

RIGHT: dict[str, Text] = {
    "rc2": [["x + l*sin(theta)"], ["l*cos(theta)"], ["0"]],
    "Jv2": [["1", "l*cos(theta)"], ["0", "-l*sin(theta)"], ["0", "0"]],
    "v2": [["x_dot + l*cos(theta)*theta_dot"], ["-l*sin(theta)*theta_dot"], ["0"]],
    "w2": [["0"], ["0"], ["theta_dot"]],
    "Kw2": "J*theta_dot^2/2",
    "Kv2": "m*(x_dot^2 + 2*l*cos(theta)*x_dot*theta_dot + l^2*theta_dot^2)/2",
    "P": "m*g*l*cos(theta)",
    "f1": "(M + m)*x_ddot + m*l*(cos(theta)*theta_ddot - sin(theta)*theta_dot^2)",
    "tau2": "m*l*cos(theta)*x_ddot + (m*l^2 + J)*theta_ddot - m*g*l*sin(theta)",
    "D": [["M + m", "m*l*cos(theta)"], ["m*l*cos(theta)", "m*l^2 + J"]],
    "g": [["0"], ["-m*g*l*sin(theta)"]],
}


def test_right_answers_are_correct() -> None:
    assert set(verdicts(judge(CART, RIGHT)).values()) <= {"correct", "missing"}


def test_what_follows_from_an_energy_without_the_coupling_is_followed() -> None:
    report = judge(
        CART,
        {
            "K": "M*x_dot^2/2 + m*(x_dot^2 + l^2*theta_dot^2)/2 + J*theta_dot^2/2",
            "D": [["M + m", "0"], ["0", "m*l^2 + J"]],
            "C": [["0", "0"], ["0", "0"]],
        },
    )
    found = {a.name: a for a in report.answers}
    assert [str(found[name].verdict) for name in ("K", "D", "C")] == ["wrong", "follows", "follows"]
    assert found["D"].follows_from == ("K",)


SLIPS: dict[str, tuple[str, Text, str]] = {
    "gravity's sign": ("P", "-m*g*l*cos(theta)", "gravity_sign"),
    "no rotation": (
        "K",
        "M*x_dot^2/2 + m*(x_dot^2 + 2*l*cos(theta)*x_dot*theta_dot + l^2*theta_dot^2)/2",
        "rotation_missing",
    ),
    "the sum of the energies": (
        "L",
        "M*x_dot^2/2 + m*(x_dot^2 + 2*l*cos(theta)*x_dot*theta_dot + l^2*theta_dot^2)/2 + J*theta_dot^2/2"
        " + m*g*l*cos(theta)",
        "lagrangian_sum",
    ),
}


@pytest.mark.parametrize("name", SLIPS)
def test_a_slip_is_told(name: str) -> None:
    answer, text, code = SLIPS[name]
    found = judged(CART, answer, text)
    assert str(found.verdict) == "wrong"
    assert code in codes(found)


FACTORIZATIONS: dict[str, list[list[str]]] = {
    "of Christoffel": [["0", "a2*cos(q2)*q2_dot"], ["0", "0"]],
    "another one": [["q2_dot", "a2*cos(q2)*q2_dot - q1_dot"], ["0", "0"]],
}


@pytest.mark.parametrize("name", FACTORIZATIONS)
def test_a_factorization_is_right_where_c_qd_is(name: str) -> None:
    """Sapienza Robotics 2, midterm 29 April 2019, exercise 4a, (13) and (14)."""
    assert str(judged(GIVEN, "C", FACTORIZATIONS[name]).verdict) == "correct"
    wrong = [[f"2*({entry})" for entry in row] for row in FACTORIZATIONS[name]]
    assert str(judged(GIVEN, "C", wrong).verdict) == "wrong"


CONSTANT = """
model:
  coordinates: {x: prismatic, y: prismatic, z: prismatic}
  D: [[m, 0, 0], [0, m, 0], [0, 0, m]]
"""
OTHERS: dict[str, tuple[list[list[str]], str]] = {
    "a cross product": (
        [["0", "z_dot", "-y_dot"], ["-z_dot", "0", "x_dot"], ["y_dot", "-x_dot", "0"]],
        "with which Ḋ - 2C is skew-symmetric",
    ),
    "a row": (
        [["y_dot", "-x_dot", "0"], ["0", "0", "0"], ["0", "0", "0"]],
        "with which Ḋ - 2C is not skew-symmetric",
    ),
}


@pytest.mark.parametrize("name", OTHERS)
def test_of_another_factorization_it_is_said_whether_it_is_skew(name: str) -> None:
    C, note = OTHERS[name]
    answer = judged(CONSTANT, "C", C)
    assert str(answer.verdict) == "correct"
    assert any(note in one for one in answer.notes)
