"""The notations in which people write one formula, each beside the formula in plain text."""

from __future__ import annotations

import random
from functools import cache

import pytest

from dynsolve.answers.reading.files import read_submission
from dynsolve.answers.verdict import Answer
from dynsolve.notation.text import read
from dynsolve.notation.tree import Node
from dynsolve.notation.tree_values import evaluate
from dynsolve.problem import Problem, load
from dynsolve.problem.reader import find


@cache
def problem(stem: str) -> Problem:
    return load(find(stem))


def answer(stem: str, name: str, text: str, head: str = "") -> Answer:
    """The one answer of a file that gives a value under a name."""
    content = f"{head}answers:\n  {name}: {text}\n"
    answers = read_submission(problem(stem), content, "answer.yaml").answers
    assert len(answers) == 1, answers
    return answers[0]


STATE = random.Random(4)


def values(stem: str) -> dict[str, float]:
    """A random state of a robot, with random parameters."""
    robot = problem(stem).robot
    names = [q.name + dots for q in robot.coordinates for dots in ("", "_dot", "_ddot")]
    return {name: STATE.uniform(0.3, 1.7) for name in (*names, *robot.parameters)}


def same(stem: str, node: Node | None, expected: str) -> bool:
    """Whether a tree has the value of a formula in plain text, at a random state."""
    assert node is not None
    at = values(stem)
    return bool(evaluate(node, at) == pytest.approx(evaluate(read(expected, dots=True).tree, at), rel=1e-12))


