"""The names of answers as people write them, on the left, on the right and in a chain."""

from __future__ import annotations

import pytest

from tests.unit.answers.reading.submissions import report

FRAME = r"\begin{bmatrix} 1&0&0&0\\0&1&0&0\\0&0&1&0\\0&0&0&1 \end{bmatrix}"
TENSOR = r"\begin{bmatrix} 0&0&0\\0&0&0\\0&0&I_1 \end{bmatrix}"
VECTOR = r"\begin{bmatrix} 0\\0\\1 \end{bmatrix}"
PAIR = r"\begin{bmatrix} m_1 \\ m_2 \end{bmatrix}"
SQUARE = r"\begin{bmatrix} m_1 & 0 \\ 0 & m_2 \end{bmatrix}"
TALL = r"\begin{bmatrix} 0 & 0 \\ 0 & 0 \\ 1 & 1 \end{bmatrix}"
WHOLE = r"\begin{bmatrix} 0&0\\0&0\\0&0\\0&0\\0&0\\1&1 \end{bmatrix}"

NAMES = [
    (r"A_1", FRAME, "A1"),
    (r"\mathbf{A_2}", FRAME, "A2"),
    (r"A_2^1", FRAME, "A2"),
    (r"H_2^0", FRAME, "H2"),
    (r"\mathbf{H}_{2}^{0}", FRAME, "H2"),
    (r"H_2", FRAME, "H2"),
    (r"T_2^0", FRAME, "H2"),
    (r"{}^0T_2", FRAME, "H2"),
    (r"T_1", FRAME, "H1"),
    (r"H_2^1", FRAME, "A2"),
    (r"J_v", TALL, "Jv"),
    (r"\mathbf{J_v}", TALL, "Jv"),
    (r"\mathbf{J}_{\mathbf{v}}", TALL, "Jv"),
    (r"\mathbf{J}_{\omega}", TALL, "Jw"),
    (r"J_\omega", TALL, "Jw"),
    (r"J", WHOLE, "J"),
    (r"\mathbf{J}(\mathbf{q})", WHOLE, "J"),
    (r"J_{v_1}", TALL, "Jv1"),
    (r"J_{v1}", TALL, "Jv1"),
    (r"J_{v_{c1}}", TALL, "Jv1"),
    (r"\mathbf{J}_{\mathbf{v}_2}", TALL, "Jv2"),
    (r"J_{\omega_2}", TALL, "Jw2"),
    (r"J_{\omega2}", TALL, "Jw2"),
    (r"J_{\omega,2}", TALL, "Jw2"),
    (r"r_{c1}", VECTOR, "rc1"),
    (r"\vec{r}_{c_1}", VECTOR, "rc1"),
    (r"r_{c,2}", VECTOR, "rc2"),
    (r"v_1", VECTOR, "v1"),
    (r"\mathbf{v_{c1}}", VECTOR, "v1"),
    (r"\dot{r}_{c1}", VECTOR, "v1"),
    (r"\omega_2", VECTOR, "w2"),
    (r"\boldsymbol{\omega}_2", VECTOR, "w2"),
    (r"w_1", VECTOR, "w1"),
    (r"I_1", TENSOR, "I_body1"),
    (r"\mathcal{I}_1", TENSOR, "I1"),
    (r"\mathcal I_1", TENSOR, "I1"),
    (r"\boldsymbol{\mathcal{I}}_{1}", TENSOR, "I1"),
    ("𝓘_1", TENSOR, "I1"),
    ("ℐ₁", TENSOR, "I1"),
    (r"I_1^0", TENSOR, "I1"),
    (r"I_{body,1}", TENSOR, "I_body1"),
    (r"P_1", "m_1 g", "P1"),
    (r"\mathcal{P}_1", "m_1 g", "P1"),
    (r"P", "m_1 g", "P"),
    (r"\mathcal{P}", "m_1 g", "P"),
    (r"P_{tot}", "m_1 g", "P"),
    (r"P_{\text{tot}}", "m_1 g", "P"),
    (r"E_p", "m_1 g", "P"),
    (r"U", "m_1 g", "P"),
    (r"K_{v_1}", "m_1", "Kv1"),
    (r"K_{v1}", "m_1", "Kv1"),
    (r"K_{v,1}", "m_1", "Kv1"),
    (r"K_{\omega_1}", "m_1", "Kw1"),
    (r"K_{\omega 2}", "m_1", "Kw2"),
    (r"K_{1}", "m_1", "K1"),
    (r"K", "m_1", "K"),
    (r"\mathcal{K}", "m_1", "K"),
    (r"T", "m_1", "K"),
    (r"\mathcal{L}", "m_1", "L"),
    ("ℒ", "m_1", "L"),
    ("\U0001d4db", "m_1", "L"),
    (r"L(q, \dot q)", "m_1", "L"),
    (r"\frac{\partial \mathcal{L}}{\partial \dot{q}_1}", "m_1", "dLdqd1"),
    (r"\frac{\partial L}{\partial \dot{\theta}_2}", "m_1", "dLdqd2"),
    (r"\dfrac{\partial L}{\partial \dot{q_1}}", "m_1", "dLdqd1"),
    (r"\frac{\delta L}{\delta q_2}", "m_1", "dLdq2"),
    (r"\frac{dL}{dq_2}", "m_1", "dLdq2"),
    (r"\frac{\partial}{\partial q_2} L", "m_1", "dLdq2"),
    (r"\frac{\partial}{\partial q_2} (\mathcal L)", "m_1", "dLdq2"),
    (r"\partial L / \partial q_1", "m_1", "dLdq1"),
    (r"\partial L / \partial \dot q_1", "m_1", "dLdqd1"),
    (r"∂L/∂q̇₁", "m_1", "dLdqd1"),
    (r"dL/dq1", "m_1", "dLdq1"),
    (r"dL/dq1'", "m_1", "dLdqd1"),
    (r"dL/d(q1_dot)", "m_1", "dLdqd1"),
    (r"\frac{\partial K}{\partial \dot{q}_1}", "m_1", "dLdqd1"),
    (r"\frac{d}{dt}\left(\frac{\partial L}{\partial \dot{q}_1}\right)", "m_1", "ddt1"),
    (r"\frac{d}{dt}\frac{\partial L}{\partial \dot{q}_2}", "m_1", "ddt2"),
    (r"\frac{\mathrm{d}}{\mathrm{d}t} \left[ \frac{\partial L}{\partial \dot{q}_2} \right]", "m_1", "ddt2"),
    (r"d/dt(dL/dq1')", "m_1", "ddt1"),
    (r"\frac{d}{dt}\left(\partial L/\partial \dot q_1\right)", "m_1", "ddt1"),
    (r"\tau_1", "m_1", "tau1"),
    (r"\tau_{2}", "m_1", "tau2"),
    (r"\tau_{\theta_1}", "m_1", "tau1"),
    (r"τ₁", "m_1", "tau1"),
    (r"tau_1", "m_1", "tau1"),
    (r"\tau", PAIR, "tau"),
    (r"\boldsymbol{\tau}", PAIR, "tau"),
    (r"\begin{bmatrix} \tau_1 \\ \tau_2 \end{bmatrix}", PAIR, "tau"),
    (r"D", SQUARE, "D"),
    (r"D(q)", SQUARE, "D"),
    (r"\mathbf{M}(\mathbf{q})", SQUARE, "D"),
    (r"B(\theta)", SQUARE, "D"),
    (r"C", SQUARE, "C"),
    (r"C(q, \dot{q})", SQUARE, "C"),
    (r"\mathbf{C}(\mathbf{q}, \dot{\mathbf{q}})", SQUARE, "C"),
    (r"C(\theta, \dot\theta)", SQUARE, "C"),
    (r"C(q,\dot q)\dot q", PAIR, "Cqd"),
    (r"c(q, \dot q)", PAIR, "Cqd"),
    (r"V(q, \dot q)", PAIR, "Cqd"),
    (r"g(q)", PAIR, "g"),
    (r"\mathbf{g}(\mathbf{q})", PAIR, "g"),
    (r"G", PAIR, "g"),
    (r"g_1", "m_1", "g1"),
    (r"\phi_1", "m_1", "g1"),
    (r"d_{11}", "m_1", "d11"),
    (r"D_{12}", "m_1", "d12"),
    (r"m_{22}", "m_1", "d22"),
    (r"C_{12}", "m_1", "C12"),
    (r"c_{12}", "m_1", "C12"),
    (r"c_{121}", "m_1", "c121"),
    (r"c_{1 2 1}", "m_1", "c121"),
    (r"c_{1,2,1}", "m_1", "c121"),
]


