"""Forces from outside: an arrow from the point where each acts, with its letter.

Its length says nothing of its size.  Moments are not drawn, nor forces whose direction depends on the pose.
"""

from __future__ import annotations

from collections.abc import Iterator

from dynsolve.algebra.ring import Expr
from dynsolve.draw import paths
from dynsolve.draw.labels import written
from dynsolve.draw.poses import MARK, Notes, Pose, is_toward, seen_end_on
from dynsolve.draw.skeleton import DrawnFrame, RobotNumbers, finite
from dynsolve.draw.vectors import NEAR, Vector, add, applied, length, moved, scale, unit
from dynsolve.notation.build import split_sign
from dynsolve.notation.tree import Node, Number
from dynsolve.quantities import letters
from dynsolve.robot.model import Robot
from dynsolve.robot.questions import Load

FORCES = "A green arrow is a force from outside, at the point where it acts."
MOMENTS = "Moments from outside are not drawn."
TURNING = "Forces from outside whose direction depends on the pose are not drawn."

_COLOUR = "#1b7f3b"
_REACH, _HEAD = 48.0, 11.0
"""How long an arrow is, and its head."""

_END_ON = 0.1
"""An arrow that is foreshortened more is seen end on."""


def forces(robot: Robot, numbers: RobotNumbers, pose: Pose, notes: Notes) -> None:
    """The arrow of every force; of one that is seen end on a point or a cross in a circle, beside."""
    for _, name, at, direction in drawn_forces(robot, numbers, pose):
        start = pose.view.point(at)
        x, y = pose.view.direction(direction)
        size = (x * x + y * y) ** 0.5
        if size < _END_ON:
            center = moved(start, (0.8, -0.6), 2.5 * MARK)
            seen_end_on(center, is_toward(direction, pose.view), notes, _COLOUR)
            notes.label(name, [center], (1.0, 0.0), _COLOUR, "force", MARK)
            continue
        way = x / size, y / size
        tip = moved(start, way, _REACH)
        back = moved(tip, way, -_HEAD + 2.0)
        notes.draw(*paths.arrow(start, back, tip, way, _COLOUR, 2.2, halo=4.6, size=_HEAD))
        notes.label(name, [tip, moved(start, way, _REACH / 2)], way, _COLOUR, "force")


def drawn_forces(
    robot: Robot, numbers: RobotNumbers, pose: Pose
) -> Iterator[tuple[Load, Node, Vector, Vector]]:
    """Each force that is drawn, its letter, its point and its direction in the picture."""
    for number, load in enumerate(robot.questions.loads, 1):
        frame = pose.skeleton.frames[load.link]
        if is_turning(load):
            continue
        try:
            direction = _direction(load, numbers, frame)
            position = _vector(load.position.entries, numbers)
        except (KeyError, ValueError, ZeroDivisionError):
            continue
        if length(direction) > NEAR:
            place = scale(position, 1 / numbers.unit)
            at = add(frame.origin, applied(frame.axes, place))
            yield load, _name(robot, load, number), at, unit(direction)


def is_turning(load: Load) -> bool:
    """Whether the direction of a force depends on the pose."""
    return any(entry.ring.depends_on_coordinates(entry) for entry in load.force.entries)


def _direction(load: Load, numbers: RobotNumbers, frame: DrawnFrame) -> Vector:
    """The force as it acts on the robot, with numbers for its letters."""
    force = load.force if load.axes is None else load.axes @ load.force
    given = _vector(force.entries, numbers)
    turned = given if load.axes is None else applied(frame.axes, given)
    return scale(turned, -1.0) if load.by_robot else turned


def _vector(entries: tuple[Expr, ...], numbers: RobotNumbers) -> Vector:
    x, y, z = (finite(entry, numbers.values) for entry in entries)
    return x, y, z


def _name(robot: Robot, load: Load, number: int) -> Node:
    """F, where that alone is the force; else 𝐅₁."""
    entries = [entry for entry in load.force.entries if not entry.is_zero]
    if len(entries) == 1:
        return split_sign(written(robot)(entries[0]))[1]
    return letters.bold("F", Number(number))
