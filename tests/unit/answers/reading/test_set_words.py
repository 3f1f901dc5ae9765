"""Sets of configurations in English, German and Norwegian, behind ⇔, `d.h.`, `altså`, and as bullets."""

from __future__ import annotations

import pytest

from dynsolve.answers.judge import Checker
from dynsolve.answers.reading.files import read_submission
from dynsolve.problem import read_problem

PENDULUM = Checker(
    read_problem("""
gravity: [0, -g, 0]
model: {coordinates: {x: prismatic, q: revolute}, bodies: [{mass: m, at: [x + l*sin(q), -l*cos(q), 0]}]}
find: [equilibria]
""")
)
ARM = Checker(
    read_problem("""
gravity: none
dh: [{theta: q1*, a: l1}, {theta: q2*, a: l2}]
reach: [x, y]
find: [det, singular]
""")
)


def verdicts(checker: Checker, text: str, suffix: str = "md") -> dict[str, str]:
    report = checker(read_submission(checker.problem, text, f"report.{suffix}"))
    return {answer.name: answer.verdict.value for answer in report.answers}


EQUILIBRIA = [
    "Gleichgewichtslagen: $q={0}$ und $q={1}$.",
    "Gleichgewichte: $q={0}$ oder $q={1}$",
    "Ruhelagen: $q={0}$, $q={1}$",
    "**Ruhelagen.** $q={0}$ (hängend) und $q={1}$ (stehend)",
    "Die Gleichgewichtslagen sind $q={0}$ und $q={1}$, $x$ beliebig.",
    "## Gleichgewichtspunkte\n\n- stabil: $q={0}$\n- instabil: $q={1}$",
    "Im Gleichgewicht gilt $\\sin q=0$, also $q={0}$ oder $q={1}$.",
    "Ruhelagen ergeben sich aus $g=0$:\n$$m g l\\sin q=0\\;\\Rightarrow\\;q\\in\\{{{0},{1}\\}}$$",
    "Likevektspunkter: $q={0}$ og $q={1}$",
    "**Likevektsstillinger:** $q={0}$ (stabil) og $q={1}$ (ustabil)",
    "Likevektspunktene er gitt ved $\\sin q=0$, dvs. $q={0}$ og $q={1}$.",
    "Ved likevekt er $\\sin q=0$, altså $q={0}$ eller $q={1}$.",
    "Likevekt: $q={0}$ eller $q={1}$, $x$ vilkårlig",
    "Equilibria: $\\sin q=0$, i.e. $q={0}$ or $q={1}$",
    "At rest $\\sin q=0$, hence $q={0}$ or $q={1}$.",
    "Equilibria: $\\cos q=\\cos({0})$ or $\\cos q=\\cos({1})$",
]


@pytest.mark.parametrize("form", EQUILIBRIA)
def test_equilibria(form: str) -> None:
    assert verdicts(PENDULUM, form.format("0", r"\pi"))["equilibria"] == "correct"
    assert verdicts(PENDULUM, form.format("0", r"\frac{\pi}{2}"))["equilibria"] == "wrong"


@pytest.mark.parametrize(("equation", "verdict"), [
    (r"\sin^2 q = 0", "correct"), (r"1 - \cos^2 q = 0", "correct"),
    (r"\cos q = 1", "wrong"), (r"\cos^2 q = 0", "wrong"),
])  # fmt: skip
def test_double_roots(equation: str, verdict: str) -> None:
    assert verdicts(PENDULUM, f"Equilibria: ${equation}$")["equilibria"] == verdict


DETERMINANTS = [
    r"$$\det J=l_1l_2\sin q_2=0\;\Leftrightarrow\;q_2=k\pi$$",
    r"$$\det J=l_1l_2\sin q_2\overset{!}{=}0\quad\Longleftrightarrow\quad q_2=k\pi,\;k\in\mathbb{Z}$$",
    r"$$\begin{aligned}\det J&=l_1l_2\sin q_2\\ \det J&=0\\ \iff q_2&=0\text{ eller }q_2=\pi\end{aligned}$$",
    "$$\\det J=l_1l_2\\sin q_2$$\nSingulariteter: $\\sin q_2=0$, dvs. $q_2=0$ eller $q_2=\\pi$",
    "$$|J|=l_1l_2\\sin q_2$$\nSinguläre Stellungen: $\\sin q_2=0$, d.h. $q_2=0$ oder $q_2=\\pi$",
    "$$\\det J=l_1l_2\\sin q_2=0$$\n$$\\Rightarrow q_2=0,\\ q_2=\\pi$$",
]


@pytest.mark.parametrize("text", DETERMINANTS)
def test_the_condition_is_no_value_of_the_determinant(text: str) -> None:
    assert verdicts(ARM, text) == {"det": "correct", "singular": "correct"}
    assert verdicts(ARM, text.replace("l_1l_2", "l_1^2"))["det"] == "wrong"


def test_plain_text() -> None:
    text = "det J = l1*l2*sin(q2) = 0  <=>  q2 = k*pi"
    assert verdicts(ARM, text, "txt") == {"det": "correct", "singular": "correct"}
    assert verdicts(ARM, "Singulariteter:\n - q2 = 0\n - q2 = pi\n", "txt")["singular"] == "correct"
    assert verdicts(ARM, "Singularitäten: q2 = pi/2\n", "txt")["singular"] == "wrong"
