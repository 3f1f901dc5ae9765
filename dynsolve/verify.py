"""The results against an independent computation: recursive Newton-Euler on numbers.

Nothing here is shared with `dynsolve.stages`.  There A_i is a formula of the book
and the torques come from energies; here every row of the table is four elementary
motions (a turn or a slide along an axis), velocities and accelerations are carried
outwards through them, forces and moments inwards by Newton's and Euler's laws.

Luh, Walker, Paul, On-line computational scheme for mechanical manipulators (1980);
Spong, Hutchinson, Vidyasagar, section 7.6; Craig, section 6.5.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from random import Random

from dynsolve.algebra.angles import Angle
from dynsolve.algebra.expr import Expr
from dynsolve.algebra.matrix import Matrix
from dynsolve.errors import VerificationError
from dynsolve.notation.evaluate import compile_trees
from dynsolve.notation.tree import Node
from dynsolve.robot.model import AxesKind, Body, Convention, Joint, Robot

TOLERANCE = 1e-9
"""The largest relative error of a result that counts as rounding."""

METHOD = "recursive Newton-Euler"

_NEGLIGIBLE = 1e-4
"""The part of what moves freely below which a result is rounding."""

_SEED = 20_200_312
_DRAWS = 200

Vector = tuple[float, float, float]
Rotation = tuple[Vector, Vector, Vector]
"""The rows of a 3×3 matrix."""

_ZERO: Vector = (0.0, 0.0, 0.0)
_ONE: Rotation = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))
_AXES: dict[str, int] = {"x": 0, "z": 2}


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
    """Hold printed forms against recursive Newton-Euler at random states.

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


# -- the arm at one state, in numbers --------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class Motion:
    """A turn about, or a slide along, the axis `x` or `z` of the frame it starts from.

    `amount` is its value at the state; `rates` how it changes with each coordinate.
    """

    axis: str
    turns: bool
    amount: float
    rates: tuple[tuple[int, float], ...] = ()


@dataclass(frozen=True, slots=True)
class Mass:
    """A body in numbers: mass, centre and tensor about it, both along the axes of its frame `link`."""

    mass: float
    link: int
    center: Vector
    inertia: Rotation


@dataclass(frozen=True, slots=True)
class Arm:
    """A robot with numbers in it, at a state q, q̇, q̈."""

    rows: tuple[tuple[Motion, ...], ...]
    masses: tuple[Mass, ...]
    base: tuple[Rotation, Vector]
    gravity: Vector
    qd: tuple[float, ...]
    qdd: tuple[float, ...]

    @property
    def n(self) -> int:
        """The number of degrees of freedom."""
        return len(self.qd)


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
    numbers = _Numbers(robot, at_rest)
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
class _Numbers:
    """What the robot's formulas are worth at q = 0."""

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
            return Mass(mass, body.link, center, (_ZERO, _ZERO, _ZERO))
        axes = self.rotation(body.axes.rotation)
        if body.axes.kind is not AxesKind.LINK:
            link = base
            for motion in (motion for row in home[: body.link] for motion in row if motion.turns):
                link = _times(link, _elementary(motion.axis, motion.amount))
            axes = _times(_transposed(link), _times(base, axes))
        inertia = _times(_times(axes, self.rotation(body.inertia)), _transposed(axes))
        if body.about_point is not None:
            inertia = _to_center(inertia, mass, _minus(center, self.vector(body.about_point)))
        return Mass(mass, body.link, center, inertia)


def _to_center(inertia: Rotation, mass: float, offset: Vector) -> Rotation:
    """The parallel-axis theorem: a tensor about a point, moved to the mass centre `offset` away from it."""
    square = _dot(offset, offset)

    def entry(i: int, j: int) -> float:
        return inertia[i][j] - mass * ((square if i == j else 0.0) - offset[i] * offset[j])

    x, y, z = ((entry(i, 0), entry(i, 1), entry(i, 2)) for i in range(3))
    return x, y, z


