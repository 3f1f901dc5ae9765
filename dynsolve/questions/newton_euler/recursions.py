"""The Newton-Euler recursions, link by link in the links' own frames: outwards motions, inwards forces.

Every vector is 3×1 and has its components along the axes of the frame of its link, i.  In the standard
convention (Spong, Hutchinson, Vidyasagar, section 7.6) joint i lies on z_{i-1}, gravity is a force on each
link, and n_i is taken about o_{i-1}; in the modified convention (Craig, section 6.5) joint i lies on z_i,
the base accelerates upwards in gravity's stead, and n_i is taken about o_i.

The check of every derivation is another program of this kind, on numbers (`newton_euler`); they share
nothing.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from msgspec import Struct

from dynsolve.algebra.matrix import Matrix, cross
from dynsolve.algebra.ring import Expr
from dynsolve.derivation import link_frame
from dynsolve.derivation.kinematics import origin, rotation
from dynsolve.derivation.link_frame import accelerations, velocities
from dynsolve.questions.statics.derive import wrench
from dynsolve.robot.model import Body, Convention, Joint, JointType, Robot


def is_standard(robot: Robot) -> bool:
    """Whether the recursions are Spong's; otherwise they are Craig's."""
    return robot.convention is Convention.STANDARD


def joint_axis(robot: Robot, A: Matrix) -> Matrix:
    """The axis of joint i along the axes of frame i: (R_i^{i-1})ᵀ k in the standard convention, else k."""
    k = Matrix.identity(robot.ring, 3).column_at(2)
    return rotation(A).T @ k if is_standard(robot) else k


def joint_rate(robot: Robot, joint: Joint, A: Matrix, dots: int) -> Matrix:
    """z q̇ or z q̈ of a joint, 3×1 along the axes of frame i; zero of a fixed frame."""
    ring = robot.ring
    rates = velocities(robot) if dots == 1 else accelerations(robot)
    own = sum((rates[k, 0] * rate for k, rate in joint.rates), start=ring.zero)
    return joint_axis(robot, A).scale(own)


# -- outwards --------------------------------------------------------------------------------------


def angular_velocity(robot: Robot, joint: Joint, A: Matrix, before: Matrix) -> Matrix:
    """ω_i = Rᵀ ω_{i-1} + z θ̇_i, R = R_i^{i-1} and z the joint's axis; without θ̇_i of a joint that slides."""
    carried = rotation(A).T @ before
    return carried + joint_rate(robot, joint, A, 1) if joint.type is JointType.REVOLUTE else carried


def angular_acceleration(robot: Robot, joint: Joint, A: Matrix, before: Matrix, spin: Matrix) -> Matrix:
    """ω̇_i = Rᵀ ω̇_{i-1} + z θ̈_i + ω_i × z θ̇_i; `before` is ω̇_{i-1} and `spin` ω_i."""
    carried = rotation(A).T @ before
    if joint.type is not JointType.REVOLUTE:
        return carried
    return carried + joint_rate(robot, joint, A, 2) + cross(spin, joint_rate(robot, joint, A, 1))


def lift(robot: Robot) -> Matrix:
    """The acceleration that the base is given: none, or in the modified convention gravity's opposite."""
    if is_standard(robot):
        return Matrix.zero(robot.ring, 3, 1)
    return -(robot.base_rotation.T @ robot.gravity)


class Motion(Struct, frozen=True):
    """How a frame moves, along its own axes: ω, ω̇ and the acceleration of its origin, 3×1 each."""

    w: Matrix
    dw: Matrix
    a: Matrix


def turning_parts(w: Matrix, dw: Matrix, arm: Matrix) -> tuple[Matrix, Matrix]:
    """ω̇ × r and ω × (ω × r), 3×1: what turning adds to the acceleration a lever r away."""
    return cross(dw, arm), cross(w, cross(w, arm))


def lever(A: Matrix) -> Matrix:
    """From o_{i-1} to o_i along the axes of frame i, 3×1."""
    return rotation(A).T @ origin(A)


class Step(Struct, frozen=True):
    """The way from frame i-1 to frame i: the joint, A_i, and the motion of frame i-1."""

    joint: Joint
    A: Matrix
    before: Motion


def acceleration_parts(
    robot: Robot, step: Step, w: Matrix, dw: Matrix, beyond: Matrix | None = None
) -> tuple[Matrix, ...]:
    """The terms of the acceleration of o_i, or in the standard convention of a point `beyond` it in link i.

    w and dw are ω_i and ω̇_i.  Standard: Rᵀ a_{i-1}, ω̇_i × r, ω_i × (ω_i × r), the way r from o_{i-1}
    turning with frame i; modified: Rᵀ (a_{i-1} + ω̇_{i-1} × p + ω_{i-1} × (ω_{i-1} × p)), with frame i-1.
    A joint that slides adds 2 ω_i × z ḋ_i and z d̈_i.
    """
    joint, A, before = step.joint, step.A, step.before
    back = rotation(A).T
    if is_standard(robot):
        arm = lever(A) if beyond is None else lever(A) + beyond
        carried: tuple[Matrix, ...] = (back @ before.a, *turning_parts(w, dw, arm))
    else:
        towards, around = turning_parts(before.w, before.dw, origin(A))
        carried = (back @ (before.a + towards + around),)
    if joint.type is not JointType.PRISMATIC:
        return carried
    coriolis = cross(w, joint_rate(robot, joint, A, 1)).scale(robot.ring.constant(2))
    return (*carried, coriolis, joint_rate(robot, joint, A, 2))


