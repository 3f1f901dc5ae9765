"""Lengths: thin lines with two heads beside what they measure.

The world in which the base is moved or leans: its frame, how far it is away, and by what angle.

A base that is only turned by right angles needs none: the arrow of gravity says which way is up.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from itertools import permutations, product

from msgspec import Struct

from dynsolve.algebra.angles import Angle
from dynsolve.draw import paths
from dynsolve.draw.labels import Box, Label, Wanted, place, written
from dynsolve.draw.paths import Path
from dynsolve.draw.poses import AXIS, Notes, Pose, world_axes
from dynsolve.draw.skeleton import RobotNumbers, opposite, unsigned
from dynsolve.draw.vectors import (
    IDENTITY,
    NEAR,
    ORIGIN,
    Point,
    Vector,
    View,
    along,
    cross,
    distance,
    dot,
    from_to,
    moved,
    scale,
    scaled,
    segment_distance,
    subtract,
    toward,
    unit,
)
from dynsolve.notation.tree import Degrees, Node, Symbol, Words
from dynsolve.quantities import letters
from dynsolve.robot.model import Convention, JointType, Robot

_AWAY = (24.0, 36.0, 48.0, 62.0, 78.0, 94.0, 110.0, 128.0)
"""How far beside what it measures a line may run, in picture units."""

_SLANTS = (0.0, math.radians(35), math.radians(-35))
_SLANTED = 400.0
"""By how much the way to it may lean, where links on both sides are in its way, and what that costs."""

_SHORT = 20.0
"""What is shorter has no room for two heads."""

_RESERVED = 60.0
"""What it costs to run through the place of a label, or its line, or the line of another length."""

_UNDER, _ACROSS, _HEAD = 12.0, 4.0, 8.0
"""What each cell costs that is taken under a length's line, under those to its ends, and under a head."""

_ON_LINK = 1000.0
"""What it costs to run over a link or a joint."""

_CUT = 60.0
"""What it costs to cut the head of an axis."""

_OVER = 30.0
"""What each cell costs of another length, or of the lines to its ends, that a length's line runs over."""

_BESIDE_END = 8.0
"""How near to the end of a length's line the lines to the ends of another may cross it."""

_CLOSE = 2.0
"""How near to a label a line may run."""

_CROWDED = 0.3
"""The part of its line from which a length that can be missed is left out."""


class Length(Struct, frozen=True):
    """A length from one point to another; an `optional` one is left out where it has no room."""

    start: Vector
    end: Vector
    node: Node
    varies: bool = False
    optional: bool = False


def row_lengths(robot: Robot, pose: Pose) -> list[Length]:
    """d and a of every row that has them; branches that begin with the same length share it."""
    found = []
    for joint, leg in zip(robot.joints, pose.skeleton.legs, strict=True):
        _, d, a, _ = joint.written
        if distance(leg.foot, leg.head) > NEAR:
            slides = joint.type is JointType.PRISMATIC
            found.append(_along(leg.axis, leg.foot, leg.head, d, varies=slides))
        if distance(leg.start, leg.foot) > NEAR:
            found.append(_along(leg.before, leg.start, leg.foot, a))
        elif distance(leg.head, leg.end) > NEAR:
            found.append(_along(leg.after, leg.head, leg.end, a))
    return list(dict.fromkeys(found))


def _along(axis: Vector, start: Vector, end: Vector, node: Node, *, varies: bool = False) -> Length:
    """A length that is positive as it is drawn: h - t of t - h where that leads back."""
    is_back = dot(subtract(end, start), axis) < 0
    return Length(start, end, opposite(node) if is_back else node, varies=varies)


def dimensions(found: Sequence[Length], pose: Pose, notes: Notes) -> None:
    """Draw lengths, the shortest nearest to what it measures, beside the places of the labels so far.

    The labels of mass centres may stand on any side, so they make way; that of a length has its place
    before the next is drawn.
    """

    def on_paper(measured: Length) -> float:
        return round(math.dist(pose.view.point(measured.start), pose.view.point(measured.end)), 6)

    wanted = [wanted for wanted in notes.wanted if wanted.kind != "mass"]
    reserved = _reserved(wanted, notes)
    for measured in sorted(found, key=on_paper):
        before = len(notes.wanted)
        line = _dimension(measured, pose, notes, reserved)
        reserved += _reserved(notes.wanted[before:], notes)
        if line:
            reserved.append(_Reserved(None, line))