ELBOW = [
    # plain text
    ("m1*g*lc1*cos(q1)", "m1*g*lc1*cos(q1)"),
    ("m1 g lc1 cos(q1)", "m1*g*lc1*cos(q1)"),
    ("m1*g*lc1*c1 + m2*g*lc2*c12", "m1*g*lc1*cos(q1) + m2*g*lc2*cos(q1 + q2)"),
    ("m1*g*lc1*c_1 + m2*g*lc2*c_{12}", "m1*g*lc1*cos(q1) + m2*g*lc2*cos(q1 + q2)"),
    ("m1*g*lc1*cos q1", "m1*g*lc1*cos(q1)"),
    ("0.5*m1*(lc1*q1')^2", "m1*lc1**2*q1_dot**2/2"),
    ("1/2 m1 lc1^2 q1'^2", "m1*lc1**2*q1_dot**2/2"),
    ("1/2*m1*lc1**2*q1_dot**2", "m1*lc1**2*q1_dot**2/2"),
    ("I1*qdot1 + I2*dq2", "I1*q1_dot + I2*q2_dot"),
    ("I1*qddot1 + I2*ddq2", "I1*q1_ddot + I2*q2_ddot"),
    ("I1*qdd1 + I2*qd2", "I1*q1_ddot + I2*q2_dot"),
    ("I1*q1'' + I2*q2'", "I1*q1_ddot + I2*q2_dot"),
    ("I1*q̈1 + I2*q̇₂²", "I1*q1_ddot + I2*q2_dot**2"),
    ("I1*theta1 + I2*θ̇2", "I1*q1 + I2*q2_dot"),
    ("½ m₁ lc1² q̇₁²", "m1*lc1**2*q1_dot**2/2"),
    (r"I_1(\sqrt{\dot q_1^2 + \dot q_2^2})^2 + I_2\sqrt{m_1}^4", "I1*(q1_dot**2 + q2_dot**2) + I2*m1**2"),
    # what is crossed out, put in boxes or braces
    (r"m_1g - \cancel{m_2g} + \cancelto{0}{m_2}", "m1*g"),
    (r"\frac{\cancel{2}m_1g}{\bcancel{2}}\xcancel{+ m_2}", "m1*g"),
    (r"\underbrace{m_1g}_{\text{weight}}l_1 + \overbrace{m_2}^{=a}g", "m1*g*l1 + m2*g"),
    (r"\fbox{$m_1g$} \checkmark", "m1*g"),
    ("I1*q1̈ + I2*q₂̇²", "I1*q1_ddot + I2*q2_dot**2"),
    # TeX takes one character, or one command, as an argument
    (r"\frac g2m_1l_1", "g*m1*l1/2"),
    (r"\frac{m_1}2l_1^2 + \frac12m_2 + \frac1{2}I_1 + \frac {I_2}34", "m1*l1**2/2 + m2/2 + I1/2 + 4*I2/3"),
    (r"\frac m_12 + \dfrac{m_2g}2l_1", "m1/2 + m2*g*l1/2"),
    (r"\frac\pi2m_1 + \frac{\frac g2m_1}3", "pi*m1/2 + g*m1/6"),
    (r"m_1\sqrt2l_1 + m_2\sin^22q_1", "m1*sqrt(2)*l1 + m2*sin(2*q1)**2"),
    ("I1·q̇₁ − I2×q̇₂", "I1*q1_dot - I2*q2_dot"),
    ("sqrt(2)*m1 + √2 m2", "sqrt(2)*(m1 + m2)"),
    ("sin 2q1 m1", "sin(2*q1)*m1"),
    ("sin^2(q1)*m1 + sin²(q2)*m2", "sin(q1)**2*m1 + sin(q2)**2*m2"),
    ("m1*sin(q1)^2", "sin(q1)**2*m1"),
    ("-m2*l1*lc2*s2*(2*q1'*q2' + q2'^2)", "-m2*l1*lc2*sin(q2)*(2*q1_dot*q2_dot + q2_dot**2)"),
    ("m2*(l1^2 + lc2^2 + 2 l1 lc2 cos(q2))", "m2*(l1**2 + lc2**2 + 2*l1*lc2*cos(q2))"),
    ("m1 lc1(q1' + q2')", "m1*lc1*(q1_dot + q2_dot)"),
    ("9.81*m1", "981*m1/100"),
    ("1e-3*m1", "m1/1000"),
    ("m1/2/l1*l1", "m1/2"),
    ("-(-m1)", "m1"),
    ("sin(90deg)*m1 + sin(90°)*m2", "m1 + m2"),
    ("sin(pi/2)*m1", "m1"),
    ("sin(q1)cos(q2)", "sin(q1)*cos(q2)"),
    ("m1*tan(q1)*cos(q1)", "m1*sin(q1)"),
    ("m1*cot(q1)*sin(q1)", "m1*cos(q1)"),
    ("Sin(q1) + COS(q2)", "sin(q1) + cos(q2)"),
    ("cq1*m1 + s(q1 + q2)", "cos(q1)*m1 + sin(q1 + q2)"),
    ("sinq1*m1 + cosθ2", "sin(q1)*m1 + cos(q2)"),
    ("cos(q(1) + q(2))*dq(1)^2", "cos(q1 + q2)*q1_dot**2"),
    ("I1*th1dot^2 + I2*theta_dot_2", "I1*q1_dot**2 + I2*q2_dot"),
    ("I1*dot(q1) + I2*ddot(q2)", "I1*q1_dot + I2*q2_ddot"),
    ("I1*dq1/dt + I2*d(q2)/dt", "I1*q1_dot + I2*q2_dot"),
    ("m1 * -g + 2(m1 + m2)", "-m1*g + 2*(m1 + m2)"),
    ("m1/2l1", "m1*l1/2"),
    ("m1*L1", "m1*l1"),
    # SymPy
    ("m1*q1.diff(t)**2 + m2*q2(t).diff(t, 2)", "m1*q1_dot**2 + m2*q2_ddot"),
    ("m1*Derivative(q1(t), t)**2", "m1*q1_dot**2"),
    ("m1*Derivative(q1(t), (t, 2))", "m1*q1_ddot"),
    ("m1*Derivative(q1, t, t)", "m1*q1_ddot"),
    ("m1*sin(q1(t))**2 + Rational(1, 2)", "m1*sin(q1)**2 + 1/2"),
    ("m1*sin(q1(t))*Derivative(q1(t), t)*Derivative(q2(t), t)", "m1*sin(q1)*q1_dot*q2_dot"),
    # MATLAB and Maxima
    ("m1*diff(q1(t), t)^2", "m1*q1_dot**2"),
    ("m1*diff(q1(t), t, t)", "m1*q1_ddot"),
    ("m1*diff(q1(t), t, 2)", "m1*q1_ddot"),
    ("(lc1^2*m1*diff(q1(t), t)^2)/2", "lc1**2*m1*q1_dot**2/2"),
    ("lc1.^2.*m1", "lc1**2*m1"),
    ("m1*'diff(q1,t,2)+m2*('diff(q2,t,1))^2", "m1*q1_ddot + m2*q2_dot**2"),
    ("2*m1*q2*'diff(q1,t,1)*'diff(q2,t,1)", "2*m1*q2*q1_dot*q2_dot"),
    ("m1 q2 'diff(q1,t)", "m1*q2*q1_dot"),
    ("%pi*m1*sin(q2)^2", "pi*m1*sin(q2)**2"),
    # LaTeX
    (r"\cos\theta_{12} + \dot\theta_{12}", "cos(q1 + q2) + q1_dot + q2_dot"),
    (r"m_1 l^2_{c1} \ddot{q_1}", "m1*lc1**2*q1_ddot"),
    (r"m_1\cos\left(\theta_1\right)^2", "m1*cos(q1)**2"),
    (
        r"\frac{m_2}{2}\left[l_1^2\dot{\theta_1}^2+2l_1l_{c2}\dot{\theta_1}cos\theta_2\right]",
        "m2*(l1**2*q1_dot**2 + 2*l1*lc2*q1_dot*cos(q2))/2",
    ),
    (r"m_1 g l_{c1} \cos(q_1)", "m1*g*lc1*cos(q1)"),
    (r"m_1gl_{c1}\cos q_1", "m1*g*lc1*cos(q1)"),
    (r"m_1gl_{c_1}c_1", "m1*g*lc1*cos(q1)"),
    (r"m_2gl_1c_1+m_2gl_{c2}c_{12}", "m2*g*l1*cos(q1) + m2*g*lc2*cos(q1 + q2)"),
    (r"\frac{1}{2}m_1l_{c1}^2\dot{q}_1^2", "m1*lc1**2*q1_dot**2/2"),
    (r"\frac12 m_1 l_{c1}^{2} \dot{q_1}^2", "m1*lc1**2*q1_dot**2/2"),
    (r"\dfrac{m_1 l_{c1}^2 \dot q_1^2}{2}", "m1*lc1**2*q1_dot**2/2"),
    (r"\tfrac{1}{2} m_1 {l_{c1}}^2 {\dot{q}_1}^2", "m1*lc1**2*q1_dot**2/2"),
    (r"\frac{1}{2} m_1 l_{c1}^2 \dot{q_1^2}", "m1*lc1**2*q1_dot**2/2"),
    (r"{1 \over 2} m_1", "m1/2"),
    (r"I_1 \ddot{\theta}_1 + I_2 \ddot\theta_2", "I1*q1_ddot + I2*q2_ddot"),
    (r"\left(I_1 + I_2\right)\left(\dot q_1 + \dot q_2\right)^2", "(I1 + I2)*(q1_dot + q2_dot)**2"),
    (r"\big[ I_1 + I_2 \big] \dot{q}_{1}", "(I1 + I2)*q1_dot"),
    (r"\left[m_1 + m_2\right] g \, l_1", "(m1 + m2)*g*l1"),
    (r"\sin^2\theta_1 + \cos^{2}(\theta_2)", "sin(q1)**2 + cos(q2)**2"),
    (r"\sin^{2}{\left(q_{1} \right)}", "sin(q1)**2"),
    (
        r"m_{1} \sin{\left(q_{1}{\left(t \right)} \right)} \frac{d}{d t} q_{1}{\left(t \right)}",
        "m1*sin(q1)*q1_dot",
    ),
    (r"m_{1} \left(\frac{d}{d t} q_{1}{\left(t \right)}\right)^{2}", "m1*q1_dot**2"),
    (r"m_{1} \frac{d^{2}}{d t^{2}} q_{1}{\left(t \right)}", "m1*q1_ddot"),
    (r"m_1 \frac{d^2 q_1}{dt^2} + m_2\frac{dq_1}{dt}", "m1*q1_ddot + m2*q1_dot"),
    (r"m_1 \frac{\mathrm{d} q_1}{\mathrm{d}t}", "m1*q1_dot"),
    (r"\sin 2\theta_1 l_2", "sin(2*q1)*l2"),
    (r"\sin\theta_1\cos\theta_2", "sin(q1)*cos(q2)"),
    (r"\sin(\theta_1)\theta_2", "sin(q1)*q2"),
    (r"\cos(q_1+q_2)l_2", "cos(q1 + q2)*l2"),
    (r"\sin\theta_1^2 m_1", "sin(q1)**2*m1"),
    (r"C_{\theta_1} + S_{\theta_1+\theta_2} + s_{q_2}", "cos(q1) + sin(q1 + q2) + sin(q2)"),
    (r"c_{1+2} + s_{2}^{2} + s_{1}c_{2}", "cos(q1 + q2) + sin(q2)**2 + sin(q1)*cos(q2)"),
    (r"c_1^2 s_{12} c_{12}", "cos(q1)**2*sin(q1 + q2)*cos(q1 + q2)"),
    (r"c\theta_1 s\theta_2", "cos(q1)*sin(q2)"),
    (r"sin(\theta_1) cos \theta_2", "sin(q1)*cos(q2)"),
    (r"\mathrm{sin}(\theta_1)\operatorname{cos}(q_2)", "sin(q1)*cos(q2)"),
    (r"m_1 \cdot g \times l_1 \ast 2 * l_2", "2*m1*g*l1*l2"),
    (r"m_2 g (l_1 + l_2 s_2)", "m2*g*(l1 + l2*sin(q2))"),
    (r"\sqrt{2} m_1 + \sqrt 2 m_2", "sqrt(2)*(m1 + m2)"),
    (r"\mathbf{m}_1 g + \boldsymbol{m_2} g", "m1*g + m2*g"),
    (r"\cos(\frac{\pi}{2} - q_1)", "sin(q1)"),
    (r"\cos(90^\circ - q_1) + \sin(90^{\circ})", "sin(q1) + 1"),
    (r"m_1\dot{q}_1\dot{q}_2 - 2\,m_2\;\dot{q}_1\!\dot{q}_2", "m1*q1_dot*q2_dot - 2*m2*q1_dot*q2_dot"),
    (r"\underbrace{m_1 g}_{\text{weight}} l_1", "m1*g*l1"),
    (r"\displaystyle\frac{m_1}{2} \text{ kg}", "m1/2"),
    (r"2 \sin\frac{q_1}{2}\cos\frac{q_1}{2}", "sin(q1)"),
    (r"-\frac{m_1}{2} -{-m_2}", "-m1/2 + m2"),
    (r"m_1 l_1^{2}\,\ddot{q}_{1}", "m1*l1**2*q1_ddot"),
    (r"m_1 (q_1)^2", "m1*q1**2"),
    (r"m_1 ^2", "m1**2"),
]


