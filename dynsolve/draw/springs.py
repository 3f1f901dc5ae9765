"""Springs at joints: a spiral about the axis of one that turns, a zigzag beside one that slides."""

from __future__ import annotations

import math
from collections.abc import Iterator

from dynsolve.algebra.compact.compactor import Compactor
from dynsolve.draw import paths
from dynsolve.draw.annotate import Notes
from dynsolve.draw.drawn_lengths import RobotNumbers, finite
from dynsolve.draw.parts import RADIUS, JointBody
from dynsolve.draw.paths import Path
from dynsolve.draw.pose import Pose
from dynsolve.draw.vectors import NEAR, Point, Vector, add, along, cross, moved, scale
from dynsolve.draw.view import View
from dynsolve.notation.tree import Node
from dynsolve.robot.actions import Elastic
from dynsolve.robot.model import JointType, Robot

SPRINGS = "A spiral or a zigzag at a joint is a spring."
OTHER_SPRINGS = "Springs on other than one joint, or given by their energy, are not drawn."
NO_DAMPERS = "Dampers are not drawn."

_INNER, _OUTER, _TURNS = RADIUS + 1.0, RADIUS + 13.0, 1.75
_STEPS = 72
_BESIDE, _HALF, _ENDS, _TOOTH, _LONGEST = 22.0, 6.0, 10.0, 6.0, 96.0
"""Of a zigzag: how far beside its joint it runs, half its width, its ends, half its period, all its teeth."""


def joint_springs(robot: Robot, numbers: RobotNumbers, pose: Pose) -> list[tuple[JointBody, Elastic]]:
    """The linear springs that act on the coordinate of just one joint, with that joint."""
    found = []
    for spring in robot.actions.springs:
        if spring.law is None:
            continue
        stretched = {k for k, q in enumerate(robot.coordinates) if _rate(spring.law, q.name, numbers) > NEAR}
        rows = [joint.index for joint in robot.joints if {k for k, _ in joint.rates} & stretched]
        found += [(part, spring.law) for part in pose.parts.joints if rows == [part.row]]
    return found


def _rate(law: Elastic, coordinate: str, numbers: RobotNumbers) -> float:
    """How much the form that a spring is given by grows with a coordinate, without its sign."""
    return abs(finite(law.of, {**numbers.values, coordinate: 1.0}) - finite(law.of, numbers.values))


def springs(robot: Robot, numbers: RobotNumbers, pose: Pose, notes: Notes) -> None:
    """Every such spring with its stiffness."""
    for part, law in joint_springs(robot, numbers, pose):
        name = Compactor(robot.ring, decimal=True).form(law.stiffness)
        if part.type is JointType.REVOLUTE:
            draw_spring(spiral(part.center, part.axis, pose.view), name, notes)
        else:
            leg = pose.skeleton.legs[part.row - 1]
            draw_spring(zigzag(pose.view.point(leg.foot), pose.view.point(leg.head), _BESIDE), name, notes)


def draw_spring(points: Iterator[Point], name: Node, notes: Notes) -> None:
    """A spring along its points, and its stiffness."""
    line = list(points)
    path = paths.line(*line)
    notes.draw(Path(path, paths.WHITE, 3.0), Path(path, paths.BLACK, 1.2))
    notes.label(name, line[:: len(line) // 6], (0.0, 0.0), paths.BLACK, "spring")


def spiral(center: Vector, axis: Vector, view: View, inner: float = _INNER) -> Iterator[Point]:
    """Round an axis, outwards."""
    across = cross(axis, view.toward)
    first = view.right if math.hypot(*view.direction(across)) < NEAR else across
    second = cross(axis, first)
    for k in range(_STEPS + 1):
        t = math.pi + 2 * math.pi * _TURNS * k / _STEPS
        radius = view.space(inner + (_OUTER - _INNER) * k / _STEPS)
        direction = add(scale(first, math.cos(t)), scale(second, math.sin(t)))
        yield view.point(along(center, direction, radius))


def zigzag(a: Point, b: Point, beside: float) -> Iterator[Point]:
    """From a point to another, that far beside the line between them."""
    reach = math.dist(a, b) or 1.0
    way = (b[0] - a[0]) / reach, (b[1] - a[1]) / reach
    across = -way[1], way[0]
    ends = max(min(_ENDS, reach / 4), (reach - _LONGEST) / 2)
    teeth = max(2, round((reach - 2 * ends) / _TOOTH))
    start = moved(a, across, beside)
    yield from (a, start, moved(start, way, ends))
    for k in range(teeth):
        corner = moved(start, way, ends + (reach - 2 * ends) * (k + 0.5) / teeth)
        yield moved(corner, across, _HALF if k % 2 else -_HALF)
    yield from (moved(start, way, reach - ends), moved(start, way, reach), b)
