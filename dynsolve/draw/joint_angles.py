"""The angles of revolute joints: each from the x axis before the joint to the one after it, about its axis.

Where the table adds degrees to a coordinate, its arrow ends that much before the x axis, and the rest is
drawn beyond it.  An angle stands about the origin on its axis; dashed lines show the directions that nothing
else shows there.  A negative angle q is drawn as -q the other way.  A robot with many rows has no room for
that: an arrow around each axis shows the sense of its angle.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from fractions import Fraction
from itertools import pairwise

from dynsolve.draw import paths
from dynsolve.draw.parts import RADIUS, JointBody
from dynsolve.draw.paths import Path
from dynsolve.draw.poses import ARC, MANY, Notes, Pose
from dynsolve.draw.skeleton import Leg, opposite, turned_alone, unsigned
from dynsolve.draw.vectors import (
    NEAR,
    Point,
    Vector,
    add,
    along,
    cross,
    distance,
    dot,
    from_to,
    length,
    moved,
    scale,
    scaled,
    subtract,
    unit,
)
from dynsolve.notation.tree import Degrees, Node, Symbol
from dynsolve.robot.model import JointType, Robot

_RING = 1.75 * RADIUS
_ARC = 31.0
_WIDER = 10.0
"""How much wider the arc of a further angle about the same point is."""

_SMALL = 0.3
"""A smaller angle in space is shown by its sense alone."""

_NO_ARC = 0.1
"""A smaller angle in a plane leaves no arc beside the head of its arrow."""

_BEYOND = 12.0
"""How far the lines of an angle reach beyond its arc."""

_PAST = 24.0
"""How much farther they reach in space where the table adds degrees to the angle, past their mark."""

_SQUARE, _INNER = 19.0, 24.0
"""The side of a right angle's mark, and the radius of the arc of another angle that the table adds."""

_CLEAR = 28.0
"""The side of that mark in space, which is not to lie on its joint's body alone."""

_ALIKE = 1 - 1e-6
"""The cosine from which two directions are one."""

_OFF_SHAFT = 3.0
"""How far from the axis at which an arc in space begins it is drawn over what lies under it."""

_PARTS = (0.5, 0.35, 0.65, 0.2, 0.8)
"""Where along an arc its name may stand, best first."""


def names_of_angles(robot: Robot) -> list[Node]:
    """What the arrow of each row shows: a coordinate, without the degrees beside it, or the whole column."""
    return [
        Symbol(name, star=True) if (name := turned_alone(robot, joint)) else unsigned(joint.written[0])
        for joint in robot.joints
    ]


def joint_angles(pose: Pose, names: Sequence[Node], notes: Notes) -> None:
    """The angle of every revolute joint."""
    for part, leg in _turning(pose):
        name = names[part.row - 1]
        if pose.view.flat:
            _flat_angle(pose, part, leg, name, notes)
        elif _has_ring(pose, leg):
            _ring(pose, part, leg, name, notes)
        else:
            _angle_in_space(pose, part, leg, name, notes)
    if len(pose.skeleton.legs) > MANY:
        notes.paths.extend(notes.tips)  # an arrow around an axis is not to cut the head of that axis


def _turning(pose: Pose) -> Iterator[tuple[JointBody, Leg]]:
    for part in pose.parts.joints:
        if part.type is JointType.REVOLUTE:
            yield part, pose.skeleton.legs[part.row - 1]


def parallels(robot: Robot, pose: Pose) -> list[tuple[str, int] | None]:
    """For every dashed line the axis that it is parallel to, ("x", 1), None where it is to none.

    That is an x axis at one end of the row, or where it is none of these the z axis after it.
    """
    found: list[tuple[str, int] | None] = []
    for part, leg in _turning(pose):
        if pose.view.flat or not _has_ring(pose, leg):
            row, parent = part.row, robot.joints[part.row - 1].parent
            axes = {("x", row): leg.after, ("x", parent): leg.before, ("z", row): pose.skeleton.frames[row].z}
            found += (
                next((name for name, axis in axes.items() if dot(axis, direction) > _ALIKE), None)
                for direction in _unseen(leg, _center(pose, part, leg), pose)
            )
    return found


