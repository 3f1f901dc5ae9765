"""Slips in a Denavit-Hartenberg table."""

from __future__ import annotations

from dynsolve.answers.diagnosis.slips.record import PLANAR_2R, Example, Slip

SLIPS = (
    Slip("dh_cell", "one cell of the table", "Row {part}: {yours} where {other} is needed. {term}",
         "Follow the four motions of this row with the drawing: about z, along z, along x, about x.",
         Example(PLANAR_2R, "DH", [["q1", "0", "l1", "90deg"], ["q2", "0", "l2", "0"]])),
    Slip("dh_exchanged", "two columns", "Row {part}: d and a are exchanged.",
         "d is measured along z, the joint's axis, and a across it, along x.",
         Example(PLANAR_2R, "DH", [["q1", "l1", "0", "0"], ["q2", "0", "l2", "0"]])),
    Slip("dh_joints", "the joint variables", "{yours}.",
         "A revolute joint has its variable in θ, a prismatic one in d, one joint a row.",
         Example(PLANAR_2R, "DH", [["0", "q1", "l1", "0"], ["q2", "0", "l2", "0"]])),
    Slip("dh_mechanism", "several cells of the table",
         "The table describes another mechanism: {part}. More than a few cells are to blame.",
         "Go through the rows with the drawing: about z, along z, along x, about x.",
         Example(PLANAR_2R, "DH", [["q1", "0", "0", "45deg"], ["q2", "l1", "l1", "90deg"]])),
    Slip("dh_convention", "the convention",
         "The table is right in the {other} convention, and asked for in the {part} one.",
         "In Spong's table a row ends with a and α, in Craig's it begins with those of the row before.",
         Example("""
convention: modified
dh: [{theta: q1*}, {theta: q2*, a: l1}, {a: l2}]
""", "DH", [["q1", "0", "l1", "0"], ["q2", "0", "l2", "0"]])),
    Slip("dh_shifted", "the convention",
         "a and α stand one row too {yours}: the rows are those of the {other} convention, and the {part} "
         "one is asked for.",
         "In Spong's table a row ends with a and α, in Craig's it begins with those of the row before.",
         Example("elbow-3r", "DH", [["theta1", "L1", "0", "0"], ["theta2", "0", "0", "90deg"],
                                    ["theta3", "0", "L2", "0"]])),
    Slip("dh_sense", "the sense of a joint",
         "{yours}; here every coordinate has to be counted as it is given.",
         "Choose the direction of each z, and where each joint is at 0, as they are given.",
         Example("""
strict: true
dh: [{theta: q1*, a: l1}, {theta: q2*, a: l2}]
""", "DH", [["q1", "0", "l1", "0"], ["q2 + 90deg", "0", "l2", "0"]])),
)  # fmt: skip
