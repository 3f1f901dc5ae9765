"""Steps of what acts beside gravity: the energies of springs and rotors, and friction.

The stages that they belong to, `energy`, `torque` and `vectorized`, put them in their place.
"""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction
from typing import Any

from msgspec.structs import replace

from dynsolve.algebra.matrix import Matrix
from dynsolve.algebra.ring import Expr
from dynsolve.derivation import actions
from dynsolve.derivation.kinematics import frame_names
from dynsolve.document import Inline, Prose
from dynsolve.document.books import siciliano, spong
from dynsolve.document.sentences import opened, say
from dynsolve.explain.context import Context
from dynsolve.explain.step import NOTED, WORKED, Detail, Part, Step
from dynsolve.explain.working.identities import product_named
from dynsolve.explain.writing import (
    agreeing,
    and_joined,
    counted_sum,
    is_small,
    listed,
    measured,
    name_of,
    side_by_side,
    sum_of,
)
from dynsolve.notation import tree
from dynsolve.notation.build import number_in_front, times, total
from dynsolve.notation.template import formula
from dynsolve.notation.tree import (
    ZERO,
    Negative,
    Node,
    Number,
    Product,
    Row,
    Sum,
    Symbol,
    Transpose,
    Words,
    equation,
)
from dynsolve.quantities import letters
from dynsolve.robot import units
from dynsolve.robot.actions import part
from dynsolve.robot.model import Act, Body, Resisting, Robot, Rotor, Stored
from dynsolve.robot.shapes import AXES


def half_square(factor: Node, of: Node) -> Node:
    """½ factor of²"""
    return formula("½ {a} ({x})²" if isinstance(of, Sum) else "½ {a} {x}²", a=factor, x=of)


def halved_square(context: Context, factor: Expr, of: Node) -> Node:
    """The same as a result: of a whole number half of it, 2ẏ² of 4."""
    if factor.is_number and factor.number.denominator == 1:
        half, decimal = Fraction(factor.number) / 2, context.robot.has_decimals
        return number_in_front(times(half, [(of, 2)], decimal=decimal and half.numerator != 1))
    return half_square(context.show(factor), of)


def _kinds(context: Context, term: type[Act]) -> list[tuple[Any, list[Any]]]:
    """What is told of each kind of a term (`acts/<kind>/explain.py`), with those that act."""
    by_kind = context.robot.actions.by_kind
    return [(part(kind, "explain"), acts) for kind, acts in by_kind.items() if isinstance(acts[0], term)]


def said_of_laws(robot: Robot, what: str) -> str:
    """A sentence of each kind of which one acts along a form, not by an energy that is given."""
    kinds = dict.fromkeys(act.kind for act in robot.actions.stored if act.along)
    return " ".join(filter(None, (getattr(part(kind, "explain"), what, "") for kind in kinds)))


# -- what stores energy ----------------------------------------------------------------------------


def stored_steps(context: Context) -> Iterator[Step]:
    """The potential energy of the springs, where there are any."""
    kinds, stored = _kinds(context, Stored), context.robot.actions.stored
    if not stored:
        return
    terms = [told.term(context, act) for told, acts in kinds for act in acts]
    has_law = any(term is not None for term in terms)
    shown = [
        term or number_in_front(context.show(act.energy)) for term, act in zip(terms, stored, strict=True)
    ]
    hint = said_of_laws(context.robot, "HINT")
    yield Step(
        id="Ps",
        title=f"Potential energy of the spring{'s' if len(stored) > 1 else ''}",
        why=(" ".join(told.why(acts) for told, acts in kinds),),
        formula=equation(letters.PS, sum_of(shown)) if has_law or len(shown) > 1 else None,
        source=siciliano("7.1.2"),
        result=(equation(letters.PS, context.form("Ps")),),
        hint=(hint,) if hint else (),
    )


# -- rotors ----------------------------------------------------------------------------------------


