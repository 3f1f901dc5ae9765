r"""Answers in the notations that students and programs write, right and wrong, each with its verdict.

One case is a report or an answer file; every right one stands beside one with a slip in the same
notation, which must stay wrong.
"""

from __future__ import annotations

from functools import lru_cache

import pytest

from dynsolve.answers.judge import Checker
from dynsolve.answers.reading.files import FileReader
from dynsolve.answers.verdict import Report
from dynsolve.derivation.rules import derive
from dynsolve.problem import read_problem
from dynsolve.solution.solution import load
from tests.unit.answers.finder import lost

R, RP = "planar-2r", "in3140-rp"
PENDULUM = """
dh: [{theta: theta1*, d: 0, a: l, alpha: 0}]
gravity: [0, -g, 0]
masses: [{link: 1, mass: m, center: {near: [lc, 0, 0]}, inertia: {zz: I}}]
"""
P2 = r"m_1 g l_{c1} \sin q_1 + m_2 g(l_1 \sin q_1 + l_{c2}\sin(q_1+q_2))"
D22 = "m_2 l_{c2}^2 + I_2"
G1 = "g((m_1 l_{c1} + m_2 l_1)c_1 + m_2 l_{c2} c_{12})"
G2 = "m_2 g l_{c2} c_{12}"
G = rf"\begin{{bmatrix}} {G1} \\ {G2} \end{{bmatrix}}"
C = (
    r"\begin{bmatrix} -m_2 l_1 l_{c2} s_2 \dot q_2 & -m_2 l_1 l_{c2} s_2 (\dot q_1 + \dot q_2) \\"
    r" m_2 l_1 l_{c2} s_2 \dot q_1 & 0\end{bmatrix}"
)
CQD = (
    r"\begin{bmatrix} -m_2 l_1 l_{c2} s_2 (2\dot q_1\dot q_2 + \dot q_2^2) \\"
    r" m_2 l_1 l_{c2} s_2 \dot q_1^2 \end{bmatrix}"
)
CH = r"\begin{bmatrix} h\dot q_2 & h(\dot q_1+\dot q_2)\\ -h\dot q_1 & 0\end{bmatrix}"
H = "h = -m_2 l_1 l_{c2} s_2"
T01 = r"\begin{bmatrix} c_1 & -s_1 & 0 & l_1 c_1 \\ s_1 & c_1 & 0 & l_1 s_1 \\ 0&0&1&0\\0&0&0&1 \end{bmatrix}"
K1 = r"\frac12(m_1 l_{c1}^2 + I_1)\dot q_1^2"

D = (
    r"\begin{bmatrix} m_1 l_{c1}^2 + m_2(l_1^2+l_{c2}^2+2l_1 l_{c2} c_2)+I_1+I_2 &"
    r" m_2(l_{c2}^2+l_1l_{c2}c_2)+I_2 \\ m_2(l_{c2}^2+l_1l_{c2}c_2)+I_2 & m_2 l_{c2}^2+I_2\end{bmatrix}"
)
V1 = r"-m_2 l_1 l_{c2} s_2 (2\dot q_1\dot q_2 + \dot q_2^2)"
V2 = r"m_2 l_1 l_{c2} s_2 \dot q_1^2"

BELOW = D[D.index(r" \\ m_2(") : D.rindex("&") + 1].lstrip()
"""What stands below the diagonal of D, with the signs around it."""

