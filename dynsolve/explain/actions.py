"""Steps of what acts beside gravity: the energies of springs and rotors, and friction.

The stages that they belong to, `energy`, `torque` and `vectorized`, put them in their place.
"""

from __future__ import annotations

from collections.abc import Iterator

from msgspec.structs import replace

from dynsolve.algebra.expr import Expr
from dynsolve.algebra.matrix import Matrix
from dynsolve.derivation import actions
from dynsolve.derivation.kinematics import frame_names
from dynsolve.document import Inline, Prose
from dynsolve.document.sentences import opened, say
from dynsolve.explain.context import Context
from dynsolve.explain.step import NOTED, WORKED, Detail, Part, Step
from dynsolve.explain.writing import (
    counted_sum,
    is_small,
    listed,
    measured,
    name_of,
    siciliano,
    side_by_side,
    spong,
    sum_of,
)
from dynsolve.notation import tree
from dynsolve.notation.build import negated, times, total
from dynsolve.notation.template import formula
from dynsolve.notation.tree import (
    Negative,
    Node,
    Number,
    Power,
    Product,
    Row,
    Sum,
    Symbol,
    Transpose,
    Words,
    equation,
    walk,
)
from dynsolve.quantities import letters
from dynsolve.robot.actions import Elastic, Motor
from dynsolve.robot.model import Body, Coordinate
from dynsolve.robot.shapes import AXES


def _half_square(factor: Node, of: Node) -> Node:
    """½ factor of²"""
    return formula("½ {a} ({x})²" if isinstance(of, Sum) else "½ {a} {x}²", a=factor, x=of)


# -- springs ---------------------------------------------------------------------------------------


def spring_steps(context: Context) -> Iterator[Step]:
    """The potential energy of the springs, where there are any."""
    springs = context.robot.actions.springs
    if not springs:
        return
    laws = [spring.law for spring in springs if spring.law]
    several = "s" if len(springs) > 1 else ""
    if not laws:
        why = "The energies are given." if several else "The energy of the spring is given."
    else:
        why = "A linear spring stores half its stiffness times the square of its deflection from rest."
        why += " The other energies are given." if len(laws) < len(springs) else ""
    terms = [
        _stretched(context, spring.law) if spring.law else context.show(spring.energy) for spring in springs
    ]
    hint = "Half the stiffness times the square of the deflection of each spring from its rest."
    yield Step(
        id="Ps",
        title=f"Potential energy of the spring{several}",
        why=(why,),
        formula=equation(letters.PS, sum_of(terms)) if laws else None,
        source=siciliano("7.1.2"),
        result=(equation(letters.PS, context.form("Ps")),),
        hint=(hint,) if laws else (),
    )


def _stretched(context: Context, law: Elastic) -> Node:
    """½ k (x - rest)², the deflection with the terms in the order that they have in the sum of all."""
    squares = (one for one in walk(context.form("Ps")) if isinstance(one, Power))
    sums = [one.base for one in squares if isinstance(one.base, Sum)]
    for sign in (1, -1):
        shown = context.show((law.of - law.rest) * sign)
        for base in sums:
            if isinstance(shown, Sum) and set(base.terms) == set(shown.terms):
                return _half_square(context.show(law.stiffness), base)
    stretch = total([context.show(law.of), negated(context.show(law.rest))])
    return _half_square(context.show(law.stiffness), stretch)


# -- rotors ----------------------------------------------------------------------------------------


def rotor_steps(context: Context) -> Iterator[Step]:
    """The kinetic energy of the rotors, where there are any."""
    motors = context.robot.actions.motors
    if not motors:
        return
    carried = [motor for motor in motors if motor.carrier]
    geared = any(motor.ratio != context.robot.ring.one for motor in motors)
    several = "s" if len(motors) > 1 else ""
    turned = formula("k_r_i q̇_k" if geared else "q̇_k")
    if carried:
        turned = Sum((turned, Product((Transpose(letters.bold("z")), letters.bold("omega", Words("link"))))))
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
        working=(equation(letters.KM, sum_of([_energy(context, motor) for motor in motors])),),
        result=(equation(letters.KM, context.form("Km")),),
        notes=tuple(_carriers(context)),
        normal=NOTED,
        hint=("Half the moment of inertia of each rotor times the square of all that it turns with.",),
    )


