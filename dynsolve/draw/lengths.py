"""Lengths: thin lines with two heads beside what they measure."""

from __future__ import annotations

import math
from dataclasses import dataclass

from dynsolve.draw import paths
from dynsolve.draw.annotate import Notes
from dynsolve.draw.occupied import Taken
from dynsolve.draw.paths import Path
from dynsolve.draw.pose import Pose
from dynsolve.draw.vectors import NEAR, Point, Vector, distance, moved, scaled
from dynsolve.notation.tree import Negative, Node
from dynsolve.robot.model import JointType, Robot

_OFFSETS = (24.0, -24.0, 34.0, -34.0, 46.0, -46.0, 60.0, -60.0)
"""How far beside what it measures a line may run, in picture units; below 0 on the lower side."""

_SHORT = 20.0
"""What is shorter has no room for two heads."""

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


def dimension(measured: Length, pose: Pose, notes: Notes) -> None:
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
    offset, crowded = _offset(a, b, along, across, notes.taken)
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


def _offset(a: Point, b: Point, along: Point, across: Point, taken: Taken) -> tuple[float, float]:
    """How far beside a length its line runs best, and how much of it then runs over other things."""

    def crowded(offset: float) -> float:
        p, q = moved(a, across, offset), moved(b, across, offset)
        return taken.on_line(moved(p, along, 3.0), moved(q, along, -3.0))

    def cost(offset: float) -> tuple[float, float]:
        return round(crowded(offset) * 250.0 + abs(offset) * 0.35 + (offset < 0) * 2.0, 6), offset

    best = min(_OFFSETS, key=cost)
    return best, crowded(best)
