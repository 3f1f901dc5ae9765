"""Slips in one step: the step done otherwise, from the student's own inputs.

Each function gives, for a node and the values of its inputs, what comes out when
the step goes wrong in a way that people do.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

from msgspec.structs import replace

from dynsolve.algebra.angles import Angle
from dynsolve.algebra.expr import Expr
from dynsolve.algebra.matrix import Matrix
from dynsolve.answers.diagnosis import kinematic_steps
from dynsolve.answers.diagnosis.slips import slip
from dynsolve.answers.verdict import Diagnosis
from dynsolve.derivation import euler_lagrange, kinematics, link_frame
from dynsolve.notation.printing import PLAIN
from dynsolve.notation.tree import Symbol
from dynsolve.notation.unicode import to_unicode
from dynsolve.quantities import families
from dynsolve.quantities.family import Family
from dynsolve.quantities.index import quantities
from dynsolve.robot.model import AxesKind, Body, Convention, Coordinate, Joint, Robot

Variant = tuple[Any, Diagnosis]
"""A value that a step gives when it goes wrong, and the slip."""

InputValue = Callable[[str], Any]
"""The nearest value of a node."""


def variants(robot: Robot, node: str, value: InputValue) -> Iterator[Variant]:
    """The values that a step gives when it is done wrongly, with the slip; `value` gives its inputs."""
    quantity = quantities(robot).of_rule(node)
    if quantity is None:
        return
    family, index = quantity.family, quantity.index
    if family in _OF_ROBOT:
        yield from _OF_ROBOT[family](robot, value)
    elif family in _OF_ROW:
        yield from _OF_ROW[family](robot, robot.joints[index[0] - 1], value)
    elif family in _OF_BODY:
        yield from _OF_BODY[family](robot, robot.bodies[index[0] - 1], value)
    elif family in _OF_COORDINATE:
        yield from _OF_COORDINATE[family](robot, robot.coordinates[index[0] - 1], value)
    elif family in kinematic_steps.OF_POINT:
        yield from kinematic_steps.OF_POINT[family](robot, robot.questions.points[index[0] - 1], value)
    if robot.actions:
        from dynsolve.answers.diagnosis.action_steps import action_variants

        yield from action_variants(robot, quantity, value)


# -- kinematics ------------------------------------------------------------------------------------


def _dh(robot: Robot, joint: Joint, value: InputValue) -> Iterator[Variant]:
    right = kinematics.dh_matrix(robot, joint)
    bare = Angle(tuple(t for t in joint.theta.terms if t[0][0][0] in robot.ring.names))
    if joint.theta != bare and bare.terms:
        yield kinematics.dh_matrix(robot, replace(joint, theta=bare)), slip("offset")
    other = Convention.MODIFIED if robot.convention is Convention.STANDARD else Convention.STANDARD
    yield kinematics.dh_matrix(replace(robot, convention=other), joint), slip("convention")
    yield kinematics.dh_matrix(robot, replace(joint, alpha=-joint.alpha)), slip("twist_sign")
    yield right.T, slip("transposed")


def _frame(robot: Robot, joint: Joint, value: InputValue) -> Iterator[Variant]:
    if joint.index > 1:
        yield value(f"A{joint.index}") @ value(f"H{joint.parent}"), slip("order")


def _center(robot: Robot, body: Body, value: InputValue) -> Iterator[Variant]:
    if not robot.has_table:
        return
    for link in (body.link, body.link - 1):
        yield (
            kinematics.origin(value(f"H{link}")),
            slip("frame_origin", part=str(link), other=body.name),
        )


# -- Jacobians -------------------------------------------------------------------------------------


def _frames(value: InputValue, link: int) -> list[Matrix]:
    return [value(f"H{i}") for i in range(link + 1)]


def _linear_jacobian(robot: Robot, body: Body, value: InputValue) -> Iterator[Variant]:
    if not robot.has_table:
        return
    frames = _frames(value, len(robot.joints))
    tip = kinematics.origin(frames[body.link])
    yield (
        kinematics.linear_jacobian(robot, frames, tip, body.link),
        slip("frame_origin", part=str(body.link), other=body.name),
    )
    if body.link < len(robot.joints):
        yield (
            kinematics.linear_jacobian(robot, frames, value(f"rc{body.name}"), len(robot.joints)),
            slip("joint_columns", part=body.name),
        )


def _end_jacobian(robot: Robot, value: InputValue) -> Iterator[Variant]:
    links = len(robot.joints)
    yield _all_turn(robot, _frames(value, links), links), slip("prismatic_turns")


def _angular_jacobian(robot: Robot, body: Body, value: InputValue) -> Iterator[Variant]:
    if not robot.has_table:
        return
    links = len(robot.joints)
    frames = _frames(value, links)
    yield _all_turn(robot, frames, body.link), slip("prismatic_turns")
    if body.link < links:
        yield kinematics.angular_jacobian(robot, frames, links), slip("joint_columns", part=body.name)


def _all_turn(robot: Robot, frames: list[Matrix], link: int) -> Matrix:
    """J_ω with an axis for prismatic joints too."""
    columns = [Matrix.zero(robot.ring, 3, 1)] * robot.n
    for joint in robot.path(link):
        if joint.type is not None:
            z = kinematics.axis(frames[kinematics.joint_frame(robot, joint)])
            for k, rate in joint.rates:
                columns[k] = columns[k] + z.scale(robot.ring.constant(rate))
    return Matrix.of(robot.ring, ([c[i, 0] for c in columns] for i in range(3)))


# -- inertia and energies --------------------------------------------------------------------------


def _body_inertia(robot: Robot, body: Body, value: InputValue) -> Iterator[Variant]:
    if body.inertia is None:
        return
    right = value(f"I_body{body.name}")
    if body.about_point is None:
        yield from _about_joint(robot, body, right)
        return
    yield body.inertia, slip("parallel_axis_missing", part=body.name)
    yield right + right - body.inertia, slip("parallel_axis_twice", part=body.name)
    yield body.inertia + body.inertia - right, slip("parallel_axis_twice", part=body.name)


def _about_joint(robot: Robot, body: Body, right: Matrix) -> Iterator[Variant]:
    """The tensor about the near end, where the one about the mass centre belongs."""
    if body.link == 0 or body.axes.kind is not AxesKind.LINK:
        return
    step = kinematics.dh_matrix(robot, robot.joints[body.link - 1])
    near = -(kinematics.rotation(step).T @ kinematics.origin(step))
    if robot.convention is Convention.MODIFIED:
        near = Matrix.zero(robot.ring, 3, 1)
    if not any(map(robot.ring.depends_on_coordinates, near.entries)):
        offset = body.axes.rotation.T @ (body.center - near)
        yield right + link_frame.steiner(body.mass, offset), slip("parallel_axis_twice", part=body.name)


def _base_inertia(robot: Robot, body: Body, value: InputValue) -> Iterator[Variant]:
    tensor, R = value(f"I_body{body.name}"), value(f"R{body.name}")
    yield tensor, slip("not_rotated", part=body.name)
    yield R.T @ tensor @ R, slip("rotation_transposed", part=body.name)
    if not robot.has_table:
        return
    if body.axes.kind is AxesKind.LINK:
        before = link_frame.body_rotation(robot, body, value(f"H{body.link - 1}"))
        yield before @ tensor @ before.T, slip("frame_before", part=body.name)
    frame = kinematics.rotation(value(f"H{body.link}"))
    yield frame @ tensor @ frame.T, slip("not_rotated", part=body.name)


def _rotational(robot: Robot, body: Body, value: InputValue) -> Iterator[Variant]:
    if body.is_point:
        return
    w = value(f"w{body.name}")
    yield link_frame.rotational_energy(w, value(f"I_body{body.name}")), slip("spin_frame", part=body.name)
    for tensor, told in _base_inertia(robot, body, value):
        yield link_frame.rotational_energy(w, tensor), told


def _linear(robot: Robot, body: Body, value: InputValue) -> Iterator[Variant]:
    for J, told in _linear_jacobian(robot, body, value):
        yield link_frame.linear_energy(body.mass, link_frame.velocity(robot, J)), told


def _total_potential(robot: Robot, value: InputValue) -> Iterator[Variant]:
    right = value("P")
    springs = value("Ps") if robot.actions.springs else robot.ring.zero
    yield springs + springs - right, slip("gravity_sign")
    for body in robot.bodies:
        yield right - value(f"P{body.name}"), slip("body_missing", part=body.name, other="P")


def _potential(robot: Robot, body: Body, value: InputValue) -> Iterator[Variant]:
    right = link_frame.potential_energy(robot, body.mass, value(f"rc{body.name}"))
    yield -right, slip("gravity_sign")
    for center, told in _center(robot, body, value):
        yield link_frame.potential_energy(robot, body.mass, center), told


def _kinetic(robot: Robot, body: Body, value: InputValue) -> Iterator[Variant]:
    yield value(f"Kv{body.name}"), slip("rotation_missing")
    yield value(f"Kw{body.name}"), slip("translation_missing")


def _total_kinetic(robot: Robot, value: InputValue) -> Iterator[Variant]:
    bodies = robot.bodies
    if not bodies:
        return
    rotors = value("Km") if robot.actions.motors else robot.ring.zero
    total = link_frame.total(robot.ring, (*(value(f"K{b.name}") for b in bodies), rotors))
    for b in bodies:
        if len(bodies) > 1:
            yield total - value(f"K{b.name}"), slip("body_missing", part=b.name, other="K")
    yield (
        link_frame.total(robot.ring, (*(value(f"Kv{b.name}") for b in bodies), rotors)),
        slip("rotation_missing"),
    )


# -- Lagrange --------------------------------------------------------------------------------------


def _lagrangian(robot: Robot, value: InputValue) -> Iterator[Variant]:
    yield value("K") + value("P"), slip("lagrangian_sum")
    springs = value("Ps") if robot.actions.springs else robot.ring.zero
    yield value("K") - springs, slip("gravity_missing")


def _rate(robot: Robot, q: Coordinate, value: InputValue) -> Iterator[Variant]:
    """d/dt ∂L/∂q̇ with one coordinate held constant, all of them, or inner derivatives left out."""
    ring, p = robot.ring, value(f"dLdqd{q.index}")
    partials = [ring.diff(p, k) for k in range(robot.n)]
    moving = [k for k, one in enumerate(partials) if not one.is_zero]
    if not moving:
        return
    right = ring.time_derivative(p)
    names = [q.name for q in robot.coordinates]
    accelerated = right
    for k in moving:
        accelerated = accelerated - partials[k] * ring.symbol(names[k], 1)
    every = ", ".join(_written(names[k]) for k in moving)
    yield accelerated, slip("product_rule", part=every)
    for k in moving:
        part = partials[k] * ring.symbol(names[k], 1)
        yield right - part, slip("product_rule", part=_written(names[k]))
        yield right - part + partials[k], slip("chain_rule", part=_written(names[k], 1))
    bare = accelerated
    for k in moving:
        bare = bare + partials[k]
    yield bare, slip("chain_rule", part="q̇")


def _written(name: str, dots: int = 0) -> str:
    return to_unicode(Symbol(name, dots), PLAIN)


def _force(robot: Robot, q: Coordinate, value: InputValue) -> Iterator[Variant]:
    rate, dLdq = value(f"ddt{q.index}"), value(f"dLdq{q.index}")
    if dLdq.is_zero:
        return
    resisted = value("friction")[q.index - 1, 0] if "friction" in robot.actions.kinds else robot.ring.zero
    yield rate + dLdq + resisted, slip("slope_sign")
    yield rate + resisted, slip("slope_missing")


# -- the vectorized form ---------------------------------------------------------------------------


def _forces(robot: Robot, value: InputValue) -> Iterator[Variant]:
    yield from _rows(value("tau"))


def _rows(right: Matrix) -> Iterator[Variant]:
    """Two rows exchanged."""
    rows = list(right.rows)
    for i in range(len(rows)):
        for j in range(i + 1, len(rows)):
            if rows[i] != rows[j]:
                swapped = list(rows)
                swapped[i], swapped[j] = rows[j], rows[i]
                yield (
                    Matrix(right.ring, tuple(swapped)),
                    slip("rows_swapped", part=str(i + 1), other=str(j + 1)),
                )


def _gravity(robot: Robot, value: InputValue) -> Iterator[Variant]:
    right = value("g")
    springs = Matrix.zero(robot.ring, robot.n, 1)
    if robot.actions.springs:
        springs = euler_lagrange.gravity_vector(robot, value("Ps"))
    yield springs + springs - right, slip("gravity_sign")
    yield from _rows(right)


def _coriolis(robot: Robot, value: InputValue) -> Iterator[Variant]:
    D = value("D")
    symbols = euler_lagrange.christoffel_symbols(robot, D)
    ring, n = robot.ring, robot.n
    rates = link_frame.velocities(robot)
    plain = Matrix.of(
        ring,
        ([_sum(ring.zero, (symbols[min(i, j), max(i, j), k] for i in range(n))) for j in range(n)]
         for k in range(n)),
    )  # fmt: skip
    yield plain @ rates, slip("christoffel_without_rates")
    right = euler_lagrange.coriolis_matrix(robot, symbols) @ rates
    yield right + right, slip("christoffel_half")
    yield from _rows(right)


def _sum(zero: Expr, terms: Iterator[Expr]) -> Expr:
    for term in terms:
        zero = zero + term
    return zero


def _inertia_matrix(robot: Robot, value: InputValue) -> Iterator[Variant]:
    yield from _rows(value("D"))


_OF_ROBOT: dict[Family, Callable[[Robot, InputValue], Iterator[Variant]]] = {
    families.JW: _end_jacobian,
    families.P: _total_potential,
    families.K: _total_kinetic,
    families.L: _lagrangian,
    families.TAU: _forces,
    families.D: _inertia_matrix,
    families.CQD: _coriolis,
    families.G: _gravity,
    **kinematic_steps.OF_ROBOT,
}

_OF_ROW: dict[Family, Callable[[Robot, Joint, InputValue], Iterator[Variant]]] = {
    families.A: _dh,
    families.H: _frame,
}

_OF_BODY: dict[Family, Callable[[Robot, Body, InputValue], Iterator[Variant]]] = {
    families.RC: _center,
    families.JV_BODY: _linear_jacobian,
    families.JW_BODY: _angular_jacobian,
    families.I_BODY: _body_inertia,
    families.I: _base_inertia,
    families.P_BODY: _potential,
    families.KV: _linear,
    families.KW: _rotational,
    families.K_BODY: _kinetic,
}

_OF_COORDINATE: dict[Family, Callable[[Robot, Coordinate, InputValue], Iterator[Variant]]] = {
    families.DDT: _rate,
    families.FORCE: _force,
}
