"""The geometry of a robot at one pose: its frames, and the legs d and a of its rows.

Both conventions come to one chain of points.  Row i has a leg along the axis of
its joint, of length d_i from its foot to its head, and a leg of length a_i across:

    standard   foot_i = o_{i-1},  head_i = foot_i + d_i z_{i-1},  o_i = head_i + a_i x_i
    modified   foot_i = o_{i-1} + a_i x_{i-1},  o_i = head_i = foot_i + d_i z_i

The lengths in a picture: how long L_1 is drawn where it has no number, and where it has one.

Lengths with a number in the problem file keep their proportions, but the shortest
is drawn long enough to be seen; the others are all equally long.  A mass centre
that is given by symbols lies near the middle of its link.

How a robot stands in the world: which way is up, and whether it moves in a plane.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from itertools import pairwise

from msgspec import Struct
from msgspec.structs import replace

from dynsolve.algebra.angles import Angle
from dynsolve.algebra.ring import Expr
from dynsolve.algebra.ring_values import evaluate
from dynsolve.draw.vectors import (
    IDENTITY,
    NEAR,
    ORIGIN,
    Rotation,
    Vector,
    across,
    add,
    along,
    cross,
    distance,
    dot,
    length,
    scale,
    subtract,
    turned,
    unit,
)
from dynsolve.notation.build import negated, total
from dynsolve.notation.tree import Negative, Node, Sum, names_in
from dynsolve.problem.model import Problem
from dynsolve.robot.model import Convention, Joint, JointType, Robot

# The lengths in a picture

SHORTEST = 0.42
"""The shortest length that is drawn, as a part of the longest."""

_MOVED, _CLEAR = (0.75, 1.5, 0.5), 0.45
"""How far a base is drawn from the world's origin along an axis, best first, as a part of the longest length,
and how far other origins are to be from that."""

_APART = 0.0437
"""How far apart the values of letters are that are to differ."""

_TINY = 1e-9
_ANGLE = math.radians(35)
_RETRIES = ((1.0, 0.0), (1.3, 0.1), (0.7, 0.3), (1.1, -0.4))
"""(factor, spread) of what undetermined parameters are tried with, until every root is real."""


class TableRow(Struct, frozen=True):
    """A row of the table in numbers, without its joint variable; the longest length is 1.

    `offset` is the part of `theta` that is a number of degrees beside one coordinate: the 90° of θ_1 + 90°.
    `backwards` says that the angle is the negative of what is drawn: f + 20° of -f - 20°.
    """

    theta: float
    d: float
    a: float
    alpha: float
    offset: float = 0.0
    backwards: bool = False


class RobotNumbers(Struct, frozen=True):
    """A robot in numbers: its rows in picture lengths, and the value of every parameter.

    `unit` is the value that is drawn with length 1; `base` turns frame 0 in the world, `moved` is where it
    is drawn from the world's origin.  `given` are the parameters whose number is the file's own.
    """

    rows: tuple[TableRow, ...]
    values: Mapping[str, float]
    unit: float
    base: Rotation = IDENTITY
    given: frozenset[str] = frozenset()
    moved: Vector = ORIGIN


def numbers(problem: Problem) -> RobotNumbers:
    """Pleasant numbers for a problem's table."""
    robot = problem.robot
    given = {name: float(value) for name, value in problem.values.items()}
    for factor, spread in _RETRIES:
        try:
            return _numbers(robot, given, factor, spread)
        except (ValueError, ZeroDivisionError, OverflowError):
            continue
    rows = tuple(TableRow(0.0, 0.0, 1.0, 0.0) for _ in robot.joints)
    return RobotNumbers(rows, dict.fromkeys(robot.ring.parameters, 1.0), 1.0)


def generic_numbers(robot: Robot) -> RobotNumbers:
    """Numbers of which no two letters have the same: what holds for them holds for all."""
    return _numbers(robot, {}, 1.0, _APART)


def _numbers(robot: Robot, given: Mapping[str, float], factor: float, spread: float) -> RobotNumbers:
    values = _all_values(robot, given, factor, spread)
    named = _lengths(robot)
    unit, shortest = _range(robot, values)
    if shortest < SHORTEST * unit:
        values |= {name: unit * drawn_length(values[name] / unit) for name in named}
        unit, shortest = _range(robot, values)

    constant = [x for row in robot.joints for x in (row.a, *(() if row.variable == "d" else (row.d,)))]
    has_vanished = any(not x.is_zero and abs(finite(x, values)) < _TINY for x in constant)
    if has_vanished and (factor, spread) != _RETRIES[-1]:
        raise ValueError("a length came out as 0")

    def drawn(expr: Expr) -> float:
        ratio = finite(expr, values) / unit
        return drawn_length(ratio) if shortest < 0.8 * SHORTEST * unit else ratio

    rows = tuple(
        TableRow(
            joint.theta.radians(values),
            drawn(joint.d),
            drawn(joint.a),
            joint.alpha.radians(values),
            _offset(robot, joint),
            not turned_alone(robot, joint) and unsigned(joint.written[0]) != joint.written[0],
        )
        for joint in robot.joints
    )
    x, y, z = ([finite(entry, values) for entry in row] for row in robot.base_rotation.rows)
    base = tuple(zip(x, y, z, strict=True))
    found = RobotNumbers(rows, values, unit, (base[0], base[1], base[2]), frozenset(given))
    return replace(found, moved=_moved(robot, found))


