"""Drums, blocks and balls as paths, with a depth to sort by."""

from __future__ import annotations

import math
from collections.abc import Sequence

from msgspec import Struct
from msgspec.structs import replace

from dynsolve.draw import paths
from dynsolve.draw.labels import Box, bounds
from dynsolve.draw.paths import Path
from dynsolve.draw.vectors import Point, Rotation, Vector, View, along, cross, dot, scale, unit

END_ON = 0.999
"""The cosine between an axis and the line of sight from which it is seen end on."""


class Material(Struct, frozen=True):
    """The colours of what is lit from above: its top, its side, its darker side."""

    top: str
    side: str
    dark: str


JOINT = Material(paths.CAP, paths.SIDE, paths.DARK_SIDE)
BODY = Material("#f8f0dc", "#ecdfc0", "#d9c9a3")


class Solid(Struct, frozen=True):
    """Paths that belong together; what is nearer the viewer is drawn later.

    A piece of a straight tube says which tube it is of, and from where to where it
    goes on paper, `first` and `last` counting pieces.
    """

    depth: float
    paths: tuple[Path, ...]
    tube: int = -1
    first: int = 0
    last: int = 0
    ends: tuple[Point, Point] = ((0.0, 0.0), (0.0, 0.0))

    @property
    def box(self) -> Box:
        """The area of paper that it covers."""
        return bounds(self.paths)


def drum(center: Vector, axis: Vector, radius: float, half: float, view: View, material: Material) -> Solid:
    """A cylinder; `radius` and `half` its height are in picture units."""
    axis = axis if dot(axis, view.toward) >= 0 else scale(axis, -1.0)
    depth = view.depth(center)
    across, lift = half_axes(axis, view, radius)
    if dot(axis, view.toward) > END_ON:
        return Solid(depth, (Path(paths.circle(view.point(center), radius), fill=material.top),))
    near = view.point(along(center, axis, view.space(half)))
    far = view.point(along(center, axis, -view.space(half)))
    # cos t runs across the axis, sin t along it towards the viewer: the far end shows its lower half
    body = (
        *paths.arc(far, across, lift, math.pi, 2 * math.pi),
        *paths.arc(near, across, lift, 0.0, math.pi, move=False),
        ("Z", ()),
    )
    return Solid(
        depth, (Path(body, fill=material.side), Path(paths.ellipse(near, across, lift), fill=material.top))
    )


def half_axes(axis: Vector, view: View, radius: float) -> tuple[Point, Point]:
    """The half axes, on paper, of a circle around an axis; the second points along the axis on paper."""
    if abs(dot(axis, view.toward)) > END_ON:
        return (radius, 0.0), (0.0, -radius)
    across = unit(cross(axis, view.toward))
    along_axis = cross(across, axis)
    x, y = view.direction(across)
    u, v = view.direction(along_axis)
    forward = view.direction(axis)
    sign = 1.0 if u * forward[0] + v * forward[1] >= 0 else -1.0
    return (x * radius, y * radius), (sign * u * radius, sign * v * radius)


def block(
    center: Vector, axes: Rotation, halves: Sequence[float], view: View, up: Vector, material: Material
) -> Solid:
    """A box with `halves` of its sides, in picture units, along its axes."""
    faces = [
        (axis if dot(axis, view.toward) > 0 else scale(axis, -1.0), k)
        for k, axis in enumerate(axes)
        if abs(dot(axis, view.toward)) > 1e-3
    ]
    faces.sort(key=lambda face: round(dot(face[0], view.toward), 6))
    drawn = tuple(_face(center, *face, axes, halves, view, up, material) for face in faces)
    return Solid(view.depth(center), drawn)


def _face(
    center: Vector,
    normal: Vector,
    k: int,
    axes: Rotation,
    halves: Sequence[float],
    view: View,
    up: Vector,
    material: Material,
) -> Path:
    middle = along(center, normal, view.space(halves[k]))
    i, j = (other for other in range(3) if other != k)
    corners = [
        along(along(middle, axes[i], view.space(s * halves[i])), axes[j], view.space(t * halves[j]))
        for s, t in ((1, 1), (1, -1), (-1, -1), (-1, 1))
    ]
    if view.flat or dot(normal, up) > 0.4:
        fill = material.top
    else:
        fill = material.side if dot(normal, view.right) < 0.4 else material.dark
    return Path(paths.polygon([view.point(corner) for corner in corners]), fill=fill)


def ball(center: Vector, radius: float, view: View, up: Vector, material: Material) -> Solid:
    """A ball with the front of its equator."""
    at = view.point(center)
    circle = Path(paths.circle(at, radius), fill=material.top)
    if view.flat:
        return Solid(view.depth(center), (circle,))
    across, lift = half_axes(up, view, radius)
    equator = paths.arc(at, across, lift, math.pi, 2 * math.pi)
    return Solid(view.depth(center), (circle, Path(equator, width=0.7)))


def nearer(solid: Solid, by: float) -> Solid:
    """The same solid, drawn as if it were nearer to the viewer."""
    return replace(solid, depth=solid.depth + by)
