"""The rows of a Denavit-Hartenberg table from the normals of an arm.

    θ_i  from x_{i-1} to x_i about z       a_i  from z to z' along x_i
    d_i  from x_{i-1} to x_i along z       α_i  from z to z' about x_i

where z is the axis of joint i and z' that of joint i + 1.  A row of the standard table holds
θ_i, d_i, a_i, α_i, one of the modified table α_{i-1}, a_{i-1}, θ_i, d_i (there both in its own
order of motions).  Where one row cannot reach the hand, a fixed row follows.

Where a sliding axis is laid that is drawn nowhere in particular.

A prismatic joint has a direction and no place (Craig 3.4): its axis may be any line along
it.  Of the lines through the axis before, through the axis after it or the hand, and
through the origin of the world, those are taken with which fewest lengths of the table differ from 0.
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import product

from msgspec import Struct
from msgspec.structs import replace

from dynsolve.algebra.angles import Angle
from dynsolve.algebra.matrix import Matrix, cross
from dynsolve.algebra.ring import Expr
from dynsolve.robot.drawing.angles import angle_of
from dynsolve.robot.drawing.normals import (
    Drawing,
    DrawnAxis,
    Line,
    NeedsMore,
    NoAngle,
    Normals,
    dot,
    naming_axis,
    normals_of,
)
from dynsolve.robot.model import Convention


class DrawnRow(Struct, frozen=True):
    """A row of the table: the joint whose variable it holds, None for a fixed frame.

    `theta` and `d` are constant parts: the variable is added to that of the joint's column.
    """

    axis: DrawnAxis | None
    theta: Angle
    d: Expr
    a: Expr
    alpha: Angle

    @property
    def is_nothing(self) -> bool:
        """Whether a fixed frame would be the one before it."""
        zero = Angle.zero()
        lengths = self.d.is_zero and self.a.is_zero
        return self.axis is None and lengths and self.theta == zero and self.alpha == zero


class _Move(Struct, frozen=True):
    """θ and d: from one normal to the next along and about the axis between them."""

    axis: DrawnAxis | None
    theta: Angle
    d: Expr


def rows_of(normals: Normals) -> tuple[DrawnRow, ...]:
    """The rows of the table, in the convention of the drawing.

    Raises NoAngle where a θ that is not a coordinate by itself is no angle that can be written.
    """
    moves = (*_joint_moves(normals), _hand_move(normals))
    zero = normals.drawing.ring.zero
    links = [(normal.a, normal.alpha) for normal in normals.all[1:]]
    if normals.drawing.convention is Convention.MODIFIED:
        links = [(zero, Angle.zero()), *links]
    else:
        links = [*links, (zero, Angle.zero())]
    rows = [
        DrawnRow(move.axis, move.theta, move.d, a, alpha)
        for move, (a, alpha) in zip(moves, links, strict=True)
    ]
    return tuple(row for row in rows if not row.is_nothing)


def _joint_moves(normals: Normals) -> list[_Move]:
    drawing = normals.drawing
    moves = []
    for i, axis in enumerate(drawing.axes):
        before, after = normals.all[i], normals.all[i + 1]
        d = dot(after.start - before.end, axis.line.direction)
        if drawing.drawn_slide(axis):
            d = d - drawing.ring.symbol(axis.coordinate)
        is_offset_free = not drawing.zero_is_drawn
        theta = Angle.zero()
        if axis.slides or not is_offset_free:
            with naming_axis(i):
                theta = _theta(before.x, after.x, axis.line.direction, axis)
        moves.append(_Move(axis, theta, drawing.ring.zero if axis.slides and is_offset_free else d))
    return moves


def _hand_move(normals: Normals) -> _Move:
    """What is left to the hand about and along its own z."""
    last, z = normals.all[-1], normals.hand.direction
    d = dot(normals.hand.point - last.end, z)
    return _Move(None, _theta(last.x, normals.hand_x, z, None), d)


def _theta(x_before: Matrix, x: Matrix, z: Matrix, axis: DrawnAxis | None) -> Angle:
    angle = angle_of(dot(x_before, x), dot(cross(x_before, x), z))
    if angle is None:
        where = f"the joint of {axis.coordinate}" if axis else "the hand"
        help = "name it: with an angle beta a direction is written [cos(beta), 0, sin(beta)]"
        if axis is not None and not axis.slides:
            help = "write zero: table, and the coordinate is the angle of the table itself"
        raise NoAngle(f"θ at {where} is no number of degrees in the pose that is drawn", help)
    return angle


# Where a sliding axis is laid that is drawn nowhere in particular

_MOST_CHOICES = 81


def placed(drawing: Drawing) -> Drawing:
    """The drawing with every sliding axis in a place.

    Raises what `normals_of` and `rows_of` raise.
    """
    if all(axis.is_placed for axis in drawing.axes):
        return drawing
    choices = [tuple(_choices(drawing, i)) for i in range(len(drawing.axes))]
    every = (
        replace(drawing, axes=axes) for axes, _ in zip(product(*choices), range(_MOST_CHOICES), strict=False)
    )
    return min(every, key=_offsets)


def _choices(drawing: Drawing, i: int) -> Iterator[DrawnAxis]:
    """The axis as it is, or in each of the places it may have."""
    axis = drawing.axes[i]
    if axis.is_placed:
        yield axis
        return
    points = [other.line.point for other in drawing.axes[:i][::-1] if other.is_placed][:1]
    points += [other.line.point for other in drawing.axes[i + 1 :] if other.is_placed][:1]
    points += [drawing.hand.at, Matrix.zero(drawing.ring, 3, 1)]
    for point in dict.fromkeys(points):
        yield replace(axis, line=Line(point, axis.line.direction))


def _offsets(drawing: Drawing) -> int:
    """How many lengths of the table and of the base differ from 0; many where there is no table."""
    try:
        normals = normals_of(drawing)
        lengths = [length for row in rows_of(normals) for length in (row.a, row.d)]
    except (NoAngle, NeedsMore):
        return 4 * len(drawing.axes)
    lengths += normals.all[0].end.entries
    return sum(not length.is_zero for length in lengths)
