"""Steps of the energies: P_i, the Jacobians and velocities of each mass centre, K_i, and the totals."""

from __future__ import annotations

from collections.abc import Iterator

from msgspec.structs import asdict, replace

from dynsolve.algebra.angles import name_alone
from dynsolve.derivation.kinematics import joint_frame
from dynsolve.document import Prose
from dynsolve.document.books import spong
from dynsolve.document.sentences import say
from dynsolve.explain.actions import acting_steps, potential_steps
from dynsolve.explain.context import Context
from dynsolve.explain.inertia import axis_named, is_its_links, orientation_named
from dynsolve.explain.jacobian import (
    BESIDE,
    ZERO,
    coordinate_column,
    crosses,
    end_of,
    how_read_off,
    parallel,
    read_off,
    told_read_off,
)
from dynsolve.explain.matrix_factors import factored
from dynsolve.explain.placed_bodies import energy_steps, jacobians_step, total_energy
from dynsolve.explain.step import STATED, WORKED, Detail, Group, Line, Part, Step, outlined
from dynsolve.explain.working.derivatives import summed
from dynsolve.explain.working.rotational import (
    along_own_axes,
    angular_square,
    multiplied_out,
    turned,
    turning_axis,
)
from dynsolve.explain.working.squares import linear, squared, written_velocity
from dynsolve.explain.writing import (
    agreeing,
    are_counted,
    counted_sum,
    is_small,
    listed,
    name_of,
    side_by_side,
    sum_of,
)
from dynsolve.notation.build import split_sign
from dynsolve.notation.template import formula
from dynsolve.notation.tree import (
    Letter,
    Matrix,
    Negative,
    Node,
    Product,
    Relation,
    Sum,
    Symbol,
    column,
    equation,
)
from dynsolve.quantities import letters
from dynsolve.robot.model import Body, Joint


def steps(context: Context) -> Iterator[Step]:
    """The potential energies, then body by body the kinetic ones, then the total; or those that are given."""
    if context.robot.given is not None:
        yield from energy_steps(context, context.robot.given)
        return
    bodies = context.robot.bodies
    springs, rotors = acting_steps(context)
    total = _total(context, "P", "potential", letters.P, [letters.PS] * len(springs))
    potential = Group("P", "Potential energy")
    for step in (*potential_steps(context), *springs, total):
        yield replace(step, group=potential)
    told, read = False, False
    for body in bodies:
        jacobians = _jacobians(context, body) if context.robot.has_table else jacobians_step(context, body)
        if not read and (way := _read_off(context, body)):
            read, jacobians = True, replace(jacobians, why=(*jacobians.why, *way))
        linear = _linear(context, body, tells=not told)
        told = told or bool(linear.notes)
        group = Group(f"K{body.name}", f"Kinetic energy of {name_of(body)}")
        yield replace(jacobians, group=group, normal=STATED | (Part.WHY if body is bodies[0] else STATED))
        yield replace(_velocities(context, body), group=group, normal=STATED)
        yield replace(linear, group=group)
        yield replace(_rotational(context, body), group=group)
        yield replace(_kinetic(context, body), group=group)
    yield from rotors
    yield _total(context, "K", "kinetic", letters.K, [letters.KM] * len(rotors))


def _total(context: Context, name: str, kind: str, letter: Letter, others: list[Letter]) -> Step:
    """The energy of the bodies, and of the springs or rotors where there are any."""
    bodies = context.robot.bodies
    parts, of_body = [letters.of_body(name, body) for body in bodies], _of_body(context, name)
    whole: Node = equation(letter, sum_of([*parts, *others]))
    is_summed = len(bodies) > 1 and not (name == "P" and context.robot.gravity.is_zero)
    is_summed = is_summed and (name == "P" or all(turning_axis(context, body) is None for body in bodies))
    if is_summed and context.are_masses_counted:
        sign, own = split_sign(of_body)
        counted = counted_sum(own, Symbol("i"), len(bodies))
        added = [counted if sign > 0 else Negative(counted), *others]
        whole = equation(letter, sum_of([*parts, *others]), sum_of(added))
    elif is_summed and not are_counted(bodies):
        whole = side_by_side([whole, equation(Letter(name, Symbol("i")), of_body)])
    points = {body.is_point for body in bodies} if is_summed and name == "K" else set()
    who = "That of the body" if others else "There is only one body"
    who = "The sum over the bodies" if len(bodies) > 1 else who
    who += f", and that of the {'springs' if name == 'P' else 'rotors'}" if others else ""
    acting = [name + ("s" if name == "P" else "m")] if others else []
    way = summed(context, [*(name + body.name for body in bodies), *acting], name, letter)
    end, more, notes = total_energy(context, name, way)
    return Step(
        id=name,
        title=f"Total {kind} energy",
        why=(f"{who}.{' A point mass has no second term.' if len(points) > 1 else ''}", *more),
        formula=whole,
        source=spong("7.2.3" if name == "P" else "7.2.2"),
        **asdict(end),
        notes=notes,
        detail=Detail.BRIEF,
        normal=STATED | Part.LINES | Part.CONCLUDING if way.used else STATED,
    )


