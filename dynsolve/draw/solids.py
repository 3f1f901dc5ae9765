"""Cylinders, boxes, links and the ground, each as paths with a depth to sort by."""

from __future__ import annotations

import math
from collections.abc import Sequence

from dynsolve.draw import paths
from dynsolve.draw.bodies import DrawnBody
from dynsolve.draw.body_solids import body_solids
from dynsolve.draw.links import joined, link_pieces
from dynsolve.draw.parts import BOX, HALF_HEIGHT, RADIUS, JointBody, Parts
from dynsolve.draw.paths import Path
from dynsolve.draw.primitives import END_ON, JOINT, Solid, block, drum, nearer
from dynsolve.draw.vectors import (
    Point,
    Vector,
    along,
    any_normal,
    between,
    cross,
    dot,
    length,
    scale,
    subtract,
    unit,
)
from dynsolve.draw.view import View
from dynsolve.robot.model import JointType

_GROUND, _PLATE = 30.0, 40.0
"""Half the length of the ground in a plane, and half the side of its plate, on which an angle may stand."""

_STEEP = 0.93
"""The cosine to the way down from which an edge of the ground has no strokes."""


def solids(parts: Parts, view: View, up: Vector, bodies: Sequence[DrawnBody] = ()) -> tuple[Path, ...]:
    """All of a robot's body but the ground, from back to front."""
    turning = [part for part in parts.joints if part.type is JointType.REVOLUTE]
    sliding = [part for part in parts.joints if part.type is JointType.PRISMATIC]
    found = [*link_pieces(parts, view, bodies), *body_solids(bodies, parts, view, up)]
    found += (cylinder(part, view) for part in turning)
    found += (box(part, view, up) for part in sliding)
    found.sort(key=lambda solid: round(solid.depth, 6))
    return tuple(path for solid in joined(found) for path in solid.paths)


# -- joints ----------------------------------------------------------------------------------------


def cylinder(part: JointBody, view: View) -> Solid:
    """A revolute joint: a cylinder along its axis, a circle with its middle where it is seen end on."""
    solid = drum(part.center, part.axis, RADIUS, HALF_HEIGHT, view, JOINT)
    if abs(dot(part.axis, view.toward)) <= END_ON:
        return solid
    middle = Path(paths.circle(view.point(part.center), 2.2), None, fill=paths.BLACK)
    return Solid(solid.depth + 1.0, (*solid.paths, middle))


def box(part: JointBody, view: View, up: Vector) -> Solid:
    """A prismatic joint: a box along its axis."""
    second = _crosswise(part.axis, view, up)
    axes = part.axis, second, cross(part.axis, second)
    halves = HALF_HEIGHT + 2.0, BOX - 1.0, BOX - 1.0
    return nearer(block(part.center, axes, halves, view, up, JOINT), 1.0 if view.flat else 0.0)


def _crosswise(axis: Vector, view: View, up: Vector) -> Vector:
    """A direction across a box: the viewer's in a flat view, else level or upright."""
    for wanted in (view.toward,) if view.flat else (up, view.right):
        level = subtract(wanted, scale(axis, dot(wanted, axis)))
        if length(level) > 0.3:
            return unit(level)
    return any_normal(axis)


# -- the ground ------------------------------------------------------------------------------------


def ground(parts: Parts, view: View) -> tuple[Path, ...]:
    """The ground under the base: a hatched line, or a hatched plate where there is space."""
    normal, place = parts.ground_normal, parts.ground
    if view.flat:
        return _hatched_line(place, cross(normal, view.toward), normal, view, _GROUND)
    first = parts.ground_side
    second = cross(normal, first)
    half = view.space(_PLATE)
    corners = [
        along(along(place, first, s * half), second, t * half)
        for s, t in ((1, 1), (1, -1), (-1, -1), (-1, 1))
    ]
    plate = Path(paths.polygon([view.point(corner) for corner in corners]), fill="#f4f1ea")
    middle = [between(corners[k], corners[(k + 1) % 4], 0.5) for k in range(4)]
    front = sorted(
        range(4), key=lambda k: round(view.depth(middle[k]) * view.size + view.point(middle[k])[1], 4)
    )
    hatches = []
    for k in front[2:]:
        a, b = corners[k], corners[(k + 1) % 4]
        hatches += _hatches(view.point(a), view.point(b), view.direction(scale(normal, -1.0)))
    return (*hatches, plate)


def _hatched_line(
    place: Vector, direction: Vector, normal: Vector, view: View, half: float
) -> tuple[Path, ...]:
    a = view.point(along(place, direction, -view.space(half)))
    b = view.point(along(place, direction, view.space(half)))
    return (*_hatches(a, b, view.direction(scale(normal, -1.0))), Path(paths.line(a, b), width=1.6))


def _hatches(a: Point, b: Point, down: Point) -> list[Path]:
    """Short slanted strokes under a line; none beside one so steep that they would run along it."""
    reach = math.dist(a, b)
    if reach < 1.0:
        return []
    drop = math.hypot(*down) or 1.0
    x, y = (b[0] - a[0]) / reach, (b[1] - a[1]) / reach
    if abs(x * down[0] + y * down[1]) > _STEEP * drop:
        return []
    slant = (down[0] / drop * 8.0 - x * 6.0, down[1] / drop * 8.0 - y * 6.0)
    count = max(2, round(reach / 7.5))
    starts = [(a[0] + x * reach * k / count, a[1] + y * reach * k / count) for k in range(1, count + 1)]
    return [
        Path(paths.line(start, (start[0] + slant[0], start[1] + slant[1])), width=0.8) for start in starts
    ]
