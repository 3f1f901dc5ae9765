"""The families of forward kinematics, and of the Jacobian of the end of the arm."""

from __future__ import annotations

from dynsolve.quantities import letters
from dynsolve.quantities.family import Family, Owner, of_robot
from dynsolve.quantities.stages import Stage
from dynsolve.robot.units import LENGTH, NONE

H0 = Family(name="H0", stage=Stage.KINEMATICS, shape=(4, 4), is_answer=False)

DH = Family(
    name="DH",
    stage=Stage.KINEMATICS,
    shape=("n", 4),
    letter=of_robot(letters.DH),
    spellings=("DHtable", "table"),
)
"""The Denavit-Hartenberg table; no rule gives it, and its rows need not be those of the robot."""

A = Family(
    name="A{i}",
    owner=Owner.ROW,
    stage=Stage.KINEMATICS,
    shape=(4, 4),
    letter=lambda robot, i: letters.A(i),
    json="A",
)

H = Family(
    name="H{i}",
    owner=Owner.ROW,
    stage=Stage.KINEMATICS,
    shape=(4, 4),
    letter=letters.H,
    json="H",
    spellings=("T{i}", "H0{i}", "T0{i}"),
)

# -- the Jacobian of the end of the arm ------------------------------------------------------------

JV = Family(
    name="Jv",
    stage=Stage.JACOBIAN,
    shape=(3, "n"),
    letter=of_robot(letters.JV),
    json="Jv",
    dimension=LENGTH,
    per=("column",),
    dimension_is_told=False,
    spellings=("JP", "Jp"),
    part_of="J",
)

JW = Family(
    name="Jw",
    stage=Stage.JACOBIAN,
    shape=(3, "n"),
    letter=of_robot(letters.JW),
    json="Jw",
    dimension=NONE,
    dimension_is_told=False,
    spellings=("Jomega", "JO", "JOmega"),
    part_of="J",
)

J = Family(name="J", stage=Stage.JACOBIAN, shape=(6, "n"), letter=of_robot(letters.J))

FAMILIES: tuple[Family, ...] = (H0, DH, A, H, JV, JW, J)
"""The records above, in their order."""
