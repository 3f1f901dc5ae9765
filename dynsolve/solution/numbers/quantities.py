"""What every result of a robot is measured in: N m, kg m², J, by its role and the type of its coordinates."""

from __future__ import annotations

from collections.abc import Sequence

from dynsolve.robot import units
from dynsolve.robot.dimensions import Dimensions
from dynsolve.robot.model import Coordinate, JointType, Robot
from dynsolve.robot.units import LENGTH, MASS, NONE, Dimension, dimension, times

PER_SECOND = dimension(time=-1)

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
    """The unit of a result by its name in an answer file: of a scalar, or of each entry of a matrix.

    A torque is in N m, an energy in J, though both are kg m²/s².
    """
    stem = name.rstrip("0123456789")
    if name == "L" or _is_energy(robot, name):
        return "J"
    per_coordinate = {"tau": _force, "dLdq": _force, "ddt": _force, "dLdqd": _momentum}
    if stem in per_coordinate and stem != name:
        return per_coordinate[stem](robot.coordinates[int(name.removeprefix(stem)) - 1])
    if name in ("tau", "g", "g_direct", "Cqd"):
        return [[_force(q)] for q in robot.coordinates]
    if name in ("D", "D_direct", "C"):
        rate = PER_SECOND if name == "C" else NONE
        sizes = [_generalized(q) for q in robot.coordinates]
        return [[units.si(times(times(MASS, times(p, q)), rate)) for q in sizes] for p in sizes]
    return _of_geometry(robot, name)


def _of_geometry(robot: Robot, name: str) -> str | Units:
    linear = ["m" if q.type is JointType.REVOLUTE else "" for q in robot.coordinates]
    angular = ["" for _ in robot.coordinates]
    if name.startswith("Jv"):
        return [linear] * 3
    if name.startswith("Jw"):
        return [angular] * 3
    if name == "J":
        return [linear] * 3 + [angular] * 3
    if name.startswith("I"):
        return [["kg m^2"] * 3] * 3
    if name[0] in "AH":
        return [["", "", "", "m"]] * 3 + [["", "", "", ""]]
    column = {"rc": "m", "v": "m/s", "w": "rad/s"}
    for stem, unit in column.items():
        if name.startswith(stem):
            return [[unit]] * 3
    return ""


def _is_energy(robot: Robot, name: str) -> bool:
    bodies = ("", *(body.name for body in robot.bodies))
    return any(name == stem + body for stem in ("P", "K", "Kv", "Kw") for body in bodies)


def _generalized(q: Coordinate) -> Dimension:
    """The dimension of ∂x/∂q for a length x, so that m (∂x/∂q)² is an entry of D."""
    return LENGTH if q.type is JointType.REVOLUTE else NONE


def _force(q: Coordinate) -> str:
    return "N m" if q.type is JointType.REVOLUTE else "N"


def _momentum(q: Coordinate) -> str:
    return "kg m^2/s" if q.type is JointType.REVOLUTE else "kg m/s"
