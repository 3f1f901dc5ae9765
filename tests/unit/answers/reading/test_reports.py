"""Reports: which equations are read, as what, and with which number."""

from __future__ import annotations

import json
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


def report(text: str, file: str = "report.md", stem: str = "planar-2r") -> Submission:
    return read_submission(problem(stem), text, file)


def named(found: Submission) -> list[tuple[str, str]]:
    return [(answer.name, answer.label) for answer in found.answers]


def shown(answer: Answer) -> str:
    assert answer.node is not None, answer.fault
    return to_unicode(answer.node)


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


def test_what_stands_after_a_comma_is_not_dropped() -> None:
    (answer,) = report("$$K = m_1, m_2$$").answers
    assert "`,`" in answer.fault


def test_every_value_of_a_chain_is_an_answer_to_every_name() -> None:
    found = report(r"$$K_1 = K_{v_1} + K_{\omega_1} = m_1 = m_1 + 0$$ $$d_{12} = d_{21} = I_2$$")
    assert [(a.name, a.occurrence) for a in found.answers] == [
        ("K1", (1, 2)),
        ("K1", (1, 3)),
        ("d12", (2, 2)),
        ("d21", (2, 2)),
    ]


def test_rows_go_on_with_a_chain() -> None:
    found = report("\\begin{align}\nP &= P_1 + P_2 \\\\\n &= m_1 g \\\\\n &\\quad + m_2 g\n\\end{align}")
    assert [shown(answer) for answer in found.answers] == ["m₁ g + m₂ g"]


def test_an_abbreviation_holds_for_what_follows() -> None:
    found = report("$$h = -m_2 l_1 l_{c2} s_2$$ $$c_{221} = h$$ $$c_{211} = c_{121} = h$$")
    assert [a.name for a in found.answers] == ["c221", "c211", "c121"]
    assert {shown(answer) for answer in found.answers} == {"-m₂ l₁ l_c2 sin(q₂)"}


def test_what_is_not_defined_is_unreadable_and_says_what_there_is() -> None:
    (answer,) = report("$$\\tau_1 = k \\dot q_1$$").answers
    assert answer.node is None
    assert "`k`" in answer.fault
    assert "lc1" in answer.expected


def test_macros_are_written_out() -> None:
    text = (
        r"\newcommand{\td}{\dot{\theta}_1} \newcommand{\tdd}[1]{\ddot{\theta}_{#1}} \def\lc{l_{c1}}"
        r" \DeclareMathOperator{\sn}{sin} $$\tau_1 = m_1 \lc \td^2 + \tdd{2} + \sn(q_1)$$"
    )
    assert [shown(answer) for answer in report(text, "report.tex").answers] == ["m₁ l_c1 q̇₁² + q̈₂ + sin(q₁)"]


def test_comments_of_latex_are_left_out() -> None:
    assert named(report("% $$ K = 3 $$\n\\[ P = m_1 % + m_2\n + l_1 \\]", "report.tex")) == [("P", "")]


def test_an_index_that_is_none_is_the_one_answer_that_is_absent() -> None:
    found = report("$$\\tau_1 = m_1$$ $$\\tau_3 = m_2$$")
    assert [a.name for a in found.answers] == ["tau1", "tau2"]
    assert "taken for tau2" in " ".join(found.answers[1].notes)


def test_an_index_that_is_none_is_not_recognized_where_two_are_absent() -> None:
    found = report("$$\\tau_3 = m_2$$", stem="scara-rrpr")
    assert [a.name for a in report("$$\\tau_9 = m_2$$", stem="scara-rrpr").answers] == []
    assert found.answers[0].name == "f3"


def test_the_model_in_matrices_gives_its_parts() -> None:
    model = (
        r"$$\tau = \begin{bmatrix} m_1 & 0 \\ 0 & m_2 \end{bmatrix}"
        r"\begin{bmatrix} \ddot q_1 \\ \ddot q_2 \end{bmatrix}"
        r" + \begin{bmatrix} 0 & I_1 \\ 0 & 0 \end{bmatrix}\begin{bmatrix} \dot q_1 \\ \dot q_2 \end{bmatrix}"
        r" + \begin{bmatrix} g \\ 0 \end{bmatrix}$$"
    )
    found = report(model)
    assert [a.name for a in found.answers] == ["D", "C", "g", "tau"]
    assert [a.name for a in report(r"$$\tau_1 = m_1$$ $$\tau_2 = m_2$$" + model).answers] == [
        "tau1",
        "tau2",
        "D",
        "C",
        "g",
    ]


