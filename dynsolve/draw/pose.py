"""A robot in a pose, and the cost of the pose.

A pose is good where nothing hides anything: origins lie apart on paper, links do
not cross, axes are not seen end on, and the arm stays above the ground.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import combinations, pairwise

from dynsolve.draw.bodies import DrawnBody
from dynsolve.draw.orientation import Orientation
from dynsolve.draw.parts import Parts
from dynsolve.draw.skeleton import Leg, Skeleton
from dynsolve.draw.vectors import (
    NEAR,
    Point,
    Vector,
    along,
    cross,
    distance,
    dot,
    point_to_segment,
    segment_distance,
    subtract,
)
from dynsolve.draw.view import View
from dynsolve.robot.model import JointType, Robot

AXIS = 44.0
"""How long the axes of frames are drawn."""

ARC = 28.0
"""The radius of the arc of an angle in space, which its joint's body is not to hide."""

MANY = 4
"""A robot with more rows than that has more to write beside it than there is room for."""


@dataclass(frozen=True, slots=True)
class Pose:
    """A robot in its pose, seen from where it shows best, with the uniform bodies on its links."""

    skeleton: Skeleton
    parts: Parts
    view: View
    bodies: tuple[DrawnBody, ...] = ()


_SQUARE_TO_PAPER = 1.0
"""The cost of a link that stands upright or level in a plane, a special case that may mislead."""

Choice = tuple[float, ...]
"""Values of the coordinates, then azimuth and elevation where the view is free."""


def cost_of(pose: Pose, orientation: Orientation) -> float:
    """How far a pose is from good, 0 at best."""
    view = pose.view
    path = [view.point(point) for point in _with_hand(pose)]
    centers = [view.point(part.center) for part in pose.parts.joints]
    tips = _tips(pose)
    return (
        30.0 * max(0.0, 120.0 / view.size - 1.0)
        + 40.0 * _crowding(path, 60.0)
        + 25.0 * _crowding(centers, 48.0)
        + 14.0 * _crowding([tip for _, tip in tips], 30.0)
        + 30.0 * _crossings(pose, 36.0)
        + 10.0 * _tips_on_links(path, tips)
        + _foreshortening(pose)
        + _lowness(pose.skeleton, orientation)
    )


def _with_hand(pose: Pose) -> tuple[Vector, ...]:
    """The points of the chain, with the last joint where that stands beyond all of them."""
    path, joints = pose.skeleton.path, pose.parts.joints
    if not joints or len(path) < 2:
        return path
    last = joints[-1].center
    ways = pairwise(path)
    on_path = any(distance(a, last) + distance(last, b) < distance(a, b) + NEAR for a, b in ways)
    return path if on_path else (*path, last)


def _shortfall(value: float, wanted: float) -> float:
    """0 where there is enough, up to 1 where there is nothing."""
    return max(0.0, 1.0 - value / wanted) ** 2


def _crowding(points: Sequence[Point], wanted: float) -> float:
    return sum(_shortfall(math.dist(a, b), wanted) for a, b in combinations(points, 2))


def _tips(pose: Pose) -> list[tuple[Point, Point]]:
    """(origin, tip) of the axes of frames on paper."""
    view, size = pose.view, pose.view.space(AXIS)
    return [
        (view.point(frame.origin), view.point(along(frame.origin, axis, size)))
        for frame in pose.skeleton.frames
        for axis in (frame.x, frame.z)
        if not (view.flat and abs(dot(axis, view.toward)) > 0.9)
    ]


def _tips_on_links(path: Sequence[Point], tips: Sequence[tuple[Point, Point]]) -> float:
    segments = list(pairwise(path))
    return sum(_shortfall(point_to_segment(tip, *segment), 13.0) for _, tip in tips for segment in segments)


def _crossings(pose: Pose, wanted: float) -> float:
    """How near links come to each other that do not meet."""
    view = pose.view
    path = [view.point(point) for point in _with_hand(pose)]
    segments = list(pairwise(path))
    total = 0.0
    for (i, first), (j, second) in combinations(enumerate(segments), 2):
        if j == i + 1:
            total += 0.6 * _fold(first, second)
        else:
            total += _shortfall(segment_distance(first, second), wanted)
    return total


