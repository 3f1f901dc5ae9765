"""The unit of every result of a robot: N m, kg m², J, by its role and the type of its coordinates."""

from __future__ import annotations

from collections.abc import Sequence

from dynsolve.quantities.family import Family
from dynsolve.quantities.index import quantities
from dynsolve.robot import units
from dynsolve.robot.dimensions import Dimensions
from dynsolve.robot.model import Coordinate, JointType, Robot
from dynsolve.robot.units import Dimension

Units = Sequence[Sequence[str]]
"""The unit of every entry, row by row; "" for a pure number."""


def of_coordinate(q: Coordinate, dots: int = 0) -> str:
    """rad or m, with each derivative per second."""
    base = "rad" if q.type is JointType.REVOLUTE else "m"
    return base + ("", "/s", "/s^2")[dots]


def of_parameters(robot: Robot) -> dict[str, Dimension]:
    """The dimension of every parameter, concluded from where it stands; unknown ones are left out."""
    known = Dimensions(robot.ring, robot)
    found = {
        g.name: known.of_generator(g)
        for g in robot.ring.generators
        if g.kind == "symbol" and not g.dots and g.name in robot.parameters
    }
    return {name: dim for name, dim in found.items() if dim is not None}


def of_result(robot: Robot, name: str) -> str | Units:
    """The unit of a result by its name: of a scalar, or of each entry of a matrix.

    Empty for pure numbers, and for what holds lengths beside them.
    A torque is in N m, an energy in J, though both are kg m²/s².
    """
    known = quantities(robot)
    quantity = known.result(name)
    if quantity is None or quantity.family.dimension is None:
        return ""
    if quantity.shape is None:
        return _unit(quantity.family, known.dimension(quantity))
    rows, columns = quantity.shape
    entries = [
        [_unit(quantity.family, known.dimension(quantity, i, j)) for j in range(columns)] for i in range(rows)
    ]
    return entries if any(map(any, entries)) else ""


def _unit(family: Family, found: Dimension | None) -> str:
    if found is None:
        return ""
    return family.unit if family.unit and found == family.dimension else units.si(found)
