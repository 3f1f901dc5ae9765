"""Steady motions: some coordinates move at constant rates, the others are in balance.

With q̇ = q̇_s constant, and nothing in the others' equations that changes with the coordinates that
move, what is left of the equations of motion is C(q, q̇_s) q̇_s + g = 0 in the rows of the others.
These forces are the derivatives of the energy

    V = P - K(q, q̇_s),

whose minimum is stable, as that of P is at rest: with a motor that keeps the rates V, and what is
kinetic energy of the others, is conserved.  Terms of first order in the rates of the others do no
work (gyroscopic forces), and may hold what V alone would let fall.

Goldstein, Poole, Safko, Classical Mechanics, 3rd ed., sections 2.7 and 8.3; Lanczos, The Variational
Principles of Mechanics, 4th ed., section V.8.
"""

from __future__ import annotations

from itertools import combinations

from dynsolve.algebra.at_state import AtState
from dynsolve.algebra.expr import Expr
from dynsolve.algebra.matrix import Matrix
from dynsolve.derivation.energy import velocities
from dynsolve.derivation.equilibria import Equilibria, equilibria, wanted_rows
from dynsolve.derivation.graph import Skipped
from dynsolve.notation.tree import Node, Number
from dynsolve.robot.model import Robot


def steady_rates(robot: Robot) -> dict[tuple[str, int], Node]:
    """The rate of each coordinate by (name, 1); 0 of those that are in balance."""
    rates = dict(robot.questions.model.steady)
    return {(q.name, 1): rates.get(q.name, Number(0)) for q in robot.coordinates}


def steady_forces(robot: Robot, C: Matrix, gravity: Matrix) -> Matrix:
    """C q̇ + g in the motion, n×1, without friction."""
    return AtState(robot.ring, steady_rates(robot)).matrix(C @ velocities(robot) + gravity)


def steady_energy(robot: Robot, P: Expr, K: Expr) -> Expr:
    """V = P - K(q, q̇_s)"""
    return AtState(robot.ring, steady_rates(robot))(P - K)


def steady_equilibria(robot: Robot, D: Matrix, C: Matrix, gravity: Matrix) -> Equilibria | Skipped:
    """Where the others are in balance."""
    forces = steady_forces(robot, C, gravity)
    changing = (*D.entries, *(forces[row, 0] for row in wanted_rows(robot)))
    for name, _ in robot.questions.model.steady:
        k = robot.ring.names.index(name)
        if any(not robot.ring.diff(entry, k).is_zero for entry in changing):
            return Skipped(f"{name} is not cyclic: the equations of the others change as it moves")
    braked = _braked(robot)
    if braked:
        return Skipped(f"friction acts on {braked} in this motion, and no motor holds it")
    return equilibria(robot, forces, may_be_held(robot, D))


def may_be_held(robot: Robot, D: Matrix) -> bool:
    """Whether more than the energy holds: gyroscopic forces, or rates that no motor keeps."""
    rates = dict(robot.questions.model.steady)
    moving = [k for k, q in enumerate(robot.coordinates) if q.name in rates]
    if set(moving) & set(robot.actions.passive):
        return True
    momentum = AtState(robot.ring, steady_rates(robot)).matrix(D @ velocities(robot))
    others = [k for k in range(robot.n) if k not in moving]
    return any(not _curl(robot, momentum, *pair).is_zero for pair in combinations(others, 2))


def _curl(robot: Robot, momentum: Matrix, i: int, j: int) -> Expr:
    """∂p_i/∂q_j - ∂p_j/∂q_i, the factor of the gyroscopic force between two coordinates."""
    return robot.ring.diff(momentum[i, 0], j) - robot.ring.diff(momentum[j, 0], i)


def _braked(robot: Robot) -> str:
    """The name of a coordinate that friction acts on in the motion, and no motor holds; else nothing."""
    ring, wanted = robot.ring, wanted_rows(robot)
    rates = steady_rates(robot)
    for one in robot.actions.friction:
        name = robot.coordinates[one.coordinate].name
        is_turning = rates[name, 1] != Number(0)
        if one.coordinate in wanted and is_turning and not (one.viscous.is_zero and one.coulomb.is_zero):
            return name
    at = AtState(ring, rates)
    for damper in robot.actions.dampers:
        parts = [ring.diff(damper.of, k) for k in range(robot.n)]
        speed = sum((p * v for p, v in zip(parts, velocities(robot).entries, strict=True)), start=ring.zero)
        for k in wanted:
            if not at(damper.damping * speed * parts[k]).is_zero:
                return robot.coordinates[k].name
    return ""
