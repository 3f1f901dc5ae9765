"""The families of what acts beside gravity: springs, rotors, friction; see `quantities.families`.

The families of the Newton-Euler recursions, in the link's frame; see `quantities.families`.

The families of forces from outside and of the torques that hold them; see `quantities.families`.

The families of constraints: their matrix, its rate, the multipliers; see `quantities.families`.

The family of what is asked of matrices: whether they can be inertia matrices.
"""

from __future__ import annotations

from dynsolve.quantities import letters
from dynsolve.quantities.family import Family, Kind, Owner, of_body, of_robot
from dynsolve.quantities.stages import Stage
from dynsolve.robot.units import ACCELERATION, ENERGY, FORCE, PER_SECOND, Dimension, times

# The families of what acts beside gravity

PS = Family(
    name="Ps",
    stage=Stage.ENERGY,
    letter=of_robot(letters.PS),
    json="Ps",
    dimension=ENERGY,
    unit="J",
    spellings=("Us", "Vs", "Pel", "Pspring", "Uel", "Uspring", "Pe", "Ue"),
    brought_by="springs",
    part_of="P",
)

KM = Family(
    name="Km",
    stage=Stage.ENERGY,
    letter=of_robot(letters.KM),
    json="Km",
    dimension=ENERGY,
    unit="J",
    spellings=("Tm", "Kmotor", "Kmot", "Krotor", "Tmotor"),
    brought_by="motors",
    part_of="K",
)

FRICTION = Family(
    name="friction",
    stage=Stage.TORQUE,
    shape=("n", 1),
    letter=of_robot(letters.FRICTION),
    json="friction",
    dimension=ENERGY,
    per=("row",),
    unit="N m",
    spellings=("tauf", "tauF", "taufric", "taufriction", "F", "Ff", "fric", "Fqd", "Fvqd"),
    brought_by="friction",
)

FRICTION_ENTRY = Family(
    name="friction{i}",
    owner=Owner.COORDINATE,
    rule="friction",
    stage=Stage.TORQUE,
    letter=lambda robot, i: letters.friction(i),
    dimension=ENERGY,
    per=("owner",),
    unit="N m",
    spellings=("tauf{i}", "tauF{i}", "Ff{i}", "fric{i}"),
    brought_by="friction",
    part_of="friction",
)

# -- read by no answer: how the derivation adds them up --------------------------------------------

DM = Family(name="Dm", stage=Stage.VECTORIZED, shape=("n", "n"), is_answer=False, brought_by="motors")
"""What the rotors add to D."""

OF_ENERGY: tuple[Family, ...] = (PS, KM)
OF_TORQUE: tuple[Family, ...] = (FRICTION, FRICTION_ENTRY)
OF_THE_MODEL: tuple[Family, ...] = (DM,)
"""The records above, by their place in the derivation."""


# The families of the Newton-Euler recursions, in the link's frame


def _of_link(stem: str, base: str, dimension: Dimension, dots: int = 0, *spellings: str) -> Family:
    return Family(
        name=f"{stem}{{i}}",
        owner=Owner.ROW,
        stage=Stage.NEWTON_EULER,
        shape=(3, 1),
        letter=lambda robot, i: letters.in_link(base, i, dots),
        dimension=dimension,
        spellings=spellings,
    )


WL = _of_link("wl", "omega", PER_SECOND, 0, "omega{i}", "w{i}")
"""ω_i of frame i."""

WDL = _of_link("wdl", "omega", times(PER_SECOND, PER_SECOND), 1, "omegadot{i}", "omega{i}dot", "alpha{i}")
"""ω̇_i of frame i."""

AL = _of_link("al", "a", ACCELERATION, 0, "a{i}", "ae{i}", "vdot{i}", "v{i}dot")
"""The acceleration of the origin of frame i; in the modified convention with that of the base."""

ACL = Family(
    name="acl{b}",
    owner=Owner.BODY,
    stage=Stage.NEWTON_EULER,
    shape=(3, 1),
    letter=of_body(lambda body: letters.center_in_link("a", body)),
    dimension=ACCELERATION,
    spellings=("ac{b}", "vcdot{b}", "vdotc{b}", "vc{b}dot", "vC{b}dot", "vCdot{b}"),
)
"""The acceleration of a body's mass centre; in the modified convention with that of the base."""

