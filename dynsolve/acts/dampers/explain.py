"""What is told of dampers."""

from __future__ import annotations

from dynsolve.acts.dampers.act import Damper
from dynsolve.document import Prose
from dynsolve.explain.actions import halved_square
from dynsolve.explain.context import Context
from dynsolve.explain.forms import Forms
from dynsolve.explain.writing import measured
from dynsolve.notation.tree import Node


def given(forms: Forms, damper: Damper) -> Prose:
    """A damper of coefficient b acts against changes of q₂ - q₁."""
    b, _ = (measured(forms.of(one.value), one.unit) for one in damper.parameters(forms.robot))
    return ("A damper of coefficient ", b, " acts against changes of ", forms.of(damper.of), ".")


def dissipation(context: Context, damper: Damper) -> Node:
    """½ b ẋ²"""
    stretching = context.show(context.robot.ring.time_derivative(damper.of))
    return halved_square(context, damper.damping, stretching)
