"""The Jacobian, column by column.

Spong, Hutchinson, Vidyasagar, section 4.6: for a revolute joint the column is
z × (p - o) over z, for a prismatic one z over 0, where z and o belong to the frame
the joint turns about: i-1 in the standard convention, i in the modified one.
"""

from __future__ import annotations

from collections.abc import Sequence

from dynsolve.algebra.matrix import Matrix, cross, hstack
from dynsolve.derivation.kinematics import axis, origin
from dynsolve.robot.model import Convention, Joint, JointType, Robot


def joint_frame(robot: Robot, joint: Joint) -> int:
    """The number of the frame whose z axis the joint turns about or slides along."""
    return joint.index - 1 if robot.convention is Convention.STANDARD else joint.index


def joint_columns(
    robot: Robot, joint: Joint, frames: Sequence[Matrix], point: Matrix
) -> tuple[Matrix, Matrix]:
    """(J_v, J_w) of one joint alone, 3×1 each, for a point that it carries."""
    H = frames[joint_frame(robot, joint)]
    z, o = axis(H), origin(H)
    if joint.type is JointType.REVOLUTE:
        return cross(z, point - o), z
    return z, Matrix.zero(robot.ring, 3, 1)


def jacobian(robot: Robot, frames: Sequence[Matrix], point: Matrix, link: int) -> tuple[Matrix, Matrix]:
    """(J_v, J_w), 3×n each, of a point fixed in frame `link`; columns of joints after it are zero.

    `frames` are H_0..H_m.  Where a joint variable is Σ rate·q_k, its column counts
    for each q_k with that rate.
    """
    zero = Matrix.zero(robot.ring, 3, 1)
    linear, angular = [zero] * robot.n, [zero] * robot.n
    for joint in robot.joints[:link]:
        if joint.type is None:
            continue
        v, w = joint_columns(robot, joint, frames, point)
        for k, rate in joint.rates:
            factor = robot.ring.constant(rate)
            linear[k] = linear[k] + v.scale(factor)
            angular[k] = angular[k] + w.scale(factor)
    return hstack(robot.ring, linear, 3), hstack(robot.ring, angular, 3)