def _turned(context: Context, motor: Motor) -> tuple[Node, Expr]:
    """The rate that a rotor turns with on its carrier, as a formula, and what the carrier adds."""
    robot = context.robot
    frames = tuple(context.values[name] for name in frame_names(motor.carrier))
    row = actions.rotor_turn(robot, motor, frames) - actions.spin(robot, motor)
    carried = robot.ring.dot(row.entries, [robot.ring.symbol(name, 1) for name in robot.ring.names])
    rate = Symbol(robot.ring.names[motor.turns], 1)
    return times(1, [(context.show(motor.ratio), 1), (rate, 1)]), carried


def _energy(context: Context, motor: Motor) -> Node:
    spin, carried = _turned(context, motor)
    return _half_square(context.show(motor.inertia), total([spin, context.show(carried)]))


def _carriers(context: Context) -> Iterator[Prose]:
    """What link a rotor rides on, and what that turns it with."""
    for place, motor in enumerate(context.robot.actions.motors, 1):
        if motor.carrier:
            axis = letters.bold(AXES[motor.axis], Number(motor.carrier))
            link = letters.bold("omega", Row((Words("link"), Number(motor.carrier))))
            yield say(
                "Motor {place} rides on link {link} and spins about {axis}: ${axis}ᵀ {omega} = {carried}$.",
                place=place,
                link=motor.carrier,
                axis=axis,
                omega=link,
                carried=context.show(_turned(context, motor)[1]),
            )


def rotor_part_step(context: Context) -> Iterator[Step]:
    """What the rotors add to D, where there are any."""
    if context.robot.actions.motors:
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
    robot = context.robot
    if "friction" not in robot.actions.kinds:
        return
    viscous = [one for one in robot.actions.friction if not one.viscous.is_zero]
    sliding = [one for one in robot.actions.friction if not one.coulomb.is_zero]
    parts: list[Node] = []
    viscosity: Prose = ()
    coulomb: Prose = ()
    if viscous or robot.actions.dampers:
        viscosity = say(
            " Viscous friction and dampers are the slopes of {R}, Rayleigh's dissipation function, in the "
            "rates.",
            R=letters.DISSIPATION,
        )
        parts.append(formula("∂{R}/∂q̇_k", R=letters.DISSIPATION))
    if sliding:
        coulomb = say(
            " Coulomb friction, of {which}, has the size of its coefficient, $f_ck$, and the sign of the "
            "rate; at rest sgn is 0.",
            which=listed([Symbol(robot.ring.names[one.coordinate]) for one in sliding]),
        )
        parts.append(formula("f_ck sgn q̇_k"))
    yield Step(
        id="friction",
        title="Friction",
        why=say(
            "Friction has no potential energy. It acts against the motion, so it stands on the side of the "
            "inertial forces, with the sign of the rate.{viscosity}{coulomb}",
            viscosity=viscosity,
            coulomb=coulomb,
        ),
        formula=formula("τ_fk = {sum}", sum=sum_of(parts)),
        source=siciliano("7.1.3"),
        working=tuple(_dissipation(context)),
        result=(equation(letters.FRICTION, context.form("friction")),),
        entries=tuple((letters.friction(q.index),) for q in robot.coordinates),
        detail=Detail.BRIEF,
    )


def _dissipation(context: Context) -> Iterator[Node]:
    """ℛ = ½ Σ f_v q̇² + ½ Σ b ẋ²"""
    robot = context.robot
    terms: list[Node] = []
    for one in robot.actions.friction:
        if not one.viscous.is_zero:
            rate = Symbol(robot.ring.names[one.coordinate], 1)
            terms.append(_half_square(context.show(one.viscous), rate))
    for damper in robot.actions.dampers:
        stretching = context.show(robot.ring.time_derivative(damper.of))
        terms.append(_half_square(context.show(damper.damping), stretching))
    if terms:
        yield equation(letters.DISSIPATION, sum_of(terms))


def in_recursions(context: Context, q: Coordinate) -> tuple[Prose, list[Node]]:
    """What is said of rotors, springs and friction of a coordinate, and their terms of its force.

    Beside what the joint holds stand k_r I (k_r q̈ + zᵀω̇) of each rotor that it turns, ∂P_s/∂q and friction.
    """
    robot, k = context.robot, q.index - 1
    why = ""
    terms: list[Node] = []
    for motor in robot.actions.motors:
        if motor.turns == k:
            why += " It also drives the rotor, through its gear."
            dw = context.values[f"wdl{motor.carrier}"] if motor.carrier else None
            terms.append(context.show(actions.rotor_drive(robot, motor, dw) * motor.ratio))
    if robot.actions.springs and not robot.ring.diff(context.values["Ps"], k).is_zero:
        why += " Springs are held."
        terms.append(letters.partial_derivative(letters.PS, Symbol(q.name)))
    if context.has_friction(k):
        why += " Friction is overcome."
        terms.append(letters.friction(q.index))
    return (why,) if why else (), terms


