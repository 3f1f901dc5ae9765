"""What is conserved: the energy, and the momenta of cyclic coordinates (Goldstein 2.6)."""

from __future__ import annotations

from dynsolve.derivation.kinematics import joint_frame
from dynsolve.document import Prose, Reference
from dynsolve.document.books import spong
from dynsolve.document.sentences import say
from dynsolve.explain.context import Context
from dynsolve.explain.entry_formulas import pairs
from dynsolve.explain.step import Line, Step
from dynsolve.explain.terms import driving_row, driving_side
from dynsolve.explain.writing import listed, sum_of, turns
from dynsolve.notation.build import cost
from dynsolve.notation.template import formula
from dynsolve.notation.tree import (
    ZERO,
    Negative,
    Node,
    Parenthesized,
    Product,
    Relation,
    Sum,
    Symbol,
    equation,
)
from dynsolve.quantities import letters
from dynsolve.robot.model import Coordinate
from dynsolve.robot.questions import FOR_EVERY_Q, Method

LONGEST = 30
"""The operations up to which a momentum is written again."""


def conserved_step(context: Context) -> Step | None:
    """How the energy changes, and which momenta stay as they are."""
    return _step(context, _of_energy(context))


def momenta_step(context: Context) -> Step | None:
    """The momenta that stay as they are."""
    return _step(context, None)


def _step(context: Context, energy: Line | None) -> Step | None:
    free = _cyclic(context)
    if energy is None and not free:
        return None
    momenta = [equation(_momentum(q), _written(context, q)) for q in free if not _stands_above(context, q)]
    said = _of_momenta(context, free) if free else ()
    conserved = (*said, " conserved.") if free else ()
    of_momenta = (*said, " conserved:") if momenta else conserved
    power = _of_power(context) if energy else ()
    return Step(
        id="conserved",
        title="Check: what is conserved",
        why=energy.by if energy else of_momenta,
        source=spong("7.1"),
        lines=(Line((), energy.formulas),) if energy else (),
        concluding=(*power, *of_momenta) if energy else (),
        result=tuple(momenta),
        outcome=(*power, *conserved),
        is_task=False,
    )


# -- the energy ------------------------------------------------------------------------------------


def _of_energy(context: Context) -> Line | None:
    """d/dt (K + P) = q̇ᵀ (D q̈ + ½ Ḋ q̇ + g) = q̇ᵀ (D q̈ + C q̇ + g + ½ N q̇) = q̇ᵀ τ, of energies."""
    asked = context.robot.questions
    if context.robot.given is not None or asked.method is not Method.LAGRANGE:
        return None
    driving = driving_side(context, constrained=False)
    terms = driving.terms if isinstance(driving, Sum) else (driving,)
    acting = sum_of([*terms, *([Negative(letters.FRICTION)] if context.robot.actions.resisting else [])])
    by = say(
        "The rate of the energy follows from $𝒦 = ½ {square}$ ($𝐃$ is symmetric) and $𝐠 = ∂𝒫/∂𝐪$, with "
        "$𝐃̇ = 2 𝐂 + 𝐍$, $𝐃 𝐪̈ + 𝐂 𝐪̇ + 𝐠 = {acting}${held} and $𝐪̇ᵀ 𝐍 𝐪̇ = 0${skew}:",
        square=formula("𝐪̇ᵀ 𝐃 𝐪̇"),
        acting=sum_of([acting, formula("𝐀_cᵀ 𝛌")]) if asked.constraints else acting,
        held=say(", $𝐀_c 𝐪̇ = 0$") if asked.constraints else "",
        skew=Reference(("skew-2",), " by "),
    )
    powers = formula(
        "𝐪̇ᵀ (𝐃 𝐪̈ + ½ 𝐃̇ 𝐪̇ + 𝐠) = 𝐪̇ᵀ (𝐃 𝐪̈ + 𝐂 𝐪̇ + 𝐠 + ½ 𝐍 𝐪̇) = 𝐪̇ᵀ {acting}",
        acting=Parenthesized(acting) if isinstance(acting, Sum) else acting,
    )
    assert isinstance(powers, Relation)
    return Line(by, (equation(letters.time_derivative(formula("𝒦 + 𝒫")), *powers.parts),))


