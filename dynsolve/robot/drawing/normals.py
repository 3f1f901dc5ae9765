"""The common normal of two lines: where x_i, a_i and α_i come from.

Of two axes that follow each other, z to z', the normal x leads from the first to the
second, a is its length and α the angle from z to z' about it (Spong et al. 3.2.2, Craig 3.4):

    skew          x = ±(z × z') / sin α, one line only; a > 0
    intersecting  x = ±(z × z') / sin α, through the intersection; a = 0
    parallel      any line across from the first axis to the second; α = 0° or 180°
    coincident    any line across; a = 0, α = 0° or 180°

What is free is chosen so that fewer entries of the table differ from 0: of two directions
the one nearer to the x before, of parallel normals the one through a given foot.

The normals along an arm as it is drawn: the textbook's procedure.

A normal leads from each axis to the next; one more stands before the first axis, where frame
0 is, and one after the last leads to the hand.  Frame 0 is at the origin of the world with
its x where the first axis allows it: where they can be the world's, they are.

What a drawing of an arm shows: its joint axes and its hand in one pose.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from enum import Enum
from fractions import Fraction
from itertools import pairwise

from msgspec import Struct

from dynsolve.algebra.angles import Angle
from dynsolve.algebra.matrix import Matrix, cross
from dynsolve.algebra.ring import Expr, Ring
from dynsolve.errors import AlgebraError
from dynsolve.notation.tree import Number
from dynsolve.robot.drawing.angles import angle_between, direction_angles, sign
from dynsolve.robot.model import Convention, JointType

# What a drawing of an arm shows: its joint axes and its hand in one pose


class Line(Struct, frozen=True):
    """A directed line in space: a point of it and its unit direction, both 3×1 in world coordinates."""

    point: Matrix
    direction: Matrix

    def foot(self, point: Matrix) -> Matrix:
        """The point of the line that is nearest to another, 3×1."""
        return self.point + self.direction.scale(dot(self.direction, point - self.point))


class DrawnAxis(Struct, frozen=True):
    """A joint axis in the pose that is drawn.

    `coordinate` names its joint variable.  The place of a sliding axis moves nothing; where
    the drawing leaves it open, `is_placed` is False and the line any of them (`rows`).
    """

    coordinate: str
    type: JointType
    line: Line
    is_placed: bool = True

    @property
    def slides(self) -> bool:
        """Whether the joint is prismatic."""
        return self.type is JointType.PRISMATIC


class Hand(Struct, frozen=True):
    """The hand in the pose that is drawn: where it is, and its axes z and x where they are given."""

    at: Matrix
    z: Matrix | None = None
    x: Matrix | None = None


class Drawing(Struct, frozen=True):
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


_HALF_TURN = Angle((), Fraction(180))


class Relation(Enum):
    """How two lines lie, or why a normal has no two lines."""

    SKEW = "skew"
    INTERSECTING = "intersecting"
    PARALLEL = "parallel"
    COINCIDENT = "coincident"
    BASE = "base"
    HAND = "hand"


class NoAngle(AlgebraError):
    """An angle of the drawing, or a length, is none that can be written.

    An angle is a number of degrees, or made of the angles of the drawing.  `axis` is the place
    (from 0) of the joint axis that shows it, None for the hand.
    """

    axis: int | None = None


@contextmanager
def naming_axis(place: int | None) -> Iterator[None]:
    """Say in a NoAngle that is raised meanwhile which axis shows the angle."""
    try:
        yield
    except NoAngle as error:
        error.axis = place
        raise


class NeedsMore(Exception):
    """The ring must hold more: the square root of `missing`, or the sine and cosine of that angle."""

    def __init__(self, missing: Expr | Angle) -> None:
        super().__init__()
        self.missing = missing


class Normal(Struct, frozen=True):
    """The normal from one axis to the next.

    `x` is its unit direction (3×1), `start` and `end` its ends on the two axes (3×1), `a` how
    far it leads along x, `alpha` the angle from the first axis to the second about x.
    """

    relation: Relation
    x: Matrix
    start: Matrix
    end: Matrix
    a: Expr
    alpha: Angle


def common_normal(first: Line, second: Line, x_before: Matrix, foot: Matrix) -> Normal:
    """The normal of two axes; `x_before` is the x of the normal before it, `foot` a point on the first axis.

    Parallel axes have many normals: the one through `foot` is taken.
    Raises NoAngle where the angle between the axes is not found.
    """
    ring = first.point.ring
    across = cross(first.direction, second.direction)
    if across.is_zero:
        alpha = Angle.zero() if dot(first.direction, second.direction) == ring.one else _HALF_TURN
        return parallel_normal(first, second.foot(foot), x_before, alpha)
    alpha = _between(first.direction, second.direction)
    x = across.map(lambda entry: divided(entry, ring.sin(alpha)))
    between = second.point - first.point
    a = dot(between, x)
    relation = Relation.INTERSECTING if a.is_zero else Relation.SKEW
    if (sign(a) or sign(dot(x_before, x))) < 0:
        x, a, alpha = -x, -a, -alpha
    along = divided(dot(cross(between, second.direction), x), ring.sin(alpha))
    start = first.point + first.direction.scale(along)
    return Normal(relation, x, start, start + x.scale(a), a, alpha)


def divided(value: Expr, divisor: Expr) -> Expr:
    """value / divisor; no fraction where the polynomial of the divisor goes into that of the value."""
    if divisor.is_number:
        return value / divisor.number
    quotient, rest = divmod(value.poly, divisor.poly)
    return value * value.ring.inverse(divisor) if rest else Expr(value.ring, quotient)


def parallel_normal(first: Line, target: Matrix, x_before: Matrix, alpha: Angle) -> Normal:
    """The normal from an axis to a point, where what goes through that point is parallel to the axis."""
    start = first.foot(target)
    across = target - start
    if across.is_zero:
        return Normal(Relation.COINCIDENT, x_before, start, target, target.ring.zero, alpha)
    x, a = unit(across, x_before, first.direction)
    return Normal(Relation.PARALLEL, x, start, target, a, alpha)


def unit(vector: Matrix, x: Matrix, z: Matrix) -> tuple[Matrix, Expr]:
    """(unit direction, length) of a vector that is perpendicular to z, as x is.

    Raises NeedsMore where the ring does not hold its length or its direction.
    """
    ring = vector.ring
    y = cross(z, x)
    along, across = dot(vector, x), dot(vector, y)
    for angle in direction_angles(along, across):
        try:
            c, s = ring.cos(angle), ring.sin(angle)
        except AlgebraError:
            raise NeedsMore(angle) from None
        if (across * c - along * s).is_zero:
            return x.scale(c) + y.scale(s), along * c + across * s
    length = root(ring, along * along + across * across)
    return vector.map(lambda entry: divided(entry, length)), length


def root(ring: Ring, square: Expr) -> Expr:
    """√square, where the ring has it."""
    if square.is_number and ring.plan.constants.holds_root(square.number):
        return ring.root(Number(square.number.numerator, square.number.denominator), square)
    for index, radicand in ring.radicands.items():
        if radicand == square.poly:
            return ring.generator(index)
    degrees = square.poly.degrees()
    if any(degrees[place] > 0 for pair in ring.pairs for place in (pair.sine, pair.cosine)):
        raise NoAngle(
            "a length of this drawing is the root of an expression with sines and cosines",
            "give the points along the directions of the axes, with letters for the lengths between them",
        )
    raise NeedsMore(square)


def _between(z: Matrix, other: Matrix) -> Angle:
    angle = angle_between(dot(z, other))
    if angle is None:
        raise NoAngle(
            "the angle between two axes is no number of degrees",
            "name it: with an angle beta a direction is written [cos(beta), 0, sin(beta)]",
        )
    return angle


# The normals along an arm as it is drawn: the textbook's procedure


class Normals(Struct, frozen=True):
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
