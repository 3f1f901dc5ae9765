"""What is told of motors; their rotors are bodies that spin, whose energy is told in `explain.actions`."""

from __future__ import annotations

from dynsolve.acts.motors.act import Motor
from dynsolve.document import Prose
from dynsolve.explain.actions import rotor_named
from dynsolve.explain.forms import Forms
from dynsolve.explain.writing import measured
from dynsolve.notation.tree import Number
from dynsolve.quantities import letters
from dynsolve.robot.shapes import AXES


def given(forms: Forms, motor: Motor) -> Prose:
    """The rotor that turns q₂ has the moment of inertia I_m2 and the gear ratio k_r2; link 1 carries it."""
    told = rotor_named(forms.robot, motor)
    told += (" has the moment of inertia ", measured(forms.of(motor.inertia), "kg m^2"))
    if motor.ratio != forms.robot.ring.one:
        told += (" and the gear ratio ", forms.of(motor.ratio))
    if motor.carrier:
        axis = letters.bold(AXES[motor.axis], Number(motor.carrier))
        told += ("; it spins about ", axis, f" and is carried by link {motor.carrier}")
    return (*told, ".")
