"""A matrix that names entries which have equations of their own: these are meant, and no cosine."""

from __future__ import annotations

import pytest

from dynsolve.answers.judge import Checker
from dynsolve.answers.reading.files import read_submission
from dynsolve.problem import load
from dynsolve.problem.reader import find

ARM = Checker(load(find("planar-2r")))  # C as every textbook has it, h = -m₂ l₁ l_c2 s₂
ENTRIES = {
    "11": r"-m_2 l_1 l_{c2} \sin(q_2) \dot q_2",
    "12": r"-m_2 l_1 l_{c2} \sin(q_2) (\dot q_1 + \dot q_2)",
    "21": r"m_2 l_1 l_{c2} \sin(q_2) \dot q_1",
}
LINES = {
    "11": "-m2*l1*lc2*sin(q2)*dq2",
    "12": "-m2*l1*lc2*sin(q2)*(dq1 + dq2)",
    "21": "m2*l1*lc2*sin(q2)*dq1",
}
MATRIX = r"$$C = \begin{bmatrix} c_{11} & c_{12} \\ c_{21} & 0 \end{bmatrix}$$"


def displays(values: dict[str, str]) -> str:
    return "\n\n".join(f"$$c_{{{index}}} = {value}$$" for index, value in values.items())


def inline(values: dict[str, str], lead: str, join: str) -> str:
    *first, last = (f"$C_{{{index}}} = {value}$" for index, value in values.items())
    return f"{lead} {', '.join(first)} {join} {last}."


def plain(values: dict[str, str]) -> str:
    return "\n".join(f"c{index} = {value};" for index, value in values.items())


LATEX = [
    lambda v: f"{MATRIX}\n\n{displays(v)}",
    lambda v: f"{displays(v)}\n\n{MATRIX}",
    lambda v: f"{MATRIX}\n{inline(v, 'mit', 'und')}",
    lambda v: f"{MATRIX}\n{inline(v, 'der', 'og')}",
    lambda v: f"{MATRIX[:-2]}, \\quad {', '.join(f'c_{{{i}}} = {e}' for i, e in v.items())}$$",
]
PLAIN = [
    lambda v: f"{plain(v)}\nC = [c11, c12; c21, 0];",
    lambda v: f"C = [c11 c12; c21 0]\n{plain(v)}",
    lambda v: f"{plain(v)}\nC = [[c11, c12], [c21, 0]]",
]


@pytest.mark.parametrize("text", [f(ENTRIES) for f in LATEX] + [f(LINES) for f in PLAIN])
def test_the_matrix_is_judged_with_its_entries(text: str) -> None:
    assert verdicts(text) == {"C": "correct", "C11": "correct", "C12": "correct", "C21": "correct"}


@pytest.mark.parametrize("text", [
    *(f(ENTRIES | {"12": ENTRIES["12"].replace("+", "-")}) for f in LATEX),
    *(f(LINES | {"12": LINES["12"].replace("+", "-")}) for f in PLAIN),
])  # fmt: skip
def test_a_wrong_entry_makes_the_matrix_wrong(text: str) -> None:
    found = verdicts(text)
    assert found["C"] == found["C12"] == "wrong" and found["C21"] == "correct"


def test_answer_file() -> None:
    values = "".join(f"  C{index}: {value}\n" for index, value in LINES.items())
    for text in (f"  C: [[C11, C12], [C21, 0]]\n{values}", f"{values}  C: [[c11, c12], [c21, 0]]\n"):
        assert verdicts(f"answers:\n{text}", "yaml")["C"] == "correct"


INERTIA = {
    "md": "\n\n$$d_{21} = m_2(l_{c2}^2 + l_1l_{c2}\\cos q_2) + I_2$$\n\n$$d_{22} = m_2l_{c2}^2 + I_2$$",
    "txt": "\nd21 = m2*(lc2^2 + l1*lc2*cos(q2)) + I2\nd22 = m2*lc2^2 + I2",
}
TORQUE = {
    "md": r"$$\tau_2 = d_{21}\ddot q_1 + d_{22}\ddot q_2 + c_{21}\dot q_1 + m_2l_{c2}g c_{12}$$",
    "txt": "tau2 = d21*ddq1 + d22*ddq2 + c21*dq1 + m2*lc2*g*c12",
}


@pytest.mark.parametrize("suffix", ["md", "txt"])
def test_an_entry_before_its_rate_and_a_cosine_beside_a_length(suffix: str) -> None:
    entries = (displays(ENTRIES) if suffix == "md" else plain(LINES)) + INERTIA[suffix]
    for text in (f"{entries}\n\n{TORQUE[suffix]}", f"{TORQUE[suffix]}\n\n{entries}"):
        assert verdicts(text, suffix)["tau2"] == "correct"
        assert verdicts(text.replace("= d", "= 2 d"), suffix)["tau2"] == "wrong"


def test_a_cosine_elsewhere_stays_one() -> None:
    vector = (
        r"g = \begin{bmatrix}(m_1l_{c1} + m_2l_1)gc_1 + m_2l_{c2}gc_{12} \\ m_2l_{c2}gc_{12}\end{bmatrix}"
    )
    assert verdicts(f"$${vector}$$\n\n{MATRIX}\n\n{displays(ENTRIES)}")["g"] == "correct"


@pytest.mark.parametrize(("second", "verdict"), [("(m_2 + m_3) g", "correct"), ("m_2 g", "wrong")])
def test_a_name_among_zeros(second: str, verdict: str) -> None:
    checker = Checker(load(find("cylindrical-rpp")))
    text = rf"$$g = \begin{{bmatrix}} 0 \\ g_2 \\ 0 \end{{bmatrix}}, \quad g_2 = {second}$$"
    assert verdicts(text, checker=checker)["g"] == verdict


def test_an_entry_that_is_given_nowhere() -> None:
    text = (
        r"$$D = \begin{bmatrix} d_{11} & 0 \\ 0 & d_{22} \end{bmatrix}, \quad d_{22} = m_2 l_{c2}^2 + I_2$$"
    )
    report = ARM(read_submission(ARM.problem, text, "report.md"))
    assert "given nowhere" in next(answer for answer in report.answers if answer.name == "D").notes[0]


def verdicts(text: str, suffix: str = "md", checker: Checker = ARM) -> dict[str, str]:
    report = checker(read_submission(checker.problem, text, f"report.{suffix}"))
    return {answer.name: answer.verdict.value for answer in report.answers if answer.verdict != "missing"}
