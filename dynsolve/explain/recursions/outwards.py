"""The steps outwards: ω, ω̇ and the acceleration of each frame, from those of the frame before."""

from __future__ import annotations

from collections.abc import Iterator

from dynsolve.algebra.matrix import Matrix, cross
from dynsolve.derivation import recursions
from dynsolve.derivation.kinematics import rotation
from dynsolve.document import Prose
from dynsolve.explain.context import Context
from dynsolve.explain.recursions import formulas
from dynsolve.explain.recursions.links import source_of
from dynsolve.explain.recursions.names import BodyNames, LinkNames
from dynsolve.explain.recursions.parts import concluding, lines_of
from dynsolve.explain.step import Step
from dynsolve.explain.writing import is_small, sum_of
from dynsolve.notation.tree import (
    Negative,
    Node,
    Parenthesized,
    Product,
    Symbol,
    Transpose,
    equation,
    number,
)
from dynsolve.quantities.stages import Stage
from dynsolve.robot.model import Body, Joint, JointType

STAGE = Stage.NEWTON_EULER


def outwards(context: Context, joint: Joint) -> Iterator[Step]:
    """The steps of one link, of what is asked for and what that is derived from."""
    wanted, i = context.wanted, joint.index
    for name, step in (("wl", _angular_velocity), ("wdl", _angular_acceleration), ("al", _acceleration)):
        if f"{name}{i}" in wanted:
            yield step(context, joint)
    for body in context.robot.bodies_on(i):
        if f"acl{body.name}" in wanted:
            yield _center_acceleration(context, body)


def _rates(context: Context, joint: Joint, kind: JointType) -> tuple[Node, Node] | None:
    """The first and second rate of the joint's variable, q̇_1 + q̇_2; None where it is of another kind."""
    if joint.type is not kind:
        return None
    return _rate(context, joint, 1), _rate(context, joint, 2)


def _rate(context: Context, joint: Joint, dots: int) -> Node:
    names = [q.name for q in context.robot.coordinates]
    terms: list[Node] = []
    for k, rate in joint.rates:
        term: Node = Symbol(names[k], dots)
        if abs(rate) != 1:
            term = Product((number(abs(rate)), term))
        terms.append(Negative(term) if rate < 0 else term)
    return (
        terms[0] if len(terms) == 1 and not isinstance(terms[0], Negative) else Parenthesized(sum_of(terms))
    )


# -- how a link turns ------------------------------------------------------------------------------


def _angular_velocity(context: Context, joint: Joint) -> Step:
    i, link = joint.index, LinkNames.of(context.robot, joint.index)
    rates = _rates(context, joint, JointType.REVOLUTE)
    terms = formulas.angular_velocity(link, rates and rates[0])
    return Step(
        id=f"wl{i}",
        stage=STAGE,
        title=f"Link {i}, outwards: angular velocity",
        why=(_turning_why(joint),),
        formula=equation(link.vector("omega"), sum_of(terms)),
        source=source_of(context),
        working=_with_matrices(context, joint, link),
        result=(equation(link.vector("omega"), context.form(f"wl{i}")),),
    )


def _turning_why(joint: Joint) -> str:
    i = joint.index
    if joint.type is JointType.REVOLUTE:
        if not joint.parent:
            return "The base does not turn; the link turns about its joint."
        return f"Link {i} turns with link {joint.parent}, and about its own joint."
    still = f"link {joint.parent}" if joint.parent else "the base, which does not turn"
    how = "Its joint slides: the link turns with" if joint.type else "The link is fixed to"
    return f"{how} {still}."


def _with_matrices(context: Context, joint: Joint, link: LinkNames) -> tuple[Node, ...]:
    """The formula of ω with this robot's matrices, where there is anything to work out."""
    if not joint.parent:
        return ()
    A: Matrix = context.values[f"A{joint.index}"]
    before = context.form(f"wl{joint.parent}")
    terms: list[Node] = [Product((Transpose(context.show(rotation(A))), before))]
    rates = _rates(context, joint, JointType.REVOLUTE)
    if rates is not None:
        terms.append(Product((context.show(recursions.joint_axis(context.robot, A)), rates[0])))
    return (equation(link.vector("omega"), sum_of(terms)),) if is_small(*terms) else ()


