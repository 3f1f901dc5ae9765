"""The places of the parts along the chain: cylinders and boxes on the axes, links between them.

A part may stand anywhere on its joint's axis without a change of the kinematics;
it is put where it meets no other part.  Sizes are in picture units.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from types import MappingProxyType

from msgspec import Struct

from dynsolve.draw.skeleton import Leg, Skeleton
from dynsolve.draw.vectors import (
    NEAR,
    Vector,
    View,
    across,
    along,
    distance,
    dot,
    length,
    scale,
    subtract,
    unit,
)
from dynsolve.robot.model import JointType

RADIUS = 13.0
HALF_HEIGHT = 16.0
BOX = 14.0
TUBE = 4.5
"""Half the width of a link."""

_CLEAR = 36.0
"""The least distance between the centres of two parts."""

_BASE_END = 24.0
"""How far from its foot the part of a joint stands that turns a long link: at the base end of that link.

The first one stands on the ground.
"""

_PEDESTAL = 46.0
_ROOM = 44.0
"""The length of a leg that has room for its joint in the middle."""

_PARALLEL = 0.99
_LEVEL = 0.5
"""The least part of an axis of the base that lies along the ground, so that an edge runs that way."""


NO_SLEEVES: Mapping[int, float] = MappingProxyType({})


class JointBody(Struct, frozen=True):
    """A cylinder (revolute) or a box (prismatic) around a joint's axis."""

    row: int
    type: JointType
    center: Vector
    axis: Vector


class Parts(Struct, frozen=True):
    """All parts, and the links between them, the first from the ground.

    `ground` is where the base stands, `ground_side` the direction of an edge of its plate: that of
    x_0 where this lies in the plate.
    """

    joints: tuple[JointBody, ...]
    links: tuple[tuple[Vector, ...], ...]
    ground: Vector
    ground_normal: Vector
    ground_side: Vector


def arrange(pose: Skeleton, view: View, up: Vector, sleeves: Mapping[int, float] = NO_SLEEVES) -> Parts:
    """Put the parts of a robot along its chain, those that slide in a body at the end of that body."""
    joints: list[JointBody] = []
    for row, leg in enumerate(pose.legs, 1):
        if leg.type is None:
            continue
        places = _places(
            pose, row, leg, view, up, first=not joints and distance(leg.foot, pose.frames[0].origin) < NEAR
        )
        if row in sleeves:
            places = [along(leg.foot, leg.axis, sleeves[row]), *places]
        clear = (p for p in places if all(distance(p, j.center) * view.size >= _CLEAR * 0.98 for j in joints))
        center = next(clear, places[0])
        joints.append(JointBody(row, leg.type, center, leg.axis))
    ground, normal = _ground(pose, joints, view, up)
    side = across(normal, pose.frames[0].axes, _LEVEL)
    return Parts(tuple(joints), _links(pose, joints, ground), ground, normal, side)


def _places(pose: Skeleton, row: int, leg: Leg, view: View, up: Vector, first: bool) -> list[Vector]:
    """Where a joint's part may stand, best first."""
    span = dot(subtract(leg.head, leg.foot), leg.axis)
    gap = view.space(_CLEAR)
    onward = 1.0 if span >= -NEAR else -1.0
    ahead = [along(leg.foot, leg.axis, onward * gap * k) for k in (0.0, 1.0, -1.0, 2.0, -2.0)]
    if leg.type is JointType.PRISMATIC:
        return ahead
    if abs(span) * view.size > _ROOM:
        base_end = HALF_HEIGHT if first else _BASE_END
        near_the_foot = [math.copysign(view.space(away), span) for away in (base_end, _CLEAR)]
        middle = [span * part for part in (0.5, 0.3, 0.7)]
        return [along(leg.foot, leg.axis, away) for away in (*near_the_foot, *middle)] + ahead
    upright = dot(leg.axis, up)
    if first and not view.flat and abs(upright) > 0.5 and abs(span) < NEAR:
        down = -1.0 if upright > 0 else 1.0
        return [along(leg.foot, leg.axis, down * view.space(_PEDESTAL)), *ahead]
    before = _neighbour(pose, row, leg, view, -1)
    after = _neighbour(pose, row, leg, view, 1)
    return [*before, *ahead[:1], *after, *ahead[1:]]


