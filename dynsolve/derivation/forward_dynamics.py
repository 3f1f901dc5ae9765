"""Forward dynamics: the accelerations that given forces make.

    q̈ = D⁻¹ (τ + Q - C q̇ - friction - g)

D⁻¹ is the adjugate over the determinant, so that all is polynomial but for one division.

Lynch, Park, Modern Robotics, section 8.5 (2017).
"""

from __future__ import annotations

from dynsolve.algebra.fraction_matrix import FractionMatrix, quotient
from dynsolve.algebra.matrix import Matrix
from dynsolve.algebra.minors import determinant, work
from dynsolve.algebra.pseudoinverse import adjugate
from dynsolve.derivation.graph import Skipped
from dynsolve.robot.model import Robot

MOST_PRODUCTS = 50_000
"""Accelerations that may come to more products of terms are not multiplied out: nobody could read them."""

TOO_LARGE = "multiplied out they are too large to be read"

SINGULAR = "the inertia matrix has no inverse: a coordinate moves nothing that has mass"

CONSTRAINED = "the forces of the constraints act, too: the accelerations follow with the multipliers lambda"


def driving_forces(robot: Robot) -> Matrix:
    """τ, n×1, by the names of the generalized forces; 0 where no motor drives a coordinate."""
    ring, passive = robot.ring, robot.actions.passive
    entries = [ring.zero if k in passive else ring.symbol(q.force) for k, q in enumerate(robot.coordinates)]
    return Matrix.column(ring, entries)


def acting_names(robot: Robot) -> tuple[str, ...]:
    """The rules of the forces that act beside τ."""
    friction = ("friction",) if "friction" in robot.actions.kinds else ()
    return ("Cqd", "g", *friction, *(("Q",) if robot.questions.loads else ()))


def acting_forces(robot: Robot, *forces: Matrix) -> Matrix:
    """τ + Q - C q̇ - friction - g, n×1, from the forces of `acting_names`."""
    total = driving_forces(robot)
    for name, force in zip(acting_names(robot), forces, strict=True):
        total = total + force if name == "Q" else total - force
    return total


def accelerations(robot: Robot, D: Matrix, *forces: Matrix) -> Matrix | FractionMatrix | Skipped:
    """q̈, n×1, from D and the forces of `acting_names`."""
    if robot.questions.constraints:
        return Skipped(CONSTRAINED)
    acting = acting_forces(robot, *forces)
    if work(D) * max(1, max(map(len, acting.entries))) > MOST_PRODUCTS:
        return Skipped(TOO_LARGE)
    scale = determinant(D)
    return Skipped(SINGULAR) if scale.is_zero else quotient(adjugate(D) @ acting, scale)