def total(parts: Iterable[Matrix], robot: Robot) -> Matrix:
    """The sum of 3×1 vectors."""
    return sum(parts, start=Matrix.zero(robot.ring, 3, 1))


def base_motion(robot: Robot) -> Motion:
    """Frame 0, at rest; in the modified convention it accelerates upwards in gravity's stead."""
    still = Matrix.zero(robot.ring, 3, 1)
    return Motion(still, still, lift(robot))


# -- inwards ---------------------------------------------------------------------------------------


def _gravity(robot: Robot, H: Matrix) -> Matrix:
    """g_0 along the axes of frame i in the standard convention; in the modified one a_c has it already."""
    if is_standard(robot):
        return rotation(H).T @ robot.gravity
    return Matrix.zero(robot.ring, 3, 1)


def inertial_force(robot: Robot, body: Body, H: Matrix, acceleration: Matrix) -> Matrix:
    """m (a_c - g_0), what a body takes besides its weight; m a_c in the modified convention."""
    return (acceleration - _gravity(robot, H)).scale(body.mass)


def tensor_in_link(robot: Robot, body: Body, H: Matrix, tensor: Matrix) -> Matrix:
    """The body's tensor about its mass centre along the axes of its link's frame, 3×3."""
    relative = link_frame.axes_in_link(robot, body, H)
    return relative @ tensor @ relative.T


def inertial_moment(tensor: Matrix, w: Matrix, dw: Matrix) -> Matrix:
    """I ω̇ + ω × I ω, Euler's equation of a body about its mass centre; I along the link's axes."""
    return tensor @ dw + cross(w, tensor @ w)


def force(robot: Robot, carried: Sequence[tuple[Matrix, Matrix]], own: Sequence[Matrix]) -> Matrix:
    """f_i = Σ R_{i+1}^i f_{i+1} + Σ m (a_c - g_0) - Σ F: what the link before holds link i with.

    `carried` are (A_{i+1}, f_{i+1}) of the links that follow, `own` the forces of the link's bodies, and -F
    of what acts from outside.
    """
    return total((*(rotation(A) @ f for A, f in carried), *own), robot)


def from_outside(robot: Robot, link: int, H: Matrix) -> list[tuple[int, Matrix, Matrix, Matrix]]:
    """(its number, p, F, M) of each force that acts on a link from outside, 3×1 along the axes of frame i.

    p is its point, from o_i.  The link before holds the link with so much less: f_i has -F, n_i -M - p × F.
    """
    back = rotation(H).T
    found = []
    for number, load in enumerate(robot.questions.loads, 1):
        if load.link == link:
            force, moment = wrench(load, H)
            found.append((number, load.position, back @ force, back @ moment))
    return found


class Carried(Struct, frozen=True):
    """A link that follows: A_{i+1}, and the f_{i+1} and n_{i+1} that it is held with."""

    A: Matrix
    f: Matrix
    n: Matrix


def moment(
    robot: Robot,
    start: Matrix,
    carried: Sequence[Carried],
    own: Sequence[tuple[Matrix, Matrix, Matrix]],
) -> Matrix:
    """n_i, the moment that the link before holds link i with, about o_{i-1} (standard) or o_i (modified).

    n_i = Σ (R n_{i+1} + l × R f_{i+1}) + Σ (N + (s + r_c) × F).  s = `start` leads from the point of n_i
    to o_i; l to the point of n_{i+1}: this is o_i in the standard convention, else o_{i+1}.  `own` are
    (r_c, F, N) of the link's bodies, and (p, -F, -M) of what acts from outside.
    """
    found = Matrix.zero(robot.ring, 3, 1)
    for link in carried:
        R = rotation(link.A)
        reach = start if is_standard(robot) else origin(link.A)
        found = found + R @ link.n + cross(reach, R @ link.f)
    for center, inertial, couple in own:
        found = found + couple + cross(start + center, inertial)
    return found


def start_of_moments(robot: Robot, A: Matrix) -> Matrix:
    """From the point that n_i is about to o_i, along the axes of frame i, 3×1."""
    return lever(A) if is_standard(robot) else Matrix.zero(robot.ring, 3, 1)


def component(robot: Robot, A: Matrix, held: Matrix) -> Expr:
    """What a joint's motor does: nᵀ z of one that turns, fᵀ z of one that slides; `held` is n_i or f_i."""
    return robot.ring.dot(joint_axis(robot, A).entries, held.entries)
