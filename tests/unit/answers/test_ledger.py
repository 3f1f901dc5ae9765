"""What is no answer waits where nothing else answers what it names, else it is set aside."""

from __future__ import annotations

import json
from fractions import Fraction
from typing import Any

import pytest
from msgspec.structs import replace

from dynsolve.answers.judge import Checker
from dynsolve.answers.report import to_json
from dynsolve.grading.cohort import for_a_human
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
        ("$$D[7,7] = m_2$$", 1, "matrix"),
        ("$$(7)\\quad d_{12} = \\frac{d}{dt}(x_9)$$", 1, "x_9"),
        (r"$$\frac{D}{2} = \begin{bmatrix} 1 & 0 \\ 0 & m_2/2 \end{bmatrix}$$", 1, "more than a name"),
        ("Eq(D, Matrix(2, 2, X))", 1, "unknown symbol"),
        (">>> D\nMatrix(2, 2, X)", 1, "no equation"),
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


VALUE = r"\frac{1}{2}(I_{1zz} + m_2 L_2^2)\dot\theta_1^2 + \frac{1}{2} m_2 \dot L_2^2"
ASKED = Checker(replace(load("in3140-rp"), marks={"K": Fraction(2), "g": Fraction(1)}))


@pytest.mark.parametrize(
    ("ending", "text"),
    [
        ("md", "The kinetic energy is $K = {}$."),
        ("md", "- K: $K = {}$"),
        ("md", "* **K:** ${}$"),
        ("md", "1. **K** = ${}$, as wanted"),
        ("md", "- $K$: ${}$"),
        ("md", "## K\n\n$${}$$"),
        ("tex", "\\section*{{$K$}}\n\\[{}\\]"),
        ("md", "- The energy $K$ is ${}$."),
        ("md", "| K | ${}$ |"),
        ("md", "| energy | $K = {}$ | joules |"),
        ("tex", r"so that \(K = {}\) follows"),
        ("tex", r"\item[K:] ${}$"),
        ("tex", r"\textbf{{K}}: ${}$"),
        ("tex", r"\begin{{tabular}}{{ll}} $K$ & ${}$ \end{{tabular}}"),
        ("tex", r"\item[$K$] ${}$"),
        ("md", "so $K \\equiv {}$ holds"),
        ("md", "**K:** $${}$$"),
        ("html", r"<p>The energy is \(K = {}\).</p>"),
    ],
)
@pytest.mark.parametrize(("value", "verdict"), [(VALUE, "correct"), (VALUE.replace("L_2^2", "L_2"), "wrong")])
def test_an_equation_in_a_sentence_is_judged_where_nothing_else_answers_that(
    ending: str, text: str, value: str, verdict: str
) -> None:
    report = ASKED(ASKED.reader(text.format(value), f"a.{ending}"))
    assert [a.verdict.value for a in report.answers if a.name == "K"] == [verdict]
    assert not report.not_recognized and not report.set_aside
    shown = "$$K = 0$$" if ending != "tex" else r"\[K = 0\]"
    with_display = ASKED(ASKED.reader(f"{text.format(value)}\n\n{shown}\n", f"a.{ending}"))
    (answer,) = (a for a in with_display.answers if a.name == "K")
    assert answer.verdict == "wrong" and answer.place is not None
    assert ending == "html" or answer.place.line == 3 + text.count("\n") or text.startswith("|")


@pytest.mark.parametrize("text", ["If $K = 0$, it rests.", "For $K = 0$ it rests.", "Wenn $K = 0$ ist"])
def test_what_a_sentence_supposes_waits(text: str) -> None:
    report = ASKED(ASKED.reader(f"Text.\n\n{text} And so on.\n", "a.md"))
    (answer,) = (a for a in report.answers if a.name == "K")
    assert answer.verdict == "missing"
    assert answer.fault and answer.place and answer.place.line == 3


def test_a_name_that_is_declared_for_a_symbol_is_no_answer() -> None:
    report = ASKED(ASKED.reader("symbols: {K: m2}\nanswers:\n  D: 1\n", "a.yaml"))
    assert not report.not_recognized and not report.set_aside


