"""The uniform bodies of a robot at a pose: how large they are drawn, and how they lie.

A side is as long as it is where the picture knows its length: from the table, from the place of the
mass centre, or by a number of the file.  Any other, as the radius of a cylinder, has a usual size on paper.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from enum import Enum

from dynsolve.algebra.expr import Expr
from dynsolve.algebra.matrix import Matrix
from dynsolve.draw.drawn_lengths import RobotNumbers, finite
from dynsolve.draw.mass_centers import symbols_of, with_masses
from dynsolve.draw.skeleton import Leg, MassCenter, Skeleton, skeleton
from dynsolve.draw.vectors import NEAR, Rotation, Vector, applied, dot, into, length, scale, subtract
from dynsolve.notation.walk import names_in
from dynsolve.robot.model import AxesKind, Body, JointType, Robot
from dynsolve.robot.shapes import AXES, Shape


class Form(Enum):
    """How a body looks: a box, something round about an axis, a ball."""

    BOX = "box"
    ROUND = "round"
    BALL = "ball"


@dataclass(frozen=True, slots=True)
class DrawnBody:
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

_USUAL = {"rod": (6.0, 12.0), "disk": (13.0, 3.0), "sphere": (12.0, 12.0), "shell": (12.0, 12.0)}
"""Half the side on paper of what is no cylinder or box: across its axis, and along it."""

_SOLID = (9.0, 12.0)

_OUT = 0.9
"""How far out slides are where it is seen what a body without a shape reaches to."""


def drawn_bodies(robot: Robot, numbers: RobotNumbers, pose: Skeleton) -> tuple[DrawnBody, ...]:
    """The bodies that have a shape, of a pose with its mass centres."""
    rest = skeleton(robot, numbers, [0.0] * robot.n)
    found = []
    for body, mass in zip(robot.bodies, pose.masses, strict=True):
        shape = body.shape
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
    rows: Sequence[Sequence[float]] = [[finite(entry, numbers.values) for entry in row] for row in R.rows]
    x, y, z = ((rows[0][k], rows[1][k], rows[2][k]) for k in range(3))
    return x, y, z


def _each(R: Rotation, change: Callable[[Vector], Vector]) -> Rotation:
    return change(R[0]), change(R[1]), change(R[2])
