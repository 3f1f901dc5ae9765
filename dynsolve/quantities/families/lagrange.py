"""The families of the Euler-Lagrange equations: the derivatives of L, and the generalized forces."""

from __future__ import annotations

from dynsolve.notation.tree import Node, Symbol
from dynsolve.quantities import letters
from dynsolve.quantities.family import Family, Owner, of_coordinate, of_robot
from dynsolve.quantities.spelling import each
from dynsolve.quantities.stages import Stage
from dynsolve.robot.model import Coordinate
from dynsolve.robot.units import ENERGY, MOMENTUM


def _momentum(q: Coordinate) -> Node:
    return letters.partial_derivative(letters.L, letters.velocity(q))


DLDQD = Family(
    name="dLdqd{i}",
    owner=Owner.COORDINATE,
    stage=Stage.TORQUE,
    capped_in=Stage.LAGRANGIAN,
    letter=of_coordinate(_momentum),
    json="dL_dqdot",
    dimension=MOMENTUM,
    per=("owner",),
    spellings=("dLdqdot{i}", "dLd{name}dot"),
)

DDT = Family(
    name="ddt{i}",
    owner=Owner.COORDINATE,
    stage=Stage.TORQUE,
    capped_in=Stage.LAGRANGIAN,
    letter=of_coordinate(lambda q: letters.time_derivative(_momentum(q))),
    json="ddt",
    dimension=ENERGY,
    per=("owner",),
    unit="N m",
    spellings=("ddtdLdqd{i}",),
)

DLDQ = Family(
    name="dLdq{i}",
    owner=Owner.COORDINATE,
    stage=Stage.TORQUE,
    capped_in=Stage.LAGRANGIAN,
    letter=of_coordinate(lambda q: letters.partial_derivative(letters.L, Symbol(q.name))),
    json="dL_dq",
    dimension=ENERGY,
    per=("owner",),
    unit="N m",
    spellings=("dLd{name}",),
)

FORCE = Family(
    name="{force}",
    rule="tau{i}",
    owner=Owner.COORDINATE,
    stage=Stage.TORQUE,
    letter=of_coordinate(letters.force),
    json="force",
    dimension=ENERGY,
    per=("owner",),
    unit="N m",
    spellings=(*each("tau f F Q", "{i}"), *each("tau f F", "{q}")),
    fallback_spellings=("tau{s}", "f{s}"),
    aliases=("tau{i}", "f{i}"),
    part_of="tau",
)

TAU = Family(
    name="tau",
    stage=Stage.TORQUE,
    shape=("n", 1),
    letter=of_robot(letters.TAU),
    json="tau",
    dimension=ENERGY,
    per=("row",),
    unit="N m",
    spellings=("tauvec",),
)

FAMILIES: tuple[Family, ...] = (DLDQD, DDT, DLDQ, FORCE, TAU)
"""The records above, in their order."""
