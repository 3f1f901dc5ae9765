"""The geometry of a robot at one pose: its frames, and the legs d and a of its rows.

Both conventions come to one chain of points.  Row i has a leg along the axis of
its joint, of length d_i from its foot to its head, and a leg of length a_i across:

    standard   foot_i = o_{i-1},  head_i = foot_i + d_i z_{i-1},  o_i = head_i + a_i x_i
    modified   foot_i = o_{i-1} + a_i x_{i-1},  o_i = head_i = foot_i + d_i z_i
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from dynsolve.draw.drawn_lengths import RobotNumbers
from dynsolve.draw.vectors import (
    NEAR,
    ORIGIN,
    Rotation,
    Vector,
    add,
    along,
    cross,
    distance,
    dot,
    length,
    scale,
    subtract,
    turned,
)
from dynsolve.robot.model import Convention, Joint, JointType, Robot


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
    `offset` is the number of degrees in θ, in radians, beside a coordinate alone.
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
    offset: float = 0.0

    @property
    def turn(self) -> float:
        """θ without the offset, within one positive turn."""
        return (self.angle - self.offset) % (2 * math.pi)

    @property
    def turned(self) -> Vector:
        """The x axis before the joint after a turn by the coordinate alone; `after` is the offset beyond."""
        side = cross(self.axis, self.after)
        return add(scale(self.after, math.cos(self.offset)), scale(side, -math.sin(self.offset)))

    @property
    def center(self) -> Vector:
        """The origin that is on the joint's axis: of the frame before it, else of the one after it."""
        way = subtract(self.start, self.foot)
        beside = subtract(way, scale(self.axis, dot(way, self.axis)))
        return self.start if length(beside) < NEAR else self.end


@dataclass(frozen=True, slots=True)
class MassCenter:
    """A mass centre.

    `from_` is where its one free `symbol` is measured from, if it has just one;
    `rate` is how far the centre moves as that grows by 1, and the distance itself where that is a
    number, without a symbol.  `chosen` are the values that its
    free symbols are drawn with.
    """

    name: str
    center: Vector
    is_point: bool
    link: int
    from_: Vector | None = None
    symbol: str = ""
    rate: float = 1.0
    chosen: tuple[tuple[str, float], ...] = ()


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
    frames, legs = [base_frame(numbers)], []
    for joint in robot.joints:
        leg, frame = _leg(robot, numbers, joint, q, frames[joint.parent])
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
    """Frame 0, rotated as the file says; its displacement does not matter to a picture."""
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
        leg = Leg(joint.type, o, o, head, end, frame.z, frame.x, across[0], theta, row.offset)
        return leg, DrawnFrame(end, turned(across, 0, row.alpha))
    tilted = turned(frame.axes, 0, row.alpha)
    foot = along(o, frame.x, row.a)
    head = along(foot, tilted[2], d)
    axes = turned(tilted, 2, theta)
    leg = Leg(joint.type, o, foot, head, head, tilted[2], frame.x, axes[0], theta, row.offset)
    return leg, DrawnFrame(head, axes)


def is_open(robot: Robot, link: int) -> bool:
    """Whether the table does not say where a link ends: the last of a chain in the modified convention."""
    return robot.convention is Convention.MODIFIED and all(joint.parent != link for joint in robot.joints)


def near_and_far(robot: Robot, bare: Skeleton, link: int) -> tuple[Vector, Vector]:
    """The two ends of a link: its start and o_i, in the modified convention o_i and o_{i+1}."""
    last = len(bare.frames) - 1
    if robot.convention is Convention.STANDARD:
        parent = robot.joints[link - 1].parent if link else 0
        return bare.frames[parent].origin, bare.frames[link].origin
    return bare.frames[link].origin, bare.frames[min(link + 1, last)].origin
