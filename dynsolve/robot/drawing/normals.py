"""The common normal of two lines: where x_i, a_i and α_i come from.

Of two axes that follow each other, z to z', the normal x leads from the first to the
second, a is its length and α the angle from z to z' about it (Spong et al. 3.2.2, Craig 3.4):

    skew          x = ±(z × z') / sin α, one line only; a > 0
    intersecting  x = ±(z × z') / sin α, through the intersection; a = 0
    parallel      any line across from the first axis to the second; α = 0° or 180°
    coincident    any line across; a = 0, α = 0° or 180°

What is free is chosen so that fewer entries of the table differ from 0: of two directions
the one nearer to the x before, of parallel normals the one through a given foot.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from enum import Enum
from fractions import Fraction

from dynsolve.algebra.angles import Angle
from dynsolve.algebra.expr import Expr
from dynsolve.algebra.matrix import Matrix, cross
from dynsolve.algebra.ring import Ring
from dynsolve.errors import AlgebraError
from dynsolve.notation.tree import Number
from dynsolve.robot.drawing.angles import angle_between, direction_angles, sign
from dynsolve.robot.drawing.drawn import Line, dot

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


@dataclass(frozen=True, slots=True)
class Normal:
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
