"""Joint rates and accelerations for those of the task, and what the joints and the task can do.

`holding` finds the conditions under which they are right: the rank of the Jacobian, and what may not be 0.
"""

from __future__ import annotations

from dynsolve.quantities import letters
from dynsolve.quantities.family import Family, Kind, of_robot
from dynsolve.quantities.stages import Stage
from dynsolve.robot.questions import Questions

QD = Family(
    name="qd",
    at_state=True,
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
    at_state=True,
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
    at_state=True,
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
    at_state=True,
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
    at_state=True,
    called="the directions {} that are lost",
    stage=Stage.RATES,
    kind=Kind.SPAN,
    shape=("m", "any"),
    letter=of_robot(letters.LOST),
)

FAMILIES: tuple[Family, ...] = tuple(record for record in vars().values() if isinstance(record, Family))
"""The records above, in their order."""


def heading(questions: Questions) -> str:
    """What stands over it: accelerations where they are given or asked for."""
    is_of_both = "acceleration" in questions.given or "qdd" in questions.asked
    return Stage.RATES.heading if is_of_both else "Rates of the joints"
