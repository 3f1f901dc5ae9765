"""Where the mass centres of a robot are at a pose.

One that is given by a symbol which the table does not have lies near the middle of its link.

The uniform bodies of a robot at a pose: how large they are drawn, and how they lie.

A side is as long as it is where the picture knows its length: from the table, from the place of the
mass centre, or by a number of the file.  Any other, as the radius of a cylinder, has a usual size on paper.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Sequence
from enum import Enum
from functools import partial
from itertools import cycle, permutations, product

from msgspec import Struct
from msgspec.structs import replace

from dynsolve.algebra.matrix import Matrix
from dynsolve.algebra.ring import Expr
from dynsolve.algebra.ring_values import evaluate
from dynsolve.draw.skeleton import (
    Leg,
    MassCenter,
    RobotNumbers,
    Skeleton,
    Step,
    finite,
    is_open,
    near_and_far,
    skeleton,
)
from dynsolve.draw.vectors import (
    NEAR,
    Rotation,
    Vector,
    add,
    applied,
    between,
    distance,
    dot,
    into,
    length,
    scale,
    subtract,
)
from dynsolve.notation.tree import names_in
from dynsolve.robot.model import AxesKind, Body, Convention, JointType, Robot
from dynsolve.robot.shapes import AXES, Shape

_SHARES = (1.0, 0.7, 1.3)
"""What part of the way to the middle of a link a free symbol stands for, best first."""

_OF_SLIDING_SHAPES = (0.7, 1.0, 1.3)
"""The same for a shape that slides, of which nothing says that it is as long as it is far out."""

_APART = 0.12
_OFF_AXIS = 0.2
"""How far a mass centre lies off its frame where the table gives its link no length."""

_ON_AXIS, _PAST_AXIS = 0.3, 0.46
"""How far along an axis of its frame a mass centre lies; past the arrow where the next link slides there."""

_UNEVEN = (1.3, 1.0, 0.5)
"""How much each of several symbols counts there, so that their sum looks like none of the axes."""

_CLEAR = 15.0
"""How clear of all else such a centre is to be on paper, where some way to count them gives that."""

_ALL_UNEVEN = tuple(
    tuple(size * sign * part for sign, part in zip(signs, parts, strict=True))
    for size in (1.0, 1.6)
    for signs in product((1.0, -1.0), repeat=3)
    for parts in permutations(_UNEVEN)
)

_MEASURED = 2
"""Up to this number of letters the steps to a mass centre are shown."""

Clear = Callable[[MassCenter, Sequence[MassCenter]], float]

_ON_OPEN, _AT_END = 0.6, 1.0
"""How far along a link the table says no end of, and how far out a point mass at the end of such a link."""


def with_masses(robot: Robot, numbers: RobotNumbers, bare: Skeleton, clear: Clear | None = None) -> Skeleton:
    """The skeleton with its mass centres; `clear` says how clear one is of all else, those before it too."""
    masses: list[MassCenter] = []
    for body in robot.bodies:
        free = free_symbols(robot, body)
        slides = robot.joints[body.link - 1].type is JointType.PRISMATIC and body.uniform_shape is not None
        shares = _OF_SLIDING_SHAPES if slides else _SHARES
        tried = [_mass(robot, numbers, bare, body, free, share) for share in shares]
        apart = (m for m in tried if all(distance(m.center, other.center) > _APART for other in masses))
        found = next(apart, tried[0])
        if clear is not None and len(free) > 1:
            found = _clearest(found, clear, masses, partial(_mass, robot, numbers, bare, body, free, 1.0))
        masses.append(found)
    return replace(bare, masses=tuple(masses))


def _clearest(
    usual: MassCenter,
    clear: Clear,
    others: Sequence[MassCenter],
    counted: Callable[[Sequence[float]], MassCenter],
) -> MassCenter:
    """A mass centre that several letters give, where it is clear of all else, or as clear as can be."""
    if clear(usual, others) >= _CLEAR:
        return usual
    best, most = usual, clear(usual, others)
    for uneven in _ALL_UNEVEN:
        mass = counted(uneven)
        room = clear(mass, others)
        if room >= _CLEAR:
            return mass
        if room > most + NEAR:
            best, most = mass, room
    return best


def _is_from_near(body: Body) -> bool:
    """Whether the file measures the centre from the near end of its link."""
    return re.match(r"\W*(near|along)\b", body.center_written) is not None


def _number(robot: Robot, numbers: RobotNumbers, body: Body) -> Expr | None:
    """The exact distance given as a number, along one axis of the link, from its near end or its origin."""
    center = body.center.entries
    if _is_from_near(body) and robot.convention is Convention.STANDARD:
        row, ring = robot.joints[body.link - 1], robot.ring
        to_near = (row.a, row.d * ring.sin(row.alpha), row.d * ring.cos(row.alpha))
        center = tuple(entry + way for entry, way in zip(center, to_near, strict=True))
    if symbols_of(robot, center):
        return None
    sizes = [(entry, finite(entry, numbers.values)) for entry in center]
    along = [entry if size > 0 else -entry for entry, size in sizes if abs(size) > NEAR]
    return along[0] if len(along) == 1 else None


def _mass(
    robot: Robot,
    numbers: RobotNumbers,
    bare: Skeleton,
    body: Body,
    free: Sequence[str],
    share: float,
    uneven: Sequence[float] = _UNEVEN,
) -> MassCenter:
    frame = bare.frames[body.link]
    near, far = near_and_far(robot, bare, body.link)
    written = body.center_written
    exact = {"tip": far, "origin": frame.origin, "midpoint": between(near, far, 0.5)}
    if written in exact:
        return MassCenter(body.name, exact[written], body.is_point, body.link)
    ends = (into(frame.axes, subtract(end, frame.origin)) for end in (near, far))
    center, local, chosen = _local_center(robot, numbers, body, free, share, uneven, *ends)

    def in_space(point: Vector) -> Vector:
        return add(frame.origin, applied(frame.axes, point))

    place = in_space(center)
    steps = tuple(replace(step, start=in_space(step.start), end=in_space(step.end)) for step in local)
    if not free and (number := _number(robot, numbers, body)):
        steps = (Step(near if _is_from_near(body) else frame.origin, place, number=number),)
    return MassCenter(body.name, place, body.is_point, body.link, steps, chosen)


def _local_center(
    robot: Robot,
    numbers: RobotNumbers,
    body: Body,
    free: Sequence[str],
    share: float,
    uneven: Sequence[float],
    near: Vector,
    far: Vector,
) -> tuple[Vector, tuple[Step, ...], tuple[tuple[str, float], ...]]:
    """The centre in its frame; the straight steps of its free symbols, one after the other; their values."""
    values = dict(numbers.values) | dict.fromkeys(free, 0.0)
    steps: list[Step] = []

    def center(**changed: float) -> Vector:
        state = values | changed
        x, y, z = (finite(entry, state) / numbers.unit for entry in body.center.entries)
        return x, y, z

    middle = between(near, far, 0.5)
    around = robot.joints[body.link : body.link + 1]
    slides = any(joint.type is JointType.PRISMATIC for joint in around)
    usual = _OFF_AXIS
    if is_open(robot, body.link):
        usual = _AT_END if body.is_point else _ON_OPEN
    elif distance(near, far) < NEAR:
        usual = _PAST_AXIS if slides and body.uniform_shape is None else _ON_AXIS
    try:
        found = center()
        for name, part in zip(free, cycle(uneven)):
            so_far = found
            step = subtract(center(**{name: 1.0}), so_far)
            twice = subtract(center(**{name: 2.0}), so_far)
            amount = _best(step, subtract(middle, so_far), distance(near, far), usual, len(free), part)
            values[name] = share * amount
            found = center()
            is_straight = distance(twice, scale(step, 2.0)) < NEAR and distance(so_far, found) > NEAR
            if is_straight and len(free) <= _MEASURED:
                steps.append(Step(so_far, found, length(step) * numbers.unit, name))
    except (ValueError, ZeroDivisionError, OverflowError):
        return middle, (), ()
    return found, tuple(steps), tuple((name, values[name]) for name in free)


def _best(direction: Vector, wanted: Vector, size: float, usual: float, symbols: int, uneven: float) -> float:
    """How far along a direction a wanted vector reaches; were it 0, one of `usual` length.

    It is positive, as letters are: -b lies on the other side than b.
    """
    square = length(direction) ** 2
    if square < NEAR:
        return 0.5
    amount = abs(sum(a * b for a, b in zip(direction, wanted, strict=True))) / square
    if abs(amount) * length(direction) > _OFF_AXIS / 2:
        return amount
    if symbols > 1:
        return uneven * (_OFF_AXIS if size < NEAR else _OFF_AXIS / 2) / length(direction)
    return usual / length(direction)


def free_symbols(robot: Robot, body: Body) -> list[str]:
    """The parameters of a mass centre that the table does not have."""
    fixed = names_in(*(node for joint in robot.joints for node in joint.written))
    return [name for name in symbols_of(robot, body.center.entries) if name not in fixed]


def symbols_of(robot: Robot, written: Sequence[Expr]) -> list[str]:
    """The parameters on which some lengths depend."""
    ring = robot.ring
    ones = dict.fromkeys((q.name for q in robot.coordinates), 0.0)
    values = {name: 1.0 + place / 7 for place, name in enumerate(ring.parameters)} | ones
    values["pi"] = 3.0

    def lengths() -> tuple[float, ...]:
        try:
            return tuple(evaluate(entry, values) for entry in written)
        except (ValueError, ZeroDivisionError, OverflowError):
            return ()

    found = []
    usual = lengths()
    for name in ring.parameters:
        kept, values[name] = values[name], values[name] + 0.5
        if lengths() != usual:
            found.append(name)
        values[name] = kept
    return found


# The uniform bodies of a robot at a pose: how large they are drawn, and how they lie


class Form(Enum):
    """How a body looks: a box, something round about an axis, a ball."""

    BOX = "box"
    ROUND = "round"
    BALL = "ball"


class DrawnBody(Struct, frozen=True):
    """A body on a link: its centre and its axes in space, `main` the one (0, 1 or 2) that it is round about.

    `halves` are half its sides along its axes, where the longest length of the table is 1, or None where
    the picture does not know one; `usual` are those that it then has on paper.  `sides` are those that the
    file gives, each with its axis: 2r of what is round.
    """

    link: int
    form: Form
    center: Vector
    axes: Rotation
    main: int
    halves: tuple[float | None, ...]
    usual: tuple[float, ...]
    sides: tuple[tuple[int, Expr], ...]

    def on_paper(self, size: float) -> tuple[float, ...]:
        """Half its sides on paper, where a length of 1 is that long; none is too thin to be seen."""
        pairs = zip(self.halves, self.usual, strict=True)
        return tuple(max(_THINNEST, usual if half is None else half * size) for half, usual in pairs)


_THINNEST = 3.0

_FORMS = {"box": Form.BOX, "sphere": Form.BALL, "shell": Form.BALL}

_USUAL = {"rod": (6.0, 12.0), "disk": (16.0, 3.0), "sphere": (16.0, 16.0), "shell": (16.0, 16.0)}
"""Half the side on paper of what is no cylinder or box: across its axis, and along it.