# -- outwards: how each frame moves ----------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class Frame:
    """Where a frame is and how it moves, along the axes of the world.

    R (3×3) and o are its orientation and origin, w and dw its angular velocity and
    acceleration, v and dv the velocity and acceleration of its origin.
    """

    R: Rotation
    o: Vector
    w: Vector = _ZERO
    dw: Vector = _ZERO
    v: Vector = _ZERO
    dv: Vector = _ZERO

    def after(self, motion: Motion, rate: float, acceleration: float) -> Frame:
        """The frame that an elementary motion ends in."""
        e = _column(self.R, _AXES[motion.axis])
        spin = _scaled(e, rate)
        if motion.turns:
            return Frame(
                _times(self.R, _elementary(motion.axis, motion.amount)),
                self.o,
                _plus(self.w, spin),
                _plus(self.dw, _plus(_scaled(e, acceleration), _cross(self.w, spin))),
                self.v,
                self.dv,
            )
        arm = _scaled(e, motion.amount)
        carried = _plus(_cross(self.dw, arm), _cross(self.w, _cross(self.w, arm)))
        sliding = _plus(_scaled(_cross(self.w, spin), 2.0), _scaled(e, acceleration))
        return Frame(
            self.R,
            _plus(self.o, arm),
            self.w,
            self.dw,
            _plus(self.v, _plus(_cross(self.w, arm), spin)),
            _plus(self.dv, _plus(carried, sliding)),
        )


@dataclass(frozen=True, slots=True)
class _Axis:
    """A joint's axis in the world: its direction and a point on it."""

    motion: Motion
    direction: Vector
    point: Vector


def _outwards(
    arm: Arm, qd: Sequence[float], qdd: Sequence[float], lift: Vector
) -> tuple[list[Frame], list[list[_Axis]]]:
    """Frames 0..m, and the axes of each row; the base accelerates with `lift`."""
    frame = Frame(*arm.base, dv=lift)
    frames, axes = [frame], []
    for row in arm.rows:
        moving = []
        for motion in row:
            if motion.rates:
                moving.append(_Axis(motion, _column(frame.R, 2), frame.o))
            rate = sum(factor * qd[k] for k, factor in motion.rates)
            acceleration = sum(factor * qdd[k] for k, factor in motion.rates)
            frame = frame.after(motion, rate, acceleration)
        frames.append(frame)
        axes.append(moving)
    return frames, axes


# -- inwards: what the joints must hold ------------------------------------------------------------


def inverse_dynamics(arm: Arm, qd: Sequence[float], qdd: Sequence[float], gravity: Vector) -> list[float]:
    """The generalized forces τ, n of them, by recursive Newton-Euler.

    Gravity is an acceleration of the base the other way.
    """
    frames, axes = _outwards(arm, qd, qdd, _scaled(gravity, -1.0))
    tau = [0.0] * arm.n
    force, moment = _ZERO, _ZERO
    for link in range(len(arm.rows), 0, -1):
        for mass in arm.masses:
            if mass.link == link:
                f, m = _wrench(mass, frames[link])
                force, moment = _plus(force, f), _plus(moment, m)
        for axis in reversed(axes[link - 1]):
            held = moment if axis.motion.turns else force
            if axis.motion.turns:
                held = _minus(moment, _cross(axis.point, force))
            for k, rate in axis.motion.rates:
                tau[k] += rate * _dot(axis.direction, held)
    return tau


def _wrench(mass: Mass, frame: Frame) -> tuple[Vector, Vector]:
    """The force that a body takes, and its moment about the origin of the world."""
    arm = _applied(frame.R, mass.center)
    turning = _plus(_cross(frame.dw, arm), _cross(frame.w, _cross(frame.w, arm)))
    force = _scaled(_plus(frame.dv, turning), mass.mass)
    inertia = _times(_times(frame.R, mass.inertia), _transposed(frame.R))
    couple = _plus(_applied(inertia, frame.dw), _cross(frame.w, _applied(inertia, frame.w)))
    return force, _plus(couple, _cross(_plus(frame.o, arm), force))


def energies(arm: Arm) -> tuple[float, float]:
    """(K, P) of the arm at its state."""
    frames, _ = _outwards(arm, arm.qd, arm.qdd, _ZERO)
    kinetic, potential = 0.0, 0.0
    for mass in arm.masses:
        frame = frames[mass.link]
        offset = _applied(frame.R, mass.center)
        v = _plus(frame.v, _cross(frame.w, offset))
        w = _applied(_transposed(frame.R), frame.w)
        kinetic += (mass.mass * _dot(v, v) + _dot(w, _applied(mass.inertia, w))) / 2
        potential -= mass.mass * _dot(arm.gravity, _plus(frame.o, offset))
    return kinetic, potential


