"""Slips in one step: the step done otherwise, from the student's own inputs.

Each function gives, for a node and the values of its inputs, what comes out when
the step goes wrong in a way that people do.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

from dynsolve.algebra.angles import Angle
from dynsolve.algebra.expr import Expr
from dynsolve.algebra.matrix import Matrix
from dynsolve.answers.diagnosis.slips import slip
from dynsolve.answers.verdict import Diagnosis
from dynsolve.derivation import energy, inertia, jacobian, kinematics, vectorized
from dynsolve.notation.printing import PLAIN
from dynsolve.notation.tree import Symbol
from dynsolve.notation.unicode import to_unicode
from dynsolve.robot.model import AxesKind, Body, Convention, Joint, Robot

Variant = tuple[Any, Diagnosis]
"""A value that a step gives when it goes wrong, and the slip."""

InputValue = Callable[[str], Any]
"""The nearest value of a node."""


def variants(robot: Robot, node: str, value: InputValue) -> Iterator[Variant]:
    """What a step may give when it goes wrong; `value` gives its inputs."""
    head, index = _split(node)
    maker = _MAKERS.get(head)
    if maker is not None:
        yield from maker(robot, index, value)


def _split(node: str) -> tuple[str, str]:
    for head in sorted(_MAKERS, key=len, reverse=True):
        if node.startswith(head):
            return head, node[len(head) :]
    return node, ""


def _body(robot: Robot, name: str) -> Body | None:
    return next((b for b in robot.bodies if b.name == name), None)


def _joint(robot: Robot, index: str) -> Joint | None:
    return next((j for j in robot.joints if str(j.index) == index), None)


# -- kinematics ------------------------------------------------------------------------------------


def _dh(robot: Robot, index: str, value: InputValue) -> Iterator[Variant]:
    from dataclasses import replace

    joint = _joint(robot, index)
    if joint is None:
        return
    right = kinematics.dh_matrix(robot, joint)
    bare = Angle(tuple(t for t in joint.theta.terms if t[0][0][0] in robot.ring.names))
    if joint.theta != bare and bare.terms:
        yield kinematics.dh_matrix(robot, replace(joint, theta=bare)), slip("offset")
    other = Convention.MODIFIED if robot.convention is Convention.STANDARD else Convention.STANDARD
    yield kinematics.dh_matrix(replace(robot, convention=other), joint), slip("convention")
    yield kinematics.dh_matrix(robot, replace(joint, alpha=-joint.alpha)), slip("twist_sign")
    yield right.T, slip("transposed")


def _frame(robot: Robot, index: str, value: InputValue) -> Iterator[Variant]:
    if index.isdigit() and int(index) > 1:
        yield value(f"A{index}") @ value(f"H{int(index) - 1}"), slip("order")


def _center(robot: Robot, name: str, value: InputValue) -> Iterator[Variant]:
    body = _body(robot, name)
    if body is None:
        return
    for link in (body.link, body.link - 1):
        yield (
            kinematics.origin(value(f"H{link}")),
            slip("frame_origin", part=str(link), other=name),
        )


# -- Jacobians -------------------------------------------------------------------------------------


def _frames(value: InputValue, link: int) -> list[Matrix]:
    return [value(f"H{i}") for i in range(link + 1)]


def _linear_jacobian(robot: Robot, name: str, value: InputValue) -> Iterator[Variant]:
    body = _body(robot, name)
    if body is None:
        return
    frames = _frames(value, len(robot.joints))
    tip = kinematics.origin(frames[body.link])
    yield (
        jacobian.linear_jacobian(robot, frames, tip, body.link),
        slip("frame_origin", part=str(body.link), other=name),
    )
    if body.link < len(robot.joints):
        yield (
            jacobian.linear_jacobian(robot, frames, value(f"rc{name}"), len(robot.joints)),
            slip("joint_columns", part=name),
        )


def _angular_jacobian(robot: Robot, name: str, value: InputValue) -> Iterator[Variant]:
    body = _body(robot, name)
    link = body.link if body is not None else len(robot.joints)
    frames = _frames(value, len(robot.joints))
    yield _all_turn(robot, frames, link), slip("prismatic_turns")
    if body is not None and link < len(robot.joints):
        yield jacobian.angular_jacobian(robot, frames, len(robot.joints)), slip("joint_columns", part=name)


def _all_turn(robot: Robot, frames: list[Matrix], link: int) -> Matrix:
    """J_ω with an axis for prismatic joints too."""
    columns = [Matrix.zero(robot.ring, 3, 1)] * robot.n
    for joint in robot.joints[:link]:
        if joint.type is not None:
            z = kinematics.axis(frames[jacobian.joint_frame(robot, joint)])
            for k, rate in joint.rates:
                columns[k] = columns[k] + z.scale(robot.ring.constant(rate))
    return Matrix.of(robot.ring, ([c[i, 0] for c in columns] for i in range(3)))


# -- inertia and energies --------------------------------------------------------------------------


def _body_inertia(robot: Robot, name: str, value: InputValue) -> Iterator[Variant]:
    body = _body(robot, name)
    if body is None or body.inertia is None:
        return
    right = value(f"I_body{name}")
    if body.about_point is None:
        yield from _about_joint(robot, body, right)
        return
    yield body.inertia, slip("parallel_axis_missing", part=name)
    yield right + right - body.inertia, slip("parallel_axis_twice", part=name)
    yield body.inertia + body.inertia - right, slip("parallel_axis_twice", part=name)


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
        yield right + inertia.steiner(body.mass, offset), slip("parallel_axis_twice", part=body.name)


def _base_inertia(robot: Robot, name: str, value: InputValue) -> Iterator[Variant]:
    body = _body(robot, name)
    if body is None:
        return
    tensor, R = value(f"I_body{name}"), value(f"R{name}")
    yield tensor, slip("not_rotated", part=name)
    yield R.T @ tensor @ R, slip("rotation_transposed", part=name)
    if body.axes.kind is AxesKind.LINK:
        before = inertia.body_rotation(robot, body, value(f"H{body.link - 1}"))
        yield before @ tensor @ before.T, slip("frame_before", part=name)
    frame = kinematics.rotation(value(f"H{body.link}"))
    yield frame @ tensor @ frame.T, slip("not_rotated", part=name)


def _rotational(robot: Robot, name: str, value: InputValue) -> Iterator[Variant]:
    body = _body(robot, name)
    if body is None or body.is_point:
        return
    w = value(f"w{name}")
    yield energy.rotational_energy(w, value(f"I_body{name}")), slip("spin_frame", part=name)
    for tensor, told in _base_inertia(robot, name, value):
        yield energy.rotational_energy(w, tensor), told


def _linear(robot: Robot, name: str, value: InputValue) -> Iterator[Variant]:
    body = _body(robot, name)
    if body is None:
        return
    for J, told in _linear_jacobian(robot, name, value):
        yield energy.linear_energy(body.mass, energy.velocity(robot, J)), told


def _potential(robot: Robot, name: str, value: InputValue) -> Iterator[Variant]:
    body = _body(robot, name)
    if body is None:
        right = value("P")
        yield -right, slip("gravity_sign")
        for b in robot.bodies:
            yield right - value(f"P{b.name}"), slip("body_missing", part=b.name, other="P")
        return
    right = energy.potential_energy(robot, body.mass, value(f"rc{name}"))
    yield -right, slip("gravity_sign")
    for center, told in _center(robot, name, value):
        yield energy.potential_energy(robot, body.mass, center), told


def _kinetic(robot: Robot, name: str, value: InputValue) -> Iterator[Variant]:
    body = _body(robot, name)
    if body is not None:
        yield value(f"Kv{name}"), slip("rotation_missing")
        yield value(f"Kw{name}"), slip("translation_missing")
        return
    bodies = robot.bodies
    total = energy.total(robot.ring, tuple(value(f"K{b.name}") for b in bodies))
    for b in bodies:
        if len(bodies) > 1:
            yield total - value(f"K{b.name}"), slip("body_missing", part=b.name, other="K")
    yield (
        energy.total(robot.ring, tuple(value(f"Kv{b.name}") for b in bodies)),
        slip("rotation_missing"),
    )


# -- Lagrange --------------------------------------------------------------------------------------


def _lagrangian(robot: Robot, index: str, value: InputValue) -> Iterator[Variant]:
    yield value("K") + value("P"), slip("lagrangian_sum")
    yield value("K"), slip("gravity_missing")


def _rate(robot: Robot, index: str, value: InputValue) -> Iterator[Variant]:
    """d/dt ∂L/∂q̇ with one coordinate held constant, all of them, or inner derivatives left out."""
    ring, p = robot.ring, value(f"dLdqd{index}")
    slopes = [ring.diff(p, k) for k in range(robot.n)]
    moving = [k for k, slope in enumerate(slopes) if not slope.is_zero]
    if not moving:
        return
    right = ring.time_derivative(p)
    names = [q.name for q in robot.coordinates]
    accelerated = right
    for k in moving:
        accelerated = accelerated - slopes[k] * ring.symbol(names[k], 1)
    every = ", ".join(_written(names[k]) for k in moving)
    yield accelerated, slip("product_rule", part=every)
    for k in moving:
        part = slopes[k] * ring.symbol(names[k], 1)
        yield right - part, slip("product_rule", part=_written(names[k]))
        yield right - part + slopes[k], slip("chain_rule", part=_written(names[k], 1))
    bare = accelerated
    for k in moving:
        bare = bare + slopes[k]
    yield bare, slip("chain_rule", part="q̇")


def _written(name: str, dots: int = 0) -> str:
    return to_unicode(Symbol(name, dots), PLAIN)


def _force(robot: Robot, index: str, value: InputValue) -> Iterator[Variant]:
    rate, slope = value(f"ddt{index}"), value(f"dLdq{index}")
    if slope.is_zero:
        return
    yield rate + slope, slip("slope_sign")
    yield rate, slip("slope_missing")


# -- the vectorized form ---------------------------------------------------------------------------


def _forces(robot: Robot, index: str, value: InputValue) -> Iterator[Variant]:
    if index:
        yield from _force(robot, index, value)
        return
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


def _gravity(robot: Robot, index: str, value: InputValue) -> Iterator[Variant]:
    right = value("g")
    yield -right, slip("gravity_sign")
    yield from _rows(right)


def _coriolis(robot: Robot, index: str, value: InputValue) -> Iterator[Variant]:
    D = value("D")
    symbols = vectorized.christoffel_symbols(robot, D)
    ring, n = robot.ring, robot.n
    rates = energy.velocities(robot)
    plain = Matrix.of(
        ring,
        ([_sum(ring.zero, (symbols[min(i, j), max(i, j), k] for i in range(n))) for j in range(n)]
         for k in range(n)),
    )  # fmt: skip
    yield plain @ rates, slip("christoffel_without_rates")
    right = vectorized.coriolis_matrix(robot, symbols) @ rates
    yield right + right, slip("christoffel_half")
    yield from _rows(right)


def _sum(zero: Expr, terms: Iterator[Expr]) -> Expr:
    for term in terms:
        zero = zero + term
    return zero


def _inertia_matrix(robot: Robot, index: str, value: InputValue) -> Iterator[Variant]:
    yield from _rows(value("D"))


_MAKERS: dict[str, Callable[[Robot, str, InputValue], Iterator[Variant]]] = {
    "A": _dh,
    "H": _frame,
    "rc": _center,
    "Jv": _linear_jacobian,
    "Jw": _angular_jacobian,
    "I_body": _body_inertia,
    "I": _base_inertia,
    "Kw": _rotational,
    "Kv": _linear,
    "K": _kinetic,
    "P": _potential,
    "L": _lagrangian,
    "ddt": _rate,
    "tau": _forces,
    "D": _inertia_matrix,
    "Cqd": _coriolis,
    "g": _gravity,
}
