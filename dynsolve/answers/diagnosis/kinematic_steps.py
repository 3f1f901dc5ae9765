"""Slips in the steps of what exercises ask of the kinematics: Jacobians, rates, forces at rest.

Each function gives, as those of `steps` do, what comes out when a step goes wrong in a way that people do.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

from dynsolve.algebra.matrix import AtState, Matrix
from dynsolve.answers.diagnosis.slips import slip
from dynsolve.answers.verdict import Diagnosis
from dynsolve.derivation import kinematics
from dynsolve.quantities import families
from dynsolve.quantities.family import Family
from dynsolve.questions import rates, statics
from dynsolve.questions import task as of_task
from dynsolve.questions.statics.derive import jacobians, total, wrench
from dynsolve.robot.model import Robot
from dynsolve.robot.questions import Load, NamedPoint

Variant = tuple[Any, Diagnosis]
InputValue = Callable[[str], Any]


def _in_last_frame(name: str) -> Callable[[Robot, InputValue], Iterator[Variant]]:
    """R_nᵀ J: the Jacobian along the axes of the last frame."""

    def variants(robot: Robot, value: InputValue) -> Iterator[Variant]:
        last = len(robot.joints)
        R = kinematics.rotation(value(f"H{last}"))
        if Matrix.identity(robot.ring, 3) != R:
            yield R.T @ value(name), slip("tool_frame", part=f"frame {last}", asked="the base")

    return variants


def _along_other_axes(name: str) -> Callable[[Robot, NamedPoint, InputValue], Iterator[Variant]]:
    """What is asked for along the axes of one frame, along those of the world and of every other."""

    def variants(robot: Robot, point: NamedPoint, value: InputValue) -> Iterator[Variant]:
        right = value(name + point.name)
        world = _rotation(robot, point.axes, value) @ right
        for frame in (None, *range(1, len(robot.joints) + 1)):
            own = _rotation(robot, frame, value).T @ world
            if own != right:
                yield own, slip("tool_frame", part=_ground(frame), asked=_ground(point.axes))

    return variants


def _rotation(robot: Robot, frame: int | None, value: InputValue) -> Matrix:
    if frame is None:
        return Matrix.identity(robot.ring, 3)
    return kinematics.rotation(value(f"H{frame}"))


def _ground(frame: int | None) -> str:
    return "the world" if frame is None else f"frame {frame}"


def _joint_rates(robot: Robot, value: InputValue) -> Iterator[Variant]:
    """J_rᵀ ṙ in place of J_r⁻¹ ṙ."""
    questions = robot.questions
    if questions.velocity is not None:
        at = AtState(robot.ring, questions.state.by_symbol)
        yield at.matrix(value("Jr")).T @ at.matrix(questions.velocity), slip("transpose_for_inverse")


def _forces(robot: Robot, value: InputValue) -> Iterator[Variant]:
    at, loads = _at(robot), robot.questions.loads
    if any(not load.moment.is_zero for load in loads) and any(not load.force.is_zero for load in loads):
        yield at.matrix(_without_moments(robot, value)), slip("moments_left_out")


def _holding(robot: Robot, value: InputValue) -> Iterator[Variant]:
    g, Q, at = _weight(robot, value), value("Q"), _at(robot)
    yield g + Q, slip("load_sign")
    if any(not load.moment.is_zero for load in robot.questions.loads):
        yield g - at.matrix(_without_moments(robot, value)), slip("moments_left_out")
    if not g.is_zero:
        yield -Q, slip("weight_left_out")


def _weight(robot: Robot, value: InputValue) -> Matrix:
    none = Matrix.zero(robot.ring, robot.n, 1)
    return _at(robot).matrix(value("g")) if robot.bodies else none


def _without_moments(robot: Robot, value: InputValue) -> Matrix:
    """Σ J_vᵀ F."""
    return total(robot, tuple(_of_force(robot, load, value) for load in robot.questions.loads))


def _of_force(robot: Robot, load: Load, value: InputValue) -> Matrix:
    frames = tuple(value(name) for name in kinematics.frame_names(load.link))
    linear, _ = jacobians(robot, load, frames)
    force, _ = wrench(load, frames[load.link])
    return linear.T @ force


def _at(robot: Robot) -> AtState:
    return AtState(robot.ring, robot.questions.state.by_symbol)


OF_ROBOT: dict[Family, Callable[[Robot, InputValue], Iterator[Variant]]] = {
    families.JV: _in_last_frame("Jv"),
    rates.QD: _joint_rates,
    statics.Q: _forces,
    statics.TAU_STATIC: _holding,
}

OF_POINT: dict[Family, Callable[[Robot, NamedPoint, InputValue], Iterator[Variant]]] = {
    of_task.JV_POINT: _along_other_axes("Jv"),
    of_task.JW_POINT: _along_other_axes("Jw"),
    of_task.V_POINT: _along_other_axes("v"),
}
