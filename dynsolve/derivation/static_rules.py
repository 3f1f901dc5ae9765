"""Forces from outside and the torques that hold them, as rules; the formulas are in `statics`."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial

from dynsolve.algebra.at_state import AtState
from dynsolve.algebra.matrix import Matrix
from dynsolve.derivation import jacobian, kinematics, statics
from dynsolve.derivation.graph import Rule
from dynsolve.quantities.robot_stages import asked_stages
from dynsolve.quantities.stages import Stage
from dynsolve.robot.model import Robot
from dynsolve.robot.questions import TIP, Load


def static_rules(robot: Robot) -> Iterator[Rule]:
    """The rules of forces; none of a robot of which nothing of them is asked."""
    if Stage.STATICS not in asked_stages(robot.questions):
        return
    at = AtState(robot.ring, robot.questions.state.by_symbol)
    parts = tuple(f"load{i}" for i, _ in enumerate(robot.questions.loads, 1))
    for name, load in zip(parts, robot.questions.loads, strict=True):
        yield _load(robot, name, load)
    yield Rule("Q", parts, lambda *found: at.matrix(statics.total(robot, found)))
    if robot.bodies:
        yield Rule("tau_static", ("g", "Q"), lambda g, Q: statics.holding_torques(at.matrix(g), Q))
    else:
        none = Matrix.zero(robot.ring, robot.n, 1)
        yield Rule("tau_static", ("Q",), partial(statics.holding_torques, none))


def _load(robot: Robot, name: str, load: Load) -> Rule:
    """J_vᵀ F + J_ωᵀ M of one force: by the Jacobian of its point, where that is derived already."""
    if not load.point:
        return Rule(name, kinematics.frame_names(load.link), partial(_from_frames, robot, load))
    point = "" if load.point == TIP else load.point
    frame = (f"H{load.link}",) if load.axes is not None else ()

    def from_jacobians(linear: Matrix, angular: Matrix, *H: Matrix) -> Matrix:
        return statics.generalized_forces(linear, angular, *statics.wrench(load, H[0] if H else None))

    return Rule(name, (f"Jv{point}", f"Jw{point}", *frame), from_jacobians)


def _from_frames(robot: Robot, load: Load, *frames: Matrix) -> Matrix:
    linear, angular = jacobians(robot, load, frames)
    return statics.generalized_forces(linear, angular, *statics.wrench(load, frames[load.link]))


def jacobians(robot: Robot, load: Load, frames: tuple[Matrix, ...]) -> tuple[Matrix, Matrix]:
    """(J_v, J_ω) of the point that a force acts at, from H_0 up to the frame of its link."""
    position = kinematics.point(frames[load.link], load.position)
    linear = jacobian.linear_jacobian(robot, frames, position, load.link)
    return linear, jacobian.angular_jacobian(robot, frames, load.link)
