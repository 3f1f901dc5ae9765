"""Friction of the joints: f_v q̇ + f_c sgn(q̇).

sgn(q̇) is no polynomial: it is a generator of its own in the ring, 0 at rest (`Ring.without`).
"""

from __future__ import annotations

import math
from collections.abc import Iterator

from msgspec.structs import replace

from dynsolve.acts.friction import FRICTION, KEY
from dynsolve.algebra.matrix import Matrix
from dynsolve.algebra.ring import Expr
from dynsolve.algebra.ring_values import evaluate
from dynsolve.notation.tree import Function, Symbol
from dynsolve.problem.acting import constant
from dynsolve.problem.cells import Cell, read_cell
from dynsolve.problem.decoder import Decoder, Record
from dynsolve.problem.kinds import VISCOUS, Fields
from dynsolve.problem.table import by_coordinate
from dynsolve.problem.values import CellValues
from dynsolve.problem.yaml_nodes import FaultyNode, MappingNode
from dynsolve.robot.actions import Parameter, Values
from dynsolve.robot.model import Resisting, Robot
from dynsolve.robot.units import ENERGY, along, dimension, times

TERM = Resisting


class JointFriction(Resisting, frozen=True):
    """Friction of coordinate k, counted from 0: f_v q̇_k + f_c sgn(q̇_k)."""

    coordinate: int
    viscous: Expr
    coulomb: Expr

    def force(self, robot: Robot) -> Matrix:
        """f_v q̇ + f_c sgn(q̇) in the row of its coordinate, n×1."""
        ring, entries = robot.ring, [robot.ring.zero] * robot.n
        rate = Symbol(ring.names[self.coordinate], 1)
        force = self.viscous * ring.symbol(rate.name, 1)
        if not self.coulomb.is_zero:
            force = force + self.coulomb * ring.function(Function("sgn", rate))
        entries[self.coordinate] = force
        return Matrix.column(ring, entries)

    def force_at(self, robot: Robot, values: Values) -> list[float]:
        """The same by the sign of a number."""
        found = [0.0] * robot.n
        rate = values[robot.coordinates[self.coordinate].velocity]
        viscous, coulomb = (evaluate(expr, values) for expr in (self.viscous, self.coulomb))
        found[self.coordinate] = viscous * rate + (math.copysign(coulomb, rate) if rate else 0.0)
        return found

    def functions(self, robot: Robot) -> tuple[Function, ...]:
        """sgn q̇, where there is Coulomb friction."""
        name = robot.coordinates[self.coordinate].name
        return () if self.coulomb.is_zero else (Function("sgn", Symbol(name, 1)),)

    def parameters(self, robot: Robot) -> Iterator[Parameter]:
        """The coefficients of both."""
        x = robot.coordinates[self.coordinate].dimension
        viscous, coulomb = times(times(ENERGY, x, -2), dimension(time=1)), times(ENERGY, x, -1)
        words = "coefficient|coefficients of {} friction"
        yield Parameter(self.viscous, words.format("viscous"), viscous, along(x, "N m s/rad", "N s/m"))
        yield Parameter(self.coulomb, words.format("Coulomb"), coulomb, along(x, "N m", "N"))

    def mistaken(self, robot: Robot) -> Iterator[tuple[str, Matrix]]:
        """Without Coulomb's."""
        if not self.coulomb.is_zero:
            yield "coulomb_missing", replace(self, coulomb=robot.ring.zero).force(robot)


Cells = tuple[str, Cell | None, Cell | None]
"""A coordinate with its viscous and its Coulomb friction."""


def read(decoder: Decoder, fields: Fields) -> Iterator[Cells]:
    """The friction of each coordinate; what is wrong with one is reported."""
    faults, node = decoder.faults, fields.get("friction")
    if not isinstance(node, MappingNode):
        if node is not None and not isinstance(node, FaultyNode):
            faults.error(node.span, "friction is a mapping from coordinates to their friction", KEY.help)
        return
    for name, value in by_coordinate(faults, node, decoder.coordinates, KEY.help):
        what = f"the friction of {name}"
        if not isinstance(value, MappingNode):
            yield name, decoder.cell(VISCOUS, read_cell(faults, value, what)), None
            continue
        record = Record(decoder, value, FRICTION, what)
        if all(record.lacks(key) for key in FRICTION.names):
            faults.error(value.span, f"{what} is empty", KEY.help)
        if record["coulomb"]:
            decoder.functions.append(Function("sgn", Symbol(name, 1)))
        yield name, record["viscous"], record["coulomb"]


def build(values: CellValues, given: Cells) -> JointFriction:
    """The friction of a coordinate with exact values; what was reported is 0."""
    name, *cells = given
    viscous, coulomb = (constant(values, cell) or values.ring.zero for cell in cells)
    return JointFriction(values.ring.names.index(name), viscous, coulomb)
