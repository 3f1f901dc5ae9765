"""Singular configurations, branches and spaces in reports, where students write no name before them."""

from __future__ import annotations

import pytest

from tests.unit.answers.hands import checker

TWO_LINKS = """
dh: [{theta: q1*, a: l1}, {theta: q2*, a: l2}]
task: [tip.x, tip.y]
reach: [px, py]
state: {q2: 0}
find: [det, singular, inverse, nullspace, rangespace, lost]
"""
NUMBERS = """
dh: [{theta: q1*, a: 1}, {theta: q2*, a: 1}]
reach: [1, 1]
find: [inverse]
"""
ELBOW = """
dh: [{theta: q1*, d: d1, alpha: 90deg}, {theta: q2*, a: a2}, {theta: q3*, a: a3}]
reach: [x, y, z]
find: [singular, inverse]
"""
RPR = """
dh: [{theta: q1*, d: d1, alpha: 90deg}, {theta: 90deg, d: q2*, alpha: 90deg}, {theta: q3*, a: a3}]
find: [det, singular]
"""
BALANCE = """
gravity: [0, -g, 0]
dh: [{theta: q1*, a: l1}, {theta: q2*, a: l2}]
masses: [{mass: m1, link: 1}, {mass: m2, link: 2}]
find: [singular, equilibria]
"""

ATAN = r"\operatorname{atan2}"
C2 = r"\frac{p_x^2 + p_y^2 - l_1^2 - l_2^2}{2 l_1 l_2}"
Q1 = rf"q_1 = {ATAN}(p_y, p_x) - {ATAN}(l_2 \sin q_2, l_1 + l_2 \cos q_2)"
SYMPY_Q1 = Q1.replace("(", r"{\left(").replace(")", r"\right)}")

# (the problem, the report, the verdicts)
REPORTS = [
    (TWO_LINKS, r"$$\det J = l_1 l_2 \sin q_2 = 0 \quad\Rightarrow\quad q_2 = 0, \pi$$",
     {"det": "correct", "singular": "correct"}),
    (TWO_LINKS, r"$$|J| = l_1 l_2 s_2$$ The arm is singular where $$\sin q_2 = 0 \text{ or } q_2 = \pi.$$",
     {"singular": "correct"}),
    (TWO_LINKS, "Singular configurations:\n\n$$q_2 = 0$$", {"singular": "wrong"}),
    (TWO_LINKS, "We look at\n\n$$q_2 = 0$$", {"singular": "missing"}),
    (TWO_LINKS, rf"$$q_2 = \pm\arccos {C2}$$ $${Q1}$$", {"inverse": "correct", "singular": "missing"}),
    (TWO_LINKS, rf"$$D = {C2}$$ $$q_2 = {ATAN}(\pm\sqrt{{1 - D^2}}, D)$$ $${Q1}$$", {"inverse": "correct"}),
    (TWO_LINKS, rf"\begin{{align}} D &= {C2} \\ q_2 &= \pm\arccos D, \\ {Q1.replace('=', '&=', 1)}"
                r"\end{align}",
     {"inverse": "correct"}),
    (TWO_LINKS, rf"$$\cos q_2 = {C2}, \quad \sin q_2 = \pm\sqrt{{1 - \cos^2 q_2}}$$"
                rf" $$q_2 = {ATAN}(\sin q_2, \cos q_2)$$ $${Q1}$$", {"inverse": "correct"}),
    (TWO_LINKS, rf"$$c_2 = {C2} \Rightarrow q_2 = \pm\cos^{{-1}}(c_2)$$ $${Q1}$$", {"inverse": "correct"}),
    (TWO_LINKS, rf"$$q_2 = \pm\arccos {C2}$$ $${SYMPY_Q1}$$",
     {"inverse": "correct"}),
    (TWO_LINKS, rf"$$q_2 = \arccos {C2}$$ $${Q1.replace('-', '+')}$$", {"inverse": "wrong"}),
    (NUMBERS, "Both solutions:\n\n$$q_1 = 0, \\quad q_2 = \\pi/2$$\n\n$$q_1 = \\pi/2, \\quad q_2 = -\\pi/2$$",
     {"inverse": "correct"}),
    (ELBOW, r"Singularities: $$s_3 = 0 \quad \text{or} \quad a_2 c_2 + a_3 c_{23} = 0$$",
     {"singular": "correct"}),
    (ELBOW, rf"$$r = \sqrt{{x^2 + y^2}}, \quad s = z - d_1$$"
            rf" $$D = \frac{{r^2 + s^2 - a_2^2 - a_3^2}}{{2 a_2 a_3}}$$"
            rf" $$\theta_1 = {ATAN}(y, x)$$ $$\theta_3 = {ATAN}(\pm\sqrt{{1 - D^2}}, D)$$"
            rf" $$\theta_2 = {ATAN}(s, r) - {ATAN}(a_3 s_3, a_2 + a_3 c_3)$$", {"inverse": "correct"}),
    (TWO_LINKS, r"The arm is singular for $q_2 = 0$ and $q_2 = \pi$, stretched or folded.",
     {"singular": "correct"}),
    (TWO_LINKS, "It is not singular for $q_2 = 1$. There it loses rank: it does so where $s_2 = 0$.",
     {"singular": "correct"}),
    (TWO_LINKS, "It is singular at $q_2 = 0$.", {"singular": "wrong"}),
    (RPR, r"$$\det J = a_3 s_3 (q_2 + a_3 s_3) = 0$$", {"det": "correct", "singular": "correct"}),
    (RPR, "The rank is less for\n\n$$s_3 = 0$$\n\nand also for\n\n$$q_2 = -a_3 s_3$$",
     {"singular": "correct"}),
    (BALANCE, "It is singular at\n\n$$s_2 = 0$$\n\nIn equilibrium\n\n$$c_1 = 0 \\text{ and } s_2 = 0$$",
     {"singular": "correct", "equilibria": "correct"}),
    (BALANCE, "## Equilibria\n\nequilibria:\n\n## The gravity terms\n\n"
              r"$$\mathbf{g} = \begin{bmatrix} g (m_1 + m_2) l_1 c_1 + m_2 g l_2 c_{12} \\ "
              r"m_2 g l_2 c_{12} \end{bmatrix}$$",
     {"g": "correct", "equilibria": "missing"}),
    (TWO_LINKS, r"$$\mathcal{N}(J) = \mathrm{span}\left\{"
                r"\begin{bmatrix} l_2 \\ -l_1 - l_2 \end{bmatrix}\right\}$$"
                r" $$\mathcal{R}(J) = \text{span}\{[-s_1, c_1]^T\}$$"
                r" $$\ker J^T = \alpha \begin{bmatrix} c_1 \\ s_1 \end{bmatrix}$$",
     {"nullspace": "correct", "rangespace": "correct", "lost": "correct"}),
]  # fmt: skip


