"""The results compared with an independent computation: recursive Newton-Euler at random states.

The trees that are printed are evaluated and compared with `dynsolve.derivation.newton_euler`, which
shares no formula with the rest of the derivation.  First the robot is put in numbers (an `Arm`),
then each result is compared: H and J of the last frame, D, C q̇, g, τ, K and P.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from random import Random

from dynsolve.algebra.angles import Angle
from dynsolve.algebra.expr import Expr
from dynsolve.algebra.matrix import Matrix
from dynsolve.derivation.newton_euler import (
    ZERO,
    Arm,
    Mass,
    Motion,
    Rotation,
    Vector,
    applied,
    dot,
    elementary,
    energies,
    inverse_dynamics,
    minus,
    outwards,
    plus,
    times,
    transposed,
)
from dynsolve.errors import VerificationError
from dynsolve.notation.tree import Node
from dynsolve.notation.tree_values import compile_trees
from dynsolve.robot.model import AxesKind, Body, Convention, Joint, Robot

TOLERANCE = 1e-9
"""The largest relative error of a result that counts as rounding."""

METHOD = "recursive Newton-Euler"

_NEGLIGIBLE = 1e-4
"""The part of what moves freely below which a result is rounding."""

_SEED = 20_200_312
_DRAWS = 200


@dataclass(frozen=True, slots=True)
class Verification:
    """How far the results differ from the independent computation.

    `max_relative_error` is the largest over all quantities and states, relative
    to the largest entry of D, C q̇, g and τ at that state.
    """

    method: str
    states: int
    max_relative_error: float


def verify(robot: Robot, results: Mapping[str, Node], states: int = 5) -> Verification:
    """Compare printed forms with recursive Newton-Euler at random states.

    `results` are trees by name: `tau`, `D`, `C`, `g`, `K`, `P`, or, of a robot
    without masses, the last `H` and `J`; those that are absent are passed over.
    Raises VerificationError where one is off by more than `TOLERANCE`.
    """
    names = [name for name in ("H", "J", "D", "C", "g", "tau", "K", "P") if name in results]
    program = compile_trees([results[name] for name in names])
    random = Random(_SEED)  # noqa: S311 - the same states every time are wanted
    worst = 0.0
    for _ in range(states):
        values, arm = _draw(robot, random)
        ours = dict(zip(names, program.run(values), strict=True))
        for name, error in _errors(arm, ours):
            if not error <= TOLERANCE:
                raise VerificationError(
                    f"{name} differs from {METHOD} by {error:.1e} of its size; this is a fault of dynsolve"
                )
            worst = max(worst, error)
    return Verification(METHOD, states, worst)


def _draw(robot: Robot, random: Random) -> tuple[dict[str, float], Arm]:
    """A random state with random parameters for which every root and quotient has a value."""
    for _ in range(_DRAWS):
        values = {name: random.uniform(0.4, 1.6) for name in robot.ring.parameters}
        values["pi"] = math.pi
        for q in robot.coordinates:
            values[q.name] = random.uniform(-1.5, 1.5)
            values[q.velocity] = random.uniform(-1.5, 1.5)
            values[q.acceleration] = random.uniform(-1.5, 1.5)
        try:
            return values, _arm(robot, values)
        except (ValueError, ZeroDivisionError):
            continue
    raise VerificationError(
        "no values of the parameters were found for which every root and quotient is real"
    )


def _arm(robot: Robot, values: Mapping[str, float]) -> Arm:
    at_rest = {**values, **dict.fromkeys((q.name for q in robot.coordinates), 0.0)}
    numbers = _RobotValues(robot, at_rest)
    q = [values[c.name] for c in robot.coordinates]
    rows = tuple(numbers.row(joint, q) for joint in robot.joints)
    home = tuple(numbers.row(joint, [0.0] * robot.n) for joint in robot.joints)
    base = (numbers.rotation(robot.base_rotation), numbers.vector(robot.base_position))
    return Arm(
        rows=rows,
        masses=tuple(numbers.mass(body, home, base[0]) for body in robot.bodies),
        base=base,
        gravity=numbers.vector(robot.gravity),
        qd=tuple(values[c.velocity] for c in robot.coordinates),
        qdd=tuple(values[c.acceleration] for c in robot.coordinates),
    )


@dataclass(frozen=True, slots=True)
class _RobotValues:
    """The values of the robot's formulas at q = 0."""

    robot: Robot
    values: Mapping[str, float]

    def number(self, expr: Expr) -> float:
        return self.robot.ring.evaluate(expr, self.values)

    def vector(self, column: Matrix) -> Vector:
        x, y, z = map(self.number, column.entries)
        return x, y, z

    def rotation(self, matrix: Matrix) -> Rotation:
        x, y, z = (tuple(map(self.number, row)) for row in matrix.rows)
        return (x[0], x[1], x[2]), (y[0], y[1], y[2]), (z[0], z[1], z[2])

    def angle(self, angle: Angle) -> float:
        total = math.radians(float(angle.degrees))
        for atom, rate in angle.terms:
            total += float(rate) * math.prod(self.values[name] ** exponent for name, exponent in atom)
        return total

    def row(self, joint: Joint, q: Sequence[float]) -> tuple[Motion, ...]:
        """The four elementary motions of a row of the table."""
        rates = tuple((k, float(rate)) for k, rate in joint.rates)
        moved = sum(rate * q[k] for k, rate in rates)
        turn = joint.variable == "theta"
        slide = joint.variable == "d"
        along_z = (
            Motion("z", True, self.angle(joint.theta) + moved * turn, rates if turn else ()),
            Motion("z", False, self.number(joint.d) + moved * slide, rates if slide else ()),
        )
        a, alpha = Motion("x", False, self.number(joint.a)), Motion("x", True, self.angle(joint.alpha))
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
            for motion in (motion for row in home[: body.link] for motion in row if motion.turns):
                link = times(link, elementary(motion.axis, motion.amount))
            axes = times(transposed(link), times(base, axes))
        inertia = times(times(axes, self.rotation(body.inertia)), transposed(axes))
        if body.about_point is not None:
            inertia = _to_center(inertia, mass, minus(center, self.vector(body.about_point)))
        return Mass(mass, body.link, center, inertia)