def _moved(robot: Robot, numbers: RobotNumbers) -> Vector:
    """From the world's origin to that of frame 0, as long along each axis where it is not 0.

    The world's axes are to be clear of those of the other frames, as far as these are where they are at 0.
    """
    sizes = [finite(entry, numbers.values) for entry in robot.base_position.entries]
    x, y, z = (math.copysign(abs(size) > 0, size) for size in sizes)
    origins = [frame.origin for frame in skeleton(robot, numbers, [0.0] * robot.n).frames[1:]]
    ways = [scale((x, y, z), size) for size in _MOVED]
    clear = (way for way in ways if all(distance(scale(way, -1.0), origin) > _CLEAR for origin in origins))
    return next(clear, ways[0])


def _offset(robot: Robot, joint: Joint) -> float:
    variable = turned_alone(robot, joint)
    return math.remainder(math.radians(float(joint.theta.degrees)), 2 * math.pi) if variable else 0.0


def turned_alone(robot: Robot, joint: Joint) -> str | None:
    """The coordinate that is the whole angle of a row, but for a number of degrees; else None."""
    if joint.type is not JointType.REVOLUTE or len(joint.rates) != 1:
        return None
    name = robot.coordinates[joint.rates[0][0]].name
    return name if joint.theta.linear == Angle.of(name) else None


def unsigned(node: Node) -> Node:
    """A length or an angle without the sign that says only which way it is measured: w + b of -w - b."""
    terms = node.terms if isinstance(node, Sum) else (node,)
    return opposite(node) if all(isinstance(term, Negative) for term in terms) else node


def opposite(node: Node) -> Node:
    """The negative of it, each term of a sum by itself."""
    return total([negated(term) for term in node.terms]) if isinstance(node, Sum) else negated(node)


def _range(robot: Robot, values: Mapping[str, float]) -> tuple[float, float]:
    """The longest length of the table, and the shortest that is not 0; 1 where there is none."""
    lengths = [abs(finite(x, values)) for joint in robot.joints for x in (joint.d, joint.a)]
    real = [x for x in lengths if x > _TINY]
    return max(real, default=1.0), min(real, default=1.0)


def _all_values(robot: Robot, given: Mapping[str, float], factor: float, spread: float) -> dict[str, float]:
    known = [abs(given[name]) for name in _lengths(robot) if given.get(name)]
    usual = factor * (sum(known) / len(known) if known else 1.0)
    values = {name: usual * (1.0 + spread * place) for place, name in enumerate(robot.ring.parameters)}
    of_table = (angle for joint in robot.joints for angle in (joint.theta, joint.alpha))
    for angle in (*of_table, *(pair.angle for pair in robot.ring.pairs)):  # those of gravity, too
        for atom, _ in angle.terms:
            values.update({name: _ANGLE for name, _ in atom if len(atom) == 1})
    values.update(dict.fromkeys(names_in(*(turn for _, turn in robot.base_turns)), _ANGLE))
    values.update(given)
    values["pi"] = math.pi
    for q in robot.coordinates:
        values.update({q.name: 0.0, q.velocity: 0.0, q.acceleration: 0.0})
    return values


def _lengths(robot: Robot) -> list[str]:
    """The parameters that stand in the columns d and a."""
    names = names_in(*(node for joint in robot.joints for node in joint.written[1:3]))
    return [name for name in robot.ring.parameters if name in names]


def finite(expr: Expr, values: Mapping[str, float]) -> float:
    """The value of an expression; ValueError where it has none that is finite."""
    value = evaluate(expr, values)
    if not math.isfinite(value):
        raise ValueError(value)
    return value


def drawn_length(ratio: float) -> float:
    """How long a length is drawn: 0 stays 0, 1 stays 1, and nothing else is too short to be seen.

    >>> drawn_length(0.0), drawn_length(1.0), drawn_length(-1.0)
    (0.0, 1.0, -1.0)
    """
    if abs(ratio) < _TINY:
        return 0.0
    return math.copysign(SHORTEST + (1.0 - SHORTEST) * abs(ratio), ratio)


