"""The pose and the view in which a robot shows best.

Candidates come from a fixed sequence, and those that cost least (`dynsolve.draw.poses`)
are improved a coordinate at a time, so the same robot always gets the same pose.

How clear of all else the mark of a mass centre is on paper, and the line that leads to it.

The pose and the view in which a robot shows best among those where some formulas are 0.

The last link of a modified table, which ends at no origin: it is drawn from o_n past its mass centre.

Linkages that a table with branches opens: an end of one branch that stays at one place of another's link.

The table of a five-bar linkage with a parallelogram says nothing of the joint between its links 3 and 4;
it is found because o_3 keeps its coordinates in frame 4, whatever the angles and the lengths are.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import partial
from itertools import pairwise
from random import Random

from msgspec.structs import replace

from dynsolve.algebra.ring import Expr
from dynsolve.draw.mass_centers import drawn_bodies, sleeves, with_masses
from dynsolve.draw.parts import NO_SLEEVES, RADIUS, arrange
from dynsolve.draw.poses import AXIS, MANY, Choice, Pose, cost_of, taste
from dynsolve.draw.skeleton import (
    DrawnFrame,
    MassCenter,
    Orientation,
    RobotNumbers,
    Skeleton,
    finite,
    generic_numbers,
    is_open,
    skeleton,
)
from dynsolve.draw.vectors import (
    NEAR,
    Point,
    Vector,
    along,
    distance,
    dot,
    facing,
    into,
    moved,
    oblique,
    point_to_segment,
    subtract,
    unit,
)
from dynsolve.notation.tree import Node
from dynsolve.notation.tree_values import evaluate
from dynsolve.robot.model import JointType, Robot, path_to

# How clear of all else the mark of a mass centre is on paper, and the line that leads to it

_MARK = 12.0
"""How much farther two marks are to be apart than a mark and a line."""

_GROUND = 50.0
"""The radius of the place where the base stands."""

_RING = 0.5 * RADIUS
"""By how much the arrow around a joint reaches beyond its body, nearly."""


def clearance(pose: Pose, mass: MassCenter, others: Sequence[MassCenter]) -> float:
    """The least distance on paper to axes, links, joints and other marks, in picture units.

    The line from the origin of the link is to keep off the tips of the axes there, too.
    """
    view = pose.view
    center = view.point(mass.center)
    found = [math.dist(center, view.point(other.center)) - _MARK for other in others]
    found += [math.dist(center, view.point(joint.center)) - RADIUS - _RING for joint in pose.parts.joints]
    found += [point_to_segment(center, *segment) for segment in _links(pose)]
    found.append(math.dist(center, view.point(pose.parts.ground)) - _GROUND)
    frame = pose.skeleton.frames[mass.link]
    origin = view.point(frame.origin)
    for start, tip in _axes(pose):
        found.append(point_to_segment(center, start, tip))
        if math.dist(start, origin) < NEAR:
            found.append(point_to_segment(tip, origin, center))
    return min(found)


def _axes(pose: Pose) -> Iterator[tuple[Point, Point]]:
    for frame in pose.skeleton.frames:
        start = pose.view.point(frame.origin)
        for axis in (frame.x, frame.z):
            yield start, moved(start, pose.view.direction(axis), AXIS)


def _links(pose: Pose) -> Iterator[tuple[Point, Point]]:
    for way in ((leg.foot, leg.head, leg.end) for leg in pose.skeleton.legs):
        for a, b in pairwise(way):
            if distance(a, b) > NEAR:
                yield pose.view.point(a), pose.view.point(b)


# The last link of a modified table, which ends at no origin

_ALIKE = 1 - 1e-6
"""The cosine from which two directions are one."""


def last_links(robot: Robot, pose: Skeleton, beyond: float) -> tuple[tuple[Vector, Vector], ...]:
    """From the last origin of a chain to the mass centre on an axis there, and `beyond` it, but for a point.

    A body with a shape is drawn itself, and a centre off all axes does not say which way the link runs.
    """
    shaped = {body.name for body in robot.bodies if body.uniform_shape is not None}
    found = []
    for mass in pose.masses:
        origin = pose.frames[mass.link].origin
        if is_open(robot, mass.link) and _is_beside(mass, origin, pose):
            way = unit(subtract(mass.center, origin))
            end = mass.center if mass.is_point or mass.name in shaped else along(mass.center, way, beyond)
            found.append((origin, end))
    return tuple(found)


def _is_beside(mass: MassCenter, origin: Vector, pose: Skeleton) -> bool:
    """Whether a mass centre is on an axis of its frame, away from its origin, where no link is yet."""
    if distance(mass.center, origin) < NEAR:
        return False
    way = unit(subtract(mass.center, origin))
    ways = [*pose.links, *((b, a) for a, b in pose.links)]
    links = [unit(subtract(b, origin)) for a, b in ways if distance(a, origin) < NEAR]
    is_on_axis = any(abs(dot(way, axis)) > _ALIKE for axis in pose.frames[mass.link].axes)
    return is_on_axis and all(dot(way, link) < _ALIKE for link in links)


# Linkages that a table with branches opens

_PROBES = (0.3, 1.1, -0.7)


def closing_links(robot: Robot, pose: Skeleton) -> tuple[tuple[Vector, Vector], ...]:
    """What closes the loops of a linkage: from the start of a link to the end of a branch that it holds."""
    if all(joint.parent == joint.index - 1 for joint in robot.joints):
        return ()
    lengths = generic_numbers(robot)
    probes = [
        skeleton(robot, lengths, [start * (1.0 + 0.61 * k) for k in range(robot.n)]).frames
        for start in _PROBES
    ]
    on_the_way = {joint.parent for joint in robot.joints}
    ends = [joint.index for joint in robot.joints if joint.index not in on_the_way]
    return tuple(
        (pose.legs[link - 1].start, pose.frames[end].origin)
        for end in ends
        for link in range(1, len(robot.joints) + 1)
        if all(joint.index != link for joint in path_to(robot.joints, end)) and _stays(probes, end, link)
    )


def _stays(probes: list[tuple[DrawnFrame, ...]], end: int, link: int) -> bool:
    """Whether the origin of one frame has the same coordinates in another frame in all poses."""
    first, *others = (
        into(frames[link].axes, subtract(frames[end].origin, frames[link].origin)) for frames in probes
    )
    return all(distance(first, other) < NEAR for other in others)


WIDTH, HEIGHT = 500.0, 390.0
"""The room that the chain of joints may take, in picture units."""

LARGEST = 150.0
"""The most picture units that a length of 1 takes."""

_MORE = 1.35
"""How much larger a robot with many rows is drawn, for there is more to write beside it."""

_FEW, _SOME = 5, 1.2
"""With more rows and bodies than that, a robot is drawn that much larger."""

_BEYOND = 24.0
"""How far beyond its mass centre a link reaches whose end the table does not say, in picture units."""

_TURNS = tuple(math.radians(15 * k) for k in range(-11, 13))
_SLIDES = (0.6, 0.75, 0.9, 1.05)
_SHAPES_OUT = (1.05, 1.2, 1.35)
"""How far out a link is that slides, and one with a shape, which takes more room to be seen."""

_AZIMUTHS = tuple(math.radians(10 * k + 5) for k in range(-9, 9))
_ELEVATIONS = tuple(math.radians(angle) for angle in (18, 24, 30, 36))
_SAMPLES, _IMPROVED, _ROUNDS = 260, 3, 3
_SEED = 1955


def best_pose(
    robot: Robot, numbers: RobotNumbers, orientation: Orientation, q: Sequence[float] | None = None
) -> Pose:
    """The pose and view with the least cost among those tried; with `q` the best view of that pose."""
    options = options_of(robot, orientation)
    if q is not None:
        options = [*((value,) for value in q), *options[robot.n :]]
    slid_in = sleeves(robot, numbers)
    random = Random(_SEED)  # noqa: S311 - the same poses every time are wanted
    remembered: dict[Choice, float] = {}

    def cost(choice: Choice) -> float:
        if choice not in remembered:
            pose = pose_of(robot, numbers, orientation, choice, slid_in)
            remembered[choice] = round(cost_of(pose, orientation) + taste(robot, pose, choice), 6)
        return remembered[choice]

    tried = [tuple(values[int(random.random() * len(values))] for values in options) for _ in range(_SAMPLES)]
    starts = sorted(set(tried), key=lambda choice: (cost(choice), choice))[:_IMPROVED]
    best = min((improved(start, options, cost) for start in starts), key=lambda c: (cost(c), c))
    return dressed(robot, numbers, pose_of(robot, numbers, orientation, best, slid_in))


def dressed(robot: Robot, numbers: RobotNumbers, pose: Pose) -> Pose:
    """A pose with its mass centres and bodies, and the links that the table does not have."""
    body = with_masses(robot, numbers, pose.skeleton, partial(clearance, pose))
    more = (*closing_links(robot, body), *last_links(robot, body, pose.view.space(_BEYOND)))
    parts = replace(pose.parts, links=(*pose.parts.links, *more))
    return replace(pose, skeleton=body, parts=parts, bodies=drawn_bodies(robot, numbers, body))


def options_of(robot: Robot, orientation: Orientation) -> list[tuple[float, ...]]:
    """The values that each coordinate, and the view, may take."""
    has_shapes = any(body.uniform_shape is not None for body in robot.bodies)
    slides = _SHAPES_OUT if has_shapes else _SLIDES
    joints = [_TURNS if q.type is JointType.REVOLUTE else slides for q in robot.coordinates]
    return joints if orientation.normal else [*joints, _AZIMUTHS, _ELEVATIONS]


def improved(choice: Choice, options: Sequence[Sequence[float]], cost: Callable[[Choice], float]) -> Choice:
    """The choice after each of its parts has in turn been set to its best value."""
    for _ in range(_ROUNDS):
        before = choice
        for k, values in enumerate(options):
            others = [(*choice[:k], value, *choice[k + 1 :]) for value in values]
            choice = min([choice, *others], key=lambda c: (cost(c), c))
        if choice == before:
            break
    return choice


def pose_of(
    robot: Robot,
    numbers: RobotNumbers,
    orientation: Orientation,
    choice: Choice,
    slid_in: Mapping[int, float] = NO_SLEEVES,
) -> Pose:
    """The robot with these values of its coordinates, seen so."""
    body = skeleton(robot, numbers, choice[: robot.n])
    if orientation.normal:
        view = facing(orientation.normal, orientation.up)
    else:
        view = oblique(orientation.up, orientation.ahead, choice[-2], choice[-1])
    room = (
        _MORE if len(robot.joints) > MANY else _SOME if len(robot.joints) + len(robot.bodies) > _FEW else 1.0
    )
    view = view.sized(room * _size([view.point(point) for point in body.path]))
    return Pose(body, arrange(body, view, orientation.up, slid_in), view)


def _size(points: Sequence[Point]) -> float:
    wide = max(x for x, _ in points) - min(x for x, _ in points)
    high = max(y for _, y in points) - min(y for _, y in points)
    return min(LARGEST, WIDTH / max(wide, NEAR), HEIGHT / max(high, NEAR))


# The pose and the view in which a robot shows best among those where some formulas are 0

_STARTS, _HELD_POSE_IMPROVED = 30, 3
_STEPS = 40
_DIFFERENCE, _CLOSE = 1e-6, 1e-9


def held_pose(
    robot: Robot,
    numbers: RobotNumbers,
    orientation: Orientation,
    zeros: Sequence[Node | Expr],
    further: Callable[[Pose], float] = lambda _: 0.0,
) -> tuple[Pose, Mapping[str, float]] | None:
    """A pose in which all formulas are 0, and the values of all symbols there; None where none is found.

    `further` is what a pose costs beside the cost of any.
    """
    options = options_of(robot, orientation)
    random = Random(_SEED)  # noqa: S311 - the same poses every time are wanted
    formulas = _Formulas(robot, numbers, zeros)

    def cost(choice: Choice) -> float:
        pose = pose_of(robot, numbers, orientation, choice)
        return round(cost_of(pose, orientation) + taste(robot, pose, choice) + further(pose), 6)

    views = options[robot.n :]
    usual = tuple(values[len(values) // 2] for values in views)
    starts = [tuple(random.choice(values) for values in options[: robot.n]) for _ in range(_STARTS)]
    found = dict.fromkeys(q for start in starts if (q := formulas.zero_near(start)) is not None)
    if not found:
        return None
    choices = sorted(((*q, *usual) for q in found), key=lambda choice: (cost(choice), choice))[
        :_HELD_POSE_IMPROVED
    ]
    seen = (improved(c, [*((value,) for value in c[: robot.n]), *views], cost) for c in choices)
    best = min(seen, key=lambda choice: (cost(choice), choice))
    return pose_of(robot, numbers, orientation, best), formulas.values(best[: robot.n])


class _Formulas:
    """Formulas at poses; prismatic coordinates of a pose are in picture lengths."""

    def __init__(self, robot: Robot, numbers: RobotNumbers, zeros: Sequence[Node | Expr]) -> None:
        self.robot, self.numbers, self.zeros = robot, numbers, zeros

    def values(self, q: Sequence[float]) -> dict[str, float]:
        """The value of every symbol."""
        pairs = zip(self.robot.coordinates, q, strict=True)
        lengths = {c.name: x * self.numbers.unit if c.type is JointType.PRISMATIC else x for c, x in pairs}
        return {**self.numbers.values, **lengths}

    def at(self, q: Sequence[float]) -> list[float]:
        """The formulas' values."""
        values = self.values(q)
        return [
            finite(zero, values) if isinstance(zero, Expr) else float(evaluate(zero, values))
            for zero in self.zeros
        ]

    def zero_near(self, start: Sequence[float]) -> tuple[float, ...] | None:
        """A pose near another at which everything is 0, by Newton's method; None where none is found."""
        try:
            return self._newton(list(start))
        except (ArithmeticError, ValueError, KeyError):
            return None

    def _newton(self, q: list[float]) -> tuple[float, ...] | None:
        for _ in range(_STEPS):
            f = self.at(q)
            if max(map(abs, f)) < _CLOSE:
                return tuple(round(self._wrapped(k, x), 9) for k, x in enumerate(q))
            for value, row in zip(f, zip(*self._slopes(q, f), strict=True), strict=True):
                square = sum(x * x for x in row)
                if square > _CLOSE:  # one equation after the other, each by its own gradient
                    q = [x - value * slope / square for x, slope in zip(q, row, strict=True)]
        return None

    def _slopes(self, q: Sequence[float], f: Sequence[float]) -> Iterator[list[float]]:
        """∂f/∂q_k, for each k."""
        for k in range(len(q)):
            beside = [*q[:k], q[k] + _DIFFERENCE, *q[k + 1 :]]
            yield [(b - a) / _DIFFERENCE for a, b in zip(f, self.at(beside), strict=True)]

    def _wrapped(self, k: int, x: float) -> float:
        if self.robot.coordinates[k].type is JointType.PRISMATIC:
            return x
        return math.remainder(x, 2 * math.pi)