RIGHT: list[tuple[str, str, str, str]] = [
    # problem, form, text, the answers that are right
    (R, "md", r"$$d_{22} = m_2l_{c2}^2+I_2$$", "d22"),
    (R, "md", r"$$K_1 = \frac12(m_1L_{c1}^2 + I_1)\dot q_1^2$$", "K1"),
    (R, "md", r"$$P_1 = m_1gl_{c1}sin q_1$$", "P1"),
    (R, "yaml", "answers: {P1: m_1 g l_{c1}sin q_1, d22: 'm_2l_{c2}^2 + I_2'}", "P1 d22"),
    (R, "md", r"$$d_{22} = m_2l^2_{c2} + I_2$$", "d22"),
    (R, "md", r"$$K_1 = \frac12(m_1 l^2_{c_1} + I_1)\dot{q}^2_1$$", "K1"),
    (R, "md", r"$$K_1 = \frac12(m_1 l_{c1}^2 + I_1){\dot{q}}_1^2$$", "K1"),
    (R, "md", r"$$K_1 = \frac12(m_1 {l_{c1}}^2 + I_1)({\dot{q}_1})^2$$", "K1"),
    *[(R, "yaml", f"answers: {{K1: (m1*lc1^2 + I1)*{rate}^2/2}}", "K1")
      for rate in ("q1p", "q1prime", "q1Dot", "q1_t", "qp1", "q1dot", "dq1")],
    *[(R, "yaml", f"answers: {{ddt2: (m2*(lc2^2+l1*lc2*cos(q2))+I2)*{a}1{b} + (m2*lc2^2+I2)*{a}2{b}"
       " - m2*l1*lc2*sin(q2)*q1p*q2p}", "ddt2") for a, b in (("q", "pp"), ("q", "_tt"), ("qddot", ""))],
    (R, "tex", r"\[ \text{g}_2 = m_2 \text{g} \text{lc2} \cos(q_1+q_2) \]", "g2"),
    (R, "tex", r"\[ d_{22} = \text{m2}\,\text{lc2}^2 + \text{I2} \]", "d22"),
    (R, "tex", rf"\[ \textbf{{g}} = {G} \]", "g"),
    (R, "tex", rf"\[ \mathbf{{d_{{22}} = {D22}}} \]", "d22"),
    (R, "tex", rf"\[ \underline{{\underline{{d_{{22}} = {D22}}}}} \]", "d22"),
    (R, "tex", rf"\[ {{\color{{red}} d_{{22}} = {D22}}} \]", "d22"),
    (R, "tex", rf"\[ \textcolor[rgb]{{1,0,0}}{{d_{{22}} = {D22}}} \]", "d22"),
    (R, "tex", rf"\[ \boxed{{d_{{22}} = {D22}}} \]", "d22"),
    (R, "tex", r"\[ d_{22} = m_2 l_{c2}^2 {\color{red} + I_2} \]", "d22"),
    (R, "tex", r"\[ d_{22} = m_2 l_{c2}^2 \boxed{+ I_2} \]", "d22"),
    (R, "tex", r"\begin{align*} P &= m_1 g l_{c1} \sin q_1 \\ &\phantom{=}+ "
     r"m_2 g(l_1 \sin q_1 + l_{c2}\sin(q_1+q_2)) \end{align*}", "P"),
    (R, "tex", r"\begin{align*} P &= m_1 g l_{c1} \sin q_1 \\* &\hphantom{P = }{} + "
     r"m_2 g(l_1 \sin q_1 + l_{c2}\sin(q_1+q_2)) \end{align*}", "P"),
    (R, "tex", r"\[ P = m_1 g l_{c1} \sin q_1 \] \[ + m_2 g(l_1 \sin q_1 + l_{c2}\sin(q_1+q_2)) \]", "P"),
    (R, "md", "$$P = m_1 g l_{c1} \\sin q_1 +$$\n\n$$m_2 g(l_1 \\sin q_1 + l_{c2}\\sin(q_1+q_2))$$", "P"),
    (R, "md", f"$$C =$$ $${C}$$", "C"),
    *[(R, "tex", rf"{a} g_1 &{e} {G1} \\ g_2 &{e} {G2} {b}", "g1 g2") for a, e, b in (
        (r"\begin{align}", "=", r"\end{align}"),
        (r"\[ \left\{\begin{aligned}", "=", r"\end{aligned}\right. \]"),
        (r"\[ \left.\begin{aligned}", "=", r"\end{aligned}\right\} \]"),
        (r"\[ \begin{aligned}[t]", "=", r"\end{aligned} \]"),
        (r"\begin{empheq}[left=\empheqlbrace]{align}", "=", r"\end{empheq}"),
        (r"\begin{IEEEeqnarray}{rCl}", "=&", r"\end{IEEEeqnarray}"),
        (r"\begin{alignat}{2}", "=", r"\end{alignat}"),
    )],
    (R, "md", f"$$C = {CH}$$ where ${H}$.", "C"),
    (R, "md", f"$$C = {CH}, \\quad \\text{{where }} {H}$$", "C"),
    (R, "md", f"With ${H}$ we get $$C = {CH}$$", "C"),
    (R, "md", f"$$C = {CH}$$ with $h = -m_2 a s_2$ and $a = l_1 l_{{c2}}$.", "C"),
    (R, "md", rf"\begin{{eqnarray}} c_{{121}} & = & {H[4:]} & = & h \end{{eqnarray}} $$C = {CH}$$", "c121 C"),
    (R, "md", rf"$$d_{{22}} = {D22} \hspace{{5mm}} d_{{22}} \in \mathbb{{R}}$$", "d22"),
    (R, "md", rf"$$d_{{22}} = {D22}, \quad d_{{22}} > 0$$", "d22"),
    (R, "md", f"$$\\vec g = [0, -g, 0]^T$$ $$g(q) = {G}$$", "g"),
    (R, "md", f"$$g(q) = {G}$$ with $$\\vec g = [0, -g]^T$$", "g"),
    (R, "md", f"$$S(q,\\dot q) = {C}$$", "C"),
    (R, "md", f"$$n(q,\\dot q) = {CQD}$$", "Cqd"),
    (R, "md", f"$$N(\\theta,\\dot\\theta) = {CQD}$$", "Cqd"),
    (R, "md", f"$$c(q,\\dot q) = {CQD}$$", "Cqd"),
    (R, "md", f"$$V(\\Theta,\\dot\\Theta) = {CQD}$$", "Cqd"),
    (R, "md", f"$$C(\\Theta,\\dot\\Theta) = {C}$$ $$G(\\Theta) = {G}$$", "C g"),
    *[(R, "md", f"$${name} = {T01}$$", "H1") for name in (
        "T_1^0", "T^0_1", "{}^0T_1", "{}^{0}_{1}T", "{}_1^0 T", "^0_1T", "H_1^0")],
    (R, "md", r"$$P = m_1 g \ell_{c1} \sin q_1 + m_2 g(\ell_1 \sin q_1 + \ell_{c2}\sin(q_1+q_2))$$", "P"),
    (R, "md", r"$$P = m_1 g l_{c1} \sin q_1 + m_2 g(l_1 \sin q_1 + l_{c2}\sin q_{12})$$", "P"),
    (R, "md", "Let $\\theta_1 = q_1$ and $\\theta_2 = q_1 + q_2$. "
     r"$$P = m_1 g l_{c1} \sin \theta_1 + m_2 g(l_1 \sin \theta_1 + l_{c2}\sin \theta_2)$$", "P"),
    (RP, "md", r"$$K_{1} = \frac12 I_{1,zz}\dot\theta^2$$", "K1"),
    (RP, "md", r"$$P = 0{,}5\, m_1 g L_1 + m_2 g L_1$$", "P"),
    (PENDULUM, "md", r"$$K_v = \frac12 m l_c^2 \dot\theta^2$$", "Kv1"),
    (R, "md", r"$$K_1^{t} = \frac12 m_1 l_{c1}^2 \dot q_1^2$$"
     r"$$K_1^{rot} = \frac12 I_1 \dot q_1^2$$", "Kv1 Kw1"),
    (R, "md", rf"$$K_1 = \nicefrac{{1}}{{2}}{K1[7:]}$$", "K1"),
    (R, "md", r"$$\dv{t}\pdv{L}{\dot q_2} = (m_2(l_{c2}^2 + l_1 l_{c2}c_2)+I_2)\ddot q_1 "
     r"+ (m_2l_{c2}^2+I_2)\ddot q_2 - m_2 l_1 l_{c2}s_2\dot q_1\dot q_2$$", "ddt2"),
    (R, "md", r"$$K_1 = \frac12 (m_1 l_{c1}^2+I_1) \left(\frac{d}{dt}q_1(t)\right)^2$$", "K1"),
    (R, "md", r"$$K_1 = \frac12 (m_1 l_{c1}^2+I_1) \left(\dv{q_1}{t}\right)^2$$", "K1"),
    (R, "md", r"$$K_1 = \frac12 (m_1 l_{c1}^2+I_1) \overset{.}{q}_1^2$$", "K1"),
    (R, "md", r"$$K_1 = {{(m_1 l_{c1}^2+I_1)\,\left({{d}\over{d\,t}}\,q_1\right)^2}\over{2}}$$", "K1"),
    (R, "md", rf"$$g = \pmatrix{{{G1}\cr {G2}\cr}}$$", "g"),
    (R, "md", rf"$$g = \bmqty{{{G1}\\ {G2}}}$$", "g"),
    (RP, "md", "$$f_2 = m_2 \\ddot L_2 - m_2 L_2 θ̇₁²$$", "f2"),
    # words, units and remarks beside a formula
    (R, "md", rf"$$\text{{Body 1}}: K_1 = {K1}\ [\mathrm{{J}}]$$", "K1"),
    (R, "md", rf"$$K_1 = {K1} \quad \text{{(kinetic energy of body 1)}}$$", "K1"),
    (R, "md", rf"$$d_{{22}} = {D22} \neq 0, \quad m_2 \in \mathbb{{R}}^+$$", "d22"),
    (R, "tex", rf"\begin{{IEEEeqnarray}}{{rCl}} \IEEEeqnarraymulticol{{3}}{{l}}{{d_{{22}} = {D22}}}"
     rf"\\ g_2 &=& {G2} " r"\IEEEyesnumber\label{a} \end{IEEEeqnarray}", "d22 g2"),
    (R, "md", rf"$$d_{{22}} \overset{{!}}{{=}} {D22}$$", "d22"),
    (R, "md", r"$$K_{\text{1}} = \frac12 (m_{\text{1}}l_{c\text{1}}^2 + I_1)\dot q_{\text{1}}^2$$", "K1"),
    # what else stands in the report decides
    (R, "md", f"$$M(\\theta)={D}$$ $$V_1 = {V1}$$ $$V_2 = {V2}$$ $$G_2={G2}$$", "D Cqd g2"),
    (R, "md", f"$$M={D}$$ $$N_1 = {V1}, N_2 = {V2}$$", "D Cqd"),
    (R, "md", f"$$c_1(q,\\dot q) = {V1}$$ $$c_2(q,\\dot q) = {V2}$$", "Cqd"),
    (R, "md", f"$$V_1 = m_1 g l_{{c1}} \\sin q_1$$ $$T_1 = {K1}$$", "P1 K1"),
    (R, "md", r"$$M(\theta)\ddot\theta + V(\theta,\dot\theta) + G(\theta) = \tau$$" f"$$M={D}$$", "D"),
    (R, "md", f"$$M(q) = {D}$$" r"$$B = \begin{bmatrix} 1 \\ 0 \end{bmatrix}$$ $$M\ddot q + g = B u$$", "D"),
    (R, "md", f"$$M(q) = {D}$$" r"$$B = \begin{bmatrix} 1 & 0 \\ 0 & 1 \end{bmatrix}$$", "D"),
    (R, "md", f"$$B(q) = {D}$$", "D"),
    (R, "md", r"$$M = M_0 + m_2 M_p$$"
     r"$$M_0 = \begin{bmatrix} m_1 l_{c1}^2 + I_1+I_2 & I_2\\ I_2 & I_2\end{bmatrix}$$"
     r"$$M_p = \begin{bmatrix} l_1^2+l_{c2}^2+2l_1 l_{c2} c_2 & l_{c2}^2+l_1l_{c2}c_2 \\"
     r" l_{c2}^2+l_1l_{c2}c_2 & l_{c2}^2 \end{bmatrix}$$", "D"),
    (R, "txt", "C = [h*q2_dot, h*(q1_dot+q2_dot); -h*q1_dot, 0]\nwhere h = -m2*l1*lc2*sin(q2)\n", "C"),
    (RP, "md", r"$$K_2 = \frac12 m_2(\dot L^{*2} + L^{*2} \dot\theta^2)$$", "K2"),
    # what programs print, and Word's linear format
    (RP, "yaml", "answers: {P: '0,5*m1*g*L1 + m2*g*L1'}", "P"),
    (RP, "yaml", "answers: {K1: 'I1zz*(0,5*theta1_dot^2)'}", "K1"),
    (RP, "md", r"$$g = \begin{bmatrix} 0,0\cdot L_1 \\ 0 \end{bmatrix}, \quad d_{22} = 1,0 m_2$$", "g d22"),
    (R, "yaml", "answers: {g: '{g*((m1*lc1+m2*l1)*Cos[q1]+m2*lc2*Cos[q1+q2]), m2*g*lc2*Cos[q1+q2]}'}", "g"),
    (R, "yaml", "answers: {K1: '(m1*lc1^2+I1)*Derivative[1][q1][t]^2/2'}", "K1"),
    (R, "yaml", r"answers: {K1: '(m1*lc1^2+I1)*\[Theta]1''[t]^2/2'}", "K1"),
    (R, "yaml", "answers: {g2: 'm[2]*g*lc[2]*cos(q[1]+q[2])'}", "g2"),
    (R, "yaml", "answers: {g2: 'm2*g*lc2*sp.cos(q1+q2)'}", "g2"),
    (R, "yaml", "answers: {K1: 'sp.Rational(1,2)*(m1*lc1**2+I1)*q1p**2'}", "K1"),
    (R, "txt", "D(1,2) = m2*(lc2^2 + l1*lc2*cos(q2)) + I2\n", "d12"),
    (R, "txt", "g(2) = m2*g*lc2*cos(q1+q2)\n", "g2"),
    (R, "md", "$$K_1 = 1/2 (m_1 l_c1^2+I_1) (θ_1 ) ̇^2$$", "K1"),
    (R, "md", "$$K_1 = 1/2 〖(m_1 l_c1^2+I_1)〗 q ̇_1^2$$", "K1"),
    (R, "md", "$$g = [■(g((m_1 l_c1+m_2 l_1) cos⁡(q_1)+m_2 l_c2 cos⁡(q_1+q_2))"
     "@m_2 g l_c2 cos⁡(q_1+q_2))]$$", "g"),
    (R, "md", rf"$$g = \binom{{{G1}}}{{{G2}}}$$", "g"),
    # symmetric matrices, columns, rows, units, tables
    *[(R, "md", "$$D = " + D.replace(BELOW, rf"\\ {mark} &") + "$$", "D")
      for mark in ("*", r"\ast", r"\star", r"\bullet", "sym.", r"\text{sym}", r"\text{symm.}", "d_{12}")],
    (R, "yaml", "answers: {D: '[[m1*lc1^2 + m2*(l1^2+lc2^2+2*l1*lc2*cos(q2))+I1+I2, "
     "m2*(lc2^2+l1*lc2*cos(q2))+I2], [*, m2*lc2^2+I2]]'}", "D"),
    (R, "md", rf"$$g = \begin{{cases}} {G1} \\ {G2} \end{{cases}}$$", "g"),
    (R, "md", rf"$$g = \left\{{\begin{{matrix}} {G1} \\ {G2} \end{{matrix}}\right.$$", "g"),
    *[(R, "md", rf"$${row} = \begin{{bmatrix}} {D[16:D.index(BELOW)]} \end{{bmatrix}}$$", "d11 d12")
      for row in ("D(1,:)", "D_{1,:}", "M_{1,*}")],
    (R, "txt", "C(:,2) = [-m2*l1*lc2*sin(q2)*(q1_dot+q2_dot); 0]\n", "C12 C22"),
    (R, "txt", "g2 = m2*g*lc2*cos(q1+q2) Nm\n", "g2"),
    (R, "txt", "P1 = m1*g*lc1*sin(q1) [J]\n", "P1"),
    (R, "txt", "K1\n  = 1/2*(m1*lc1^2+I1)*q1_dot^2\n", "K1"),
    (R, "md", f"| | is |\n|---|---|\n| $P_1$ | $m_1 g l_{{c1}} \\sin q_1$ |\n| $g_2$ | ${G2}$ |\n", "P1 g2"),
    (R, "md", "|a|b|\n|---|---|\n| **P1** | m1*g*lc1*sin(q1) |\n| g2 | m2*g*lc2*cos(q1+q2) |\n", "P1 g2"),
    (R, "md", "| no | equation |\n|---|---|\n| 1 | $P_1 = m_1 g l_{c1} \\sin q_1$ |\n", "P1"),
    (R, "md", f"$$C = {CH}$$ with $${H[4:]} =: h$$", "C"),
    (R, "md", f"$$C = {CH}$$ where $h$ is ${H[4:]}$.", "C"),
    (R, "md", f"$$C = {CH}$$\n\nHere h denotes ${H[4:]}$.", "C"),
    (RP, "md", r"$$d_{11} = I_{1,zz} + m_2 L_2^2(t)$$", "d11"),
    # a model with vectors
    (R, "md", rf"$${D} \begin{{bmatrix}}\ddot q_1\\ \ddot q_2\end{{bmatrix}} + {CQD} + {G} = \tau$$",
     "D Cqd g tau"),
    (R, "md", rf"$$\tau = {D} \ddot q + {G} + {CQD}$$", "D Cqd g tau"),
    # Maple and MATLAB
    (R, "txt", "ddt2 := (m2*(lc2^2+l1*lc2*cos(q2(t)))+I2)*diff(q1(t), t$2) + (m2*lc2^2+I2)*diff(q2(t),t$2)"
     " - m2*l1*lc2*sin(q2(t))*diff(q1(t),t)*diff(q2(t),t);\n", "ddt2"),
    (R, "txt", "g := Vector([g*((m1*lc1+m2*l1)*cos(q1)+m2*lc2*cos(q1+q2)), m2*g*lc2*cos(q1+q2)]);\n", "g"),
    (R, "txt", "g := Vector(2, [g*((m1*lc1+m2*l1)*cos(q1)+m2*lc2*cos(q1+q2)), m2*g*lc2*cos(q1+q2)]);\n", "g"),
    (R, "txt", "g := <g*((m1*lc1+m2*l1)*cos(q1)+m2*lc2*cos(q1+q2)), m2*g*lc2*cos(q1+q2)>;\n", "g"),
    (R, "txt", "C := <<h*q2d | h*(q1d+q2d)>, <-h*q1d | 0>>;\nh := -m2*l1*lc2*sin(q2);\n", "C"),
    (R, "txt", "g =\n\n g*((m1*lc1+m2*l1)*cos(q1)+m2*lc2*cos(q1+q2))\n       m2*g*lc2*cos(q1+q2)\n \n", "g"),
    # the letters and indices of other books
    (R, "md", r"$$\Gamma_{112} = -m_2 l_1 l_{c2} s_2$$ $$\Gamma_{211} = m_2 l_1 l_{c2} s_2$$", "c121 c112"),
    (R, "md", r"$$c_{112} = -m_2 l_1 l_{c2} s_2$$ with $$c_{kij} = \frac12\left(\frac{\partial d_{kj}}"
     r"{\partial q_i} + \frac{\partial d_{ki}}{\partial q_j} - \frac{\partial d_{ij}}{\partial q_k}\right)$$",
     "c121"),
    # of a planar robot the angular velocity is one number
    (R, "yaml", "answers: {w1: q1_dot, w2: q1_dot + q2_dot}", "w1 w2"),
]  # fmt: skip