class DrawnFrame(Struct, frozen=True):
    """A frame in the world."""

    origin: Vector
    axes: Rotation

    @property
    def x(self) -> Vector:
        """Its x axis."""
        return self.axes[0]

    @property
    def z(self) -> Vector:
        """Its z axis."""
        return self.axes[2]


_WIDEST = math.radians(225) + NEAR
"""A wider angle is drawn as a negative one."""


class Leg(Struct, frozen=True):
    """A row of the table in space.

    `axis` is the direction of the joint's axis, `before` and `after` the x axes that
    θ turns from and to, `start` the origin of the frame before it, `end` that of its own.
    `offset` is the number of degrees in θ, in radians, beside a coordinate alone.  An angle -f - 20° is
    `backwards`: f + 20° the other way.
    """

    type: JointType | None
    start: Vector
    foot: Vector
    head: Vector
    end: Vector
    axis: Vector
    before: Vector
    after: Vector
    angle: float
    offset: float = 0.0
    backwards: bool = False

    @property
    def turn(self) -> float:
        """θ without the offset, within one positive turn about `turned_about`."""
        angle = self.angle - self.offset
        return (-angle if self.backwards else angle) % (2 * math.pi)

    @property
    def drawn(self) -> float:
        """θ without the offset as it is drawn about `turned_about`: beyond -135° up to 225°."""
        return self.turn if self.turn < _WIDEST else self.turn - 2 * math.pi

    @property
    def turned_about(self) -> Vector:
        """The axis about which the angle is drawn as positive."""
        return scale(self.axis, -1.0) if self.backwards else self.axis

    @property
    def turned(self) -> Vector:
        """The x axis before the joint after a turn by the coordinate alone; `after` is the offset beyond."""
        side = cross(self.axis, self.after)
        return add(scale(self.after, math.cos(self.offset)), scale(side, -math.sin(self.offset)))

    @property
    def center(self) -> Vector:
        """The origin that is on the joint's axis: of the frame before it, else of the one after it."""
        way = subtract(self.start, self.foot)
        beside = subtract(way, scale(self.axis, dot(way, self.axis)))
        return self.start if length(beside) < NEAR else self.end


class Step(Struct, frozen=True):
    """A straight way from one point to another: `rate` times a symbol, or an exact number."""

    start: Vector
    end: Vector
    rate: float = 0.0
    symbol: str = ""
    number: Expr | None = None


class MassCenter(Struct, frozen=True):
    """A mass centre, the steps that lead to it, and the values that its free symbols are drawn with."""

    name: str
    center: Vector
    is_point: bool
    link: int
    steps: tuple[Step, ...] = ()
    chosen: tuple[tuple[str, float], ...] = ()


class Skeleton(Struct, frozen=True):
    """A robot at a pose: frames 0..m, legs 1..m, and the mass centres.

    `path` are the points of the chains from frame 0 on, each once, and `links` the straight ways to them.
    """

    frames: tuple[DrawnFrame, ...]
    legs: tuple[Leg, ...]
    path: tuple[Vector, ...]
    links: tuple[tuple[Vector, Vector], ...]
    masses: tuple[MassCenter, ...] = ()


def skeleton(robot: Robot, numbers: RobotNumbers, q: Sequence[float]) -> Skeleton:
    """The robot with these values of its coordinates, in radians and picture lengths; without masses."""
    frames, legs = [DrawnFrame(ORIGIN, numbers.base)], []
    for joint in robot.joints:
        leg, frame = _leg(robot, numbers, joint, q, frames[joint.parent])
        legs.append(leg)
        frames.append(frame)
    links = tuple(_links(legs))
    return Skeleton(tuple(frames), tuple(legs), (ORIGIN, *(end for _, end in links)), links)


def _links(legs: Sequence[Leg]) -> Iterator[tuple[Vector, Vector]]:
    for leg in legs:
        ways = pairwise((leg.start, leg.foot, leg.head, leg.end))
        yield from ((a, b) for a, b in ways if distance(a, b) > NEAR)


def _leg(
    robot: Robot, numbers: RobotNumbers, joint: Joint, q: Sequence[float], frame: DrawnFrame
) -> tuple[Leg, DrawnFrame]:
    row = numbers.rows[joint.index - 1]
    moved = sum(float(rate) * q[k] for k, rate in joint.rates)
    theta = row.theta + (moved if joint.variable == "theta" else 0.0)
    d = row.d + (moved if joint.variable == "d" else 0.0)
    o = frame.origin
    if robot.convention is Convention.STANDARD:
        level = turned(frame.axes, 2, theta)
        head = along(o, frame.z, d)
        end = along(head, level[0], row.a)
        leg = Leg(joint.type, o, o, head, end, frame.z, frame.x, level[0], theta, row.offset, row.backwards)
        return leg, DrawnFrame(end, turned(level, 0, row.alpha))
    tilted = turned(frame.axes, 0, row.alpha)
    foot = along(o, frame.x, row.a)
    head = along(foot, tilted[2], d)
    axes = turned(tilted, 2, theta)
    leg = Leg(joint.type, o, foot, head, head, tilted[2], frame.x, axes[0], theta, row.offset, row.backwards)
    return leg, DrawnFrame(head, axes)