def rotor_moments(context: Context, link: int) -> Iterator[tuple[Node, Matrix]]:
    """What each rotor that rides on a link takes from it, a moment, with its value."""
    for place, motor in enumerate(context.robot.actions.motors, 1):
        if motor.carrier == link:
            w, dw = context.values[f"wl{link}"], context.values[f"wdl{link}"]
            name = letters.bold("n", Row((Words("m"), Number(place))))
            yield name, actions.rotor_moment(context.robot, motor, w, dw)


def passive_prose(context: Context) -> Prose:
    """That no motor drives some coordinates, so that their generalized forces are 0."""
    passive = [context.robot.coordinates[k] for k in context.robot.actions.passive]
    if not passive:
        return ()
    forces = [equation(letters.force(q), Number(0)) for q in passive]
    names = listed([Symbol(q.name) for q in passive])
    return say(" No motor drives {names}: {forces}.", names=names, forces=side_by_side(forces))


def acting_steps(context: Context) -> tuple[list[Step], list[Step]]:
    """The step of the springs and that of the rotors, where there are any."""
    return list(spring_steps(context)), list(rotor_steps(context))


# -- steps of the potential energy of each body: by its height, or by the vectors ------------------


def potential_steps(context: Context) -> Iterator[Step]:
    """P_i of every body; what gravity is, and which way is up, is told where it is used first."""
    heavy = [body for body in context.robot.bodies if not body.mass.is_zero]
    for body in context.robot.bodies:
        yield _potential(context, body, tells=heavy[:1] == [body])


def _potential(context: Context, body: Body, tells: bool) -> Step:
    P, m, r = letters.of_body("P", body), context.mass(body), letters.rc(body)
    pull = formula("𝐠_0ᵀ {r}", r=r)
    step = Step(
        id=f"P{body.name}",
        title=f"Potential energy of {name_of(body)}",
        formula=equation(P, Negative(Product((m, pull)))),
        source=spong("7.2.3"),
        result=(equation(P, context.form(f"P{body.name}")),),
        normal=WORKED | Part.WHY,
    )
    if context.robot.gravity.is_zero:
        return replace(step, why=("There is no gravity.",), said="no gravity")
    further = (equation(letters.GRAVITY, gravity_row(context)),) if tells else ()
    normal = step.normal if tells or body.mass.is_zero else WORKED
    step = replace(step, further=further, normal=normal)
    if body.mass.is_zero:
        why = f"{opened(name_of(body))} has inertia but no mass, so gravity does not act on it."
        return replace(step, why=(why,))
    gravity = _of_gravity(context) if tells else ()
    along = _along(context)
    if along is None:
        center = context.form(f"rc{body.name}")
        vectors = Product((context.show(body.mass), gravity_row(context).argument, center))
        return replace(
            step,
            why=(*gravity, "Minus the mass times ", pull, "."),
            working=(equation(P, Negative(vectors)),) if is_small(center) else (),
        )
    i, size, is_up = along
    h, g = letters.height(letters.index_of(body.name)), _acceleration(context, size)
    at: Expr = context.values[f"rc{body.name}"][i, 0]
    named = [(m, context.show(body.mass), "kg"), *([(g, context.show(size), "m/s²")] if tells else [])]
    given = [equation(letter, measured(value, unit)) for letter, value, unit in named if letter != value]
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
        working=(equation(h, context.show(at if is_up else -at)),),
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


def _along(context: Context) -> tuple[int, Expr, bool] | None:
    """The axis, from 0, along which gravity lies, its size, and whether the axis points up; None of none."""
    along = [(i, entry) for i, entry in enumerate(context.robot.gravity.entries) if not entry.is_zero]
    if len(along) != 1:
        return None
    ((i, entry),) = along
    is_up = leads_with_minus(entry)
    return i, -entry if is_up else entry, is_up


def _acceleration(context: Context, size: Expr) -> Node:
    """The size of gravity along its axis: the problem's symbol, g for a number."""
    named = "g" in context.robot.parameters
    return context.show(size) if named or not size.is_number else Symbol("g")


def leads_with_minus(expr: Expr) -> bool:
    """Whether a value is written with a minus: of gravity along an axis, whether that points up."""
    return bool(expr.poly.leading_coefficient() < 0)
