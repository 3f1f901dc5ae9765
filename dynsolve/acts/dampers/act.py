"""Dampers: b ẋ along a linear form x of the coordinates, the gradient of ½ b ẋ² in the rates."""

from __future__ import annotations

from collections.abc import Iterator

from dynsolve.algebra.matrix import Matrix
from dynsolve.algebra.ring import Expr
from dynsolve.algebra.ring_values import evaluate
from dynsolve.problem.acting import constant, linear
from dynsolve.problem.decoder import Record
from dynsolve.problem.values import CellValues
from dynsolve.robot.actions import Parameter, Values
from dynsolve.robot.dimensions import measured_along
from dynsolve.robot.model import Resisting, Robot
from dynsolve.robot.units import ENERGY, along, dimension, times

TERM = Resisting


class Damper(Resisting, frozen=True):
    """A damper between what a linear form x of the coordinates says: the force b ẋ along x."""

    damping: Expr
    of: Expr

    def force(self, robot: Robot) -> Matrix:
        """b ẋ ∂x/∂q, n×1"""
        rate = robot.ring.time_derivative(self.of)
        slopes = [robot.ring.diff(self.of, k) for k in range(robot.n)]
        return Matrix.column(robot.ring, [self.damping * rate * slope for slope in slopes])

    def force_at(self, robot: Robot, values: Values) -> list[float]:
        """By no derivative: a linear form at the rates is its own rate, and at unit vectors its slopes."""
        names = [q.name for q in robot.coordinates]
        moving = {**values, **{q.name: values[q.velocity] for q in robot.coordinates}}
        force = evaluate(self.damping, values) * evaluate(self.of, moving)
        units = ({**values, **{name: float(name == own) for name in names}} for own in names)
        return [force * evaluate(self.of, unit) for unit in units]

    @property
    def along(self) -> tuple[Expr, Expr]:
        """(x, b)"""
        return self.of, self.damping

    def parameters(self, robot: Robot) -> Iterator[Parameter]:
        """A coefficient, and x, as far as that is an angle or a length."""
        x = measured_along(robot, self.of)
        damping = x and times(times(ENERGY, x, -2), dimension(time=1))
        unit = along(x, "N m s/rad", "N s/m")
        yield Parameter(self.damping, "coefficient|coefficients of a|the damper|dampers", damping, unit)
        yield Parameter(self.of, dimension=x)

    def mistaken(self, robot: Robot) -> Iterator[tuple[str, Matrix]]:
        """Left out."""
        yield "dampers_missing", Matrix.zero(robot.ring, robot.n, 1)


def build(values: CellValues, damper: Record) -> Damper | None:
    """A damper with exact values; None where one was reported."""
    b, x = constant(values, damper["damping"]), linear(values, damper["of"])
    return None if b is None or x is None else Damper(b, x)