@pytest.mark.parametrize(("text", "expected"), ELBOW)
def test_a_planar_arm_in_every_dress(text: str, expected: str) -> None:
    found = answer("planar-2r", "tau1", text)
    assert not found.fault, found.fault
    assert same("planar-2r", found.node, expected), found.read_as


ARM = [
    (r"\frac{m_2 \dot{L}_2^{\star 2}}{2}", "m2*L2_dot**2/2"),
    (
        r"\frac{m_2(\cos(2\theta_1)L_2^{\star^2}\dot{\theta}_1^2 + \dot{L}_2^{\star^2})}{2}",
        "m2*(cos(2*theta1)*L2**2*theta1_dot**2 + L2_dot**2)/2",
    ),
    (r"m_2 L_2^{*2} \dot{\theta_1}^{2}", "m2*L2**2*theta1_dot**2"),
    (r"m_2 L_2^{*^2} \dot{\theta_1^2}", "m2*L2**2*theta1_dot**2"),
    (r"\dot{L_2^{*2}}", "L2_dot**2"),
    (r"\dot{L}_2^* \dot{\theta_1} + \ddot{L}_2^\star", "L2_dot*theta1_dot + L2_ddot"),
    (r"-s_1 * 0 + {L_2^*}^2", "L2**2"),
    ("m2*L2*^2 + L2*", "m2*L2**2 + L2"),
    ("m2*(L2*) + L2* - 1", "m2*L2 + L2 - 1"),
    ("L2*theta1_dot", "L2*theta1_dot"),
    ("m1*g*L1/2", "m1*g*L1/2"),
    (r"m_1 g \frac{L_1}{2}", "m1*g*L1/2"),
    (r"I_{1,zz} + I_{zz1} + I_{1zz} + I_{zz,1} + I1zz", "5*I1zz"),
    (r"\frac{I_1 \dot\theta_1^2}{2}", "I1zz*theta1_dot**2/2"),
    ("q1 + q2", "theta1 + L2"),
    ("q1' + q2''", "theta1_dot + L2_ddot"),
    (r"\dot{q}_1 \dot{q}_2", "theta1_dot*L2_dot"),
    (r"m_2 d_2 \dot d_2", "m2*L2*L2_dot"),
    (r"m_2 l_2 \dot{l}_2", "m2*L2*L2_dot"),
    (r"s_{1}^{2} + c_1^2", "1"),
    ("s1**2 + c1**2", "1"),
    ("theta1'^2*L2 + thetadot1*dL2 + dtheta1*L2dot", "theta1_dot**2*L2 + 2*theta1_dot*L2_dot"),
    ("thetaddot1 + ddtheta1 + theta1'' + d2theta1", "4*theta1_ddot"),
    ("theta1_ddot + L2_dot", "theta1_ddot + L2_dot"),
    ("θ̇1 + θ1' + θ̈₁ + ϑ1", "2*theta1_dot + theta1_ddot + theta1"),
    (r"\vartheta_1 + \dot\vartheta_1", "theta1 + theta1_dot"),
]


