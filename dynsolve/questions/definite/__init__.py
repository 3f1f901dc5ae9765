"""Whether matrices can be inertia matrices: symmetric, positive definite."""

from __future__ import annotations

from dynsolve.quantities.family import Family, Kind
from dynsolve.quantities.stages import Stage

DEFINITE = Family(
    name="definite",
    called="whether a matrix can be an inertia matrix",
    stage=Stage.DEFINITE,
    kind=Kind.VERDICTS,
    spellings=("positivedefinite", "posdef"),
    terms=("positive definite", "definiteness"),
)

FAMILIES: tuple[Family, ...] = tuple(record for record in vars().values() if isinstance(record, Family))
"""The records above, in their order."""
