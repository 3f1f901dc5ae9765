"""Formulas with one reading are read without the grammar, and as it reads them."""

from __future__ import annotations

import pytest

from dynsolve.answers.reading import answer_file, equation_reader
from dynsolve.answers.reading.plain import plain_member
from dynsolve.answers.reading.vocabulary import vocabulary
from tests.unit.answers.reading.submissions import hand_in, problem, report

SCALARS = [
    "m2*(l1**2 + 2*l1*lc2*cos(q2))",
    r"\frac{1}{2} m_{2} (\dot{q}_{1}^{2} + l_{1}^{2} \dot{q}_{2}^{2}) \cdot 3",
    r"- m_1 \sin^2(q_1) l_{\mathrm{c}1} + 10 \cos q_2",
    "-(m1 - m2)**2*g/2/l1*lc1 - 1.50*m1",
    "m₂·l₁²·q̇₂ - cos(q₁ + q₂)²·q̇₁² + 3·I₂",
    "m1*q1'^2*q2'' + sin q2",
    r"\cos q_2 m_1 \sin^2 q_1 - \dot q_2 \ddot{q}_1",
    r"g \left(m_1 l_1 + m_2\right) \sin\left(q_1 + q_2\right)",
]
MATRICES = [
    "[[m1*l1, 0], [0, -I2]]",
    r"\begin{bmatrix} m_1 l_1^2 & 0 \\ 0 & I_2 \end{bmatrix}",
    r"\left[\begin{matrix}m_1 + m_2 & 0\\0 & I_2\end{matrix}\right]",
]
OTHERS = [
    "m1g", "g(q1)", "m_2^2_1", "m1 l1'", "m1'''", "cos q_1^2", "cos q1(q2)", "m₁₂²g²", "h", "2 3", "m1*-g",
    "(3) m1", "2e1*m1", "m_{1}g", "", "m1*[l1]", "d/dt m1", "m1 == g", "m1)", "((m1)", "m1**0.5", "theta",
]  # fmt: skip


@pytest.mark.parametrize("text", SCALARS + MATRICES)
def test_a_plain_formula_is_read_as_the_grammar_reads_it(text: str, monkeypatch: pytest.MonkeyPatch) -> None:
    name = "D" if text in MATRICES else "K"
    files = [f"$$ {name} = {text} $$", f"answers:\n  {name}: '{text}'\n"]
    assert plain_member(vocabulary(problem("planar-2r")), text, 0, 0, (name,)) is not None
    plain = report(files[0]), hand_in(files[1])
    for module in (equation_reader, answer_file):
        monkeypatch.setattr(module, "plain_member", lambda *_: None)
    assert (report(files[0]), hand_in(files[1])) == plain
    assert plain[0].answers[0].node is not None


@pytest.mark.parametrize("text", OTHERS)
def test_a_formula_that_may_be_read_otherwise_is_left_to_the_grammar(text: str) -> None:
    assert plain_member(vocabulary(problem("planar-2r")), text, 0, 0, ("K",)) is None


def test_the_brace_behind_the_last_sign_belongs_to_a_value() -> None:
    answer = report(r"$$ K = m_1 g \sin q_1 \frac{\dot q_1}{2} $$").answers[0]
    assert answer.text == r"m_1 g \sin q_1 \frac{\dot q_1}{2}"