def _of_power(context: Context) -> Prose:
    driving = driving_side(context, constrained=False)
    if driving == letters.TAU and len(context.robot.actions.passive) == context.robot.n:
        by_friction = "friction alone changes the energy, and takes it away"
        what = by_friction if context.robot.actions.resisting else "the energy is conserved"
        return (f"No motor drives: {what}. ",)
    rest = " alone: as long as ${driving} = 𝟎$ it is conserved. "
    if context.robot.actions.resisting:
        rest = " and of friction, which takes energy away. "
    return say(f"The energy changes by the power of {{driving}}{rest}", driving=driving)


# -- momenta ---------------------------------------------------------------------------------------


def _cyclic(context: Context) -> list[Coordinate]:
    """The coordinates that do not stand in L, on which neither friction nor a constraint acts."""
    values = context.values
    held = context.robot.questions.constraints
    return [
        q
        for q in context.robot.coordinates
        if values[f"dLdq{q.index}"].is_zero
        and not (held and any(not row[q.index - 1].is_zero for row in values["Ac"].rows))
        and not values[f"dLdqd{q.index}"].is_zero
        and not context.has_friction(q.index - 1)
    ]


def _momentum(q: Coordinate) -> Node:
    return letters.partial_derivative(letters.L, letters.velocity(q))


def _of_momenta(context: Context, free: list[Coordinate]) -> Prose:
    """Which momenta stay constant as long as nothing acts on them, and what these are."""
    acting = [form for q in free if (form := _acting_on(context, q)) != ZERO]
    text = (
        "{names} does not appear in {L}: a cyclic coordinate. {zeros} Euler-Lagrange equation says that the "
        "momentum {momenta} is"
    )
    if len(free) > 1:
        text = (
            "{names} do not appear in {L}: cyclic coordinates. {zeros} Euler-Lagrange equations say that the "
            "momenta {momenta} are"
        )
    return say(
        text,
        names=listed([Symbol(q.name) for q in free]),
        L=formula("ℒ = 𝒦 - 𝒫") if context.by_energies else letters.L,
        zeros=say("As long as {zeros}, the", zeros=listed([equation(form, ZERO) for form in acting]))
        if acting
        else "The",
        momenta=listed(
            [(_momentum(q), Reference((f"dLdqd{q.index}",), " in "), *_named(context, q)) for q in free]
        ),
    )


def _acting_on(context: Context, q: Coordinate) -> Node:
    """What really acts on a coordinate: no motor on a passive one, nothing that is 0 in its row."""
    values, k = context.values, q.index - 1
    row = driving_row(context.robot, q, with_passive=False)
    terms = list(row.terms) if isinstance(row, Sum) else [row]
    if context.robot.questions.loads and values[FOR_EVERY_Q][k, 0].is_zero:
        terms.remove(letters.entry("Q", q.index))
    if context.robot.questions.constraints:  # none acts on what is cyclic
        terms.pop()
    return sum_of(terms) if terms else ZERO


def _named(context: Context, q: Coordinate) -> Prose:
    """What the momentum is of a coordinate that moves one joint, or shifts all bodies alike."""
    robot = context.robot
    if robot.actions.rotors:
        return ()
    if not robot.has_table:
        shift = _shifts_all(context, q)
        return (f" (the total linear momentum along {shift})",) if shift else ()
    moved = robot.joints_of(q)
    if len(moved) != 1 or moved[0][1] != 1:
        return ()
    joint = moved[0][0]
    kind, where = ("angular", "about") if turns(q) else ("linear", "along")
    is_first = not robot.is_tree and all(body.link >= joint.index for body in robot.bodies)
    return say(
        "{of_all} {axis})" if is_first else "{of_some} {axis} of all that {joint} moves)",
        of_all=f" (the {kind} momentum of the {context.machine} {where}",
        of_some=f" (the {kind} momentum {where}",
        axis=letters.z(joint_frame(robot, joint)),
        joint=f"joint {robot.number_of(joint)}",
    )


