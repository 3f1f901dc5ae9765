"""Slips in the transformations, the Jacobians and the rates."""

from __future__ import annotations

from dynsolve.answers.diagnosis.slips.record import HELD, IN3140, PLANAR_2R, Example, Slip

SLIPS = (
    Slip("joint_columns", "a column of the Jacobian",
         "Body {part}'s Jacobian has a column for a joint after it.",
         "A body is moved only by the joints before it.",
         Example(IN3140, "Jv1", [["0", "cos(theta1)"], ["0", "sin(theta1)"], ["0", "0"]])),
    Slip("prismatic_turns", "a prismatic joint",
         "A prismatic joint was given a column in J_ω.", "A prismatic joint turns nothing: its column is 0.",
         Example(IN3140, "Jw", [["0", "cos(theta1)"], ["0", "sin(theta1)"], ["1", "0"]])),
    Slip("order", "the order of a product", "The matrices are multiplied in the wrong order.",
         "H_i = H_{{i-1}} A_i: each new frame stands on the right.",
         Example(IN3140, "H2", [["-sin(theta1)", "0", "cos(theta1)", "0"],
                 ["cos(theta1)", "0", "sin(theta1)", "0"],
                 ["0", "1", "0", "L1+L2"], ["0", "0", "0", "1"]])),
    Slip("convention", "the convention", "This is what the other Denavit-Hartenberg convention gives.",
         "Standard: Rot_z Trans_z Trans_x Rot_x; modified: Rot_x Trans_x Rot_z Trans_z.",
         Example(IN3140, "A1", [["-sin(theta1)", "-cos(theta1)", "0", "0"], ["0", "0", "-1", "-L1"],
                 ["cos(theta1)", "-sin(theta1)", "0", "0"], ["0", "0", "0", "1"]])),
    Slip("offset", "an offset of the joint variable", "The constant part of the joint angle is left out.",
         "Look at the table: the angle is the variable plus its offset.",
         Example(IN3140, "A1", [["cos(theta1)", "0", "sin(theta1)", "0"],
                 ["sin(theta1)", "0", "-cos(theta1)", "0"],
                 ["0", "1", "0", "L1"], ["0", "0", "0", "1"]])),
    Slip("twist_sign", "the sign of α", "The sign of α is wrong.", "α turns about x, from z to the next z.",
         Example(IN3140, "A1", [["-sin(theta1)", "0", "-cos(theta1)", "0"],
                 ["cos(theta1)", "0", "-sin(theta1)", "0"], ["0", "-1", "0", "L1"], ["0", "0", "0", "1"]])),
    Slip("tool_frame", "the frame of a vector",
         "Your matrix is seen from {part}; it is asked for along the axes of {asked}.",
         "Its columns are vectors: z and o belong in the same frame.",
         Example(PLANAR_2R, "Jv", [["l1*sin(q2)", "0"], ["l1*cos(q2) + l2", "l2"], ["0", "0"]])),
    Slip("transpose_for_inverse", "the transpose for the inverse",
         "The velocity is multiplied by the transpose of the Jacobian, which takes forces to torques.",
         "Solve J q̇ = ṙ for q̇, and put what you find into it.",
         Example(HELD, "qd", [["-l1*sin(q1)*v - l2*sin(q1 + q2)*v"], ["-l2*sin(q1 + q2)*v"]])),
)  # fmt: skip