@pytest.mark.parametrize(
    ("ending", "text", "line"),
    [
        ("md", "so K = see below, with $m_1$", 1),
        ("md", "text\n\n$m_1$ and K(q, qd) = as above", 3),
        ("tex", "text\n\\begin{verbatim}\nK = 3\n\\end{verbatim}\n\\[ x_1 = 3 \\]", 3),
        ("yaml", "let: {K: 3}\nanswers:\n  D: 1\n", 1),
        ("ipynb", '{"cells": [\n{"cell_type": "code", "source": [\n"x = 3\\n",\n"K = m*v**2\\n"]}]}', 4),
    ],
)
def test_what_names_an_answer_where_nothing_is_read_waits(ending: str, text: str, line: int) -> None:
    report = ASKED(ASKED.reader(text, f"a.{ending}"))
    (answer,) = (a for a in report.answers if a.name == "K")
    assert answer.verdict == "missing" and answer.fault
    assert answer.place is not None and answer.place.line == line


@pytest.mark.parametrize(
    ("text", "name"),
    [
        (r"The symbol is $c_{121} = m_2 L_2$, as it was.", "c121"),
        (r"All that matters is $\mathcal L = \frac12 m_2 \dot L_2^2$, thus.", "L"),
        (r"One has $\frac{\partial L}{\partial\dot L_2} = m_2\dot L_2$ here.", "dLdqd2"),
    ],
)
def test_a_sentence_answers_what_is_not_asked_where_a_mass_stands_in_it(text: str, name: str) -> None:
    report = judged(text)
    assert [a["name"] for a in report["answers"] if a["verdict"] in ("correct", "wrong")] == [name]
    without = judged(text.replace("m_2", "3"))
    assert not [a["name"] for a in without["answers"] if a["verdict"] in ("correct", "wrong")]


PICTURES = [
    ("md", "![my D](photo.jpg)"),
    ("tex", r"\includegraphics[width=5cm]{photo.png}"),
    ("md", '<img src="photo.jpg" width=300>'),
    ("html", "<p><img src='photo.jpg'></p>"),
    ("ipynb", json.dumps({"cells": [{"cell_type": "markdown", "source": "![](attachment:a.png)"}]})),
    ("ipynb", json.dumps({"cells": [{"cell_type": "code", "source": "show()", "outputs": [
        {"output_type": "display_data", "data": {"image/png": "AAAA"}}]}]})),
]  # fmt: skip


@pytest.mark.parametrize(("ending", "text"), PICTURES)
def test_a_picture_waits_for_what_is_missing(ending: str, text: str) -> None:
    report = judged(text, ending)
    answer = next(a for a in report["answers"] if a["name"] == "D")
    assert answer["verdict"] == "missing" and "picture" in answer["fault"]["message"]
    assert any("D" in q["name"].split(", ") and "picture" in q["reason"] for q in report["queued"])


def test_a_picture_beside_answers_says_nothing_of_them() -> None:
    report = judged(f"{D}\n\n![](arm.png)\n\n$$C = X_7$$")
    faults = {a["name"]: a.get("fault", {}).get("message", "") for a in report["answers"]}
    assert not faults["D"] and "X_7" in faults["C"] and "picture" in faults["g"]


def test_what_is_there_of_a_matrix_and_what_is_not() -> None:
    report = judged("$$d_{11} = I_{1zz} + m_2 L_2^2$$")
    notes = {a["name"]: a["note"] for a in report["answers"]}
    assert notes["D"] == "d11 is there, but not d12, d22"


@pytest.mark.parametrize("said", ["The energy is $V = m_2 g$.", "We have $p = X_7$ and $P = X_7$."])
def test_a_name_that_nobody_asks_for_is_set_aside(said: str) -> None:
    robot = load("in3140-rp")
    checker = Checker(replace(robot, find=("D",), marks={}))
    report = to_json(checker(checker.reader(f"{said}\n\n{D}", "a.md")))
    assert not report["not_recognized"] and [one["line"] for one in report["set_aside"]]