def _neighbour(pose: Skeleton, row: int, leg: Leg, view: View, step: int) -> list[Vector]:
    """A place on the link that comes before or after, where that lies along the joint's axis."""
    here = leg.foot if step < 0 else leg.head
    ways = pose.links if step > 0 else [(b, a) for a, b in pose.links]
    there = next((b for a, b in ways if distance(a, here) < NEAR), here)
    gap = view.space(_CLEAR)
    if distance(here, there) < 1.6 * gap:
        return []
    way = unit(subtract(there, here))
    return [] if abs(dot(way, leg.axis)) < _PARALLEL else [along(here, way, gap)]


def _ground(pose: Skeleton, joints: Sequence[JointBody], view: View, up: Vector) -> tuple[Vector, Vector]:
    """Where the ground is under the robot, and its normal."""
    start = pose.frames[0].origin
    if not joints:
        return start, up
    first = joints[0]
    if view.flat and first.type is JointType.REVOLUTE:
        return along(first.center, up, -view.space(RADIUS + 14.0)), up
    stands_at_start = distance(first.center, start) < NEAR
    if first.type is JointType.REVOLUTE and abs(dot(first.axis, up)) < 0.5 and stands_at_start:
        return along(first.center, up, -view.space(RADIUS + 34.0)), up
    leg = pose.legs[first.row - 1]
    span = dot(subtract(leg.head, leg.foot), leg.axis)
    normal = scale(leg.axis, 1.0 if span > NEAR or (abs(span) <= NEAR and dot(leg.axis, up) > 0) else -1.0)
    low = min(dot(subtract(first.center, start), normal) - view.space(HALF_HEIGHT + 8.0), 0.0)
    if low < 0.0:
        heights = [dot(subtract(point, start), normal) for point in pose.path]
        low = min(low, min(heights[1:], default=0.0) - view.space(_PEDESTAL))
    return along(start, normal, low), normal


def _links(pose: Skeleton, joints: Sequence[JointBody], ground: Vector) -> tuple[tuple[Vector, ...], ...]:
    """The way from the ground to the first part, and from each part to the next, or to the end.

    A row that starts from an earlier frame ends the way before it and begins one there.
    """
    centers = {part.row: part.center for part in joints}
    way, end = [ground], ground
    links = []
    for row, leg in enumerate(pose.legs, 1):
        if row > 1 and distance(leg.start, end) > NEAR:
            links.append(straightened(way))
            way = [leg.start]
        end = leg.end
        way.append(leg.foot)
        if row in centers:
            way.append(centers[row])
            links.append(straightened(way))
            way = [centers[row]]
        way += [leg.head, leg.end]
    links.append(straightened(way))
    return tuple(link for link in links if len(link) > 1)


def straightened(way: Sequence[Vector]) -> tuple[Vector, ...]:
    """The points of a way, each once, without going somewhere and straight back.

    >>> straightened([(0.0, 0.0, 0.0), (2.0, 0.0, 0.0), (2.0, 0.0, 0.0), (1.0, 0.0, 0.0)])
    ((0.0, 0.0, 0.0), (1.0, 0.0, 0.0))
    """
    points: list[Vector] = []
    for point in way:
        if points and distance(points[-1], point) < NEAR:
            continue
        points.append(point)
        while len(points) > 2 and _in_line(*points[-3:]):
            del points[-2]
            if distance(points[-1], points[-2]) < NEAR:
                del points[-1]
    return tuple(points)


def _in_line(a: Vector, b: Vector, c: Vector) -> bool:
    return abs(dot(unit(subtract(b, a)), unit(subtract(c, b)))) > 1 - 1e-9


def is_inside(point: Vector, parts: Parts, view: View) -> bool:
    """Whether a point lies in a cylinder or a box."""
    for part in parts.joints:
        offset = scale(subtract(point, part.center), view.size)
        height = dot(offset, part.axis)
        beside = length(subtract(offset, scale(part.axis, height)))
        wide = RADIUS if part.type is JointType.REVOLUTE else BOX - 1.0
        if abs(height) < HALF_HEIGHT - 1.0 and beside < wide - 1.0:
            return True
    return False