class _Reserved(Struct, frozen=True):
    """The place of a label with the way to what it names, or with the line from afar; or a length's line."""

    box: Box | None
    line: tuple[Point, Point] | None

    def meets(self, line: tuple[Point, Point]) -> bool:
        """Whether a line runs through it."""
        in_box = self.box is not None and self.box.meets(*line)
        return in_box or (self.line is not None and segment_distance(self.line, line) < _CLOSE)


def _reserved(wanted: Sequence[Wanted], notes: Notes) -> list[_Reserved]:
    placed = zip(place(wanted, notes.taken), wanted, strict=True)
    return [_Reserved(_with_way(label, named), label.lead) for label, named in placed]


def _with_way(label: Label, wanted: Wanted) -> Box:
    """The place of a label with the way to what it names, which no line is to run between."""
    box = label.box.grown(_CLOSE)
    if label.lead:
        return box
    return box.holding(min(wanted.anchors, key=lambda anchor: math.dist(anchor, box.nearest(anchor))))


def _dimension(
    measured: Length, pose: Pose, notes: Notes, reserved: Sequence[_Reserved]
) -> tuple[Point, Point] | None:
    """Draw a length where least is in its way, and ask for its label; its line, but for its ends."""
    a, b = pose.view.point(measured.start), pose.view.point(measured.end)
    reach = math.dist(a, b)
    colour, kind = (paths.VARIABLE, "variable") if measured.varies else (paths.BLACK, "length")
    if reach < _SHORT:
        if not measured.optional:
            middle = (a[0] + b[0]) / 2, (a[1] + b[1]) / 2
            notes.label(measured.node, [middle], (0.0, 0.0), colour, kind)
        return None
    along = toward(a, b)
    shift, crowded = _shift(a, b, along, notes, reserved)
    if measured.optional and crowded > _CROWDED:
        return None
    p, q = moved(a, shift, 1.0), moved(b, shift, 1.0)
    from_ends = _from_ends(a, b, shift)
    shaft = paths.line(moved(p, along, 5.0), moved(q, along, -5.0))
    notes.draw(
        *(Path(paths.line(*line), paths.GREY, 0.7) for line in from_ends),
        Path(shaft, paths.WHITE, 3.4),
        Path(shaft, colour, 1.0),
        Path(paths.head(p, scaled(along, -1.0), 7.5), None, fill=colour),
        Path(paths.head(q, along, 7.5), None, fill=colour),
    )
    for line in ((p, q), *from_ends):
        notes.lengths.add_line(*line)
    anchors = [moved(p, along, reach * part) for part in (0.5, 0.35, 0.65, 0.2, 0.8)]
    notes.label(measured.node, anchors, shift, colour, kind)
    return moved(p, along, _BESIDE_END), moved(q, along, -_BESIDE_END)


def _shift(
    a: Point, b: Point, along: Point, notes: Notes, reserved: Sequence[_Reserved]
) -> tuple[Point, float]:
    """How far beside a length its line runs best, and how much of it then runs over other things."""
    taken = notes.taken

    def crowded(shift: Point) -> float:
        p, q = moved(a, shift, 1.0), moved(b, shift, 1.0)
        return taken.on_line(moved(p, along, 3.0), moved(q, along, -3.0))

    def cost(shift: Point) -> float:
        p, q = moved(a, shift, 1.0), moved(b, shift, 1.0)
        from_ends = _from_ends(a, b, shift)
        in_places = sum(place.meets(line) for place in reserved for line in ((p, q), *from_ends))
        under = _UNDER * taken.cells_on(p, q) + _ACROSS * sum(taken.cells_on(*line) for line in from_ends)
        heads = sum(taken.inside(Box.around(at, 6.0, 6.0)) for at in (p, q))
        on_link = _ON_LINK if notes.solid.cells_on(p, q) else 0.0
        cut = _CUT * bool(notes.heads.cells_on(p, q))
        over = _OVER * notes.lengths.cells_on(p, q)
        return 250.0 * crowded(shift) + _RESERVED * in_places + under + _HEAD * heads + on_link + over + cut

    tried = [(round(cost(shift) + price, 6), k, shift) for k, (shift, price) in enumerate(_shifts(along))]
    best = min(tried)[-1]
    return best, crowded(best)


