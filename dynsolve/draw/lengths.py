"""Lengths: thin lines with two heads beside what they measure."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from dynsolve.draw import paths
from dynsolve.draw.annotate import Notes
from dynsolve.draw.labels import Label, Wanted, place
from dynsolve.draw.occupied import Box, Taken
from dynsolve.draw.paths import Path
from dynsolve.draw.pose import Pose
from dynsolve.draw.vectors import NEAR, Point, Vector, distance, moved, scaled
from dynsolve.notation.tree import Negative, Node
from dynsolve.robot.model import JointType, Robot

_OFFSETS = tuple(side * away for away in (24.0, 36.0, 48.0, 62.0, 78.0, 94.0) for side in (1.0, -1.0))
"""How far beside what it measures a line may run, in picture units; below 0 on the lower side."""

_SHORT = 20.0
"""What is shorter has no room for two heads."""

_LABEL = 60.0
"""What it costs to run through the place of a label."""

_UNDER, _ACROSS, _HEAD = 12.0, 4.0, 8.0
"""What each cell costs that is taken under a length's line, under those to its ends, and under a head."""

_CLOSE = 2.0
"""How near to a label a line may run."""

_CROWDED = 0.3
"""The part of its line from which a length that can be missed is left out."""


@dataclass(frozen=True, slots=True)
class Length:
    """A length from one point to another; an `optional` one is left out where it has no room."""

    start: Vector
    end: Vector
    node: Node
    varies: bool = False
    optional: bool = False


def row_lengths(robot: Robot, pose: Pose) -> list[Length]:
    """d and a of every row that has them."""
    found = []
    for joint, leg in zip(robot.joints, pose.skeleton.legs, strict=True):
        _, d, a, _ = joint.written
        if distance(leg.foot, leg.head) > NEAR:
            slides = joint.type is JointType.PRISMATIC
            found.append(Length(leg.foot, leg.head, d if slides else unsigned(d), varies=slides))
        start, end = (leg.start, leg.foot) if distance(leg.start, leg.foot) > NEAR else (leg.head, leg.end)
        if distance(start, end) > NEAR:
            found.append(Length(start, end, unsigned(a)))
    return found


def unsigned(node: Node) -> Node:
    """A length without the sign that says only which way it is measured."""
    return node.argument if isinstance(node, Negative) else node


def dimensions(found: Sequence[Length], pose: Pose, notes: Notes) -> None:
    """Draw lengths, the shortest nearest to what it measures, beside the places of the labels so far.

    The labels of mass centres may stand on any side, so they make way.
    """

    def on_paper(measured: Length) -> float:
        return round(math.dist(pose.view.point(measured.start), pose.view.point(measured.end)), 6)

    wanted = [wanted for wanted in notes.wanted if wanted.kind != "mass"]
    placed = place(wanted, notes.taken)
    reserved = [_reserved(label, named) for label, named in zip(placed, wanted, strict=True)]
    for measured in sorted(found, key=on_paper):
        dimension(measured, pose, notes, reserved)


def _reserved(label: Label, wanted: Wanted) -> Box:
    """The place of a label with the way to what it names, which no line is to run between."""
    box = label.box.grown(_CLOSE)
    if label.lead:
        return box
    return box.holding(min(wanted.anchors, key=lambda anchor: math.dist(anchor, box.nearest(anchor))))


def dimension(measured: Length, pose: Pose, notes: Notes, reserved: Sequence[Box] = ()) -> None:
    """Draw a length where least is in its way, and ask for its label."""
    a, b = pose.view.point(measured.start), pose.view.point(measured.end)
    reach = math.dist(a, b)
    colour, kind = (paths.VARIABLE, "variable") if measured.varies else (paths.BLACK, "length")
    if reach < _SHORT:
        if not measured.optional:
            middle = (a[0] + b[0]) / 2, (a[1] + b[1]) / 2
            notes.label(measured.node, [middle], (0.0, 0.0), colour, kind)
        return
    along = (b[0] - a[0]) / reach, (b[1] - a[1]) / reach
    across = (
        (along[1], -along[0]) if along[0] > 0 or (along[0] == 0 and along[1] > 0) else (-along[1], along[0])
    )
    offset, crowded = _offset(a, b, along, across, notes.taken, reserved)
    if measured.optional and crowded > _CROWDED:
        return
    p, q = moved(a, across, offset), moved(b, across, offset)
    side = math.copysign(1.0, offset)
    shaft = paths.line(moved(p, along, 5.0), moved(q, along, -5.0))
    notes.draw(
        *(
            Path(
                paths.line(moved(at, across, side * 8.0), moved(at, across, offset + side * 4.0)),
                paths.GREY,
                0.7,
            )
            for at in (a, b)
        ),
        Path(shaft, paths.WHITE, 3.4),
        Path(shaft, colour, 1.0),
        Path(paths.head(p, scaled(along, -1.0), 7.5), None, fill=colour),
        Path(paths.head(q, along, 7.5), None, fill=colour),
    )
    anchors = [moved(p, along, reach * part) for part in (0.5, 0.35, 0.65, 0.2, 0.8)]
    notes.label(measured.node, anchors, scaled(across, side), colour, kind)


def _offset(
    a: Point, b: Point, along: Point, across: Point, taken: Taken, reserved: Sequence[Box]
) -> tuple[float, float]:
    """How far beside a length its line runs best, and how much of it then runs over other things."""

    def crowded(offset: float) -> float:
        p, q = moved(a, across, offset), moved(b, across, offset)
        return taken.on_line(moved(p, along, 3.0), moved(q, along, -3.0))

    def cost(offset: float) -> tuple[float, float]:
        p, q = moved(a, across, offset), moved(b, across, offset)
        side = math.copysign(1.0, offset)
        from_ends = [(moved(at, across, side * 8.0), moved(at, across, offset + side * 4.0)) for at in (a, b)]
        in_labels = sum(box.meets(*line) for box in reserved for line in ((p, q), *from_ends))
        under = _UNDER * taken.cells_on(p, q) + _ACROSS * sum(taken.cells_on(*line) for line in from_ends)
        heads = sum(taken.inside(Box.around(at, 6.0, 6.0)) for at in (p, q))
        total = 250.0 * crowded(offset) + 0.35 * abs(offset) + 2.0 * (offset < 0)
        return round(total + _LABEL * in_labels + under + _HEAD * heads, 6), offset

    best = min(_OFFSETS, key=cost)
    return best, crowded(best)
