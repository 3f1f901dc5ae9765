"""The angles of revolute joints: each from the x axis before the joint to the one after it, about its axis.

Where a joint is drawn away from the origins of these frames, dashed lines through it are parallel to their
x axes.  A robot with many rows has no room for that: an arrow around each axis shows the sense of its angle.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from itertools import pairwise

from dynsolve.draw import paths
from dynsolve.draw.annotate import Notes
from dynsolve.draw.parts import RADIUS, JointBody
from dynsolve.draw.paths import Path
from dynsolve.draw.pose import MANY, Pose
from dynsolve.draw.skeleton import Leg
from dynsolve.draw.vectors import (
    NEAR,
    Point,
    Vector,
    add,
    along,
    cross,
    distance,
    dot,
    length,
    moved,
    scale,
    scaled,
    subtract,
    unit,
)
from dynsolve.notation.tree import Node
from dynsolve.robot.model import JointType

_RING = 1.75 * RADIUS
_ARC = 31.0
_WIDER = 10.0
"""How much wider the arc of a further angle about the same point is."""

_WIDE = 34.0
"""The radius of an arc in space, which its joint's body is not to hide."""

_SMALL = 0.3
"""A smaller angle in space is shown by its sense alone."""

_BEYOND = 12.0
"""How far the lines of an angle reach beyond its arc."""

_PARTS = (0.5, 0.35, 0.65, 0.2, 0.8)
"""Where along an arc its name may stand, best first."""


def joint_angles(pose: Pose, written: Sequence[Node], notes: Notes) -> None:
    """The angle of every revolute joint, as the table has it."""
    for part in pose.parts.joints:
        if part.type is JointType.REVOLUTE:
            leg, name = pose.skeleton.legs[part.row - 1], written[part.row - 1]
            if pose.view.flat:
                _flat_angle(pose, part, leg, name, notes)
            elif _has_ring(pose, leg):
                _ring(pose, part, name, notes)
            else:
                _angle_in_space(pose, part, leg, name, notes)


def has_parallels(pose: Pose) -> bool:
    """Whether some angle is shown between lines that are parallel to its x axes."""
    flat = pose.view.flat
    legs = ((pose.skeleton.legs[part.row - 1], part) for part in pose.parts.joints)
    return any(
        leg.type is JointType.REVOLUTE
        and (flat or not _has_ring(pose, leg))
        and any(_drawn_lines(leg, part, flat))
        for leg, part in legs
    )


def _has_ring(pose: Pose, leg: Leg) -> bool:
    """Whether there is no room for an angle in space, or it is too small to be seen."""
    return len(pose.skeleton.legs) > MANY or leg.angle % (2 * math.pi) < _SMALL


def _drawn_lines(leg: Leg, part: JointBody, flat: bool) -> Iterator[Vector]:
    """The directions from a joint in which nothing else shows the x axis before it, or after it."""
    if distance(leg.start, part.center) > NEAR:
        yield leg.before
    has_link = distance(leg.head, leg.end) > NEAR and distance(leg.head, part.center) < NEAR
    if not flat and distance(leg.end, part.center) > NEAR and not has_link:
        yield leg.after


# -- in a plane ------------------------------------------------------------------------------------


def _flat_angle(pose: Pose, part: JointBody, leg: Leg, node: Node, notes: Notes) -> None:
    """θ_i in the plane of the paper, turning as the joint's axis says."""
    view = pose.view
    center = view.point(part.center)
    first = view.direction(leg.before)
    angle = leg.angle % (2 * math.pi)
    if dot(leg.axis, view.toward) < 0:
        angle = -angle
    second = (first[1], -first[0])
    lines = _drawn_lines(leg, part, flat=True) if math.dist(view.point(leg.start), center) > NEAR else ()
    for line in lines:
        end = moved(center, view.direction(line), _ARC + _BEYOND)
        notes.draw(Path(paths.line(center, end), paths.GREY, 0.9, dashed=True))
    radius = (_ARC if abs(angle) > 0.5 else _ARC + 16.0) + _WIDER * _before_here(pose, part)
    p, q = scaled(first, radius), scaled(second, radius)
    short = angle - math.copysign(min(6.0 / radius, abs(angle) / 2), angle)
    notes.draw(
        Path(paths.arc(center, p, q, 0.0, short), paths.VARIABLE, 1.4), _head(center, p, q, angle, short)
    )
    middle = [paths.on_ellipse(center, p, q, angle * part_of) for part_of in _PARTS[:3]]
    notes.label(node, middle, _from_to(center, middle[0]), paths.VARIABLE, "variable")


