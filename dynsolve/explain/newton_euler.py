"""Steps of the Newton-Euler recursions: outwards the motions, link by link, inwards the forces.

Where they are the way to the forces, these follow as components of what the joints hold; of robots of
more than three coordinates the recursions are then told once for all links.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from dynsolve.document import Prose
from dynsolve.explain.context import MOST_JOINTS, Context
from dynsolve.explain.recursions import (
    BodyNames,
    LinkNames,
    acceleration,
    angular_acceleration,
    angular_velocity,
    center_acceleration,
    inertial_force,
    inwards,
    is_heavy,
    links_step,
    moment_of_body,
    moment_of_next,
    outwards,
    passed_on,
    source_of,
)
from dynsolve.explain.step import Detail, Group, Step
from dynsolve.explain.terms import driving_row
from dynsolve.explain.writing import listed, spong, sum_of, turns
from dynsolve.notation.tree import Letter, Negative, Node, Product, Symbol, Transpose, equation, number
from dynsolve.quantities import letters
from dynsolve.quantities.stages import Stage
from dynsolve.robot.model import Coordinate, JointType
from dynsolve.robot.questions import Method

STAGE = Stage.NEWTON_EULER


def steps(context: Context) -> Iterator[Step]:
    """What is known of each link; outwards ω, ω̇ and the accelerations; inwards f, n and the forces τ."""
    robot = context.robot
    by_method = robot.questions.method is Method.NEWTON_EULER
    yield links_step(context)
    if by_method and robot.n > MOST_JOINTS:
        yield from general_steps(context)
    for joint in robot.joints:
        group = Group(f"outwards{joint.index}", f"Link {joint.index}, outwards")
        yield from (replace(step, group=group) for step in outwards(context, joint))
    for joint in reversed(robot.joints):
        group = Group(f"inwards{joint.index}", f"Link {joint.index}, inwards")
        yield from (replace(step, group=group) for step in inwards(context, joint))
    if by_method:
        yield from _acting_steps(context)
        for q in robot.coordinates:
            yield replace(_torque(context, q), group=Group("tau", "The forces and torques of the motors"))
        yield _lagrange(context)


def _torque(context: Context, q: Coordinate) -> Step:
    terms: list[Node] = []
    for joint, rate in context.robot.joints_of(q):
        held = letters.in_link("n" if joint.type is JointType.REVOLUTE else "f", joint.index)
        term: Node = Product((Transpose(held), LinkNames.of(context.robot, joint.index).axis))
        if abs(rate) != 1:
            term = Product((number(abs(rate)), term))
        terms.append(Negative(term) if rate < 0 else term)
    kind, what = ("torque", "moment") if turns(q) else ("force", "force")
    beside, added = _acting(context, q)
    return Step(
        id=f"tau{q.index}",
        stage=STAGE,
        title=f"Coordinate {q.index}: the {kind}",
        why=(
            f"The motor gives the component of the {what} along the axis of the joint; "
            "the bearings hold the others.",
            *beside,
        ),
        said="" if beside else f"the {kind} of a motor",
        formula=equation(driving_row(context, q), sum_of([*terms, *added])),
        source=source_of(context),
        result=(equation(driving_row(context, q), context.form(f"tau{q.index}")),),
        detail=Detail.BRIEF,
    )


def _acting_steps(context: Context) -> Iterator[Step]:
    """The steps of springs and friction, which the forces are made of, too."""
    if context.robot.actions:
        from dynsolve.explain.actions import friction_steps, spring_steps

        found = (*spring_steps(context), *friction_steps(context))
        yield from (replace(step, stage=STAGE) for step in found)


def _acting(context: Context, q: Coordinate) -> tuple[Prose, list[Node]]:
    """What is said of rotors, springs and friction of a coordinate, and their terms of its force."""
    if not context.robot.actions:
        return (), []
    from dynsolve.explain.actions import in_recursions

    return in_recursions(context, q)


def _lagrange(context: Context) -> Step:
    forces = listed([letters.force(q) for q in context.robot.coordinates])
    why: Prose = ("The Euler-Lagrange equations of the same robot give the same ", *forces, ".")
    return Step(
        id="lagrange",
        stage=STAGE,
        title="The same by the Lagrangian",
        why=why,
        outcome=why,
        detail=Detail.FULL,
        source=spong("7.6"),
        uses=tuple(f"tau{q.index}" for q in context.robot.coordinates),
        is_task=False,
    )


# -- the recursions said once for all links, of arms of which nobody reads them link by link -------

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
        (link.vector("omega"), angular_velocity(link, spin and spin[0])),
        (link.vector("omega", 1), angular_acceleration(link, spin)),
        (link.vector("a"), acceleration(link, link.lever, slide)),
        (body.acceleration, center_acceleration(body, slide)),
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
    inertial = inertial_force(body, Letter("m", _I), is_heavy(context))
    force = [passed_on(after, "f"), inertial]
    moment = [*moment_of_next(link, after), *moment_of_body(body, inertial, is_point=False)]
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
