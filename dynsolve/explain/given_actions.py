"""What is given of springs, dampers, friction, rotors and passive coordinates, in words."""

from __future__ import annotations

from collections.abc import Iterator

from dynsolve.document import Prose
from dynsolve.explain.forms import Forms
from dynsolve.explain.writing import listed, measured
from dynsolve.notation.tree import Letter, Number, Symbol, equation
from dynsolve.robot.actions import JointFriction, Motor, Spring
from dynsolve.robot.shapes import AXES


def of_actions(forms: Forms) -> Iterator[Prose]:
    """A sentence for each thing that acts beside gravity."""
    actions = forms.robot.actions
    yield from (_spring(forms, spring) for spring in actions.springs)
    for damper in actions.dampers:
        yield ("A damper of coefficient ", forms.of(damper.damping), " acts along ", forms.of(damper.of), ".")
    yield from (_friction(forms, friction) for friction in actions.friction)
    yield from (_motor(forms, motor) for motor in actions.motors)
    passive = [_coordinate(forms, k) for k in actions.passive]
    if passive:
        yield ("No motor drives ", *listed(passive), ".")


def _coordinate(forms: Forms, k: int) -> Symbol:
    return Symbol(forms.robot.coordinates[k].name)


def _spring(forms: Forms, spring: Spring) -> Prose:
    """A spring of stiffness k acts along q₁ - q₂ and is at rest where this is 0."""
    if spring.law is None:
        return ("A spring has the potential energy ", forms.of(spring.energy), ".")
    stiffness, along = (forms.of(value) for value in (spring.law.stiffness, spring.law.of))
    at_rest = equation(along, forms.of(spring.law.rest))
    return ("A spring of stiffness ", stiffness, " is at rest at ", at_rest, ".")


def _friction(forms: Forms, friction: JointFriction) -> Prose:
    """On q₁ acts viscous friction of coefficient f_v and Coulomb friction of coefficient f_c."""
    kinds = (("viscous", friction.viscous), ("Coulomb", friction.coulomb))
    there: list[Prose] = [
        (f"{kind} friction of coefficient ", forms.of(value)) for kind, value in kinds if not value.is_zero
    ]
    what = there[0] if len(there) == 1 else (*there[0], " and ", *there[1])
    return ("On ", _coordinate(forms, friction.coordinate), " acts ", *what, ".")


def _motor(forms: Forms, motor: Motor) -> Prose:
    """The rotor that turns q₂ has the moment of inertia I_m2 and the gear ratio k_r2; link 1 carries it."""
    told: Prose = ("The rotor that drives ", _coordinate(forms, motor.turns), " has the moment of inertia ")
    told += (measured(forms.of(motor.inertia), "kg m^2"),)
    if motor.ratio != forms.robot.ring.one:
        told += (" and the gear ratio ", forms.of(motor.ratio))
    if motor.carrier:
        axis = Letter(AXES[motor.axis], Number(motor.carrier), style="bold")
        told += ("; it spins about ", axis, f" and is carried by link {motor.carrier}")
    return (*told, ".")
