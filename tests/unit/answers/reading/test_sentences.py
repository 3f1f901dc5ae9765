"""What the words of a report say of a formula: a condition, a case, a rejected attempt, a quotation."""

from __future__ import annotations

from typing import Any

import pytest

from dynsolve.answers.judge import Checker
from dynsolve.answers.reading.files import read_submission
from dynsolve.problem import read_problem

ARM = """
gravity: [0, 0, -g]
model:
  coordinates: {q1: prismatic, q2: revolute}
  D: [[M + m, m*l*cos(q2)], [m*l*cos(q2), m*l^2]]
  P: M*g*q1 + m*g*l*sin(q2)
find: [D, C, g, P]
"""
CHECKER = Checker(read_problem(ARM))
P, SLIP = r"Mgq_1+mgl\sin q_2", r"Mgq_1+mgl\cos q_2"
D = r"$$D=\begin{{pmatrix}}M+m&ml\,{0}\\ml\,{0}&ml^2\end{{pmatrix}}$$"


def judged(text: str, ending: str = "md") -> Any:
    return CHECKER(read_submission(CHECKER.problem, text, f"report.{ending}"))


def verdicts(text: str, ending: str = "md") -> dict[str, str]:
    return {answer.name: answer.verdict.value for answer in judged(text, ending).answers}


@pytest.mark.parametrize("text", [
    "Likevekt krever $g(q)=0$, der {0}", "Equilibrium requires that $g(q)=0$ with {0}",
    "Gleichgewicht verlangt $g(q)=0$. {0}", "{0} The arm is free, ($\\tau=0$). With $g=0$ it floats.",
    "$g(q)=0$ when the arm is at rest. {0}", "Aus $g(q)=0$ folgt die Ruhelage. {0}",
])  # fmt: skip
def test_a_condition_is_no_value(text: str) -> None:
    for sign, expected in (("", "correct"), ("-", "wrong")):
        found = verdicts(text.format(f"$g_1=Mg$ and $g_2={sign}mgl\\cos q_2$."))
        assert found.get("tau") in (None, "missing") and found["g2"] == expected
        assert expected == "wrong" or "wrong" not in found.values()


@pytest.mark.parametrize("zero", ["0", r"\begin{bmatrix}0\\0\end{bmatrix}"])
@pytest.mark.parametrize("form", ["$${0}={1}$$", "The equilibria follow from ${0}={1}$, which gives them."])
def test_a_condition_at_the_end_of_a_chain_is_no_value(form: str, zero: str) -> None:
    for entry, expected in ((r"mgl\cos q_2", "correct"), (r"mgl\sin q_2", "wrong")):
        value = rf"g(q)=\begin{{bmatrix}}Mg\\{entry}\end{{bmatrix}}"
        assert verdicts(form.format(value, zero))["g"] == expected


CASES = [
    "For $q_2=0$ this becomes", "Im Sonderfall $q_2=0$ wird", "Utstrakt arm, $q_2=0$:", "If there is no load,"
    " we would get", "At first we had", "The book gives", "I boka står det",
    "The book (7.87) has", "In the book,", "Im Skript",
    "Vergleich mit dem Skript: dort steht",
    "One could think that",
    "Zuerst hatten wir", "Check ($M=0$):", "With $m=1\\,\\mathrm{kg}$:",
]  # fmt: skip


@pytest.mark.parametrize("case", CASES)
@pytest.mark.parametrize(
    "form", ["$${1}$$\n\n{0} $${2}$$", "{0} $${2}$$\n\nIn general $${1}$$", "$${1}$$ {0} ${2}$."]
)
def test_what_does_not_hold_in_general_gives_way(case: str, form: str) -> None:
    for value, other, expected in ((P, SLIP, "correct"), (SLIP, P, "wrong")):
        report = judged(form.format(case, f"P={value}", f"P={other}"))
        assert {a.name: a.verdict.value for a in report.answers}["P"] == expected
        assert len([one for one in report.set_aside if "P" in one.answers]) == 1


@pytest.mark.parametrize(
    "form", ["$g_1=Mg$, $g_2={0}$; horizontally $g_2=0$.", "$g_2={0}$. Drawn down, $g_2=mgl$, $g_1=Mg$."]
)
def test_a_number_in_a_sentence_is_no_general_answer(form: str) -> None:
    """Where letters answer the same."""
    for value, expected in ((r"mgl\cos q_2", "correct"), (r"mgl\sin q_2", "wrong")):
        assert verdicts(form.format(value))["g2"] == expected


@pytest.mark.parametrize(
    "case", ["For $q_2=0$:", "- Für $q_2 = 0$ gilt", "for $q_2=0$ we get", "When $q_2=\\pi$,"]
)
def test_a_case_alone_waits(case: str) -> None:
    report = judged(f"{case} $g_2 = mgl$")
    assert {answer.verdict for answer in report.answers} == {"missing"}
    assert ["g2" in one.answers for one in report.not_recognized] == [True]


