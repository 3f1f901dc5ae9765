"""The drawing that a table was found from: its pose, and the letters by which its points are given."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from itertools import accumulate, permutations

from dynsolve.algebra.compact.compactor import Compactor
from dynsolve.algebra.ring import Expr
from dynsolve.derivation.drawn_motion import drawn_coordinates
from dynsolve.draw import paths
from dynsolve.draw.lengths import Length
from dynsolve.draw.paths import Path
from dynsolve.draw.placed_pose import Place, straight_parts
from dynsolve.draw.poses import Pose
from dynsolve.draw.skeleton import RobotNumbers, finite
from dynsolve.draw.vectors import NEAR, ORIGIN, Vector, add, between, distance, dot, subtract
from dynsolve.notation.tree import Node, Symbol
from dynsolve.problem.model import Problem
from dynsolve.robot.drawing.normals import Normals
from dynsolve.robot.model import JointType, Robot

SLIDE = 0.9
"""How far out a slide is drawn whose letter stands in a drawing."""

_NEAR, _MOST = 1e-3, 5
"""How near a point of the picture is to where it is given; with more parts a way is taken as it is."""


_Part = tuple[Expr | None, Vector]


def as_drawn(problem: Problem, values: RobotNumbers) -> list[float] | None:
    """The pose of the drawing that a table was found from, in picture lengths; None of a table."""
    if problem.normals is None:
        return None
    robot = problem.robot
    try:
        drawn = drawn_coordinates(problem.normals, _values(robot, problem.normals, values))
    except (ValueError, ZeroDivisionError):
        return None
    units = (values.unit if q.type is JointType.PRISMATIC else 1.0 for q in robot.coordinates)
    return [drawn[q.name] / unit for q, unit in zip(robot.coordinates, units, strict=True)]


def _values(robot: Robot, normals: Normals, values: RobotNumbers) -> dict[str, float]:
    """The value of every letter of a drawing."""
    others = dict.fromkeys(normals.drawing.ring.parameters, values.unit)
    slides = {q.name: SLIDE * values.unit for q in robot.coordinates if q.type is JointType.PRISMATIC}
    return {**others, **values.values, **slides}


def given_lengths(problem: Problem, numbers: RobotNumbers, pose: Pose, shown: list[Node]) -> list[Length]:
    """The letters by which the points of a drawing are given, but for those that are `shown`, each once.

    They lead along straight ways from the world's origin, where the base is, from point to point.
    """
    if problem.normals is None or numbers.moved != ORIGIN:
        return []
    drawing = problem.normals.drawing
    values = _values(problem.robot, problem.normals, numbers)

    def in_picture(place: Place) -> Vector:
        x, y, z = (finite(entry, values) / numbers.unit for entry in place)
        return x, y, z

    if distance(in_picture(_place(drawing.hand.at.entries)), pose.skeleton.frames[-1].origin) > _NEAR:
        return []
    form = Compactor(drawing.ring).form
    names = {node.name for node in shown if isinstance(node, Symbol)}
    found, at = list[Length](), ORIGIN
    for way in _ways(problem.normals):
        parts = [(size, in_picture(part)) for size, part in straight_parts(drawing.ring, way)]
        for size, part in _on_arm(at, parts, pose):
            start, at = at, add(at, part)
            name = None if size is None else form(size)
            if isinstance(name, Symbol) and name.name not in names:
                names.add(name.name)
                found.append(Length(start, at, name))
    return found


def ways_beside(found: Iterable[Length], pose: Pose) -> Iterator[Path]:
    """Dashed lines where lengths lead that lie on no link."""
    for each in found:
        if off_links(between(each.start, each.end, 0.5), pose) > _NEAR:
            ends = pose.view.point(each.start), pose.view.point(each.end)
            yield Path(paths.line(*ends), paths.GREY, 0.9, dashed=True)


def _on_arm(at: Vector, parts: Sequence[_Part], pose: Pose) -> Sequence[_Part]:
    """The parts of a way in the order in which its corners are nearest to the links."""

    def off(order: Sequence[_Part]) -> float:
        corners = accumulate((part for _, part in order), add, initial=at)
        return round(sum(off_links(corner, pose) for corner in corners), 6)

    return min(permutations(parts), key=off) if len(parts) <= _MOST else parts


def off_links(point: Vector, pose: Pose) -> float:
    """How far a point is from the chain of the links."""

    def off(a: Vector, b: Vector) -> float:
        way = subtract(b, a)
        part = dot(subtract(point, a), way) / max(dot(way, way), NEAR)
        return distance(point, between(a, b, min(1.0, max(0.0, part))))

    return min((off(a, b) for a, b in pose.skeleton.links), default=0.0)


def _ways(normals: Normals) -> Iterator[Place]:
    """From the world's origin to the point of the first axis that has one, and on to the hand."""
    drawing = normals.drawing
    points = [axis.line.point for axis in drawing.axes if axis.is_placed] + [drawing.hand.at]
    at = points[0] - points[0]
    for point in points:
        yield _place((point - at).entries)
        at = point


def _place(entries: tuple[Expr, ...]) -> Place:
    x, y, z = entries
    return x, y, z
