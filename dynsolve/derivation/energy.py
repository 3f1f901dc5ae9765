"""Velocities and energies of each body.

Spong, Hutchinson, Vidyasagar, section 7.2: v = J_v q̇, ω = J_ω q̇,
K = ½ m vᵀv + ½ ωᵀ I ω and P = -m gᵀ r_c.
"""

from __future__ import annotations

from fractions import Fraction

from dynsolve.algebra.expr import Expr
from dynsolve.algebra.matrix import Matrix
from dynsolve.algebra.ring import Ring
from dynsolve.robot.model import Robot

HALF = Fraction(1, 2)


def velocities(robot: Robot) -> Matrix:
    """q̇, n×1."""
    return Matrix.column(robot.ring, [robot.ring.symbol(q.name, 1) for q in robot.coordinates])


def accelerations(robot: Robot) -> Matrix:
    """q̈, n×1."""
    return Matrix.column(robot.ring, [robot.ring.symbol(q.name, 2) for q in robot.coordinates])


def velocity(robot: Robot, jacobian: Matrix) -> Matrix:
    """v = J_v q̇ or ω = J_ω q̇, 3×1."""
    return jacobian @ velocities(robot)


def potential_energy(robot: Robot, mass: Expr, center: Matrix) -> Expr:
    """P = -m gᵀ r_c: the height of the mass centre against gravity, from the base origin."""
    return -mass * robot.ring.dot(robot.gravity.entries, center.entries)


def linear_energy(mass: Expr, v: Matrix) -> Expr:
    """K_v = ½ m vᵀ v"""
    return mass * mass.ring.dot(v.entries, v.entries) * HALF


def rotational_energy(w: Matrix, inertia: Matrix) -> Expr:
    """K_ω = ½ ωᵀ I ω, ω and I in one frame."""
    return w.ring.dot(w.entries, (inertia @ w).entries) * HALF


def kinetic_energy(linear: Expr, rotational: Expr) -> Expr:
    """K_i = K_v + K_ω of one body."""
    return linear + rotational


def total(ring: Ring, parts: tuple[Expr, ...]) -> Expr:
    """The sum over the bodies."""
    return sum(parts, start=ring.zero)
