"""What is told of friction of the joints."""

from __future__ import annotations

from collections.abc import Sequence

from dynsolve.acts.friction.act import JointFriction
from dynsolve.document import Prose
from dynsolve.document.sentences import say
from dynsolve.explain.actions import halved_square
from dynsolve.explain.context import Context
from dynsolve.explain.forms import Forms
from dynsolve.explain.writing import listed, measured
from dynsolve.notation.template import formula
from dynsolve.notation.tree import Node, Symbol

LETTERS = "* f_ck | coefficient of Coulomb friction of coordinate k"


def given(forms: Forms, friction: JointFriction) -> Prose:
    """On q₁ acts viscous friction of coefficient f_v and Coulomb friction of coefficient f_c."""
    there, resisting = _coefficients(forms, friction), forms.robot.actions.resisting
    alike = [
        one for one in resisting if isinstance(one, JointFriction) and _coefficients(forms, one) == there
    ]
    if friction is not alike[0]:
        return ()  # told with the first
    names = [Symbol(forms.robot.coordinates[one.coordinate].name) for one in alike]
    return ("On ", *listed(names), " acts ", *listed(there), ".")


def _coefficients(forms: Forms, friction: JointFriction) -> list[Prose]:
    return [
        (f"{kind} friction of coefficient ", measured(forms.of(one.value), one.unit))
        for kind, one in zip(("viscous", "Coulomb"), friction.parameters(forms.robot), strict=True)
        if not one.value.is_zero
    ]


def beside(context: Context, friction: Sequence[JointFriction]) -> tuple[Prose, Node] | None:
    """What Coulomb friction is, and its term of the formula; None where there is none."""
    sliding = [one.coordinate for one in friction if not one.coulomb.is_zero]
    if not sliding:
        return None
    told = say(
        " Coulomb friction, of {which}, has the size of its coefficient, $f_ck$, and the sign of the "
        "rate; at rest sgn is 0.",
        which=listed([Symbol(context.robot.ring.names[k]) for k in sliding]),
    )
    return told, formula("f_ck sgn q̇_k")


def dissipation(context: Context, friction: JointFriction) -> Node | None:
    """½ f_v q̇²"""
    if friction.viscous.is_zero:
        return None
    rate = Symbol(context.robot.ring.names[friction.coordinate], 1)
    return halved_square(context, friction.viscous, rate)
