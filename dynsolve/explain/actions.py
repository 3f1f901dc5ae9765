"""Steps of what acts beside gravity: the energies of springs and rotors, and friction.

The stages that they belong to, `energy`, `torque` and `vectorized`, put them in their place.
"""

from __future__ import annotations

from collections.abc import Iterator

from dynsolve.algebra.expr import Expr
from dynsolve.algebra.matrix import Matrix
from dynsolve.derivation import actions
from dynsolve.derivation.kinematics import frame_names
from dynsolve.document import Inline, Prose
from dynsolve.explain.context import Context
from dynsolve.explain.step import NOTED, WORKED, Detail, Part, Step
from dynsolve.explain.writing import (
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
from dynsolve.notation.tree import (
    BigSum,
    Function,
    Letter,
    Negative,
    Node,
    Number,
    Parenthesized,
    Power,
    Product,
    Row,
    Sum,
    Symbol,
    Transpose,
    Words,
    equation,
)
from dynsolve.quantities import letters
from dynsolve.quantities.stages import Stage
from dynsolve.robot.actions import Elastic, Motor
from dynsolve.robot.model import Body, Coordinate
from dynsolve.robot.shapes import AXES

_K = Symbol("k")


def _square(node: Node) -> Node:
    return Power(Parenthesized(node) if isinstance(node, Sum) else node, Number(2))


# -- springs ---------------------------------------------------------------------------------------


def spring_steps(context: Context) -> Iterator[Step]:
    """The potential energy of the springs, where there are any."""
    springs = context.robot.actions.springs
    if not springs:
        return
    laws = [spring.law for spring in springs if spring.law]
    why: Prose = ("A linear spring stores half its stiffness times the square of its deflection from rest.",)
    if not laws:
        why = ("The energy of the spring is given." if len(springs) == 1 else "The energies are given.",)
    elif len(laws) < len(springs):
        why += (" The other energies are given.",)
    terms = [
        _stretched(context, spring.law) if spring.law else context.show(spring.energy) for spring in springs
    ]
    yield Step(
        id="Ps",
        stage=Stage.ENERGY,
        title="Potential energy of the springs" if len(springs) > 1 else "Potential energy of the spring",
        why=why,
        formula=equation(letters.PS, sum_of(terms)) if laws else None,
        source=siciliano("7.1.2"),
        result=(equation(letters.PS, context.form("Ps")),),
        hint=("Half the stiffness times the square of the deflection of each spring from its rest.",)
        if laws
        else (),
    )


def _stretched(context: Context, law: Elastic) -> Node:
    """½ k (x - rest)², as the problem has it."""
    stretch = total([context.show(law.of), negated(context.show(law.rest))])
    return Product((letters.HALF, context.show(law.stiffness), _square(stretch)))


# -- rotors ----------------------------------------------------------------------------------------


def rotor_steps(context: Context) -> Iterator[Step]:
    """The kinetic energy of the rotors, where there are any."""
    motors = context.robot.actions.motors
    if not motors:
        return
    carried = [motor for motor in motors if motor.carrier]
    geared = any(motor.ratio != context.robot.ring.one for motor in motors)
    why: Prose = (
        "A rotor turns with the rate of the coordinate ",
        Letter("q", _K),
        " that it drives",
    )
    why += (", times the ratio of its gear",) if geared else ()
    why += ("; one that rides on a link is carried round by that link, too",) if carried else ()
    why += (". The energy of its turning is half its moment of inertia times the square of that.",)
    yield Step(
        id="Km",
        stage=Stage.ENERGY,
        title="Kinetic energy of the rotors" if len(motors) > 1 else "Kinetic energy of the rotor",
        why=why,
        formula=equation(letters.KM, _general(len(motors), carried=bool(carried))),
        source=siciliano("7.1.1"),
        working=(equation(letters.KM, sum_of([_energy(context, motor) for motor in motors])),),
        result=(equation(letters.KM, context.form("Km")),),
        notes=tuple(_carriers(context)),
        normal=NOTED,
        hint=("Half the moment of inertia of each rotor times the square of all that it turns with.",),
    )


def _general(motors: int, carried: bool) -> Node:
    """Σ ½ I_m (k_r q̇ + zᵀ ω)² over the motors, of one alone without the sum."""
    i = Symbol("i")
    turned: Node = Product((Letter("k", Letter("r", i)), Letter("q", _K, dots=1)))
    if carried:
        turned = Sum((turned, Product((Transpose(letters.bold("z")), letters.bold("omega", Words("link"))))))
    square = Power(Parenthesized(turned), Number(2))
    energy = Product((letters.HALF, Letter("I", Letter("m", i)), square))
    return energy if motors == 1 else BigSum(energy, i, Number(1), Number(motors))


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
    turned = total([spin, context.show(carried)])
    return Product((letters.HALF, context.show(motor.inertia), _square(turned)))


def _carriers(context: Context) -> Iterator[Prose]:
    """What link a rotor rides on, and what that turns it with."""
    for place, motor in enumerate(context.robot.actions.motors, 1):
        if motor.carrier:
            carried = context.show(_turned(context, motor)[1])
            axis = Letter(AXES[motor.axis], Number(motor.carrier), None, "bold")
            link = Row((Words("link"), Number(motor.carrier)))
            projected = Product((Transpose(axis), letters.bold("omega", link)))
            yield (
                f"Motor {place} rides on link {motor.carrier} and spins about ", axis, ": ",
                equation(projected, carried), ".",
            )  # fmt: skip


def rotor_part_step(context: Context) -> Iterator[Step]:
    """What the rotors add to D, where there are any."""
    if context.robot.actions.motors:
        quadratic = letters.transposed_product(letters.QD, letters.DM)
        yield Step(
            id="Dm",
            stage=Stage.VECTORIZED,
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
    drags = bool(viscous or robot.actions.dampers)
    why: Prose = ("Friction has no potential energy. It acts against the motion, so it stands on the side "
                  "of the inertial forces, with the sign of the rate.",)  # fmt: skip
    parts: list[Node] = []
    if drags:
        why += (" Viscous friction and dampers are the slopes of ", letters.DISSIPATION,
                ", Rayleigh's dissipation function, in the rates.")  # fmt: skip
        parts.append(letters.partial_derivative(letters.DISSIPATION, Letter("q", _K, dots=1)))
    if sliding:
        of = [Symbol(robot.ring.names[one.coordinate]) for one in sliding]
        why += (" Coulomb friction, of ", *listed(of), ", has the sign of the rate alone; at rest sgn is 0.")
        sign = Function("sgn", Letter("q", _K, dots=1))
        parts.append(Product((Letter("f", Row((Words("c"), _K))), sign)))
    yield Step(
        id="friction",
        stage=Stage.TORQUE,
        title="Friction",
        why=why,
        formula=equation(Letter("tau", Row((Words("f"), _K))), sum_of(parts)),
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
            terms.append(Product((letters.HALF, context.show(one.viscous), Power(rate, Number(2)))))
    for damper in robot.actions.dampers:
        stretching = context.show(robot.ring.time_derivative(damper.of))
        terms.append(Product((letters.HALF, context.show(damper.damping), _square(stretching))))
    if terms:
        yield equation(letters.DISSIPATION, sum_of(terms))


def in_recursions(context: Context, q: Coordinate) -> tuple[Prose, list[Node]]:
    """What is said of rotors, springs and friction of a coordinate, and their terms of its force.

    Beside what the joint holds stand k_r I (k_r q̈ + zᵀω̇) of each rotor that it turns, ∂P_s/∂q and friction.
    """
    robot, k = context.robot, q.index - 1
    why: list[Inline] = []
    terms: list[Node] = []
    for motor in robot.actions.motors:
        if motor.turns == k:
            why.append(" It also drives the rotor, through its gear.")
            dw = context.values[f"wdl{motor.carrier}"] if motor.carrier else None
            drive = context.show(actions.rotor_drive(robot, motor, dw) * motor.ratio)
            terms.append(drive)
    if robot.actions.springs and not robot.ring.diff(context.values["Ps"], k).is_zero:
        why.append(" Springs are held.")
        terms.append(letters.partial_derivative(letters.PS, Symbol(q.name)))
    if "friction" in context.values.rules and not context.values["friction"][k, 0].is_zero:
        why.append(" Friction is overcome.")
        terms.append(letters.friction(q.index))
    return tuple(why), terms


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
    return (" No motor drives ", *listed([Symbol(q.name) for q in passive]), ": ", side_by_side(forces), ".")


# -- where the steps of springs and rotors are imported: only of robots on which something acts ----


def acting_steps(context: Context) -> tuple[list[Step], list[Step]]:
    """The step of the springs and that of the rotors, where there are any."""
    if not context.robot.actions:
        return [], []

    return list(spring_steps(context)), list(rotor_steps(context))


# -- steps of the potential energy of each body: by its height, or by the vectors ------------------

STAGE = Stage.ENERGY


def potential_steps(context: Context) -> Iterator[Step]:
    """P_i of every body; what gravity is, and which way is up, is told where it is used first."""
    heavy = [body for body in context.robot.bodies if not body.mass.is_zero]
    for body in context.robot.bodies:
        yield _potential(context, body, tells=heavy[:1] == [body])


def _potential(context: Context, body: Body, tells: bool) -> Step:
    P, pull = letters.of_body("P", body), Product((Transpose(letters.GRAVITY), letters.rc(body)))
    parts: tuple[Node, ...] = (P, Negative(Product((context.mass(body), pull))))
    working: tuple[Node, ...] = ()
    numbers: tuple[Node, ...] = ()
    is_pulled = not context.robot.gravity.is_zero
    if not is_pulled:
        why: Prose = ("There is no gravity.",)
    elif body.mass.is_zero:
        why = (f"{name_of(body).capitalize()} has inertia but no mass, so gravity does not act on it.",)
    else:
        why = _of_gravity(context) if tells else ()
        height = _height(context, body)
        if height is None:
            why += ("Minus the mass times ", pull, ".")
            working = _by_vectors(context, body)
        else:
            h, g = letters.height(letters.index_of(body.name)), _acceleration(context)
            why += _entry_of_height(context, body, h, tells)
            parts += (Product((context.mass(body), g, h)),)
            working, numbers = (equation(h, height),), _numbers(context, body, g, tells)
    return Step(
        id=f"P{body.name}",
        stage=STAGE,
        title=f"Potential energy of {name_of(body)}",
        why=why,
        formula=equation(*parts),
        source=spong("7.2.3"),
        further=(
            *((equation(letters.GRAVITY, gravity_row(context)),) if tells and is_pulled else ()),
            *numbers,
        ),
        working=working,
        result=(equation(P, context.form(f"P{body.name}")),),
        said="" if is_pulled else "no gravity",
        normal=WORKED | Part.WHY if tells or not is_pulled or body.mass.is_zero else WORKED,
    )


def _of_gravity(context: Context) -> Prose:
    """What the vector of gravity is, and which axis points up where one does."""
    why: Prose = (
        letters.GRAVITY,
        " is the acceleration of gravity, which points down (",
        spong("7.2.3"),
        " writes a plus, for which the vector must point up). ",
    )
    along = _along(context)
    if along is None:
        return why
    i, entry = along
    axis: Inline = Letter("xyz"[i], Number(0), style="bold")
    if letters.has_base(context.robot):
        axis = letters.bold("xyz"[i], Words("w"))
    elif context.ground != "base":
        axis = f"The axis {'xyz'[i]} of the world"
    return (*why, axis, f" points {'up' if leads_with_minus(entry) else 'down'}, so ")


def _by_vectors(context: Context, body: Body) -> tuple[Node, ...]:
    """-m g_0ᵀ r_c with this robot's vectors."""
    P, center = letters.of_body("P", body), context.form(f"rc{body.name}")
    product = Product((context.show(body.mass), gravity_row(context).argument, center))
    return (equation(P, Negative(product)),) if is_small(center) else ()


def _entry_of_height(context: Context, body: Body, h: Node, tells: bool) -> Prose:
    """Which entry of r_c the height is."""
    along = _along(context)
    assert along is not None
    i, entry = along
    what = f", the height above the origin of the {context.ground}," if tells else ""
    minus = "" if leads_with_minus(entry) else "minus "
    return (h, f"{what} is {minus}the {('first', 'second', 'third')[i]} entry of ", letters.rc(body), ".")


def _numbers(context: Context, body: Body, g: Node, tells: bool) -> tuple[Node, ...]:
    """What the mass is, and g of the first body, where they are numbers: m_1 = 2.5 kg, g = 9.81 m/s²."""
    (entry,) = (entry for entry in context.robot.gravity.entries if not entry.is_zero)
    size = context.show(-entry if leads_with_minus(entry) else entry)
    named = [(context.mass(body), context.show(body.mass), "kg"), *([(g, size, "m/s²")] if tells else [])]
    given = [equation(letter, measured(value, unit)) for letter, value, unit in named if letter != value]
    return (side_by_side(given),) if given else ()


def gravity_row(context: Context) -> Transpose:
    """The vector of gravity as the transpose of a row."""
    return Transpose(tree.Matrix((tuple(map(context.show, context.robot.gravity.entries)),)))


def _along(context: Context) -> tuple[int, Expr] | None:
    """The axis, from 0, along which gravity lies, and its entry there; None where it lies along none."""
    along = [(i, entry) for i, entry in enumerate(context.robot.gravity.entries) if not entry.is_zero]
    return along[0] if len(along) == 1 else None


def _height(context: Context, body: Body) -> Node | None:
    """The height of the mass centre, where gravity lies along an axis of the base."""
    along = _along(context)
    if along is None:
        return None
    i, entry = along
    center: Expr = context.values[f"rc{body.name}"][i, 0]
    return context.show(center if leads_with_minus(entry) else -center)


def _acceleration(context: Context) -> Node:
    """The size of gravity along its axis: the problem's symbol, g for a number."""
    (entry,) = (entry for entry in context.robot.gravity.entries if not entry.is_zero)
    size = context.show(-entry if leads_with_minus(entry) else entry)
    named = "g" in context.robot.parameters
    return size if named or not entry.is_number else Symbol("g")


def leads_with_minus(expr: Expr) -> bool:
    """Whether a value is written with a minus: of gravity along an axis, whether that points up."""
    return bool(expr.poly.leading_coefficient() < 0)