One that is round is seen around the mark of its mass centre."""

_SOLID = (9.0, 12.0)

_OUT = 0.9
"""How far out slides are where it is seen what a body without a shape reaches to."""


def drawn_bodies(robot: Robot, numbers: RobotNumbers, pose: Skeleton) -> tuple[DrawnBody, ...]:
    """The uniform bodies that have a shape, of a pose with its mass centres."""
    rest = skeleton(robot, numbers, [0.0] * robot.n)
    found = []
    for body, mass in zip(robot.bodies, pose.masses, strict=True):
        shape = body.uniform_shape
        if shape is None or shape.kind == "point":
            continue
        main = AXES.index(shape.axis) if shape.axis else 2
        known = {key: _length(value, robot, numbers, mass) for key, value in shape.dimensions}
        across, lengthwise = _USUAL.get(shape.kind, _SOLID)
        found.append(
            DrawnBody(
                body.link,
                _FORMS.get(shape.kind, Form.ROUND),
                mass.center,
                _axes(robot, numbers, body, pose, rest),
                main,
                tuple(_halves(shape, main, known)),
                tuple(lengthwise if k == main and shape.kind != "box" else across for k in range(3)),
                tuple(_sides(shape, main)),
            )
        )
    return tuple(found)


def sleeves(robot: Robot, numbers: RobotNumbers) -> dict[int, float]:
    """How far from the foot of a sliding row the body reaches that it slides in, by the row.

    A body without a shape reaches to its mass centre, which then does not seem to be on what slides.
    """
    out = [_OUT if q.type is JointType.PRISMATIC else 0.0 for q in robot.coordinates]
    pose = with_masses(robot, numbers, skeleton(robot, numbers, out))
    bodies = drawn_bodies(robot, numbers, pose)
    found = {}
    for row, (joint, leg) in enumerate(zip(robot.joints, pose.legs, strict=True), 1):
        if joint.type is not JointType.PRISMATIC:
            continue
        ends = [_end(body, leg) for body in bodies if body.link == joint.parent]
        ends += [_height_on(leg, mass.center) for mass in pose.masses if mass.link == joint.parent]
        if reach := max((end for end in ends if end is not None), default=0.0):
            found[row] = reach
    return found


def _height_on(leg: Leg, point: Vector) -> float | None:
    """How far a point of the axis of a leg is from its foot, onward; None of a point beside it or behind."""
    offset = subtract(point, leg.foot)
    height = dot(offset, leg.axis)
    is_on_axis = length(subtract(offset, scale(leg.axis, height))) < NEAR
    return height if is_on_axis and height > NEAR else None


def _end(body: DrawnBody, leg: Leg) -> float | None:
    """How far a body reaches from the foot of a leg, whose axis runs through it lengthwise; else None."""
    height = _height_on(leg, body.center)
    for axis, half in zip(body.axes, body.halves, strict=True):
        if half is not None and abs(dot(axis, leg.axis)) > 1 - NEAR:
            return None if height is None else height + half
    return None


def _halves(shape: Shape, main: int, known: dict[str, float | None]) -> Iterator[float | None]:
    """Half the side along each of the body's axes, by the dimensions that the shape has."""
    for k, axis in enumerate(AXES):
        side = known.get(axis, known.get("length") if k == main else None)
        round_ = "radius" if "radius" in known else "outer"
        if side is not None:
            yield side / 2
        elif k != main or _FORMS.get(shape.kind) is Form.BALL:
            yield known.get(round_)
        else:
            yield None


