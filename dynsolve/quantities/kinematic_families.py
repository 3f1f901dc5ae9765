"""The families of what an exercise asks of the kinematics: points, the task, how Jacobians change.

A robot has those of a stage of which something is asked (`quantities.stages`).  To add one,
see `quantities.families`; its rule stands in `dynsolve.derivation.task`.
"""

from __future__ import annotations

from dynsolve.quantities import letters
from dynsolve.quantities.family import Family, Kind, Owner, of_point, of_robot
from dynsolve.quantities.stages import Stage
from dynsolve.robot.units import LENGTH, NONE, PER_SECOND, VELOCITY

# -- points that the exercise names ---------------------------------------------------------------

P_POINT = Family(
    name="p{p}",
    owner=Owner.POINT,
    stage=Stage.TASK,
    shape=(3, 1),
    letter=of_point(lambda point: letters.of_point("p", point.name)),
    dimension=LENGTH,
    spellings=("r{p}", "o{p}"),
)

JV_POINT = Family(
    name="Jv{p}",
    owner=Owner.POINT,
    stage=Stage.TASK,
    shape=(3, "n"),
    letter=of_point(lambda point: letters.j_of_point("v", point.name, point.axes)),
    dimension=LENGTH,
    per=("column",),
    dimension_is_told=False,
    spellings=("J{p}",),
)

JW_POINT = Family(
    name="Jw{p}",
    owner=Owner.POINT,
    stage=Stage.TASK,
    shape=(3, "n"),
    letter=of_point(lambda point: letters.j_of_point("omega", point.name, point.axes)),
    dimension=NONE,
    dimension_is_told=False,
    spellings=("Jomega{p}",),
)

V_POINT = Family(
    name="v{p}",
    owner=Owner.POINT,
    stage=Stage.TASK,
    shape=(3, 1),
    letter=of_point(lambda point: letters.of_point("v", point.name, point.axes)),
    dimension=VELOCITY,
    spellings=("p{p}dot", "r{p}dot", "o{p}dot"),
)

# -- how the arm's own Jacobian changes ------------------------------------------------------------

JV_DOT = Family(
    name="Jv_dot",
    stage=Stage.TASK,
    shape=(3, "n"),
    letter=of_robot(letters.rate(letters.JV)),
    dimension=VELOCITY,
    per=("column",),
    dimension_is_told=False,
    spellings=("dJv",),
    part_of="J_dot",
)

JW_DOT = Family(
    name="Jw_dot",
    stage=Stage.TASK,
    shape=(3, "n"),
    letter=of_robot(letters.rate(letters.JW)),
    dimension=PER_SECOND,
    dimension_is_told=False,
    spellings=("Jomegadot", "dJw"),
    part_of="J_dot",
)

J_DOT = Family(
    name="J_dot",
    stage=Stage.TASK,
    shape=(6, "n"),
    letter=of_robot(letters.rate(letters.J)),
    spellings=("dJ",),
)

# -- the task --------------------------------------------------------------------------------------

R = Family(
    name="r", stage=Stage.TASK, shape=("m", 1), letter=of_robot(letters.TASK), spellings=("p", "pe", "ptip")
)

R_ENTRY = Family(
    name="r{i}",
    rule="r",
    owner=Owner.TASK,
    stage=Stage.TASK,
    letter=lambda robot, i: letters.entry("r", i),
    spellings=("{name}",),
    part_of="r",
)

JR = Family(
    name="Jr", stage=Stage.TASK, shape=("m", "n"), letter=of_robot(letters.J_TASK), spellings=("J", "Ja")
)

JR_DOT = Family(
    name="Jr_dot",
    stage=Stage.TASK,
    shape=("m", "n"),
    letter=of_robot(letters.rate(letters.J_TASK)),
    spellings=("dJr", "Jdot", "dJ"),
)

DET = Family(
    name="det",
    stage=Stage.TASK,
    letter=of_robot(letters.DET),
    spellings=("detJ", "detJr", "detJJT", "Delta"),
)

# -- its configurations ----------------------------------------------------------------------------

SINGULAR = Family(name="singular", stage=Stage.SINGULAR, kind=Kind.EQUATIONS, spellings=("singularities",))

INVERSE = Family(name="inverse", stage=Stage.INVERSE, kind=Kind.BRANCHES, spellings=("ik",))

# -- rates for a velocity or an acceleration of the task -------------------------------------------

QD = Family(
    name="qd",
    stage=Stage.RATES,
    shape=("n", 1),
    letter=of_robot(letters.QD),
    spellings=("qdot", "dq"),
)

QDD = Family(
    name="qdd",
    stage=Stage.RATES,
    shape=("n", 1),
    letter=of_robot(letters.QDD),
    spellings=("qddot", "ddq"),
)

# -- what the joints and the task can do at a state ------------------------------------------------

NULLSPACE = Family(
    name="nullspace",
    stage=Stage.RATES,
    kind=Kind.SPAN,
    shape=("n", "any"),
    letter=of_robot(letters.NULLSPACE),
    spellings=("N", "null", "kernel", "ker"),
)

RANGESPACE = Family(
    name="rangespace",
    stage=Stage.RATES,
    kind=Kind.SPAN,
    shape=("m", "any"),
    letter=of_robot(letters.RANGESPACE),
    spellings=("range", "image", "R"),
)

LOST = Family(
    name="lost",
    stage=Stage.RATES,
    kind=Kind.SPAN,
    shape=("m", "any"),
    letter=of_robot(letters.LOST),
)

FAMILIES: tuple[Family, ...] = tuple(record for record in vars().values() if isinstance(record, Family))
"""The records above, in their order."""
