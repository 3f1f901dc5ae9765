"""What a drawing of an arm shows: its joint axes and its hand in one pose."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from dynsolve.algebra.expr import Expr
from dynsolve.algebra.matrix import Matrix
from dynsolve.algebra.ring import Ring
from dynsolve.robot.model import Convention, JointType


@dataclass(frozen=True, slots=True)
class Line:
    """A directed line in space: a point of it and its unit direction, both 3×1 in world coordinates."""

    point: Matrix
    direction: Matrix

    def foot(self, point: Matrix) -> Matrix:
        """The point of the line that is nearest to another, 3×1."""
        return self.point + self.direction.scale(dot(self.direction, point - self.point))


@dataclass(frozen=True, slots=True)
class DrawnAxis:
    """A joint axis in the pose that is drawn.

    `coordinate` names its joint variable.  The place of a sliding axis moves nothing; where
    the drawing leaves it open, `is_placed` is False and the line any of them (`places`).
    """

    coordinate: str
    type: JointType
    line: Line
    is_placed: bool = True

    @property
    def slides(self) -> bool:
        """Whether the joint is prismatic."""
        return self.type is JointType.PRISMATIC


@dataclass(frozen=True, slots=True)
class Hand:
    """The hand in the pose that is drawn: where it is, and its axes z and x where they are given."""

    at: Matrix
    z: Matrix | None = None
    x: Matrix | None = None


@dataclass(frozen=True, slots=True)
class Drawing:
    """An arm as it is drawn; every vector is 3×1 over `ring`, in world coordinates.

    The letter of a sliding joint is its value in that pose, where the drawing has it at
    all; where it does not, the joint is at 0.  Turning joints are at 0 as drawn where
    `zero_is_drawn`; otherwise the coordinates are the variables of the table.
    """

    ring: Ring
    convention: Convention
    axes: tuple[DrawnAxis, ...]
    hand: Hand
    zero_is_drawn: bool

    def drawn_slide(self, axis: DrawnAxis) -> bool:
        """Whether the axis slides, and the drawing has its letter."""
        return axis.slides and self.ring.has_symbol(axis.coordinate)

    @property
    def vectors(self) -> Iterator[Matrix]:
        """Every point and direction."""
        for axis in self.axes:
            yield from (axis.line.point, axis.line.direction)
        yield from (vector for vector in (self.hand.at, self.hand.z, self.hand.x) if vector is not None)


def dot(a: Matrix, b: Matrix) -> Expr:
    """a · b of two 3×1 columns."""
    return a.ring.dot(a.entries, b.entries)
