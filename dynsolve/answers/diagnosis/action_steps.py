"""Slips in what acts beside gravity: springs, rotors, friction; as `steps` has them for the other steps."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from fractions import Fraction
from typing import Any

from msgspec.structs import replace

from dynsolve.algebra.expr import Expr
from dynsolve.algebra.matrix import Matrix
from dynsolve.answers.diagnosis.slips import slip
from dynsolve.answers.verdict import Diagnosis
from dynsolve.derivation import actions, euler_lagrange
from dynsolve.derivation.kinematics import frame_names
from dynsolve.quantities import action_families, families
from dynsolve.quantities.family import Family
from dynsolve.quantities.index import Quantity
from dynsolve.robot.actions import Actions, Motor
from dynsolve.robot.model import Robot

Variant = tuple[Any, Diagnosis]
InputValue = Callable[[str], Any]


def action_variants(robot: Robot, quantity: Quantity, value: InputValue) -> Iterator[Variant]:
    """The values that a step gives when something that acts is done wrongly, with the slip."""
    if quantity.family is families.FORCE:
        yield from _resisted(robot, quantity.index[0], value)
    elif quantity.family in _OF_ROBOT:
        yield from _OF_ROBOT[quantity.family](robot, value)


# -- springs ---------------------------------------------------------------------------------------


def _springs(robot: Robot, value: InputValue) -> Iterator[Variant]:
    right = value("Ps")
    yield right + right, slip("spring_half")
    yield -right, slip("spring_sign")
    relaxed = _spring_energy(robot, lambda stiffness, x, rest: stiffness * x * x)
    yield relaxed, slip("spring_rest")
    yield (
        _spring_energy(robot, lambda stiffness, x, rest: stiffness * (x * x - rest * rest)),
        slip("spring_square"),
    )
    yield (
        _spring_energy(robot, lambda stiffness, x, rest: stiffness * (x + rest) ** 2),
        slip("spring_rest_sign"),
    )


def _spring_energy(robot: Robot, twice: Callable[[Expr, Expr, Expr], Expr]) -> Expr:
    """The energy of the springs, that of linear ones by another law of twice the energy."""
    total = robot.ring.zero
    for spring in robot.actions.springs:
        law = spring.law
        energy = spring.energy if law is None else twice(law.stiffness, law.of, law.rest) / 2
        total = total + energy
    return total


def _without_springs(robot: Robot, value: InputValue) -> Iterator[Variant]:
    """g = ∂P/∂q without the forces of the springs."""
    if robot.actions.springs:
        yield value("g") - euler_lagrange.gravity_vector(robot, value("Ps")), slip("springs_missing")


def _lagrangian(robot: Robot, value: InputValue) -> Iterator[Variant]:
    if robot.actions.springs:
        yield value("K") - value("P") + value("Ps"), slip("springs_missing")


def _potential(robot: Robot, value: InputValue) -> Iterator[Variant]:
    if robot.actions.springs:
        springs = value("Ps")
        yield value("P") - springs, slip("springs_missing")
        yield value("P") - springs - springs, slip("spring_sign")


# -- rotors ----------------------------------------------------------------------------------------


def _rotors(robot: Robot, value: InputValue) -> Iterator[Variant]:
    motors = robot.actions.motors
    last = max(motor.carrier for motor in motors)
    frames = tuple(value(name) for name in frame_names(last)) if last else ()
    if last:
        grounded = tuple(replace(motor, carrier=0) for motor in motors)
        yield _rotor_energy(robot, grounded, frames), slip("carried_spin")
    one = robot.ring.one
    if any(motor.ratio != one for motor in motors):
        plain = tuple(replace(motor, ratio=one) for motor in motors)
        yield _rotor_energy(robot, plain, frames), slip("gear_missing")
        yield _with_single_ratios(robot, frames), slip("gear_square")


def _rotor_energy(robot: Robot, motors: tuple[Motor, ...], frames: tuple[Matrix, ...]) -> Expr:
    changed = replace(robot, actions=Actions(motors=motors))
    return actions.rotor_energy(changed, *frames)


def _with_single_ratios(robot: Robot, frames: tuple[Matrix, ...]) -> Expr:
    """K_m with k_r in place of k_r² beside the square of the rate."""
    found = actions.rotor_energy(robot, *frames)
    for motor in robot.actions.motors:
        rate = robot.ring.symbol(robot.ring.names[motor.turns], 1)
        square = motor.inertia * rate * rate * Fraction(1, 2)
        found = found + square * motor.ratio - square * motor.ratio * motor.ratio
    return found


def _kinetic(robot: Robot, value: InputValue) -> Iterator[Variant]:
    if robot.actions.motors:
        yield value("K") - value("Km"), slip("rotors_missing")


# -- friction --------------------------------------------------------------------------------------


def _friction(robot: Robot, value: InputValue) -> Iterator[Variant]:
    acting = robot.actions
    yield -value("friction"), slip("friction_sign")
    zero = robot.ring.zero
    if any(not one.coulomb.is_zero for one in acting.friction):
        smooth = tuple(replace(one, coulomb=zero) for one in acting.friction)
        yield (
            actions.friction(replace(robot, actions=replace(acting, friction=smooth))),
            slip("coulomb_missing"),
        )
    if acting.dampers:
        yield actions.friction(replace(robot, actions=replace(acting, dampers=()))), slip("dampers_missing")


def _resisted(robot: Robot, k: int, value: InputValue) -> Iterator[Variant]:
    """A force without friction, with friction of the wrong sign, without springs."""
    ring, driven = robot.ring, value(f"ddt{k}") - value(f"dLdq{k}")
    friction: Expr = value("friction")[k - 1, 0] if "friction" in robot.actions.kinds else ring.zero
    if not friction.is_zero:
        yield driven, slip("friction_missing")
        yield driven - friction, slip("friction_sign")
    if robot.actions.springs and not (held := ring.diff(value("Ps"), k - 1)).is_zero:
        yield driven + friction - held, slip("springs_missing")


_OF_ROBOT: dict[Family, Callable[[Robot, InputValue], Iterator[Variant]]] = {
    action_families.PS: _springs,
    action_families.KM: _rotors,
    action_families.FRICTION: _friction,
    families.P: _potential,
    families.K: _kinetic,
    families.L: _lagrangian,
    families.G: _without_springs,
}