def rotor_steps(context: Context) -> Iterator[Step]:
    """The kinetic energy of the rotors, where there are any."""
    motors = context.robot.actions.rotors
    if not motors:
        return
    carried = [motor for motor in motors if motor.carrier]
    geared = any(motor.ratio != context.robot.ring.one for motor in motors)
    several = "s" if len(motors) > 1 else ""
    turned = formula("k_r_i q̇_k" if geared else "q̇_k")
    if carried:
        turned = Sum((turned, Product((Transpose(letters.bold("z")), letters.bold("omega", Words("link"))))))
    turns = [(motor, *_turned(context, motor)) for motor in motors]
    energies = [
        halved_square(context, motor.inertia, total([spin, context.show(with_link)]))
        for motor, spin, with_link in turns
    ]
    is_sum = geared or carried
    energy = formula("½ I_m_i ({turned})²" if is_sum else "½ I_m_i {turned}²", turned=turned)
    yield Step(
        id="Km",
        title=f"Kinetic energy of the rotor{several}",
        why=say(
            "A rotor turns with the rate of its coordinate $q_k${geared}{carried}. The energy of its "
            "turning is half its moment of inertia, $I_m_i$, times the square of that.",
            geared=say(", times the ratio $k_r_i$ of its gear") if geared else "",
            carried=say("; one that rides on a link turns with that link, too, about its own axis $𝐳$")
            if carried
            else "",
        ),
        formula=equation(letters.KM, counted_sum(energy, letters.COUNT, len(motors)) if several else energy),
        source=siciliano("7.1.1"),
        result=(equation(letters.KM, sum_of(energies)),),
        notes=tuple(_carriers(context)),
        normal=NOTED,
        hint=("Half the moment of inertia of each rotor times the square of all that it turns with.",),
    )


def _turned(context: Context, rotor: Rotor) -> tuple[Node, Expr]:
    """The rate that a rotor turns with on its carrier, as a formula, and what the carrier adds."""
    robot = context.robot
    frames = tuple(context.values[name] for name in frame_names(rotor.carrier))
    row = actions.rotor_turn(robot, rotor, frames) - actions.spin(robot, rotor)
    carried = robot.ring.dot(row.entries, [robot.ring.symbol(name, 1) for name in robot.ring.names])
    rate = Symbol(robot.ring.names[rotor.turns], 1)
    return times(1, [(context.show(rotor.ratio), 1), (rate, 1)]), carried


def rotor_named(robot: Robot, rotor: Rotor) -> Prose:
    """The rotor that drives q₂, one geared to a q₂ without a motor, or that of an angle that is its own."""
    q = robot.coordinates[rotor.turns]
    drives = "geared to" if rotor.turns in robot.actions.passive else "that drives"
    return (f"The rotor {'of' if robot.is_of_motor(q) else drives} ", Symbol(q.name))


def _carriers(context: Context) -> Iterator[Prose]:
    """What link a rotor rides on, and what that turns it with."""
    for motor in context.robot.actions.rotors:
        if motor.carrier:
            axis = letters.bold(AXES[motor.axis], Number(motor.carrier))
            link = letters.bold("omega", Row((Words("link"), Number(motor.carrier))))
            yield say(
                "{rotor} rides on link {link} and spins about {axis}: ${axis}ᵀ {omega} = {carried}$.",
                rotor=rotor_named(context.robot, motor),
                link=motor.carrier,
                axis=axis,
                omega=link,
                carried=context.show(_turned(context, motor)[1]),
            )


def rotor_part_step(context: Context) -> Iterator[Step]:
    """What the rotors add to D, where there are any."""
    if context.robot.actions.rotors:
        quadratic = letters.transposed_product(letters.QD, letters.DM)
        yield Step(
            id="Dm",
            title="What the rotors add to the inertia matrix",
            why=("The factors in ", equation(letters.KM, Product((letters.HALF, quadratic))), "."),
            source=siciliano("7.1.1"),
            result=(equation(letters.DM, context.form("Dm")),),
            uses=("Km",),
            is_task=False,
        )


# -- friction --------------------------------------------------------------------------------------


