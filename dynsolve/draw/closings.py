"""What constraints hold the points of a robot to: a wall, a pivot on the ground, a joint where two ends meet.

A constraint on points is looked at in numbers, where they are in the picture: whether h is 0 there, and its
slopes.  What holds one point along one direction is a wall, or a curve; along all directions a pivot.  What
says how two points lie to each other along all directions joins them where they are one; else it is shown
by its lengths.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence

from msgspec import Struct

from dynsolve.algebra.matrix import Matrix
from dynsolve.draw import paths
from dynsolve.draw.labels import written
from dynsolve.draw.lengths import Length
from dynsolve.draw.parts import RADIUS, JointBody, Parts
from dynsolve.draw.paths import Path
from dynsolve.draw.poses import Pose
from dynsolve.draw.skeleton import Orientation, RobotNumbers, finite, unsigned
from dynsolve.draw.solids import ground, hatched, solids
from dynsolve.draw.vectors import (
    IDENTITY,
    NEAR,
    ORIGIN,
    Vector,
    across,
    add,
    along,
    applied,
    cross,
    distance,
    dot,
    length,
    scale,
    subtract,
    unit,
)
from dynsolve.notation.tree import Node, Reference, Symbol, mapped, names_in
from dynsolve.notation.tree_values import evaluate
from dynsolve.questions.constraints.derive import holonomic
from dynsolve.questions.task.derive import task_value
from dynsolve.robot.model import JointType, Robot
from dynsolve.robot.questions import TIP, Task, points_of

WALLS = "A second hatched line or plate is a wall, from which a point does not part."
CURVES = "A long black curve is one from which a point does not part."
PIVOTS = "A further stand is a pivot on the ground, where an end is held."
MEETINGS = "A circle where two ends meet is a joint between them."
OTHERS = "Constraints of other kinds hold in this pose, and are not drawn."
NOT_HELD = "The constraints do not hold in this pose."

_STEP, _HOLDS, _ALIKE = 1e-4, 1e-3, 1e-5
"""For slopes, how near to 0 a constraint is, and how near two slopes are that are one, in picture lengths."""

_ELSEWHERE = (0.31, -0.17, 0.23)
_WALL, _BEYOND = 62.0, 14.0
"""How far a wall reaches beyond its point, and beyond where its length ends, in picture units."""

_CURVE, _PIECE = 480.0, 3.0
"""How far a curve is followed to both sides, and in pieces of which length."""

_ROOM, _INSIDE = 36.0, 30.0
"""How far from a wall other points of the chain are to be, in picture units; what one in its face costs."""

_STAND, _MEETING = RADIUS + 14.0, 9.0


class Closings(Struct, frozen=True):
    """What is drawn of constraints, under the robot and over it; lengths, names of points, what is said."""

    under: tuple[Path, ...] = ()
    body: tuple[Path, ...] = ()
    lengths: tuple[Length, ...] = ()
    names: tuple[tuple[Node, Vector], ...] = ()
    said: tuple[str, ...] = ()


class _Constraint:
    """h over points, these in picture lengths from the world's origin."""

    def __init__(self, robot: Robot, numbers: RobotNumbers, entry: Node) -> None:
        self.points = points_of(Task((entry,)))
        self._tree, self._numbers = mapped(entry, _as_symbol), numbers
        nowhere = dict.fromkeys(self.points, Matrix.column(robot.ring, [robot.ring.zero] * 3))
        (self.constant,) = task_value(robot, Task((entry,)), nowhere).entries
        self.is_of_points = not names_in(self._tree) & {q.name for q in robot.coordinates}

    def at(self, places: Mapping[str, Vector]) -> float:
        """h, in picture lengths where it is a length."""
        size = self._numbers.unit
        found = {f"{name} {k}": x * size for name, place in places.items() for k, x in enumerate(place, 1)}
        return float(evaluate(self._tree, {**self._numbers.values, **found})) / size

    def slope(self, places: Mapping[str, Vector], point: str) -> Vector:
        """∂h along the coordinates of a point."""
        x, y, z = (
            (self.at({**places, point: ahead}) - self.at({**places, point: back})) / (2 * _STEP)
            for axis in IDENTITY
            for ahead, back in [(along(places[point], axis, _STEP), along(places[point], axis, -_STEP))]
        )
        return x, y, z

    def is_straight(self, places: Mapping[str, Vector]) -> bool:
        """Whether its slopes are the same elsewhere, and of two points opposite."""
        others = {
            name: add(place, scale(_ELSEWHERE, 1.0 + k)) for k, (name, place) in enumerate(places.items())
        }
        found = [self.slope(at, name) for at in (places, others) for name in self.points[:1]]
        found += [scale(self.slope(at, name), -1.0) for at in (places, others) for name in self.points[1:]]
        return all(distance(found[0], each) < _ALIKE for each in found)