SLIPS = (
    ("I_2", "I_1"), ("c_1 ", "s_1 "), ("c_{12}", "c_2"), ("l_1 l_{c2}", "l_2 l_{c2}"),
    (r"\sin q_1", r"\cos q_1"), ("+ I_1", "- I_1"), ("I2", "2*I2"), ("I1", "I2"), ("m_2", "m_1"),
    ("0{,}5", "0{,}6"), (r"\frac12", r"\frac13"), ("l_{c1}", "l_1"), ("L_{c1}", "L_1"),
    ("I_{1,zz}", "2 I_{1,zz}"), ("0,5", "0,6"), ("1,0", "1,1"), ("m2", "m1"),
    ("m_1 l_c1", "m_1 l_1"), ("m[2]", "m[1]"), ("lc2", "l2"),
    ("lc1", "l1"), (r"\sin q", r"\cos q"), ("q1_dot", "q2_dot"),
)  # fmt: skip
"""What a slip puts in the place of what: the first that a text holds behind its first `=` or `:`."""


@lru_cache(maxsize=8)
def _tools(stem: str) -> tuple[FileReader, Checker]:
    problem = read_problem(stem, "own.yaml") if "\n" in stem else load(stem)
    return FileReader(problem), Checker(problem, derive(problem.robot))


