"""What is conserved: the energy, and the momenta of cyclic coordinates (Goldstein 2.6)."""

from __future__ import annotations

from dynsolve.derivation.jacobian import joint_frame
from dynsolve.document import Prose, Reference
from dynsolve.explain.context import Context
from dynsolve.explain.forms import pairs
from dynsolve.explain.step import Line, Step
from dynsolve.explain.terms import driving_row, driving_side, has_friction
from dynsolve.explain.writing import listed, spong, sum_of, turns
from dynsolve.notation.build import cost
from dynsolve.notation.tree import (
    Letter,
    Negative,
    Node,
    Number,
    Parenthesized,
    Product,
    Relation,
    Row,
    Sum,
    Symbol,
    Transpose,
    equation,
)
from dynsolve.quantities import letters
from dynsolve.quantities.stages import Stage
from dynsolve.robot.model import Coordinate
from dynsolve.robot.questions import Method

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
    by: Prose = energy.by if energy else ()
    momenta = [equation(_momentum(q), _written(context, q)) for q in free if not _stands_above(context, q)]
    of_momenta = (*_of_momenta(context, free), " conserved:") if momenta else _conserved(context, free)
    return Step(
        id="conserved",
        stage=Stage.VECTORIZED,
        title="Check: what is conserved",
        why=by or of_momenta,
        source=spong("7.1"),
        lines=(Line((), energy.formulas),) if energy else (),
        concluding=(*_of_power(context), *of_momenta) if energy else (),
        result=tuple(momenta),
        outcome=(*(_of_power(context) if energy else ()), *_conserved(context, free)),
        is_task=False,
    )


def _conserved(context: Context, free: list[Coordinate]) -> Prose:
    """Which momenta are conserved, without what they are."""
    return (*_of_momenta(context, free), " conserved.") if free else ()


# -- the energy ------------------------------------------------------------------------------------


def _of_energy(context: Context) -> Line | None:
    """d/dt (K + P) = q̇ᵀ (D q̈ + ½ Ḋ q̇ + g) = q̇ᵀ (D q̈ + C q̇ + g + ½ N q̇) = q̇ᵀ τ, of energies."""
    asked = context.robot.questions
    if context.robot.given is not None or asked.method is not Method.LAGRANGE or asked.constraints:
        return None
    half, N, rate_of_inertia = letters.HALF, letters.bold("N"), letters.bold("D", dots=1)
    inertial, coriolis = Product((letters.D, letters.QDD)), Product((letters.C, letters.QD))
    acting = sum_of(_acting(context))
    powers = [
        Sum((inertial, Product((half, rate_of_inertia, letters.QD)), letters.G)),
        Sum((inertial, coriolis, letters.G, Product((half, N, letters.QD)))),
        acting,
    ]
    rate = letters.time_derivative(Sum((letters.K, letters.P)))
    kinetic = equation(letters.K, Product((half, letters.transposed_product(letters.QD, letters.D))))
    slope = equation(letters.G, letters.partial_derivative(letters.P, letters.Q))
    splitting = equation(rate_of_inertia, Sum((Product((Number(2), letters.C)), N)))
    by: Prose = (
        "The rate of the energy follows from ",
        kinetic,
        " (",
        letters.D,
        " is symmetric) and ",
        slope,
    )
    by += (", with ", splitting, ", ")
    by += (equation(Sum((inertial, coriolis, letters.G)), acting), " and ")
    by += (
        equation(letters.transposed_product(letters.QD, N), Number(0)),
        Reference(("skew-2",), " by "),
        ":",
    )
    return Line(by, (equation(rate, *map(_power, powers)),))


def _acting(context: Context) -> list[Node]:
    """τ, the forces from outside and friction, as they stand beside D q̈ + C q̇ + g."""
    driving = driving_side(context)
    terms: list[Node] = [*(driving.terms if isinstance(driving, Sum) else (driving,))]
    return [*terms, Negative(letters.FRICTION)] if has_friction(context) else terms


def _power(force: Node) -> Product:
    """q̇ᵀ times a force"""
    return Product((Transpose(letters.QD), Parenthesized(force) if isinstance(force, Sum) else force))


def _of_power(context: Context) -> Prose:
    """What changes the energy."""
    driving = driving_side(context)
    said: Prose = ("The energy changes by the power of ", driving)
    if has_friction(context):
        return (*said, " and of friction, which takes energy away. ")
    zero = equation(driving, letters.bold("0"))
    return (*said, " alone: as long as ", zero, " it is conserved. ")


