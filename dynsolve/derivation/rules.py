"""The textbook's derivation as rules, in the order of the course.

Each function yields the rules of a stage.  Quantities go by their names in an answer
file, a body's index is its name and a coordinate's its place: `H2`, `Jv1`, `Kv1`, `K`,
`dLdqd1`, `tau`, `D`.  The formulas are in the file of their section of the textbook
(`kinematics`, `link_frame`, `euler_lagrange`); a rule
says from which quantities they are computed.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial

from dynsolve.algebra.matrix import Matrix, vstack
from dynsolve.derivation import euler_lagrange, kinematics, link_frame
from dynsolve.derivation.graph import Derivation, Rule
from dynsolve.derivation.link_frame import link_frame_rules
from dynsolve.quantities.owners import asked_stages
from dynsolve.quantities.stages import ASKED_FOR
from dynsolve.robot.model import Body, Robot


def derive(robot: Robot) -> Derivation:
    """The derivation of a robot.

    Where both give the same, the link frames' rules, which are faster, take the place
    of the textbook's.
    """
    if robot.has_table:
        return Derivation([*course_rules(robot), *link_frame_rules(robot), *_rotors(robot)])
    from dynsolve.derivation.model_rules import direct_rules

    return Derivation([*course_rules(robot), *direct_rules(robot), *_rotors(robot)])


def course_rules(robot: Robot) -> Iterator[Rule]:
    """Every rule of the textbook's derivation; of a robot without masses those of the kinematics alone."""
    yield from _kinematics(robot)
    if robot.has_table:
        yield from _end_jacobian(robot)
    if robot.has_dynamics:
        for body in robot.bodies:
            yield from _body(robot, body)
        yield from _energies(robot)
        yield from _euler_lagrange(robot)
        yield from _vectorized(robot)
    yield from _asked(robot)


def _asked(robot: Robot) -> Iterator[Rule]:
    """The rules of what an exercise asks beyond the course's derivation, each from its own folder."""
    asked = asked_stages(robot.questions)
    for stage in ASKED_FOR:
        if stage in asked and (question := stage.part("derive")) is not None:
            yield from question.rules(robot)


def _rotors(robot: Robot) -> Iterator[Rule]:
    """The link frames' rules of the rotors."""
    if robot.has_dynamics and robot.actions.rotors:
        from dynsolve.derivation.actions import rotor_rules

        yield from rotor_rules(robot)


def _kinematics(robot: Robot) -> Iterator[Rule]:
    yield Rule("H0", (), partial(kinematics.base_transform, robot))
    for joint in robot.joints:
        i = joint.index
        yield Rule(f"A{i}", (), partial(kinematics.dh_matrix, robot, joint))
        yield Rule(f"H{i}", (f"H{joint.parent}", f"A{i}"), kinematics.frame)


def _end_jacobian(robot: Robot) -> Iterator[Rule]:
    last = len(robot.joints)
    frames = kinematics.frame_names(last)

    def linear(*H: Matrix) -> Matrix:
        return kinematics.linear_jacobian(robot, H, kinematics.origin(H[-1]), last)

    def angular(*H: Matrix) -> Matrix:
        return kinematics.angular_jacobian(robot, H, last)

    yield Rule("Jv", frames, linear)
    yield Rule("Jw", frames, angular)
    yield Rule("J", ("Jv", "Jw"), vstack)


def _body(robot: Robot, body: Body) -> Iterator[Rule]:
    b = body.name
    yield from _motion(robot, body)
    yield Rule(f"v{b}", (f"Jv{b}",), partial(link_frame.velocity, robot))
    yield Rule(f"w{b}", (f"Jw{b}",), partial(link_frame.velocity, robot))
    yield _own_tensor(robot, body)
    yield Rule(f"I{b}", (f"R{b}", f"I_body{b}"), link_frame.base_inertia)
    yield Rule(f"P{b}", (f"rc{b}",), partial(link_frame.potential_energy, robot, body.mass))
    yield Rule(f"Kv{b}", (f"v{b}",), partial(link_frame.linear_energy, body.mass))
    if body.is_point:
        yield Rule(f"Kw{b}", (), lambda: robot.ring.zero)
    else:
        yield Rule(f"Kw{b}", (f"w{b}", f"I{b}"), link_frame.rotational_energy)
    yield Rule(f"K{b}", (f"Kv{b}", f"Kw{b}"), link_frame.kinetic_energy)


