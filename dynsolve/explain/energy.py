"""Steps of the energies: P_i, the Jacobians and velocities of each mass centre, K_i, and the totals."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace

from dynsolve.derivation.jacobian import joint_frame
from dynsolve.document import Prose, Reference
from dynsolve.explain.actions import acting_steps, potential_steps
from dynsolve.explain.context import Context
from dynsolve.explain.jacobian import where_told_read_off
from dynsolve.explain.jacobian_columns import (
    BESIDE,
    ZERO,
    coordinate_column,
    crosses,
    end_of,
    how_read_off,
    parallel,
    read_off,
)
from dynsolve.explain.placed_bodies import energy_steps, jacobians_step
from dynsolve.explain.step import STATED, WORKED, Detail, Group, Line, Part, Step, outlined
from dynsolve.explain.working.derivatives import summed
from dynsolve.explain.working.kinetic import linear, squared, written_velocity
from dynsolve.explain.working.rotational import along_own_axes, multiplied_out, turned
from dynsolve.explain.writing import (
    are_counted,
    counted_sum,
    is_small,
    listed,
    name_of,
    side_by_side,
    spong,
    sum_of,
)
from dynsolve.notation.build import split_sign
from dynsolve.notation.tree import (
    Letter,
    Matrix,
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
    Words,
    column,
    equation,
)
from dynsolve.quantities import letters
from dynsolve.quantities.stages import Stage
from dynsolve.robot.model import Body

STAGE = Stage.ENERGY


def steps(context: Context) -> Iterator[Step]:
    """The potential energies, then body by body the kinetic ones, then the total; or those that are given."""
    if context.robot.given is not None:
        yield from energy_steps(context, context.robot.given)
        return
    bodies = context.robot.bodies
    springs, rotors = acting_steps(context)
    of_gravity = [*potential_steps(context), *springs]
    total = _total(context, "P", "potential", letters.P, [letters.PS] * len(springs))
    potential = Group("P", "Potential energy")
    yield from (replace(step, group=potential) for step in (*of_gravity, total))
    told, read = False, False
    for body in bodies:
        jacobians = _jacobians(context, body) if context.robot.has_table else jacobians_step(context, body)
        if not read and (way := _read_off(context, body)):
            read, jacobians = True, replace(jacobians, why=(*jacobians.why, *way))
        linear = _linear(context, body, tells=not told)
        told = told or bool(linear.notes)
        turning = rotational_step(context, body)
        group = Group(f"K{body.name}", f"Kinetic energy of {name_of(body)}")
        yield replace(jacobians, group=group, normal=STATED | (Part.WHY if body is bodies[0] else STATED))
        yield replace(_velocities(context, body), group=group, normal=STATED)
        yield replace(linear, group=group, normal=WORKED if linear.working or linear.lines else STATED)
        yield replace(turning, group=group)
        yield replace(_kinetic(context, body), group=group, normal=STATED)
    yield from rotors
    yield _total(context, "K", "kinetic", letters.K, [letters.KM] * len(rotors))


def _total(context: Context, name: str, kind: str, letter: Letter, others: list[Letter]) -> Step:
    """The energy of the bodies, and of the springs or rotors where there are any."""
    bodies = [letters.of_body(name, body) for body in context.robot.bodies]
    why = "The sum over the bodies" if len(bodies) > 1 else "There is only one body"
    if others:
        why = "The sum over the bodies" if len(bodies) > 1 else "That of the body"
        why += f", and that of the {'springs' if name == 'P' else 'rotors'}"
    why += "."
    formula: Node = equation(letter, sum_of([*bodies, *others]))
    weightless = name == "P" and context.robot.gravity.is_zero
    if len(bodies) > 1 and not weightless:
        if context.are_masses_counted:
            formula = equation(letter, sum_of([*bodies, *others]), sum_of([_summed(context, name), *others]))
        elif not are_counted(context.robot.bodies):
            formula = side_by_side([formula, equation(Letter(name, Symbol("i")), _of_body(context, name))])
        why += _without_turning(context) if name == "K" else ""
    acting = [name + ("s" if name == "P" else "m")] if others else []
    way = summed(context, [*(name + body.name for body in context.robot.bodies), *acting], name, letter)
    return Step(
        id=name,
        stage=STAGE,
        title=f"Total {kind} energy",
        why=(why,),
        formula=formula,
        source=spong("7.2.3" if name == "P" else "7.2.2"),
        lines=way.lines,
        concluding=way.concluding,
        result=(equation(letter, context.form(name)),),
        detail=Detail.BRIEF,
        normal=STATED,
    )


def _without_turning(context: Context) -> str:
    """What is left of the sum for points, where it has a term that they have not."""
    points = [body.is_point for body in context.robot.bodies]
    return " A point mass has no second term." if any(points) and not all(points) else ""


def _summed(context: Context, name: str) -> Node:
    """The sum over the bodies of what each has."""
    sign, own = split_sign(_of_body(context, name))
    added = counted_sum(own, Symbol("i"), len(context.robot.bodies))
    return added if sign > 0 else Negative(added)


def _of_body(context: Context, name: str) -> Node:
    """Of body i: -m_i g₀ᵀ r_ci, or ½ m_i v_iᵀ v_i + ½ ω_iᵀ I_i ω_i."""
    i = Symbol("i")
    mass = Letter("m", i)
    if name == "P":
        center = letters.bold("r", Row((Words("c"), i)))
        return Negative(Product((mass, Transpose(letters.GRAVITY), center)))
    v, w = (letters.bold(base, i) for base in ("v", "omega"))
    linear = Product((letters.HALF, mass, letters.transposed_product(v)))
    angular = Product((letters.HALF, letters.transposed_product(w, letters.base_tensor(i))))
    turning = any(not body.is_point for body in context.robot.bodies)
    return Sum((linear, angular)) if turning else linear


# -- kinetic energy --------------------------------------------------------------------------------


def _jacobians(context: Context, body: Body) -> Step:
    b, robot = body.name, context.robot
    columns = [
        coordinate_column(context, k, body.link, letters.rc(body)) or (ZERO, ZERO) for k in range(robot.n)
    ]
    late = [Symbol(q.name) for q, both in zip(robot.coordinates, columns, strict=True) if both[0] == ZERO]
    linear = equation(letters.jv(body), Matrix((tuple(v for v, _ in columns),)))
    angular = equation(letters.jw(body), Matrix((tuple(w for _, w in columns),)))
    beside = robot.n <= BESIDE and not any(isinstance(v, Sum) for v, _ in columns)
    working, named = crosses(
        context, body.link, letters.rc(body), context.values[f"rc{b}"], context.matrix(f"Jv{b}")
    )
    turning = () if body.is_point else (angular,)
    step = Step(
        id=f"Jv{b}",
        stage=STAGE,
        title=f"Jacobian{'s' * bool(turning)} of the mass centre of {name_of(body)}",
        why=(*_jacobians_why(context, late), *_zero_column(context, body)),
        formula=side_by_side([linear, *turning]) if beside else linear,
        source=spong("7.2.2"),
        further=() if beside else turning,
        working=working,
        concluding=named,
        result=(
            equation(letters.jv(body), context.form(f"Jv{b}")),
            *((equation(letters.jw(body), context.form(f"Jw{b}")),) if turning else ()),
        ),
        together=robot.n <= BESIDE and not body.is_point,
        also=(f"Jw{b}",),
        uses=("axes", f"rc{b}"),
    )
    return _at_the_end(context, body, step) if _is_at_the_end(context, body) else step


def _read_off(context: Context, body: Body) -> Prose:
    """How the columns of which no product is shown are read off, or which column of the end tells it."""
    if not (context.is_short and context.robot.has_table) or _is_at_the_end(context, body):
        return ()
    joint = read_off(context, body.link, context.values[f"rc{body.name}"])
    if joint is None:
        return ()
    column = where_told_read_off(context)
    if column:
        axis = letters.z(joint_frame(context.robot, joint))
        first = Letter("J", Number(int(column[1:])), style="bold")
        return (" Products with ", axis, " are read off as in ", first, Reference((column,)), ".")
    return (" ", *how_read_off(context, joint), ".")


def _zero_column(context: Context, body: Body) -> Prose:
    """Why a column of which no product is shown is zero."""
    if not context.is_short:
        return ()
    return parallel(context, body.link, letters.rc(body), context.values[f"rc{body.name}"])


def _jacobians_why(context: Context, late: Sequence[Node]) -> Prose:
    """Which joints move a mass centre; `late` are the coordinates that do not."""
    why = f"As for {context.end}, but for the mass centre"
    if not late:
        return (f"{why}.",)
    columns = "column of " if len(late) == 1 else "columns of "
    verb = " is zero." if len(late) == 1 else " are zero."
    return (
        f"{why}: only the joints up to the body's link can move it, so the {columns}",
        *listed(late),
        verb,
    )


def _is_at_the_end(context: Context, body: Body) -> bool:
    """Whether the mass centre of a body is the end of the arm."""
    is_last = body.link == len(context.robot.joints)
    return is_last and bool(context.values[f"rc{body.name}"] == end_of(context))


def _at_the_end(context: Context, body: Body, step: Step) -> Step:
    """The Jacobians of a mass centre that is the end of the arm: they are known."""
    center = equation(letters.rc(body), letters.o(body.link))
    same = [equation(letters.jv(body), letters.JV)]
    same += [] if body.is_point else [equation(letters.jw(body), letters.JW)]
    return replace(
        step,
        why=("The mass centre is ", context.end, ", ", center, ", so its Jacobian is known."),
        formula=side_by_side(same),
        further=(),
        working=(),
        concluding=(),
        uses=("J",),
    )


def _velocities(context: Context, body: Body) -> Step:
    b = body.name
    v, w = letters.of_body("v", body, "bold"), letters.of_body("omega", body, "bold")
    results = [equation(v, written_velocity(context, body))]
    formulas: list[Node] = [equation(v, Product((letters.jv(body), letters.QD)))]
    if not body.is_point:
        results.append(equation(w, context.form(f"w{b}")))
        formulas.append(equation(w, Product((letters.jw(body), letters.QD))))
    qd = column(*(letters.velocity(q) for q in context.robot.coordinates))
    Jv = context.form(f"Jv{b}")
    moves = not context.values[f"Jv{b}"].is_zero
    working = (equation(v, Product((Jv, qd))),) if moves and is_small(Jv, qd) else ()
    return Step(
        id=f"v{b}",
        stage=STAGE,
        title=f"Velocity of {name_of(body)}",
        why=(_times_rates(context, body),),
        formula=side_by_side(formulas),
        source=spong("7.2.2"),
        working=working,
        result=tuple(results),
        together=context.robot.n <= BESIDE,
        also=(f"w{b}",),
    )


def _times_rates(context: Context, body: Body) -> str:
    alone = body.is_point  # of which J_ω is not needed
    return f"The Jacobian{'s' * (not alone)} times the rates of the coordinates."


def _linear(context: Context, body: Body, tells: bool) -> Step:
    b = body.name
    Kv, v = letters.energy_part("v", body), letters.of_body("v", body, "bold")
    velocity = written_velocity(context, body)
    form = context.form(f"Kv{b}")
    working: tuple[Node, ...] = ()
    still = all(row[0] == Number(0) for row in velocity.rows)
    if still:
        why: Prose = ("The mass centre does not move.",)
    elif body.mass.is_zero:
        why = ("The body has no mass, only inertia.",)
    else:
        why = ("Half the mass times the square of the speed of the mass centre.",)
        if is_small(velocity, velocity):
            working = (equation(Kv, squared(context, body)),)
    way = linear(context, body, squares_shown=bool(working))
    return Step(
        id=f"Kv{b}",
        stage=STAGE,
        title=f"Translational kinetic energy of {name_of(body)}",
        why=why,
        formula=equation(Kv, Product((letters.HALF, context.mass(body), letters.transposed_product(v)))),
        source=spong("7.2"),
        working=working if way.frame is None else (),
        lines=outlined(way.lines) if way.frame is None else way.lines,
        concluding=way.concluding,
        uses=None if way.frame is None else (f"H{way.frame}", f"v{b}"),
        result=(equation(Kv, form),),
        notes=tuple(_cancelling(context, body)) if working and tells else (),
        hint=(
            "Half the mass times the square of the speed of the mass centre: add up the squares of the "
            "components of ",
            v,
            ".",
        ),
    )


def _cancelling(context: Context, body: Body) -> Iterator[Prose]:
    """Where sines and cosines of a joint angle leave the square by s² + c² = 1."""
    ring = context.robot.ring
    v, K = context.values[f"v{body.name}"], context.values[f"Kv{body.name}"]
    left = K.poly.degrees()
    entries = [entry.poly.degrees() for entry in v.entries]
    for pair in ring.pairs:
        if len(pair.angle.terms) != 1 or pair.angle.degrees:
            continue
        ((atom, rate),) = pair.angle.terms
        if rate != 1 or atom[0][0] not in ring.names or left[pair.sine] > 0 or left[pair.cosine] > 0:
            continue
        holding = [d for d in entries if d[pair.sine] > 0 or d[pair.cosine] > 0]  # of 0 they are -1
        both = (any(d[k] > 0 for d in holding) for k in (pair.sine, pair.cosine))
        if len(holding) > 1 and all(both):
            angle = Symbol(atom[0][0])
            yield ("The speed does not depend on ", angle, ".")
            return


def _kinetic(context: Context, body: Body) -> Step:
    K = letters.of_body("K", body)
    parts = Sum((letters.energy_part("v", body), letters.energy_part("omega", body)))
    names = (f"Kv{body.name}", f"Kw{body.name}")
    way = summed(context, names, f"K{body.name}", K, stand_above=True)
    return Step(
        id=f"K{body.name}",
        stage=STAGE,
        title=f"Kinetic energy of {name_of(body)}",
        why=("The sum of the translational and the rotational part.",),
        formula=equation(K, parts),
        source=spong("7.2"),
        lines=way.lines,
        concluding=way.concluding,
        result=(equation(K, context.form(f"K{body.name}")),),
    )


# -- the step of the rotational kinetic energy of a body -------------------------------------------


def rotational_step(context: Context, body: Body) -> Step:
    """K_ω = ½ ωᵀ 𝓘 ω, along the axes of the base or of the body."""
    b = body.name
    Kw, w = letters.energy_part("omega", body), letters.of_body("omega", body, "bold")
    step = Step(
        id=f"Kw{b}",
        stage=Stage.ENERGY,
        title=f"Rotational kinetic energy of {name_of(body)}",
        source=spong("7.2"),
        normal=STATED,
        result=(equation(Kw, context.form(f"Kw{b}")),),
    )
    if body.is_point:
        none: Prose = ("A point mass has no rotational energy.",)
        return replace(step, why=none, said="point mass", normal=Part.WHY | Part.RESULT)
    half = Product(
        (letters.HALF, letters.transposed_product(w, letters.base_tensor(letters.index_of(body.name))))
    )
    why: Prose = (w, f" and the tensor, both in {context.ground} coordinates.")
    step = replace(step, why=why, hint=why, formula=equation(Kw, half))
    if context.values[f"w{b}"].is_zero:
        return replace(step, why=("The body does not turn.",), normal=STATED | Part.WHY)
    product, way = multiplied_out(context, body)
    step = replace(step, working=(product,) if is_small(product) else (), lines=way.lines)
    step = replace(step, concluding=way.concluding)
    return _turned(context, body, step) if along_own_axes(context, body) else step


def _turned(context: Context, body: Body, step: Step) -> Step:
    """K_ω along the axes of the body: ω is brought there, and the tensor is the given one."""
    b, w = body.name, letters.of_body("omega", body, "bold")
    R, tensor = letters.of_body("R", body, "bold"), letters.tensor(context.robot, body)
    own = turned(context, body, "w", w)
    half = Product((letters.HALF, Transpose(Parenthesized(own.name)), tensor, Parenthesized(own.name)))
    assert isinstance(step.formula, Relation)
    why: Prose = (
        equation(letters.base_tensor(letters.index_of(body.name)), Product((R, tensor, Transpose(R)))),
        f" is the tensor along the axes of the {context.ground}. Along the body's own axes it is ",
        tensor,
        ", and the angular velocity is ",
        own.name,
        ".",
    )
    put_in = Line(("The tensor along the body's own axes put in:",), step.working, (f"I_body{b}",))
    return replace(
        step,
        why=why,
        formula=equation(*step.formula.parts, half),
        working=(),
        lines=(
            *own.lines,
            *(replace(line, detail=Detail.FULL) for line in (put_in, *step.lines) if line.formulas),
        ),
        normal=STATED | Part.WHY | Part.LINES,
        said="own axes",
        uses=(f"v{b}", own.uses),
    )
