"""What is said of one case alone, and is not right in general, waits; what is right counts."""

from __future__ import annotations

import pytest

from dynsolve.answers.judging.equivalences import UP_TO_FACTOR
from dynsolve.answers.reading.answer_list import UNDRIVEN
from dynsolve.answers.verdict import JudgedAnswer, Verdict
from tests.unit.answers.hands import checker
from tests.unit.answers.judging.elbow import ELBOW

G2 = r"m_2 g l_{c2} \cos(q_1 + q_2)"
STATIC = rf"\tau_2 = {G2}"
PENDULUM = """
gravity: [0, -g, 0]
dh: [{theta: q1* - pi/2, a: l}]
masses: [{mass: m, link: 1, center: tip}]
find: [tau]
"""
FREE = "an equation of free motion"


def judged(stem: str, text: str, name: str) -> JudgedAnswer:
    check = checker(stem)
    report = check(check.reader(text, "a.md"))
    return next(answer for answer in report.answers if answer.name == name)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        (f"At rest, ${STATIC}$.", "At rest"),
        (f"In the static case we have ${STATIC}$.", "static"),
        (f"Statically, ${STATIC}$ is needed.", "Statically"),
        (f"In the static case\n\n$${STATIC}$$", "static"),
        (rf"For $\dot q = 0$ we find ${STATIC}$", r"\dot q = 0"),
        (r"For $\dot q_1 = \dot q_2 = 0$:" + f"\n\n$${STATIC}$$", r"\dot q_1 = \dot q_2 = 0"),
        (f"When nothing moves, ${STATIC}$.", "nothing moves"),
        (f"Im statischen Fall ist ${STATIC}$.", "statischen"),
        (f"I ro er ${STATIC}$.", "I ro"),
    ],
)
def test_a_torque_of_the_arm_at_rest_waits_with_its_words(text: str, words: str) -> None:
    answer = judged(ELBOW, text, "tau2")
    assert answer.verdict is Verdict.UNREADABLE
    assert "not right in general" in answer.fault and words in answer.fault


def test_what_holds_in_general_counts_although_a_case_is_named() -> None:
    for text in (f"At rest, $g_2 = {G2}$ is left.", rf"For $\dot q = 0$ the vector has $g_2 = {G2}$."):
        assert judged(ELBOW, text, "g2").verdict is Verdict.CORRECT
    assert judged(ELBOW, f"$${STATIC}$$", "tau2").verdict is Verdict.WRONG


@pytest.mark.parametrize("equation", [
    r"\ddot q_1 = -\frac{g}{l} \sin q_1",
    r"\ddot q_1 + \frac{g}{l} \sin q_1 = 0",
    r"l \ddot q_1 + g \sin q_1 = 0",
])  # fmt: skip
def test_an_equation_of_free_motion_may_be_divided_by_what_it_likes(equation: str) -> None:
    answer = judged(PENDULUM, f"$${equation}$$", "tau1")
    assert (answer.verdict, answer.notes) == (Verdict.CORRECT, (UNDRIVEN, UP_TO_FACTOR))


def test_an_equation_of_free_motion_is_no_torque() -> None:
    slip = r"$$\ddot q_1 + g \sin q_1 = 0$$"
    answer = judged(PENDULUM, slip, "tau1")
    assert answer.verdict is Verdict.UNREADABLE and FREE in answer.fault
    torque = r"$$\tau_1 = m l^2 \ddot q_1 + m g l \sin q_1$$"
    for text in (f"{torque}\n\n{slip}", f"{slip}\n\n{torque}"):
        check = checker(PENDULUM)
        report = check(check.reader(text, "a.md"))
        assert next(a for a in report.answers if a.name == "tau1").verdict is Verdict.CORRECT
        assert [FREE in one.why for one in report.set_aside] == [True]


def test_a_matrix_under_a_letter_of_the_coriolis_vector_is_none() -> None:
    check = checker(ELBOW)
    text = r"$$N = \dot D - 2 C = \begin{bmatrix} 0 & -1 \\ 1 & 0 \end{bmatrix}$$"
    report = check(check.reader(text, "a.md"))
    assert not [answer.name for answer in report.answers if answer.given]
    assert [one.text.partition(" ")[0] for one in report.set_aside] == ["N"]
