"""The normals along an arm as it is drawn: the textbook's procedure.

A normal leads from each axis to the next; one more stands before the first axis, where frame
0 is, and one after the last leads to the hand.  Frame 0 is at the origin of the world with
its x where the first axis allows it: where they can be the world's, they are.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import pairwise

from dynsolve.algebra.angles import Angle
from dynsolve.algebra.matrix import Matrix, cross
from dynsolve.robot.drawing.drawn import Drawing, DrawnAxis, Line, dot
from dynsolve.robot.drawing.normals import (
    Normal,
    Relation,
    common_normal,
    naming_axis,
    parallel_normal,
    unit,
)


@dataclass(frozen=True, slots=True)
class Normals:
    """The normals of an arm: `all[0]` at frame 0, `all[i]` from axis i to i + 1, `all[-1]` to the hand.

    `hand` is the line of the hand's z, the last axis's direction where none is given, and
    `hand_x` the hand's x, or that of the last normal.
    """

    drawing: Drawing
    all: tuple[Normal, ...]
    hand: Line
    hand_x: Matrix

    @property
    def lines(self) -> tuple[Line, ...]:
        """The joint axes, and the hand's z."""
        return (*(axis.line for axis in self.drawing.axes), self.hand)


def normals_of(drawing: Drawing) -> Normals:
    """The normals of an arm all of whose axes have a place.

    Raises NoAngle for an angle that is not found, NeedsMore for what the ring does not hold.
    """
    found = [_base(drawing.axes[0].line)]
    for i, (axis, following) in enumerate(pairwise(drawing.axes), 1):
        foot = _foot(drawing, axis, found[-1])
        with naming_axis(i):
            found.append(common_normal(axis.line, following.line, found[-1].x, foot))
    last, hand = drawing.axes[-1], drawing.hand
    if hand.z is None:
        end = parallel_normal(last.line, hand.at, found[-1].x, Angle.zero())
        line = Line(hand.at, last.line.direction)
    else:
        line = Line(hand.at, hand.z)
        end = common_normal(last.line, line, found[-1].x if hand.x is None else hand.x, hand.at)
    return Normals(drawing, (*found, end), line, end.x if hand.x is None else hand.x)


def _foot(drawing: Drawing, axis: DrawnAxis, before: Normal) -> Matrix:
    """Where a normal of parallel axes starts: d is 0 there, of a sliding joint its bare variable."""
    if not drawing.drawn_slide(axis):
        return before.end
    return before.end + axis.line.direction.scale(drawing.ring.symbol(axis.coordinate))


def _base(first: Line) -> Normal:
    """Frame 0: its x and its origin, which lies on the first axis."""
    ring = first.point.ring
    origin = first.foot(Matrix.zero(ring, 3, 1))
    return Normal(Relation.BASE, _base_x(first), origin, origin, ring.zero, Angle.zero())


def _base_x(first: Line) -> Matrix:
    """The first of the world's axes x, y, z that is perpendicular to the first joint axis."""
    ring = first.point.ring
    identity = Matrix.identity(ring, 3)
    for k in range(3):
        if dot(identity.column_at(k), first.direction).is_zero:
            return identity.column_at(k)
    # none is: across from the world's z, in the world's x-y plane
    vector = cross(identity.column_at(2), first.direction)
    x, _ = unit(vector, identity.column_at(0), identity.column_at(2))
    return x


def frames(normals: Normals, modified: bool) -> Iterator[tuple[Matrix, Matrix, Matrix]]:
    """(origin, x, z) of frame 0, 1, ... in the pose that is drawn, each 3×1 in world coordinates.

    Standard: z_i is the axis of joint i + 1, modified: of joint i; the hand's frame is the last.
    """
    lines = normals.lines
    if modified:
        first = normals.all[0]
        yield first.end, first.x, lines[0].direction
        for normal, line in zip(normals.all[1:], lines, strict=False):
            yield normal.start, normal.x, line.direction
    else:
        for normal, line in zip(normals.all, lines, strict=True):
            yield normal.end, normal.x, line.direction
