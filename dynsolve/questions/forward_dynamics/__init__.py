"""The accelerations that given forces make; `named` has them in the entries of D."""

from __future__ import annotations

from dynsolve.quantities import letters
from dynsolve.quantities.family import Family, of_robot
from dynsolve.quantities.stages import Stage

QDD_FORWARD = Family(
    name="qdd_forward",
    called="the accelerations {} as functions of the forces",
    stage=Stage.FORWARD_DYNAMICS,
    shape=("n", 1),
    letter=of_robot(letters.QDD),
    spellings=("forwarddynamics", "qddforward", "qdd", "qddot", "ddq"),
    holds_forces=True,
    terms=("forward dynamics", "acceleration", "accelerations"),
)

FAMILIES: tuple[Family, ...] = tuple(record for record in vars().values() if isinstance(record, Family))
"""The records above, in their order."""
