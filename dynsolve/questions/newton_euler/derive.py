"""The Newton-Euler recursions as rules; the formulas are in `recursions`.

`wl2`, `wdl2` and `al2` are ω, ω̇ and the acceleration of the origin of frame 2, `acl2` the acceleration of
the mass centre of body 2, `fl2` and `nl2` the force and the moment that link 1 holds link 2 with, all along
the axes of the link's frame.  Where the exercise is to be solved by the recursions, the forces τ_k
are the components of these; else they come from the Lagrangian.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import partial
from typing import Any

from dynsolve.algebra.matrix import Matrix
from dynsolve.algebra.ring import Expr
from dynsolve.derivation import actions
from dynsolve.derivation.graph import Rule
from dynsolve.questions.newton_euler import recursions
from dynsolve.questions.newton_euler.recursions import Carried, Motion, Step
from dynsolve.robot.model import Body, Coordinate, Joint, JointType, Robot
from dynsolve.robot.questions import FOR_EVERY_Q, Method


def rules(robot: Robot) -> Iterator[Rule]:
    """The rules of the recursions, and by their method those of the forces."""
    for joint in robot.joints:
        yield from _outwards(robot, joint)
    for body in robot.bodies:
        yield _center(robot, body)
    for joint in robot.joints:
        yield _force(robot, joint)
        yield _moment(robot, joint)
    if robot.questions.method is Method.NEWTON_EULER:
        for q in robot.coordinates:
            yield torque_rule(robot, q)


# -- outwards --------------------------------------------------------------------------------------


def _outwards(robot: Robot, joint: Joint) -> Iterator[Rule]:
    """ω, ω̇ and a of one frame, from those of the frame before; frame 0 is at rest."""
    i, before = joint.index, joint.parent
    base = recursions.base_motion(robot)

    def angular_velocity(A: Matrix, w: Matrix = base.w) -> Matrix:
        return recursions.angular_velocity(robot, joint, A, w)

    def angular_acceleration(A: Matrix, spin: Matrix, dw: Matrix = base.dw) -> Matrix:
        return recursions.angular_acceleration(robot, joint, A, dw, spin)

    yield Rule(f"wl{i}", (f"A{i}", *_of_frame(before, "wl")), angular_velocity)
    yield Rule(f"wdl{i}", (f"A{i}", f"wl{i}", *_of_frame(before, "wdl")), angular_acceleration)
    yield Rule(f"al{i}", _motion(joint), partial(_acceleration, robot, joint, None))


def _acceleration(
    robot: Robot, joint: Joint, beyond: Matrix | None, A: Matrix, w: Matrix, dw: Matrix, *before: Matrix
) -> Matrix:
    step = Step(joint, A, Motion(*before) if before else recursions.base_motion(robot))
    return recursions.total(recursions.acceleration_parts(robot, step, w, dw, beyond), robot)


def _motion(joint: Joint) -> tuple[str, ...]:
    """What the accelerations of a joint's link are made of."""
    i = joint.index
    return (f"A{i}", f"wl{i}", f"wdl{i}", *_of_frame(joint.parent, "wl", "wdl", "al"))


def _of_frame(i: int, *stems: str) -> tuple[str, ...]:
    """Quantities of a frame by their names; none of frame 0."""
    return tuple(f"{stem}{i}" for stem in stems) if i else ()


def _center(robot: Robot, body: Body) -> Rule:
    """a_c: by the way from the origin before in the standard convention, else from the frame's own origin."""
    i, name = body.link, f"acl{body.name}"
    if recursions.is_standard(robot):
        joint = robot.joints[i - 1]
        return Rule(name, _motion(joint), partial(_acceleration, robot, joint, body.center))

    def from_own_origin(a: Matrix, w: Matrix, dw: Matrix) -> Matrix:
        return recursions.total((a, *recursions.turning_parts(w, dw, body.center)), robot)

    return Rule(name, (f"al{i}", f"wl{i}", f"wdl{i}"), from_own_origin)


# -- inwards ---------------------------------------------------------------------------------------


