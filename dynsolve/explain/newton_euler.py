"""Steps of the Newton-Euler recursions: outwards the motions, link by link, inwards the forces.

Where they are the way to the forces, these follow as components of what the joints hold; of robots of
more than three coordinates the recursions are then told once for all links.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from dynsolve.document import Prose
from dynsolve.explain.citations import spong
from dynsolve.explain.closing import driving_row
from dynsolve.explain.context import Context
from dynsolve.explain.recursions.general import general_steps
from dynsolve.explain.recursions.inwards import inwards
from dynsolve.explain.recursions.links import links_step, source_of
from dynsolve.explain.recursions.names import LinkNames
from dynsolve.explain.recursions.outwards import outwards
from dynsolve.explain.short_arms import MOST_JOINTS
from dynsolve.explain.step import Detail, Group, Step
from dynsolve.explain.writing import listed, sum_of, turns
from dynsolve.notation.tree import Negative, Node, Product, Transpose, equation, number
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
