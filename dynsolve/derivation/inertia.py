"""Inertia tensors: the body-attached frame, the parallel-axis theorem, the base frame.

Spong, Hutchinson, Vidyasagar, section 7.2: I_base = R I Rᵀ, where I is about the
mass centre with axes fixed to the body and R turns the body's axes into the base's.
"""

from __future__ import annotations

from dynsolve.algebra.expr import Expr
from dynsolve.algebra.matrix import Matrix
from dynsolve.derivation.kinematics import rotation
from dynsolve.robot.model import AxesKind, Body, Robot


def body_rotation(robot: Robot, body: Body, H: Matrix) -> Matrix:
    """R_b, 3×3: the body-attached axes seen from the base; H is that of the body's link."""
    axes = body.axes
    match axes.kind:
        case AxesKind.LINK:
            return rotation(H) @ axes.rotation
        case AxesKind.REST:
            return rotation(H) @ rotation(H).map(robot.ring.at_rest).T @ robot.base_rotation @ axes.rotation
        case AxesKind.BASE:
            return robot.base_rotation @ axes.rotation


def axes_in_link(robot: Robot, body: Body, H: Matrix) -> Matrix:
    """Rᵀ R_b, 3×3, at q = 0: the body's axes seen from its link, which they turn with."""
    if body.axes.kind is AxesKind.LINK:
        return body.axes.rotation
    return (rotation(H).T @ body_rotation(robot, body, H)).map(robot.ring.at_rest)


def turns_with_link(robot: Robot, body: Body, H: Matrix) -> bool:
    """Whether a given R_b is fixed in the link, as the frame of a rigid body is."""
    if body.axes.kind is not AxesKind.BASE:
        return True
    relative = rotation(H).T @ body_rotation(robot, body, H)
    return not any(map(robot.ring.depends_on_coordinates, relative.entries))


def steiner(mass: Expr, offset: Matrix) -> Matrix:
    """m (|r|² 1 - r rᵀ), 3×3: what the parallel-axis theorem adds for an axis a distance r away."""
    ring = mass.ring
    square = ring.dot(offset.entries, offset.entries)
    return (Matrix.identity(ring, 3).scale(square) - offset @ offset.T).scale(mass)


def central_inertia(robot: Robot, body: Body, H: Matrix) -> Matrix:
    """I about the mass centre, 3×3, in the body-attached frame; H is that of the body's link.

    A tensor given about another point is moved by the parallel-axis theorem; a point mass has none.
    """
    ring = body.mass.ring
    if body.inertia is None:
        return Matrix.zero(ring, 3, 3)
    if body.about_point is None:
        return body.inertia
    offset = axes_in_link(robot, body, H).T @ (body.center - body.about_point)
    return body.inertia - steiner(body.mass, offset)


def base_inertia(R: Matrix, inertia: Matrix) -> Matrix:
    """I_base = R I Rᵀ, 3×3."""
    return R @ inertia @ R.T