def test_a_zero_level_of_height_stays_a_symbol() -> None:
    (answer,) = report("$$P_1 = m_1 g (l_{c1} s_1 + h_0)$$").answers
    assert answer.free == ("h0",)


def test_what_a_symbol_of_the_problem_is_said_to_be_is_no_answer() -> None:
    found = report("$$g = 9.81 m/s^2$$ $$I_1 = \\frac{1}{12} m_1 l_1^2$$ $$m_1 = 3\\,\\text{kg}$$")
    assert found.answers == ()
    assert len(found.not_recognized) == 3


def test_a_moment_of_inertia_without_its_body_is_that_of_the_answer() -> None:
    (answer,) = report("$$K_{\\omega_2} = \\frac12 I_{zz} \\dot\\theta_1^2$$", stem="elbow-3r").answers
    assert "I_2zz" in shown(answer)
    assert answer.notes


def test_equations_without_a_name_are_listed() -> None:
    found = report("$$x + y = 3$$ $$v_2^2 = l_1^2$$ $$K = m_1$$")
    assert [refused.text for refused in found.not_recognized][:1] == ["x + y = 3"]
    assert named(found) == [("K", "")]


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


def test_a_notebook_is_read_by_its_markdown_cells() -> None:
    cells = [
        {"cell_type": "markdown", "source": ["# Title\n", "$$K = m_1$$\n", "text"]},
        {"cell_type": "code", "source": ["K = 3"], "outputs": []},
        {"cell_type": "markdown", "source": "\\begin{equation}\nP = m_2 g\n\\end{equation}"},
    ]
    text = json.dumps({"cells": cells, "nbformat": 4}, indent=1)
    found = report(text, "report.ipynb")
    assert named(found) == [("K", ""), ("P", "")]
    place = found.answers[0].place
    assert "$$K = m_1$$" in text.splitlines()[place.line - 1]


PAGES = [
    "<p>\\[ K = m_1 \\]</p>",
    "<p><span class='math display'>\\[K = m_1\\]</span></p>",
    "<div>$$K = m_1$$</div>",
    "<script type='math/tex; mode=display'>K = m_1</script>",
    "<span class='katex-display'><span class='katex'><span class='katex-mathml'><math><semantics><mi>K</mi>"
    "<annotation encoding='application/x-tex'>K = m_1</annotation></semantics></math></span>"
    "<span class='katex-html'>K=m1</span></span></span>",
    "<script>var x = '$$P = 3$$';</script><p>$$K = m_1$$</p>",
    "<p>$$K = m_1 &amp; $$</p>".replace(" &amp;", ""),
    "<!-- $$P = 3$$ --><p>$$K = m_1$$</p>",
    r"<p>so \(P = 3\) at rest</p><p><span class='nolink'>\(K = m_1\)</span></p>",
    "<p><img class='equation_image' title='K = m_1' src='/equation_images/K' alt='LaTeX: K = m_1' "
    "data-equation-content='K = m_1'></p>",
    "<p><img class='equation_image' src='/equation_images/K' alt='LaTeX: K = m_1'></p>",
    "<p><img class='texrender' title='K = m_1' alt='K = m_1' src='/filter/tex/pix.php/1.gif'></p>",
    "<p>so <img class='equation_image' data-equation-content='P = 3'> holds, $$K = m_1$$ <img src='x'></p>",
]


@pytest.mark.parametrize("text", PAGES)
def test_a_web_page_is_read_by_its_formulas(text: str) -> None:
    found = report(f"<html><head><title>x</title></head>\n<body>{text}</body></html>", "report.html")
    assert named(found) == [("K", "")]
    assert found.answers[0].place.line == 2
