"""A Denavit-Hartenberg table in numbers, as the chain of joint axes that it describes.

A chain knows no frames: only where each joint's axis lies and which way it points when every
coordinate is 0, and where the hand is then.  Two tables describe the same mechanism where their
chains can be laid on each other (`matching`), whatever frames they were made with.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from dynsolve.derivation.newton_euler import (
    IDENTITY,
    ZERO,
    Rotation,
    Vector,
    column,
    elementary,
    plus,
    scaled,
    times,
)

Rates = tuple[tuple[int, float], ...]
"""(index of a coordinate from 0, how fast the joint moves with it)"""


@dataclass(frozen=True, slots=True)
class NumberRow:
    """A row in numbers: the constant parts of θ and d, and a and α; angles in radians.

    `variable` is "theta" or "d", None for a fixed frame; `rates` belong to it.
    """

    theta: float
    d: float
    a: float
    alpha: float
    variable: str | None = None
    rates: Rates = ()


@dataclass(frozen=True, slots=True)
class JointLine:
    """A joint axis where every coordinate is 0; `row` is that of the table, from 1."""

    turns: bool
    point: Vector
    direction: Vector
    rates: Rates
    row: int


@dataclass(frozen=True, slots=True)
class Pose:
    """Where a frame is: its axes as the columns of R, and its origin."""

    R: Rotation
    o: Vector

    def turned(self, axis: str, angle: float) -> Pose:
        """The frame after a turn about one of its own axes."""
        return Pose(times(self.R, elementary(axis, angle)), self.o)

    def moved(self, axis: str, way: float) -> Pose:
        """The frame after a slide along one of its own axes."""
        return Pose(self.R, plus(self.o, scaled(column(self.R, 0 if axis == "x" else 2), way)))


@dataclass(frozen=True, slots=True)
class Chain:
    """The joint axes from the base to the hand, and the hand's frame, where every coordinate is 0."""

    joints: tuple[JointLine, ...]
    hand: Pose


def chain_of(rows: Iterable[NumberRow], modified: bool) -> Chain:
    """The chain of a table, seen from its frame 0."""
    joints: list[JointLine] = []
    pose = Pose(IDENTITY, ZERO)
    for index, row in enumerate(rows, 1):
        if modified:
            pose = pose.turned("x", row.alpha).moved("x", row.a)
        if row.variable:
            turns = row.variable == "theta"
            joints.append(JointLine(turns, pose.o, column(pose.R, 2), row.rates, index))
        pose = pose.turned("z", row.theta).moved("z", row.d)
        if not modified:
            pose = pose.moved("x", row.a).turned("x", row.alpha)
    return Chain(tuple(joints), pose)
