"""The Jacobian, column by column.

Spong, Hutchinson, Vidyasagar, section 4.6: for a revolute joint the column is
z × (p - o) over z, for a prismatic one z over 0, where z and o belong to the frame
the joint turns about: that where the row starts, i-1, in the standard convention, i in the modified one.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

from dynsolve.algebra.matrix import Matrix, cross, hstack
from dynsolve.derivation.kinematics import axis, origin
from dynsolve.robot.model import Convention, Joint, JointType, Robot


def joint_frame(robot: Robot, joint: Joint) -> int:
    """The number of the frame whose z axis the joint turns about or slides along."""
    return joint.parent if robot.convention is Convention.STANDARD else joint.index


def linear_jacobian(robot: Robot, frames: Sequence[Matrix], point: Matrix, link: int) -> Matrix:
    """J_v, 3×n, of a point fixed in frame `link`: z × (p - o), or z of a prismatic joint.

    `frames` are H_0..H_m, of which those of the joints up to `link` are used.
    """

    def column(joint: Joint, H: Matrix) -> Matrix:
        return cross(axis(H), point - origin(H)) if joint.type is JointType.REVOLUTE else axis(H)

    return _by_coordinate(robot, frames, link, column)


def angular_jacobian(robot: Robot, frames: Sequence[Matrix], link: int) -> Matrix:
    """J_ω, 3×n, of frame `link`: z, or zero of a prismatic joint."""
    zero = Matrix.zero(robot.ring, 3, 1)

    def column(joint: Joint, H: Matrix) -> Matrix:
        return axis(H) if joint.type is JointType.REVOLUTE else zero

    return _by_coordinate(robot, frames, link, column)


def _by_coordinate(
    robot: Robot, frames: Sequence[Matrix], link: int, column: Callable[[Joint, Matrix], Matrix]
) -> Matrix:
    """The columns of the joints that carry `link`, summed up by coordinate; those of others are zero.

    Where a joint variable is Σ rate·q_k, the joint's column counts for each q_k with that rate.
    """
    columns = [Matrix.zero(robot.ring, 3, 1)] * robot.n
    for joint in robot.path(link):
        if joint.type is None:
            continue
        moved = column(joint, frames[joint_frame(robot, joint)])
        for k, rate in joint.rates:
            columns[k] = columns[k] + moved.scale(robot.ring.constant(rate))
    return hstack(robot.ring, columns, 3)