def _to_center(inertia: Rotation, mass: float, offset: Vector) -> Rotation:
    """The parallel-axis theorem: a tensor about a point, moved to the mass centre `offset` away from it."""
    square = dot(offset, offset)

    def entry(i: int, j: int) -> float:
        return inertia[i][j] - mass * ((square if i == j else 0.0) - offset[i] * offset[j])

    x, y, z = ((entry(i, 0), entry(i, 1), entry(i, 2)) for i in range(3))
    return x, y, z


# -- the comparison --------------------------------------------------------------------------------


def _errors(arm: Arm, ours: Mapping[str, list[list[float]]]) -> Iterator[tuple[str, float]]:
    """(name, relative error) of each result."""
    yield from _kinematic_errors(arm, ours)
    if "D" not in ours:
        return
    n, still = arm.n, [0.0] * arm.n
    units = [[float(i == k) for i in range(n)] for k in range(n)]
    columns = [inverse_dynamics(arm, still, unit, ZERO) for unit in units]
    theirs = {
        "D": [[columns[j][i] for j in range(n)] for i in range(n)],
        "Cqd": [[x] for x in inverse_dynamics(arm, arm.qd, still, ZERO)],
        "g": [[x] for x in inverse_dynamics(arm, still, still, arm.gravity)],
        "tau": [[x] for x in inverse_dynamics(arm, arm.qd, arm.qdd, arm.gravity)],
    }
    size = max(_negligible(arm), *(_size(matrix) for matrix in theirs.values())) or 1.0
    mine = {**ours, "Cqd": [[sum(c * x for c, x in zip(row, arm.qd, strict=True))] for row in ours["C"]]}
    for name, matrix in theirs.items():
        if name in mine:
            yield name, _distance(mine[name], matrix) / size
    for name, value in zip(("K", "P"), energies(arm), strict=True):
        if name in ours:
            yield name, _distance([[ours[name]]], [[value]]) / max(size, abs(value))  # type: ignore[list-item]


def _negligible(arm: Arm) -> float:
    """The size below which results count as 0: a body that no joint can move leaves only rounding."""
    frames, axes = outwards(arm, arm.qd, arm.qdd, ZERO)
    slides = any(not axis.motion.turns for row in axes for axis in row)
    weight = math.sqrt(dot(arm.gravity, arm.gravity))

    def largest(mass: Mass) -> float:
        frame = frames[mass.link]
        center = plus(frame.o, applied(frame.R, mass.center))
        reach = math.sqrt(max(dot(center, center), *(dot(frame.o, frame.o) for frame in frames)))
        return max(_size(mass.inertia), mass.mass * max(reach * reach, reach * weight, float(slides)))

    return _NEGLIGIBLE * max(map(largest, arm.masses), default=0.0)


def _kinematic_errors(arm: Arm, ours: Mapping[str, list[list[float]]]) -> Iterator[tuple[str, float]]:
    """The errors of the last frame: of its position, and of its motion J q̇."""
    if "H" not in ours or "J" not in ours:
        return
    frames, _ = outwards(arm, arm.qd, arm.qdd, ZERO)
    last = frames[-1]
    H = [[*row, x] for row, x in zip(last.R, last.o, strict=True)] + [[0.0, 0.0, 0.0, 1.0]]
    yield "H", _distance(ours["H"], H) / max(1.0, _size(H))
    moves = [[x] for x in (*last.v, *last.w)]
    mine = [[sum(c * x for c, x in zip(row, arm.qd, strict=True))] for row in ours["J"]]
    yield "J", _distance(mine, moves) / max(1.0, _size(moves))


def _size(matrix: Sequence[Sequence[float]]) -> float:
    return max((abs(entry) for row in matrix for entry in row), default=0.0)


def _distance(ours: Sequence[Sequence[float]], theirs: Sequence[Sequence[float]]) -> float:
    if [len(row) for row in ours] != [len(row) for row in theirs]:
        return math.inf
    gaps = (
        abs(a - b) for row, other in zip(ours, theirs, strict=True) for a, b in zip(row, other, strict=True)
    )
    return max((gap if gap == gap else math.inf for gap in gaps), default=0.0)
