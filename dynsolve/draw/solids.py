"""Cylinders, boxes, links and the ground, each as paths with a depth to sort by.

Links are tubes cut into short pieces, so that each can be sorted by depth, and put together again.  Of
uniform bodies, drums, blocks and balls, what lies inside a joint is left out.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from itertools import groupby

from msgspec import Struct
from msgspec.structs import replace

from dynsolve.draw import paths
from dynsolve.draw.labels import Box, bounds
from dynsolve.draw.mass_centers import DrawnBody, Form
from dynsolve.draw.parts import BOX, HALF_HEIGHT, RADIUS, TUBE, JointBody, Parts, is_inside
from dynsolve.draw.paths import Path
from dynsolve.draw.vectors import (
    Point,
    Rotation,
    Vector,
    View,
    across,
    along,
    between,
    cross,
    distance,
    dot,
    moved,
    scale,
    subtract,
    toward,
    unit,
)
from dynsolve.robot.model import JointType

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
    wide, lift = half_axes(axis, view, radius)
    if dot(axis, view.toward) > END_ON:
        return Solid(depth, (Path(paths.circle(view.point(center), radius), fill=material.top),))
    near = view.point(along(center, axis, view.space(half)))
    far = view.point(along(center, axis, -view.space(half)))
    # cos t runs across the axis, sin t along it towards the viewer: the far end shows its lower half
    body = (
        *paths.arc(far, wide, lift, math.pi, 2 * math.pi),
        *paths.arc(near, wide, lift, 0.0, math.pi, move=False),
        ("Z", ()),
    )
    return Solid(
        depth, (Path(body, fill=material.side), Path(paths.ellipse(near, wide, lift), fill=material.top))
    )


def half_axes(axis: Vector, view: View, radius: float) -> tuple[Point, Point]:
    """The half axes, on paper, of a circle around an axis; the second points along the axis on paper."""
    if abs(dot(axis, view.toward)) > END_ON:
        return (radius, 0.0), (0.0, -radius)
    level = unit(cross(axis, view.toward))
    along_axis = cross(level, axis)
    x, y = view.direction(level)
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
    wide, lift = half_axes(up, view, radius)
    equator = paths.arc(at, wide, lift, math.pi, 2 * math.pi)
    return Solid(view.depth(center), (circle, Path(equator, width=0.7)))


def nearer(solid: Solid, by: float) -> Solid:
    """The same solid, drawn as if it were nearer to the viewer."""
    return replace(solid, depth=solid.depth + by)


# Uniform bodies as solids: what of them lies inside a joint is left out

_STEP = 2.0
"""How finely a body is looked through for joints, in picture units."""

_SHORTEST = 6.0
"""What is left of a body between two joints, and is shorter, is not drawn."""


def body_solids(bodies: Sequence[DrawnBody], parts: Parts, view: View, up: Vector) -> Iterator[Solid]:
    """Every body, in as many pieces as joints and thicker bodies leave of it."""
    sink = 0.4 if view.flat else 0.0  # in a plane joints lie on bodies, and bodies on links
    for body in bodies:
        halves = list(body.on_paper(view.size))
        if body.form is Form.BALL:
            yield ball(body.center, halves[0], view, up, BODY)
            continue
        lengthwise = max(range(3), key=lambda k: halves[k])
        thicker = [other for other in bodies if _thickness(other, view) > _thickness(body, view)]
        for start, end in _pieces(body, lengthwise, halves[lengthwise], parts, thicker, view):
            center = along(body.center, body.axes[lengthwise], view.space((start + end) / 2))
            halves[lengthwise] = (end - start) / 2
            yield nearer(_piece(body, center, halves, view, up), -sink)


def _piece(body: DrawnBody, center: Vector, halves: Sequence[float], view: View, up: Vector) -> Solid:
    if body.form is Form.BOX:
        return block(center, body.axes, halves, view, up, BODY)
    radius = halves[(body.main + 1) % 3]
    return drum(center, body.axes[body.main], radius, halves[body.main], view, BODY)


def _pieces(
    body: DrawnBody,
    lengthwise: int,
    half: float,
    parts: Parts,
    thicker: Sequence[DrawnBody],
    view: View,
) -> Iterator[tuple[float, float]]:
    """From where to where a body is outside of joints and thicker ones, along its longest side, on paper."""
    steps = max(1, math.ceil(2 * half / _STEP))
    width = 2 * half / steps

    def hidden(k: int) -> bool:
        middle = along(body.center, body.axes[lengthwise], view.space(-half + (k + 0.5) * width))
        return is_inside(middle, parts, view) or covers(thicker, middle, view)

    for inside, run in groupby(range(steps), hidden):
        places = list(run)
        if not inside and (len(places) * width >= _SHORTEST or len(places) == steps):
            yield -half + places[0] * width, -half + (places[-1] + 1) * width


def _thickness(body: DrawnBody, view: View) -> float:
    """The second of its three sides on paper, by size: how thick a long body is."""
    return sorted(body.on_paper(view.size))[1]


def covers(bodies: Sequence[DrawnBody], point: Vector, view: View) -> bool:
    """Whether a point lies in a body."""
    for body in bodies:
        offset = subtract(point, body.center)
        halves = body.on_paper(view.size)
        pairs = zip(body.axes, halves, strict=True)
        if all(abs(dot(offset, axis)) * view.size < half - 0.5 for axis, half in pairs):
            return True
    return False


# Links

_PIECE = 5.0
"""How long the pieces are that a link is cut into."""


def link_pieces(parts: Parts, view: View, bodies: Sequence[DrawnBody] = ()) -> Iterator[Solid]:
    """The tubes between the parts in pieces, and the elbows between the tubes; nothing inside a body."""
    sink = 0.5 if view.flat else 0.0
    tube = 0
    for number, way in enumerate(parts.links):
        for k, point in enumerate(way):
            if (number or k) and not _hidden(point, parts, view, bodies):
                elbow = Path(paths.circle(view.point(point), TUBE), fill=paths.LINK)
                yield Solid(view.depth(point) - 1e-3 - sink, (elbow,))
            if k:
                tube += 1
                for piece in _tube(way[k - 1], point, view, sink, tube):
                    if not _hidden(between(way[k - 1], point, piece[0]), parts, view, bodies):
                        yield piece[1]


def _hidden(point: Vector, parts: Parts, view: View, bodies: Sequence[DrawnBody]) -> bool:
    return is_inside(point, parts, view) or covers(bodies, point, view)


def _tube(a: Vector, b: Vector, view: View, sink: float, tube: int) -> Iterator[tuple[float, Solid]]:
    """A straight tube in short pieces, each with the part of the way at which its middle is."""
    if math.dist(view.point(a), view.point(b)) < 0.5:
        return
    pieces = max(1, math.ceil(distance(a, b) * view.size / _PIECE))
    for k in range(pieces):
        part = (k + 0.5) / pieces
        ends = view.point(between(a, b, k / pieces)), view.point(between(a, b, (k + 1) / pieces))
        yield part, Solid(view.depth(between(a, b, part)) - sink, _drawn(*ends), tube, k, k, ends)


def _drawn(a: Point, b: Point) -> tuple[Path, ...]:
    """A straight tube on paper: its area and its two sides."""
    x, y = toward(a, b)
    sides = [(moved(a, (-s * y, s * x), TUBE), moved(b, (-s * y, s * x), TUBE)) for s in (1.0, -1.0)]
    area = paths.polygon([*sides[0], *reversed(sides[1])])
    return (Path(area, None, fill=paths.LINK), *(Path(paths.line(*side)) for side in sides))


def joined(solids: Sequence[Solid]) -> list[Solid]:
    """Solids in order, with the pieces of a tube put together where nothing comes between them."""
    done: list[Solid] = []
    for solid in solids:
        place = _before(done, solid)
        if place is None:
            done.append(solid)
        else:
            done[place] = _merged(done[place], solid)
    return done


def _before(done: Sequence[Solid], solid: Solid) -> int | None:
    """Where the neighbouring piece of a tube stands, if what was drawn since leaves this one free."""
    if solid.tube < 0:
        return None
    box = solid.box
    for place in range(len(done) - 1, -1, -1):
        other = done[place]
        if other.tube == solid.tube and solid.first in (other.first - 1, other.last + 1):
            return place
        if other.tube != solid.tube and box.overlaps(other.box):
            return None
    return None


def _merged(a: Solid, b: Solid) -> Solid:
    if b.first < a.first:
        a, b = b, a
    ends = a.ends[0], b.ends[1]
    return replace(a, paths=_drawn(*ends), last=b.last, ends=ends)


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
    second = across(part.axis, (view.toward,) if view.flat else (up, view.right), 0.3)
    axes = part.axis, second, cross(part.axis, second)
    halves = HALF_HEIGHT + 2.0, BOX - 1.0, BOX - 1.0
    return nearer(block(part.center, axes, halves, view, up, JOINT), 1.0 if view.flat else 0.0)


# -- the ground ------------------------------------------------------------------------------------


def ground(parts: Parts, view: View) -> tuple[Path, ...]:
    """The ground under the base: a hatched line, or a hatched plate where there is space."""
    normal, place = parts.ground_normal, parts.ground
    if view.flat:
        level = cross(normal, view.toward)
        left = view.point(along(place, level, -view.space(_GROUND)))
        right = view.point(along(place, level, view.space(_GROUND)))
        return hatched(left, right, view.direction(scale(normal, -1.0)))
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


def hatched(a: Point, b: Point, down: Point) -> tuple[Path, ...]:
    """A line with short strokes on the side to which `down` points."""
    return (*_hatches(a, b, down), Path(paths.line(a, b), width=1.6))


def _hatches(a: Point, b: Point, down: Point) -> list[Path]:
    """Short slanted strokes under a line; none beside one so steep that they would run along it."""
    reach = math.dist(a, b)
    if reach < 1.0:
        return []
    drop = math.hypot(*down) or 1.0
    x, y = toward(a, b)
    if abs(x * down[0] + y * down[1]) > _STEEP * drop:
        return []
    slant = (down[0] / drop * 8.0 - x * 6.0, down[1] / drop * 8.0 - y * 6.0)
    count = max(2, round(reach / 7.5))
    starts = [(a[0] + x * reach * k / count, a[1] + y * reach * k / count) for k in range(1, count + 1)]
    return [Path(paths.line(start, moved(start, slant, 1.0)), width=0.8) for start in starts]
