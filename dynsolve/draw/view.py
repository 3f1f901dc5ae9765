"""How space is laid on paper: a parallel projection, its size and its place."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

from dynsolve.draw.vectors import Point, Vector, any_normal, cross, dot, scale, subtract, unit


@dataclass(frozen=True, slots=True)
class View:
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
    level = unit(subtract(ahead, scale(up, dot(ahead, up)))) if _leans(ahead, up) else any_normal(up)
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


def _leans(a: Vector, b: Vector) -> bool:
    return abs(dot(a, b)) < 0.99
