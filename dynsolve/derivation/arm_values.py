"""A robot put in numbers: its `Arm` at a state, as the independent check wants it."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from functools import partial
from math import exp
from operator import itemgetter
from typing import TypeVar

from msgspec import Struct

from dynsolve.algebra.matrix import Matrix
from dynsolve.algebra.ring import Expr, Ring
from dynsolve.algebra.ring_values import evaluate
from dynsolve.algebra.sampling import samples
from dynsolve.derivation.newton_euler import (
    ZERO,
    Arm,
    Mass,
    Motion,
    Rotation,
    Rotor,
    Vector,
    dot,
    elementary,
    minus,
    times,
    transposed,
)
from dynsolve.errors import NoStatesError
from dynsolve.robot import model
from dynsolve.robot.model import AxesKind, Body, Convention, Joint, Robot

_MISSES = 200
"""So many samples after each other may have no value."""

_REPAIRED, _STEPS = 100, 40
"""After so many misses parameters are moved to where what is assumed holds, in so many steps."""

_BEYOND, _FARTHEST, _DIFFERENCE = 1.5, 2.0, 1e-6
"""Of each step in the logarithms: past where an inequality begins to hold, at most, and for slopes."""

Made = TypeVar("Made")


def arms(robot: Robot) -> Iterator[tuple[dict[str, float], Arm]]:
    """States, with parameters for which every root and quotient has a value, and the arm there."""
    return states_with(robot.ring, partial(arm_at, robot))


def states_with(
    ring: Ring, at: Callable[[Mapping[str, float]], Made], signed: Iterable[str] = (), first: int = 0
) -> Iterator[tuple[dict[str, float], Made]]:
    """The samples where `at` has a value, without end, and what it makes of them."""
    missed = 0
    for values in samples(ring, signed, first):
        try:
            made = at(values)
        except (ValueError, ZeroDivisionError):
            missed += 1
            if missed == _MISSES:
                break
            continue
        missed = 0
        yield values, made
    raise NoStatesError("no values of the parameters were found for which every root and quotient is real")


def assumed_states(robot: Robot) -> Iterator[dict[str, float]]:
    """Samples that satisfy what is assumed of the parameters: k > 100 m is met by none that are near 1."""
    bounds, missed = [bound.value for bound in robot.questions.model.assumed], 0
    for values in samples(robot.ring):
        found = values if missed < _REPAIRED else _moved(values, robot.ring.parameters, bounds)
        if all(evaluate(bound, found) > 0 for bound in bounds):
            yield found
            continue
        missed += 1
        if missed == _MISSES:
            raise NoStatesError("no positive values of the parameters are known that satisfy `assume`")


def _moved(values: dict[str, float], names: Sequence[str], bounds: Sequence[Expr]) -> dict[str, float]:
    """Parameters moved to where all bounds are positive, by steps of Newton in their logarithms."""
    for _ in range(_STEPS):
        lowest, value = min(((bound, evaluate(bound, values)) for bound in bounds), key=itemgetter(1))
        if value > 0:
            break
        farther = (evaluate(lowest, {**values, name: values[name] * (1 + _DIFFERENCE)}) for name in names)
        slopes = [(one - value) / _DIFFERENCE for one in farther]
        steepness = sum(slope * slope for slope in slopes)
        if not steepness:
            break
        for name, slope in zip(names, slopes, strict=True):
            step = -_BEYOND * value * slope / steepness
            values = {**values, name: values[name] * exp(max(-_FARTHEST, min(_FARTHEST, step)))}
    return values


def arm_at(robot: Robot, values: Mapping[str, float]) -> Arm:
    """The robot at a state: `values` are those of its parameters, coordinates and their derivatives."""
    at_rest = {**values, **dict.fromkeys((q.name for q in robot.coordinates), 0.0)}
    numbers = RobotValues(robot, at_rest)
    q = [values[c.name] for c in robot.coordinates]
    rows = tuple(numbers.row(joint, q) for joint in robot.joints)
    home = tuple(numbers.row(joint, [0.0] * robot.n) for joint in robot.joints)
    base = (numbers.rotation(robot.base_rotation), numbers.vector(robot.base_position))
    return Arm(
        starts=tuple(joint.parent for joint in robot.joints) if robot.is_tree else (),
        rows=rows,
        masses=tuple(numbers.mass(body, home, base[0]) for body in robot.bodies),
        base=base,
        gravity=numbers.vector(robot.gravity),
        qd=tuple(values[c.velocity] for c in robot.coordinates),
        qdd=tuple(values[c.acceleration] for c in robot.coordinates),
        rotors=tuple(map(numbers.rotor, robot.actions.rotors)),
    )


class RobotValues(Struct, frozen=True):
    """The values of the robot's formulas at q = 0."""

    robot: Robot
    values: Mapping[str, float]

    def number(self, expr: Expr) -> float:
        """The value of an expression."""
        return evaluate(expr, self.values)

    def vector(self, column: Matrix) -> Vector:
        """The value of a column of three."""
        x, y, z = map(self.number, column.entries)
        return x, y, z

    def rotation(self, matrix: Matrix) -> Rotation:
        """The value of a 3×3 matrix."""
        x, y, z = (tuple(map(self.number, row)) for row in matrix.rows)
        return (x[0], x[1], x[2]), (y[0], y[1], y[2]), (z[0], z[1], z[2])

    def row(self, joint: Joint, q: Sequence[float]) -> tuple[Motion, ...]:
        """The four elementary motions of a row of the table."""
        rates = tuple((k, float(rate)) for k, rate in joint.rates)
        moved = sum(rate * q[k] for k, rate in rates)
        turn = joint.variable == "theta"
        slide = joint.variable == "d"
        along_z = (
            Motion("z", True, joint.theta.radians(self.values) + moved * turn, rates if turn else ()),
            Motion("z", False, self.number(joint.d) + moved * slide, rates if slide else ()),
        )
        a = Motion("x", False, self.number(joint.a))
        alpha = Motion("x", True, joint.alpha.radians(self.values))
        if self.robot.convention is Convention.STANDARD:
            return (*along_z, a, alpha)
        return (alpha, a, *along_z)

    def mass(self, body: Body, home: Sequence[Sequence[Motion]], base: Rotation) -> Mass:
        """The body with its tensor turned into its link and moved to its mass centre."""
        mass, center = self.number(body.mass), self.vector(body.center)
        if body.inertia is None:
            return Mass(mass, body.link, center, (ZERO, ZERO, ZERO))
        axes = self.rotation(body.axes.rotation)
        if body.axes.kind is not AxesKind.LINK:
            link = base
            rows = (home[joint.index - 1] for joint in self.robot.path(body.link))
            for motion in (motion for row in rows for motion in row if motion.turns):
                link = times(link, elementary(motion.axis, motion.amount))
            axes = times(transposed(link), times(base, axes))
        inertia = times(times(axes, self.rotation(body.inertia)), transposed(axes))
        if body.about_point is not None:
            inertia = _to_center(inertia, mass, minus(center, self.vector(body.about_point)))
        return Mass(mass, body.link, center, inertia)

    def rotor(self, one: model.Rotor) -> Rotor:
        """The rotor in numbers."""
        return Rotor(self.number(one.inertia), one.carrier, one.axis, one.turns, self.number(one.ratio))


def _to_center(inertia: Rotation, mass: float, offset: Vector) -> Rotation:
    """The parallel-axis theorem: a tensor about a point, moved to the mass centre `offset` away from it."""
    square = dot(offset, offset)

    def entry(i: int, j: int) -> float:
        return inertia[i][j] - mass * ((square if i == j else 0.0) - offset[i] * offset[j])

    x, y, z = ((entry(i, 0), entry(i, 1), entry(i, 2)) for i in range(3))
    return x, y, z