def judged(stem: str, ending: str, text: str) -> Report:
    reader, check = _tools(stem)
    read = reader(text, f"a.{ending}")
    report = check(read)
    assert not lost(check, text, ending, read, report), text
    return report


def verdicts(report: Report) -> dict[str, str]:
    return {answer.name: str(answer.verdict.value) for answer in report.answers}


def with_slip(text: str) -> str:
    head, sign, rest = text.partition("=" if "=" in text else ":")
    for old, new in SLIPS:
        if old in rest:
            return head + sign + rest.replace(old, new)
    for old, new in SLIPS:
        if old in head:
            return head.replace(old, new) + sign + rest
    raise AssertionError(f"no slip for {text}")


@pytest.mark.parametrize(("stem", "ending", "text", "names"), RIGHT)
def test_a_right_answer_is_right(stem: str, ending: str, text: str, names: str) -> None:
    found = verdicts(judged(stem, ending, text))
    assert {name: found.get(name) for name in names.split()} == dict.fromkeys(names.split(), "correct")


@pytest.mark.parametrize(("stem", "ending", "text", "names"), RIGHT)
def test_the_same_with_a_slip_is_not_right(stem: str, ending: str, text: str, names: str) -> None:
    found = verdicts(judged(stem, ending, with_slip(text)))
    assert any(found.get(name) in ("wrong", "unreadable") for name in names.split())


