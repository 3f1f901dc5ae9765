"""The equations of motion near an equilibrium, linear: ẋ = A x + B u.

With x = (q - q_e, q̇) and the inputs u counted from the forces g(q_e) that hold the equilibrium,

    A = [ 0, 1; -D⁻¹ ∂g/∂q, -D⁻¹ F ],   B = [ 0; D⁻¹ S ]   at q = q_e, q̇ = 0:

C q̇ is of second order, F holds the viscous friction, and S a column for each coordinate that a
motor drives.  D⁻¹ is the adjugate over the determinant.

Slotine, Li, Applied Nonlinear Control, section 3.3 (1991).
"""

from __future__ import annotations

from dynsolve.algebra.at_state import AtState
from dynsolve.algebra.fraction_matrix import FractionMatrix, fraction_of, quotient, tidy
from dynsolve.algebra.matrix import Matrix
from dynsolve.algebra.minors import determinant, work
from dynsolve.algebra.pseudoinverse import adjugate
from dynsolve.derivation.graph import Skipped
from dynsolve.robot.model import Robot

MOST_PRODUCTS = 200_000
"""An inertia matrix whose determinant may come to more products of terms is not inverted."""

TOO_LARGE = "the inverse of the inertia matrix is too large to be read"
SINGULAR = "the inertia matrix has no inverse"

Linear = Matrix | FractionMatrix | Skipped


def at_equilibrium(robot: Robot) -> AtState:
    """Puts the equilibrium into expressions; rates are 0 there."""
    return AtState(robot.ring, robot.questions.model.equilibrium)


def driven(robot: Robot) -> list[int]:
    """The coordinates that a motor drives, from 0: the inputs."""
    return [k for k in range(robot.n) if k not in robot.actions.passive]


def unbalanced(robot: Robot, gravity: Matrix) -> str:
    """The name of a passive coordinate that gravity and springs move there; empty where none does."""
    at = at_equilibrium(robot)
    for k in robot.actions.passive:
        if not at(gravity[k, 0]).is_zero:
            return robot.coordinates[k].name
    return ""


def curvature(robot: Robot, gravity: Matrix) -> Matrix:
    """∂g/∂q, n×n: the second derivatives of the potential energy."""
    ring = robot.ring
    return Matrix.of(ring, ([ring.diff(g, k) for k in range(robot.n)] for g in gravity.entries))


def stiffness(robot: Robot, gravity: Matrix) -> Matrix:
    """∂g/∂q at the equilibrium, n×n."""
    return at_equilibrium(robot).matrix(curvature(robot, gravity))


def damping(robot: Robot, friction: Matrix | None) -> Matrix:
    """F = ∂(friction)/∂q̇ at the equilibrium, n×n: of the viscous friction, for sgn jumps there."""
    ring, at = robot.ring, at_equilibrium(robot)
    if friction is None:
        return Matrix.zero(ring, robot.n, robot.n)
    return Matrix.of(ring, ([at(ring.diff_velocity(f, k)) for k in range(robot.n)] for f in friction.entries))


def state_matrix(robot: Robot, D: Matrix, gravity: Matrix, friction: Matrix | None = None) -> Linear:
    """A, 2n×2n."""
    name = unbalanced(robot, gravity)
    if name:
        return Skipped(f"this is no equilibrium: no motor holds {name}")
    below = Matrix(
        robot.ring,
        tuple(
            (*k, *f)
            for k, f in zip((-stiffness(robot, gravity)).rows, (-damping(robot, friction)).rows, strict=True)
        ),
    )
    zero, one = Matrix.zero(robot.ring, robot.n, robot.n), Matrix.identity(robot.ring, robot.n)
    return _below(
        robot, D, Matrix(robot.ring, tuple((*z, *e) for z, e in zip(zero.rows, one.rows, strict=True))), below
    )


def input_matrix(robot: Robot, D: Matrix) -> Linear:
    """B, 2n×m, a column for each coordinate that a motor drives."""
    inputs = driven(robot)
    selected = Matrix.of(
        robot.ring,
        ([robot.ring.one if i == k else robot.ring.zero for k in inputs] for i in range(robot.n)),
    )
    if not inputs:
        return Skipped("no coordinate has a motor")
    return _below(robot, D, Matrix.zero(robot.ring, robot.n, len(inputs)), selected)


def _below(robot: Robot, D: Matrix, upper: Matrix, right: Matrix) -> Linear:
    """[upper; D⁻¹ right] with D at the equilibrium."""
    inertia = at_equilibrium(robot).matrix(D)
    if work(inertia) > MOST_PRODUCTS:
        return Skipped(TOO_LARGE)
    divisor = determinant(inertia)
    if divisor.is_zero:
        return Skipped(SINGULAR)
    lower = quotient(adjugate(inertia) @ right, divisor)
    return tidy(robot.ring, [map(fraction_of, row) for row in (*upper.rows, *lower.rows)])