FL = _of_link("fl", "f", FORCE, 0, "f{i}")
"""The force that the link before exerts on link i."""

NL = _of_link("nl", "n", ENERGY, 0, "n{i}", "mu{i}")
"""The moment that the link before exerts on link i, about o_{i-1}, in the modified convention about o_i."""

FAMILIES: tuple[Family, ...] = (WL, WDL, AL, ACL, FL, NL)
"""The records above, in their order."""


# The families of forces from outside and of the torques that hold them

LOAD = Family(
    name="load{i}",
    owner=Owner.LOAD,
    stage=Stage.STATICS,
    shape=("n", 1),
    letter=lambda robot, i: letters.of_load(i),
    dimension=ENERGY,
    per=("row",),
    unit="N m",
    is_answer=False,
)

Q = Family(
    name="Q",
    stage=Stage.STATICS,
    shape=("n", 1),
    letter=of_robot(letters.Q_FORCES),
    dimension=ENERGY,
    per=("row",),
    unit="N m",
    dimension_is_told=False,
    spellings=("Qext", "tauext"),
)

TAU_STATIC = Family(
    name="tau_static",
    stage=Stage.STATICS,
    shape=("n", 1),
    letter=of_robot(letters.TAU_STATIC),
    dimension=ENERGY,
    per=("row",),
    unit="N m",
    dimension_is_told=False,
    spellings=("taus", "taust", "tau0", "tau"),
)

Q_ENTRY = Family(
    name="Q{i}",
    rule="Q",
    owner=Owner.COORDINATE,
    stage=Stage.STATICS,
    letter=lambda robot, i: letters.entry("Q", i),
    part_of="Q",
)

TAU_STATIC_ENTRY = Family(
    name="tau_static{i}",
    rule="tau_static",
    owner=Owner.COORDINATE,
    stage=Stage.STATICS,
    letter=letters.static_torque,
    spellings=("taus{i}", "tau{i}", "tau{q}", "{force}"),
    part_of="tau_static",
)

STATIC_FAMILIES: tuple[Family, ...] = (LOAD, Q, Q_ENTRY, TAU_STATIC, TAU_STATIC_ENTRY)
"""The records above, in their order."""


# The families of constraints

H_C = Family(
    name="hc", stage=Stage.CONSTRAINTS, shape=("c", 1), letter=of_robot(letters.H_C), is_answer=False
)
"""The functions h(q) that are kept at 0; there are none of constraints on the rates."""

AC = Family(
    name="Ac",
    stage=Stage.CONSTRAINTS,
    shape=("c", "n"),
    letter=of_robot(letters.A_C),
    spellings=("A", "Jc", "Jh", "Jlambda"),
)

AC_DOT = Family(
    name="Ac_dot",
    stage=Stage.CONSTRAINTS,
    shape=("c", "n"),
    letter=of_robot(letters.rate(letters.A_C)),
    spellings=("Adot", "dA", "dAc", "Jcdot", "Jhdot"),
)

LAMBDA = Family(
    name="lambda",
    stage=Stage.CONSTRAINTS,
    shape=("c", 1),
    letter=of_robot(letters.LAMBDA),
    spellings=("lam", "lambda_", "mu"),
)

LAMBDA_ENTRY = Family(
    name="lambda{i}",
    rule="lambda",
    owner=Owner.CONSTRAINT,
    stage=Stage.CONSTRAINTS,
    letter=lambda robot, i: letters.entry("lambda", i),
    spellings=("lam{i}",),
    part_of="lambda",
)

REDUCED = Family(
    name="reduced",
    stage=Stage.CONSTRAINTS,
    kind=Kind.CONDITIONS,
    spellings=("eliminated", "reducedequations"),
)

CONSTRAINT_FAMILIES: tuple[Family, ...] = (H_C, AC, AC_DOT, LAMBDA, LAMBDA_ENTRY, REDUCED)
"""The records above, in their order."""

MULTIPLIERS = (LAMBDA, LAMBDA_ENTRY)
"""λ, and its entries."""


# The family of what is asked of matrices: whether they can be inertia matrices

DEFINITE = Family(
    name="definite", stage=Stage.DEFINITE, kind=Kind.VERDICTS, spellings=("positivedefinite", "posdef")
)

DEFINITE_FAMILIES: tuple[Family, ...] = (DEFINITE,)
"""The records above, in their order."""
