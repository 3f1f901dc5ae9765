"""How thick the uniform bodies are: two arrows that point at a body from both sides, with what lies between.

A radius is shown by the diameter, 2r.  The length of a body along its link is written beside the robot, with
those of the table and of the mass centres.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

from dynsolve.algebra.compact.compactor import Compactor
from dynsolve.draw import paths
from dynsolve.draw.annotate import Notes
from dynsolve.draw.bodies import DrawnBody, Form
from dynsolve.draw.occupied import Box
from dynsolve.draw.paths import Path
from dynsolve.draw.pose import Pose
from dynsolve.draw.vectors import NEAR, Point, along, cross, dot, length, moved, scaled, unit
from dynsolve.draw.view import View
from dynsolve.notation.tree import Node
from dynsolve.robot.model import Robot

_TAIL, _HEAD = 15.0, 7.0
"""How long each of the arrows is, and its head."""

_LABEL = 26.0
"""The side of the square beyond an arrow in which its label is to have room."""

_PLACES = (-0.5, 0.5, -0.3, 0.3, -0.7, 0.7, -0.1, 0.1, -0.9, 0.9)
"""Where along a body its arrows may stand, as parts of half its length: off its ends and its middle first."""

_TURNS = tuple(math.pi * k / 8 for k in range(8))
"""The ways through a ball in which its diameter may be shown."""

_FACING = 0.5
"""A side that is foreshortened more is not shown."""


def thicknesses(robot: Robot, pose: Pose, notes: Notes) -> None:
    """The sides of every body across its length, each letter once."""
    shown: set[Node] = set()
    write = Compactor(robot.ring, decimal=True).form
    for body in pose.bodies:
        for axis, side in body.sides:
            name, ways = write(side), list(_ways(body, axis, pose.view))
            if ways and name not in shown:
                shown.add(name)
                p, q = min(ways, key=lambda way: _crowded(way[0], way[1], notes))
                _arrows(p, q, name, notes)


def _ways(body: DrawnBody, axis: int, view: View) -> Iterator[tuple[Point, Point]]:
    """The pairs of points on paper between which a side may be shown; none of one along the body."""
    halves = body.on_paper(view.size)
    is_box = body.form is Form.BOX
    lengthwise = max(range(3), key=lambda k: halves[k]) if is_box else body.main
    across = body.axes[axis] if is_box else cross(body.axes[body.main], view.toward)
    if body.form is Form.BALL or (axis != lengthwise and length(across) < NEAR):
        yield from _diameters(view.point(body.center), halves[axis])
    elif axis != lengthwise and math.hypot(*view.direction(unit(across))) > _FACING:
        half = scaled(view.direction(unit(across)), halves[axis])
        third = 3 - axis - lengthwise
        toward = dot(body.axes[third], view.toward)
        front = view.space(math.copysign(halves[third], toward)) if is_box else 0.0
        face = along(body.center, body.axes[third], front)
        for part in _PLACES:
            at = view.point(along(face, body.axes[lengthwise], view.space(part * halves[lengthwise])))
            yield moved(at, half, -1.0), moved(at, half, 1.0)


def _diameters(center: Point, radius: float) -> Iterator[tuple[Point, Point]]:
    """Through the middle of a circle."""
    for turn in _TURNS:
        way = math.cos(turn), math.sin(turn)
        yield moved(center, way, -radius), moved(center, way, radius)


def _outward(p: Point, q: Point) -> Point:
    reach = math.dist(p, q)
    return (p[0] - q[0]) / reach, (p[1] - q[1]) / reach


def _crowded(p: Point, q: Point, notes: Notes) -> tuple[int, int]:
    """How much is in the way of the arrows, and of a label at the freer one; and of one at the other."""
    out = _outward(p, q)
    tips = (p, out), (q, scaled(out, -1.0))
    tails = sum(notes.taken.cells_on(moved(tip, way, 4.0), moved(tip, way, _TAIL)) for tip, way in tips)
    rooms = (Box.around(moved(tip, way, _TAIL + _LABEL / 2), _LABEL, _LABEL) for tip, way in tips)
    taken = sorted(map(notes.taken.inside, rooms))
    return 4 * tails + taken[0], taken[1]


def _arrows(p: Point, q: Point, name: Node, notes: Notes) -> None:
    out = _outward(p, q)
    ends = []
    for tip, way in ((p, out), (q, scaled(out, -1.0))):
        ends.append(moved(tip, way, _TAIL))
        shaft = paths.line(ends[-1], moved(tip, way, _HEAD - 2.0))
        notes.draw(
            Path(shaft, paths.WHITE, 3.4),
            Path(shaft, paths.BLACK, 1.0),
            Path(paths.head(tip, scaled(way, -1.0), _HEAD), None, fill=paths.BLACK),
        )
    notes.label(name, ends, (0.0, 0.0), paths.BLACK, "length")
