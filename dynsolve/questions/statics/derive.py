"""Forces from outside, and the torques that hold them at rest.

Spong, Hutchinson, Vidyasagar, section 4.10: the power of a force F and a moment M at a
point is Fᵀ v + Mᵀ ω = (J_vᵀ F + J_ωᵀ M)ᵀ q̇, whatever the motion, so that the generalized
forces are Q = J_vᵀ F + J_ωᵀ M: the transpose of what takes rates to velocities takes forces to
torques.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial

from dynsolve.algebra.matrix import AtState, Matrix
from dynsolve.derivation import kinematics
from dynsolve.derivation.graph import Rule
from dynsolve.robot.model import Robot
from dynsolve.robot.questions import FOR_EVERY_Q, TIP, Load


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


# Forces from outside and the torques that hold them, as rules


def rules(robot: Robot) -> Iterator[Rule]:
    """The rules of Q and of the torques that hold it."""
    at = AtState(robot.ring, robot.questions.state.by_symbol)
    parts = tuple(f"load{i}" for i, _ in enumerate(robot.questions.loads, 1))
    for name, load in zip(parts, robot.questions.loads, strict=True):
        yield _load(robot, name, load)
    yield Rule(FOR_EVERY_Q, parts, lambda *found: total(robot, found))
    yield Rule("Q", parts, lambda *found: at.matrix(total(robot, found)))
    if robot.bodies:
        yield Rule("tau_static", ("g", "Q"), lambda g, Q: holding_torques(at.matrix(g), Q))
    else:
        none = Matrix.zero(robot.ring, robot.n, 1)
        yield Rule("tau_static", ("Q",), partial(holding_torques, none))


def _load(robot: Robot, name: str, load: Load) -> Rule:
    """J_vᵀ F + J_ωᵀ M of one force: by the Jacobian of its point, where that is derived already."""
    if not load.point:
        return Rule(name, kinematics.frame_names(load.link), partial(_from_frames, robot, load))
    point = "" if load.point == TIP else load.point
    frame = (f"H{load.link}",) if load.axes is not None else ()

    def from_jacobians(linear: Matrix, angular: Matrix, *H: Matrix) -> Matrix:
        return generalized_forces(linear, angular, *wrench(load, H[0] if H else None))

    return Rule(name, (f"Jv{point}", f"Jw{point}", *frame), from_jacobians)


def _from_frames(robot: Robot, load: Load, *frames: Matrix) -> Matrix:
    linear, angular = jacobians(robot, load, frames)
    return generalized_forces(linear, angular, *wrench(load, frames[load.link]))


def jacobians(robot: Robot, load: Load, frames: tuple[Matrix, ...]) -> tuple[Matrix, Matrix]:
    """(J_v, J_ω) of the point that a force acts at, from H_0 up to the frame of its link."""
    position = kinematics.point(frames[load.link], load.position)
    linear = kinematics.linear_jacobian(robot, frames, position, load.link)
    return linear, kinematics.angular_jacobian(robot, frames, load.link)
