"""A and B of the equations near an equilibrium, read from files as students write them."""

from __future__ import annotations

from pathlib import Path

import pytest

import dynsolve

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
