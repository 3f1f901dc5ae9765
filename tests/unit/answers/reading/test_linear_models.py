r"""Models that are written out as products of matrices: ẋ = A x + B u, and those of reference rates."""

from __future__ import annotations

import pytest

from dynsolve.answers.reading.files import read_submission
from dynsolve.problem import read_problem
from tests.unit.answers.reading.submissions import report

A = r"\begin{bmatrix} 0 & 0 & 1 & 0 \\ 0 & 0 & 0 & 1 \\ 0 & 0 & 0 & 0 \\ 0 & 0 & 0 & 0 \end{bmatrix}"
B = r"\begin{bmatrix} 0 \\ 0 \\ 1 \\ 0 \end{bmatrix}"
STATE = r"\begin{bmatrix} q_1 \\ q_2 \\ \dot q_1 \\ \dot q_2 \end{bmatrix}"


@pytest.mark.parametrize(("equation", "names"), [
    (rf"\dot x = {A} x + {B} u", ["linear_A", "linear_B"]),
    (rf"\delta\dot x = {A}\,\delta x + {B} F", ["linear_A", "linear_B"]),
    (rf"\frac{{d}}{{dt}}{STATE} = {A}{STATE} + {B} u", ["linear_A", "linear_B"]),
    (rf"\dot x = {A} x", ["linear_A"]),
    (rf"\dot x = {A} x - {B} u", []),
    (rf"\dot x = {B} u", []),
])  # fmt: skip
def test_the_matrices_of_a_linear_model_are_a_and_b(equation: str, names: list[str]) -> None:
    assert [answer.name for answer in report(f"$${equation}$$", stem="crane").answers] == names


ADAPTIVE = read_problem("""
gravity: none
model:
  coordinates: {q1: prismatic, q2: prismatic}
  bodies: [{mass: m1, at: [q1, 0, 0]}, {mass: m2, at: [q2, 0, 0]}]
friction: {q1: fv1, q2: fv2}
find: [Yr, a, friction]
""")
Y = r"\begin{bmatrix} \ddot q_{r1} & 0 \\ 0 & \ddot q_{r2} \end{bmatrix}"
PARAMETERS = r"\begin{bmatrix} m_1 \\ m_2 \end{bmatrix}"


@pytest.mark.parametrize(("equation", "names"), [
    (rf"Y_r = {Y}", ["Yr"]),
    (rf"Y(q, \dot q, \dot q_r, \ddot q_r) = {Y}", ["Yr"]),
    (rf"M(q) \ddot q_r + C(q, \dot q) \dot q_r = {Y}{PARAMETERS}", ["Yr", "a"]),
    (r"M \ddot q_r + C \dot q_r = Y_r a", []),
    (r"F_v \dot q = \begin{bmatrix} f_{v1} \dot q_1 \\ f_{v2} \dot q_2 \end{bmatrix}", ["friction"]),
])  # fmt: skip
def test_reference_rates_name_their_regressor(equation: str, names: list[str]) -> None:
    found = read_submission(ADAPTIVE, f"$${equation}$$", "report.md")
    assert [answer.name for answer in found.answers] == names
    assert found.not_recognized == ()
