r"""Nothing that stands in a hand-in is lost: every equation is an answer, is left alone, or is listed.

The equations are found here by a way of its own, which knows nothing of what they say.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

import pytest

from dynsolve.answers.verdict import Submission
from tests.golden.answers.test_notation import RIGHT, with_slip
from tests.unit.answers.reading.submissions import report

COURSE = Path(__file__).parents[3] / "golden" / "answers" / "dynamics-overview.md"
_FORMULA = re.compile(
    r"\$\$(?s:.+?)\$\$|(?<!\\)\\\[(?s:.+?)\\\]|\\begin\{(align\*?|equation\*?|eqnarray\*?)\}(?s:.+?)\\end\{\1\}"
    r"|(?<![$\\])\$(?!\$)[^$\n]+\$"
)
_ROW = re.compile(r"\\\\|\n\n")


def equations(text: str) -> Iterator[tuple[int, int]]:
    """The first and the last line of each equation: formulas with `=`, and other lines with `=`."""
    rest = text
    for found in _FORMULA.finditer(text):
        if "=" in found[0]:
            yield text.count("\n", 0, found.start()) + 1, text.count("\n", 0, found.end()) + 1
        rest = rest.replace(found[0], re.sub(r"[^\n]", " ", found[0]), 1)
    for number, line in enumerate(rest.split("\n"), 1):
        if "=" in line and not line.lstrip().startswith(("=", "#", "\\")):
            yield number, number + (3 if line.endswith("=") else 1)


def lost(text: str, found: Submission) -> list[str]:
    """The equations that no record of the submission speaks of."""
    records = [r.place.line for r in (*found.answers, *found.not_recognized, *found.left_alone)]
    lines = text.split("\n")
    return [
        "\n".join(lines[first - 1 : last])
        for first, last in equations(text)
        if not any(first <= line <= last for line in records)
    ]


REPORTS = [
    (stem, ending, text) for stem, ending, text, _ in RIGHT if ending in ("md", "txt") and "\n" not in stem
]


def test_every_equation_of_the_notations_is_accounted_for() -> None:
    for stem, ending, text in REPORTS:
        for written in (text, with_slip(text)):
            assert not lost(written, report(written, f"a.{ending}", stem)), written


def test_every_equation_of_the_course_document_is_accounted_for() -> None:
    text = COURSE.read_text(encoding="utf-8")
    assert not lost(text, report(text, "a.md", "in3140-rp"))


@pytest.mark.parametrize(
    ("text", "why"),
    [
        ("$$P_1 = m_1 g x_7$$", "x_7 is a letter of the derivation"),
        ("P_1 = m_1 g x_7", "x_7 is a letter of the derivation"),
        ("P_1 = m_1 g b_7", "unknown symbol `b_7`"),
        ("$$g_2 = m_2 g l_{c2} c_{12}$$\n$$g_2 = F x$$", "unknown symbol `F`"),
        ("$$\\tau = [m_1 g l_{c1} c_1, 0]^T$$\n$$\\tau = D \\ddot q + F_v \\dot q$$", "unknown symbol `F_v`"),
        ("$$\\tau_1 = m_1$$\n$$\\tau_2 = m_2$$\n$$\\tau = J^T F$$", "unknown symbol `F`"),
        ("$$m_1^2 + m_2^2 = 1$$", "no side of it is the name of an answer"),
        ("$$x^2 + y^2 = 1$$", "unknown symbol `x`"),
        ("$$\\begin{bmatrix} m_1 & 0 \\\\ 0 & m_2 \\end{bmatrix}$$", "no name stands here for what this is"),
        ("$$u = K_p (q_d - q)$$", "unknown symbol `K_p`"),
        ("Then $P_2 = m_2 g l_{c2} c_{12}$ is clear.", "it stands in a sentence"),
        ("If $g_2 = m_2 g l_{c2} c_{12}$ it is clear.", "a sentence supposes it"),
        ("Then $g_2 = m_2 g b$ is clear.", "unknown symbol `b`"),
        ("$$\\vec g = [0, -g, 0]^T$$", "this says what a symbol of the problem is"),
        ("$$D(1,:) = [m_1, m_1, m_1]$$", "2 entries are expected"),
        ("$$P_1 = m_1 g l_{c1} s_1", "P1"),
        ("\\begin{align} P_1 = m_1 g b_9\n\nText", "unknown symbol `b_9`"),
    ],
)  # fmt: skip
def test_what_is_no_answer_is_listed_with_its_reason(text: str, why: str) -> None:
    found = report(text)
    said = [r.why for r in found.not_recognized] + [a.fault for a in found.answers if a.fault]
    assert why in (said or [a.name for a in found.answers]), (found.not_recognized, found.left_alone)


@pytest.mark.parametrize(
    ("text", "why"),
    [
        ("$$P = P_1 + P_2$$", "it holds names of the derivation alone"),
        ("$$K_i = \\frac12 m_i v_i^T v_i$$", "K_i has a running index"),
        ("$$v_1 = z_0 \\times (o_1 - o_0)$$", "z_0 is a letter of the derivation"),
        ("$$h = m_2 l_1$$", "it defines an abbreviation"),
        ("We write $s_2 = \\sin q_2$.", "it stands in a sentence"),
        ("so that 2 = the number of links", "it is a sentence"),
    ],
)
def test_what_only_explains_is_left_alone(text: str, why: str) -> None:
    found = report(text, "report.md")
    assert not found.answers and not found.not_recognized
    assert [kept.why for kept in found.left_alone] == [why]


def test_where_a_file_is_too_long_it_says_so() -> None:
    found = report("$$g_2 = m_2$$\n\n" * 1_001)
    assert [r.why for r in found.not_recognized] == ["only the first 1000 equations of a file are read"]