# -- momenta ---------------------------------------------------------------------------------------


def _cyclic(context: Context) -> list[Coordinate]:
    """The coordinates that stand neither in L nor in friction, on which no friction acts."""
    values = context.values
    return [
        q
        for q in context.robot.coordinates
        if values[f"dLdq{q.index}"].is_zero
        and ("friction" not in values.rules or values["friction"][q.index - 1, 0].is_zero)
    ]


def _momentum(q: Coordinate) -> Node:
    return letters.partial_derivative(letters.L, letters.velocity(q))


def _of_momenta(context: Context, free: list[Coordinate]) -> Prose:
    """Which momenta stay constant as long as nothing acts on them, and what these are."""
    one = len(free) == 1
    why: Prose = (*listed([Symbol(q.name) for q in free]), f" {'does' if one else 'do'} not appear in ")
    why += (letters.L, f": {'a cyclic coordinate' if one else 'cyclic coordinates'}. As long as ")
    why += (
        *listed([equation(driving_row(context, q), Number(0)) for q in free]),
        ", the Euler-Lagrange equation",
    )
    why += (" says" if one else "s say", f" that the {'momentum' if one else 'momenta'} ")
    why += (
        *listed([(_momentum(q), Reference((f"dLdqd{q.index}",), " in "), *_named(context, q)) for q in free]),
        " is" if one else " are",
    )
    return why


def _named(context: Context, q: Coordinate) -> Prose:
    """What the momentum is of a coordinate that moves one joint, or shifts all bodies alike."""
    robot = context.robot
    if robot.actions.motors:
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
    axis = letters.z(joint_frame(robot, joint))
    if is_first:
        return (f" (the {kind} momentum of the {context.machine} {where} ", axis, ")")
    return (f" (the {kind} momentum {where} ", axis, f" of all that joint {joint.index} moves)")


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
        return form
    row, k = context.values["D"].rows[q.index - 1], q.index
    coupled = [other for other in context.robot.coordinates if not row[other.index - 1].is_zero]
    return sum_of([Product((letters.entry("d", k, j.index), letters.velocity(j))) for j in coupled])


# -- on what D depends: a joint moves what comes after it as one body, and changes no inertia of it


def dependence_step(context: Context) -> Step | None:
    """The coordinates that no entry may depend on, and the entry that is constant."""
    robot = context.robot
    if not is_carried_along(context) or robot.actions.motors:
        return None
    last = robot.coordinates[-1]
    entry = letters.entry("d", last.index, last.index)
    value = context.values["D"][last.index - 1, last.index - 1]
    form = context.show(value)
    why = (*on_carried_links(), *on_last_entry(context))
    return Step(
        id="dependence",
        stage=Stage.VECTORIZED,
        title="Check: on what the inertia matrix depends",
        why=why,
        source=spong("7.2"),
        result=(equation(entry, form),) if cost(form) <= LONGEST else (),
        outcome=why,
        is_task=False,
    )


def on_carried_links() -> Prose:
    """Which entries do not depend on which coordinates, and why."""
    j, k, i = (Symbol(name) for name in "jki")
    within = (Relation((i, other), ("≤",)) for other in (j, k))
    return (
        "Joint i moves the links from ",
        i,
        " on like one body. So no ",
        Letter("d", Row((j, k))),
        " depends on ",
        Letter("q", i),
        " where ",
        *listed(list(within)),
        ". ",
    )


def on_last_entry(context: Context) -> Prose:
    """What the last entry of the diagonal is."""
    last = context.robot.coordinates[-1]
    what = "moment of inertia about its axis" if turns(last) else "mass"
    entry = letters.entry("d", last.index, last.index)
    return (entry, f" is constant: of all that joint {last.index} moves, it is the {what}.")


def is_carried_along(context: Context) -> bool:
    """Whether no d_jk depends on q_i with i ≤ j, k: the inertia of a chain about its own joints."""
    robot, D = context.robot, context.values["D"]
    if robot.is_tree or not robot.has_table or not robot.moves_each_joint_alone:
        return False
    return all(robot.ring.diff(D[j, k], i).is_zero for j, k in pairs(robot.n) for i in range(j + 1))