def _shifts(along: Point) -> Iterator[tuple[Point, float]]:
    """Where a line may run beside a length, and what it costs: best near, above, and straight across."""
    upper = along[0] > 0 or (along[0] == 0 and along[1] > 0)
    across = (along[1], -along[0]) if upper else (-along[1], along[0])
    for away in _AWAY:
        for side in (1.0, -1.0):
            for slant in _SLANTS:
                c, s = math.cos(slant), math.sin(slant)
                out = across[0] * c - across[1] * s, across[0] * s + across[1] * c
                price = 0.35 * away + 2.0 * (side < 0) + _SLANTED * (slant != 0)
                yield scaled(out, side * away), price


def _from_ends(a: Point, b: Point, shift: Point) -> list[tuple[Point, Point]]:
    """The thin lines from the ends of what is measured to those of its line, and a little beyond."""
    away = math.hypot(*shift)
    return [(moved(at, shift, 8.0 / away), moved(at, shift, 1.0 + 4.0 / away)) for at in (a, b)]


# The world in which the base is moved or leans

_LEAN, _BEYOND = 62.0, 12.0
"""The radius of the arc of the angle by which the base leans, and how far its lines reach beyond it."""

_ALONG = 0.9
"""The cosine from which an axis is seen end on."""

_WORLD_FRAME_HEAD = 6.0
"""The head of that arc, which shows the sense."""

_PARTS = (0.5, 0.35, 0.65)
"""Where along that arc its name may stand."""

TWISTS = "A black arc is the angle between two axes, from a grey line parallel to the first."
WORLD = "The frame of the world has the index w."
ASIDE = "It is drawn beside the arm, and begins at 𝐨₀."
SAME = "Frame 0 is that of the world."


def has_world(robot: Robot, numbers: RobotNumbers) -> bool:
    """Whether the base is moved, or leans by other than right angles."""
    entries = [abs(entry) for column in numbers.base for entry in column]
    leans = any(NEAR < entry < 1.0 - NEAR for entry in entries)
    return leans or not robot.base_position.is_zero


def is_aside(robot: Robot, numbers: RobotNumbers, drawn: bool) -> bool:
    """Whether the directions of the world are to be shown, and no move or single turn of the base shows them.

    Those of a robot that is `drawn` are, where frame 0 has others.
    """
    leans = has_world(robot, numbers) or (drawn and numbers.base != IDENTITY)
    return leans and numbers.moved == ORIGIN and len(robot.base_turns) != 1


def world_frame(robot: Robot, numbers: RobotNumbers, pose: Pose, notes: Notes) -> tuple[Path, ...]:
    """The axes of the world and the angle of the base; the lines that lie under all else."""
    if numbers.moved != ORIGIN:
        at = pose.view.point(scale(numbers.moved, -1.0))
        world_axes(at, Words("w"), pose.view, AXIS, notes)
    _lean(robot, numbers, pose, notes)
    points = [pose.view.point(corner) for corner in _corners(numbers)]
    way = Path(paths.line(*points), paths.GREY, 1.0, dashed=True)
    ways = () if numbers.moved == ORIGIN else (way,)
    notes.taken.add(ways)
    return ways


def moves(robot: Robot, numbers: RobotNumbers) -> list[Length]:
    """How far frame 0 is moved along each axis of the world."""
    form = written(robot)
    corners = _corners(numbers)
    return [
        Length(start, end, unsigned(form(entry)))
        for start, end, entry in zip(corners, corners[1:], robot.base_position.entries, strict=False)
        if start != end
    ]


def _corners(numbers: RobotNumbers) -> list[Vector]:
    """The world's origin, and where the moves along x, y and z lead to from there."""
    at = [scale(numbers.moved, -1.0)]
    for axis, amount in zip(IDENTITY, numbers.moved, strict=True):
        at.append(along(at[-1], axis, amount))
    return at


