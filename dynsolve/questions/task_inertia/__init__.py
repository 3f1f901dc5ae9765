"""The inertia that a force at the task meets."""

from __future__ import annotations

from dynsolve.quantities import letters
from dynsolve.quantities.family import Family, of_robot
from dynsolve.quantities.stages import Stage

LAMBDA = Family(
    name="Lambda",
    called="the inertia matrix of the task",
    stage=Stage.TASK_INERTIA,
    shape=("m", "m"),
    letter=of_robot(letters.TASK_INERTIA),
    spellings=("Mr", "Dr", "Mp"),
    terms=("task inertia", "operational space inertia"),
)

FAMILIES: tuple[Family, ...] = tuple(record for record in vars().values() if isinstance(record, Family))
"""The records above, in their order."""
