"""Steps of the Euler-Lagrange equations, a coordinate after the other."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import partial

from msgspec.structs import asdict, replace

from dynsolve.document import Prose
from dynsolve.document.books import spong
from dynsolve.document.sentences import say
from dynsolve.explain.context import Context
from dynsolve.explain.named_steps import ending
from dynsolve.explain.step import STATED, Detail, Group, Part, Step
from dynsolve.explain.terms import driving_row
from dynsolve.explain.working.derivatives import cancelling, coordinate_derivative, momentum_rate
from dynsolve.explain.working.identities import Way, new_angles
from dynsolve.explain.writing import listed, sum_of, turns
from dynsolve.notation.template import formula
from dynsolve.notation.tree import ZERO, Negative, Node, Relation, Symbol, equation, number
from dynsolve.quantities import letters
from dynsolve.robot.model import Coordinate, JointType


def steps(context: Context) -> Iterator[Step]:
    """∂L/∂q̇, its rate, ∂L/∂q and the force, for each coordinate."""
    if context.robot.actions:
        from dynsolve.explain.actions import friction_steps

        yield from friction_steps(context)
    if not context.by_energies:
        for q in context.robot.coordinates:
            yield from _of_coordinate(context, q)


def _of_coordinate(context: Context, q: Coordinate) -> Iterator[Step]:
    i, driven = q.index, say("{q}{driven}", q=Symbol(q.name), driven=_driven_by(context, q))
    why: Prose = ()
    asked = context.robot.questions
    is_force = not context.is_in_letters and context.values[f"ddt{i}"] == context.values[f"tau{i}"]
    is_force &= {"ddt", f"ddt{i}"}.isdisjoint(context.find)
    way = momentum_rate(context, q)
    identities = [part for part in way.concluding if isinstance(part, Relation)] if is_force else []
    collected = _collected_with([*(_of_new_angles(context) if i == 1 else ()), *identities])
    if i == 1:
        why = say(
            "In $∂ℒ/∂q̇_i$ and $∂ℒ/∂q_i$ everything else is held fixed; in d/dt all that changes with time is "
            "differentiated (product and chain rule).{collected}{outside}{held}",
            collected=say(" {these}", these=collected) if collected else (),
            outside=say(" $Q_i$, entry $i$ of $𝐐$, is what acts from outside.") if asked.loads else "",
            held=say(" $𝐀_cᵀ 𝛌$ is what the constraints do.") if asked.constraints else "",
        )
    else:
        why = collected
    passive = context.robot.actions.passive
    if i - 1 in passive or (passive and not turns(q)):
        why = say("{why}{gap}{driven}", why=why, gap=" " if why else "", driven=driven)
    group = Group(f"tau{i}", f"Coordinate {i}", why)
    step = partial(Step, source=spong("7.1"), group=group)
    by_rate = formula("∂ℒ/∂{rate}", rate=letters.velocity(q))
    by_coordinate = formula("∂ℒ/∂{q}", q=Symbol(q.name))
    end = ending(context, f"dLdqd{i}", {f"dLdqd{i}": (by_rate,)})
    yield step(
        id=f"dLdqd{i}",
        title=f"Coordinate {i}: generalized momentum",
        why=_partial(context, letters.velocity(q), "coordinate", "rate"),
        **asdict(end),
        normal=STATED,
    )
    rate = letters.time_derivative(by_rate)
    end = ending(context, f"ddt{i}", {f"ddt{i}": (rate,)}, way)
    if is_force:  # the force has the same result: of a worked example the first line is enough
        end = replace(
            end, lines=(*end.lines[:1], *(replace(one, detail=Detail.FULL) for one in end.lines[1:]))
        )
    yield step(
        id=f"ddt{i}",
        title=f"Coordinate {i}: time derivative of the momentum",
        why=(*_rate_why(context, q), *_change_of_inertia(context, q)),
        **asdict(end),
        normal=Part.FORMULA | Part.LINES if is_force else STATED,
        hint=(
            "Differentiate the momentum with respect to time. Each rate in it becomes an acceleration, "
            "and each coordinate in it brings its own rate (product and chain rule).",
        ),
    )
    end = ending(context, f"dLdq{i}", {f"dLdq{i}": (by_coordinate,)}, coordinate_derivative(context, q))
    yield step(
        id=f"dLdq{i}",
        title=f"Coordinate {i}: partial derivative of ℒ",
        why=_slope_why(context, q),
        **asdict(end),
        normal=STATED,
        hint=(
            "Differentiate ℒ with respect to the coordinate alone: the rates are held fixed, and a term "
            "in which the coordinate does not occur drops out.",
        ),
    )
    force, resisted = driving_row(context.robot, q), [letters.friction(i)] * context.has_friction(i - 1)
    end = ending(context, f"tau{i}", {f"tau{i}": (force,)}, Way((), cancelling(context, q)))
    yield step(
        id=f"tau{i}",
        title=f"Coordinate {i}: the {'torque' if turns(q) else 'force'}",
        why=(*driven, *how_collected(context)),
        formula=equation(force, sum_of([rate, Negative(by_coordinate), *resisted])),
        **asdict(end),
        detail=Detail.BRIEF,
        normal=STATED,
    )


def _of_new_angles(context: Context) -> list[Node]:
    """What sines and cosines stand for whose angles are met first in these results."""
    if context.is_in_letters:
        return []
    stems = ("ddt", "dLdq", "tau")
    made = [context.result(f"{stem}{q.index}") for q in context.robot.coordinates for stem in stems]
    made += [one.meaning for one in context.names.sums] if context.names else []
    return list(new_angles(context.robot.ring, [context.form("L")], made))


def _collected_with(identities: Sequence[Node]) -> Prose:
    these = dict.fromkeys(identities)
    return say("The results are collected with {these}.", these=listed([*these])) if these else ()


def how_collected(context: Context) -> Prose:
    """How a force is written that stays in letters."""
    return (" Collected by the accelerations and the rates.",) if context.is_in_letters else ()


def _partial(context: Context, by: Symbol, held: str, like: str) -> Prose:
    """The sentence about a partial derivative: the variable, and the quantities that are held fixed."""
    fixed = f"the {held} is" if context.robot.n == 1 else f"the {held}s and the other {like}s are"
    return say("Differentiate ℒ with respect to {by} alone: {fixed} held fixed.", by=by, fixed=fixed)


def _rate_why(context: Context, q: Coordinate) -> Prose:
    ring, momentum = context.robot.ring, context.values[f"dLdqd{q.index}"]
    moving = [c for k, c in enumerate(context.robot.coordinates) if not ring.diff(momentum, k).is_zero]
    if not moving:
        return ("No coordinate occurs in it: each rate becomes an acceleration, and nothing else changes.",)
    return say(
        "Everything that changes with time is differentiated (product and chain rule): {rates}, and also "
        "{moving}.",
        rates="the rate" if context.robot.n == 1 else "the rates",
        moving=listed([Symbol(c.name) for c in moving]),
    )


def _change_of_inertia(context: Context, q: Coordinate) -> Prose:
    """What ḋ_kj is, where a momentum is written by d_kj."""
    if not context.is_in_letters:
        return ()
    change = formula(
        "ḋ_{k}j = Σ_(i=1)^{n} (c_ij{k} + c_i{k}j) q̇_i", k=Symbol(str(q.index)), n=context.robot.n
    )
    return say(" In the Christoffel symbols, {change}.", change=change)


def _slope_why(context: Context, q: Coordinate) -> Prose:
    name = Symbol(q.name)
    if context.form(f"dLdq{q.index}") == ZERO:
        return say("{q} itself does not occur in ℒ.", q=name)
    if context.robot.given is None and context.robot.ring.diff(context.values["K"], q.index - 1).is_zero:
        return say(
            "{q} does not occur in 𝒦, so $∂ℒ/∂{q} = -∂𝒫/∂{q}$. The rates{others} are held fixed.",
            q=name,
            others=" and the other coordinates" if context.robot.n > 1 else "",
        )
    return _partial(context, name, "rate", "coordinate")


def _driven_by(context: Context, q: Coordinate) -> Prose:
    """The kind of force that drives a coordinate, and of which joints it is made where they share it."""
    kind, what = ("torque", "an angle") if turns(q) else ("force", "a length")
    if q.index - 1 in context.robot.actions.passive:
        return say(
            " is {what} that no motor drives: its {kind} ${force} = 0$, and this is its equation of motion.",
            what=what,
            kind=kind,
            force=letters.force(q),
        )
    moved = context.robot.joints_of(q)
    if not moved or (len(moved) == 1 and all(len(joint.rates) == 1 and rate == 1 for joint, rate in moved)):
        if turns(q):
            return (" is an angle, so what drives it is a torque.",)
        return say(" is a length, so what drives it is the force {force}.", force=letters.force(q))
    parts: Prose = ()
    for joint, rate in moved:
        parts += say(
            "{sign}{rate}{times}the {own} of joint {joint}",
            sign=" minus " if rate < 0 else " plus " if parts else " ",
            rate=() if abs(rate) == 1 else (number(abs(rate)),),
            times="" if abs(rate) == 1 else " times ",
            own="torque" if joint.type is JointType.REVOLUTE else "force",
            joint=context.robot.number_of(joint),
        )
    return say(
        " is not the variable of one joint alone. By virtual work its {kind} is{p}.", kind=kind, p=parts
    )


# -- the step to the Lagrangian --------------------------------------------------------------------


def lagrangian_steps(context: Context) -> Iterator[Step]:
    """L = K - P"""
    if context.by_energies:
        return
    end = ending(context, "L", {"L": (letters.L,)})
    yield Step(
        id="L",
        title="Kinetic minus potential energy",
        why=("The one function from which every equation of motion follows.",),
        formula=formula("ℒ = 𝒦 - 𝒫"),
        source=spong("7.1"),
        **asdict(end),
        detail=Detail.BRIEF,
        normal=STATED,
    )
