"""Recursive Newton-Euler on numbers, sharing no formula with `dynsolve.derivation`.

There A_i is a formula of the book and the torques come from energies; here a row of
the table is elementary motions (a turn or a slide along an axis), velocities and
accelerations are carried outwards through them, forces and moments inwards by
Newton's and Euler's laws.  Even the vectors are its own: it imports nothing of dynsolve, so
that no fault of the algebra can be in both.

Luh, Walker, Paul, On-line computational scheme for mechanical manipulators (1980);
Spong, Hutchinson, Vidyasagar, section 7.6; Craig, section 6.5.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

from msgspec import Struct

Vector = tuple[float, float, float]
Rotation = tuple[Vector, Vector, Vector]
"""The rows of a 3×3 matrix."""

ZERO: Vector = (0.0, 0.0, 0.0)
IDENTITY: Rotation = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))
_AXES: dict[str, int] = {"x": 0, "z": 2}


class Motion(Struct, frozen=True):
    """A turn about, or a slide along, the axis `x` or `z` of the frame it starts from.

    `amount` is its value at the state; `rates` how it changes with each coordinate.
    """

    axis: str
    turns: bool
    amount: float
    rates: tuple[tuple[int, float], ...] = ()


class Mass(Struct, frozen=True):
    """A body in numbers: mass, centre and tensor about it, both along the axes of its frame `link`."""

    mass: float
    link: int
    center: Vector
    inertia: Rotation


class Rotor(Struct, frozen=True):
    """A rotor in numbers: it spins with `ratio` times the rate of coordinate `turns`, counted from 0.

    Its axis is x, y or z (0, 1 or 2) of frame `link`, which carries it.
    """

    inertia: float
    link: int
    axis: int
    turns: int
    ratio: float


class Arm(Struct, frozen=True):
    """A robot with numbers in it, at a state q, q̇, q̈; `starts` are the frames that its rows start from."""

    rows: tuple[tuple[Motion, ...], ...]
    masses: tuple[Mass, ...]
    base: tuple[Rotation, Vector]
    gravity: Vector
    qd: tuple[float, ...]
    qdd: tuple[float, ...]
    rotors: tuple[Rotor, ...] = ()
    starts: tuple[int, ...] = ()

    def start(self, row: int) -> int:
        """The frame that a row, counted from 1, starts from: the one before where nothing else is said."""
        return self.starts[row - 1] if self.starts else row - 1

    @property
    def n(self) -> int:
        """The number of degrees of freedom."""
        return len(self.qd)


# -- outwards: how each frame moves ----------------------------------------------------------------


class MovingFrame(Struct, frozen=True):
    """Where a frame is and how it moves, along the axes of the world.

    R (3×3) and o are its orientation and origin, w and dw its angular velocity and
    acceleration, v and dv the velocity and acceleration of its origin.
    """

    R: Rotation
    o: Vector
    w: Vector = ZERO
    dw: Vector = ZERO
    v: Vector = ZERO
    dv: Vector = ZERO

    def after(self, motion: Motion, rate: float, acceleration: float) -> MovingFrame:
        """The frame that an elementary motion ends in."""
        e = column(self.R, _AXES[motion.axis])
        spin = scaled(e, rate)
        if motion.turns:
            return MovingFrame(
                times(self.R, elementary(motion.axis, motion.amount)),
                self.o,
                plus(self.w, spin),
                plus(self.dw, plus(scaled(e, acceleration), cross(self.w, spin))),
                self.v,
                self.dv,
            )
        arm = scaled(e, motion.amount)
        carried = plus(cross(self.dw, arm), cross(self.w, cross(self.w, arm)))
        sliding = plus(scaled(cross(self.w, spin), 2.0), scaled(e, acceleration))
        return MovingFrame(
            self.R,
            plus(self.o, arm),
            self.w,
            self.dw,
            plus(self.v, plus(cross(self.w, arm), spin)),
            plus(self.dv, plus(carried, sliding)),
        )


class _Axis(Struct, frozen=True):
    """A joint's axis in the world: its direction and a point on it."""

    motion: Motion
    direction: Vector
    point: Vector


def outwards(
    arm: Arm, qd: Sequence[float], qdd: Sequence[float], lift: Vector
) -> tuple[list[MovingFrame], list[list[_Axis]]]:
    """Frames 0..m, and the axes of each row; the base accelerates with `lift`."""
    frames, axes = [MovingFrame(*arm.base, dv=lift)], []
    for number, row in enumerate(arm.rows, 1):
        frame, moving = frames[arm.start(number)], []
        for motion in row:
            if motion.rates:
                moving.append(_Axis(motion, column(frame.R, 2), frame.o))
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
    frames, axes = outwards(arm, qd, qdd, scaled(gravity, -1.0))
    tau = [0.0] * arm.n
    for rotor in arm.rotors:
        tau[rotor.turns] += rotor.ratio * _spun(rotor, frames[rotor.link], qd, qdd)[1]
    for moving, (force, moment) in zip(axes, held_by_joints(arm, frames, qd, qdd), strict=True):
        for axis in moving:
            load = moment if axis.motion.turns else force
            if axis.motion.turns:
                load = minus(moment, cross(axis.point, force))
            for k, rate in axis.motion.rates:
                tau[k] += rate * dot(axis.direction, load)
    return tau