def _motion(robot: Robot, body: Body) -> Iterator[Rule]:
    """Where a body is and how it moves with the coordinates: by its link, or by its given position."""
    if not robot.has_table:
        from dynsolve.derivation.model_rules import motion_rules

        yield from motion_rules(robot, body)
        return
    b, link = body.name, body.link
    H = f"H{link}"
    from_frames_and_center = (*kinematics.frame_names(link), f"rc{b}")

    def linear(*values: Matrix) -> Matrix:
        *frames, center = values
        return kinematics.linear_jacobian(robot, frames, center, link)

    def angular(*values: Matrix) -> Matrix:
        *frames, _ = values
        return kinematics.angular_jacobian(robot, frames, link)

    yield Rule(f"rc{b}", (H,), lambda H: kinematics.point(H, body.center))
    yield Rule(f"R{b}", (H,), partial(link_frame.body_rotation, robot, body))
    yield Rule(f"Jv{b}", from_frames_and_center, linear)
    yield Rule(f"Jw{b}", from_frames_and_center, angular)


def _own_tensor(robot: Robot, body: Body) -> Rule:
    """The tensor about the mass centre, along the body's own axes."""
    b = body.name
    if robot.has_table:
        return Rule(f"I_body{b}", (f"H{body.link}",), partial(link_frame.central_inertia, robot, body))
    return Rule(f"I_body{b}", (), lambda: body.inertia or Matrix.zero(robot.ring, 3, 3))


def _energies(robot: Robot) -> Iterator[Rule]:
    stored, moving = ([name] if name in robot.actions.terms else [] for name in ("Ps", "Km"))
    if stored or moving:
        from dynsolve.derivation.actions import energy_rules

        yield from energy_rules(robot)
    if robot.given is not None:
        from dynsolve.derivation.model_rules import given_rules

        yield from given_rules(robot, robot.given, stored, moving)
    else:
        names = [body.name for body in robot.bodies]
        parts_of_P, parts_of_K = (*(f"P{b}" for b in names), *stored), (*(f"K{b}" for b in names), *moving)
        yield Rule("P", parts_of_P, lambda *parts: link_frame.total(robot.ring, parts))
        yield Rule("K", parts_of_K, lambda *parts: link_frame.total(robot.ring, parts))
    yield Rule("L", ("K", "P"), euler_lagrange.lagrangian)


def _euler_lagrange(robot: Robot) -> Iterator[Rule]:
    resisted = robot.actions.resistance
    if resisted:
        from dynsolve.derivation.actions import friction_rule

        yield friction_rule(robot)
    for q in robot.coordinates:
        k = q.index
        yield Rule(f"dLdqd{k}", ("L",), partial(euler_lagrange.momentum, k=k - 1))
        yield Rule(f"ddt{k}", (f"dLdqd{k}",), euler_lagrange.momentum_rate)
        yield Rule(f"dLdq{k}", ("L",), partial(euler_lagrange.coordinate_derivative, k=k - 1))
        equation = partial(euler_lagrange.generalized_force, k=k - 1)
        yield Rule(f"tau{k}", (f"ddt{k}", f"dLdq{k}", *resisted), equation)
    forces = tuple(f"tau{q.index}" for q in robot.coordinates)
    yield Rule("tau", forces, lambda *parts: euler_lagrange.force_vector(robot, parts))


def _vectorized(robot: Robot) -> Iterator[Rule]:
    yield Rule("D", ("tau",), partial(euler_lagrange.inertia_from_torque, robot))
    yield Rule("christoffel", ("D",), partial(euler_lagrange.christoffel_symbols, robot))
    yield Rule("C", ("christoffel",), partial(euler_lagrange.coriolis_matrix, robot))
    yield Rule("g", ("tau",), partial(euler_lagrange.gravity_from_torque, robot))
    left = ("tau", "g", *robot.actions.resistance)
    yield Rule("Cqd", left, partial(euler_lagrange.coriolis_from_torque, robot))
    yield Rule("g_direct", ("P",), partial(euler_lagrange.gravity_vector, robot))
