"""The pose and the view in which a robot shows best.

A pose is good where nothing hides anything: origins lie apart on paper, links do
not cross, axes are not seen end on, and the arm stays above the ground.  Candidates
come from a fixed sequence, and the best are improved a coordinate at a time, so the
same robot always gets the same pose.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from itertools import combinations, pairwise
from random import Random

from dynsolve.draw.numbers import RobotNumbers
from dynsolve.draw.orientation import Setting
from dynsolve.draw.parts import Parts, arrange
from dynsolve.draw.skeleton import NEAR, Skeleton, skeleton, with_masses
from dynsolve.draw.vectors import Point, along, distance, dot, subtract
from dynsolve.draw.view import View, facing, oblique
from dynsolve.robot.model import JointType, Robot

WIDTH, HEIGHT = 500.0, 390.0
"""The room that the chain of joints may take, in picture units."""

LARGEST = 150.0
"""The most picture units that a length of 1 takes."""

_MANY, _MORE = 4, 1.35
"""A robot with more rows than that is drawn larger, for there is more to write beside it."""

AXIS = 44.0
"""How long the axes of frames are drawn."""

_TURNS = tuple(math.radians(15 * k) for k in range(-11, 13))
_SLIDES = (0.6, 0.75, 0.9, 1.05)
_AZIMUTHS = tuple(math.radians(10 * k + 5) for k in range(-9, 9))
_ELEVATIONS = tuple(math.radians(angle) for angle in (18, 24, 30))
_SAMPLES, _IMPROVED, _ROUNDS = 260, 3, 3
_SEED = 1955


@dataclass(frozen=True, slots=True)
class Pose:
    """A robot in its pose, seen from where it shows best."""

    skeleton: Skeleton
    parts: Parts
    view: View


_Choice = tuple[float, ...]
"""Values of the coordinates, then azimuth and elevation where the view is free."""


def best_pose(robot: Robot, numbers: RobotNumbers, setting: Setting) -> Pose:
    """The pose and view with the least cost among those tried."""
    options = _options(robot, setting)
    random = Random(_SEED)  # noqa: S311 - the same poses every time are wanted
    remembered: dict[_Choice, float] = {}

    def cost(choice: _Choice) -> float:
        if choice not in remembered:
            pose = _pose(robot, numbers, setting, choice)
            remembered[choice] = round(_cost(pose, setting) + _taste(robot, pose, choice), 6)
        return remembered[choice]

    tried = [tuple(_pick(random, values) for values in options) for _ in range(_SAMPLES)]
    starts = sorted(set(tried), key=lambda choice: (cost(choice), choice))[:_IMPROVED]
    best = min((_improved(start, options, cost) for start in starts), key=lambda c: (cost(c), c))
    pose = _pose(robot, numbers, setting, best)
    return replace(pose, skeleton=with_masses(robot, numbers, pose.skeleton))


def _pick(random: Random, values: Sequence[float]) -> float:
    return values[int(random.random() * len(values))]


def _options(robot: Robot, setting: Setting) -> list[tuple[float, ...]]:
    """The values that each coordinate, and the view, may take."""
    joints = [_TURNS if q.type is JointType.REVOLUTE else _SLIDES for q in robot.coordinates]
    return joints if setting.normal else [*joints, _AZIMUTHS, _ELEVATIONS]


def _improved(
    choice: _Choice, options: Sequence[Sequence[float]], cost: Callable[[_Choice], float]
) -> _Choice:
    """The choice after each of its parts has in turn been set to its best value."""
    for _ in range(_ROUNDS):
        before = choice
        for k, values in enumerate(options):
            others = [(*choice[:k], value, *choice[k + 1 :]) for value in values]
            choice = min([choice, *others], key=lambda c: (cost(c), c))
        if choice == before:
            break
    return choice


def _pose(robot: Robot, numbers: RobotNumbers, setting: Setting, choice: _Choice) -> Pose:
    body = skeleton(robot, numbers, choice[: robot.n])
    if setting.normal:
        view = facing(setting.normal, setting.up)
    else:
        view = oblique(setting.up, setting.ahead, choice[-2], choice[-1])
    room = _MORE if len(robot.joints) > _MANY else 1.0
    view = view.sized(room * _size([view.point(point) for point in body.path]))
    return Pose(body, arrange(body, view, setting.up), view)


def _size(points: Sequence[Point]) -> float:
    wide = max(x for x, _ in points) - min(x for x, _ in points)
    high = max(y for _, y in points) - min(y for _, y in points)
    return min(LARGEST, WIDTH / max(wide, NEAR), HEIGHT / max(high, NEAR))


# -- what a pose costs -----------------------------------------------------------------------------


def _cost(pose: Pose, setting: Setting) -> float:
    view = pose.view
    path = [view.point(point) for point in pose.skeleton.path]
    centers = [view.point(part.center) for part in pose.parts.joints]
    tips = _tips(pose)
    return (
        30.0 * max(0.0, 120.0 / view.size - 1.0)
        + 40.0 * _crowding(path, 60.0)
        + 25.0 * _crowding(centers, 48.0)
        + 14.0 * _crowding([tip for _, tip in tips], 30.0)
        + 30.0 * _crossings(pose, 36.0)
        + 10.0 * _tips_on_links(path, tips)
        + _foreshortening(pose)
        + _lowness(pose.skeleton, setting)
    )


def _shortfall(value: float, wanted: float) -> float:
    """0 where there is enough, up to 1 where there is nothing."""
    return max(0.0, 1.0 - value / wanted) ** 2


def _crowding(points: Sequence[Point], wanted: float) -> float:
    return sum(_shortfall(math.dist(a, b), wanted) for a, b in combinations(points, 2))


def _tips(pose: Pose) -> list[tuple[Point, Point]]:
    """(origin, tip) of the axes of frames on paper."""
    view, size = pose.view, pose.view.space(AXIS)
    return [
        (view.point(frame.origin), view.point(along(frame.origin, axis, size)))
        for frame in pose.skeleton.frames
        for axis in (frame.x, frame.z)
        if not (view.flat and abs(dot(axis, view.toward)) > 0.9)
    ]


def _tips_on_links(path: Sequence[Point], tips: Sequence[tuple[Point, Point]]) -> float:
    segments = list(pairwise(path))
    return sum(_shortfall(point_to_segment(tip, *segment), 13.0) for _, tip in tips for segment in segments)


def _crossings(pose: Pose, wanted: float) -> float:
    """How near links come to each other that do not meet."""
    view = pose.view
    path = [view.point(point) for point in pose.skeleton.path]
    segments = list(pairwise(path))
    total = 0.0
    for (i, first), (j, second) in combinations(enumerate(segments), 2):
        if j == i + 1:
            total += 0.6 * _fold(first, second)
        else:
            total += _shortfall(segment_distance(first, second), wanted)
    return total


def _fold(first: tuple[Point, Point], second: tuple[Point, Point]) -> float:
    """1 where a link lies straight back on the one before it, 0 where it is far from that."""
    (a, b), (_, c) = first, second
    u, v = (a[0] - b[0], a[1] - b[1]), (c[0] - b[0], c[1] - b[1])
    sizes = math.hypot(*u) * math.hypot(*v)
    if sizes < NEAR:
        return 1.0
    return max(0.0, (u[0] * v[0] + u[1] * v[1]) / sizes - 0.4)


def _foreshortening(pose: Pose) -> float:
    view = pose.view
    total = 0.0
    for frame in pose.skeleton.frames:
        for axis in (frame.x, frame.z):
            if not (view.flat and abs(dot(axis, view.toward)) > 0.9):
                total += 6.0 * _shortfall(math.hypot(*view.direction(axis)), 0.6)
    for a, b in zip(pose.skeleton.path, pose.skeleton.path[1:], strict=False):
        seen = math.dist(view.point(a), view.point(b)) / (distance(a, b) * view.size)
        total += 8.0 * _shortfall(seen, 0.7)
    return total


def _lowness(body: Skeleton, setting: Setting) -> float:
    """What it costs to reach below the base."""
    start = body.frames[0].origin
    heights = [dot(subtract(point, start), setting.up) for point in body.path]
    return 12.0 * sum(max(0.0, -0.05 - height) for height in heights)


def _taste(robot: Robot, pose: Pose, choice: _Choice) -> float:
    """Small preferences: angles that can be seen, moderate values, the arm leading to the right."""
    total = 0.0
    for q, value in zip(robot.coordinates, choice, strict=False):
        if q.type is JointType.PRISMATIC:
            total += 1.5 * abs(value - 0.9)
        else:
            total += 0.3 * abs(value)
    if pose.view.flat:
        for leg in pose.skeleton.legs:
            if leg.type is JointType.REVOLUTE:
                angle = abs(math.remainder(leg.angle, 2 * math.pi))
                total += 12.0 * _shortfall(angle, 0.7) + 1.2 * abs(angle - 0.8)
    else:
        total += 0.5 * abs(choice[-2] - math.radians(35))
    first, last = pose.skeleton.frames[0].origin, pose.skeleton.frames[-1].origin
    reach = pose.view.direction(subtract(last, first))[0]
    return total + 1.5 * max(0.0, 1.0 - reach)


# -- distances on paper ----------------------------------------------------------------------------


def point_to_segment(p: Point, a: Point, b: Point) -> float:
    """How far a point is from a segment."""
    dx, dy = b[0] - a[0], b[1] - a[1]
    square = dx * dx + dy * dy
    t = 0.0 if square < NEAR else ((p[0] - a[0]) * dx + (p[1] - a[1]) * dy) / square
    t = min(1.0, max(0.0, t))
    return math.hypot(p[0] - a[0] - t * dx, p[1] - a[1] - t * dy)


def segment_distance(first: tuple[Point, Point], second: tuple[Point, Point]) -> float:
    """How far two segments are apart; 0 where they cross.

    >>> segment_distance(((0.0, 0.0), (2.0, 0.0)), ((1.0, -1.0), (1.0, 1.0)))
    0.0
    """
    (a, b), (c, d) = first, second
    if _side(a, b, c) * _side(a, b, d) < 0 and _side(c, d, a) * _side(c, d, b) < 0:
        return 0.0
    return min(
        point_to_segment(a, c, d),
        point_to_segment(b, c, d),
        point_to_segment(c, a, b),
        point_to_segment(d, a, b),
    )


def _side(a: Point, b: Point, p: Point) -> float:
    return (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0])
