"""Constraints: their matrix, its rate, the multipliers.

`closed` has the equations of motion without multipliers in the accelerations that are free, `forms` both as
formulas.
"""

from __future__ import annotations

from dynsolve.quantities import letters
from dynsolve.quantities.family import Family, Kind, Owner, of_robot
from dynsolve.quantities.stages import Stage

H_C = Family(
    name="hc", stage=Stage.CONSTRAINTS, shape=("c", 1), letter=of_robot(letters.H_C), is_answer=False
)
"""The functions h(q) that are kept at 0; there are none of constraints on the rates."""


AC = Family(
    name="Ac",
    called="the matrix of the constraints",
    stage=Stage.CONSTRAINTS,
    shape=("c", "n"),
    letter=of_robot(letters.A_C),
    spellings=("A", "Jc", "Jh", "Jlambda"),
    terms=("constraint jacobian", "constraint matrix"),
)


AC_DOT = Family(
    name="Ac_dot",
    called="the time derivative {} of the matrix of the constraints",
    stage=Stage.CONSTRAINTS,
    shape=("c", "n"),
    letter=of_robot(letters.rate(letters.A_C)),
    spellings=("Adot", "dA", "dAc", "Jcdot", "Jhdot"),
)


LAMBDA = Family(
    name="lambda",
    called="the multipliers",
    stage=Stage.CONSTRAINTS,
    shape=("c", 1),
    letter=of_robot(letters.LAMBDA),
    spellings=("lam", "lambda_", "mu"),
    holds_forces=True,
    terms=("multiplier", "multipliers", "lagrange multipliers"),
)


LAMBDA_ENTRY = Family(
    name="lambda{i}",
    called="the multiplier|multipliers {}",
    rule="lambda",
    owner=Owner.CONSTRAINT,
    stage=Stage.CONSTRAINTS,
    letter=lambda robot, i: letters.entry("lambda", i),
    spellings=("lam{i}",),
    part_of="lambda",
)


REDUCED = Family(
    name="reduced",
    called="the equations without multipliers",
    stage=Stage.CONSTRAINTS,
    kind=Kind.CONDITIONS,
    spellings=("eliminated", "reducedequations"),
    needs="mass",
    holds_forces=True,
)


MULTIPLIERS = (LAMBDA, LAMBDA_ENTRY)
"""λ, and its entries."""

FAMILIES: tuple[Family, ...] = tuple(record for record in vars().values() if isinstance(record, Family))
"""The records above, in their order."""
