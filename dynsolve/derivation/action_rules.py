"""What acts beside gravity, as rules; the formulas are in `actions`."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial

from dynsolve.derivation import actions
from dynsolve.derivation.graph import Rule
from dynsolve.derivation.kinematics import frame_names
from dynsolve.derivation.link_frame import quadratic_energy
from dynsolve.robot.model import Robot


def energy_rules(robot: Robot) -> Iterator[Rule]:
    """The textbook's energies of springs and rotors."""
    kinds = robot.actions.kinds
    if "springs" in kinds:
        yield Rule("Ps", (), partial(actions.spring_energy, robot))
    if "motors" in kinds:
        last = max(motor.carrier for motor in robot.actions.motors)
        inputs = frame_names(last) if last else ()
        yield Rule("Km", inputs, partial(actions.rotor_energy, robot))


def friction_rule(robot: Robot) -> Rule:
    """The dissipative terms."""
    return Rule("friction", (), partial(actions.friction, robot))


def rotor_rules(robot: Robot) -> Iterator[Rule]:
    """K_m from the rotors' part of D, in each carrier's own frame: the fast way, as for the bodies."""
    carriers = ("link_jacobians",) if robot.has_table else ()
    yield Rule("Dm", carriers, partial(actions.rotor_part, robot))
    yield Rule("Km", ("Dm",), partial(quadratic_energy, robot))