def test_a_model_does_not_explain_its_own_parts() -> None:
    model = rf"$$\tau = {D.replace('I_2', 'I_1')} \ddot q + {C} \dot q + {G}$$"
    found = verdicts(judged(R, "md", model))
    assert (found["D"], found["C"], found["g"]) == ("wrong", "correct", "correct")


def test_degrees_without_their_sign_are_pointed_out() -> None:
    report = judged(R, "md", r"$$P_1 = m_1 g l_{c1} \sin(q_1 + 90)$$")
    answer = next(found for found in report.answers if found.name == "P1")
    assert answer.verdict.value == "wrong" and "90°" in " ".join(answer.notes)


@pytest.mark.parametrize("first", [0, 1])
def test_programs_may_count_from_zero(first: int) -> None:
    i, j = first, first + 1
    P = f"m[{i}]*g*lc[{i}]*sin(q[{i}]) + m[{j}]*g*(l[{i}]*sin(q[{i}]) + lc[{j}]*sin(q[{i}] + q[{j}]))"
    assert verdicts(judged(R, "yaml", f"answers: {{P: '{P}'}}"))["P"] == "correct"
    slip = P.replace(f"l[{i}]*", f"l[{j}]*", 1)
    assert verdicts(judged(R, "yaml", f"answers: {{P: '{slip}'}}"))["P"] == "wrong"


