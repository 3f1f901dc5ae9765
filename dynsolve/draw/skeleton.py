"""Where everything of a robot is at one pose: its frames, the legs d and a of its rows, its mass centres.

Both conventions come to one chain of points.  Row i has a leg along the axis of
its joint, of length d_i from its foot to its head, and a leg of length a_i across:

    standard   foot_i = o_{i-1},  head_i = foot_i + d_i z_{i-1},  o_i = head_i + a_i x_i
    modified   foot_i = o_{i-1} + a_i x_{i-1},  o_i = head_i = foot_i + d_i z_i
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

from dynsolve.draw.numbers import RobotNumbers, evaluate
from dynsolve.draw.vectors import (
    ORIGIN,
    Rotation,
    Vector,
    add,
    along,
    applied,
    between,
    distance,
    into,
    length,
    scale,
    subtract,
    turned,
)
from dynsolve.notation.walk import names_in
from dynsolve.robot.model import Body, Convention, Joint, JointType, Robot

NEAR = 1e-6
"""The distance below which two points are one."""


@dataclass(frozen=True, slots=True)
class DrawnFrame:
    """A frame in the world."""

    origin: Vector
    axes: Rotation

    @property
    def x(self) -> Vector:
        """Its x axis."""
        return self.axes[0]

    @property
    def z(self) -> Vector:
        """Its z axis."""
        return self.axes[2]


@dataclass(frozen=True, slots=True)
class Leg:
    """A row of the table in space.

    `axis` is the direction of the joint's axis, `before` and `after` the x axes that
    θ turns from and to, `start` the origin of the frame before it, `end` that of its own.
    """

    type: JointType | None
    start: Vector
    foot: Vector
    head: Vector
    end: Vector
    axis: Vector
    before: Vector
    after: Vector
    angle: float


@dataclass(frozen=True, slots=True)
class MassCenter:
    """A mass centre.

    `from_` is where its one free `symbol` is measured from, if it has just one;
    `rate` is how far the centre moves as that grows by 1.
    """

    name: str
    center: Vector
    is_point: bool
    link: int
    from_: Vector | None = None
    symbol: str = ""
    rate: float = 1.0


@dataclass(frozen=True, slots=True)
class Skeleton:
    """A robot at a pose: frames 0..m, legs 1..m, and the mass centres.

    `path` are the points of the chain from frame 0 to the last, each once.
    """

    frames: tuple[DrawnFrame, ...]
    legs: tuple[Leg, ...]
    path: tuple[Vector, ...]
    masses: tuple[MassCenter, ...] = ()


def skeleton(robot: Robot, numbers: RobotNumbers, q: Sequence[float]) -> Skeleton:
    """The robot with these values of its coordinates, in radians and picture lengths; without masses."""
    frame = base_frame(numbers)
    frames, legs = [frame], []
    for joint in robot.joints:
        leg, frame = _leg(robot, numbers, joint, q, frame)
        legs.append(leg)
        frames.append(frame)
    return Skeleton(tuple(frames), tuple(legs), _path(legs))


def _path(legs: Sequence[Leg]) -> tuple[Vector, ...]:
    points = [ORIGIN]
    for leg in legs:
        for point in (leg.foot, leg.head, leg.end):
            if distance(points[-1], point) > NEAR:
                points.append(point)
    return tuple(points)


def base_frame(numbers: RobotNumbers) -> DrawnFrame:
    """Frame 0, turned as the file says; where it is moved to does not matter to a picture."""
    return DrawnFrame(ORIGIN, numbers.base)


def _leg(
    robot: Robot, numbers: RobotNumbers, joint: Joint, q: Sequence[float], frame: DrawnFrame
) -> tuple[Leg, DrawnFrame]:
    row = numbers.rows[joint.index - 1]
    moved = sum(float(rate) * q[k] for k, rate in joint.rates)
    theta = row.theta + (moved if joint.variable == "theta" else 0.0)
    d = row.d + (moved if joint.variable == "d" else 0.0)
    o = frame.origin
    if robot.convention is Convention.STANDARD:
        across = turned(frame.axes, 2, theta)
        head = along(o, frame.z, d)
        end = along(head, across[0], row.a)
        leg = Leg(joint.type, o, o, head, end, frame.z, frame.x, across[0], theta)
        return leg, DrawnFrame(end, turned(across, 0, row.alpha))
    tilted = turned(frame.axes, 0, row.alpha)
    foot = along(o, frame.x, row.a)
    head = along(foot, tilted[2], d)
    axes = turned(tilted, 2, theta)
    return Leg(joint.type, o, foot, head, head, tilted[2], frame.x, axes[0], theta), DrawnFrame(head, axes)


# -- mass centres ----------------------------------------------------------------------------------

_SHARES = (1.0, 0.7, 1.3)
"""What part of the way to the middle of a link a free symbol stands for, best first."""

_APART = 0.12
_OFF_AXIS = 0.2
"""How far a mass centre lies off its frame where the table gives its link no length."""


def with_masses(robot: Robot, numbers: RobotNumbers, bare: Skeleton) -> Skeleton:
    """The skeleton with its mass centres."""
    masses: list[MassCenter] = []
    for body in robot.bodies:
        free = free_symbols(robot, body)
        tried = (_mass(robot, numbers, bare, body, free, share) for share in _SHARES)
        apart = (mass for mass in tried if _is_apart(mass, masses))
        masses.append(next(apart, None) or _mass(robot, numbers, bare, body, free, _SHARES[0]))
    return replace(bare, masses=tuple(masses))


def _is_apart(mass: MassCenter, others: Sequence[MassCenter]) -> bool:
    return all(distance(mass.center, other.center) > _APART for other in others)


def near_and_far(robot: Robot, bare: Skeleton, link: int) -> tuple[Vector, Vector]:
    """The two ends of a link: o_{i-1} and o_i in the standard convention, o_i and o_{i+1} in the modified."""
    last = len(bare.frames) - 1
    if robot.convention is Convention.STANDARD:
        return bare.frames[max(link - 1, 0)].origin, bare.frames[link].origin
    return bare.frames[link].origin, bare.frames[min(link + 1, last)].origin


def _mass(
    robot: Robot, numbers: RobotNumbers, bare: Skeleton, body: Body, free: Sequence[str], share: float
) -> MassCenter:
    frame = bare.frames[body.link]
    near, far = near_and_far(robot, bare, body.link)
    written = body.center_written
    exact = {"tip": far, "origin": frame.origin, "midpoint": between(near, far, 0.5)}
    if written in exact:
        return MassCenter(body.name, exact[written], body.is_point, body.link)
    ends = (into(frame.axes, subtract(end, frame.origin)) for end in (near, far))
    center, from_, rate = _local_center(robot, numbers, body, free, share, *ends)
    place = add(frame.origin, applied(frame.axes, center))
    start = None if from_ is None else add(frame.origin, applied(frame.axes, from_))
    return MassCenter(body.name, place, body.is_point, body.link, start, free[0] if start else "", rate)


def _local_center(
    robot: Robot,
    numbers: RobotNumbers,
    body: Body,
    free: Sequence[str],
    share: float,
    near: Vector,
    far: Vector,
) -> tuple[Vector, Vector | None, float]:
    """The centre in its frame; where its only free symbol is measured from, and the rate of that."""
    values = dict(numbers.values) | dict.fromkeys(free, 0.0)
    rate = 0.0

    def center(**changed: float) -> Vector:
        state = values | changed
        x, y, z = (evaluate(robot, entry, state) / numbers.unit for entry in body.center.entries)
        return x, y, z

    middle = between(near, far, 0.5)
    try:
        start = center()
        for name in free:
            step = subtract(center(**{name: 1.0}), start)
            twice = subtract(center(**{name: 2.0}), start)
            straight = distance(twice, scale(step, 2.0)) < NEAR
            rate = length(step) * numbers.unit if straight else 0.0
            values[name] = share * _best(step, subtract(middle, start), distance(near, far), len(free))
        found = center()
    except (ValueError, ZeroDivisionError, OverflowError):
        return middle, None, 0.0
    measured = len(free) == 1 and rate > NEAR and distance(start, found) > NEAR
    return found, start if measured else None, rate


def _best(direction: Vector, wanted: Vector, size: float, symbols: int) -> float:
    """How much of a direction leads nearest to what is wanted, and not to nothing."""
    square = length(direction) ** 2
    if square < NEAR:
        return 0.5
    amount = sum(a * b for a, b in zip(direction, wanted, strict=True)) / square
    if abs(amount) * length(direction) > _OFF_AXIS / 2:
        return amount
    if symbols > 1:
        return (_OFF_AXIS if size < NEAR else _OFF_AXIS / 2) / length(direction)
    return (0.3 if size < NEAR else _OFF_AXIS) / length(direction)


def free_symbols(robot: Robot, body: Body) -> list[str]:
    """The parameters of a mass centre that the table does not have."""
    fixed = names_in(*(node for joint in robot.joints for node in joint.written))
    return [name for name in _symbols_of(robot, body) if name not in fixed]


def _symbols_of(robot: Robot, body: Body) -> list[str]:
    """The parameters that move a mass centre."""
    ring = robot.ring
    ones = dict.fromkeys((q.name for q in robot.coordinates), 0.0)
    values = {name: 1.0 + place / 7 for place, name in enumerate(ring.parameters)} | ones
    values["pi"] = 3.0

    def center() -> tuple[float, ...]:
        try:
            return tuple(ring.evaluate(entry, values) for entry in body.center.entries)
        except (ValueError, ZeroDivisionError, OverflowError):
            return ()

    found = []
    usual = center()
    for name in ring.parameters:
        kept, values[name] = values[name], values[name] + 0.5
        if center() != usual:
            found.append(name)
        values[name] = kept
    return found
