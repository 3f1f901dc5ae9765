"""How a robot stands in the world: which way is up, and whether it moves in a plane."""

from __future__ import annotations

from msgspec import Struct

from dynsolve.draw.skeleton import DrawnFrame, RobotNumbers, Skeleton, base_frame, finite, skeleton
from dynsolve.draw.vectors import (
    IDENTITY,
    ORIGIN,
    Vector,
    any_normal,
    cross,
    dot,
    length,
    scale,
    subtract,
    unit,
)
from dynsolve.robot.model import JointType, Robot

_FLAT = 1e-6
_PROBES = (0.3, 1.1, -0.7)


class Orientation(Struct, frozen=True):
    """Which way is up, and what the robot moves in.

    `gravity` is a unit vector, None without gravity; `ahead` a level direction of the
    base; `normal` that of the plane of motion, where there is one, upright or level.
    """

    up: Vector
    ahead: Vector
    gravity: Vector | None
    normal: Vector | None


def orientation(robot: Robot, numbers: RobotNumbers, drawn: bool = False) -> Orientation:
    """Which way is up for a robot, and the plane that it moves in.

    It is seen from a side of frame 0; a robot that is `drawn` from a side of the drawing's axes,
    wherever the table has put frame 0: from behind it would be mirrored.
    """
    base = DrawnFrame(ORIGIN, IDENTITY) if drawn else base_frame(numbers)
    gravity = _gravity(robot, numbers)
    normal = _normal(robot, numbers, base)
    if normal is not None and not _leans(normal, gravity):
        return Orientation(_up_in_plane(normal, base, gravity), base.x, gravity, normal)
    up = scale(gravity, -1.0) if gravity else base.z
    ahead = base.x if abs(dot(base.x, up)) < 0.9 else base.z
    return Orientation(up, ahead, gravity, None)


def _leans(normal: Vector, gravity: Vector | None) -> bool:
    """Whether a plane is neither upright nor level: seen from its front, it would hide how far it leans."""
    return gravity is not None and _FLAT < abs(dot(normal, gravity)) < 1 - _FLAT


def _gravity(robot: Robot, numbers: RobotNumbers) -> Vector | None:
    try:
        x, y, z = (finite(entry, numbers.values) for entry in robot.gravity.entries)
    except (ValueError, ZeroDivisionError, OverflowError):
        return None
    return unit((x, y, z)) if length((x, y, z)) > _FLAT else None


def _up_in_plane(normal: Vector, base: DrawnFrame, gravity: Vector | None) -> Vector:
    """The direction of the plane that is drawn upwards: against gravity, else y_0, else z_0."""
    for wanted in ([scale(gravity, -1.0)] if gravity else []) + [base.axes[1], base.z]:
        level = subtract(wanted, scale(normal, dot(wanted, normal)))
        if length(level) > 0.1:
            return unit(level)
    return any_normal(normal)


def _normal(robot: Robot, numbers: RobotNumbers, base: DrawnFrame) -> Vector | None:
    """The normal of the plane that the robot moves in, towards the viewer; None in space."""
    poses = [skeleton(robot, numbers, _probe(robot.n, start)) for start in _PROBES]
    candidate = _candidate(poses[0])
    if candidate is None or not all(_moves_across(pose, candidate) for pose in poses):
        return None
    for direction in (base.z, base.axes[1], base.x):
        if abs(dot(direction, candidate)) > 0.5:
            toward = dot(direction, candidate) * (-1.0 if direction is base.axes[1] else 1.0)
            return candidate if toward > 0 else scale(candidate, -1.0)
    return candidate


def _probe(n: int, start: float) -> list[float]:
    return [start + 0.37 * k for k in range(n)]


def _candidate(pose: Skeleton) -> Vector | None:
    turning = [leg.axis for leg in pose.legs if leg.type is JointType.REVOLUTE]
    if turning:
        return turning[0]
    sliding = [leg.axis for leg in pose.legs if leg.type is JointType.PRISMATIC]
    for other in sliding[1:]:
        normal = cross(sliding[0], other)
        if length(normal) > _FLAT:
            return unit(normal)
    return None


def _moves_across(pose: Skeleton, normal: Vector) -> bool:
    """Whether all of a pose lies in one plane with this normal, and moves in it."""
    heights = [dot(normal, point) for point in pose.path]
    if max(heights) - min(heights) > _FLAT or len(heights) < 2:
        return False
    for leg in pose.legs:
        lean = abs(dot(leg.axis, normal))
        if leg.type is JointType.REVOLUTE and lean < 1 - _FLAT:
            return False
        if leg.type is JointType.PRISMATIC and lean > _FLAT:
            return False
    return True
