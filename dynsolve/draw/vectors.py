"""Vectors of three and of two numbers: as much geometry as a picture needs.

How space is laid on paper: a parallel projection, its size and its place.
"""

from __future__ import annotations

import math
from collections.abc import Iterable

from msgspec import Struct
from msgspec.structs import replace

Vector = tuple[float, float, float]
Point = tuple[float, float]
Rotation = tuple[Vector, Vector, Vector]
"""The columns of a 3×3 matrix: the axes x, y and z of a frame."""

NEAR = 1e-6
"""The distance below which two points are one."""

ORIGIN: Vector = (0.0, 0.0, 0.0)
IDENTITY: Rotation = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))


def add(a: Vector, b: Vector) -> Vector:
    """a + b"""
    return a[0] + b[0], a[1] + b[1], a[2] + b[2]


def subtract(a: Vector, b: Vector) -> Vector:
    """a - b"""
    return a[0] - b[0], a[1] - b[1], a[2] - b[2]


def scale(a: Vector, factor: float) -> Vector:
    """factor·a"""
    return a[0] * factor, a[1] * factor, a[2] * factor


def along(start: Vector, direction: Vector, length: float) -> Vector:
    """start + length·direction"""
    return (
        start[0] + direction[0] * length,
        start[1] + direction[1] * length,
        start[2] + direction[2] * length,
    )


def between(a: Vector, b: Vector, fraction: float) -> Vector:
    """The point that fraction of the way from a to b."""
    return along(a, subtract(b, a), fraction)


def dot(a: Vector, b: Vector) -> float:
    """aᵀ b"""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a: Vector, b: Vector) -> Vector:
    """a × b"""
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


def length(a: Vector) -> float:
    """|a|"""
    return math.sqrt(dot(a, a))


def distance(a: Vector, b: Vector) -> float:
    """|b - a|"""
    return length(subtract(b, a))


def unit(a: Vector) -> Vector:
    """a / |a|, of a vector that is not zero."""
    return scale(a, 1.0 / length(a))


def any_normal(a: Vector) -> Vector:
    """A unit vector at right angles to a."""
    smallest = min(range(3), key=lambda k: (abs(round(a[k], 9)), k))
    return unit(cross(a, IDENTITY[smallest]))


def across(axis: Vector, wanted: Iterable[Vector], least: float) -> Vector:
    """The first of some directions of which more than `least` is at right angles to an axis; else any."""
    for direction in wanted:
        level = subtract(direction, scale(axis, dot(direction, axis)))
        if length(level) > least:
            return unit(level)
    return any_normal(axis)


def turned(R: Rotation, axis: int, angle: float) -> Rotation:
    """R after a turn about its own axis, 0 for x and 2 for z."""
    c, s = math.cos(angle), math.sin(angle)
    first, second = R[(axis + 1) % 3], R[(axis + 2) % 3]
    columns = list(R)
    columns[(axis + 1) % 3] = add(scale(first, c), scale(second, s))
    columns[(axis + 2) % 3] = add(scale(first, -s), scale(second, c))
    return columns[0], columns[1], columns[2]


def applied(R: Rotation, a: Vector) -> Vector:
    """R a"""
    return add(add(scale(R[0], a[0]), scale(R[1], a[1])), scale(R[2], a[2]))


def into(R: Rotation, a: Vector) -> Vector:
    """Rᵀ a"""
    return dot(R[0], a), dot(R[1], a), dot(R[2], a)


def scaled(a: Point, factor: float) -> Point:
    """factor·a, on paper."""
    return a[0] * factor, a[1] * factor


def moved(point: Point, direction: Point, amount: float) -> Point:
    """point + amount·direction, on paper."""
    return point[0] + direction[0] * amount, point[1] + direction[1] * amount


def from_to(a: Point, b: Point) -> Point:
    """b - a, on paper."""
    return b[0] - a[0], b[1] - a[1]


def toward(a: Point, b: Point) -> Point:
    """(b - a) / |b - a|, on paper; 0 where they are one."""
    reach = math.dist(a, b) or 1.0
    return (b[0] - a[0]) / reach, (b[1] - a[1]) / reach


# -- distances on paper ----------------------------------------------------------------------------


def point_to_segment(p: Point, a: Point, b: Point) -> float:
    """How far a point is from a segment."""
    dx, dy = b[0] - a[0], b[1] - a[1]
    square = dx * dx + dy * dy
    t = 0.0 if square < NEAR else ((p[0] - a[0]) * dx + (p[1] - a[1]) * dy) / square
    t = min(1.0, max(0.0, t))
    return math.hypot(p[0] - a[0] - t * dx, p[1] - a[1] - t * dy)


def segment_distance(first: tuple[Point, Point], second: tuple[Point, Point]) -> float:
    """How far two segments are apart; 0 where they cross.

    >>> segment_distance(((0.0, 0.0), (2.0, 0.0)), ((1.0, -1.0), (1.0, 1.0)))
    0.0
    """
    (a, b), (c, d) = first, second
    if _side(a, b, c) * _side(a, b, d) < 0 and _side(c, d, a) * _side(c, d, b) < 0:
        return 0.0
    return min(
        point_to_segment(a, c, d),
        point_to_segment(b, c, d),
        point_to_segment(c, a, b),
        point_to_segment(d, a, b),
    )


def _side(a: Point, b: Point, p: Point) -> float:
    return (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0])


# How space is laid on paper: a parallel projection, its size and its place


class View(Struct, frozen=True):
    """A parallel projection; y of the paper grows downwards.

    `right` and `up` are the directions of the paper, `toward` the one to the viewer;
    `size` is how many picture units a length of 1 takes.  `flat` says that the robot
    moves in the plane of the paper.
    """

    right: Vector
    up: Vector
    toward: Vector
    size: float = 1.0
    flat: bool = False
    shift: Point = (0.0, 0.0)

    def point(self, place: Vector) -> Point:
        """Where a point of space is on paper."""
        return (
            self.shift[0] + self.size * dot(self.right, place),
            self.shift[1] - self.size * dot(self.up, place),
        )

    def direction(self, direction: Vector) -> Point:
        """A direction of space on paper; its length is how little it is foreshortened."""
        return dot(self.right, direction), -dot(self.up, direction)

    def depth(self, place: Vector) -> float:
        """How near the viewer a point is."""
        return dot(self.toward, place)

    def sized(self, size: float) -> View:
        """The same view at another size."""
        return replace(self, size=size)

    def space(self, length: float) -> float:
        """The length in space of a length on paper."""
        return length / self.size


def oblique(up: Vector, ahead: Vector, azimuth: float, elevation: float) -> View:
    """A view from above, turned by `azimuth` from the direction `ahead`; angles in radians."""
    leans = abs(dot(ahead, up)) < 0.99
    level = unit(subtract(ahead, scale(up, dot(ahead, up)))) if leans else any_normal(up)
    side = cross(up, level)
    c, s = math.cos(azimuth), math.sin(azimuth)
    front = (level[0] * c + side[0] * s, level[1] * c + side[1] * s, level[2] * c + side[2] * s)
    lift, low = math.sin(elevation), math.cos(elevation)
    toward = (
        front[0] * low + up[0] * lift,
        front[1] * low + up[1] * lift,
        front[2] * low + up[2] * lift,
    )
    right = unit(cross(up, front))
    return View(right, cross(toward, right), toward)


def facing(toward: Vector, up: Vector) -> View:
    """The plane seen from straight in front, with `up` upwards."""
    level = unit(subtract(up, scale(toward, dot(up, toward))))
    return View(cross(level, toward), level, toward, flat=True)
