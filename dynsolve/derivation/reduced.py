"""The equations of motion of a constrained mechanism without the multipliers.

The columns of Z span the rates that the constraints leave free, A_c Z = 0.  The forces of the
constraints do no work on these:

    Zᵀ (D q̈ + C q̇ + friction + g) = Zᵀ (τ + Q)

Murray, Li, Sastry, A Mathematical Introduction to Robotic Manipulation, section 6.1.3 (1994).
"""

from __future__ import annotations

from dataclasses import dataclass

from dynsolve.algebra.expr import Expr
from dynsolve.algebra.matrix import Matrix
from dynsolve.algebra.spans import nullspace
from dynsolve.derivation.forward_dynamics import driving_forces
from dynsolve.derivation.graph import Skipped
from dynsolve.robot.model import Robot

MOST_TERMS = 400
"""Equations with more terms together are not multiplied out."""


@dataclass(frozen=True, slots=True)
class Reduced:
    """Z, n×(n-c), and (left, right) of each equation."""

    free: Matrix
    equations: tuple[tuple[Expr, Expr], ...]


def reduced(robot: Robot, A: Matrix, forces: Matrix, *loads: Matrix) -> Reduced | Skipped:
    """The equations without multipliers; `forces` are their left sides, n×1, `loads` Q where there is any."""
    Z = nullspace(A)
    if not Z.shape[1]:
        return Skipped("the constraints leave nothing free to move")
    if sum(map(len, forces.entries)) * max(map(len, Z.entries)) > MOST_TERMS:
        return Skipped("multiplied out the equations are too long to be read")
    driving = driving_forces(robot)
    for Q in loads:
        driving = driving + Q
    return Reduced(Z, tuple(zip((Z.T @ forces).entries, (Z.T @ driving).entries, strict=True)))
