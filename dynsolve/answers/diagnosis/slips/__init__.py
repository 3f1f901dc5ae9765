"""The records of the slips, by what they are made in.

    record         what a slip is
    terms          a sign, a number, a factor, an angle: one term of an answer
    dynamics       the way from the energies to D, C and g
    kinematics     transformations, Jacobians, rates
    matrices       how a matrix, a vector or a space is written
    actions        friction, springs, rotors, forces from outside
    tables         Denavit-Hartenberg tables
    configurations sets of configurations, and verdicts on matrices: a table of their own

In messages {yours} is what the student wrote, {term} the term that is meant, {part}
a factor or symbol, {other} what belongs in its place.
"""

from __future__ import annotations

from dynsolve.answers.diagnosis.slips import actions, dynamics, kinematics, matrices, tables, terms
from dynsolve.answers.diagnosis.slips.record import Slip
from dynsolve.answers.verdict import Diagnosis

_TABLES: tuple[tuple[Slip, ...], ...] = (
    terms.SLIPS, dynamics.SLIPS, kinematics.SLIPS, matrices.SLIPS, actions.SLIPS, tables.SLIPS,
)  # fmt: skip

SLIPS = {slip.code: slip for table in _TABLES for slip in table}
"""The slips by their codes."""


def slip(code: str, **what: str) -> Diagnosis:
    """A slip of the tables as it happened."""
    return SLIPS[code].told(**what)
