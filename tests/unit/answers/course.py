"""The equations of the IN3140 dynamics overview (University of Oslo, 2020) for its RP manipulator.

In plain text, as they stand there, slips and all; the number of each is beside it.
"""

from __future__ import annotations

_IDENTITY_ROW = ["0", "0", "0", "1"]
_KV2 = "m2*(cos(2*theta1)*L2^2*theta1_dot^2 + L2_dot^2)/2"

COURSE: dict[str, str | list[list[str]]] = {
    "H1": [["-sin(theta1)", "0", "cos(theta1)", "0"], ["cos(theta1)", "0", "sin(theta1)", "0"],
           ["0", "1", "0", "L1"], _IDENTITY_ROW],  # (3)
    "A1": [["-sin(theta1)", "0", "cos(theta1)", "0"], ["cos(theta1)", "0", "sin(theta1)", "0"],
           ["0", "1", "0", "L1"], _IDENTITY_ROW],  # (3)
    "A2": [["1", "0", "0", "0"], ["0", "1", "0", "0"], ["0", "0", "1", "L2"], _IDENTITY_ROW],  # (4)
    "H2": [["-sin(theta1)", "0", "cos(theta1)", "cos(theta1)*L2"],
           ["cos(theta1)", "0", "sin(theta1)", "sin(theta1)*L2"],
           ["0", "1", "0", "L1"], _IDENTITY_ROW],  # (5)
    "Jv": [["-sin(theta1)*L2", "cos(theta1)"], ["cos(theta1)*L2", "sin(theta1)"], ["0", "0"]],  # (9)
    "Jw": [["0", "0"], ["0", "0"], ["1", "0"]],  # (10)
    "I_body1": [["0", "0", "0"], ["0", "0", "0"], ["0", "0", "I1zz"]],  # (1)
    "P1": "m1*g*L1/2",  # (14)
    "P2": "m2*g*L1",  # (15)
    "v1": [["0"], ["0"], ["0"]],  # (19)
    "v2": [["-sin(theta1)*L2*theta1_dot + cos(theta1)*L2_dot"],
           ["cos(theta1)*L2*theta1_dot + sin(theta1)*L2_dot"], ["0"]],  # (20)
    "Kv1": "0",  # (21)
    "Kv2": _KV2,  # (22)
    "w1": [["0"], ["0"], ["theta1_dot"]],  # (24)
    "Kw1": "I1zz*theta1_dot^2/2",  # (27)
    "K": "0 + I1zz*theta1_dot^2/2 + m2*(cos(2*theta1)*L2^2*theta1_dot^2 + L2^2)/2 + 0",  # (29)
    "P": "m1*g*L1/2 + m2*g*L1",  # (30)
    "L": f"I1zz*theta1_dot^2/2 + {_KV2} - m1*g*L1/2 - m2*g*L1",  # (32)
    "dLdqd1": "I1zz*theta1_dot + m2*cos(2*theta1)*L2^2*theta1_dot",  # (36)
    "ddt1": "theta1_ddot + m2*cos(2*theta1)*L2^2*theta1_ddot + 2*m2*cos(2*theta1)*L2_dot^2*theta1_dot"
            " - 2*m2*sin(2*theta1)*L2^2*theta1_dot^2",  # (37)
    "dLdq1": "-m2*sin(2*theta1)*L2^2*theta1_dot^2",  # (38)
    "tau1": "theta1_ddot + m2*cos(2*theta1)*L2^2*theta1_ddot + 2*m2*cos(2*theta1)*L2_dot^2*theta1_dot"
            " - m2*sin(2*theta1)*L2^2*theta1_dot^2",  # (39)
    "dLdqd2": "L2_dot",  # (40)
    "ddt2": "L2_ddot",  # (41)
    "dLdq2": "m2*cos(2*theta1)*L2*theta1_dot^2",  # (42)
    "f2": "L2_ddot - m2*cos(2*theta1)*L2*theta1_dot^2",  # (43)
    "tau": [["theta1_ddot + m2*cos(2*theta1)*L2^2*theta1_ddot + 2*m2*cos(2*theta1)*L2_dot*theta1_dot"
             " - m2*sin(2*theta1)*L2^2*theta1_dot^2"],
            ["L2_ddot - m2*cos(2*theta1)*L2*theta1_dot^2"]],  # (44)
    "D": [["m2*cos(2*theta1)*L2^2 + 1", "0"], ["0", "1"]],  # (46)
    "C": [["-m2*sin(2*theta1)*L2^2*theta1_dot", "2*m2*cos(2*theta1)*theta1_dot"],
          ["-m2*cos(2*theta1)*L2*theta1_dot", "0"]],  # (46)
    "g": [["0"], ["0"]],  # (46)
}  # fmt: skip
