"""The families of the bodies: mass centres, velocities, inertia.

The families of forward kinematics, and of the Jacobian of the end of the arm.
"""

from __future__ import annotations

from dynsolve.quantities import letters
from dynsolve.quantities.family import Family, Owner, of_body, of_robot
from dynsolve.quantities.letters import each
from dynsolve.quantities.stages import Stage
from dynsolve.robot.units import INERTIA, LENGTH, NONE, PER_SECOND, VELOCITY

LINEAR = each("v vc vm", "{b}")
"""What students write for the velocity of a body's mass centre."""

ANGULAR = each("omega omegac w wc", "{b}")
"""What they write for its angular velocity."""

RC = Family(
    name="rc{b}",
    called="the position|positions {} of the mass centre|centres",
    owner=Owner.BODY,
    stage=Stage.INERTIA,
    capped_in=Stage.KINEMATICS,
    shape=(3, 1),
    letter=of_body(letters.rc),
    json="r_c",
    dimension=LENGTH,
    spellings=("pc{b}", "oc{b}", "rm{b}"),
    terms=("mass centre", "mass center", "center of mass", "centre of mass", "com"),
)

R = Family(
    name="R{b}",
    owner=Owner.BODY,
    stage=Stage.INERTIA,
    shape=(3, 3),
    letter=of_body(lambda body: letters.of_body("R", body, "bold")),
    json="R",
    dimension=NONE,
    is_answer=False,
    needs_rotation=True,
)

JV_BODY = Family(
    name="Jv{b}",
    called="the linear part|parts {} of the Jacobian|Jacobians of the mass centre|centres",
    owner=Owner.BODY,
    stage=Stage.ENERGY,
    capped_in=Stage.JACOBIAN,
    shape=(3, "n"),
    letter=of_body(letters.jv),
    json="Jv",
    dimension=LENGTH,
    per=("column",),
    dimension_is_told=False,
    spellings=each("J", LINEAR),
)

JW_BODY = Family(
    name="Jw{b}",
    called="the angular part|parts {} of the Jacobian|Jacobians of the body|bodies",
    owner=Owner.BODY,
    stage=Stage.ENERGY,
    capped_in=Stage.JACOBIAN,
    shape=(3, "n"),
    letter=of_body(letters.jw),
    json="Jw",
    dimension=NONE,
    dimension_is_told=False,
    spellings=each("J", ANGULAR),
)

V = Family(
    name="v{b}",
    called="the velocity|velocities {} of the mass centre|centres",
    owner=Owner.BODY,
    stage=Stage.ENERGY,
    capped_in=Stage.JACOBIAN,
    shape=(3, 1),
    letter=of_body(lambda body: letters.of_body("v", body, "bold")),
    json="v",
    dimension=VELOCITY,
    spellings=LINEAR,
    terms=("velocity", "velocities", "linear velocity"),
)

W = Family(
    name="w{b}",
    called="the angular velocity|velocities {} of the body|bodies",
    owner=Owner.BODY,
    stage=Stage.ENERGY,
    capped_in=Stage.JACOBIAN,
    shape=(3, 1),
    letter=of_body(lambda body: letters.of_body("omega", body, "bold")),
    json="w",
    dimension=PER_SECOND,
    unit="rad/s",
    spellings=ANGULAR,
    terms=("omega", "angular velocity", "angular velocities"),
)

I_BODY = Family(
    name="I_body{b}",
    called="the inertia tensor|tensors {} along the axes of the body|bodies",
    owner=Owner.BODY,
    stage=Stage.INERTIA,
    shape=(3, 3),
    letter=lambda robot, b: letters.tensor(robot, robot.bodies[b - 1]),
    json="I_body",
    dimension=INERTIA,
    spellings=("Ib{b}", "I{b}", "Ic{b}", "I{b}b", "I{b}body"),
    needs_rotation=True,
)

I = Family(  # noqa: E741  the book's symbol
    name="I{b}",
    called="the inertia tensor|tensors {} along the axes of the base",
    owner=Owner.BODY,
    stage=Stage.INERTIA,
    shape=(3, 3),
    letter=of_body(lambda body: letters.base_tensor(letters.index_of(body.name))),
    json="I_base",
    dimension=INERTIA,
    spellings=("I0{b}", "Ibase{b}", "I{b}base"),
    needs_rotation=True,
    terms=("inertia tensor", "tensor"),
)

FAMILIES: tuple[Family, ...] = (RC, R, JV_BODY, JW_BODY, V, W, I_BODY, I)
"""The records above, in their order."""


# The families of forward kinematics, and of the Jacobian of the end of the arm

H0 = Family(name="H0", stage=Stage.KINEMATICS, shape=(4, 4), is_answer=False)

DH = Family(
    name="DH",
    called="the Denavit-Hartenberg parameters",
    stage=Stage.KINEMATICS,
    shape=("n", 4),
    letter=of_robot(letters.DH),
    spellings=("DHtable", "table"),
    terms=("denavit hartenberg", "dh table", "dh parameters", "table"),
)
"""The Denavit-Hartenberg table; no rule gives it, and its rows need not be those of the robot."""

A = Family(
    name="A{i}",
    called="the matrix|matrices {} of the row|rows of the table",
    owner=Owner.ROW,
    stage=Stage.KINEMATICS,
    shape=(4, 4),
    letter=lambda robot, i: letters.A(i),
    json="A",
    terms=("transformation", "transformations", "link transformations"),
)

H = Family(
    name="H{i}",
    called="the matrix|matrices {} of the forward kinematics, seen from the base",
    owner=Owner.ROW,
    stage=Stage.KINEMATICS,
    shape=(4, 4),
    letter=letters.H,
    json="H",
    spellings=("T{i}", "H0{i}", "T0{i}", "H{i}w"),
    terms=("forward kinematics", "fk", "pose", "homogeneous transformation"),
)

# -- the Jacobian of the end of the arm ------------------------------------------------------------

JV = Family(
    name="Jv",
    called="the linear part {} of the Jacobian",
    stage=Stage.JACOBIAN,
    shape=(3, "n"),
    letter=of_robot(letters.JV),
    json="Jv",
    dimension=LENGTH,
    per=("column",),
    dimension_is_told=False,
    spellings=("JP", "Jp"),
    part_of="J",
    terms=("linear jacobian", "linear velocity jacobian", "position jacobian"),
)

JW = Family(
    name="Jw",
    called="the angular part {} of the Jacobian",
    stage=Stage.JACOBIAN,
    shape=(3, "n"),
    letter=of_robot(letters.JW),
    json="Jw",
    dimension=NONE,
    dimension_is_told=False,
    spellings=("Jomega", "JO", "JOmega"),
    part_of="J",
    terms=("angular jacobian", "angular velocity jacobian", "orientation jacobian"),
)

J = Family(
    name="J",
    called="the Jacobian",
    stage=Stage.JACOBIAN,
    shape=(6, "n"),
    letter=of_robot(letters.J),
    terms=("jacobian", "jacobian matrix", "manipulator jacobian", "jacobi"),
)

KINEMATICS_FAMILIES: tuple[Family, ...] = (H0, DH, A, H, JV, JW, J)
"""The records above, in their order."""
