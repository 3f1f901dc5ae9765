"""Bodies that are given by their positions: Jacobians by differentiation, orientation by turns.

Where no table gives H_i, the position p(q) of a mass centre is given itself, and
v = ∂p/∂q q̇; a body's orientation is a product of turns, R = R_1 R_2 ..., each about an axis
that those before it carry along, so that ω is the sum of their rates along their axes.

Spong, Hutchinson, Vidyasagar, sections 2.5.3 (a turn about an axis) and 4.4
(angular velocities add up).
"""

from __future__ import annotations

from dynsolve.algebra.matrix import Matrix
from dynsolve.robot.model import Body, Robot


def position_jacobian(robot: Robot, position: Matrix) -> Matrix:
    """J_v = ∂p/∂q, 3×n, of a point that is given by its position p (3×1, world)."""
    ring = robot.ring
    return Matrix.of(ring, ([ring.diff(entry, k) for k in range(robot.n)] for entry in position.entries))


def orientation(robot: Robot, body: Body) -> Matrix:
    """R = R_1 R_2 ..., 3×3: the body's axes in the world, after all its turns."""
    rotation = Matrix.identity(robot.ring, 3)
    for turn in body.turns:
        rotation = rotation @ turn.rotation
    return rotation


def angular_jacobian(robot: Robot, body: Body) -> Matrix:
    """J_ω, 3×n, in the world: ω = Σ R_1 ... R_{t-1} a_t φ̇_t, with φ̇_t = rates_t q̇."""
    total = Matrix.zero(robot.ring, 3, robot.n)
    before = Matrix.identity(robot.ring, 3)
    for turn in body.turns:
        total = total + before @ turn.axis @ turn.rates
        before = before @ turn.rotation
    return total


def own_angular_jacobian(robot: Robot, body: Body) -> Matrix:
    """Rᵀ J_ω, 3×n: the same along the body's own axes, in which the first turn's angle does not occur."""
    total = Matrix.zero(robot.ring, 3, robot.n)
    for turn in body.turns:
        total = turn.rotation.T @ total + turn.axis @ turn.rates
    return total
