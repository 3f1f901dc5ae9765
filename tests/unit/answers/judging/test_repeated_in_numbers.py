"""An answer that a box repeats with numbers put in: the formula counts where the problem gives none."""

from __future__ import annotations

import pytest

from dynsolve.answers.judge import Checker
from dynsolve.answers.reading.files import read_submission
from dynsolve.problem import load, read_problem
from dynsolve.problem.reader import find

ARM = Checker(load(find("planar-2r")))
G2 = r"m_2l_{c2}g\cos(q_1+q_2)"
NUMBERS = r"9.81\cos(q_1+q_2)"


@pytest.mark.parametrize(("text", "verdict"), [
    (rf"$$g_2={G2}$$ Mit $m_2=2$ und $g=9.81$: $$\boxed{{g_2={NUMBERS}}}$$", "correct"),
    (rf"$$g_2={G2}={NUMBERS}$$", "correct"),
    (rf"$$g_2=2{G2}$$ $$\boxed{{g_2={NUMBERS}}}$$", "wrong"),
    (rf"$$g_2={NUMBERS}$$", "wrong"),
    (rf"$$g_2={G2}$$ $$g_2=\cos(q_1+q_2)$$", "wrong"),
])  # fmt: skip
def test_the_formula_counts(text: str, verdict: str) -> None:
    report = ARM(read_submission(ARM.problem, text, "report.md"))
    assert next(answer.verdict for answer in report.answers if answer.name == "g2") == verdict


@pytest.mark.parametrize(("factor", "verdict"), [("0.98", "correct"), ("0.49", "wrong")])
def test_numbers_of_the_problem_are_put_in(factor: str, verdict: str) -> None:
    checker = Checker(
        read_problem("""
gravity: [0, -g, 0]
dh: [{theta: q*, a: l}]
masses: [{mass: m, link: 1, center: tip}]
values: {m: 0.5, l: 0.2, g: 9.8}
""")
    )
    text = rf"$$g_1=m g l\cos q$$ $$\boxed{{g_1={factor}\cos q}}$$"
    report = checker(read_submission(checker.problem, text, "report.md"))
    assert next(answer.verdict for answer in report.answers if answer.name == "g1") == verdict