def test_an_unknown_letter_is_named() -> None:
    report = judged(R, "md", r"$$P_1 = m_1 g a_1 \sin(q_1)$$")
    answer = next(found for found in report.answers if found.name == "P1")
    assert answer.verdict.value == "unreadable" and "a_1" in str(answer)


def test_a_controller_is_none_of_the_answers() -> None:
    report = judged(R, "md", r"$$\tau_2 = -K_p(q_2 - q_d)$$ $$u = K_p \tilde{q}$$")
    assert not [answer for answer in report.answers if answer.given]
    assert len(report.not_recognized) == 2


def test_an_answer_in_a_sentence_alone_is_judged() -> None:
    report = judged(
        R, "md", f"The entry $d_{{22}} = {D22}$ is clear. $$g_2 = {G2}$$ since $g_2 = {G2}$ again."
    )
    assert verdicts(report)["d22"] == verdicts(report)["g2"] == "correct"
    assert not report.not_recognized


TAU = (
    r"$$\tau_1 = (m_2 L_2^2 + I_{1,zz})\ddot\theta_1 + 2 m_2 L_2\dot\theta_1\dot L_2$$"
    "\n"
    r"$$f_2 = m_2\ddot L_2 - m_2 L_2\dot\theta_1^2$$"
    "\n"
)