def _fold(first: tuple[Point, Point], second: tuple[Point, Point]) -> float:
    """1 where a link lies straight back on the one before it, 0 where it is far from that."""
    (a, b), (_, c) = first, second
    u, v = (a[0] - b[0], a[1] - b[1]), (c[0] - b[0], c[1] - b[1])
    sizes = math.hypot(*u) * math.hypot(*v)
    if sizes < NEAR:
        return 1.0
    return max(0.0, (u[0] * v[0] + u[1] * v[1]) / sizes - 0.4)


def _foreshortening(pose: Pose) -> float:
    view = pose.view
    total = 0.0
    for frame in pose.skeleton.frames:
        for axis in (frame.x, frame.z):
            if not (view.flat and abs(dot(axis, view.toward)) > 0.9):
                total += 6.0 * _shortfall(math.hypot(*view.direction(axis)), 0.6)
    for a, b in zip(pose.skeleton.path, pose.skeleton.path[1:], strict=False):
        seen = math.dist(view.point(a), view.point(b)) / (distance(a, b) * view.size)
        total += 8.0 * _shortfall(seen, 0.7)
    return total


def _lowness(body: Skeleton, orientation: Orientation) -> float:
    """The cost of reaching below the base."""
    start = body.frames[0].origin
    heights = [dot(subtract(point, start), orientation.up) for point in body.path]
    return 12.0 * sum(max(0.0, -0.05 - height) for height in heights)


def taste(robot: Robot, pose: Pose, choice: Choice) -> float:
    """Small preferences: angles that can be seen, moderate values, the arm leading to the right."""
    total = 0.0
    for q, value in zip(robot.coordinates, choice, strict=False):
        if q.type is JointType.PRISMATIC:
            total += 1.5 * abs(value - 0.9)
        else:
            total += 0.3 * abs(value) + 1.5 * max(0.0, 0.3 - value)  # 90° more than 30° is seen to be obtuse
    if pose.view.flat:
        for leg in pose.skeleton.legs:
            if leg.type is JointType.REVOLUTE:
                total += 12.0 * _shortfall(leg.turn, 0.7) + 1.2 * abs(leg.turn - 0.8)
        total += sum(_SQUARE_TO_PAPER for link in pairwise(pose.skeleton.path) if _is_square(pose, *link))
    else:
        total += 0.5 * abs(choice[-2] - math.radians(35))
        if len(pose.skeleton.legs) <= MANY:
            total += sum(_hidden_angle(leg, pose.view) for leg in pose.skeleton.legs)
    first, last = pose.skeleton.frames[0].origin, pose.skeleton.frames[-1].origin
    reach = pose.view.direction(subtract(last, first))[0]
    return total + 1.5 * max(0.0, 1.0 - reach)


def _is_square(pose: Pose, a: Vector, b: Vector) -> bool:
    """Whether a link that a joint may turn stands upright or level on paper, as few poses have it."""
    across, up = pose.view.direction(subtract(b, a))
    return min(abs(across), abs(up)) < NEAR and distance(a, b) > NEAR


def _hidden_angle(leg: Leg, view: View) -> float:
    """The cost of an angle in space that is small, or very large, or behind its joint."""
    if leg.type is not JointType.REVOLUTE:
        return 0.0
    angle = leg.turn
    side = cross(leg.axis, leg.before)
    behind = sum(
        max(0.0, -dot(leg.before, view.toward) * math.cos(t) - dot(side, view.toward) * math.sin(t))
        for t in (0.0, angle / 2, angle)
    )
    behind += max(0.0, -dot(leg.after, view.toward)) if leg.offset else 0.0
    flat = _shortfall(abs(dot(leg.axis, view.toward)), 0.6)  # an arc that is seen from its edge
    return (
        12.0 * _shortfall(angle, 0.7)
        + 0.8 * abs(angle - 1.1)
        + 1.5 * max(0.0, angle - 2.8)
        + 2.0 * behind
        + 12.0 * flat
    )
