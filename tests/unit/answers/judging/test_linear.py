"""A and B of the equations near an equilibrium, read from files as students write them."""

from __future__ import annotations

from pathlib import Path
from unicodedata import normalize

import pytest

import dynsolve
from dynsolve.answers.judging.state_order import IN_ORDER
from tests.unit.answers.hands import judge, verdicts

POLE = """
gravity: [0, -g, 0]
model:
  coordinates: {x: prismatic, theta: revolute}
  bodies: [{mass: M, at: [x, 0, 0]}, {mass: m, at: [x + l*sin(theta), l*cos(theta), 0]}]
passive: [theta]
linearize: {x: 0, theta: 0}
find: [D, linear_A, linear_B]
"""
ELASTIC = """
gravity: [0, -g, 0]
base: Rz(-90deg)
dh: [{theta: q1*, a: l}]
masses: [{mass: M, link: 1, center: {near: [L, 0, 0]}, inertia: {zz: I}}]
motors: [{turns: q2*, inertia: J}]
springs: [{stiffness: k, of: q1 - q2}]
passive: [q1]
linearize: {q1: 0, q2: 0}
find: [D, equilibria, linear_A, linear_B]
"""
"""Spong, Hutchinson, Vidyasagar (2006), chapter 8: a link with a flexible joint."""

MOTION = r"\begin{bmatrix} 0 & 0 & 1 & 0 \\ 0 & 0 & 0 & 1 \\ "
POLE_ROWS = r"0 & -\frac{mg}{M} & 0 & 0 \\ 0 & \frac{(M+m)g}{Ml} & 0 & 0 \end{bmatrix}"
ELASTIC_ROWS = (
    r"-\frac{MgL + k}{I + ML^2} & \frac{k}{I + ML^2} & 0 & 0 \\"
    r" \frac{k}{J} & -\frac{k}{J} & 0 & 0 \end{bmatrix}"
)


@pytest.mark.parametrize(
    ("problem", "rows", "expected"),
    [
        (POLE, POLE_ROWS, "correct"),
        (POLE, POLE_ROWS.replace("(M+m)g", "(M+m)"), "wrong"),
        (POLE, POLE_ROWS.replace("-", ""), "wrong"),
        (ELASTIC, ELASTIC_ROWS, "correct"),
        (ELASTIC, ELASTIC_ROWS.replace("MgL + k", "MgL - k"), "wrong"),
    ],
)
def test_a_state_matrix(tmp_path: Path, problem: str, rows: str, expected: str) -> None:
    file = tmp_path / "report.md"
    file.write_text(f"$$A = {MOTION}{rows}$$\n")
    verdicts = {a.name: str(a.verdict) for a in dynsolve.check(problem, file).answers}
    assert verdicts["linear_A"] == expected


@pytest.mark.parametrize(
    ("value", "name", "expected"),
    [
        (r"\begin{bmatrix} 0 \\ 0 \\ 0 \\ \frac{1}{J} \end{bmatrix}", "linear_B", "correct"),
        (r"\begin{bmatrix} 0 & 0 & 0 & 1/J \end{bmatrix}^T", "linear_B", "correct"),
        (r"\begin{bmatrix} 0 \\ 0 \\ \frac{1}{J} \\ 0 \end{bmatrix}", "linear_B", "wrong"),
        (r"\begin{bmatrix} I + ML^2 & 0 \\ 0 & J \end{bmatrix}", "D", "correct"),
    ],
)
def test_the_letter_b_is_what_its_size_says(tmp_path: Path, value: str, name: str, expected: str) -> None:
    """Books write B for the matrix of the inputs, and for the inertia matrix."""
    file = tmp_path / "report.md"
    file.write_text(f"$$B = {value}$$\n")
    given = {a.name: str(a.verdict) for a in dynsolve.check(ELASTIC, file).answers if a.given}
    assert given == {name: expected}


CART = """
gravity: [0, -g, 0]
model:
  coordinates: {x: prismatic, theta: revolute}
  bodies: [{mass: M, at: [x, 0, 0]}, {mass: m, at: [x + l*sin(theta), l*cos(theta), 0]}]
friction: {x: b}
passive: [theta]
linearize: {x: 0, theta: 0}
find: [linear_A, linear_B]
"""
A_KEY = [
    ["0", "0", "1", "0"],
    ["0", "0", "0", "1"],
    ["0", "-m*g/M", "-b/M", "0"],
    ["0", "(M + m)*g/(M*l)", "b/(M*l)", "0"],
]
B_KEY = ["0", "0", "1/M", "-1/(M*l)"]
PAIRS, RATES_FIRST, TURNED = (0, 2, 1, 3), (2, 3, 0, 1), (1, 0, 3, 2)


def in_order(order: tuple[int, ...], slip: str = "b/(M*l)") -> tuple[list[list[str]], list[list[str]]]:
    """A and B with the state in an order, b/(M l) replaced."""
    A = [[A_KEY[i][j] if (i, j) != (3, 2) else slip for j in order] for i in order]
    return A, [[B_KEY[i]] for i in order]


@pytest.mark.parametrize(
    ("order", "words"),
    [
        (PAIRS, "(x, ẋ, θ, θ̇)"),
        (RATES_FIRST, "(ẋ, θ̇, x, θ)"),
        (TURNED, "(θ, x, θ̇, ẋ)"),
    ],
)
def test_another_order_of_the_state_is_right(order: tuple[int, ...], words: str) -> None:
    A, B = in_order(order)
    for answers in ({"linear_A": A, "linear_B": B}, {"linear_A": A}):
        found = {a.name: a for a in judge(CART, answers).answers if a.given}
        assert {str(one.verdict) for one in found.values()} == {"correct"}
        for one in found.values():
            assert normalize("NFC", IN_ORDER.format(words)) in [normalize("NFC", note) for note in one.notes]


def test_the_matrices_have_one_order() -> None:
    A, B = in_order(PAIRS)
    for answers, expected in (
        ({"linear_B": B}, ["correct"]),
        ({"linear_A": A, "linear_B": in_order(TURNED)[1]}, ["correct", "wrong"]),
        ({"linear_A": A_KEY, "linear_B": B}, ["correct", "wrong"]),
        ({"linear_B": in_order(TURNED)[1]}, ["wrong"]),
    ):
        found = verdicts(judge(CART, answers))
        assert [found[name] for name in answers] == expected


def test_a_wrong_entry_is_told_in_the_order_in_which_it_stands() -> None:
    A, _ = in_order(PAIRS, slip="-b/(M*l)")
    wrong = next(a for a in judge(CART, {"linear_A": A}).answers if a.given)
    assert wrong.verdict == "wrong"
    told = "In the order (x, ẋ, θ, θ̇) of the state, it is wrong in (4, 2)."
    assert [normalize("NFC", one.message) for one in wrong.diagnosis] == [normalize("NFC", told)]
