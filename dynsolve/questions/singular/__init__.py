"""Where the Jacobian has less than its greatest rank.

A matrix loses rank exactly where all minors of the size of its greatest rank are 0 (Spong, Hutchinson,
Vidyasagar, section 4.9, 2006); `derivation.singular` finds where.  `forms` has the alternatives as formulas.
"""

from __future__ import annotations

from dynsolve.quantities.family import Family, Kind
from dynsolve.quantities.stages import Stage

SINGULAR = Family(
    name="singular",
    called="the singular configurations",
    stage=Stage.SINGULAR,
    kind=Kind.EQUATIONS,
    spellings=("singularities",),
    terms=("singularity", "singularities", "singular configurations"),
)

FAMILIES: tuple[Family, ...] = tuple(record for record in vars().values() if isinstance(record, Family))
"""The records above, in their order."""
