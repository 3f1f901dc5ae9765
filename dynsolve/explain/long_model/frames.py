"""The last frame of a long chain, and the axes of the others."""

from __future__ import annotations

from dataclasses import replace
from functools import partial

from dynsolve.explain.context import Context
from dynsolve.explain.long_model.model import Change, LongModel
from dynsolve.explain.step import Step
from dynsolve.explain.working.identities import Identity, said
from dynsolve.explain.working.products import used_in_product
from dynsolve.notation.tree import Letter, Product, Symbol, Words, equation
from dynsolve.quantities import letters


def changes(model: LongModel) -> dict[str, Change]:
    """The changes by the ids of their steps."""
    last = len(model.context.robot.joints)
    return {f"H{last}": partial(last_frame, model), "axes": partial(axes, model)}


def last_frame(model: LongModel, step: Step) -> Step:
    """The last frame by the matrices of the rows, without the frames on the way to it."""
    used = _identities_outwards(model.context)
    return replace(step, working=(), concluding=("With ", *said(used), ":") if used else ())


def axes(model: LongModel, step: Step) -> Step:
    """The frames on the way, which are not shown, by their products."""
    robot = model.context.robot
    if robot.is_tree or letters.has_base(robot):
        return step
    i = Symbol("i")
    frame = replace(letters.H(robot, 1), sub=i)
    product = Product((letters.A(1), Words("…"), Letter("A", i, style="bold")))
    return replace(step, why=(*step.why, " Frame i is ", equation(frame, product), "."))


def _identities_outwards(context: Context) -> list[Identity]:
    """The identities by which the products of the frames become what is printed, each once."""
    used: dict[Identity, None] = {}
    for joint in context.robot.path(len(context.robot.joints)):
        before, A, H = (
            context.values[name] for name in (f"H{joint.parent}", f"A{joint.index}", f"H{joint.index}")
        )
        used |= dict.fromkeys(used_in_product(context, before, A, H))
    return list(used)
