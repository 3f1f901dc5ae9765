"""Sets behind their heads in a report: which alternatives each form has."""

from __future__ import annotations

import pytest

from dynsolve.answers.judge import Checker
from dynsolve.answers.reading.files import read_submission
from dynsolve.answers.verdict import Submission
from dynsolve.notation.unicode import to_unicode
from dynsolve.problem import read_problem

CART = read_problem("""
gravity: [0, -g, 0]
model:
  coordinates: {x: prismatic, theta: revolute}
  bodies: [{mass: M, at: [x, 0, 0]}, {mass: m, at: [x + l*sin(theta), l*cos(theta), 0]}]
find: [equilibria]
""")


def report(text: str) -> Submission:
    return read_submission(CART, text, "report.md")


TWO = "θ | θ - π"
FORMS = [
    (r"Equilibria: $\theta = 0$ and $\theta = \pi$, $x$ arbitrary.", TWO),
    (r"Ruhelagen: $\theta = 0$ oder $\theta = \pi$. Die untere ist stabil.", TWO),
    (r"Equilibria: $\theta\in\{0,\pi\}$, where the pole is vertical.", TWO),
    (r"**Equilibria:** $\theta = 0$ (unstable), $\theta = \pi$ (stable), for any $x$.", TWO),
    ("The equilibrium points are: theta = 0 or theta = pi", TWO),
    ("equilibria: theta = 0 or pi", TWO),
    ("equilibria = theta = 0 or theta = pi", TWO),
    ("## Equilibria:\n\n- $\\theta = 0$\n- $\\theta = \\pi$\n\n$$P = m g$$", TWO),
    ("(d) The equilibria:\n- $\\theta = 0$ (stable)\n- $\\theta = \\pi$, unstable", TWO),
    ("**(b)** Equilibria:\n1. $\\theta = 0$ (stable)\n2. $\\theta = \\pi$ (unstable)", TWO),
    (r"\[ \text{Equilibria: } \theta = 0,\ \pi \]", TWO),
    (r"$$\text{Equilibria: } \sin\theta = 0$$", "sin(θ)"),
    (r"\textbf{Equilibria:} $\sin\theta = 0$.", "sin(θ)"),
    ("Equilibria: x = 0 and theta = 0; x = 0 and theta = pi", "x & θ | x & θ - π"),
    ("Equilibria: x = 0 and theta = 0, x = 0 and theta = pi", "x & θ | x & θ - π"),
    (r"Equilibria: $x \in \mathbb{R}$, $\theta \in \{0, \pi\}$", TWO),
    ("Equilibria: x arbitrary, theta = 0 or pi", TWO),
    (r"Equilibrium points: $\bar\theta = 0$, $\theta_{eq} = \pi$", TWO),
    (r"Equilibria: $(x, 0)$ and $(x, \pi)$", TWO),
    (r"Equilibria: $(x, \theta) = (0, 0), (0, \pi)$", "x & θ | x & θ - π"),
    (r"Equilibria: $x = 0$, $\theta = 0$", "x & θ"),
    ("Equilibria: x = 0, theta = 0; x = 0, theta = pi", "x & θ | x & θ - π"),
]


@pytest.mark.parametrize(("text", "expected"), FORMS)
def test_a_head_names_the_set_that_stands_behind_it(text: str, expected: str) -> None:
    (found,) = report(text).configurations
    assert not found.fault
    shown = [" & ".join(to_unicode(part.node) for part in one) for one in found.alternatives]
    assert (found.name, " | ".join(shown)) == ("equilibria", expected)


@pytest.mark.parametrize("text", [
    "Equilibria: see below.",
    "We look for equilibria: where gravity moves nothing, g(q) = 0",
    "Equilibria",
])  # fmt: skip
def test_other_words_are_no_head(text: str) -> None:
    assert report(text).configurations == ()


def test_what_stands_around_a_head_is_read_as_ever() -> None:
    found = report("$$P = M g$$\nEquilibria: $\\theta = 0$\n$$K = M g$$")
    assert [answer.name for answer in found.answers] == ["P", "K"]


@pytest.mark.parametrize(
    ("angle", "expected"),
    [(r"k\pi", "correct"), ("k π", "correct"), ("k", "wrong"), (r"\pi/2 + k\pi", "wrong")],
)
def test_a_letter_before_pi_counts_turns_also_where_it_is_a_stiffness(angle: str, expected: str) -> None:
    problem = read_problem("""
gravity: [0, -g, 0]
model:
  coordinates: {x: prismatic, theta: revolute}
  bodies: [{mass: M, at: [x, 0, 0]}, {mass: m, at: [x + l*sin(theta), -l*cos(theta), 0]}]
springs: [{stiffness: k, of: x}]
find: [equilibria]
""")
    said = read_submission(problem, rf"Equilibria: $x = 0$ and $\theta = {angle}$", "report.md")
    assert [answer.verdict for answer in Checker(problem)(said).answers] == [expected]
