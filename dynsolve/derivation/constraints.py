"""Constraints: A_c q̇ = 0, its rate, and the multipliers that keep it.

With A_c q̇ = 0 the equations of motion are D q̈ + C q̇ + g = τ + Q + A_cᵀ λ, and A_c q̈ + Ȧ_c q̇ = 0
besides.  Put q̈ from the first into the second:

    λ = -(A_c D⁻¹ A_cᵀ)⁻¹ (A_c D⁻¹ (τ + Q - C q̇ - g) + Ȧ_c q̇)

Every inverse is an adjugate over a determinant, so that all is polynomial but for one division.

Murray, Li, Sastry, A Mathematical Introduction to Robotic Manipulation, section 6.1.2;
Siciliano, Sciavicco, Villani, Oriolo, Robotics, section 11.4 for constraints on the rates.
"""

from __future__ import annotations

from collections.abc import Mapping

from dynsolve.algebra.expr import Expr
from dynsolve.algebra.fraction_matrix import FractionMatrix, quotient
from dynsolve.algebra.matrix import Matrix
from dynsolve.algebra.minors import determinant, work
from dynsolve.algebra.pseudoinverse import adjugate
from dynsolve.algebra.ring_values import value_of
from dynsolve.derivation.energy import velocities
from dynsolve.derivation.forward_dynamics import SINGULAR
from dynsolve.derivation.graph import Skipped
from dynsolve.derivation.task import task_value
from dynsolve.robot.constraints import Constraint
from dynsolve.robot.model import Robot
from dynsolve.robot.questions import Task

MOST_PRODUCTS = 200_000
"""Multipliers that may come to more products of terms are not multiplied out: nobody could read them."""

DEPENDENT = "one constraint follows from the others, so that the multipliers are not determined"

TOO_LARGE = "multiplied out they are too large to be read"


def holonomic(robot: Robot) -> tuple[Constraint, ...]:
    """The constraints that are functions of the coordinates."""
    return tuple(one for one in robot.questions.constraints if not one.in_rates)


def constraint_functions(robot: Robot, positions: Mapping[str, Matrix]) -> Matrix:
    """h(q), a row a holonomic constraint; `positions` are those of the points in it, 3×1 each."""
    return task_value(robot, Task(tuple(one.entry for one in holonomic(robot))), positions)


def constraint_matrix(robot: Robot, h: Matrix) -> Matrix:
    """A_c, c×n: ∂h/∂q, and the factors of the rates where a constraint is given by these."""
    ring, functions = robot.ring, iter(h.entries)
    rows: list[list[Expr]] = []
    for one in robot.questions.constraints:
        if one.in_rates:
            value = value_of(ring, one.entry)
            rows.append([ring.coefficient(value, name, 1) for name in ring.names])
        else:
            function = next(functions)
            rows.append([ring.diff(function, k) for k in range(robot.n)])
    return Matrix.of(ring, rows)


def multipliers(
    robot: Robot, A: Matrix, A_dot: Matrix, D: Matrix, acting: Matrix
) -> Matrix | FractionMatrix | Skipped:
    """λ, c×1; `acting` is τ + Q - C q̇ - g, n×1: what is left of the forces beside D q̈."""
    if work(D) > MOST_PRODUCTS:
        return Skipped(TOO_LARGE)
    inverse, scale = adjugate(D), determinant(D)
    through = A @ inverse
    square = through @ A.T
    if work(square) > MOST_PRODUCTS:
        return Skipped(TOO_LARGE)
    if scale.is_zero:
        return Skipped(SINGULAR)
    if determinant(square).is_zero:
        return Skipped(DEPENDENT)
    wanted = through @ acting + (A_dot @ velocities(robot)).scale(scale)
    return quotient(-(adjugate(square) @ wanted), determinant(square))