def _of_body(context: Context, name: str) -> Node:
    """Of body i: -m_i g₀ᵀ r_ci, or ½ m_i v_iᵀ v_i + ½ ω_iᵀ I_i ω_i."""
    if name == "P":
        return formula("-m_i 𝐠_0ᵀ 𝐫_ci")
    extended = [body for body in context.robot.bodies if not body.is_point]
    if not extended:
        return formula("½ m_i {v}", v=formula("𝐯_iᵀ 𝐯_i"))
    return formula("½ m_i {v} + ½ {w}", v=formula("𝐯_iᵀ 𝐯_i"), w=formula("𝛚_iᵀ 𝓘_i 𝛚_i"))


# -- kinetic energy --------------------------------------------------------------------------------


def _jacobians(context: Context, body: Body) -> Step:
    b, robot = body.name, context.robot
    J_v, J_w, center = letters.jv(body), letters.jw(body), context.values[f"rc{body.name}"]
    columns = [
        coordinate_column(context, k, body.link, letters.rc(body)) or (ZERO, ZERO) for k in range(robot.n)
    ]
    late = [Symbol(q.name) for q, (v, _) in zip(robot.coordinates, columns, strict=True) if v == ZERO]
    linear = equation(J_v, Matrix((tuple(v for v, _ in columns),)))
    turning = () if body.is_point else (equation(J_w, Matrix((tuple(w for _, w in columns),))),)
    beside = robot.n <= BESIDE and not any(isinstance(v, Sum) for v, _ in columns)
    working, named = crosses(context, body.link, letters.rc(body), center, context.matrix(f"Jv{b}"))
    results = [equation(J_v, factored(context, context.form(f"Jv{b}")))]
    results += [] if body.is_point else [equation(J_w, factored(context, context.form(f"Jw{b}")))]
    step = Step(
        id=f"Jv{b}",
        title=f"Jacobian{'s' * bool(turning)} of the mass centre of {name_of(body)}",
        why=say(
            "The column of each {moving}, taken at the mass centre{late}.{zero}",
            moving="joint" if robot.moves_each_joint_alone else "coordinate",
            late=say(agreeing("; {q} does|do not move it", len(late)), q=listed(late)) if late else "",
            zero=parallel(context, body.link, letters.rc(body), center) if context.is_short else "",
        ),
        formula=side_by_side([linear, *turning]) if beside else linear,
        source=spong("7.2.2"),
        further=() if beside else turning,
        working=working,
        concluding=named,
        result=tuple(results),
        together=robot.n <= BESIDE and not body.is_point,
        also=(f"Jw{b}",),
        uses=("axes", f"rc{b}"),
    )
    if not _is_at_the_end(context, body):
        return step
    same = [equation(J_v, letters.JV), *([] if body.is_point else [equation(J_w, letters.JW)])]
    return replace(
        step,
        why=say(
            "The mass centre is {end}, ${r} = {o}$, so its Jacobian is known.",
            end=context.end,
            r=letters.rc(body),
            o=letters.o(body.link),
        ),
        formula=side_by_side(same),
        further=(),
        working=(),
        concluding=(),
        uses=("J",),
    )


def _read_off(context: Context, body: Body) -> Prose:
    """How the columns of which no product is shown are read off; nothing where that was told before."""
    joint = _joint_read_off(context, body)
    told = told_read_off(context)
    earlier = context.robot.bodies[: context.robot.bodies.index(body)]
    known = [told[1] if told else None, *(_joint_read_off(context, other) for other in earlier)]
    frames = {joint_frame(context.robot, each) for each in known if each}
    if joint is None or joint_frame(context.robot, joint) in frames:
        return ()
    return say(" {how}.", how=how_read_off(context, joint))


