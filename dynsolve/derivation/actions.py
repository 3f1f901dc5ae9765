"""What acts beside gravity: the energy that is stored, the kinetic energy of rotors, friction.

What stores energy has a part in P = Σ P_i + P_s, and g = ∂P/∂q has its force.
A rotor that spins with k_r q̇ about an axis z, on a link with the angular velocity ω, turns with
k_r q̇ + zᵀω, and has the kinetic energy ½ I (k_r q̇ + zᵀω)² beside that of the mass it adds to its
link (Siciliano, Sciavicco, Villani, Oriolo, Robotics, section 7.1.1).  Friction has no
potential: it is a generalized force on the side of D q̈ + C q̇ + g (section 7.3, equation 7.42).
What each of them is, is said by its record (`robot.actions`).

What acts beside gravity, as rules.
"""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction
from functools import partial

from dynsolve.algebra.matrix import Matrix, cross
from dynsolve.algebra.ring import Expr
from dynsolve.derivation import kinematics
from dynsolve.derivation.graph import Rule
from dynsolve.derivation.kinematics import frame_names
from dynsolve.derivation.link_frame import LinkJacobian, quadratic_energy
from dynsolve.robot.model import Robot, Rotor

HALF = Fraction(1, 2)


def stored_energy(robot: Robot) -> Expr:
    """P_s, the sum of what is stored."""
    return sum(stored_apart(robot), start=robot.ring.zero)


def stored_apart(robot: Robot) -> list[Expr]:
    """What is stored in each deflection: added up, two squares would make others that are of no spring."""
    energies = dict.fromkeys((act.differences for act in robot.actions.stored), robot.ring.zero)
    for act in robot.actions.stored:
        energies[act.differences] += act.energy
    return list(energies.values())


def friction(robot: Robot) -> Matrix:
    """The sum of what resists, n×1; it stands beside g."""
    forces = (act.force(robot) for act in robot.actions.resisting)
    return sum(forces, start=Matrix.zero(robot.ring, robot.n, 1))


# -- rotors ----------------------------------------------------------------------------------------


def spin(robot: Robot, rotor: Rotor) -> Matrix:
    """The rates with which a rotor turns on its carrier, 1×n: k_r in the column of its coordinate."""
    row = [robot.ring.zero] * robot.n
    row[rotor.turns] = rotor.ratio
    return Matrix.of(robot.ring, [row])


def rotor_turn(robot: Robot, rotor: Rotor, frames: tuple[Matrix, ...]) -> Matrix:
    """k_r e_kᵀ + zᵀ J_ω, 1×n: what the rates turn a rotor with, from H_0 up to the frame of its carrier."""
    if not rotor.carrier:
        return spin(robot, rotor)
    axis = kinematics.rotation(frames[rotor.carrier]).column_at(rotor.axis)
    return spin(robot, rotor) + axis.T @ kinematics.angular_jacobian(robot, frames, rotor.carrier)


def rotor_energy(robot: Robot, *frames: Matrix) -> Expr:
    """K_m = Σ ½ I (k_r q̇ + zᵀω)²"""
    rates = Matrix.column(robot.ring, [robot.ring.symbol(name, 1) for name in robot.ring.names])
    total = robot.ring.zero
    for rotor in robot.actions.rotors:
        turned = (rotor_turn(robot, rotor, frames) @ rates)[0, 0]
        total = total + rotor.inertia * turned * turned * HALF
    return total


def rotor_part(robot: Robot, jacobians: tuple[LinkJacobian, ...] = ()) -> Matrix:
    """What the rotors add to D, n×n: Σ I (k_r e_k + J_ωᵀ z)(k_r e_k + J_ωᵀ z)ᵀ, in each carrier's frame."""
    total = Matrix.zero(robot.ring, robot.n, robot.n)
    for rotor in robot.actions.rotors:
        row = rotor_row(robot, rotor, jacobians)
        total = total + (row.T @ row).scale(rotor.inertia)
    return total


def rotor_row(robot: Robot, rotor: Rotor, jacobians: tuple[LinkJacobian, ...] = ()) -> Matrix:
    """k_r e_kᵀ + zᵀ J_ω, 1×n, along the carrier's own axes."""
    if not rotor.carrier:
        return spin(robot, rotor)
    axis = Matrix.identity(robot.ring, 3).column_at(rotor.axis)
    return spin(robot, rotor) + axis.T @ jacobians[rotor.carrier - 1].angular


def rotor_drive(robot: Robot, rotor: Rotor, dw: Matrix | None) -> Expr:
    """I (k_r q̈ + z·ω̇), the moment about its axis that turns a rotor; ω̇ along the carrier's own axes."""
    rate = robot.ring.symbol(robot.ring.names[rotor.turns], 2) * rotor.ratio
    return rotor.inertia * (rate if dw is None else rate + dw[rotor.axis, 0])


def rotor_moment(robot: Robot, rotor: Rotor, w: Matrix, dw: Matrix) -> Matrix:
    """What a rotor takes from its carrier, 3×1 along the carrier's own axes, by ḣ of h = I (k_r q̇ + z·ω) z.

    I (k_r q̈ + z·ω̇) z + I (k_r q̇ + z·ω) ω × z.
    """
    axis = Matrix.identity(robot.ring, 3).column_at(rotor.axis)
    rate = robot.ring.symbol(robot.ring.names[rotor.turns], 1) * rotor.ratio
    spun = rotor.inertia * (rate + w[rotor.axis, 0])
    return axis.scale(rotor_drive(robot, rotor, dw)) + cross(w, axis).scale(spun)


# -- as rules --------------------------------------------------------------------------------------


def energy_rules(robot: Robot) -> Iterator[Rule]:
    """The textbook's energies of what is stored and of rotors."""
    if robot.actions.stored:
        yield Rule("Ps", (), partial(stored_energy, robot))
    if rotors := robot.actions.rotors:
        last = max(rotor.carrier for rotor in rotors)
        inputs = frame_names(last) if last else ()
        yield Rule("Km", inputs, partial(rotor_energy, robot))


def friction_rule(robot: Robot) -> Rule:
    """What resists, as one vector."""
    return Rule("friction", (), partial(friction, robot))


def rotor_rules(robot: Robot) -> Iterator[Rule]:
    """K_m from the rotors' part of D, in each carrier's own frame: the fast way, as for the bodies."""
    carriers = ("link_jacobians",) if robot.has_table else ()
    yield Rule("Dm", carriers, partial(rotor_part, robot))
    yield Rule("Km", ("Dm",), partial(quadratic_energy, robot))
