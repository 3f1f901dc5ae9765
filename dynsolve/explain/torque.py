"""Steps of the Euler-Lagrange equations, a coordinate after the other."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from dynsolve.document import Prose
from dynsolve.explain.context import Context
from dynsolve.explain.step import STATED, Detail, Group, Step
from dynsolve.explain.terms import driving_row
from dynsolve.explain.working.derivatives import cancelling, coordinate_derivative, momentum_rate
from dynsolve.explain.writing import listed, spong, turns
from dynsolve.notation.tree import Letter, Negative, Node, Number, Sum, Symbol, equation, number
from dynsolve.quantities import letters
from dynsolve.quantities.stages import Stage
from dynsolve.robot.model import Coordinate, JointType

STAGE = Stage.TORQUE


def steps(context: Context) -> Iterator[Step]:
    """∂L/∂q̇, its rate, ∂L/∂q and the force, for each coordinate."""
    if context.robot.actions:
        from dynsolve.explain.actions import friction_steps

        yield from friction_steps(context)
    for q in context.robot.coordinates:
        why = _held_fixed() if q.index == 1 else ()
        if q.index - 1 in context.robot.actions.passive:
            why += (*((" ",) if why else ()), Symbol(q.name), *_driven_by(context, q))
        group = Group(f"tau{q.index}", f"Coordinate {q.index}", why)
        for step in (_momentum(context, q), _rate(context, q), _slope(context, q), _force(context, q)):
            yield replace(step, group=group, normal=STATED)


def _held_fixed() -> Prose:
    """How the three derivatives differ."""
    rate, coordinate = (
        letters.partial_derivative(letters.L, Letter("q", Symbol("i"), dots=d)) for d in (1, 0)
    )
    return (
        *("In ", rate, " and ", coordinate, " everything else is held fixed; in d/dt all that changes with "),
        "time is differentiated (product and chain rule).",
    )


def _momentum(context: Context, q: Coordinate) -> Step:
    rate = letters.velocity(q)
    return Step(
        id=f"dLdqd{q.index}",
        stage=STAGE,
        title=f"Coordinate {q.index}: generalized momentum",
        why=_partial(context, rate, "coordinate", "rate"),
        formula=None,
        source=spong("7.1"),
        result=(equation(letters.partial_derivative(letters.L, rate), context.form(f"dLdqd{q.index}")),),
    )


def _partial(context: Context, by: Node, held: str, like: str) -> Prose:
    """The sentence about a partial derivative: the variable, and the quantities that are held fixed."""
    fixed = f"the {held} is" if context.robot.n == 1 else f"the {held}s and the other {like}s are"
    return ("Differentiate ℒ with respect to ", by, f" alone: {fixed} held fixed.")


def _rate(context: Context, q: Coordinate) -> Step:
    way = momentum_rate(context, q)
    momentum = letters.partial_derivative(letters.L, letters.velocity(q))
    return Step(
        id=f"ddt{q.index}",
        stage=STAGE,
        title=f"Coordinate {q.index}: time derivative of the momentum",
        why=_rate_why(context, q),
        source=spong("7.1"),
        lines=way.lines,
        concluding=way.concluding,
        result=(equation(letters.time_derivative(momentum), context.form(f"ddt{q.index}")),),
        hint=(
            "Differentiate the momentum with respect to time. Each rate in it becomes an acceleration, "
            "and each coordinate in it brings its own rate (product and chain rule).",
        ),
    )


def _rate_why(context: Context, q: Coordinate) -> Prose:
    ring = context.robot.ring
    momentum = context.values[f"dLdqd{q.index}"]
    moving = [c for k, c in enumerate(context.robot.coordinates) if not ring.diff(momentum, k).is_zero]
    if not moving:
        return ("No coordinate occurs in it: each rate becomes an acceleration, and nothing else changes.",)
    rates = "the rate" if context.robot.n == 1 else "the rates"
    return (
        f"Everything that changes with time is differentiated (product and chain rule): {rates}, and also ",
        *listed([Symbol(c.name) for c in moving]),
        ".",
    )


def _slope(context: Context, q: Coordinate) -> Step:
    form = context.form(f"dLdq{q.index}")
    why: Prose = _partial(context, Symbol(q.name), "rate", "coordinate")
    if form == Number(0):
        why = (Symbol(q.name), " itself does not occur in ℒ.")
    elif context.robot.given is None and context.robot.ring.diff(context.values["K"], q.index - 1).is_zero:
        why = _of_potential_energy(context, q)
    way = coordinate_derivative(context, q)
    return Step(
        id=f"dLdq{q.index}",
        stage=STAGE,
        title=f"Coordinate {q.index}: partial derivative of ℒ",
        why=why,
        source=spong("7.1"),
        lines=way.lines,
        concluding=way.concluding,
        result=(equation(letters.partial_derivative(letters.L, Symbol(q.name)), form),),
        hint=(
            "Differentiate ℒ with respect to the coordinate alone: the rates are held fixed, and a term "
            "in which the coordinate does not occur drops out.",
        ),
    )


def _of_potential_energy(context: Context, q: Coordinate) -> Prose:
    """That a coordinate is in P alone, and what is held fixed there."""
    slope, fall = (letters.partial_derivative(of, Symbol(q.name)) for of in (letters.L, letters.P))
    others = " and the other coordinates" if context.robot.n > 1 else ""
    held = f" The rates{others} are held fixed."
    return (Symbol(q.name), " does not occur in 𝒦, so ", equation(slope, Negative(fall)), f".{held}")


def _force(context: Context, q: Coordinate) -> Step:
    force = driving_row(context, q)
    momentum = letters.time_derivative(letters.partial_derivative(letters.L, letters.velocity(q)))
    derivative = letters.partial_derivative(letters.L, Symbol(q.name))
    return Step(
        id=f"tau{q.index}",
        stage=STAGE,
        title=f"Coordinate {q.index}: the {'torque' if turns(q) else 'force'}",
        why=(Symbol(q.name), *_driven_by(context, q)),
        formula=equation(force, Sum((momentum, Negative(derivative), *_resisted(context, q)))),
        source=spong("7.1"),
        concluding=cancelling(context, q),
        result=(equation(force, context.form(f"tau{q.index}")),),
        detail=Detail.BRIEF,
    )


def _resisted(context: Context, q: Coordinate) -> tuple[Node, ...]:
    """The friction of a coordinate, where there is any."""
    return (letters.friction(q.index),) if context.has_friction(q.index - 1) else ()


def _driven_by(context: Context, q: Coordinate) -> Prose:
    """The kind of force that drives a coordinate, and of which joints it is made where they share it."""
    kind = "torque" if turns(q) else "force"
    if q.index - 1 in context.robot.actions.passive:
        what = f" is {'an angle' if turns(q) else 'a length'} that no motor drives: its {kind} "
        return (what, equation(letters.force(q), Number(0)), ", and this is its equation of motion.")
    moved = context.robot.joints_of(q)
    alone = len(moved) == 1 and all(len(joint.rates) == 1 and rate == 1 for joint, rate in moved)
    if alone or not moved:
        return (f" is {'an angle' if turns(q) else 'a length'}, so what drives it is a {kind}.",)
    if not moved:
        return (f" is the angle of a motor, so what drives it is a {kind}.",)
    parts: Prose = ()
    for joint, rate in moved:
        sign = " minus " if rate < 0 else " plus " if parts else " "
        factor: Prose = () if abs(rate) == 1 else (number(abs(rate)), " times ")
        own = "torque" if joint.type is JointType.REVOLUTE else "force"
        parts += (sign, *factor, f"the {own} of joint {joint.index}")
    return (f" is not the variable of one joint alone. By virtual work its {kind} is", *parts, ".")


# -- the step to the Lagrangian --------------------------------------------------------------------

STAGE_OF_LAGRANGIAN = Stage.LAGRANGIAN


def lagrangian_steps(context: Context) -> Iterator[Step]:
    """L = K - P"""
    yield Step(
        id="L",
        stage=STAGE_OF_LAGRANGIAN,
        title="Kinetic minus potential energy",
        why=("The one function from which every equation of motion follows.",),
        formula=equation(letters.L, Sum((letters.K, Negative(letters.P)))),
        source=spong("7.1"),
        result=(equation(letters.L, context.form("L")),),
        detail=Detail.BRIEF,
    )
