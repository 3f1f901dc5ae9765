"""Single values of answer files: backslashes, quotes, lists, blanks, and their places."""

from __future__ import annotations

import pytest

from dynsolve.answers.reading.answer_file import parsed
from dynsolve.answers.reading.sources import Source
from tests.unit.answers.reading.submissions import hand_in, last

VALUES = [
    (r'"\theta_1"', r"\theta_1"),
    (r'"\\theta_1"', r"\theta_1"),
    (r'"\nu \tau \times \neq \text{a} \frac{1}{2}"', r"\nu \tau \times \neq \text{a} \frac{1}{2}"),
    (r'"a\n + b"', "a\n + b"),
    (r'"\u00bd m \u03b8\u0307 \xBD"', "½ m θ̇ ½"),
    (r'"\ud835\udc5e"', "\U0001d45e"),
    (r'"a \/ b"', "a / b"),
    (r'"\begin{bmatrix} a \\ b \end{bmatrix}"', r"\begin{bmatrix} a \\ b \end{bmatrix}"),
    (r'"\begin{bmatrix} a \\b \end{bmatrix}"', r"\begin{bmatrix} a \\b \end{bmatrix}"),
    (r'"\\begin{bmatrix} a \\\\ b \\end{bmatrix}"', r"\begin{bmatrix} a \\ b \end{bmatrix}"),
    (r'"2\\,m\\;g"', r"2\,m\;g"),
    (r'"\\(m_1\\)"', "m_1"),
    ("'''diff(q1,t)'", "'diff(q1,t)"),
    ("'a ''b'' c'", "a 'b' c"),
    ("[a, b]", "[a, b]"),
    ("['a', \"b\"]", "[a, b]"),
    ("[[\"a\", b], [0, '1']]", "[[a, b], [0, 1]]"),
    ("[$a$, '$b$']", "[a, b]"),
    ("[atan2(y, x), 0]", "[atan2(y, x), 0]"),
    ("[a, diff(b, t), c]", "[a, diff(b, t), c]"),
    ("['0,5*m', b]", "[0.5*m, b]"),
    ("['a, b', 'c, d']", "[[a, b], [c, d]]"),
    ("[a, b; c, d]", "[a, b; c, d]"),
    ("{m1}", "{m1}"),
    ("{a, b}", "{a, b}"),
    ("&x m1", "&x m1"),
    ("!!str m1", "!!str m1"),
    ("*x", "*x"),
    ("010", "010"),
    ("no", "no"),
    ("\n    - a\n    - -b", "[a, -b]"),
    ("\n    - - a\n      - 0\n    - - 0\n      - b", "[[a, 0], [0, b]]"),
    ("\n  - a\n  - b", "[a, b]"),
    ("|\n    a\n    + b", "a\n    + b"),
    (">-\n    a\n    + b", "a     + b"),
    ("a\n    + b", "a     + b"),
]


@pytest.mark.parametrize(("written", "read"), VALUES)
def test_a_value(written: str, read: str) -> None:
    for before, after in (("", ""), ("\n  L: m1", ""), ("", "\n  L: [\\frac{1}{2}, {")):
        file = parsed(f"answers:{before}\n  K: {written}\n  P: m2{after}\n")
        found = {entry.key: entry.value.text for entry in file.answers if entry.value}
        assert found["K"] == read
        assert found["P"] == "m2"


@pytest.mark.parametrize("blank", ["", "~", "null", "''", '""', "  ", "|\n"])
def test_what_is_blank_is_not_handed_in(blank: str) -> None:
    file = parsed(f"answers:\n  K: {blank}\n  P: m2\n")
    assert [entry.key for entry in file.answers if entry.value] == ["P"]


@pytest.mark.parametrize(
    "text",
    [
        "answers:\n  K: [m1, 'm2 + qx']\n",
        "answers:\n  K:\n  - m1\n  - |\n    m2 +\n      qx\n",
        'answers:\n  K: "\\u00bd m1 + qx"\n',
        "answers:\n  K: '''m1'' qx'\n",
        "answers:\n  K: [m1, 'm2 + qx']\n  P: [\\frac{1}{2}, {\n",
        '{"answers": {"K": ["m1", "\\\\theta_1 qx"]}}',
    ],
)
def test_every_character_knows_its_place(text: str) -> None:
    source = Source(text)
    entry = next(e for e in parsed(text).answers if e.key == "K")
    assert entry.value is not None
    place = entry.value.display(source).locate(entry.value.text.index("qx"), 2)
    line = text.split("\n")[place.line - 1]
    assert line[place.column - 1 :].startswith("qx")
    assert place.excerpt == line


def test_the_place_of_a_fault_in_a_list_is_exact() -> None:
    place = last(hand_in("answers:\n  g:\n  - m1*g\n  - 'm2*gx'\n"), "g2").place
    assert (place.line, place.column, place.length) == (4, 9, 2)


def test_answers_beside_answers_are_answers_too() -> None:
    assert [a.name for a in hand_in("answers:\nK: m1\nP: m2\n").answers] == ["K", "P"]
    assert [a.name for a in hand_in("answers:\n- K: m1\n- P: m2\n").answers] == ["K", "P"]
    assert [a.name for a in hand_in("---\nanswers:\n  K: m1\n---\n").answers] == ["K"]


def test_a_key_given_twice_is_two_answers_in_every_style() -> None:
    for text in ("answers: {K: m1, K: m2}", '{"answers": {"K": "m1", "K": "m2"}}', "K: m1\nK: m2\n"):
        assert [a.name for a in hand_in(text).answers] == ["K", "K"]