def held_by_joints(
    arm: Arm, frames: Sequence[MovingFrame], qd: Sequence[float], qdd: Sequence[float]
) -> list[tuple[Vector, Vector]]:
    """The force and the moment about the origin of the world that each link takes from the one before.

    The rates q̇ and q̈ are those that the frames move with: a rotor spins with them on its link.
    """
    held = [(ZERO, ZERO)] * (len(arm.rows) + 1)
    for mass in arm.masses:
        force, moment = held[mass.link]
        f, m = _wrench(mass, frames[mass.link])
        held[mass.link] = plus(force, f), plus(moment, m)
    for rotor in arm.rotors:
        force, moment = held[rotor.link]
        held[rotor.link] = force, plus(moment, _spun(rotor, frames[rotor.link], qd, qdd)[0])
    for link in range(len(arm.rows), 0, -1):
        force, moment = held[arm.start(link)]
        held[arm.start(link)] = plus(force, held[link][0]), plus(moment, held[link][1])
    return held[1:]


def _wrench(mass: Mass, frame: MovingFrame) -> tuple[Vector, Vector]:
    """The force that a body takes, and its moment about the origin of the world."""
    arm = applied(frame.R, mass.center)
    turning = plus(cross(frame.dw, arm), cross(frame.w, cross(frame.w, arm)))
    force = scaled(plus(frame.dv, turning), mass.mass)
    inertia = times(times(frame.R, mass.inertia), transposed(frame.R))
    couple = plus(applied(inertia, frame.dw), cross(frame.w, applied(inertia, frame.w)))
    return force, plus(couple, cross(plus(frame.o, arm), force))


def _spun(
    rotor: Rotor, frame: MovingFrame, qd: Sequence[float], qdd: Sequence[float]
) -> tuple[Vector, float]:
    """The moment that a rotor takes from its link, and the moment about its axis, which its drive gives.

    Its angular momentum h = I (spin + a·ω) a is along its axis a, which turns with the link: ḣ is
    I (spin' + a·ω̇) a, and across it I (spin + a·ω) ω × a.
    """
    a = column(frame.R, rotor.axis)
    drive = rotor.inertia * (rotor.ratio * qdd[rotor.turns] + dot(a, frame.dw))
    momentum = rotor.inertia * (rotor.ratio * qd[rotor.turns] + dot(a, frame.w))
    return plus(scaled(a, drive), scaled(cross(frame.w, a), momentum)), drive


def energies(arm: Arm) -> tuple[float, float]:
    """(K, P) of the arm at its state."""
    frames, _ = outwards(arm, arm.qd, arm.qdd, ZERO)
    kinetic, potential = 0.0, 0.0
    for mass in arm.masses:
        frame = frames[mass.link]
        offset = applied(frame.R, mass.center)
        v = plus(frame.v, cross(frame.w, offset))
        w = applied(transposed(frame.R), frame.w)
        kinetic += (mass.mass * dot(v, v) + dot(w, applied(mass.inertia, w))) / 2
        potential -= mass.mass * dot(arm.gravity, plus(frame.o, offset))
    for rotor in arm.rotors:
        frame = frames[rotor.link]
        turned = rotor.ratio * arm.qd[rotor.turns] + dot(column(frame.R, rotor.axis), frame.w)
        kinetic += rotor.inertia * turned * turned / 2
    return kinetic, potential


# -- vectors of three ------------------------------------------------------------------------------


def plus(a: Vector, b: Vector) -> Vector:
    """a + b"""
    return a[0] + b[0], a[1] + b[1], a[2] + b[2]


def minus(a: Vector, b: Vector) -> Vector:
    """a - b"""
    return a[0] - b[0], a[1] - b[1], a[2] - b[2]


def scaled(a: Vector, factor: float) -> Vector:
    """factor · a"""
    return a[0] * factor, a[1] * factor, a[2] * factor


def dot(a: Vector, b: Vector) -> float:
    """aᵀ b"""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a: Vector, b: Vector) -> Vector:
    """a × b"""
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


def applied(R: Rotation, a: Vector) -> Vector:
    """R a"""
    return dot(R[0], a), dot(R[1], a), dot(R[2], a)


def column(R: Rotation, j: int) -> Vector:
    """Column j, from 0."""
    return R[0][j], R[1][j], R[2][j]


def transposed(R: Rotation) -> Rotation:
    """Rᵀ"""
    return column(R, 0), column(R, 1), column(R, 2)


def times(A: Rotation, B: Rotation) -> Rotation:
    """A B"""
    columns = transposed(B)
    x, y, z = ((dot(row, columns[0]), dot(row, columns[1]), dot(row, columns[2])) for row in A)
    return x, y, z


def elementary(axis: str, angle: float) -> Rotation:
    """The rotation by an angle about the axis `x` or `z`."""
    c, s = math.cos(angle), math.sin(angle)
    if axis == "x":
        return (1.0, 0.0, 0.0), (0.0, c, -s), (0.0, s, c)
    return (c, -s, 0.0), (s, c, 0.0), (0.0, 0.0, 1.0)