def friction_steps(context: Context) -> Iterator[Step]:
    """The dissipative terms, where there are any."""
    kinds = _kinds(context, Resisting)
    if not kinds:
        return
    smooth = [(told, act) for told, acts in kinds if hasattr(told, "dissipation") for act in acts]
    squares = [term for told, act in smooth if (term := told.dissipation(context, act))]
    parts: list[Node] = [formula("∂{R}/∂q̇_k", R=letters.DISSIPATION)] if squares else []
    viscosity: Prose = ()
    if squares:
        viscosity = say(
            " Viscous friction and dampers are the slopes of {R}, Rayleigh's dissipation function, in the "
            "rates.",
            R=letters.DISSIPATION,
        )
    beside: Prose = ()
    for told, acts in kinds:
        if hasattr(told, "beside") and (found := told.beside(context, acts)):
            beside, parts = (*beside, *found[0]), [*parts, found[1]]
    yield Step(
        id="friction",
        title="Friction",
        why=say(
            "Friction has no potential energy. It acts against the motion, so it stands on the side of the "
            "inertial forces.{viscosity}{beside}",
            viscosity=viscosity,
            beside=beside,
        ),
        formula=formula("τ_fk = {sum}", sum=sum_of(parts)),
        source=siciliano("7.1.3"),
        working=(equation(letters.DISSIPATION, sum_of(squares)),) if squares else (),
        result=(equation(letters.FRICTION, context.form("friction")),),
        entries=tuple((letters.friction(q.index),) for q in context.robot.coordinates),
        detail=Detail.BRIEF,
    )


def passive_prose(context: Context) -> Prose:
    """That no motor drives some coordinates, so that their generalized forces are 0."""
    passive = [context.robot.coordinates[k] for k in context.robot.actions.passive]
    if not passive:
        return ()
    forces = [equation(letters.force(q), Number(0)) for q in passive]
    names = listed([Symbol(q.name) for q in passive], "or")
    return say(" No motor drives {names}: {forces}.", names=names, forces=side_by_side(forces))


def acting_steps(context: Context) -> tuple[list[Step], list[Step]]:
    """The step of the springs and that of the rotors, where there are any."""
    return list(stored_steps(context)), list(rotor_steps(context))


# -- steps of the potential energy of each body: by its height, or by the vectors ------------------


def potential_steps(context: Context) -> Iterator[Step]:
    """P_i of every body; what gravity is, and which way is up, is told where it is used first.

    Those that stay at the height of the origin are told together, unless there are no others; so are all
    where there is no gravity.
    """
    is_weightless = context.robot.gravity.is_zero
    heavy = [body for body in context.robot.bodies if not body.mass.is_zero]
    along = _along(context)
    level = [body for body in heavy if along and context.values[f"rc{body.name}"][along[0], 0].is_zero]
    level = list(context.robot.bodies) if is_weightless else level[level == heavy :]
    first = next((body for body in heavy if body not in level), None)
    for body in context.robot.bodies:
        if body not in level:
            yield _potential(context, body, tells=body is first)
    if level:
        yield Step(
            id=f"P{level[0].name}",
            title=f"Potential energy of {and_joined([name_of(body) for body in level])}",
            why=("There is no gravity.",)
            if is_weightless
            else say(
                agreeing("{centers} stays|stay at the height of the origin.", len(level)),
                centers=listed([letters.rc(body) for body in level]),
            ),
            source=spong("7.2.3"),
            result=(equation(*(letters.of_body("P", body) for body in level), ZERO),),
            also=tuple(f"P{body.name}" for body in level[1:]),
            uses=tuple(f"rc{body.name}" for body in level),
        )


