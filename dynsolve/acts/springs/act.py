"""Springs: ½ k (x - rest)², x linear in the coordinates; or by an energy that is given."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from dynsolve.acts.springs import KEY
from dynsolve.algebra.ring import Expr
from dynsolve.algebra.ring_values import evaluate
from dynsolve.problem.acting import constant, linear
from dynsolve.problem.cells import Cell
from dynsolve.problem.decoder import Decoder, Record
from dynsolve.problem.kinds import Fields
from dynsolve.problem.values import CellValues
from dynsolve.robot.actions import Parameter, Values
from dynsolve.robot.dimensions import measured_along
from dynsolve.robot.model import Robot, Stored
from dynsolve.robot.units import ENERGY, along, times

TERM = Stored

HIGHEST_DEGREE = 8
"""The highest degree of an energy in coordinates, sines and cosines."""


class Spring(Stored, frozen=True):
    """A linear spring: ½ k (x - rest)², x a linear form of the coordinates."""

    stiffness: Expr
    of: Expr
    rest: Expr

    @property
    def energy(self) -> Expr:
        """½ k (x - rest)²"""
        return self.stiffness * (self.of - self.rest) ** 2 / 2

    def energy_at(self, values: Values) -> float:
        """½ k (x - rest)², each in numbers first."""
        k, x, rest = (evaluate(expr, values) for expr in (self.stiffness, self.of, self.rest))
        return k * (x - rest) ** 2 / 2

    @property
    def along(self) -> tuple[Expr, Expr]:
        """(x, k)"""
        return self.of, self.stiffness

    @property
    def differences(self) -> tuple[tuple[Expr, Expr], ...]:
        """x - rest"""
        return ((self.of, self.rest),)

    def parameters(self, robot: Robot) -> Iterator[Parameter]:
        """A stiffness, where the spring is relaxed, and x, as far as that is an angle or a length."""
        x = measured_along(robot, self.of)
        k, words = x and times(ENERGY, x, -2), "stiffness|stiffnesses of a|the spring|springs"
        yield Parameter(self.stiffness, words, k, along(x, "N m/rad", "N/m"))
        yield Parameter(self.rest, "rest position|positions of a|the spring|springs", x, along(x, "rad", "m"))
        yield Parameter(self.of, dimension=x)

    def mistaken(self, robot: Robot) -> Iterator[tuple[str, Expr]]:
        """Without the ½; with what may stand in the place of the square of the stretch."""
        k, x, rest = self.stiffness, self.of, self.rest
        yield "spring_half", self.energy * 2
        yield "spring_rest", k * x**2 / 2
        yield "spring_square", k * (x**2 - rest**2) / 2
        yield "spring_rest_sign", k * (x + rest) ** 2 / 2


class GivenEnergy(Stored, frozen=True):
    """A spring by its energy, a function of the coordinates."""

    given: Expr

    @property
    def energy(self) -> Expr:
        """As it is given."""
        return self.given

    def energy_at(self, values: Values) -> float:
        """As it is given."""
        return evaluate(self.given, values)

    def parameters(self, robot: Robot) -> Iterator[Parameter]:
        """What stands in the energy."""
        yield Parameter(self.given, "parameter|parameters of a|the spring|springs", ENERGY, is_whole=False)


# -- from a file -----------------------------------------------------------------------------------


def read(decoder: Decoder, fields: Fields) -> Iterable[Record]:
    """The springs of a file; what is wrong with one is reported."""
    for spring in decoder.entries(fields, KEY):
        law = [key for key in ("stiffness", "of", "rest") if key in spring]
        if "energy" in spring and law:
            message = f"{spring.what} has an `energy` and a `{law[0]}`"
            spring.faults.error(spring.key_span(law[0]), message, "give one of them: " + KEY.help)
        elif spring.lacks("energy"):
            for key in ("stiffness", "of"):
                if spring.lacks(key):
                    spring.faults.error(spring.span, f"{spring.what} has no `{key}`", KEY.help)
        yield spring


def build(values: CellValues, spring: Record) -> Stored | None:
    """A spring with exact values; None where one was reported."""
    if cell := spring["energy"]:
        energy = values.expr(cell)
        return GivenEnergy(energy) if energy is not None and _is_admitted(values, cell, energy) else None
    stiffness, x = constant(values, spring["stiffness"]), linear(values, spring["of"])
    rest = values.expr(spring["rest"]) if spring["rest"] else values.ring.zero
    return None if stiffness is None or x is None or rest is None else Spring(stiffness, x, rest)


def _is_admitted(values: CellValues, cell: Cell, energy: Expr) -> bool:
    """Whether an energy holds coordinates, of no higher degree than is read; else it is reported."""
    ring = values.ring
    if not ring.depends_on_coordinates(energy):
        values.faults.error(cell.span, f"{cell.what} contains no coordinate", "it is a function of them")
        return False
    moving = [g.index for g in ring.generators if ring.depends_on_coordinates(ring.generator(g.index))]
    degree = max(sum(exponents[i] for i in moving) for exponents in energy.poly.monoms())
    if degree > HIGHEST_DEGREE:
        message = f"{cell.what} is of degree {degree}; at most {HIGHEST_DEGREE} is read"
        values.faults.error(cell.span, message, "write an energy of a lower degree")
        return False
    return True