def _as_symbol(node: Node) -> Node:
    return Symbol(f"{node.quantity} {node.row}") if isinstance(node, Reference) else node


def closings(robot: Robot, numbers: RobotNumbers, pose: Pose, world: Orientation) -> Closings:
    """What the constraints of a robot hold in this pose."""
    groups: dict[tuple[str, ...], list[_Constraint]] = {}
    names, lengths, said = list[tuple[Node, Vector]](), list[Length](), list[str]()
    under, body = list[Path](), list[Path]()
    places = dict(_places(robot, numbers, pose))
    for one in holonomic(robot):
        held = _Constraint(robot, numbers, one.entry)
        used = {point: places[point] for point in held.points}
        if not (used and held.is_of_points):
            said.append(OTHERS)
        elif abs(held.at(used)) > _HOLDS:
            return Closings(said=(NOT_HELD,))
        else:
            groups.setdefault(tuple(sorted(held.points)), []).append(held)
    start = scale(numbers.moved, -1.0)
    for points, group in groups.items():
        used = {point: places[point] for point in points}
        at = add(start, places[points[0]])
        other = add(start, places[points[1]]) if len(points) == 2 else None
        straight = len(points) <= 2 and all(held.is_straight(used) for held in group)
        slopes = [_on_paper(held.slope(used, points[0]), pose) for held in group]
        is_held = straight and _rank(slopes) == (2 if pose.view.flat else 3)
        names += [(Symbol(point), add(start, places[point])) for point in points if point != TIP]
        if straight:
            lengths += _lengths(robot, group, used, other or start)
        if is_held and other is not None:
            if distance(at, other) < _HOLDS:
                body += _meeting(at, pose)
                said.append(MEETINGS)
        elif is_held and pose.view.flat:
            ground_of, stand = _pivot(at, pose, world)
            under, body = [*under, *ground_of], [*body, *stand]
            said.append(PIVOTS)
        elif len(points) == len(group) == 1 and length(slopes[0]) > NEAR and (straight or pose.view.flat):
            wall = _wall if straight else _curve
            under += wall(group[0], used, start, pose, world)
            said.append(WALLS if straight else CURVES)
        else:
            said.append(OTHERS)
    return Closings(tuple(under), tuple(body), tuple(lengths), tuple(names), tuple(dict.fromkeys(said)))


def _places(robot: Robot, numbers: RobotNumbers, pose: Pose) -> Iterator[tuple[str, Vector]]:
    """The points from the world's origin, in picture lengths."""
    yield TIP, add(pose.skeleton.frames[-1].origin, numbers.moved)
    for point in robot.questions.points:
        frame = pose.skeleton.frames[point.link]
        x, y, z = (finite(entry, numbers.values) / numbers.unit for entry in point.position.entries)
        yield point.name, add(add(frame.origin, applied(frame.axes, (x, y, z))), numbers.moved)


def _on_paper(direction: Vector, pose: Pose) -> Vector:
    """A direction without its part across the plane in which a robot moves."""
    toward = pose.view.toward
    return along(direction, toward, -dot(direction, toward)) if pose.view.flat else direction


def _rank(directions: Sequence[Vector]) -> int:
    """How many of some directions are independent."""
    found: list[Vector] = []
    for direction in directions:
        for known in found:
            direction = along(direction, known, -dot(direction, known))
        if length(direction) > _HOLDS:
            found.append(unit(direction))
    return len(found)


def _lengths(
    robot: Robot, group: Sequence[_Constraint], used: Mapping[str, Vector], start: Vector
) -> Iterator[Length]:
    """How far a point is from the world's origin, or from another point, along each axis that is given."""
    nowhere = dict.fromkeys(used, ORIGIN)
    for held in group:
        slope = held.slope(used, min(used))
        away = -held.at(nowhere)
        if abs(length(slope) - 1.0) < _ALIKE and abs(away) > NEAR:
            end = along(start, slope, away)
            yield Length(start, end, unsigned(written(robot)(held.constant)))
            start = end


