"""Forces from outside, and the torques that hold them at rest.

Spong, Hutchinson, Vidyasagar, section 4.10: the power of a force F and a moment M at a
point is Fᵀ v + Mᵀ ω = (J_vᵀ F + J_ωᵀ M)ᵀ q̇, whatever the motion, so that the generalized
forces are Q = J_vᵀ F + J_ωᵀ M: the transpose of what takes rates to velocities takes forces to
torques.
"""

from __future__ import annotations

from dynsolve.algebra.matrix import Matrix
from dynsolve.derivation import kinematics
from dynsolve.robot.model import Robot
from dynsolve.robot.questions import Load


def wrench(load: Load, H: Matrix | None) -> tuple[Matrix, Matrix]:
    """The force and the moment on the link in the world, 3×1 each; `H` is the frame of the link.

    F = R_i R F' of one that is given along axes R of the link; what the robot exerts acts on
    it with the opposite sign.
    """
    force, moment = load.force, load.moment
    if load.axes is not None:
        assert H is not None
        turned = kinematics.rotation(H) @ load.axes
        force, moment = turned @ force, turned @ moment
    return (-force, -moment) if load.by_robot else (force, moment)


def generalized_forces(linear: Matrix, angular: Matrix, force: Matrix, moment: Matrix) -> Matrix:
    """Q = J_vᵀ F + J_ωᵀ M, n×1."""
    return linear.T @ force + angular.T @ moment


def total(robot: Robot, parts: tuple[Matrix, ...]) -> Matrix:
    """Q = Σ Q_i, n×1."""
    return sum(parts, start=Matrix.zero(robot.ring, robot.n, 1))


def holding_torques(g: Matrix, Q: Matrix) -> Matrix:
    """τ = g - Q, n×1: the equations of motion, D q̈ + C q̇ + g = τ + Q, at rest."""
    return g - Q
