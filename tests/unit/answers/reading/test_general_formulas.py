"""General formulas of redundant and constrained robots: names of matrices, which answer nothing alone."""

from __future__ import annotations

import pytest

from dynsolve.answers.judge import check
from dynsolve.answers.reading.files import read_submission
from dynsolve.answers.verdict import Submission
from dynsolve.notation.unicode import to_unicode
from dynsolve.problem import load, read_problem
from dynsolve.problem.reader import find

LINE = read_problem("""
gravity: none
dh: [{theta: q1* + 90deg, alpha: 90deg}, {d: q2*}]
masses: [{mass: m, link: 2, center: origin}]
constraints: [tip.x - k]
find: [D, Cqd, Ac, lambda]
""")
SLIDER = read_problem("""
gravity: none
model: {coordinates: {x: prismatic, y: prismatic}, bodies: [{mass: m, at: [x, y, 0]}]}
passive: [y]
constraints: [x - y]
find: [lambda]
""")


def report(text: str) -> Submission:
    return read_submission(LINE, f"$${text}$$", "report.md")


@pytest.mark.parametrize("text", [
    r"J^\# = J^T (J J^T)^{-1}",
    r"J^{\dagger} = J^T (J J^T)^{-1}",
    r"J^+ = J^T (J J^T)^{-1}",
    r"J^{+} = J^T (J J^T)^{-1}",
    r"J_W^{\#} = J^T (J J^T)^{-1}",
    r"\bar{J} = M^{-1} J^T (J M^{-1} J^T)^{-1}",
    r"A_M^{\#} = M^{-1} A^T (A M^{-1} A^T)^{-1}",
    r"\lambda = (A_M^{\#})^T (c - \tau) - (A M^{-1} A^T)^{-1} \dot A \dot q",
    r"\ddot q = (I - A_M^\# A) M^{-1} (\tau - c)",
    r"M \ddot q + c = \tau + A^T \lambda",
])  # fmt: skip
def test_names_of_pseudo_inverses_are_left_alone(text: str) -> None:
    found = report(text)
    assert found.answers == found.not_recognized == ()
    assert len(found.left_alone) == 1


def test_a_pseudo_inverse_that_is_written_out_stands_for_its_value() -> None:
    found = report(r"J^\# = \begin{bmatrix} m & 0 \\ 0 & m \end{bmatrix}, \quad D = J^\#")
    (answer,) = found.answers
    assert answer.node is not None
    assert to_unicode(answer.node) == "[[m, 0], [0, m]]"


@pytest.mark.parametrize(
    ("value", "expected"), [("m F", "[[m f1]]"), ("u m", "[[f1 m]]"), ("m F_2", "[[m f2]]")]
)
def test_letters_of_what_drives_are_forces_in_the_multipliers(value: str, expected: str) -> None:
    (answer,) = read_submission(SLIDER, rf"$$\lambda = {value}$$", "report.md").answers
    assert answer.node is not None
    assert to_unicode(answer.node) == expected


def test_forces_in_a_formula_of_the_multipliers_need_not_be_given() -> None:
    text = r"""
    $$D = \begin{bmatrix} m q_2^2 & 0 \\ 0 & m \end{bmatrix}, \quad
      c(q, \dot q) = \begin{bmatrix} 2 m q_2 \dot q_1 \dot q_2 \\ -m q_2 \dot q_1^2 \end{bmatrix}$$
    $$A = \begin{bmatrix} -q_2 s_1 & c_1 \end{bmatrix}, \quad
      \dot A = \begin{bmatrix} -\dot q_2 s_1 - q_2 c_1 \dot q_1 & -s_1 \dot q_1 \end{bmatrix}$$
    $$\lambda = (A D^{-1} A^T)^{-1} (A D^{-1} (c - u) - \dot A \dot q)$$
    """
    judged = check(LINE, read_submission(LINE, text, "report.md"))
    assert {answer.name: str(answer.verdict) for answer in judged.answers}["lambda"] == "correct"


FORWARD = read_problem("""
gravity: none
model: {coordinates: {x: prismatic, y: prismatic}, bodies: [{mass: m, at: [x, y, 0]}]}
passive: [y]
find: [qdd_forward]
""")


@pytest.mark.parametrize("text", [
    r"$$\ddot x = \frac{u}{m}$$ $$\ddot y = 0$$",
    r"$$\ddot x = F/m, \quad \ddot y = 0$$",
    r"$$\ddot q = \begin{bmatrix} \tau/m \\ 0 \end{bmatrix}$$",
    r"$$\ddot q = \frac{1}{m}\begin{bmatrix} f_1 \\ 0 \end{bmatrix}$$",
])  # fmt: skip
def test_accelerations_are_given_one_by_one_or_as_a_vector(text: str) -> None:
    (answer,) = check(FORWARD, read_submission(FORWARD, text, "report.md")).answers
    assert (answer.name, str(answer.verdict)) == ("qdd_forward", "correct")


COUPLED = read_problem("""
gravity: none
model: {coordinates: {x: prismatic, y: prismatic}, D: [[m1 + m2, m2], [m2, m2 + m3]]}
find: [D, qdd_forward]
""")


def test_accelerations_in_the_entries_of_the_inertia_matrix_are_no_derivatives() -> None:
    text = r"""
$$D = \begin{bmatrix} m_1 + m_2 & m_2 \\ m_2 & m_2 + m_3 \end{bmatrix}$$
$$\Delta = m_1 m_2 + m_1 m_3 + m_2 m_3$$

$$\ddot x = \frac{d_{22} f_1 - d_{12} f_2}{\Delta}, \quad \ddot y = \frac{d_{11} f_2 - d_{12} f_1}{\Delta}$$
"""
    answers = check(COUPLED, read_submission(COUPLED, text, "report.md")).answers
    assert [str(answer.verdict) for answer in answers] == ["correct", "correct"]


def test_an_acceleration_alone_is_listed() -> None:
    found = read_submission(FORWARD, r"$$\ddot x = u/m$$", "report.md")
    assert found.answers == ()
    assert len(found.not_recognized) == 1


@pytest.mark.parametrize("text", [
    r"$$\tau = M(q) \ddot q + c(q, \dot q) + g(q)$$",
    r"$$M(q) \ddot q = \tau - c(q, \dot q) - g(q)$$",
    r"Near the equilibrium $q_1 = q_2 = 0$ the pendulum is slow.",
])  # fmt: skip
def test_what_is_called_with_the_coordinates_is_no_parameter(text: str) -> None:
    found = read_submission(load(find("crane")), text, "report.md")
    assert found.answers == found.not_recognized == found.configurations == ()