def _pivot(at: Vector, pose: Pose, world: Orientation) -> tuple[tuple[Path, ...], tuple[Path, ...]]:
    """A joint on a stand of its own, as the first one has it: its ground, and its body."""
    foot = along(at, world.up, -pose.view.space(_STAND))
    joint = JointBody(0, JointType.REVOLUTE, at, pose.view.toward)
    parts = Parts((joint,), ((foot, at),), foot, world.up, cross(world.up, pose.view.toward))
    return ground(parts, pose.view), solids(parts, pose.view, world.up)


def _meeting(at: Vector, pose: Pose) -> Iterator[Path]:
    yield Path(paths.circle(pose.view.point(at), _MEETING), fill=paths.CAP)


def _wall(
    held: _Constraint, used: Mapping[str, Vector], start: Vector, pose: Pose, world: Orientation
) -> tuple[Path, ...]:
    """A hatched line through a point, from where its length ends; a plate in space."""
    view = pose.view
    at, normal = _face(held, used, start, pose, world)
    away = dot(subtract(at, start), normal)
    foot = along(start, normal, away)
    if not view.flat:
        beside = Path(paths.line(view.point(foot), view.point(at)), paths.GREY, 0.9, dashed=True)
        plate = Parts((), (), at, scale(normal, -1.0), across(normal, IDENTITY, 0.5))
        return (beside, *ground(plate, view))
    way = cross(view.toward, normal)
    to_foot = dot(subtract(foot, at), way)
    beyond = to_foot + math.copysign(view.space(_BEYOND), to_foot)
    ends = [-view.space(_WALL), view.space(_WALL), *([beyond] if abs(away) > NEAR else [])]
    first, last = (view.point(along(at, way, t)) for t in (min(ends), max(ends)))
    return hatched(first, last, view.direction(normal))


def _face(
    held: _Constraint, used: Mapping[str, Vector], start: Vector, pose: Pose, world: Orientation
) -> tuple[Vector, Vector]:
    """A point of a wall, and the normal into it: away from the world's origin, else downwards."""
    ((point, place),) = used.items()
    at, normal = add(start, place), unit(_on_paper(held.slope(used, point), pose))
    away = dot(subtract(at, start), normal)
    is_outwards = away > 0 if abs(away) > NEAR else dot(normal, world.up) <= NEAR
    return at, normal if is_outwards else scale(normal, -1.0)


def in_walls(robot: Robot, numbers: RobotNumbers, world: Orientation) -> Callable[[Pose], float]:
    """How far a pose has its joints and ends inside walls or near them, 0 where all are clear of them."""
    known = [_Constraint(robot, numbers, one.entry) for one in holonomic(robot)]
    alone = [held for held in known if [one.points for one in known].count(held.points) == 1]
    start = scale(numbers.moved, -1.0)

    def cost(pose: Pose) -> float:
        places, total = dict(_places(robot, numbers, pose)), 0.0
        for held in alone:
            used = {point: places[point] for point in held.points}
            if len(used) > 1 or not (used and held.is_of_points and held.is_straight(used)):
                continue
            if length(_on_paper(held.slope(used, held.points[0]), pose)) > NEAR:
                at, normal = _face(held, used, start, pose, world)
                rest = [point for point in pose.skeleton.path[1:] if distance(point, at) > _HOLDS]
                room = (-dot(subtract(point, at), normal) * pose.view.size / _ROOM for point in rest)
                total += sum(max(0.0, 1.0 - part) ** 2 for part in room)
        return _INSIDE * total

    return cost


def _curve(
    held: _Constraint, used: Mapping[str, Vector], start: Vector, pose: Pose, world: Orientation
) -> tuple[Path, ...]:
    """The curve in the plane on which h = 0, some way to both sides of the point."""
    ((point, place),) = used.items()
    view, points = pose.view, [place]
    for sense in (1.0, -1.0):
        at = place
        for _ in range(round(_CURVE / _PIECE)):
            slope = _on_paper(held.slope({point: at}, point), pose)
            if length(slope) < _HOLDS:
                break
            at = along(at, unit(cross(view.toward, slope)), sense * view.space(_PIECE))
            slope = _on_paper(held.slope({point: at}, point), pose)
            at = along(at, slope, -held.at({point: at}) / max(dot(slope, slope), NEAR))
            points.insert(len(points) if sense > 0 else 0, at)
            if len(points) > 3 and distance(points[0], points[-1]) < view.space(_PIECE):
                break
    return (Path(paths.line(*(view.point(add(start, each)) for each in points)), width=1.6),)