def _angular_acceleration(context: Context, joint: Joint) -> Step:
    i, link, values = joint.index, LinkNames.of(context.robot, joint.index), context.values
    rates = _rates(context, joint, JointType.REVOLUTE)
    terms = formulas.angular_acceleration(link, rates)
    why = "The joint adds nothing; that of the link before is turned into the frame."
    A: Matrix = values[f"A{i}"]
    before = recursions.base_motion(context.robot).dw
    if joint.parent:
        before = values[f"wdl{joint.parent}"]
    parts = [rotation(A).T @ before]
    if rates is not None:
        first, second = (recursions.joint_rate(context.robot, joint, A, dots) for dots in (1, 2))
        parts += [second, cross(values[f"wl{i}"], first)]
        why = "The joint's own acceleration, and the turning of its axis with the link."
    lines = lines_of(context, list(zip(terms, parts, strict=True)))
    return Step(
        id=f"wdl{i}",
        stage=STAGE,
        title=f"Link {i}, outwards: angular acceleration",
        why=(why,),
        formula=equation(link.vector("omega", 1), sum_of(terms)),
        source=source_of(context),
        lines=lines,
        concluding=concluding(lines),
        result=(equation(link.vector("omega", 1), context.form(f"wdl{i}")),),
    )


# -- how its points accelerate ---------------------------------------------------------------------


def _acceleration(context: Context, joint: Joint) -> Step:
    i, link = joint.index, LinkNames.of(context.robot, joint.index)
    terms = formulas.acceleration(link, link.lever, _rates(context, joint, JointType.PRISMATIC))
    lines = lines_of(context, list(zip(terms, _carried(context, joint, None), strict=True)))
    return Step(
        id=f"al{i}",
        stage=STAGE,
        title=f"Link {i}, outwards: acceleration of its origin",
        why=(_carried_why(joint), *_base_why(context, joint)),
        formula=equation(link.vector("a"), sum_of(terms)),
        source=source_of(context),
        lines=lines,
        concluding=concluding(lines),
        result=(equation(link.vector("a"), context.form(f"al{i}")),),
    )


def _carried_why(joint: Joint) -> str:
    made = "What the origin before has, and what the turning adds over the way from there"
    if joint.type is JointType.PRISMATIC:
        return f"{made}; since the joint slides, also the Coriolis acceleration and its own."
    return f"{made}."


def _base_why(context: Context, joint: Joint) -> Prose:
    if joint.parent:
        return ()
    if context.standard:
        return (" The base is at rest.",)
    given = equation(
        LinkNames.of(context.robot, joint.index).vector_before("a"),
        context.show(recursions.lift(context.robot)),
    )
    return (" The base accelerates by ", given, ", which stands for gravity.")


def _carried(context: Context, joint: Joint, beyond: Matrix | None) -> tuple[Matrix, ...]:
    """The values of the terms of an acceleration."""
    i, values = joint.index, context.values
    before = recursions.base_motion(context.robot)
    if joint.parent:
        before = recursions.Motion(*(values[f"{stem}{joint.parent}"] for stem in ("wl", "wdl", "al")))
    step = recursions.Step(joint, values[f"A{i}"], before)
    return recursions.acceleration_parts(context.robot, step, values[f"wl{i}"], values[f"wdl{i}"], beyond)


def _center_acceleration(context: Context, body: Body) -> Step:
    joint, names = context.robot.joints[body.link - 1], BodyNames.of(context.robot, body)
    terms = formulas.center_acceleration(names, _rates(context, joint, JointType.PRISMATIC))
    if context.standard:
        why = "As for an origin, with the way from the origin before to the mass centre."
        values = _carried(context, joint, body.center)
    else:
        why = "From the origin of the frame to the mass centre, which is fixed in the link."
        at_origin, w, dw = (context.values[f"{stem}{body.link}"] for stem in ("al", "wl", "wdl"))
        values = (at_origin, *recursions.turning_parts(w, dw, body.center))
    lines = lines_of(context, list(zip(terms, values, strict=True)))
    return Step(
        id=f"acl{body.name}",
        stage=STAGE,
        title=f"Body {body.name}, outwards: acceleration of its mass centre",
        why=(why,),
        formula=equation(names.acceleration, sum_of(terms)),
        source=source_of(context),
        lines=lines,
        concluding=concluding(lines),
        result=(equation(names.acceleration, context.form(f"acl{body.name}")),),
    )
