"""The Lagrangian and the Euler-Lagrange equations: d/dt ∂L/∂q̇_k - ∂L/∂q_k = τ_k.

Spong, Hutchinson, Vidyasagar, section 7.1.
"""

from __future__ import annotations

from dynsolve.algebra.expr import Expr
from dynsolve.algebra.matrix import Matrix
from dynsolve.robot.model import Robot


def lagrangian(K: Expr, P: Expr) -> Expr:
    """L = K - P"""
    return K - P


def momentum(L: Expr, k: int) -> Expr:
    """∂L/∂q̇_k, k from 0."""
    return L.ring.diff_velocity(L, k)


def momentum_rate(momentum: Expr) -> Expr:
    """d/dt ∂L/∂q̇_k, the total derivative by the chain rule: Σ_j (∂/∂q_j q̇_j + ∂/∂q̇_j q̈_j)."""
    return momentum.ring.time_derivative(momentum)


def coordinate_derivative(L: Expr, k: int) -> Expr:
    """∂L/∂q_k, k from 0."""
    return L.ring.diff(L, k)


def generalized_force(
    momentum_rate: Expr, coordinate_derivative: Expr, friction: Matrix | None = None, *, k: int
) -> Expr:
    """τ_k = d/dt ∂L/∂q̇_k - ∂L/∂q_k: a torque for a revolute coordinate, a force for a prismatic one.

    Friction (n×1), which no potential gives, is one more term: the drive has to overcome it.  k counts
    from 0.
    """
    force = momentum_rate - coordinate_derivative
    return force if friction is None else force + friction[k, 0]


def force_vector(robot: Robot, forces: tuple[Expr, ...]) -> Matrix:
    """τ, n×1."""
    return Matrix.column(robot.ring, forces)
