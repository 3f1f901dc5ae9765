"""What acts beside gravity, as rules; the formulas are in `actions`."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial

from dynsolve.derivation import actions
from dynsolve.derivation.graph import Rule
from dynsolve.derivation.kinematics import frame_names
from dynsolve.derivation.link_frame import quadratic_energy
from dynsolve.robot.model import Robot


def action_rules(robot: Robot) -> Iterator[Rule]:
    """The rules of the textbook: the energies of springs and rotors, and friction."""
    kinds = robot.actions.kinds
    if "springs" in kinds:
        yield Rule("Ps", (), partial(actions.spring_energy, robot))
    if "motors" in kinds:
        last = max(motor.carrier for motor in robot.actions.motors)
        inputs = frame_names(last) if last else ()
        yield Rule("Km", inputs, partial(actions.rotor_energy, robot))
    if "friction" in kinds:
        yield Rule("friction", (), partial(actions.friction, robot))


def rotor_rules(robot: Robot) -> Iterator[Rule]:
    """K_m from the rotors' part of D, in each carrier's own frame: the fast way, as for the bodies."""
    carriers = ("link_jacobians",) if robot.has_table else ()
    yield Rule("Dm", carriers, partial(actions.rotor_part, robot))
    yield Rule("Km", ("Dm",), partial(quadratic_energy, robot))
