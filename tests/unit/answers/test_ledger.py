"""What is no answer waits where nothing else answers what it names, else it is set aside."""

from __future__ import annotations

import json
from typing import Any

import pytest

from dynsolve.answers.judge import Checker
from dynsolve.answers.report import to_json
from dynsolve.grading.queue import for_a_human
from dynsolve.grading.record import RecordedAnswer
from dynsolve.solution.solution import load

CHECKER = Checker(load("in3140-rp"))
D = r"$$D = \begin{bmatrix} I_{1zz} + m_2 L_2^2 & 0 \\ 0 & m_2 \end{bmatrix}$$"


def judged(text: str, ending: str = "md") -> dict[str, Any]:
    found: dict[str, Any] = json.loads(json.dumps(to_json(CHECKER(CHECKER.reader(text, f"a.{ending}")))))
    return found


@pytest.mark.parametrize(
    ("text", "line", "reason"),
    [
        (r"$$D = D_v^{-1} X$$", 1, "unknown symbol"),
        ("Text.\n\n$$D = \\sum_i m_i J_{v_i}^T J_{v_i}$$", 3, "a sum over an index"),
        ("$$D = M$$", 1, "given nowhere"),
        ("Let the matrix be $D = X_7$, as before.", 1, "X_7"),
        ("$$D[0,0] = m_2$$", 1, "matrix"),
        ("$$(7)\\quad d_{12} = \\frac{d}{dt}(x_9)$$", 1, "x_9"),
    ],
)
def test_an_equation_of_what_nothing_else_answers_waits(text: str, line: int, reason: str) -> None:
    report = judged(text)
    (answer,) = (a for a in report["answers"] if a["name"] == "D")
    (found,) = (q for q in report["queued"] if q["name"] in ("D", "d12"))
    assert answer["where"]["line"] == found["line"] == line
    assert reason in found["reason"] and found["reason"] in answer["fault"]["message"]
    assert not [q for q in report["set_aside"] if "D" in q["name"].split(", ")]


@pytest.mark.parametrize("text", [r"$$D = D_v^{-1} X$$", "$$D = M$$", "with $D = X_7$, as before"])
def test_where_something_else_answers_it_it_is_set_aside(text: str) -> None:
    report = judged(f"{D}\n\n{text}")
    assert not [q for q in report["queued"] if q["name"] == "D"]
    assert [q["line"] for q in report["set_aside"]] == [3]
    assert not report["not_recognized"]
    assert next(a for a in report["answers"] if a["name"] == "D")["verdict"] == "correct"


def test_what_counts_as_an_answer_is_in_no_list() -> None:
    report = judged(f"{D}\n\n$$C = 0$$\n\n$$g = 0$$\n\n$$\\tau = D \\ddot q + C \\dot q + g$$")
    assert next(a for a in report["answers"] if a["name"] == "tau")["verdict"] != "missing"
    assert not report["set_aside"] and not report["queued"]


def test_a_missing_answer_with_a_line_waits_in_a_course_and_one_without_does_not() -> None:
    blank: dict[str, Any] = dict.fromkeys(RecordedAnswer._fields, "")
    missing = {**blank, "verdict": "missing", "of": "4", "line": 3}
    assert "line 3" in for_a_human(RecordedAnswer(**{**missing, "fault": "unknown symbol `X`"}))
    assert not for_a_human(RecordedAnswer(**missing))
