"""Slips in one step: the step done otherwise, from the student's own inputs.

Each function gives, for the robot, what owns the quantity (a joint, a body, a coordinate, a point, or
None), and the values of the inputs, what comes out when the step goes wrong in a way that people do.
The table at the end says which of them are tried for a quantity of which family.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from fractions import Fraction
from functools import partial
from itertools import chain
from typing import Any

from msgspec.structs import replace

from dynsolve.algebra.angles import Angle
from dynsolve.algebra.matrix import AtState, Matrix
from dynsolve.algebra.ring import Expr
from dynsolve.answers.diagnosis.slips import slip
from dynsolve.answers.verdict import Diagnosis
from dynsolve.derivation import euler_lagrange, kinematics, link_frame
from dynsolve.notation.printing import PLAIN
from dynsolve.notation.tree import Symbol
from dynsolve.notation.unicode import to_unicode
from dynsolve.quantities import action_families, families
from dynsolve.quantities.family import Family, Owner
from dynsolve.quantities.index import quantities
from dynsolve.questions import rates, statics
from dynsolve.questions import task as of_task
from dynsolve.questions.statics.derive import jacobians, total, wrench
from dynsolve.robot.model import Act, Actions, AxesKind, Body, Convention, Coordinate, Joint, Robot
from dynsolve.robot.questions import NamedPoint

Variant = tuple[Any, Diagnosis]
"""A value that a step gives when it goes wrong, and the slip."""

InputValue = Callable[[str], Any]
"""The nearest value of a node."""

Variants = Callable[[Robot, Any, InputValue], Iterator[Variant]]


def variants(robot: Robot, node: str, value: InputValue) -> Iterator[Variant]:
    """The values that a step gives when it is done wrongly, with the slip; `value` gives its inputs."""
    quantity = quantities(robot).of_rule(node)
    if quantity is None:
        return
    owners: dict[Owner, Sequence[Any]] = {
        Owner.ROW: robot.joints,
        Owner.BODY: robot.bodies,
        Owner.COORDINATE: robot.coordinates,
        Owner.POINT: robot.questions.points,
    }
    owner = quantity.family.owner
    of = owners[owner][quantity.index[0] - 1] if owner in owners else None
    if quantity.family in _OTHERWISE:
        yield from _OTHERWISE[quantity.family](robot, of, value)


# -- kinematics ------------------------------------------------------------------------------------


def _dh(robot: Robot, joint: Joint, value: InputValue) -> Iterator[Variant]:
    bare = Angle(tuple(t for t in joint.theta.terms if t[0][0][0] in robot.ring.names))
    if joint.theta != bare and bare.terms:
        yield kinematics.dh_matrix(robot, replace(joint, theta=bare)), slip("offset")
    other = Convention.MODIFIED if robot.convention is Convention.STANDARD else Convention.STANDARD
    yield kinematics.dh_matrix(replace(robot, convention=other), joint), slip("convention")
    yield kinematics.dh_matrix(robot, replace(joint, alpha=-joint.alpha)), slip("twist_sign")
    yield kinematics.dh_matrix(robot, joint).T, slip("transposed")


def _frame(robot: Robot, joint: Joint, value: InputValue) -> Iterator[Variant]:
    if joint.index > 1:
        yield value(f"A{joint.index}") @ value(f"H{joint.parent}"), slip("order")


def _center(robot: Robot, body: Body, value: InputValue) -> Iterator[Variant]:
    for link in (body.link, body.link - 1) if robot.has_table else ():
        yield kinematics.origin(value(f"H{link}")), slip("frame_origin", part=str(link), other=body.name)


def _rotation(robot: Robot, frame: int | None, value: InputValue) -> Matrix:
    return Matrix.identity(robot.ring, 3) if frame is None else kinematics.rotation(value(f"H{frame}"))


def _ground(frame: int | None) -> str:
    return "the world" if frame is None else f"frame {frame}"


def _along_last_axes(robot: Robot, of: None, value: InputValue) -> Iterator[Variant]:
    """R_nᵀ J: the Jacobian along the axes of the last frame."""
    last = len(robot.joints)
    R = _rotation(robot, last, value)
    if Matrix.identity(robot.ring, 3) != R:
        yield R.T @ value("Jv"), slip("tool_frame", part=f"frame {last}", asked="the base")


def _along_other_axes(name: str, robot: Robot, point: NamedPoint, value: InputValue) -> Iterator[Variant]:
    """What is asked for along the axes of one frame, along those of the world and of every other."""
    right = value(name + point.name)
    world = _rotation(robot, point.axes, value) @ right
    for frame in (None, *range(1, len(robot.joints) + 1)):
        own = _rotation(robot, frame, value).T @ world
        if own != right:
            yield own, slip("tool_frame", part=_ground(frame), asked=_ground(point.axes))


def _joint_rates(robot: Robot, of: None, value: InputValue) -> Iterator[Variant]:
    """J_rᵀ ṙ in place of J_r⁻¹ ṙ."""
    if (wanted := robot.questions.velocity) is not None:
        at = _at(robot)
        yield at.matrix(value("Jr")).T @ at.matrix(wanted), slip("transpose_for_inverse")


# -- Jacobians -------------------------------------------------------------------------------------


def _frames(value: InputValue, link: int) -> list[Matrix]:
    return [value(f"H{i}") for i in range(link + 1)]


def _linear_jacobian(robot: Robot, body: Body, value: InputValue) -> Iterator[Variant]:
    if not robot.has_table:
        return
    links = len(robot.joints)
    frames = _frames(value, links)
    at_origin = kinematics.linear_jacobian(robot, frames, kinematics.origin(frames[body.link]), body.link)
    yield at_origin, slip("frame_origin", part=str(body.link), other=body.name)
    if body.link < links:
        of_all = kinematics.linear_jacobian(robot, frames, value(f"rc{body.name}"), links)
        yield of_all, slip("joint_columns", part=body.name)


def _end_jacobian(robot: Robot, of: None, value: InputValue) -> Iterator[Variant]:
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


# -- forces at rest --------------------------------------------------------------------------------


def _outer_forces(robot: Robot, of: None, value: InputValue) -> Iterator[Variant]:
    loads = robot.questions.loads
    if _have_moments(robot) and any(not load.force.is_zero for load in loads):
        yield _without_moments(robot, value), slip("moments_left_out")


def _holding(robot: Robot, of: None, value: InputValue) -> Iterator[Variant]:
    g, Q = Matrix.zero(robot.ring, robot.n, 1), value("Q")
    if robot.bodies:
        g = _at(robot).matrix(value("g"))
    yield g + Q, slip("load_sign")
    if _have_moments(robot):
        yield g - _without_moments(robot, value), slip("moments_left_out")
    if not g.is_zero:
        yield -Q, slip("weight_left_out")


def _have_moments(robot: Robot) -> bool:
    return any(not load.moment.is_zero for load in robot.questions.loads)


def _without_moments(robot: Robot, value: InputValue) -> Matrix:
    """Σ J_vᵀ F."""
    parts = []
    for load in robot.questions.loads:
        frames = tuple(value(name) for name in kinematics.frame_names(load.link))
        linear, _ = jacobians(robot, load, frames)
        force, _ = wrench(load, frames[load.link])
        parts.append(linear.T @ force)
    return _at(robot).matrix(total(robot, tuple(parts)))


def _at(robot: Robot) -> AtState:
    return AtState(robot.ring, robot.questions.state.by_symbol)


# -- inertia and energies --------------------------------------------------------------------------


def _body_inertia(robot: Robot, body: Body, value: InputValue) -> Iterator[Variant]:
    if body.inertia is None:
        return
    right = value(f"I_body{body.name}")
    twice = slip("parallel_axis_twice", part=body.name)
    if body.about_point is None:
        yield from _about_joint(robot, body, right)
        return
    yield body.inertia, slip("parallel_axis_missing", part=body.name)
    yield right + right - body.inertia, twice
    yield body.inertia + body.inertia - right, twice


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
    in_own_frame = value(f"I_body{body.name}"), slip("spin_frame", part=body.name)
    for tensor, told in chain((in_own_frame,), _base_inertia(robot, body, value)):
        yield link_frame.rotational_energy(value(f"w{body.name}"), tensor), told


def _linear(robot: Robot, body: Body, value: InputValue) -> Iterator[Variant]:
    for J, told in _linear_jacobian(robot, body, value):
        yield link_frame.linear_energy(body.mass, link_frame.velocity(robot, J)), told


def _spring_part(robot: Robot, value: InputValue) -> Expr:
    part: Expr = value("Ps") if robot.actions.stored else robot.ring.zero
    return part


def _left_out(robot: Robot) -> Iterator[tuple[Expr, Diagnosis]]:
    """The energy of all springs, and of each of several."""
    stored = [act.energy for act in robot.actions.stored]
    if stored:
        yield sum(stored, start=robot.ring.zero), slip("springs_missing", part="the springs")
    if len(stored) > 1:
        yield from ((energy, slip("springs_missing", part="a spring")) for energy in stored)


def _total_potential(robot: Robot, of: None, value: InputValue) -> Iterator[Variant]:
    right, springs = value("P"), _spring_part(robot, value)
    yield springs + springs - right, slip("gravity_sign")
    for body in robot.bodies:
        yield right - value(f"P{body.name}"), slip("body_missing", part=body.name, other="P")
    yield from ((right - part, told) for part, told in _left_out(robot))
    if robot.actions.stored:
        yield right - springs - springs, slip("spring_sign")


def _potential(robot: Robot, body: Body, value: InputValue) -> Iterator[Variant]:
    right = link_frame.potential_energy(robot, body.mass, value(f"rc{body.name}"))
    yield -right, slip("gravity_sign")
    for center, told in _center(robot, body, value):
        yield link_frame.potential_energy(robot, body.mass, center), told


def _kinetic(robot: Robot, body: Body, value: InputValue) -> Iterator[Variant]:
    yield value(f"Kv{body.name}"), slip("rotation_missing")
    yield value(f"Kw{body.name}"), slip("translation_missing")


def _total_kinetic(robot: Robot, of: None, value: InputValue) -> Iterator[Variant]:
    rotors = value("Km") if robot.actions.rotors else robot.ring.zero
    if bodies := robot.bodies:
        every = link_frame.total(robot.ring, (*(value(f"K{b.name}") for b in bodies), rotors))
        for b in bodies if len(bodies) > 1 else ():
            yield every - value(f"K{b.name}"), slip("body_missing", part=b.name, other="K")
        linear = link_frame.total(robot.ring, (*(value(f"Kv{b.name}") for b in bodies), rotors))
        yield linear, slip("rotation_missing")
    if robot.actions.rotors:
        yield value("K") - rotors, slip("rotors_missing")


# -- Lagrange --------------------------------------------------------------------------------------


def _lagrangian(robot: Robot, of: None, value: InputValue) -> Iterator[Variant]:
    K, P, springs = value("K"), value("P"), _spring_part(robot, value)
    yield K + P, slip("lagrangian_sum")
    yield K - springs, slip("gravity_missing")
    yield from ((K - P + part, told) for part, told in _left_out(robot))


def _rate(robot: Robot, q: Coordinate, value: InputValue) -> Iterator[Variant]:
    """d/dt ∂L/∂q̇ with one coordinate held constant, all of them, or inner derivatives left out."""
    ring, p = robot.ring, value(f"dLdqd{q.index}")
    moving = {
        q.name: partial for k, q in enumerate(robot.coordinates) if not (partial := ring.diff(p, k)).is_zero
    }
    if not moving:
        return
    right = ring.time_derivative(p)
    parts = {name: partial * ring.symbol(name, 1) for name, partial in moving.items()}
    accelerated = right - _sum(ring.zero, parts.values())
    yield accelerated, slip("product_rule", part=", ".join(map(_written, moving)))
    for name, part in parts.items():
        yield right - part, slip("product_rule", part=_written(name))
        yield right - part + moving[name], slip("chain_rule", part=_written(name, 1))
    yield accelerated + _sum(ring.zero, moving.values()), slip("chain_rule", part="q̇")


def _written(name: str, dots: int = 0) -> str:
    return to_unicode(Symbol(name, dots), PLAIN)


def _sum(start: Expr, terms: Iterable[Expr]) -> Expr:
    for term in terms:
        start = start + term
    return start


def _force(robot: Robot, q: Coordinate, value: InputValue) -> Iterator[Variant]:
    """A force without ∂L/∂q or with its wrong sign; the same of friction; without springs."""
    ring, rate, slope = robot.ring, value(f"ddt{q.index}"), value(f"dLdq{q.index}")
    friction = value("friction")[q.index - 1, 0] if robot.actions.resisting else ring.zero
    if not slope.is_zero:
        yield rate + slope + friction, slip("slope_sign")
        yield rate + friction, slip("slope_missing")
    if not friction.is_zero:
        yield rate - slope, slip("friction_missing")
        yield rate - slope - friction, slip("friction_sign")
    for part, told in _left_out(robot):
        if not (held := ring.diff(part, q.index - 1)).is_zero:
            yield rate - slope + friction - held, told


# -- the vectorized form ---------------------------------------------------------------------------


def _rows_of(name: str, robot: Robot, of: None, value: InputValue) -> Iterator[Variant]:
    """Two rows exchanged."""
    right: Matrix = value(name)
    rows = list(right.rows)
    for i in range(len(rows)):
        for j in range(i + 1, len(rows)):
            if rows[i] != rows[j]:
                swapped = list(rows)
                swapped[i], swapped[j] = rows[j], rows[i]
                told = slip("rows_swapped", part=str(i + 1), other=str(j + 1))
                yield Matrix(right.ring, tuple(swapped)), told


def _gravity(robot: Robot, of: None, value: InputValue) -> Iterator[Variant]:
    right, springs = value("g"), euler_lagrange.gravity_vector(robot, _spring_part(robot, value))
    yield springs + springs - right, slip("gravity_sign")
    yield from _rows_of("g", robot, of, value)
    for part, told in _left_out(robot):
        yield right - euler_lagrange.gravity_vector(robot, part), told


def _coriolis(robot: Robot, of: None, value: InputValue) -> Iterator[Variant]:
    symbols = euler_lagrange.christoffel_symbols(robot, value("D"))
    ring, n, velocities = robot.ring, range(robot.n), link_frame.velocities(robot)
    plain = Matrix.of(
        ring, ([_sum(ring.zero, (symbols[min(i, j), max(i, j), k] for i in n)) for j in n] for k in n)
    )
    yield plain @ velocities, slip("christoffel_without_rates")
    right = euler_lagrange.coriolis_matrix(robot, symbols) @ velocities
    yield right + right, slip("christoffel_half")
    yield from _rows_of("Cqd", robot, of, lambda name: right)


# -- springs, rotors, friction ---------------------------------------------------------------------


def _mistaken(robot: Robot, acts: Sequence[Act], right: Sequence[Any]) -> Iterator[Variant]:
    """The sum of energies or forces in which some acts are got wrong in the same way; `right` are theirs."""
    mistaken = [dict(act.mistaken(robot)) for act in acts]
    for code in dict.fromkeys(chain(*mistaken)):
        first, *others = (wrong.get(code, own) for wrong, own in zip(mistaken, right, strict=True))
        yield sum(others, start=first), slip(code)


def _springs(robot: Robot, of: None, value: InputValue) -> Iterator[Variant]:
    yield -value("Ps"), slip("spring_sign")
    stored = robot.actions.stored
    yield from _mistaken(robot, stored, [act.energy for act in stored])


def _rotors(robot: Robot, of: None, value: InputValue) -> Iterator[Variant]:
    from dynsolve.derivation.actions import rotor_energy

    motors, one = robot.actions.rotors, robot.ring.one
    last = max(motor.carrier for motor in motors)
    frames = tuple(value(name) for name in kinematics.frame_names(last)) if last else ()

    def energy(**changes: Any) -> Expr:
        changed = tuple(replace(motor, **changes) for motor in motors)
        return rotor_energy(replace(robot, actions=Actions(changed)), *frames)

    if last:
        yield energy(carrier=0), slip("carried_spin")
    if any(motor.ratio != one for motor in motors):
        yield energy(ratio=one), slip("gear_missing")
        single = energy()  # with k_r in place of k_r² beside the square of the rate
        for motor in motors:
            rate = robot.ring.symbol(robot.ring.names[motor.turns], 1)
            square = motor.inertia * rate * rate * Fraction(1, 2)
            single = single + square * motor.ratio - square * motor.ratio * motor.ratio
        yield single, slip("gear_square")


def _friction(robot: Robot, of: None, value: InputValue) -> Iterator[Variant]:
    yield -value("friction"), slip("friction_sign")
    resisting = robot.actions.resisting
    yield from _mistaken(robot, resisting, [act.force(robot) for act in resisting])


_OTHERWISE: dict[Family, Variants] = {
    families.A: _dh,
    families.H: _frame,
    families.RC: _center,
    families.JV: _along_last_axes,
    families.JW: _end_jacobian,
    families.JV_BODY: _linear_jacobian,
    families.JW_BODY: _angular_jacobian,
    families.I_BODY: _body_inertia,
    families.I: _base_inertia,
    families.P_BODY: _potential,
    families.P: _total_potential,
    families.KV: _linear,
    families.KW: _rotational,
    families.K_BODY: _kinetic,
    families.K: _total_kinetic,
    families.L: _lagrangian,
    families.DDT: _rate,
    families.FORCE: _force,
    families.TAU: partial(_rows_of, "tau"),
    families.D: partial(_rows_of, "D"),
    families.CQD: _coriolis,
    families.G: _gravity,
    action_families.PS: _springs,
    action_families.KM: _rotors,
    action_families.FRICTION: _friction,
    of_task.JV_POINT: partial(_along_other_axes, "Jv"),
    of_task.JW_POINT: partial(_along_other_axes, "Jw"),
    of_task.V_POINT: partial(_along_other_axes, "v"),
    rates.QD: _joint_rates,
    statics.Q: _outer_forces,
    statics.TAU_STATIC: _holding,
}
"""How the steps to quantities go wrong, by their families."""
