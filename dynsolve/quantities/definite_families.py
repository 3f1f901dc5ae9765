"""The family of what is asked of matrices: whether they can be inertia matrices."""

from __future__ import annotations

from dynsolve.quantities.family import Family, Kind
from dynsolve.quantities.stages import Stage

DEFINITE = Family(
    name="definite", stage=Stage.DEFINITE, kind=Kind.VERDICTS, spellings=("positivedefinite", "posdef")
)

FAMILIES: tuple[Family, ...] = (DEFINITE,)
"""The records above, in their order."""