def _potential(context: Context, body: Body, tells: bool) -> Step:
    P, m, r = letters.of_body("P", body), context.forms.mass(body), letters.rc(body)
    pull = formula("𝐠_0ᵀ {r}", r=r)
    step = Step(
        id=f"P{body.name}",
        title=f"Potential energy of {name_of(body)}",
        formula=None if body.mass.is_zero else equation(P, Negative(Product((m, pull)))),
        source=spong("7.2.3"),
        result=(equation(P, context.form(f"P{body.name}")),),
        normal=WORKED | Part.WHY,
    )
    if body.mass.is_zero:
        why = f"{opened(name_of(body))} has inertia but no mass, so gravity does not act on it."
        return replace(step, why=(why,))
    further = (gravity_given(context),) if tells else ()
    step = replace(step, further=further, normal=step.normal if tells else WORKED)
    gravity = _of_gravity(context) if tells else ()
    along = _along(context)
    if along is None:
        center = context.form(f"rc{body.name}")
        vectors = Product((context.show(body.mass), gravity_row(context).argument, center))
        row = context.robot.gravity.T.scale(-body.mass)
        place, energy = (context.values[f"{name}{body.name}"] for name in ("rc", "P"))
        is_shown = is_small(center)
        return replace(
            step,
            why=(*gravity, "The potential energy is minus the mass times ", pull, "."),
            working=(equation(P, Negative(vectors)),) if is_shown else (),
            concluding=product_named(context, row, place, Matrix.of(energy.ring, [[energy]])) * is_shown,
        )
    i, size, is_up = along
    h, is_named = letters.height(letters.index_of(body.name)), "g" in context.robot.parameters
    g = context.show(size) if is_named or not size.is_number else Symbol("g")
    at: Expr = context.values[f"rc{body.name}"][i, 0]
    value = context.show(size)
    given = [equation(g, measured(value, "m/s²"))] if tells and g != value else ()
    return replace(
        step,
        why=say(
            "{gravity}{h}{what} is {minus}the {entry} entry of {r}.",
            gravity=gravity,
            h=h,
            what=f", the height above the origin of the {context.ground}," if tells else "",
            minus="" if is_up else "minus ",
            entry=("first", "second", "third")[i],
            r=r,
        ),
        formula=formula("{P} = -{m} {pull} = {m} {g} {h}", P=P, m=m, pull=pull, g=g, h=h),
        further=(*further, side_by_side(given)) if given else further,
        working=(equation(h, measured(context.show(at if is_up else -at), "m")),),
    )


def _of_gravity(context: Context) -> Prose:
    """What the vector of gravity is, and which axis points up where one does."""
    axis: Prose = ()
    if along := _along(context):
        i, _, is_up = along
        name: Inline = letters.bold("xyz"[i], Number(0))
        if letters.has_base(context.robot):
            name = letters.bold("xyz"[i], Words("w"))
        elif context.ground != "base":
            name = f"The axis {'xyz'[i]} of the world"
        axis = (name, f" points {'up' if is_up else 'down'}, so ")
    return say(
        "$𝐠_0$ is the acceleration of gravity, which points down ({book} writes a plus, for which the vector "
        "must point up). {axis}",
        book=spong("7.2.3"),
        axis=axis,
    )


def gravity_row(context: Context) -> Transpose:
    """The vector of gravity as the transpose of a row."""
    return Transpose(tree.Matrix((tuple(map(context.show, context.robot.gravity.entries)),)))


def gravity_given(context: Context) -> Node:
    """g₀, with its unit where it is in numbers."""
    row, is_number = gravity_row(context), all(entry.is_number for entry in context.robot.gravity.entries)
    with_unit = Row((row, Words(" "), units.node(units.si(units.ACCELERATION))))
    return equation(letters.GRAVITY, with_unit if is_number else row)


def _along(context: Context) -> tuple[int, Expr, bool] | None:
    """The axis, from 0, along which gravity lies, its size, and whether the axis points up; None of none."""
    along = [(i, entry) for i, entry in enumerate(context.robot.gravity.entries) if not entry.is_zero]
    if len(along) != 1:
        return None
    ((i, entry),) = along
    is_up = leads_with_minus(entry)
    return i, -entry if is_up else entry, is_up


def leads_with_minus(expr: Expr) -> bool:
    """Whether a value is written with a minus: of gravity along an axis, whether that points up."""
    return bool(expr.poly.leading_coefficient() < 0)
