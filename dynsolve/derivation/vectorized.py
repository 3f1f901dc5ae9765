"""The vectorized form D(q) q̈ + C(q, q̇) q̇ + g(q) = τ, twice.

Read off from τ by collecting; and assembled directly.  Spong, Hutchinson,
Vidyasagar, section 7.3: d_ij from the Jacobians, c_ijk by Christoffel's formula,
g_k = ∂P/∂q_k.
"""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction

from dynsolve.algebra.expr import Expr
from dynsolve.algebra.matrix import Matrix
from dynsolve.robot.model import Robot

HALF = Fraction(1, 2)

Christoffel = Mapping[tuple[int, int, int], Expr]
"""c_ijk at (i, j, k), from 0; symmetric in i and j."""


def inertia_from_torque(robot: Robot, tau: Matrix) -> Matrix:
    """D, n×n: the factors of q̈ in τ."""
    ring = robot.ring
    return Matrix.of(ring, ([ring.coefficient(t, q, 2) for q in ring.names] for t in tau.entries))


def gravity_from_torque(robot: Robot, tau: Matrix) -> Matrix:
    """g, n×1: τ at q̇ = q̈ = 0."""
    ring = robot.ring
    return tau.map(lambda t: ring.without(ring.without(t, 2), 1))


def coriolis_from_torque(robot: Robot, tau: Matrix, g: Matrix, friction: Matrix | None = None) -> Matrix:
    """C q̇, n×1: τ without the terms of accelerations and gravity, and without friction (n×1)."""
    left = tau.map(lambda t: robot.ring.without(t, 2)) - g
    return left if friction is None else left - friction


def inertia_from_energy(robot: Robot, K: Expr) -> Matrix:
    """D, n×n: d_ij = ∂²K/∂q̇_i ∂q̇_j, since K = ½ q̇ᵀ D q̇."""
    ring = robot.ring
    momenta = [ring.diff_velocity(K, k) for k in range(robot.n)]
    return Matrix.of(ring, ([ring.diff_velocity(p, k) for k in range(robot.n)] for p in momenta))


def christoffel_symbols(robot: Robot, D: Matrix) -> dict[tuple[int, int, int], Expr]:
    """c_ijk = ½ (∂d_kj/∂q_i + ∂d_ki/∂q_j - ∂d_ij/∂q_k), at (i, j, k) with i ≤ j and from 0."""
    ring, n = D.ring, robot.n
    derivatives = {(i, j, k): ring.diff(D[i, j], k) for i in range(n) for j in range(i, n) for k in range(n)}

    def derivative(i: int, j: int, k: int) -> Expr:
        return derivatives[min(i, j), max(i, j), k]

    return {
        (i, j, k): (derivative(k, j, i) + derivative(k, i, j) - derivative(i, j, k)) * HALF
        for i in range(n)
        for j in range(i, n)
        for k in range(n)
    }


def coriolis_matrix(robot: Robot, symbols: Christoffel) -> Matrix:
    """C, n×n: c_kj = Σ_i c_ijk q̇_i."""
    ring, n = robot.ring, robot.n

    def entry(k: int, j: int) -> Expr:
        rates = [ring.symbol(name, 1) for name in ring.names]
        return ring.dot([symbols[min(i, j), max(i, j), k] for i in range(n)], rates)

    return Matrix.of(ring, ([entry(k, j) for j in range(n)] for k in range(n)))


def gravity_vector(robot: Robot, P: Expr) -> Matrix:
    """g, n×1: g_k = ∂P/∂q_k."""
    return Matrix.column(robot.ring, [robot.ring.diff(P, k) for k in range(robot.n)])


def torque(
    robot: Robot, D: Matrix, coriolis: Matrix, g: Matrix, friction: Matrix | None = None, *, k: int
) -> Expr:
    """τ_k = Σ_j d_kj q̈_j + (C q̇)_k + g_k, and the friction (n×1) of coordinate k; k counts from 0."""
    accelerations = [robot.ring.symbol(name, 2) for name in robot.ring.names]
    force = robot.ring.dot(list(D.rows[k]), accelerations) + coriolis[k, 0] + g[k, 0]
    return force if friction is None else force + friction[k, 0]
