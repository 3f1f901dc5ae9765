"""The pose and the view in which a robot shows best.

Candidates come from a fixed sequence, and those that cost least (`dynsolve.draw.pose`)
are improved a coordinate at a time, so the same robot always gets the same pose.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from functools import partial
from random import Random

from dynsolve.draw.bodies import drawn_bodies, sleeves
from dynsolve.draw.clearance import clearance
from dynsolve.draw.drawn_lengths import RobotNumbers
from dynsolve.draw.last_links import last_links
from dynsolve.draw.loops import closing_links
from dynsolve.draw.mass_centers import with_masses
from dynsolve.draw.orientation import Orientation
from dynsolve.draw.parts import NO_SLEEVES, arrange
from dynsolve.draw.pose import MANY, Choice, Pose, cost_of, taste
from dynsolve.draw.skeleton import skeleton
from dynsolve.draw.vectors import NEAR, Point
from dynsolve.draw.view import facing, oblique
from dynsolve.robot.model import JointType, Robot

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

    tried = [tuple(_pick(random, values) for values in options) for _ in range(_SAMPLES)]
    starts = sorted(set(tried), key=lambda choice: (cost(choice), choice))[:_IMPROVED]
    best = min((improved(start, options, cost) for start in starts), key=lambda c: (cost(c), c))
    return dressed(robot, numbers, pose_of(robot, numbers, orientation, best, slid_in))


def dressed(robot: Robot, numbers: RobotNumbers, pose: Pose) -> Pose:
    """A pose with its mass centres and bodies, and the links that the table does not have."""
    body = with_masses(robot, numbers, pose.skeleton, partial(clearance, pose))
    more = (*closing_links(robot, body), *last_links(robot, body, pose.view.space(_BEYOND)))
    parts = replace(pose.parts, links=(*pose.parts.links, *more))
    return replace(pose, skeleton=body, parts=parts, bodies=drawn_bodies(robot, numbers, body))


def _pick(random: Random, values: Sequence[float]) -> float:
    return values[int(random.random() * len(values))]


def options_of(robot: Robot, orientation: Orientation) -> list[tuple[float, ...]]:
    """The values that each coordinate, and the view, may take."""
    has_shapes = any(body.shape is not None for body in robot.bodies)
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
