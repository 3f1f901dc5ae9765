"""Forward kinematics: A_i from a row of the table, H_i as their product.

Spong, Hutchinson, Vidyasagar, Robot Modeling and Control, section 3.2;
Craig, Introduction to Robotics, section 3.4, for the modified convention.

The Jacobian, column by column.

Spong, Hutchinson, Vidyasagar, section 4.6: for a revolute joint the column is
z × (p - o) over z, for a prismatic one z over 0, where z and o belong to the frame
the joint turns about: that where the row starts, i-1, in the standard convention, i in the modified one.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any

from dynsolve.algebra.matrix import Matrix, cross, hstack
from dynsolve.algebra.ring import Expr
from dynsolve.robot.model import Convention, Joint, JointType, Robot


def dh_matrix(robot: Robot, joint: Joint) -> Matrix:
    """A_i, 4×4: frame i seen from frame i-1.

    Standard:  [[cθ, -sθ cα,  sθ sα, a cθ], [sθ,  cθ cα, -cθ sα, a sθ], [0, sα, cα, d], [0, 0, 0, 1]]
    Modified:  [[cθ, -sθ, 0, a], [sθ cα, cθ cα, -sα, -d sα], [sθ sα, cθ sα, cα, d cα], [0, 0, 0, 1]]
    """
    ring = robot.ring
    c, s = ring.cos(joint.theta), ring.sin(joint.theta)
    ca, sa = ring.cos(joint.alpha), ring.sin(joint.alpha)
    a, d, zero, one = joint.a, joint.d, ring.zero, ring.one
    if robot.convention is Convention.STANDARD:
        rows = [[c, -s * ca, s * sa, a * c], [s, c * ca, -c * sa, a * s], [zero, sa, ca, d]]
    else:
        rows = [[c, -s, zero, a], [s * ca, c * ca, -sa, -d * sa], [s * sa, c * sa, ca, d * ca]]
    return Matrix.of(ring, [*rows, [zero, zero, zero, one]])


def base_transform(robot: Robot) -> Matrix:
    """H_0, 4×4: frame 0 in the world; the identity unless the file turns or moves the base."""
    ring = robot.ring
    rotation, position = robot.base_rotation, robot.base_position
    rows = [[*row, p] for row, p in zip(rotation.rows, position.entries, strict=True)]
    return Matrix.of(ring, [*rows, [ring.zero, ring.zero, ring.zero, ring.one]])


def frame(before: Matrix, step: Matrix) -> Matrix:
    """H_i = H_{i-1} A_i, 4×4."""
    return before @ step


def rotation(H: Matrix) -> Matrix:
    """R, 3×3, of a homogeneous transformation."""
    return H.block(0, 3, 0, 3)


def origin(H: Matrix) -> Matrix:
    """o, 3×1, of a homogeneous transformation."""
    return H.block(0, 3, 3, 4)


def axis(H: Matrix) -> Matrix:
    """z, 3×1, of a homogeneous transformation."""
    return H.block(0, 3, 2, 3)


def point(H: Matrix, local: Matrix) -> Matrix:
    """R·local + o, 3×1: a point fixed in the frame, seen from the base."""
    return rotation(H) @ local + origin(H)


def frame_names(link: int) -> tuple[str, ...]:
    """The frames up to that of a link, as the derivation calls them: H0..H<link>."""
    return tuple(f"H{i}" for i in range(link + 1))


# The Jacobian, column by column


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


def distances_from_axis(robot: Robot, values: Mapping[str, Any]) -> Iterator[Expr]:
    """The components of the ways from the first axis about which something turns to the mass centres.

    They stand beside the rate of its angle in the velocities, along the axes of the frame that it turns.
    Single terms are left out.
    """
    ring = robot.ring
    joint = next((joint for joint in robot.joints if joint.variable == "theta"), None)
    if joint is None:
        return
    for body in robot.bodies:
        along = rotation(values[f"H{joint.index}"]).T @ values[f"v{body.name}"]
        for k, _ in joint.rates:
            place = ring.symbol_indices[ring.names[k], 1]
            slopes = (Expr(ring, x.poly.derivative(place)) for x in along.entries)
            yield from (slope for slope in slopes if len(slope) > 1)


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
