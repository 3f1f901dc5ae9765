"""What is told of springs."""

from __future__ import annotations

from collections.abc import Sequence

from dynsolve.acts.springs.act import Spring
from dynsolve.algebra.angles import in_degrees
from dynsolve.document import Prose
from dynsolve.explain.actions import half_square
from dynsolve.explain.context import Context
from dynsolve.explain.forms import Forms
from dynsolve.explain.writing import measured
from dynsolve.notation.tree import Node, equation
from dynsolve.robot.model import Stored
from dynsolve.robot.typed_sums import along, deflection

HINT = "Half the stiffness times the square of the deflection of each spring from its rest."
PITFALL = "The energy of a spring has a ½, and the stretch is squared as a whole, with its rest."


def given(forms: Forms, spring: Stored) -> Prose:
    """A spring of stiffness k is at rest at q₁ = δ."""
    if not isinstance(spring, Spring):
        return ("A spring has the potential energy ", forms.of(spring.energy), ".")
    stiffness, rest, _ = ((forms.of(one.value), one.unit) for one in spring.parameters(forms.robot))
    at = in_degrees(rest[0])
    position = equation(along(spring.of, forms.of), measured(*rest) if at == rest[0] else at)
    return ("A spring of stiffness ", measured(*stiffness), " is at rest at ", position, ".")


def why(springs: Sequence[Stored]) -> str:
    """What a linear spring stores."""
    laws = [spring for spring in springs if isinstance(spring, Spring)]
    if not laws:
        return "The energies are given." if len(springs) > 1 else "The energy of the spring is given."
    told = "A linear spring stores half its stiffness times the square of its deflection from rest."
    return told + (" The other energies are given." if len(laws) < len(springs) else "")


def term(context: Context, spring: Stored) -> Node | None:
    """½ k (x - rest)²"""
    if not isinstance(spring, Spring):
        return None
    return half_square(context.show(spring.stiffness), deflection(*spring.differences[0], context.show))
