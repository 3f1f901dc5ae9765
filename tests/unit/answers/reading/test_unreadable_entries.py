"""A matrix with an entry that cannot be read: the others are judged, and the whole by all of them."""

from __future__ import annotations

import pytest

from dynsolve.answers.judge import Checker
from dynsolve.answers.reading.files import read_submission
from dynsolve.problem import load
from dynsolve.problem.reader import find

ARM = Checker(load(find("planar-2r")))
G1 = r"(m_1 l_{c1} + m_2 l_1) g \cos(q_1) + m_2 l_{c2} g \cos(q_1 + q_2)"
G2 = r"m_2 l_{c2} g \cos(q_1 + q_2)"
FORMS = [
    r"$$g = \begin{{bmatrix}} {0} \\ {1} \end{{bmatrix}}$$",
    r"$$g = \left[\begin{{array}}{{c}} {0} \\ {1} \end{{array}}\right]$$",
    r"$$g = [{0}, {1}]$$",
    r"$$g = [{0}; {1}]$$",
]


def verdicts(text: str, suffix: str = "md") -> dict[str, str]:
    report = ARM(read_submission(ARM.problem, text, f"report.{suffix}"))
    return {answer.name: answer.verdict.value for answer in report.answers}


@pytest.mark.parametrize("form", FORMS)
@pytest.mark.parametrize(("entries", "expected"), [
    ((G1, rf"{G2} \kappa"), ("unreadable", "correct", "unreadable")),
    ((rf"{G1} + Q_7", G2), ("unreadable", "unreadable", "correct")),
    ((rf"2 {G2}", rf"{G2} \kappa"), ("wrong", "wrong", "unreadable")),
])  # fmt: skip
def test_a_vector(form: str, entries: tuple[str, str], expected: tuple[str, ...]) -> None:
    found = verdicts(form.format(*entries))
    assert (found["g"], found["g1"], found["g2"]) == expected


def test_a_matrix_of_an_answer_file() -> None:
    D = "[[m1*lc1^2 + m2*(l1^2 + lc2^2 + 2*l1*lc2*cos(q2)) + I1 + I2, kappa], [kappa, {}]]"
    found = verdicts(f"answers:\n  D: {D.format('m2*lc2^2 + I2')}\n", "yaml")
    assert (found["D"], found["d11"], found["d12"], found["d22"]) == (
        "unreadable", "correct", "unreadable", "correct",
    )  # fmt: skip
    assert verdicts(f"answers:\n  D: {D.format('m2*lc2^2')}\n", "yaml")["D"] == "wrong"


@pytest.mark.parametrize("value", [r"\kappa \begin{bmatrix} 1 \\ 0 \end{bmatrix}", r"[\kappa, \kappa]"])
def test_where_no_entry_can_be_read(value: str) -> None:
    found = verdicts(f"$$g = {value}$$")
    assert found["g"] == "unreadable" and "g1" not in found


def test_names_beside_an_entry_that_cannot_be_read() -> None:
    matrix = r"$$D = \begin{bmatrix} d_{11} & d_{12} \\ d_{12} & \delta \end{bmatrix}$$"
    entries = r"$d_{11} = m_1 l_{c1}^2$ und $d_{12} = m_2 (l_{c2}^2 + l_1 l_{c2} \cos q_2) + I_2$"
    found = verdicts(f"{matrix} mit {entries}")
    assert (found["D"], found["d11"], found["d12"], found["d22"]) == (
        "wrong",
        "wrong",
        "correct",
        "unreadable",
    )
