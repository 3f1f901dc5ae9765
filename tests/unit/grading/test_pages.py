"""What a student reads: true, no more than the policy allows, and nothing of the student's is markup."""

from __future__ import annotations

import base64
import re

import pytest

from dynsolve.grading.teacher import HEAD_HERE, unpack
from dynsolve.grading.work import grade_one
from tests.support import ROOT

TEXT = (ROOT / "problems" / "in3140-rp.yaml").read_text(encoding="utf-8")
MARKS = {"P": "2", "K": "4", "tau": "6", "D": "4"}
RIGHT = {
    "P": "m1*g*L1/2 + m2*g*L1",
    "K": "I1zz*theta1'^2/2 + m2*(L2'^2 + L2^2*theta1'^2)/2",
    "tau": "[(I1zz + m2*L2^2)*theta1'' + 2*m2*L2*L2'*theta1', m2*L2'' - m2*L2*theta1'^2]",
    "D": "[[I1zz + m2*L2^2, 0], [0, m2]]",
}


def _page(answers: dict[str, str], hints: int = 3, kind: str = "markdown", name: str = "a.yaml") -> str:
    lines = "".join(f"  {key}: {value}\n" for key, value in answers.items())
    return _of_text(f"answers:\n{lines}", hints, kind, name)


def _of_text(text: str, hints: int = 3, kind: str = "markdown", name: str = "a.yaml") -> str:
    policy = {"follow": "1", "caps": {}, "rounding": "1/100", "late": "1", "hints": hints}
    file = {"name": name, "content": base64.b64encode(text.encode()).decode()}
    payload = {
        "problem": {"file": "in3140-rp.yaml", "text": TEXT}, "marks": MARKS, "policy": policy,
        "files": [file],
    }  # fmt: skip
    return unpack(base64.b64decode(grade_one(payload)[kind]))


def test_the_first_slip_comes_first_with_what_was_written_set_beside() -> None:
    page = _page({**RIGHT, "K": "I1zz*theta1'^2/2 + m2*(L2'^2 + L2*theta1'^2)/2"})
    first = page.index("It first went wrong at K (line 3).")
    slip = page.index("### K: wrong")
    assert page.index(HEAD_HERE) < first < slip < page.index("## How the answers were read")
    assert r"K = \frac{I_{1,zz} \dot{\theta}_{1}^{2}}{2}" in page[slip:]
    assert "the $L_{2}$ should be squared" in page[slip:]
    assert "tau (line 4), correct (right, though your own earlier answers lead elsewhere):" in page
    assert "[[" not in page and r"D = \begin{bmatrix}" in page


def test_what_is_said_of_everything_is_said_of_the_entry_that_it_holds_for() -> None:
    page = _page({"D": "[[-I1zz - m2*L2^2, 0], [0, m2]]"})
    assert "- Entry (1, 1) has the wrong sign." in page
    page = _page(
        {"tau": "[2*(I1zz + m2*L2^2)*theta1'' + 4*m2*L2*L2'*theta1', 2*m2*L2'' - 2*m2*L2*theta1'^2]"}
    )
    assert "- Your answer is 2 times what it should be." in page


def test_an_answer_that_follows_says_from_what() -> None:
    slipped = {"K": "I1zz*theta1'^2 + m2*(L2'^2 + L2^2*theta1'^2)/2"}
    follows = {"tau": "[(2*I1zz + m2*L2^2)*theta1'' + 2*m2*L2*L2'*theta1', m2*L2'' - m2*L2*theta1'^2]"}
    page = _page({"P": RIGHT["P"], **slipped, **follows})
    assert "1 later answer follows from earlier slips." in page
    assert "tau (line 4), follows from your earlier answers (from K):" in page


@pytest.mark.parametrize("hints", [1, 2, 3])
def test_who_writes_nothing_of_it_is_not_told_the_answer(hints: int) -> None:
    page = _page(dict.fromkeys(RIGHT, "0") | {"tau": "[0, 0]", "D": "[[0, 0], [0, 0]]"}, hints)
    told = re.sub(r"(?s)\$\$.*?\$\$|`[^`]*`", "", page)  # what the student wrote stands there, set
    assert not re.search(r"m_\{|L_\{|theta|I_", told), told


def test_a_right_term_is_not_said_to_be_wrong_because_an_earlier_answer_is() -> None:
    page = _page({"K": "0", "tau": RIGHT["tau"].replace("2*m2", "m2")})
    assert "does not belong" not in page
    assert "has 1 in front where 2 belongs" in page


def test_each_level_tells_where_what_kind_and_how() -> None:
    answers = {**RIGHT, "tau": RIGHT["tau"].replace("2*m2", "m2")}
    where, kind, how = (_page(answers, hints) for hints in (1, 2, 3))
    for page in (where, kind, how):
        assert "It first went wrong at tau (line 4)." in page
        assert "Wrong in entry 1; the others are right or follow." in page
    assert "kind of slip" not in where and "in front" not in where
    assert "What kind of slip: a factor such as ½." in kind and "in front" not in kind
    assert "has 1 in front where 2 belongs" in how


def test_each_slip_of_a_matrix_says_in_which_entry_it_is() -> None:
    slipped = {**RIGHT, "D": "[[I1zz + m2*L2^2 + m1*L2^2, 0], [0, 2*m2]]"}
    page = _page(slipped)
    assert "Wrong in entries (1, 1), (2, 2); the others are right or follow." in page
    assert "- Entry (1, 1): The term $m_{1}$ $L_{2}^{2}$ does not belong here." in page
    assert "- Entry (2, 2) is 2 times what it should be." in page


def test_without_answers_it_says_how_they_are_written() -> None:
    assert "No answer was found in it. The name stands before the value: `K = ...`, and" in _of_text(
        "answers: {}\n"
    )


def test_what_could_not_be_read_is_shown_as_it_was_typed() -> None:
    page = _page({"K": "m2*(L2'^2 +", "P": "m_1 # <b>*x*</b> `q`"})
    assert "Line 2: the formula ends here too early." in page
    assert "`K: m2*(L2'^2  ▸+◂`" in page
    assert "<b>" not in re.sub(r"``.*?``", "", page)


HOSTILE = (
    "---\nproblem: in3140-rp\n---\n# <script>alert(1)</script>\n\n"
    "$$<img src=x onerror=alert(1)> = 1$$\n\n$$Q_{\\text{[x](javascript:alert(1))}} = `</code><b>`$$\n\n"
    "$$K = \\text{</p><script>alert(2)</script>}$$\n\n$$P = m_1 \u202e g$$\n"
)


def test_nothing_that_a_student_writes_is_markup() -> None:
    html = _of_text(HOSTILE, kind="html", name="<script>.md")
    for sign in ("<script", "<img", "<b>", 'javascript:alert(1))"'):
        assert sign not in html.replace("&lt;", "")
    assert "\u202e" not in html
    plain = re.sub(r"(?s)(`+).*?\1", "", _of_text(HOSTILE))
    assert "<script" not in plain and "<img" not in plain and "](javascript" not in plain