def _before_here(pose: Pose, part: JointBody) -> int:
    """How many joints before this one turn about the same point of the paper."""
    at = pose.view.point(part.center)
    others = (other for other in pose.parts.joints if other.row < part.row)
    return sum(math.dist(pose.view.point(other.center), at) < NEAR for other in others)


def _head(center: Point, p: Point, q: Point, end: float, short: float) -> Path:
    """The head of an arrow along an ellipse, its tip at `end`."""
    tip, before = paths.on_ellipse(center, p, q, end), paths.on_ellipse(center, p, q, short)
    return Path(paths.head(tip, _from_to(before, tip), 8.0), None, fill=paths.VARIABLE)


def _from_to(a: Point, b: Point) -> Point:
    return b[0] - a[0], b[1] - a[1]


# -- in space --------------------------------------------------------------------------------------


def _angle_in_space(pose: Pose, part: JointBody, leg: Leg, node: Node, notes: Notes) -> None:
    """θ_i around the joint's axis; what lies behind the joint is drawn before it."""
    view = pose.view
    center = view.point(part.center)
    side = cross(leg.axis, leg.before)
    for direction in _drawn_lines(leg, part, flat=False):
        tip = view.point(along(part.center, direction, view.space(_WIDE + _BEYOND)))
        line = Path(paths.line(center, tip), paths.GREY, 0.9, dashed=True)
        notes.draw(line, behind=dot(direction, view.toward) < 0)
    p, q = scaled(view.direction(leg.before), _WIDE), scaled(view.direction(side), _WIDE)
    angle = leg.angle % (2 * math.pi)
    short = angle - min(0.25, angle / 2)
    for start, end, behind in _seen(leg.before, side, view.toward, short):
        arc = paths.arc(center, p, q, start, end)
        halo = () if behind else (Path(arc, paths.WHITE, 3.6),)
        notes.draw(*halo, Path(arc, paths.VARIABLE, 1.4), behind=behind)
    notes.draw(_head(center, p, q, angle, short), behind=_depth(leg.before, side, view.toward, angle) < 0)
    places = sorted(_PARTS, key=lambda part_of: _depth(leg.before, side, view.toward, angle * part_of) < 0)
    anchors = [paths.on_ellipse(center, p, q, angle * part_of) for part_of in places]
    notes.label(node, anchors, _from_to(center, anchors[0]), paths.VARIABLE, "variable")


def _depth(first: Vector, second: Vector, toward: Vector, t: float) -> float:
    """How near the viewer the point first·cos t + second·sin t is."""
    return dot(add(scale(first, math.cos(t)), scale(second, math.sin(t))), toward)


def _seen(first: Vector, second: Vector, toward: Vector, end: float) -> Iterator[tuple[float, float, bool]]:
    """The parts of the arc from 0 to `end` that lie in front of its middle, and those behind."""
    nearest = math.atan2(dot(second, toward), dot(first, toward))
    turns = (nearest + math.pi / 2 * (2 * k + 1) for k in range(-3, 4))
    places = [0.0, *sorted(t for t in turns if 0.0 < t < end), end]
    for a, b in pairwise(places):
        yield a, b, _depth(first, second, toward, (a + b) / 2) < -NEAR


def _ring(pose: Pose, part: JointBody, node: Node, notes: Notes) -> None:
    """An arrow around a joint's axis, in front of its cylinder, in the positive sense."""
    view = pose.view
    center = view.point(part.center)
    lean = dot(part.axis, view.toward)
    front = subtract(view.toward, scale(part.axis, lean))
    front = unit(front) if length(front) > 0.05 else unit(cross(part.axis, view.up))
    side = cross(part.axis, front)
    p, q = scaled(view.direction(front), _RING), scaled(view.direction(side), _RING)
    half = math.radians(105)
    arc = paths.arc(center, p, q, -half, half - 0.2)
    notes.draw(
        Path(arc, paths.WHITE, 3.6),
        Path(arc, paths.VARIABLE, 1.4),
        _head(center, p, q, half, half - 0.22),
    )
    anchors = [paths.on_ellipse(center, p, q, t) for t in (half, -half, half / 2, -half / 2, 0.0)]
    notes.label(node, anchors, _from_to(center, anchors[0]), paths.VARIABLE, "variable")