# -- the comparison --------------------------------------------------------------------------------


def _errors(arm: Arm, ours: Mapping[str, list[list[float]]]) -> Iterator[tuple[str, float]]:
    """(name, relative error) of each result."""
    yield from _kinematic_errors(arm, ours)
    if "D" not in ours:
        return
    n, still = arm.n, [0.0] * arm.n
    units = [[float(i == k) for i in range(n)] for k in range(n)]
    columns = [inverse_dynamics(arm, still, unit, _ZERO) for unit in units]
    theirs = {
        "D": [[columns[j][i] for j in range(n)] for i in range(n)],
        "Cqd": [[x] for x in inverse_dynamics(arm, arm.qd, still, _ZERO)],
        "g": [[x] for x in inverse_dynamics(arm, still, still, arm.gravity)],
        "tau": [[x] for x in inverse_dynamics(arm, arm.qd, arm.qdd, arm.gravity)],
    }
    size = max(_floor(arm), *(_size(matrix) for matrix in theirs.values())) or 1.0
    mine = {**ours, "Cqd": [[sum(c * x for c, x in zip(row, arm.qd, strict=True))] for row in ours["C"]]}
    for name, matrix in theirs.items():
        if name in mine:
            yield name, _distance(mine[name], matrix) / size
    for name, value in zip(("K", "P"), energies(arm), strict=True):
        if name in ours:
            yield name, _distance([[ours[name]]], [[value]]) / max(size, abs(value))  # type: ignore[list-item]


def _floor(arm: Arm) -> float:
    """The size below which results count as 0: a body that no joint can move leaves only rounding."""
    frames, axes = _outwards(arm, arm.qd, arm.qdd, _ZERO)
    slides = any(not axis.motion.turns for row in axes for axis in row)
    weight = math.sqrt(_dot(arm.gravity, arm.gravity))

    def largest(mass: Mass) -> float:
        frame = frames[mass.link]
        center = _plus(frame.o, _applied(frame.R, mass.center))
        reach = math.sqrt(max(_dot(center, center), *(_dot(frame.o, frame.o) for frame in frames)))
        return max(_size(mass.inertia), mass.mass * max(reach * reach, reach * weight, float(slides)))

    return _NEGLIGIBLE * max(map(largest, arm.masses), default=0.0)


def _kinematic_errors(arm: Arm, ours: Mapping[str, list[list[float]]]) -> Iterator[tuple[str, float]]:
    """Of the last frame: where it is, and how J q̇ says that it moves."""
    if "H" not in ours or "J" not in ours:
        return
    frames, _ = _outwards(arm, arm.qd, arm.qdd, _ZERO)
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


# -- vectors of three ------------------------------------------------------------------------------


def _plus(a: Vector, b: Vector) -> Vector:
    return a[0] + b[0], a[1] + b[1], a[2] + b[2]


def _minus(a: Vector, b: Vector) -> Vector:
    return a[0] - b[0], a[1] - b[1], a[2] - b[2]


def _scaled(a: Vector, factor: float) -> Vector:
    return a[0] * factor, a[1] * factor, a[2] * factor


def _dot(a: Vector, b: Vector) -> float:
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def _cross(a: Vector, b: Vector) -> Vector:
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


def _applied(R: Rotation, a: Vector) -> Vector:
    return _dot(R[0], a), _dot(R[1], a), _dot(R[2], a)


def _column(R: Rotation, j: int) -> Vector:
    return R[0][j], R[1][j], R[2][j]


def _transposed(R: Rotation) -> Rotation:
    return _column(R, 0), _column(R, 1), _column(R, 2)


def _times(A: Rotation, B: Rotation) -> Rotation:
    columns = _transposed(B)
    x, y, z = ((_dot(row, columns[0]), _dot(row, columns[1]), _dot(row, columns[2])) for row in A)
    return x, y, z


def _elementary(axis: str, angle: float) -> Rotation:
    c, s = math.cos(angle), math.sin(angle)
    if axis == "x":
        return (1.0, 0.0, 0.0), (0.0, c, -s), (0.0, s, c)
    return (c, -s, 0.0), (s, c, 0.0), (0.0, 0.0, 1.0)
