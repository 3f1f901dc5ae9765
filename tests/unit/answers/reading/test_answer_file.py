"""The answer file: values from the source text, the student's own names, one bad line at a time."""

from __future__ import annotations

from functools import cache

import pytest

from dynsolve.answers.reading.files import read_submission
from dynsolve.answers.submission import Answer, Submission
from dynsolve.notation.unicode import to_unicode
from dynsolve.problem import Problem, load
from dynsolve.problem.library import find


@cache
def problem(stem: str) -> Problem:
    return load(find(stem))


def hand_in(text: str, stem: str = "planar-2r") -> Submission:
    return read_submission(problem(stem), text, "answer.yaml")


def last(found: Submission, name: str) -> Answer:
    return [answer for answer in found.answers if answer.name == name][-1]


def shown(found: Submission, name: str) -> str:
    node = last(found, name).node
    assert node is not None, last(found, name).fault
    return to_unicode(node)


def test_the_head_is_read() -> None:
    found = hand_in("problem: planar-2r   # which one\nstudent: 's123456'\nanswers:\n  K: m1\n")
    assert (found.problem, found.student, found.file) == ("planar-2r", "s123456", "answer.yaml")


VALUES = [
    ("m1*g", "m₁ g"),
    ("'m1*g'", "m₁ g"),
    ('"m1*g"', "m₁ g"),
    (r'"\theta_1"', "q₁"),
    (r"'\theta_1'", "q₁"),
    ("m1*g   # a comment", "m₁ g"),
    ("|\n    m1*g\n    + m2*g", "m₁ g + m₂ g"),
    (">\n    m1*g\n    + m2*g", "m₁ g + m₂ g"),
    ("m1*g\n    + m2*g", "m₁ g + m₂ g"),
    ("- m1*g", "-m₁ g"),
    ("{m1}/2", "m₁/2"),
    ("K = m1*g", "m₁ g"),
    ("m1*g.", "m₁ g"),
    (r"\frac{m_1}{2}", "m₁/2"),
    ("$m_1 g$", "m₁ g"),
    ("$$m_1 g$$", "m₁ g"),
    (r"\(m_1 g\)", "m₁ g"),
    (r"\[ m_1 g \]", "m₁ g"),
    ("'diff(q1,t)", "q̇₁"),
]


@pytest.mark.parametrize(("value", "expected"), VALUES)
def test_a_value_is_what_stands_in_the_source(value: str, expected: str) -> None:
    assert shown(hand_in(f"answers:\n  K: {value}\n  P: m2\n"), "K") == expected


@pytest.mark.parametrize(
    "text",
    [
        "answers: {K: m1*g, P: m2}",
        "answers: {K: m1*g, P: m2}\n",
        "K: m1*g\nP: m2\n",
        "answers:\n    K: m1*g\n    P: m2",
        "answers:\r\n  K: m1*g\r\n  P: m2\r\n",
        "\ufeffanswers:\n  K: m1*g\n  P: m2\n",
        "answers:\n\n  K: m1*g\n\n  # more\n  P: m2\n",
    ],
)
def test_an_answer_file_in_every_layout(text: str) -> None:
    found = hand_in(text)
    assert shown(found, "K") == "m₁ g"
    assert shown(found, "P") == "m₂"


@pytest.mark.parametrize(
    "bad",
    [r"[[\frac{a}{b}, 0], [0, 0]]", "# ...", "[", "{", "'", "&a m1", "*a", "!!int 3", "@", "%", "`", "a: b"],
)
def test_a_bad_line_spoils_one_answer(bad: str) -> None:
    found = hand_in(f"answers:\n  K: {bad}\n  P: m2\n")
    assert shown(found, "P") == "m₂"
    answer = last(found, "K")
    assert answer.node is None
    assert answer.fault
    assert answer.expected
    assert (answer.place.line, answer.place.excerpt) == (2, f"  K: {bad}")


def test_the_place_of_a_fault_is_exact() -> None:
    place = last(hand_in("answers:\n  P: m2\n  K: m1*gx + m2\n"), "K").place
    assert (place.line, place.column, place.length) == (3, 9, 2)


def test_a_blank_value_is_not_handed_in() -> None:
    assert hand_in("answers:\n  K:\n  P: m2\n").answers == hand_in("answers:\n  K:    \n  P: m2\n").answers
    assert [answer.name for answer in hand_in("answers:\n  K:\n  P: m2\n").answers] == ["P"]


def test_a_name_given_twice_stands_twice() -> None:
    assert [a.name for a in hand_in("answers:\n  K: m1\n  K: m2\n").answers] == ["K", "K"]


def test_an_unknown_name_is_not_recognized() -> None:
    found = hand_in("answers:\n  foo: m1\n  K: m1\n")
    assert [refused.text for refused in found.not_recognized] == ["foo: m1"]


def test_names_of_answers_inside_a_value_are_references() -> None:
    found = hand_in("answers:\n  L: K - P\n  P: P1 + P2\n")
    assert last(found, "L").references == ("K", "P")
    assert last(found, "L").read_as == "K - P"
    assert last(found, "P").references == ("P1", "P2")


def test_abbreviations_and_own_symbols() -> None:
    head = "symbols: {q1: theta1, d2: L2, qd1: theta1_dot}\nlet: {h: -m2*L2*sin(q1)}\n"
    found = hand_in(head + "answers:\n  tau1: h*qd1 + \\ddot q_1 + \\dot{d}_2 + dd2\n", "in3140-rp")
    assert shown(found, "tau1") == "-(m₂ L₂ sin(θ₁)) θ̇₁ + θ̈₁ + L̇₂ + L̇₂"


OWN = [
    ("q1: theta1 - 90deg", "sin(q1)*dq1", "sin(θ₁ - 90°) θ̇₁"),
    ("q1: 90deg - theta1", "s1*q1'", "sin(90° - θ₁) (-θ̇₁)"),
    ("phi: theta1", r"\dot\phi^2 \cos\phi", "θ̇₁² cos(θ₁)"),
    ("x: L2 - L1", r"\dot{x}", "L̇₂"),
    ("M: m1", "M*g", "m₁ g"),
    (r"\varphi_1: \theta_1", r"\ddot\varphi_1", "θ̈₁"),
    ("w: theta1_dot", "w^2", "θ̇₁²"),
    ("I: I1zz", r"\frac12 I \dot\theta_1^2", "1/2 I_1zz θ̇₁²"),
]


@pytest.mark.parametrize(("symbols", "value", "expected"), OWN)
def test_a_symbol_of_the_students_own(symbols: str, value: str, expected: str) -> None:
    found = hand_in(f"symbols:\n  {symbols}\nanswers:\n  tau1: {value}\n", "in3140-rp")
    assert found.faults == ()
    assert shown(found, "tau1").replace("½", "1/2") == expected


def test_a_definition_that_cannot_be_read_is_a_fault_of_its_own() -> None:
    found = hand_in("let: {h: sin(}\nanswers:\n  K: h\n  P: m1\n")
    assert len(found.faults) == 1
    assert last(found, "K").node is None
    assert "definition" in last(found, "K").expected
    assert shown(found, "P") == "m₁"


def test_an_empty_file_has_a_fault() -> None:
    assert hand_in("").faults
    assert hand_in("problem: x\nstudent: y\n").faults
