"""The same energies from Jacobians expressed in each link's own frame.

In the base frame a column grows with every joint before it, and shrinks again in
vᵀv; in the link's own frame it never grows.  Both give the same K exactly (a test
holds that); this way is the fast one.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction

from dynsolve.algebra.matrix import Matrix, cross, hstack
from dynsolve.derivation.kinematics import dh_matrix, origin, rotation
from dynsolve.robot.model import Convention, Joint, Robot


@dataclass(frozen=True, slots=True)
class LinkJacobian:
    """J_v of the frame's origin and J_ω, 3×n each, along the frame's own axes."""

    linear: Matrix
    angular: Matrix

    def at(self, local: Matrix) -> Matrix:
        """J_v, 3×n, of a point fixed in the frame: J_v + J_ω × r."""
        ring = local.ring
        n = self.linear.shape[1]
        columns = [self.linear.column_at(k) + cross(self.angular.column_at(k), local) for k in range(n)]
        return hstack(ring, columns, 3)


def link_jacobians(robot: Robot) -> Iterator[LinkJacobian]:
    """The Jacobians of frames 1, 2, ..., each from the one before."""
    jacobian = LinkJacobian(Matrix.zero(robot.ring, 3, robot.n), Matrix.zero(robot.ring, 3, robot.n))
    for joint in robot.joints:
        jacobian = _next(robot, joint, jacobian)
        yield jacobian


def _next(robot: Robot, joint: Joint, before: LinkJacobian) -> LinkJacobian:
    """ω and v pass from frame to frame as in the recursion of velocities (Craig, section 5.6)."""
    A = dh_matrix(robot, joint)
    back, position = rotation(A).T, origin(A)
    spin, slide = _rates(robot, joint)
    if robot.convention is Convention.STANDARD:
        z = back.column_at(2)
        angular = back @ before.angular + z @ spin
        carried = LinkJacobian(back @ before.linear + z @ slide, angular)
        return LinkJacobian(carried.at(back @ position), angular)
    z = Matrix.identity(robot.ring, 3).column_at(2)
    carried_linear = before.at(position)
    return LinkJacobian(back @ carried_linear + z @ slide, back @ before.angular + z @ spin)


def _rates(robot: Robot, joint: Joint) -> tuple[Matrix, Matrix]:
    """The joint's turning and sliding rates as rows, 1×n, in the coordinates."""
    rates: list[Fraction] = [Fraction(0)] * robot.n
    for k, rate in joint.rates:
        rates[k] = rate
    row = Matrix.of(robot.ring, [map(robot.ring.constant, rates)])
    none = Matrix.zero(robot.ring, 1, robot.n)
    return (row, none) if joint.variable == "theta" else (none, row)


def linear_inertia(mass_jacobian: Matrix) -> Matrix:
    """J_vᵀ J_v, n×n; times the mass it is the body's linear part of D."""
    return mass_jacobian.T @ mass_jacobian


def rotational_inertia(angular: Matrix, inertia: Matrix) -> Matrix:
    """J_ωᵀ I J_ω, n×n, with I along the frame's axes."""
    return angular.T @ (inertia @ angular)
