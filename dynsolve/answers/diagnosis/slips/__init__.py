"""The records of the slips, by what they are made in.

    dynamics       what a slip is; the way from the energies to D, C and g; transformations, Jacobians,
                   rates;
                   friction, springs, rotors, forces from outside; Denavit-Hartenberg tables
    terms          a sign, a number, a factor, an angle: one term of an answer; how a matrix is written;
                   sets of configurations, and verdicts on matrices: a table of their own

In messages {yours} is what the student wrote, {term} the term that is meant, {part}
a factor or symbol, {other} what belongs in its place.
"""

from __future__ import annotations

from dynsolve.answers.diagnosis.slips import dynamics, terms
from dynsolve.answers.diagnosis.slips.dynamics import Slip
from dynsolve.answers.verdict import Diagnosis

_TABLES: tuple[tuple[Slip, ...], ...] = (
    terms.SLIPS,
    dynamics.SLIPS,
    dynamics.KINEMATICS_SLIPS,
    terms.MATRICES_SLIPS,
    dynamics.ACTIONS_SLIPS,
    dynamics.TABLES_SLIPS,
)  # fmt: skip

SLIPS = {slip.code: slip for table in _TABLES for slip in table}
"""The slips by their codes."""


def slip(code: str, **what: str) -> Diagnosis:
    """A slip of the tables as it happened."""
    return SLIPS[code].told(**what)