@pytest.mark.parametrize(("text", "expected"), ARM)
def test_the_arm_of_the_course_in_every_dress(text: str, expected: str) -> None:
    found = answer("in3140-rp", "tau1", text)
    assert not found.fault, found.fault
    assert same("in3140-rp", found.node, expected), found.read_as


MATRICES = [
    "[[m1, 0], [g, m2]]",
    "[m1, 0; g, m2]",
    "[m1 0; g m2]",
    "Matrix([[m1, 0], [g, m2]])",
    "matrix([m1,0],[g,m2])",
    "|\n    [ m1, 0]\n    [  g, m2]",
    "\n    - [m1, 0]\n    - [g, m2]",
    "[[m1, 0],\n      [g, m2]]",
    r"\begin{bmatrix} m_1 & 0 \\ g & m_2 \end{bmatrix}",
    r"\begin{pmatrix} m_1 & 0 \\[4pt] g & m_2 \\ \end{pmatrix}",
    r"\left[\begin{array}{cc} m_1 & 0 \\ g & m_2 \end{array}\right]",
    r"\left[\begin{matrix}m_{1} & 0\\g & m_{2}\end{matrix}\right]",
    r"\begin{bmatrix} m_1 & g \\ 0 & m_2 \end{bmatrix}^T",
    r"\begin{bmatrix} 1 & 0 \\ 0 & 1 \end{bmatrix} \begin{bmatrix} m_1 & 0 \\ g & m_2 \end{bmatrix}",
    r"\begin{bmatrix} m_1 & 0 \\ 0 & m_2 \end{bmatrix} + \begin{bmatrix} 0 & 0 \\ g & 0 \end{bmatrix}",
    r"\frac{1}{2}\begin{bmatrix} 2m_1 & 0 \\ 2g & 2m_2 \end{bmatrix}",
    r"\frac{\begin{bmatrix} 2m_1 & 0 \\ 2g & 2m_2 \end{bmatrix}}{2}",
    r"\begin{bmatrix} \frac{1}{m_1} & 0 \\ -\frac{g}{m_1 m_2} & \frac{1}{m_2} \end{bmatrix}^{-1}",
    "[[2, 1], [1, 1]]^(-1) * [[2*m1 + g, m2], [m1 + g, m2]]",
    "[[1,0,0],[0,0,1]] * [[m1,0,0],[0,0,1],[0,1,0]]^(-1) * [[m1^2,0],[g,m2],[0,0]]",
]