def _lean(robot: Robot, numbers: RobotNumbers, pose: Pose, notes: Notes) -> None:
    """The angle of a base that is turned about one axis: from an axis of the world to that of frame 0."""
    if len(robot.base_turns) != 1:
        return
    ((letter, node),) = robot.base_turns
    turned = 0 if letter == "z" else 2
    first, second = IDENTITY[turned], numbers.base[turned]
    side = cross(IDENTITY["xyz".index(letter)], first)
    size = math.atan2(dot(second, side), dot(second, first))
    if abs(math.sin(2 * size)) < NEAR:
        return
    angle_between(ORIGIN, first, side, size, node, pose.view, notes)
    if numbers.moved == ORIGIN:
        name = letters.bold("xyz"[turned], Words("w"))
        tip = pose.view.point(along(ORIGIN, first, pose.view.space(_LEAN + _BEYOND)))
        notes.label(name, [tip], pose.view.direction(first), paths.GREY, "axis")


def angle_between(
    vertex: Vector, first: Vector, side: Vector, size: float, node: Node, view: View, notes: Notes
) -> None:
    """An angle from a direction towards a side of it, without its sign, with the lines that it is between."""
    at = view.point(vertex)
    second = along(scale(first, math.cos(size)), side, math.sin(size))
    for direction in (first, second):
        end = view.point(along(vertex, direction, view.space(_LEAN + _BEYOND)))
        notes.draw(Path(paths.line(at, end), paths.GREY, 0.9), behind=True)
    p, q = scaled(view.direction(first), _LEAN), scaled(view.direction(side), _LEAN)
    arc = paths.arc(at, p, q, 0.0, size)
    tip, before = (paths.on_ellipse(at, p, q, size * part) for part in (1.0, 0.8))
    head = paths.head(tip, from_to(before, tip), _WORLD_FRAME_HEAD)
    notes.draw(Path(arc, paths.WHITE, 3.6), Path(arc, paths.BLACK, 1.1), Path(head, None, fill=paths.BLACK))
    anchors = [paths.on_ellipse(at, p, q, size * part) for part in _PARTS]
    name = Degrees(abs(node.p), node.q) if isinstance(node, Degrees) else unsigned(node)
    notes.label(name, anchors, from_to(at, anchors[0]), paths.BLACK, "angle")


def twists(robot: Robot, pose: Pose, frames: bool = True) -> list[tuple[Vector, Vector, Vector, float, Node]]:
    """The angles of a table that joints do not turn, but for right angles, as `angle_between` has them.

    That is α between the z axes and, with `frames`, θ between the x axes of a row that is no revolute joint.
    """
    found = list[tuple[Vector, Vector, Vector, float, Node]]()
    for joint, leg in zip(robot.joints, pose.skeleton.legs, strict=True):
        about = leg.after if robot.convention is Convention.STANDARD else leg.before
        before, after = (pose.skeleton.frames[k] for k in (joint.parent, joint.index))
        pairs = [(before.z, after.z, about, joint.written[3])]
        if frames and joint.variable != "theta":
            pairs.append((leg.before, leg.after, leg.axis, joint.written[0]))
        for first, second, axis, node in pairs:
            side = cross(axis, first)
            size = math.atan2(dot(second, side), dot(second, first))
            if abs(math.sin(2 * size)) > NEAR:
                found.append((after.origin, first, side, size, node))
    return found


def tilt(robot: Robot, gravity: Vector, view: View, notes: Notes) -> None:
    """The angle that gravity has to the axes of frame 0, along which g sin β and g cos β pull.

    The first is β off level, and that is drawn in a plane; in space z_0, where it is the second, and so β
    off upright.
    """
    ring, pulls = robot.ring, list(zip(IDENTITY, robot.gravity.entries, strict=True))
    if robot.base_turns or sum(pull.is_zero for _, pull in pulls) != 1:
        return
    angles = [(Symbol(name), Angle.of(name)) for name in robot.parameters]
    known = [(node, angle) for node, angle in angles if any(angle == pair.angle for pair in ring.pairs)]
    both = permutations([one for one in pulls if not one[1].is_zero], 2)
    for ((first, pull), (second, other)), (node, angle) in product(both, known):
        along_axis, across = pull * ring.cos(angle), other * ring.sin(angle)
        if along_axis not in (across, -across):
            continue
        axis, start = second, scale(gravity, math.copysign(1.0, dot(second, gravity)))
        if view.flat:
            axis, start = first, unit(subtract(first, scale(gravity, dot(first, gravity))))
        if axis == IDENTITY[2] or (view.flat and abs(dot(axis, view.toward)) < _ALONG):
            side = unit(subtract(axis, scale(start, dot(axis, start))))
            angle_between(ORIGIN, start, side, math.acos(dot(axis, start)), node, view, notes)
        return