@pytest.mark.parametrize(
    "restated",
    [
        r"\tau = D\ddot q + C\dot q + g",
        r"D\ddot{q} + C\dot{q} + g = \tau",
        r"\tau = M\ddot q + C\dot q + G",
        r"\boldsymbol\tau = \mathbf{D}\ddot{\mathbf q} + \mathbf{C}\dot{\mathbf q} + \mathbf{g}",
        r"\tau = D(q)\ddot q + C(q,\dot q)\dot q + g",
    ],
)
def test_a_general_equation_takes_no_answer_away(restated: str) -> None:
    """Beside matrices g is the vector of gravity, so that the equation only says what the letters are."""
    found = verdicts(judged("in3140-rp", "md", f"{TAU}$${restated}$$\n"))
    assert (found["tau1"], found["f2"], found["tau"]) == ("correct", "correct", "correct")
    assert verdicts(judged("in3140-rp", "md", f"$${restated}$$\n"))["tau"] == "missing"


def test_the_acceleration_of_gravity_stays_a_number_beside_numbers() -> None:
    report = r"$$P = \tfrac12 m_1 g L_1 + m_2 g L_1$$" + "\n" + r"$$g = \begin{bmatrix}0\\0\end{bmatrix}$$"
    found = verdicts(judged("in3140-rp", "md", report))
    assert (found["P"], found["g"]) == ("correct", "correct")
