"""The planar elbow's answers in plain text, as the textbook has them."""

from __future__ import annotations

RP, ELBOW = "in3140-rp", "planar-2r"
D11 = "m1*lc1^2 + m2*(l1^2 + lc2^2 + 2*l1*lc2*cos(q2)) + I1 + I2"
D12 = "m2*(lc2^2 + l1*lc2*cos(q2)) + I2"
D22 = "m2*lc2^2 + I2"
H = "(-m2*l1*lc2*sin(q2))"
G1 = "(m1*lc1 + m2*l1)*g*cos(q1) + m2*lc2*g*cos(q1 + q2)"
G2 = "m2*lc2*g*cos(q1 + q2)"
TAU2 = f"({D12})*q1_ddot + ({D22})*q2_ddot - {H}*q1_dot^2 + {G2}"
TAU1 = f"({D11})*q1_ddot + ({D12})*q2_ddot + {H}*(2*q1_dot*q2_dot + q2_dot^2) + {G1}"
P = "m1*g*lc1*sin(q1) + m2*g*(l1*sin(q1) + lc2*sin(q1 + q2))"
K = f"({D11})*q1_dot^2/2 + ({D12})*q1_dot*q2_dot + ({D22})*q2_dot^2/2"


def column(*entries: str) -> list[list[str]]:
    return [[entry] for entry in entries]