def _sides(shape: Shape, main: int) -> Iterator[tuple[int, Expr]]:
    """The whole sides that a shape has, each with its axis; those of what is round across its own axis."""
    along_axes = {"length": main, **{axis: k for k, axis in enumerate(AXES)}}
    for key, value in shape.dimensions:
        if key in along_axes:
            yield along_axes[key], value
        elif key != "inner":
            yield (main + 1) % 3, 2 * value


def _length(written: Expr, robot: Robot, numbers: RobotNumbers, mass: MassCenter) -> float | None:
    """A length as it is drawn; None where the picture knows nothing of it."""
    table = names_in(*(node for joint in robot.joints for node in joint.written))
    chosen = dict(mass.chosen)
    if not {*symbols_of(robot, [written])} <= {*table, *numbers.given, *chosen}:
        return None
    try:
        return abs(finite(written, {**numbers.values, **chosen})) / numbers.unit
    except (ValueError, ZeroDivisionError, OverflowError):
        return None


def _axes(robot: Robot, numbers: RobotNumbers, body: Body, pose: Skeleton, rest: Skeleton) -> Rotation:
    """The body's axes in space; those that are given from the base are fixed in its link at q = 0."""
    given = _columns(robot, numbers, body.axes.rotation)
    if body.axes.kind is not AxesKind.LINK:
        at_rest = rest.frames[body.link].axes
        given = _each(given, lambda column: into(at_rest, applied(numbers.base, column)))
    return _each(given, lambda column: applied(pose.frames[body.link].axes, column))


def _columns(robot: Robot, numbers: RobotNumbers, R: Matrix) -> Rotation:
    rows = ([finite(entry, numbers.values) for entry in row] for row in R.rows)
    x, y, z = zip(*rows, strict=True)
    return x, y, z


def _each(R: Rotation, change: Callable[[Vector], Vector]) -> Rotation:
    return change(R[0]), change(R[1]), change(R[2])
