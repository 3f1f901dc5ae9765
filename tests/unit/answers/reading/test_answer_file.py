"""The answer file: values from the source text, one bad line at a time."""

from __future__ import annotations

import pytest

from tests.unit.answers.reading.submissions import hand_in, last, shown_last


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
    assert shown_last(hand_in(f"answers:\n  K: {value}\n  P: m2\n"), "K") == expected


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
    assert shown_last(found, "K") == "m₁ g"
    assert shown_last(found, "P") == "m₂"


@pytest.mark.parametrize(
    "bad",
    [r"[[\frac{a}{b}, 0], [0, 0]]", "# ...", "[", "{", "'", "&a m1", "*a", "!!int 3", "@", "%", "`", "a: b"],
)
def test_a_bad_line_spoils_one_answer(bad: str) -> None:
    found = hand_in(f"answers:\n  K: {bad}\n  P: m2\n")
    assert shown_last(found, "P") == "m₂"
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


def test_an_empty_file_has_a_fault() -> None:
    assert hand_in("").faults
    assert hand_in("problem: x\nstudent: y\n").faults