SENTENCES = [(TWO_LINKS, text, {name: verdict}) for name, verdict, text in [
    ("singular", "correct", r"The arm is singular for $q_2=0$ (stretched) and $q_2=\pi$ (folded)."),
    ("singular", "correct", r"Singulært er $q_2=0$ (strak) og $q_2=\pi$ (foldet)."),
    ("singular", "correct", r"Its determinant vanishes if $q_2=0$ or $q_2=\pi$. So far."),
    ("singular", "unreadable", r"The arm is singular for $q_2=0$ and, when it is folded, $q_2=\pi$."),
    ("singular", "correct", r"Singularities: $q_2=0$ or $q_2=\pi$. Else it moves."),
    ("singular", "correct", r"Singularities: $q_2\in\{0,\pi\}$, the arm is straight."),
    ("singular", "unreadable", r"Singularities: $q_2=0$, and then the folded arm."),
    ("singular", "correct", r"Not singular: $q_2=\pi/2$. Singular: $q_2=0$, $q_2=\pi$."),
    ("inverse", "correct", rf"Then $q_2=\pm\arccos {C2}$ and ${Q1}$, both."),
    ("inverse", "correct", rf"$q_2=\pm\arccos {C2}$ and ${Q1}$."),
    ("inverse", "correct", rf"So $q_2=\pm\arccos {C2}$. The first angle is then $${Q1}$$"),
    ("inverse", "unreadable", rf"So $q_2=\pm\arccos X_9$. The first angle is then $${Q1}$$"),
    ("inverse", "correct", rf"So $q_2=\pm\arccos {C2}$. Then $${Q1}$$ Singular are $q_2=0$ and $q_2=\pi$."),
    ("inverse", "wrong", rf"The first angle is $${Q1}$$"),
]]  # fmt: skip
"""A set of a sentence is judged whole, or waits."""


@pytest.mark.parametrize(("problem", "text", "verdicts"), [*REPORTS, *SENTENCES])
def test_sets_of_a_report(problem: str, text: str, verdicts: dict[str, str]) -> None:
    check = checker(problem)
    for ending in (".md", ".tex"):
        report = check(check.reader(text + "\n", f"answer{ending}"))
        found = {answer.name: answer.verdict for answer in report.answers}
        assert {name: found.get(name) for name in verdicts} == verdicts, report.answers


def test_both_signs_in_words_are_two_branches() -> None:
    check = checker(TWO_LINKS)
    c2 = "(px^2 + py^2 - l1^2 - l2^2)/(2*l1*l2)"
    text = f"q2 = +acos({c2}) or -acos({c2})\nq1 = atan2(py, px) - atan2(l2*sin(q2), l1 + l2*cos(q2))\n"
    report = check(check.reader(text, "answer.txt"))
    assert {a.name: a.verdict for a in report.answers}["inverse"] == "correct"
