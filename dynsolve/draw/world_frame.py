"""The world in which the base is moved or leans: its frame, how far it is away, and by what angle.

A base that is only turned by right angles needs none: the arrow of gravity says which way is up.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

from dynsolve.algebra.compact.compactor import Compactor
from dynsolve.draw import paths
from dynsolve.draw.annotate import MARK, Notes, axis_arrow, axis_end_on
from dynsolve.draw.drawn_lengths import RobotNumbers
from dynsolve.draw.lengths import Length, unsigned
from dynsolve.draw.paths import Path
from dynsolve.draw.pose import Pose
from dynsolve.draw.vectors import (
    IDENTITY,
    NEAR,
    ORIGIN,
    Vector,
    along,
    cross,
    dot,
    scale,
    scaled,
)
from dynsolve.notation.tree import Degrees, Node, Words
from dynsolve.quantities import letters
from dynsolve.robot.model import Robot

_LEAN, _BEYOND = 62.0, 12.0
"""The radius of the arc of the angle by which the base leans, and how far its lines reach beyond it."""

_HEAD = 6.0
"""The head of that arc, which shows the sense."""

_PARTS = (0.5, 0.35, 0.65)
"""Where along that arc its name may stand."""

WORLD = "The frame of the world has the index w."


def has_world(robot: Robot, numbers: RobotNumbers) -> bool:
    """Whether the base is moved, or leans by other than right angles."""
    entries = [abs(entry) for column in numbers.base for entry in column]
    leans = any(NEAR < entry < 1.0 - NEAR for entry in entries)
    return leans or not robot.base_position.is_zero


def world_frame(robot: Robot, numbers: RobotNumbers, pose: Pose, notes: Notes) -> tuple[Path, ...]:
    """The axes of the world and the angle of the base; the lines that lie under all else."""
    if numbers.moved != ORIGIN:
        _axes(scale(numbers.moved, -1.0), pose, notes)
    _lean(robot, numbers, pose, notes)
    way = tuple(_way(numbers, pose))
    notes.taken.add(way)
    return way


def moves(robot: Robot, numbers: RobotNumbers) -> list[Length]:
    """How far frame 0 is moved along each axis of the world."""
    compactor = Compactor(robot.ring, decimal=True)
    corners = _corners(numbers)
    return [
        Length(start, end, unsigned(compactor.form(entry)))
        for start, end, entry in zip(corners, corners[1:], robot.base_position.entries, strict=False)
        if start != end
    ]


def _corners(numbers: RobotNumbers) -> list[Vector]:
    """The world's origin, and where the moves along x, y and z lead to from there."""
    at = [scale(numbers.moved, -1.0)]
    for axis, amount in zip(IDENTITY, numbers.moved, strict=True):
        at.append(along(at[-1], axis, amount))
    return at


def _way(numbers: RobotNumbers, pose: Pose) -> Iterator[Path]:
    points = [pose.view.point(corner) for corner in _corners(numbers)]
    if numbers.moved != ORIGIN:
        yield Path(paths.line(*points), paths.GREY, 1.0, dashed=True)


def _axes(origin: Vector, pose: Pose, notes: Notes) -> None:
    """The frame of the world."""
    at = pose.view.point(origin)
    for letter, axis in zip("xyz", IDENTITY, strict=True):
        tip = axis_arrow(at, axis, pose, notes)
        if tip == at:
            axis_end_on(at, dot(axis, pose.view.toward) > 0, notes)
        toward = tip[0] - at[0], tip[1] - at[1]
        radius = MARK if tip == at else 0.0
        notes.label(letters.bold(letter, Words("w")), [tip], toward, paths.FRAME, "axis", radius)


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
    view, at = pose.view, pose.view.point(ORIGIN)
    for direction in (first, second):
        end = view.point(along(ORIGIN, direction, view.space(_LEAN + _BEYOND)))
        notes.draw(Path(paths.line(at, end), paths.GREY, 0.9), behind=True)
    p, q = scaled(view.direction(first), _LEAN), scaled(view.direction(side), _LEAN)
    arc = paths.arc(at, p, q, 0.0, size)
    tip, before = (paths.on_ellipse(at, p, q, size * part) for part in (1.0, 0.8))
    head = paths.head(tip, (tip[0] - before[0], tip[1] - before[1]), _HEAD)
    notes.draw(Path(arc, paths.WHITE, 3.6), Path(arc, paths.BLACK, 1.1), Path(head, None, fill=paths.BLACK))
    anchors = [paths.on_ellipse(at, p, q, size * part) for part in _PARTS]
    toward = anchors[0][0] - at[0], anchors[0][1] - at[1]
    notes.label(_size_of(node), anchors, toward, paths.BLACK, "angle")
    if numbers.moved == ORIGIN:
        name = letters.bold("xyz"[turned], Words("w"))
        tip = view.point(along(ORIGIN, first, view.space(_LEAN + _BEYOND)))
        notes.label(name, [tip], view.direction(first), paths.GREY, "axis")


def _size_of(node: Node) -> Node:
    """An angle without the sign that says which way it is turned."""
    return Degrees(abs(node.p), node.q) if isinstance(node, Degrees) else unsigned(node)
