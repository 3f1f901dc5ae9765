"""The step of what is known of each link, along the axes of its own frame."""

from __future__ import annotations

from collections.abc import Iterator

from dynsolve.algebra.matrix import Matrix
from dynsolve.derivation import recursions
from dynsolve.derivation.kinematics import origin, rotation
from dynsolve.document import Prose
from dynsolve.explain.citations import craig, spong
from dynsolve.explain.context import Context
from dynsolve.explain.recursions.names import BodyNames, LinkNames
from dynsolve.explain.step import Step
from dynsolve.notation.tree import Node, Number, Product, Symbol, Transpose, equation
from dynsolve.quantities import letters
from dynsolve.quantities.stages import Stage
from dynsolve.robot.model import Body, Joint


def source_of(context: Context) -> str:
    """The section of the book whose convention the table is in."""
    return spong("7.6") if context.standard else craig("6.5")


def links_step(context: Context) -> Step:
    """R, the levers, the axes, gravity, and the tensors of all links."""
    general = LinkNames.general(context.standard)
    base: Prose = (" In place of gravity the base accelerates upwards, which weighs on every link alike.",)
    if context.standard:
        to_base = letters.bold("R", Symbol("i"), Number(0))
        turned = Product((Transpose(to_base), letters.GRAVITY))
        base = (" Gravity is turned into each frame too: ", equation(general.gravity, turned), ".")
    return Step(
        id="links",
        stage=Stage.NEWTON_EULER,
        title="The links, each in its own frame",
        why=(
            "Every vector of link i is written along the axes of its own frame i, in which the mass centre "
            "and the tensor are constant. A vector passes from frame i-1 to frame i by the transpose of ",
            general.R,
            ", the rotation in ",
            letters.bold("A", Symbol("i")),
            ".",
            *base,
        ),
        source=source_of(context),
        result=tuple(known for joint in context.robot.joints for known in _known(context, joint)),
        listed=True,
        uses=tuple(f"A{joint.index}" for joint in context.robot.joints),
    )


def _known(context: Context, joint: Joint) -> Iterator[Node]:
    """The rotation, the lever, the joint's axis, gravity, and the bodies of a link."""
    robot, link = context.robot, LinkNames.of(context.robot, joint.index)
    A: Matrix = context.values[f"A{joint.index}"]
    yield equation(link.R, context.show(rotation(A)))
    yield equation(link.lever, context.show(recursions.lever(A) if context.standard else origin(A)))
    if joint.type:
        yield equation(link.axis, context.show(recursions.joint_axis(robot, A)))
    if context.standard and not robot.gravity.is_zero:
        H: Matrix = context.values[f"H{joint.index}"]
        yield equation(link.gravity, context.show(rotation(H).T @ robot.gravity))
    for body in robot.bodies_on(joint.index):
        names = BodyNames.of(context.robot, body)
        if context.standard:
            yield equation(names.lever, context.show(recursions.lever(A) + body.center))
        else:
            yield equation(names.center, context.show(body.center))
        if not body.is_point:
            yield equation(names.tensor, context.show(tensor_value(context, body)))


def tensor_value(context: Context, body: Body) -> Matrix:
    """The tensor about the mass centre along the axes of the link's frame, 3×3."""
    H, own = context.values[f"H{body.link}"], context.values[f"I_body{body.name}"]
    return recursions.tensor_in_link(context.robot, body, H, own)
