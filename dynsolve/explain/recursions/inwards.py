"""The steps inwards: what each link is held with by the link before, a force and a moment."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from dynsolve.algebra.matrix import Matrix, cross
from dynsolve.derivation import recursions
from dynsolve.derivation.kinematics import origin, rotation
from dynsolve.document import Prose
from dynsolve.explain.context import Context
from dynsolve.explain.jacobian_columns import ZERO
from dynsolve.explain.recursions import formulas
from dynsolve.explain.recursions.links import source_of, tensor_value
from dynsolve.explain.recursions.names import BodyNames, LinkNames
from dynsolve.explain.recursions.parts import Part, concluding, lines_of
from dynsolve.explain.step import Step
from dynsolve.explain.writing import sum_of
from dynsolve.notation.tree import Node, equation
from dynsolve.quantities import letters
from dynsolve.quantities.stages import Stage
from dynsolve.robot.model import Body, Joint

STAGE = Stage.NEWTON_EULER


def inwards(context: Context, joint: Joint) -> Iterator[Step]:
    """The steps of one link, of what is asked for and what that is derived from."""
    for name, step in (("fl", _force), ("nl", _moment)):
        if f"{name}{joint.index}" in context.wanted:
            yield step(context, joint)


def is_heavy(context: Context) -> bool:
    """Whether gravity stands in the forces; in the modified convention it stands in the accelerations."""
    return context.standard and not context.robot.gravity.is_zero


def _nothing_follows(context: Context, i: int) -> Prose:
    return () if context.robot.links_after(i) else (" No link follows, so nothing is passed on.",)


def _inertial(context: Context, body: Body) -> Node:
    return formulas.inertial_force(BodyNames.of(context.robot, body), context.mass(body), is_heavy(context))


def _inertial_value(context: Context, body: Body) -> Matrix:
    H, acceleration = context.values[f"H{body.link}"], context.values[f"acl{body.name}"]
    return recursions.inertial_force(context.robot, body, H, acceleration)


# -- the force -------------------------------------------------------------------------------------


def _force(context: Context, joint: Joint) -> Step:
    i, bodies = joint.index, context.robot.bodies_on(joint.index)
    parts = list(_forces(context, i, bodies))
    lines = lines_of(context, parts)
    name = letters.in_link("f", i)
    return Step(
        id=f"fl{i}",
        stage=STAGE,
        title=f"Link {i}, inwards: the force in its joint",
        why=(_newton(context, bodies), *_nothing_follows(context, i)),
        formula=equation(name, sum_of([part for part, _ in parts]) if parts else ZERO),
        source=source_of(context),
        lines=lines,
        concluding=concluding(lines),
        result=(equation(name, context.form(f"fl{i}")),),
    )


def _forces(context: Context, i: int, bodies: Sequence[Body]) -> Iterator[Part]:
    """The terms of f_i, each with its value."""
    for j in context.robot.links_after(i):
        R = rotation(context.values[f"A{j}"])
        yield formulas.passed_on(LinkNames.of(context.robot, j), "f"), R @ context.values[f"fl{j}"]
    for body in bodies:
        yield _inertial(context, body), _inertial_value(context, body)


def _newton(context: Context, bodies: Sequence[Body]) -> str:
    if not bodies:
        return "The link has no mass: it passes on the force that the next link needs."
    own = " beside its weight" if is_heavy(context) else ""
    next_link = ", and what the next link needs" if context.robot.links_after(bodies[0].link) else ""
    return f"Newton's law: what the mass needs{own}{next_link}."


# -- the moment ------------------------------------------------------------------------------------


def _moment(context: Context, joint: Joint) -> Step:
    i = joint.index
    parts = list(_moments(context, joint))
    lines = lines_of(context, parts)
    name = letters.in_link("n", i)
    return Step(
        id=f"nl{i}",
        stage=STAGE,
        title=f"Link {i}, inwards: the moment in its joint",
        why=(
            "Euler's law about the mass centre, and the moments of the forces about ",
            letters.o(i - 1 if context.standard else i),
            ".",
            *_nothing_follows(context, i),
        ),
        formula=equation(name, sum_of([part for part, _ in parts]) if parts else ZERO),
        source=source_of(context),
        lines=lines,
        concluding=concluding(lines),
        result=(equation(name, context.form(f"nl{i}")),),
    )


def _moments(context: Context, joint: Joint) -> Iterator[Part]:
    """The terms of n_i, each with its value."""
    robot, values, i = context.robot, context.values, joint.index
    link = LinkNames.of(context.robot, i)
    for j in robot.links_after(i):
        A: Matrix = values[f"A{j}"]
        reach = recursions.lever(values[f"A{i}"]) if context.standard else origin(A)
        force = cross(reach, rotation(A) @ values[f"fl{j}"])
        named = formulas.moment_of_next(link, LinkNames.of(context.robot, j))
        yield from zip(named, (rotation(A) @ values[f"nl{j}"], force), strict=True)
    for body in robot.bodies_on(i):
        yield from _of_body(context, joint, body)
    if robot.actions.motors:
        from dynsolve.explain.actions import rotor_moments

        yield from rotor_moments(context, i)


def _of_body(context: Context, joint: Joint, body: Body) -> Iterator[Part]:
    values, i = context.values, joint.index
    start = recursions.start_of_moments(context.robot, values[f"A{i}"])
    found = [cross(start + body.center, _inertial_value(context, body))]
    if not body.is_point:
        tensor, w, dw = tensor_value(context, body), values[f"wl{i}"], values[f"wdl{i}"]
        found += [tensor @ dw, cross(w, tensor @ w)]
    names = BodyNames.of(context.robot, body)
    yield from zip(
        formulas.moment_of_body(names, _inertial(context, body), body.is_point), found, strict=True
    )