@pytest.mark.parametrize(
    ("text", "fault"),
    [
        ("[[m1, m1], [0, 0]]^(-1)", "a singular matrix has no inverse"),
        ("[[m1, m2]]^(-1)", "a 1×2 matrix has no inverse"),
        ("[[m1,0,0,0], [0,1,0,0], [0,0,1,0], [0,0,0,1]]^(-1)", "the inverse of a matrix of more than 3 rows"),
    ],
)
def test_what_has_no_inverse_is_said(text: str, fault: str) -> None:
    assert answer("planar-2r", "D", text).fault == fault


@pytest.mark.parametrize("text", MATRICES)
def test_a_matrix_in_every_dress(text: str) -> None:
    from dynsolve.notation.tree import Matrix

    found = answer("planar-2r", "D", text)
    assert isinstance(found.node, Matrix), found.fault
    wanted = [["m1", "0"], ["g", "m2"]]
    assert len(found.node.rows) == 2
    for row, texts in zip(found.node.rows, wanted, strict=True):
        for entry, expected in zip(row, texts, strict=True):
            assert same("planar-2r", entry, expected), found.read_as


@pytest.mark.parametrize(
    "text",
    [
        "[m1, m2]",
        "[[m1], [m2]]",
        "[m1; m2]",
        "Matrix([m1, m2])",
        "Matrix([[m1], [m2]])",
        "[m1, m2]'",
        "[m1 m2].'",
        r"\begin{bmatrix} m_1 \\ m_2 \end{bmatrix}",
        r"\begin{bmatrix} m_1 & m_2 \end{bmatrix}^\top",
        "(m1, m2)",
        "\n    - m1\n    - m2",
        "[m1\n     m2]",
    ],
)
def test_a_column_in_every_dress(text: str) -> None:
    from dynsolve.notation.tree import Matrix, Symbol

    found = answer("planar-2r", "g", text)
    assert isinstance(found.node, Matrix), found.fault
    assert found.node.rows == ((Symbol("m1"),), (Symbol("m2"),))