def offsets(pose: Pose) -> list[float]:
    """What is drawn of some angles as a second part."""
    shown = [leg.offset for _, leg in _turning(pose) if pose.view.flat or not _has_ring(pose, leg)]
    return [offset for offset in shown if NEAR <= abs(offset) <= math.pi - NEAR]


def is_right(offset: float) -> bool:
    """Whether an angle is drawn as a square corner."""
    return abs(abs(offset) - math.pi / 2) < NEAR


def has_rings(pose: Pose) -> bool:
    """Whether some arrow shows no angle, but in which sense it grows."""
    return any(_has_ring(pose, leg) for _, leg in _turning(pose))


def _has_ring(pose: Pose, leg: Leg) -> bool:
    """Whether there is no room for an angle in space, or it is too small to be seen."""
    if pose.view.flat:
        return abs(leg.drawn) < _NO_ARC
    return len(pose.skeleton.legs) > MANY or abs(leg.drawn) < _SMALL


def _center(pose: Pose, part: JointBody, leg: Leg) -> Vector:
    """The origin on the axis of a joint; in space the joint itself, where another one stands there."""
    others = (other for other, _ in _turning(pose) if other is not part)
    is_free = all(distance(other.center, leg.center) > NEAR for other in others)
    return leg.center if is_free or pose.view.flat else part.center


def _unseen(leg: Leg, center: Vector, pose: Pose) -> Iterator[Vector]:
    """The directions of an angle that nothing else shows at its middle: no axis of a frame, and no link."""
    frames = [frame for frame in pose.skeleton.frames if distance(frame.origin, center) < NEAR]
    seen = [axis for frame in frames for axis in (frame.x, frame.z)]
    ways = [*pose.skeleton.links, *((b, a) for a, b in pose.skeleton.links)]
    seen += [unit(subtract(b, a)) for a, b in ways if distance(a, center) < NEAR < distance(a, b)]
    directions = [leg.before, leg.turned, *([leg.after] if leg.offset else [])]
    return (direction for direction in directions if all(dot(direction, way) < _ALIKE for way in seen))


def _shown(leg: Leg, name: Node) -> Node:
    """What the arrow of an angle shows: -q of a negative one, which is drawn in its own sense."""
    return name if leg.drawn > 0 else opposite(name)


# -- in a plane ------------------------------------------------------------------------------------


def _flat_angle(pose: Pose, part: JointBody, leg: Leg, node: Node, notes: Notes) -> None:
    """θ_i in the plane of the paper, turning as the joint's axis says."""
    view = pose.view
    center = view.point(leg.center)
    first = view.direction(leg.before)
    angle = leg.drawn if dot(leg.turned_about, view.toward) > 0 else -leg.drawn
    second = (first[1], -first[0])
    for direction in _unseen(leg, leg.center, pose):
        end = moved(center, view.direction(direction), _ARC + _BEYOND)
        notes.draw(Path(paths.line(center, end), paths.GREY, 0.9, dashed=True))
    _offset(leg.center, leg, pose, notes)
    if _has_ring(pose, leg):
        _ring(pose, part, leg, node, notes)
        return
    radius = (_ARC if abs(angle) > 0.5 else _ARC + 16.0) + _WIDER * _before_here(pose, part)
    p, q = scaled(first, radius), scaled(second, radius)
    short = angle - math.copysign(min(6.0 / radius, abs(angle) / 2), angle)
    notes.draw(
        Path(paths.arc(center, p, q, 0.0, short), paths.VARIABLE, 1.4), _head(center, p, q, angle, short)
    )
    middle = [paths.on_ellipse(center, p, q, angle * part_of) for part_of in _PARTS[:3]]
    notes.label(_shown(leg, node), middle, from_to(center, middle[0]), paths.VARIABLE, "variable")


def _offset(center: Vector, leg: Leg, pose: Pose, notes: Notes) -> None:
    """The part of θ_i that is a number of degrees: a right angle, or an arc with its size."""
    view, at = pose.view, pose.view.point(center)
    size = abs(leg.offset)
    if size < NEAR or size > math.pi - NEAR:
        return
    if is_right(size):
        corners = (leg.turned, add(leg.turned, leg.after), leg.after)
        wide = _SQUARE if view.flat else _CLEAR
        square = paths.line(*(moved(at, view.direction(corner), wide) for corner in corners))
        notes.draw(Path(square, paths.WHITE, 3.6), Path(square, paths.GREY, 1.2))
        return
    side = cross(leg.axis, leg.turned)
    p, q = scaled(view.direction(leg.turned), _INNER), scaled(view.direction(side), _INNER)
    notes.draw(Path(paths.arc(at, p, q, 0.0, leg.offset), paths.GREY, 1.0))
    middle = paths.on_ellipse(at, p, q, leg.offset / 2)
    degrees = Fraction(math.degrees(size)).limit_denominator(1000)
    node = Degrees(degrees.numerator, degrees.denominator)
    notes.label(node, [middle], from_to(at, middle), paths.GREY, "angle")