@pytest.mark.parametrize(("name", "value", "canonical"), NAMES)
def test_a_name_on_the_left(name: str, value: str, canonical: str) -> None:
    found = report(f"$$ {name} = {value} $$")
    assert [answer.name for answer in found.answers] == [canonical], found.not_recognized
    assert found.answers[0].node is not None


@pytest.mark.parametrize(("name", "value", "canonical"), [row for row in NAMES if row[0] not in ("g", "G")])
def test_a_name_on_the_right(name: str, value: str, canonical: str) -> None:
    if (canonical[0] in "dcCIw" and name[0] in "cCdmMI") or canonical == "Cqd":
        return  # on the right these are cosines and symbols of the problem
    found = report(f"$$ 2 {value} = {name} $$")
    assert [answer.name for answer in found.answers] == [canonical], found.not_recognized


DEFINITIONS = [
    r"\mathcal{P} = P_1 + P_2",
    r"K = K_{v_1} + K_{\omega_1} + K_{v_2} + K_{\omega_2}",
    r"L = K - P",
    r"\mathcal{L} = \mathcal{K} - \mathcal{P}",
    r"H_2^0 = A_1 A_2",
    r"P_i = m_i g h_i",
    r"P_i = m_i g^T r_{ci}",
    r"K_i = \frac{1}{2} m_i v_i^T v_i + \frac{1}{2}\omega_i^T I_i \omega_i",
    r"K_1 = \frac{1}{2} m_1 v_1^T v_1 + \frac{1}{2}\omega_1^T \mathcal{I}_1 \omega_1",
    r"K = \frac{1}{2}\dot q^T D(q) \dot q",
    r"K = \sum_{i=1}^{2} K_i",
    r"K = \sum_{i=1}^{n} \left( \frac{1}{2} m_i v_i^T v_i \right)",
    r"v_1 = J_{v_1} \dot{\mathbf{q}}",
    r"\omega_i = J_{\omega_i} \dot{q}",
    r"\mathcal{I}_1 = R_1 I_1 R_1^T",
    r"D(q)\ddot{q} + C(q,\dot q)\dot q + g(q) = \tau",
    r"\tau = D(q)\ddot{q} + C(q,\dot q)\dot q + g(q)",
    r"\frac{d}{dt}\frac{\partial L}{\partial \dot q_i} - \frac{\partial L}{\partial q_i} = \tau_i",
    r"\frac{d}{dt}\frac{\partial L}{\partial \dot q_1} - \frac{\partial L}{\partial q_1} = \tau_1",
    r"\tau_1 = \frac{d}{dt}\frac{\partial L}{\partial \dot q_1} - \frac{\partial L}{\partial q_1}",
    r"J_v = \begin{bmatrix} z_0 \times (o_2 - o_0) & z_1 \times (o_2 - o_1) \end{bmatrix}",
    r"\mathbf{J} = \begin{bmatrix} \mathbf{J_v} \\ \mathbf{J}_\omega \end{bmatrix}",
    r"J_{\omega} = \begin{bmatrix} z_0 & z_1 \end{bmatrix}",
    r"\tau = \begin{bmatrix} \tau_1 \\ \tau_2 \end{bmatrix}",
    r"D = \begin{bmatrix} d_{11} & d_{12} \\ d_{21} & d_{22} \end{bmatrix}",
    r"C = \begin{bmatrix} c_{11} & c_{12} \\ c_{21} & c_{22} \end{bmatrix}",
    r"g_k = \frac{\partial P}{\partial q_k}",
    r"c_{ijk} = \frac{1}{2}\left( \frac{\partial d_{kj}}{\partial q_i} "
    r"+ \frac{\partial d_{ki}}{\partial q_j} "
    r"- \frac{\partial d_{ij}}{\partial q_k} \right)",
    r"D = \sum_{i=1}^2 m_i J_{v_i}^T J_{v_i} + J_{\omega_i}^T R_i I_i R_i^T J_{\omega_i}",
    r"D(q) = m_1 J_{v_1}^T J_{v_1} + m_2 J_{v_2}^T J_{v_2} + J_{\omega_1}^T I_1 J_{\omega_1}",
    r"c_{111} = \frac{1}{2}\frac{\partial d_{11}}{\partial q_1}",
]


@pytest.mark.parametrize("text", DEFINITIONS)
def test_a_definition_is_left_alone(text: str) -> None:
    found = report(f"$$ {text} $$")
    assert found.answers == ()
    assert found.not_recognized == ()
