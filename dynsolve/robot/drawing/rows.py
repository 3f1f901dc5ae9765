"""The rows of a Denavit-Hartenberg table from the normals of an arm.

    θ_i  from x_{i-1} to x_i about z       a_i  from z to z' along x_i
    d_i  from x_{i-1} to x_i along z       α_i  from z to z' about x_i

where z is the axis of joint i and z' that of joint i + 1.  A row of the standard table holds
θ_i, d_i, a_i, α_i, one of the modified table α_{i-1}, a_{i-1}, θ_i, d_i (there both in its own
order of motions).  Where one row cannot reach the hand, a fixed row follows.
"""

from __future__ import annotations

from dataclasses import dataclass

from dynsolve.algebra.angles import Angle
from dynsolve.algebra.expr import Expr
from dynsolve.algebra.matrix import Matrix, cross
from dynsolve.robot.drawing.angles import angle_of
from dynsolve.robot.drawing.drawn import DrawnAxis, dot
from dynsolve.robot.drawing.normals import NoAngle, naming_axis
from dynsolve.robot.drawing.procedure import Normals
from dynsolve.robot.model import Convention


@dataclass(frozen=True, slots=True)
class DrawnRow:
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


@dataclass(frozen=True, slots=True)
class _Move:
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
