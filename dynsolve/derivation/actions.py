"""What acts beside gravity: the energy of springs, the kinetic energy of rotors, friction.

A spring has the potential energy ½ k (x - rest)²; so P = Σ P_i + P_s, and g = ∂P/∂q has its force.
A rotor that spins with k_r q̇ about an axis z, on a link with the angular velocity ω, turns with
k_r q̇ + zᵀω, and has the kinetic energy ½ I (k_r q̇ + zᵀω)² beside that of the mass it adds to its
link (Siciliano, Sciavicco, Villani, Oriolo, Robotics, section 7.1.1).  Friction has no
potential: it is the generalized force F_v q̇ + F_s sgn(q̇) on the side of D q̈ + C q̇ + g
(section 7.3, equation 7.42), and dampers are the gradient of Rayleigh's dissipation ½ b ẋ².

What acts beside gravity, as rules; the formulas are in `actions`.
"""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction
from functools import partial

from dynsolve.algebra.expr import Expr
from dynsolve.algebra.matrix import Matrix, cross
from dynsolve.derivation import kinematics
from dynsolve.derivation.graph import Rule
from dynsolve.derivation.kinematics import frame_names
from dynsolve.derivation.link_frame import LinkJacobian, quadratic_energy
from dynsolve.notation.tree import Function, Symbol
from dynsolve.robot.actions import Damper, JointFriction, Motor
from dynsolve.robot.model import Robot

# What acts beside gravity: the energy of springs, the kinetic energy of rotors, friction

HALF = Fraction(1, 2)


def spring_energy(robot: Robot) -> Expr:
    """P_s = Σ ½ k (x - rest)², or the sum of the energies that are given."""
    return sum((spring.energy for spring in robot.actions.springs), start=robot.ring.zero)


# -- rotors ----------------------------------------------------------------------------------------


def spin(robot: Robot, motor: Motor) -> Matrix:
    """The rates with which a rotor turns on its carrier, 1×n: k_r in the column of its coordinate."""
    row = [robot.ring.zero] * robot.n
    row[motor.turns] = motor.ratio
    return Matrix.of(robot.ring, [row])


def rotor_turn(robot: Robot, motor: Motor, frames: tuple[Matrix, ...]) -> Matrix:
    """k_r e_kᵀ + zᵀ J_ω, 1×n: what the rates turn a rotor with, from H_0 up to the frame of its carrier."""
    if not motor.carrier:
        return spin(robot, motor)
    axis = kinematics.rotation(frames[motor.carrier]).column_at(motor.axis)
    return spin(robot, motor) + axis.T @ kinematics.angular_jacobian(robot, frames, motor.carrier)


def rotor_energy(robot: Robot, *frames: Matrix) -> Expr:
    """K_m = Σ ½ I (k_r q̇ + zᵀω)²"""
    rates = Matrix.column(robot.ring, [robot.ring.symbol(name, 1) for name in robot.ring.names])
    total = robot.ring.zero
    for motor in robot.actions.motors:
        turned = (rotor_turn(robot, motor, frames) @ rates)[0, 0]
        total = total + motor.inertia * turned * turned * HALF
    return total


def rotor_part(robot: Robot, jacobians: tuple[LinkJacobian, ...] = ()) -> Matrix:
    """What the rotors add to D, n×n: Σ I (k_r e_k + J_ωᵀ z)(k_r e_k + J_ωᵀ z)ᵀ, in each carrier's frame."""
    total = Matrix.zero(robot.ring, robot.n, robot.n)
    for motor in robot.actions.motors:
        row = spin(robot, motor)
        if motor.carrier:
            axis = Matrix.identity(robot.ring, 3).column_at(motor.axis)
            row = row + axis.T @ jacobians[motor.carrier - 1].angular
        total = total + (row.T @ row).scale(motor.inertia)
    return total


def rotor_drive(robot: Robot, motor: Motor, dw: Matrix | None) -> Expr:
    """I (k_r q̈ + z·ω̇), the moment about its axis that turns a rotor; ω̇ along the carrier's own axes."""
    rate = robot.ring.symbol(robot.ring.names[motor.turns], 2) * motor.ratio
    return motor.inertia * (rate if dw is None else rate + dw[motor.axis, 0])


def rotor_moment(robot: Robot, motor: Motor, w: Matrix, dw: Matrix) -> Matrix:
    """What a rotor takes from its carrier, 3×1 along the carrier's own axes, by ḣ of h = I (k_r q̇ + z·ω) z.

    I (k_r q̈ + z·ω̇) z + I (k_r q̇ + z·ω) ω × z.
    """
    axis = Matrix.identity(robot.ring, 3).column_at(motor.axis)
    rate = robot.ring.symbol(robot.ring.names[motor.turns], 1) * motor.ratio
    spun = motor.inertia * (rate + w[motor.axis, 0])
    return axis.scale(rotor_drive(robot, motor, dw)) + cross(w, axis).scale(spun)


# -- friction --------------------------------------------------------------------------------------


def joint_friction(robot: Robot, one: JointFriction) -> Expr:
    """f_v q̇ + f_c sgn(q̇)"""
    ring = robot.ring
    rate = Symbol(ring.names[one.coordinate], 1)
    force = one.viscous * ring.symbol(rate.name, 1)
    return force if one.coulomb.is_zero else force + one.coulomb * ring.function(Function("sgn", rate))


def damper_force(robot: Robot, damper: Damper) -> Matrix:
    """b ẋ ∂x/∂q, n×1: the gradient of ½ b ẋ² with respect to the rates."""
    rate = robot.ring.time_derivative(damper.of)
    slopes = [robot.ring.diff(damper.of, k) for k in range(robot.n)]
    return Matrix.column(robot.ring, [damper.damping * rate * slope for slope in slopes])


def friction(robot: Robot) -> Matrix:
    """The dissipative terms, n×1: friction of the joints and dampers; they stand beside g."""
    entries = [robot.ring.zero] * robot.n
    for one in robot.actions.friction:
        entries[one.coordinate] = entries[one.coordinate] + joint_friction(robot, one)
    forces = (damper_force(robot, damper) for damper in robot.actions.dampers)
    return sum(forces, start=Matrix.column(robot.ring, entries))


# What acts beside gravity, as rules; the formulas are in `actions`


def energy_rules(robot: Robot) -> Iterator[Rule]:
    """The textbook's energies of springs and rotors."""
    kinds = robot.actions.kinds
    if "springs" in kinds:
        yield Rule("Ps", (), partial(spring_energy, robot))
    if "motors" in kinds:
        last = max(motor.carrier for motor in robot.actions.motors)
        inputs = frame_names(last) if last else ()
        yield Rule("Km", inputs, partial(rotor_energy, robot))


def friction_rule(robot: Robot) -> Rule:
    """The dissipative terms."""
    return Rule("friction", (), partial(friction, robot))


def rotor_rules(robot: Robot) -> Iterator[Rule]:
    """K_m from the rotors' part of D, in each carrier's own frame: the fast way, as for the bodies."""
    carriers = ("link_jacobians",) if robot.has_table else ()
    yield Rule("Dm", carriers, partial(rotor_part, robot))
    yield Rule("Km", ("Dm",), partial(quadratic_energy, robot))
