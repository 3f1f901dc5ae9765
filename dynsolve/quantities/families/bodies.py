"""The families of the bodies: mass centres, velocities, inertia."""

from __future__ import annotations

from dynsolve.quantities import letters
from dynsolve.quantities.family import Family, Owner, of_body
from dynsolve.quantities.spelling import each
from dynsolve.quantities.stages import Stage
from dynsolve.robot.units import INERTIA, LENGTH, NONE, PER_SECOND, VELOCITY

LINEAR = each("v vc vm", "{b}")
"""What students write for the velocity of a body's mass centre."""

ANGULAR = each("omega omegac w wc", "{b}")
"""What they write for its angular velocity."""

RC = Family(
    name="rc{b}",
    owner=Owner.BODY,
    stage=Stage.INERTIA,
    capped_in=Stage.KINEMATICS,
    shape=(3, 1),
    letter=of_body(letters.rc),
    json="r_c",
    dimension=LENGTH,
    spellings=("pc{b}", "oc{b}", "rm{b}"),
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
    owner=Owner.BODY,
    stage=Stage.ENERGY,
    capped_in=Stage.JACOBIAN,
    shape=(3, 1),
    letter=of_body(lambda body: letters.of_body("v", body, "bold")),
    json="v",
    dimension=VELOCITY,
    spellings=LINEAR,
)

W = Family(
    name="w{b}",
    owner=Owner.BODY,
    stage=Stage.ENERGY,
    capped_in=Stage.JACOBIAN,
    shape=(3, 1),
    letter=of_body(lambda body: letters.of_body("omega", body, "bold")),
    json="w",
    dimension=PER_SECOND,
    unit="rad/s",
    spellings=ANGULAR,
)

I_BODY = Family(
    name="I_body{b}",
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
    owner=Owner.BODY,
    stage=Stage.INERTIA,
    shape=(3, 3),
    letter=of_body(lambda body: letters.base_tensor(letters.index_of(body.name))),
    json="I_base",
    dimension=INERTIA,
    spellings=("I0{b}", "Ibase{b}", "I{b}base"),
    needs_rotation=True,
)

FAMILIES: tuple[Family, ...] = (RC, R, JV_BODY, JW_BODY, V, W, I_BODY, I)
"""The records above, in their order."""
