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


DISK = """
gravity: none
model:
  coordinates: {x: prismatic, y: prismatic, phi: revolute, theta: revolute}
  bodies:
    - mass: m
      at: [x, y, R]
      turn: [{by: phi, about: [0, 0, 1]}, {by: theta, about: [0, 1, 0]}]
      inertia: {xx: Id, yy: Ia, zz: Id}
constraints: [{rates: x' - R*theta'*cos(phi)}, {rates: y' - R*theta'*sin(phi)}]
passive: [x, y]
find: [Ac, lambda, reduced]
"""
FIRST, SECOND = r"I_d\ddot\phi = \tau_3", r"(I_a + mR^2)\ddot\theta = \tau_4"
TYPED, TYPED_TOO = "Id*phi_ddot = tau3", "(Ia + m*R^2)*theta_ddot = tau4"
WITH = r"$$I_a\ddot\theta = \tau_4 - R\lambda_1\cos\phi - R\lambda_2\sin\phi$$"


@pytest.mark.parametrize("text", [
    f"reduced: [{TYPED}, {TYPED_TOO}]",
    f"reduced:\n- {TYPED}\n- {TYPED_TOO}",
    f"reduced: {TYPED} and {TYPED_TOO}",
    f"reduced: {TYPED}, {TYPED_TOO}",
    f"reduced: ${FIRST}$ and ${SECOND}$",
    f"Reduced equations of motion:\n{TYPED}\n{TYPED_TOO}\n\nL = 0",
    f"## Reduced equations\n\n$${FIRST}$$\n\n$${SECOND}$$",
    f"The reduced equations are\n\\begin{{align}} {FIRST} \\\\ {SECOND} \\end{{align}}",
    f"Without the multipliers: $${FIRST}, \\quad {SECOND}$$",
    f"Eliminating the multipliers we get\n\n$${FIRST}$$ and $${SECOND}$$",
    f"{WITH}\nEliminating $\\lambda$ gives ${FIRST}$ and ${SECOND}$.",
    r"Reduced: $\ddot x\sin\phi - \ddot y\cos\phi + R\dot\phi\dot\theta = 0$, "
    r"$\ddot y = R\sin\phi\ddot\theta + R\cos\phi\dot\phi\dot\theta$, " + f"${FIRST}$, ${SECOND}$",
])  # fmt: skip
def test_equations_without_multipliers_are_announced_by_name_heading_or_words(text: str) -> None:
    problem = read_problem(DISK)
    judge = Checker(problem)
    for said, expected in ((text, "correct"), (text.replace("R^2", "R"), "wrong")):
        report = judge(read_submission(problem, said, "report.md"))
        verdicts = {answer.name: str(answer.verdict) for answer in report.answers}
        assert verdicts["reduced"] == (expected if "R^2" in text else verdicts["reduced"])
        assert "tau3" not in verdicts
        assert verdicts.get("tau4", "correct") == "correct"


@pytest.mark.parametrize("text", [
    f"We eliminate the multipliers later. The full equations are\n$${FIRST}$$\n{WITH}",
    f"Eliminating the accelerations gives the multipliers.\n\n{WITH}",
])  # fmt: skip
def test_other_equations_of_motion_stay_those_of_their_forces(text: str) -> None:
    assert read_submission(read_problem(DISK), text, "report.md").configurations == ()


@pytest.mark.parametrize("text", [
    "singular: sin(q2) = 0, q2 = 0 or 180 degrees",
    "det(J) = l1*l2*sin(q2), so singular when sin(q2) = 0, q2 = 0 or pi",
])  # fmt: skip
def test_angles_say_again_what_a_sine_says(text: str) -> None:
    arm = read_problem("{dh: [{theta: q1*, a: l1}, {theta: q2*, a: l2}], find: [singular]}")
    (answer,) = (a for a in Checker(arm)(read_submission(arm, text, "a.txt")).answers if a.name == "singular")
    assert str(answer.verdict) == "correct"