def _force(robot: Robot, joint: Joint) -> Rule:
    i = joint.index
    after, bodies = robot.links_after(i), robot.bodies_on(i)

    def compute(H: Matrix, *values: Matrix) -> Matrix:
        accelerations, rest = values[: len(bodies)], values[len(bodies) :]
        own = [
            recursions.inertial_force(robot, body, H, a)
            for body, a in zip(bodies, accelerations, strict=True)
        ]
        own += [-F for _, _, F, _ in recursions.from_outside(robot, i, H)]
        return recursions.force(robot, [(A, f) for A, f in _in_groups(rest, 2)], own)

    links = (name for j in after for name in (f"A{j}", f"fl{j}"))
    return Rule(f"fl{i}", (f"H{i}", *(f"acl{body.name}" for body in bodies), *links), compute)


def _moment(robot: Robot, joint: Joint) -> Rule:
    i = joint.index
    after, bodies = robot.links_after(i), robot.bodies_on(i)
    rotors = [motor for motor in robot.actions.rotors if motor.carrier == i]
    none = Matrix.zero(robot.ring, 3, 1)

    def compute(A: Matrix, H: Matrix, w: Matrix, dw: Matrix, *values: Matrix) -> Matrix:
        mine, rest = values[: 2 * len(bodies)], values[2 * len(bodies) :]
        own = []
        for body, (acceleration, tensor) in zip(bodies, _in_groups(mine, 2), strict=True):
            along_link = recursions.tensor_in_link(robot, body, H, tensor)
            couple = recursions.inertial_moment(along_link, w, dw)
            own.append((body.center, recursions.inertial_force(robot, body, H, acceleration), couple))
        own += [(none, none, actions.rotor_moment(robot, motor, w, dw)) for motor in rotors]
        own += [(p, -F, -M) for _, p, F, M in recursions.from_outside(robot, i, H)]
        carried = [Carried(*values) for values in _in_groups(rest, 3)]
        return recursions.moment(robot, recursions.start_of_moments(robot, A), carried, own)

    of_bodies = (name for body in bodies for name in (f"acl{body.name}", f"I_body{body.name}"))
    links = (name for j in after for name in (f"A{j}", f"fl{j}", f"nl{j}"))
    return Rule(f"nl{i}", (f"A{i}", f"H{i}", f"wl{i}", f"wdl{i}", *of_bodies, *links), compute)


def torque_rule(robot: Robot, q: Coordinate) -> Rule:
    """τ_k, by the joints that coordinate k moves: nᵀ z of one that turns, fᵀ z of one that slides.

    The motors that turn q_k also drive their rotors, through their gears, friction and springs add what they
    resist with, and what acts from outside its Q_k: f and n are less by it.
    """
    moved, k = robot.joints_of(q), q.index - 1
    motors = [motor for motor in robot.actions.rotors if motor.turns == k]
    beside: list[str] = [name for name in ("Ps", "friction") if name in robot.actions.terms]
    beside += [FOR_EVERY_Q] if robot.questions.loads else []

    def compute(*values: Any) -> Expr:
        held, rest = values[: 2 * len(moved)], list(values[2 * len(moved) :])
        found = robot.ring.zero
        for (_, rate), (A, wrench) in zip(moved, _in_groups(held, 2), strict=True):
            found = found + recursions.component(robot, A, wrench) * rate
        for motor in motors:
            dw = rest.pop(0) if motor.carrier else None
            found = found + motor.ratio * actions.rotor_drive(robot, motor, dw)
        for name, value in zip(beside, rest, strict=True):
            found = found + (robot.ring.diff(value, k) if name == "Ps" else value[k, 0])
        return found

    joints = (name for joint, _ in moved for name in (f"A{joint.index}", holding(joint)))
    carriers = (f"wdl{motor.carrier}" for motor in motors if motor.carrier)
    return Rule(f"tau{q.index}", (*joints, *carriers, *beside), compute)


def holding(joint: Joint) -> str:
    """What a joint's motor gives a component of: the moment of a joint that turns, else the force."""
    return f"{'nl' if joint.type is JointType.REVOLUTE else 'fl'}{joint.index}"


def _in_groups(values: Sequence[Matrix], size: int) -> Iterator[Sequence[Matrix]]:
    return (values[k : k + size] for k in range(0, len(values), size))