def test_a_rejected_attempt_gives_way_within_its_sentence() -> None:
    form = "One could think that $g_2={0}$, but the arm turns the other way, so $g_2={1}$."
    right, slip = r"mgl\cos q_2", r"-mgl\cos q_2"
    assert verdicts(form.format(slip, right))["g2"] == "correct"
    assert verdicts(form.format(right, slip))["g2"] == "wrong"


@pytest.mark.parametrize("form", [
    "Using ${0}={1}$ we have\n" + D, D + "\nwith ${0}={1}$.", "$${0}={1}$$\n" + D,
    "Let ${0}={1}$. Then\n" + D, D + "\nwhere ${0} = {1}$ and $h=2$.",
])  # fmt: skip
@pytest.mark.parametrize("name", [r"c_{21}", r"c_{\alpha}", "C", "S", "E", "H", "A"])
def test_a_letter_means_what_the_report_says(name: str, form: str) -> None:
    for angle, expected in (("q_2", "correct"), ("(q_2+q_2)", "wrong")):
        value = rf"\{'sin' if name == 'S' else 'cos'}{{{angle}}}"
        if name == "S":
            value = rf"\sin({angle}+\pi/2)"
        found = verdicts(form.format(name, value))
        assert found["D"] == expected
        assert expected == "wrong" or "wrong" not in found.values()


@pytest.mark.parametrize("form", [
    "We write $z$ for $q_1$ and $\\varphi$ for $q_2$.",
    "Wir schreiben $z$ für $q_1$ und $\\varphi$ für $q_2$.",
    "Vi skriver $z$ for $q_1$ og $\\varphi$ for $q_2$.",
    "Using $z$ instead of $q_1$ and $\\varphi$ instead of $q_2$:",
])  # fmt: skip
def test_a_letter_for_a_coordinate(form: str) -> None:
    matrix = r"$$C=\begin{pmatrix}0&-ml\dot\varphi\sin\varphi\\0&0\end{pmatrix},\quad P=Mgz+mgl\%s\varphi$$"
    assert [verdicts(f"{form}\n{matrix % 'sin'}")[name] for name in "CP"] == ["correct", "correct"]
    assert verdicts(f"{form}\n{matrix % 'cos'}")["P"] == "wrong"


@pytest.mark.parametrize("word", ["let ", "Let ", "sei ", "with ", ""])
def test_a_definition_in_plain_text(word: str) -> None:
    for angle, expected in (("q2", "correct"), ("2*q2", "wrong")):
        assert verdicts(f"{word}d = {angle}\nP = M*g*q1 + m*g*l*sin(d)\n", "txt")["P"] == expected


@pytest.mark.parametrize("table", [
    "| entry | value |\n|---|---|\n"
    "| $d_{{11}}$ | $M+m$ |\n| $d_{{12}}=d_{{21}}$ | ${0}$ |\n| $d_{{22}}$ | $ml^2$ |",
    "| $d_{{11}}$ | $d_{{12}}=d_{{21}}$ | $d_{{22}}$ |\n|:-:|:-:|:-:|\n| $M+m$ | ${0}$ | $ml^2$ |",
])  # fmt: skip
def test_entries_in_a_table(table: str) -> None:
    for value, expected in ((r"ml\cos q_2", "correct"), (r"ml\sin q_2", "wrong")):
        report = judged(f"The entries are\n\n{table.format(value)}\n\nas expected.")
        assert next(answer for answer in report.answers if answer.name == "D").verdict.value == expected
        assert all(
            "|" in answer.place.excerpt for answer in report.answers if answer.name == "d12" and answer.place
        )


def test_what_letters_mean_behind_an_equation_in_plain_text() -> None:
    for angle, expected in (("q2", "correct"), ("2*q2", "wrong")):
        text = f"P = M*g*z + m*g*l*sin(d)   (z = q1, d = {angle})\n"
        assert verdicts(text, "txt")["P"] == expected


def test_an_approximation_is_no_value() -> None:
    for value, expected in ((P, "correct"), (SLIP, "wrong")):
        assert verdicts(rf"$$P={value}\approx Mgq_1+mglq_2$$")["P"] == expected


@pytest.mark.parametrize("text", [
    r"Let $\theta = q_2$ be the angle.", r"We write $\sin q_2 = s_2$.", r"Here $\varphi := \psi$.",
])  # fmt: skip
def test_another_name_is_no_answer(text: str) -> None:
    problem = read_problem(ARM.replace("m*l*cos(q2)", "m*l*cos(q2 - psi)").replace("[D,", "[equilibria, D,"))
    report = Checker(problem)(read_submission(problem, text, "a.md"))
    assert not [one for one in (*report.set_aside, *report.not_recognized) if one.answers or one.waits]


def test_the_model_in_letters_calls_no_force() -> None:
    text = r"$$\tau = D\ddot q + C\dot q + F\dot q + g$$"
    problem = read_problem(f"{ARM}friction: {{q1: b}}\n".replace("[D,", "[tau, D,"))
    (said,) = read_submission(problem, text, "a.md").left_alone
    assert "drives" not in said.why
