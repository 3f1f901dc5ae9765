"""Joint rates and accelerations for those of the task, and what the joints and the task can do."""

from __future__ import annotations

from dynsolve.quantities import letters
from dynsolve.quantities.family import Family, Kind, of_robot
from dynsolve.quantities.stages import Stage

QD = Family(
    name="qd",
    called="the rates of the coordinates",
    stage=Stage.RATES,
    shape=("n", 1),
    letter=of_robot(letters.QD),
    spellings=("qdot", "dq"),
    needs="velocity",
    terms=("joint velocity", "joint velocities", "joint rates"),
)


QDD = Family(
    name="qdd",
    called="the accelerations of the coordinates",
    stage=Stage.RATES,
    shape=("n", 1),
    letter=of_robot(letters.QDD),
    spellings=("qddot", "ddq"),
    needs="acceleration",
    terms=("joint acceleration", "joint accelerations"),
)


NULLSPACE = Family(
    name="nullspace",
    called="the null space {} of the Jacobian",
    stage=Stage.RATES,
    kind=Kind.SPAN,
    shape=("n", "any"),
    letter=of_robot(letters.NULLSPACE),
    spellings=("N", "null", "kernel", "ker"),
    terms=("null space", "kernel"),
)


RANGESPACE = Family(
    name="rangespace",
    called="the range space {} of the Jacobian",
    stage=Stage.RATES,
    kind=Kind.SPAN,
    shape=("m", "any"),
    letter=of_robot(letters.RANGESPACE),
    spellings=("range", "image", "R"),
    terms=("range space", "image"),
)


LOST = Family(
    name="lost",
    called="the directions {} that are lost",
    stage=Stage.RATES,
    kind=Kind.SPAN,
    shape=("m", "any"),
    letter=of_robot(letters.LOST),
)

FAMILIES: tuple[Family, ...] = tuple(record for record in vars().values() if isinstance(record, Family))
"""The records above, in their order."""