def _joint_read_off(context: Context, body: Body) -> Joint | None:
    """The joint whose column in the Jacobian of a body is a look; none where no such column is told."""
    if not (context.is_short and context.robot.has_table) or _is_at_the_end(context, body):
        return None
    return read_off(context, body.link, context.values[f"rc{body.name}"])


def _is_at_the_end(context: Context, body: Body) -> bool:
    is_last = body.link == len(context.robot.joints)
    return is_last and bool(context.values[f"rc{body.name}"] == end_of(context))


def _velocities(context: Context, body: Body) -> Step:
    b = body.name
    v, w = letters.of_body("v", body, "bold"), letters.of_body("omega", body, "bold")
    results = [equation(v, factored(context, written_velocity(context, body)))]
    formulas: list[Node] = [equation(v, Product((letters.jv(body), letters.QD)))]
    if not body.is_point:
        results.append(equation(w, factored(context, context.form(f"w{b}"))))
        formulas.append(equation(w, Product((letters.jw(body), letters.QD))))
    J, qd = context.form(f"Jv{b}"), column(*(letters.velocity(q) for q in context.robot.coordinates))
    moves = not context.values[f"Jv{b}"].is_zero
    return Step(
        id=f"v{b}",
        title=f"Velocity of {name_of(body)}",
        why=(f"The Jacobian{'s' * (not body.is_point)} times the rates of the coordinates.",),
        formula=side_by_side(formulas),
        source=spong("7.2.2"),
        working=(equation(v, factored(context, Product((J, qd)))),) if moves and is_small(J, qd) else (),
        result=tuple(results),
        together=context.robot.n <= BESIDE,
        also=(f"w{b}",),
    )


def _linear(context: Context, body: Body, tells: bool) -> Step:
    b = body.name
    Kv, v = letters.energy_part("v", body), letters.of_body("v", body, "bold")
    velocity = written_velocity(context, body)
    half = "Half the mass times the square of the speed of the mass centre"
    why, working = f"{half}.", tuple[Node, ...]()
    written: Node | None = Product((letters.HALF, context.forms.mass(body), letters.transposed_product(v)))
    if body.mass.is_zero:
        why, written = "The body has no mass, only inertia.", None
    elif context.values[f"v{b}"].is_zero:
        why = "The mass centre does not move."
    elif is_small(velocity, velocity):
        working = (equation(Kv, squared(context, body)),)
    way = linear(context, body, squares_shown=bool(working))
    afresh = way.frame is not None
    return Step(
        id=f"Kv{b}",
        title=f"Translational kinetic energy of {name_of(body)}",
        why=(why,),
        formula=equation(Kv, written) if written else None,
        source=spong("7.2") if written else "",
        normal=WORKED if way.lines or working else STATED | Part.WHY if written is None else STATED,
        working=() if afresh else working,
        lines=way.lines if afresh else outlined(way.lines),
        concluding=way.concluding,
        uses=(f"H{way.frame}", f"v{b}") if afresh else None,
        result=(equation(Kv, context.form(f"Kv{b}")),),
        notes=tuple(_cancelling(context, body)) if working and tells else (),
        hint=say("{half}: add up the squares of the components of {v}.", half=half, v=v),
    )


def _cancelling(context: Context, body: Body) -> Iterator[Prose]:
    """Where sines and cosines of a joint angle leave the square by s² + c² = 1."""
    ring = context.robot.ring
    energy = context.values[f"Kv{body.name}"]
    entries = [entry.poly.degrees() for entry in context.values[f"v{body.name}"].entries]
    for pair in ring.pairs:
        if len(pair.angle.terms) != 1 or pair.angle.degrees:
            continue
        ((atom, rate),) = pair.angle.terms
        name = name_alone(atom)
        if rate != 1 or name not in ring.names:
            continue
        if not ring.diff(energy, ring.names.index(name)).is_zero:
            continue
        sines, cosines = ([d for d in entries if d[k] > 0] for k in (pair.sine, pair.cosine))  # of 0 -1
        if sines and cosines and (len(sines) > 1 or sines != cosines):
            yield say("The speed does not depend on {angle}.", angle=Symbol(name))
            return


