"""Slips in how a matrix, a vector or a space is written."""

from __future__ import annotations

from dynsolve.answers.diagnosis.slips.record import IN3140, PLANAR_2R, Example, Slip

SLIPS = (
    Slip("transposed", "rows and columns exchanged", "Your matrix is the transpose of the right one.",
         "Check which index is the row.",
         Example(IN3140, "A1", [["-sin(theta1)", "cos(theta1)", "0", "0"], ["0", "0", "1", "0"],
                 ["cos(theta1)", "sin(theta1)", "0", "0"], ["0", "0", "L1", "1"]])),
    Slip("rows_swapped", "rows exchanged", "Rows {part} and {other} are exchanged.",
         "Check which joint or axis each row belongs to.",
         Example(IN3140, "tau", [["m2*L2_ddot - m2*L2*theta1_dot^2"],
                 ["(I1zz + m2*L2^2)*theta1_ddot + 2*m2*L2*L2_dot*theta1_dot"]])),
    Slip("shape", "the size of the matrix", "{yours}", "Count rows and columns.",
         Example(PLANAR_2R, "g", [["m2*lc2*g*cos(q1)"]])),
    Slip("span", "another space", "{yours}", "Put your vectors into the equation that they must solve.",
         Example("""
dh: [{theta: q1*, a: l1}, {theta: q2*, a: l2}, {theta: q3*, a: l3}]
state: {q2: 0, q3: 0}
find: [nullspace]
""", "nullspace", [["l2 + l3", "-l1", "0"], ["l3", "0", "-l1"]])),
)  # fmt: skip
