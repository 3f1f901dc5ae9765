"""The course document as a hand-in: what its equations are read as."""

from __future__ import annotations

from dynsolve.answers.reading.files import read_submission
from dynsolve.answers.verdict import Answer, Submission
from dynsolve.problem import load
from dynsolve.problem.reader import find
from tests.support import COURSE_DOCUMENT

READ = [
    ("I_body1", "(1)"),
    ("H1", "(3)"),
    ("A1", "(3)"),
    ("A2", "(4)"),
    ("H2", "(5)"),
    ("Jv", "(9)"),
    ("Jw", "(10)"),
    ("P1", "(14)"),
    ("P2", "(15)"),
    ("v1", "(19)"),
    ("v1", "(19)"),
    ("v2", "(20)"),
    ("v2", "(20)"),
    ("Kv1", "(21)"),
    ("Kv2", "(22)"),
    ("w1", "(24)"),
    ("w1", "(24)"),
    ("Kw1", "(25)"),
    ("Kw1", "(27)"),
    ("K", "(29)"),
    ("P", "(30)"),
    ("L", "(32)"),
    ("dLdqd1", "(36)"),
    ("ddt1", "(37)"),
    ("dLdq1", "(38)"),
    ("tau1", "(39)"),
    ("dLdqd2", "(40)"),
    ("ddt2", "(41)"),
    ("dLdq2", "(42)"),
    ("f2", "(43)"),
    ("tau", "(44)"),
    ("D", "(46)"),
    ("C", "(46)"),
    ("g", "(46)"),
]


def hand_in() -> Submission:
    return read_submission(load(find("in3140-rp")), COURSE_DOCUMENT.read_bytes(), "course.md")


def last(name: str) -> Answer:
    return [answer for answer in hand_in().answers if answer.name == name][-1]


def test_every_answer_of_the_document_is_read_and_nothing_else() -> None:
    found = hand_in()
    assert [(answer.name, answer.label) for answer in found.answers] == READ
    assert [answer.fault for answer in found.answers if answer.node is None] == []
    assert found.not_recognized == ()
    assert found.faults == ()


def test_a_bare_inertia_may_be_either() -> None:
    assert last("I_body1").alternatives == ("I1",)


def test_the_letter_a_scanner_misread_is_taken_for_the_one_answer_that_is_absent() -> None:
    notes = " ".join(last("dLdq2").notes)
    assert "L_0" in notes
    assert "taken for dLdq2" in notes


def test_repaired_notation_is_shown() -> None:
    assert "a power under a dot is read as the power of the derivative" in last("L").notes
    assert last("L").read_as == "I_1zz θ̇₁²/2 + m₂ (cos(2θ₁) L₂² θ̇₁² + L̇₂²)/2 - m₁ g L₁/2 - m₂ g L₁"


def test_the_place_is_that_of_the_value() -> None:
    text = COURSE_DOCUMENT.read_text(encoding="utf-8").splitlines()
    place = last("P2").place
    assert text[place.line - 1][place.column - 1 :].startswith("m_2 g L_1")


def test_the_model_is_taken_apart() -> None:
    assert last("D").read_as == "[[m₂ cos(2θ₁) L₂² + 1, 0], [0, 1]]"
    assert last("g").read_as == "[[0], [0]]"


def test_names_inside_a_value_stand_for_answers() -> None:
    first = next(answer for answer in hand_in().answers if answer.label == "(25)")
    assert first.references == ("I1",)