def _kinetic(context: Context, body: Body) -> Step:
    K, b = letters.of_body("K", body), body.name
    way = summed(context, (f"Kv{b}", f"Kw{b}"), f"K{b}", K, stand_above=True)
    parts = [letters.energy_part(kind, body) for kind in ("v", "omega")]
    left = [part for part, kind in zip(parts, "vw", strict=True) if not context.values[f"K{kind}{b}"].is_zero]
    is_one = len(left) == 1 and f"K{b}" not in context.find
    whole = equation(K, sum_of(parts))
    return Step(
        id=f"K{b}",
        title=f"Kinetic energy of {name_of(body)}",
        why=("The sum of the translational and the rotational part.",),
        formula=equation(*whole.parts, *left * is_one),
        task=whole,
        source=spong("7.2"),
        lines=way.lines,
        concluding=way.concluding,
        result=(equation(K, context.form(f"K{b}")),),
        normal=Part.FORMULA if is_one else STATED,  # the one that is not 0 has the same line
    )


def _rotational(context: Context, body: Body) -> Step:
    """K_ω = ½ ωᵀ 𝓘 ω, along the axes of the base or of the body."""
    b = body.name
    Kw, w = letters.energy_part("omega", body), letters.of_body("omega", body, "bold")
    step = Step(
        id=f"Kw{b}",
        title=f"Rotational kinetic energy of {name_of(body)}",
        source=spong("7.2"),
        normal=STATED,
        result=(equation(Kw, context.form(f"Kw{b}")),),
    )
    if body.is_point:
        none = ("A point mass has no rotational energy.",)
        return replace(step, why=none, said="point mass", normal=Part.WHY | Part.RESULT)
    axis = turning_axis(context, body)
    energy = formula("{Kw} = ½ {product}", Kw=Kw, product=angular_square(context, body, w))
    if axis is None:
        why = say("{w} and the tensor, both in {ground} coordinates.", w=w, ground=context.ground)
    else:
        of_body = axis_named(context, body, "xyz"[axis], f"the body's axis {'xyz'[axis]}")
        alone = "{w} is parallel to {axis}, so of the tensor the moment about this axis alone enters."
        why, uses = say(alone, w=w, axis=of_body), (f"v{b}", f"I_body{b}")
        step = replace(step, uses=uses, said=f"turning axis {axis}", normal=STATED | Part.WHY)
    step = replace(step, why=why, hint=why, formula=energy)
    if context.values[f"w{b}"].is_zero:
        return replace(step, why=("The body does not turn.",), normal=STATED | Part.WHY)
    product, way = multiplied_out(context, body)
    working = (product,) if is_small(product) else ()
    step = replace(step, working=working, lines=way.lines, concluding=way.concluding)
    return _turned(context, body, step) if along_own_axes(context, body) else step


def _turned(context: Context, body: Body, step: Step) -> Step:
    """K_ω along the axes of the body: ω is brought there, and the tensor is the given one."""
    tensor, i = letters.tensor(context.robot, body), letters.index_of(body.name)
    own = turned(context, body, "w", letters.of_body("omega", body, "bold"))
    assert isinstance(step.formula, Relation)
    put_in = Line(("The tensor along the body's own axes put in:",), step.working, (f"I_body{body.name}",))
    by_identity = any(isinstance(part, Relation) for part in step.concluding)
    shown = step.lines[-1:] if by_identity else ()
    worked = [line for line in (put_in, *step.lines) if line.formulas]
    worked = [line if line in shown else replace(line, detail=Detail.FULL) for line in worked]
    half = formula("½ ({own})ᵀ {I} ({own})", own=own.name, I=tensor)
    return replace(
        step,
        why=say(
            "$𝓘_{i} = 𝐑_{i} {I} 𝐑_{i}ᵀ${where} is the tensor along the axes of the {ground}. Along the "
            "body's own axes it is {I}, and the angular velocity is {own}.",
            i=i,
            I=tensor,
            ground=context.ground,
            where=say(" with {R}", R=orientation_named(context, body)) if is_its_links(body) else "",
            own=own.name,
        ),
        formula=equation(*step.formula.parts, half),
        working=(),
        lines=(*own.lines, *worked),
        normal=STATED | Part.WHY | Part.LINES | (Part.CONCLUDING if by_identity else Part(0)),
        said="own axes",
        uses=(f"v{body.name}", own.uses),
    )
