"""Reports: which equations are read, as what, and with which number."""

from __future__ import annotations

import pytest

from tests.unit.answers.reading.submissions import named, report, shown

DISPLAYS = [
    ("$$K = m_1$$", [("K", "")]),
    ("text $$K = m_1$$ text", [("K", "")]),
    ("$$\nK = m_1\n$$", [("K", "")]),
    (r"\[ K = m_1 \]", [("K", "")]),
    (r"\\[ K = m_1 \\]", [("K", "")]),
    (r"\(K = m_1\)", [("K", "")]),
    (r"so \(K = m_1\) holds", []),
    (r"\begin{equation} K = m_1 \end{equation}", [("K", "")]),
    (r"\begin{equation*} K = m_1 \end{equation*}", [("K", "")]),
    (r"\begin{align} K &= m_1 \\ P &= m_2 \end{align}", [("K", ""), ("P", "")]),
    (r"\begin{align*} K &= m_1, \\ P &= m_2. \end{align*}", [("K", ""), ("P", "")]),
    (r"$$\begin{aligned} K &= m_1 \\ P &= m_2 \end{aligned}$$", [("K", ""), ("P", "")]),
    (r"\begin{gather} K = m_1 \\ P = m_2 \end{gather}", [("K", ""), ("P", "")]),
    (r"\begin{eqnarray} K & = & m_1 \\ P & = & m_2 \end{eqnarray}", [("K", ""), ("P", "")]),
    (r"\begin{multline} K = m_1 \\ + m_2 \end{multline}", [("K", "")]),
    (r"\begin{alignat}{2} K &= m_1 & P &= m_2 \end{alignat}", [("K", ""), ("P", "")]),
    (r"$$\left\{ \begin{array}{l} K = m_1 \\ P = m_2 \end{array} \right.$$", [("K", ""), ("P", "")]),
    (r"$$\begin{array}{rcl} K &=& m_1 \\ P &=& m_2 \end{array}$$", [("K", ""), ("P", "")]),
    (r"$$\begin{cases} K = m_1 \\ P = m_2 \end{cases}$$", [("K", ""), ("P", "")]),
    ("```math\nK = m_1\n```", [("K", "")]),
    ("```\nK = m1\n```", [("K", "")]),
    ("$K = m_1$", [("K", "")]),
    ("- $K = m_1$\n- $P = m_2$", [("K", ""), ("P", "")]),
    ("We see that $K = m_1$ here.", []),
    (r"$$K = m_1 \tag{7}$$", [("K", "(7)")]),
    (r"$$K = m_1 \qquad (7)$$", [("K", "(7)")]),
    ("$$K = m_1$$ (7)", [("K", "(7)")]),
    ("$$K = m_1$$\n(7)", [("K", "(7)")]),
    ("$$K = m_1$$\n\n$$(7)$$", [("K", "(7)")]),
    (r"\begin{align} K &= m_1 \tag{1} \\ P &= m_2 \tag{2b} \end{align}", [("K", "(1)"), ("P", "(2b)")]),
    (r"$$K = m_1, \quad P = m_2$$", [("K", ""), ("P", "")]),
    (r"$$K = m_1 \quad\text{and}\quad P = m_2$$", [("K", ""), ("P", "")]),
    (r"$$K = m_1 \implies P = m_2$$", [("K", ""), ("P", "")]),
    (r"$$K = m_1 \quad + m_2 \quad = m_2 + m_1, \quad i = 1, 2$$", [("K", ""), ("K", "")]),
    (r"$$\Rightarrow\quad K = m_1$$", [("K", "")]),
    (r"$$m_1 + m_2 = K$$", [("K", "")]),
    (r"$$K = \left. m_1 \right.$$", [("K", "")]),
    (r"$$\boxed{K = m_1}$$", [("K", "")]),
    (r"$$ K = m_1 \; [\text{J}] $$", [("K", "")]),
]


@pytest.mark.parametrize(("text", "names"), DISPLAYS)
def test_displays_with_their_numbers(text: str, names: list[tuple[str, str]]) -> None:
    assert named(report(text + "\n")) == names


def test_macros_are_written_out() -> None:
    text = (
        r"\newcommand{\td}{\dot{\theta}_1} \newcommand{\tdd}[1]{\ddot{\theta}_{#1}} \def\lc{l_{c1}}"
        r" \DeclareMathOperator{\sn}{sin} $$\tau_1 = m_1 \lc \td^2 + \tdd{2} + \sn(q_1)$$"
    )
    assert [shown(answer) for answer in report(text, "report.tex").answers] == ["m₁ l_c1 q̇₁² + q̈₂ + sin(q₁)"]


def test_comments_of_latex_are_left_out() -> None:
    assert named(report("% $$ K = 3 $$\n\\[ P = m_1 % + m_2\n + l_1 \\]", "report.tex")) == [("P", "")]


PLAIN = """Oblig 3

P1 = m1*g*lc1*sin(q1)
P = P1 + P2
  = m1*g*lc1*sin(q1) +
    m2*g*lc2*sin(q1+q2)
h = -m2*l1*lc2*s2
C = [ h*q2', h*(q1' + q2')
     -h*q1', 0 ]
dL/dq1' = m1*lc1^2*q1'
d/dt(dL/dq1') = m1*lc1^2*q1''
tau = [m1;
       m2]
So the answer is: x = 3
g = [cos(q(1)); m2*dq(2)^2]
"""


def test_plain_text_is_read_line_by_line() -> None:
    found = report(PLAIN, "report.txt")
    assert [a.name for a in found.answers] == ["P1", "P", "C", "dLdqd1", "ddt1", "tau", "g"]
    assert all(answer.node is not None for answer in found.answers)
    assert shown(found.answers[1]) == "m₁ g l_c1 sin(q₁) + m₂ g l_c2 sin(q₁ + q₂)"
    assert found.answers[0].place.line == 3
    assert shown(found.answers[-1]) == "[[cos(q₁)], [m₂ q̇₂²]]"
