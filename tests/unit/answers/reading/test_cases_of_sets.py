"""`For q₂ = 90°` names a case; it is a set only where its sentence says so, and nothing else is."""

from __future__ import annotations

from itertools import cycle

import pytest

from tests.unit.answers.hands import checker, verdicts

ARM = """
gravity: [0, -g, 0]
dh: [{theta: q1*, a: l1}, {theta: q2*, a: l2}]
masses: [{mass: m1, link: 1}, {mass: m2, link: 2}]
find: [det, singular, equilibria]
"""
DET = r"$$\det J = l_1 l_2 \sin q_2$$"
SET = r"The arm is singular for $q_2 = 0$ and $q_2 = \pi$."

CASES = [
    "For $q_2=90°$ the determinant is greatest.",
    "For $q_2=90°$ the Jacobian has full rank.",
    "At $q_2=90°$ the arm can move in all directions.",
    "For $q_2=90°$",
    "For $q_2=90°$:",
    "For $q_2=90°$ it is far from singular.",
    "For\n\n$$q_2=90°$$\n\nthe determinant is greatest.",
    "Bei $q_2=90°$ ist die Determinante am größten.",
    "For $q_2=90°$ er determinanten størst.",
]
HEADS = ["# Singular configurations\n\n", "\\section{Singularities}\n", "**Singular**\n\n", ""]


@pytest.mark.parametrize(("head", "said"), [*zip(cycle(HEADS), CASES)])
def test_a_case_is_no_set(head: str, said: str) -> None:
    judge = checker(ARM)
    for text in (f"{head}{said}", f"{head}{DET}\n\n{said}", f"{DET}\n\n{head}{said}"):
        report = judge(judge.reader(text, "a.md"))
        assert verdicts(report)["singular"] == "missing", text
        answer = next(answer for answer in report.answers if answer.name == "singular")
        assert answer.fault, text
    for text in (f"{head}{DET}\n\n{said}\n\n{SET}", f"{head}{SET}\n\n{said}"):
        report = judge(judge.reader(text, "a.md"))
        assert verdicts(report)["singular"] == "correct", text


@pytest.mark.parametrize(("text", "name", "verdict"), [
    (r"For $q_2 = 0$ and $q_2 = \pi$ the arm is singular.", "singular", "correct"),
    (r"For $q_2 = 0$ or $\pi$ the determinant vanishes.", "singular", "correct"),
    (r"Bei $q_2 = 0$ und $q_2 = \pi$ ist die Jacobimatrix singulär.", "singular", "correct"),
    (r"# Singular configurations" "\n\n" r"For $q_2 = 0, \pi$ we have $\det J = 0$.", "singular", "correct"),
    (r"The arm is singular for $\sin q_2 = 0$.", "singular", "correct"),
    (r"Singular configurations:" "\n\n" r"For $q_2 = 0, \pi$", "singular", "correct"),
    (r"For $q_2 = 90°$ the arm is singular.", "singular", "wrong"),
    (r"For $\cos q_1 = 0$ and $\sin q_2 = 0$ it is in equilibrium.", "equilibria", "correct"),
    (r"# Equilibria" "\n\n" r"For $q_1 = 0$ the torque is greatest.", "equilibria", "missing"),
])  # fmt: skip
def test_a_case_whose_sentence_says_so_is_a_set(text: str, name: str, verdict: str) -> None:
    judge = checker(ARM)
    assert verdicts(judge(judge.reader(text, "a.md")))[name] == verdict