def _before_here(pose: Pose, part: JointBody) -> int:
    """How many joints before this one turn about the same point of the paper."""
    at = pose.view.point(part.center)
    others = (other for other in pose.parts.joints if other.row < part.row)
    return sum(math.dist(pose.view.point(other.center), at) < NEAR for other in others)


def _head(center: Point, p: Point, q: Point, end: float, short: float) -> Path:
    """The head of an arrow along an ellipse, its tip at `end`."""
    tip, before = paths.on_ellipse(center, p, q, end), paths.on_ellipse(center, p, q, short)
    return Path(paths.head(tip, from_to(before, tip), 8.0), None, fill=paths.VARIABLE)


# -- in space --------------------------------------------------------------------------------------


def _angle_in_space(pose: Pose, part: JointBody, leg: Leg, node: Node, notes: Notes) -> None:
    """θ_i around the joint's axis; what lies behind its middle is drawn before the joint."""
    view, middle = pose.view, _center(pose, part, leg)
    center = view.point(middle)
    side = scale(cross(leg.turned_about, leg.before), math.copysign(1.0, leg.drawn))
    reach = ARC + _BEYOND + (_PAST * bool(leg.offset))
    for direction in _unseen(leg, middle, pose):
        tip = view.point(along(middle, direction, view.space(reach)))
        line = Path(paths.line(center, tip), paths.GREY, 0.9, dashed=True)
        notes.draw(line, behind=dot(direction, view.toward) < 0)
    _offset(middle, leg, pose, notes)
    p, q = scaled(view.direction(leg.before), ARC), scaled(view.direction(side), ARC)
    angle = abs(leg.drawn)
    short = angle - min(0.25, angle / 2)
    for start, end, behind in _seen(leg.before, side, view.toward, short):
        if not behind:  # the white edge leaves the axis whole at which the arc begins
            clear = paths.arc(center, p, q, start or min(_OFF_SHAFT / ARC, end), end)
            notes.draw(Path(clear, paths.WHITE, 3.6))
        notes.draw(Path(paths.arc(center, p, q, start, end), paths.VARIABLE, 1.4), behind=behind)
    notes.draw(_head(center, p, q, angle, short), behind=_depth(leg.before, side, view.toward, angle) < 0)
    places = sorted(_PARTS, key=lambda part_of: _depth(leg.before, side, view.toward, angle * part_of) < 0)
    anchors = [paths.on_ellipse(center, p, q, angle * part_of) for part_of in places]
    notes.label(_shown(leg, node), anchors, from_to(center, anchors[0]), paths.VARIABLE, "variable")


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


def _ring(pose: Pose, part: JointBody, leg: Leg, node: Node, notes: Notes) -> None:
    """An arrow around a joint's axis, in front of its cylinder, in the sense in which its angle grows."""
    view = pose.view
    center = view.point(part.center)
    lean = dot(part.axis, view.toward)
    front = subtract(view.toward, scale(part.axis, lean))
    if view.flat:  # its ends leave room for the x axes
        front = scale(leg.before, -1.0)
    front = unit(front) if length(front) > 0.05 else unit(cross(part.axis, view.up))
    side = cross(leg.turned_about, front)
    p, q = scaled(view.direction(front), _RING), scaled(view.direction(side), _RING)
    half = math.radians(105)
    arc = paths.arc(center, p, q, -half, half - 0.2)
    notes.draw(
        Path(arc, paths.WHITE, 3.6),
        Path(arc, paths.VARIABLE, 1.4),
        _head(center, p, q, half, half - 0.22),
    )
    anchors = [paths.on_ellipse(center, p, q, t) for t in (half, -half, half / 2, -half / 2, 0.0)]
    notes.label(node, anchors, from_to(center, anchors[0]), paths.VARIABLE, "variable")
