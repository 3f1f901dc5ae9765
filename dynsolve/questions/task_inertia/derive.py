"""The inertia that a force at the task meets: Λ = (J_r D⁻¹ J_rᵀ)⁻¹ (Khatib 1987).

Nothing is inverted on the way.  By the formulas of Cauchy and Binet, and of Jacobi for the minors
of an adjugate, the minors of J_r adj D J_rᵀ are powers of det D times

    S(A, B) = Σ_{I, J} ± det J_r[A, I] · det D[J', I'] · det J_r[B, J],

over all I and J of as many columns as there are rows in A and B; J' and I' are the others.  With
these Λ_ij = ± S(without j, without i) / S(all, all).

Lynch, Park, Modern Robotics, section 8.6 (2017); Horn, Johnson, Matrix Analysis, section 0.8.
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import combinations

from dynsolve.algebra.linear_systems import FractionMatrix, part, quotient
from dynsolve.algebra.matrix import Matrix, determinant, work
from dynsolve.algebra.ring import Expr
from dynsolve.derivation.graph import Rule, Skipped
from dynsolve.questions.equilibria.linearization import MOST_PRODUCTS
from dynsolve.questions.forward_dynamics.derive import SINGULAR as SINGULAR_INERTIA
from dynsolve.questions.forward_dynamics.derive import TOO_LARGE, if_readable
from dynsolve.robot.model import Robot

_Indices = tuple[int, ...]


RANK = "the Jacobian of the task has dependent rows"


def rules(robot: Robot) -> Iterator[Rule]:
    """Λ, of a robot with masses and a table."""
    if robot.has_dynamics and robot.has_table:
        is_constrained = bool(robot.questions.constraints)
        yield Rule("Lambda", ("Jr", "D"), _constrained if is_constrained else task_inertia)


def _constrained(jacobian: Matrix, D: Matrix) -> Skipped:
    return Skipped("a force at the task meets the constraints, too")


def task_inertia(jacobian: Matrix, D: Matrix) -> Matrix | FractionMatrix | Skipped:
    """Λ, m×m, for a Jacobian J_r (m×n) of full row rank."""
    m, n = jacobian.shape
    if m > n:
        return Skipped(RANK)
    if work(D) > MOST_PRODUCTS or work(jacobian @ jacobian.T) > MOST_PRODUCTS:
        return Skipped(TOO_LARGE)
    if determinant(D).is_zero:
        return Skipped(SINGULAR_INERTIA)
    every = tuple(range(m))
    size = _sum(jacobian, D, every, every)
    if size.is_zero:
        return Skipped(RANK)

    def entry(i: int, j: int) -> Expr:
        value = _sum(jacobian, D, tuple(k for k in every if k != j), tuple(k for k in every if k != i))
        return value if (i + j) % 2 == 0 else -value

    return if_readable(quotient(Matrix.of(D.ring, ([entry(i, j) for j in every] for i in every)), size))


def _sum(jacobian: Matrix, D: Matrix, A: _Indices, B: _Indices) -> Expr:
    """S(A, B)"""
    columns = tuple(range(len(D.rows)))
    total = D.ring.zero
    for across in combinations(columns, len(A)):
        left = determinant(part(jacobian, A, across))
        for other in () if left.is_zero else combinations(columns, len(B)):
            right = determinant(part(jacobian, B, other))
            if not right.is_zero:
                term = (
                    left * determinant(part(D, _without(columns, other), _without(columns, across))) * right
                )
                total += term if (sum(across) + sum(other)) % 2 == 0 else -term
    return total


def _without(every: _Indices, some: _Indices) -> _Indices:
    return tuple(k for k in every if k not in some)
