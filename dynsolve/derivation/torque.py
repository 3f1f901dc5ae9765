"""The generalized forces: a torque τ_k for a revolute coordinate, a force f_k for a prismatic one.

Spong, Hutchinson, Vidyasagar, section 7.1, the Euler-Lagrange equations.
"""

from __future__ import annotations

from dynsolve.algebra.expr import Expr
from dynsolve.algebra.matrix import Matrix
from dynsolve.robot.model import Robot


def generalized_force(ddt: Expr, slope: Expr) -> Expr:
    """τ_k = d/dt ∂L/∂q̇_k - ∂L/∂q_k"""
    return ddt - slope


def force_vector(robot: Robot, forces: tuple[Expr, ...]) -> Matrix:
    """τ, n×1."""
    return Matrix.column(robot.ring, forces)
