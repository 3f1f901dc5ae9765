"""What is not right by itself waits where it may follow from an answer that could not be read."""

from __future__ import annotations

import pytest

from dynsolve.answers.feedback import FeedbackView, feedback
from dynsolve.answers.verdict import JudgedAnswer, Verdict
from dynsolve.render.markdown import render
from tests.unit.answers.hands import checker
from tests.unit.answers.judging.elbow import ELBOW

UNREAD = r"\Xi_9"
P1, P2 = r"m_1 g l_{c1} \sin q_1", r"m_2 g (l_1 \sin q_1 + l_{c2} \sin(q_1 + q_2))"
G1 = r"m_1 g l_1 \cos q_1 + m_2 g (l_1 \cos q_1 + l_{c2} \cos(q_1 + q_2))"
G2 = r"m_2 g l_{c2} \cos(q_1 + q_2)"
WRONG_G = rf"$$g = \begin{{bmatrix}} {G1} \\ {G2} \end{{bmatrix}}$$"
WRONG_D = r"$$D = \begin{bmatrix} I_{1} + m_1 l_{c1}^2 & 0 \\ 0 & m_2 l_{c2}^2 + I_{2} \end{bmatrix}$$"


def judged(*lines: str, name: str = "g") -> JudgedAnswer:
    check = checker(ELBOW)
    report = check(check.reader("\n\n".join(lines), "a.md"))
    return next(answer for answer in report.answers if answer.name == name)


@pytest.mark.parametrize(
    ("before", "source"),
    [
        (f"$$P = {UNREAD}$$", "P"),
        (rf"$$P = m_1 g \frac{{l_1 + {UNREAD}$$", "P"),
        (f"Here $P = {UNREAD}$ is found.", "P"),
        (f"$$P_1 = {UNREAD}$$", "P1"),
        (f"$$r_{{c1}} = {UNREAD}$$", "rc1"),
        (rf"$$\tau_1 = {UNREAD}$$", "tau1"),
    ],
)
def test_a_consequence_of_what_was_not_read_waits(before: str, source: str) -> None:
    answer = judged(before, WRONG_G)
    assert answer.verdict is Verdict.UNREADABLE
    assert f"may follow from {source}, which could not be read" in answer.fault
    assert not answer.diagnosis and not answer.entries


@pytest.mark.parametrize(
    "lines",
    [
        (f"$$K = {UNREAD}$$", WRONG_G),  # nothing of K is in g
        ("$$L = K - P$$", WRONG_G),  # a definition hides nothing
        ("The arm is free ($\\tau = 0$).", WRONG_G),  # neither does a condition
        (f"$$P = {P1} + {P2}$$", f"$$P_1 = {UNREAD}$$", WRONG_G),  # P stands between
        (f"$$P = {P1} + {P2}$$", rf"$$\tau_2 = {UNREAD}$$", WRONG_G),  # the other entry
        (WRONG_G, rf"$$\tau_1 = {UNREAD}$$"),  # written after it
        (f"$$P = {UNREAD}$$", r"$$g = \begin{bmatrix} m_1 \\ m_2 \end{bmatrix}$$"),  # nothing of the key
    ],
)
def test_what_cannot_follow_from_it_is_wrong(lines: tuple[str, ...]) -> None:
    assert judged(*lines).verdict is Verdict.WRONG


def test_of_the_answers_that_one_letter_names_the_first_is_told() -> None:
    """V is the potential energy, or C q̇: none of the latter stands there."""
    turning = r"(m_2 (l_{c2}^2 + l_1 l_{c2} \cos q_2) + I_2) \ddot q_1 + (m_2 l_{c2}^2 + I_2) \ddot q_2"
    torque = rf"\tau_2 = {turning} + m_2 l_1 l_{{c2}} \sin q_2 \dot q_1^2 + 2 {G2}"
    answer = judged(f"$$V = {UNREAD}$$", f"$${torque}$$", name="tau2")
    assert "may follow from P, which could not be read" in answer.fault


def test_what_was_read_is_not_said_to_be_unreadable() -> None:
    check = checker(ELBOW)
    report = check(check.reader(f"$$P = {UNREAD}$$\n\n{WRONG_G}", "a.md"))
    page = render(feedback(report, "a.md", FeedbackView()))
    assert "g: for a human to judge" in page and "g: could not be read" not in page


def test_what_is_right_or_follows_from_what_was_read_does_not_wait() -> None:
    slip = P1.replace("l_{c1}", "l_1")
    assert judged(f"$$P = {slip} + {P2}$$", f"$$K = {UNREAD}$$", WRONG_G).verdict is Verdict.FOLLOWS
    right = WRONG_G.replace("m_1 g l_1", "m_1 g l_{c1}")
    assert judged(f"$$P = {UNREAD}$$", right).verdict is Verdict.CORRECT


def test_an_inertia_matrix_waits_for_the_kinetic_energy_and_not_for_the_potential() -> None:
    assert judged(f"$$K = {UNREAD}$$", WRONG_D, name="D").verdict is Verdict.UNREADABLE
    assert judged(f"$$P = {UNREAD}$$", WRONG_D, name="D").verdict is Verdict.WRONG
