"""The recursions said once for all links, of arms of which nobody reads them link by link."""

from __future__ import annotations

from collections.abc import Iterator

from dynsolve.explain.context import Context
from dynsolve.explain.recursions import formulas
from dynsolve.explain.recursions.inwards import is_heavy
from dynsolve.explain.recursions.links import source_of
from dynsolve.explain.recursions.names import BodyNames, LinkNames
from dynsolve.explain.step import Step
from dynsolve.explain.writing import sum_of
from dynsolve.notation.tree import Letter, Node, Symbol, equation
from dynsolve.quantities import letters
from dynsolve.quantities.stages import Stage
from dynsolve.robot.model import JointType

STAGE = Stage.NEWTON_EULER

_I = Symbol("i")


def general_steps(context: Context) -> Iterator[Step]:
    """Outwards for each kind of joint, then inwards, link i standing for all."""
    for kind, name in ((JointType.REVOLUTE, "revolute"), (JointType.PRISMATIC, "prismatic")):
        if any(joint.type is kind for joint in context.robot.joints):
            yield _outwards(context, kind, name)
    yield _inwards(context)


def _outwards(context: Context, kind: JointType, name: str) -> Step:
    link = LinkNames.general(context.standard)
    variable = "theta" if kind is JointType.REVOLUTE else "d"
    rates = Letter(variable, _I, dots=1), Letter(variable, _I, dots=2)
    spin, slide = (rates, None) if kind is JointType.REVOLUTE else (None, rates)
    body = BodyNames(_I, link)
    found: list[tuple[Node, list[Node]]] = [
        (link.vector("omega"), formulas.angular_velocity(link, spin and spin[0])),
        (link.vector("omega", 1), formulas.angular_acceleration(link, spin)),
        (link.vector("a"), formulas.acceleration(link, link.lever, slide)),
        (body.acceleration, formulas.center_acceleration(body, slide)),
    ]
    return Step(
        id=f"outwards_{name}",
        stage=STAGE,
        title=f"Outwards over a {name} joint",
        why=("From the first link to the last, the motion of each follows from that of the one before.",),
        source=source_of(context),
        result=tuple(equation(left, sum_of(terms)) for left, terms in found),
        listed=True,
        uses=("links",),
    )


def _inwards(context: Context) -> Step:
    link = LinkNames.general(context.standard)
    after = LinkNames(letters.AFTER, _I, context.standard)
    body = BodyNames(_I, link)
    inertial = formulas.inertial_force(body, Letter("m", _I), is_heavy(context))
    force = [formulas.passed_on(after, "f"), inertial]
    moment = [*formulas.moment_of_next(link, after), *formulas.moment_of_body(body, inertial, is_point=False)]
    return Step(
        id="inwards",
        stage=STAGE,
        title="Inwards: the forces and moments in the joints",
        why=(
            "From the last link, which holds nothing, to the first: Newton's law and Euler's for each link.",
        ),
        source=source_of(context),
        result=tuple(
            equation(link.vector(name), sum_of(terms)) for name, terms in (("f", force), ("n", moment))
        ),
        listed=True,
        uses=("links",),
    )
