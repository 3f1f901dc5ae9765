"""Motors: the rotors that turn the coordinates, through their gears."""

from __future__ import annotations

from collections.abc import Iterator

from dynsolve.acts.motors import KEY
from dynsolve.problem.acting import constant
from dynsolve.problem.decoder import Decoder, Record
from dynsolve.problem.kinds import Fields
from dynsolve.problem.values import CellValues
from dynsolve.robot.actions import Parameter
from dynsolve.robot.model import Robot, Rotor
from dynsolve.robot.shapes import AXES
from dynsolve.robot.units import INERTIA, NONE, times

TERM = Rotor


class Motor(Rotor, frozen=True):
    """The rotor of a motor that turns a coordinate through a gear."""

    def parameters(self, robot: Robot) -> Iterator[Parameter]:
        """A moment of inertia, and the ratio of a gear; without one the rotor has the coordinate's own."""
        x = robot.coordinates[self.turns].dimension
        geared = self.ratio != robot.ring.one
        inertia, ratio = (INERTIA, times(NONE, x, -1)) if geared else (times(INERTIA, x, -2), NONE)
        yield Parameter(self.inertia, "moment|moments of inertia of a|the rotor|rotors", inertia)
        yield Parameter(self.ratio, "ratio|ratios of a|the gear|gears", ratio)


def read(decoder: Decoder, fields: Fields) -> Iterator[Record]:
    """The motors of a file; what is wrong with one is reported."""
    for motor in decoder.entries(fields, KEY):
        if "carrier" in motor and not decoder.rows:
            message = f"{motor.what} has a `carrier`, and there is no table whose links could carry it"
            motor.faults.error(motor.key_span("carrier"), message, "leave it out, or give a `dh` table")
        elif "axis" in motor and "carrier" not in motor:
            message = f"`axis` of {motor.what} is that of a carrier, and there is none"
            motor.faults.error(motor.key_span("axis"), message, "add carrier: 1, or leave `axis` out")
        yield motor


def build(values: CellValues, motor: Record) -> Motor | None:
    """A motor with exact values; None where one was reported."""
    names = values.ring.names
    inertia = constant(values, motor["inertia"])
    ratio = values.expr(motor["ratio"]) if motor["ratio"] else values.ring.one
    if inertia is None or ratio is None or motor["turns"] not in names:
        return None
    if ratio.is_zero:
        help = "write ratio: kr1, or leave it out"
        values.faults.error(motor["ratio"].span, "the ratio of a gear is not 0", help)
    axis = AXES.index(motor["axis"] or "z")
    return Motor(names.index(motor["turns"]), inertia, ratio, motor["carrier"] or 0, axis)