def is_open(robot: Robot, link: int) -> bool:
    """Whether the table does not say where a link ends: the last of a chain in the modified convention."""
    return robot.convention is Convention.MODIFIED and all(joint.parent != link for joint in robot.joints)


def near_and_far(robot: Robot, bare: Skeleton, link: int) -> tuple[Vector, Vector]:
    """The two ends of a link: its start and o_i, in the modified convention o_i and o_{i+1}."""
    last = len(bare.frames) - 1
    if robot.convention is Convention.STANDARD:
        parent = robot.joints[link - 1].parent if link else 0
        return bare.frames[parent].origin, bare.frames[link].origin
    return bare.frames[link].origin, bare.frames[min(link + 1, last)].origin


_FLAT = 1e-6
_PROBES = (0.3, 1.1, -0.7)


class Orientation(Struct, frozen=True):
    """Which way is up, and what the robot moves in.

    `gravity` is a unit vector, None without gravity; `ahead` a level direction of the
    base; `normal` that of the plane of motion, where there is one, upright or level.
    """

    up: Vector
    ahead: Vector
    gravity: Vector | None
    normal: Vector | None


def orientation(robot: Robot, numbers: RobotNumbers, drawn: bool = False) -> Orientation:
    """Which way is up for a robot, and the plane that it moves in.

    It is seen from a side of frame 0; a robot that is `drawn` from a side of the drawing's axes,
    wherever the table has put frame 0: from behind it would be mirrored.
    """
    base = DrawnFrame(ORIGIN, IDENTITY if drawn else numbers.base)
    gravity = _gravity(robot, numbers)
    normal = _normal(robot, numbers, base)
    # a plane that is neither upright nor level would hide from its front how far it leans
    leans = normal and gravity and _FLAT < abs(dot(normal, gravity)) < 1 - _FLAT
    if normal is not None and not leans:
        against = [scale(gravity, -1.0)] if gravity else []  # is drawn upwards, else y_0, else z_0
        upwards = across(normal, [*against, base.axes[1], base.z], 0.1)
        return Orientation(upwards, base.x, gravity, normal)
    up = scale(gravity, -1.0) if gravity else base.z
    ahead = base.x if abs(dot(base.x, up)) < 0.9 else base.z
    return Orientation(up, ahead, gravity, None)


def _gravity(robot: Robot, numbers: RobotNumbers) -> Vector | None:
    try:
        x, y, z = (finite(entry, numbers.values) for entry in robot.gravity.entries)
    except (ValueError, ZeroDivisionError, OverflowError):
        return None
    return unit((x, y, z)) if length((x, y, z)) > _FLAT else None


def _normal(robot: Robot, numbers: RobotNumbers, base: DrawnFrame) -> Vector | None:
    """The normal of the plane that the robot moves in, towards the viewer; None in space."""
    probes = ([start + 0.37 * k for k in range(robot.n)] for start in _PROBES)
    poses = [skeleton(robot, numbers, q) for q in probes]
    candidate = _candidate(poses[0])
    if candidate is None or not all(_moves_across(pose, candidate) for pose in poses):
        return None
    for direction in (base.z, base.axes[1], base.x):
        if abs(dot(direction, candidate)) > 0.5:
            toward = dot(direction, candidate) * (-1.0 if direction is base.axes[1] else 1.0)
            return candidate if toward > 0 else scale(candidate, -1.0)
    return candidate


def _candidate(pose: Skeleton) -> Vector | None:
    turning = [leg.axis for leg in pose.legs if leg.type is JointType.REVOLUTE]
    if turning:
        return turning[0]
    sliding = [leg.axis for leg in pose.legs if leg.type is JointType.PRISMATIC]
    for other in sliding[1:]:
        normal = cross(sliding[0], other)
        if length(normal) > _FLAT:
            return unit(normal)
    return None


def _moves_across(pose: Skeleton, normal: Vector) -> bool:
    """Whether all of a pose lies in one plane with this normal, and moves in it."""
    heights = [dot(normal, point) for point in pose.path]
    if max(heights) - min(heights) > _FLAT or len(heights) < 2:
        return False
    for leg in pose.legs:
        lean = abs(dot(leg.axis, normal))
        if leg.type is JointType.REVOLUTE and lean < 1 - _FLAT:
            return False
        if leg.type is JointType.PRISMATIC and lean > _FLAT:
            return False
    return True