def _shifts_all(context: Context, q: Coordinate) -> str:
    """The axis of the world along which a coordinate shifts every body by as much, turning none; else ''."""
    ring, values, k = context.robot.ring, context.values, q.index - 1
    names = [body.name for body in context.robot.bodies]
    shifts = {tuple(row[k] for row in values[f"Jv{name}"].rows) for name in names}
    turned = [row[k] for name in names if f"Jw{name}" in values.rules for row in values[f"Jw{name}"].rows]
    if len(shifts) != 1 or not all(entry.is_zero for entry in turned):
        return ""
    units = {tuple(ring.one if i == j else ring.zero for i in range(3)): "xyz"[j] for j in range(3)}
    return units.get(next(iter(shifts)), "")


def _stands_above(context: Context, q: Coordinate) -> bool:
    """Whether the equation that is referred to is the momentum as it would be written here."""
    from_lagrangian = context.robot.questions.method is Method.LAGRANGE
    return from_lagrangian and context.is_short and cost(context.form(f"dLdqd{q.index}")) <= LONGEST


def _written(context: Context, q: Coordinate) -> Node:
    """A momentum: its formula, or the entries of D times the rates where that is long."""
    form = context.form(f"dLdqd{q.index}")
    if cost(form) <= LONGEST:
        return context.named(form)
    row, k = context.values["D"].rows[q.index - 1], q.index
    coupled = [other for other in context.robot.coordinates if not row[other.index - 1].is_zero]
    return sum_of([Product((letters.entry("d", k, j.index), letters.velocity(j))) for j in coupled])


# -- on what D depends: a joint moves what comes after it as one body, and changes no inertia of it


def dependence_step(context: Context) -> Step | None:
    """The coordinates that no entry may depend on, and the entry that is constant."""
    robot = context.robot
    if not is_carried_along(context) or robot.actions.rotors:
        return None
    k = robot.coordinates[-1].index
    form = context.show(context.values["D"][k - 1, k - 1])
    why = say(
        "A joint moves all links after it like one body. So no $d_jk$ depends on $q_i$ where $i ≤ j$ and "
        "$i ≤ k$. {last}",
        last=on_last_entry(context),
    )
    title = "Check: on what the inertia matrix depends"
    if context.is_in_letters:  # that was said of the Christoffel symbols
        title = "Check: the last entry of the inertia matrix"
    return Step(
        id="dependence",
        title=title,
        why=on_last_entry(context) if context.is_in_letters else why,
        source=spong("7.2"),
        result=(equation(letters.entry("d", k, k), form),) if cost(form) <= LONGEST else (),
        outcome=why,
        is_task=False,
    )


def on_last_entry(context: Context) -> Prose:
    """What the last entry of the diagonal is."""
    last = context.robot.coordinates[-1]
    ((joint, _),) = context.robot.joints_of(last)
    return say(
        "{entry} is constant: of all that joint {joint} moves, it is the {what}.",
        entry=letters.entry("d", last.index, last.index),
        joint=context.robot.number_of(joint),
        what="moment of inertia about its axis" if turns(last) else "mass",
    )


def is_carried_along(context: Context) -> bool:
    """Whether no d_jk depends on q_i with i ≤ j, k: the inertia of a chain about its own joints."""
    robot, D = context.robot, context.values["D"]
    if robot.is_tree or not robot.has_table or not robot.moves_each_joint_alone:
        return False
    return all(robot.ring.diff(D[j, k], i).is_zero for j, k in pairs(robot.n) for i in range(j + 1))
