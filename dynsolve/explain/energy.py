"""Steps of the energies: P_i, the Jacobians and velocities of each mass centre, K_i, and the totals."""

from __future__ import annotations

from collections.abc import Iterator

from dynsolve.algebra.expr import Expr
from dynsolve.document import Prose
from dynsolve.explain.course import Course, is_small, listed, shv, side_by_side
from dynsolve.explain.inertia import name_of
from dynsolve.explain.jacobian import ZERO, coordinate_column
from dynsolve.explain.step import Detail, Step
from dynsolve.notation.tree import (
    Letter,
    Matrix,
    Negative,
    Node,
    Number,
    Power,
    Product,
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

_BESIDE = 2
"""Up to this number of columns J_v and J_ω in letters stand on one line."""


def steps(course: Course) -> Iterator[Step]:
    """The potential energies, then body by body the kinetic ones, then the total."""
    bodies = course.robot.bodies
    for body in bodies:
        yield _potential(course, body)
    yield _total(course, "P", "potential", letters.P, [letters.of_body("P", b) for b in bodies])
    told = False
    for body in bodies:
        yield _jacobians(course, body)
        yield _velocities(course, body)
        linear = _linear(course, body, tells=not told)
        told = told or bool(linear.notes)
        yield linear
        yield _rotational(course, body)
        yield _kinetic(course, body)
    yield _total(course, "K", "kinetic", letters.K, [letters.of_body("K", b) for b in bodies])


# -- potential energy ------------------------------------------------------------------------------


def _potential(course: Course, body: Body) -> Step:
    P = letters.of_body("P", body)
    general = equation(
        P, Negative(Product((course.mass(body), Transpose(letters.bold("g")), letters.rc(body))))
    )
    formula: Node = general
    working: tuple[Node, ...] = ()
    if course.robot.gravity.is_zero:
        why: Prose = ("There is no gravity.",)
    elif body.mass.is_zero:
        why = (f"{name_of(body).capitalize()} has inertia but no mass, so gravity does not act on it.",)
    else:
        why, formula, working = _weight(course, body, general)
    return Step(
        id=f"P{body.name}",
        stage=STAGE,
        title=f"Potential energy of {name_of(body)}",
        why=why,
        formula=formula,
        source=shv("7.2.3"),
        working=working,
        result=(equation(P, course.form(f"P{body.name}")),),
    )


def _weight(course: Course, body: Body, general: Node) -> tuple[Prose, Node, tuple[Node, ...]]:
    """By the height, where gravity lies along an axis, and by the vectors: why, the formula, the working."""
    P = letters.of_body("P", body)
    gravity, center = course.show(course.robot.gravity), course.form(f"rc{body.name}")
    row = Matrix((tuple(entry for (entry,) in _rows(gravity)),))
    vectors = equation(P, Negative(Product((course.show(body.mass), row, center))))
    working: tuple[Node, ...] = (vectors,) if is_small(center) else ()
    product: Prose = (
        Product((Transpose(letters.bold("g")), letters.bold("r", Words("c")))),
        ", g being the acceleration of gravity, which points down.",
    )
    height = _height(course, body)
    if height is None:
        return ("Minus the mass times ", *product), general, working
    h, g = letters.height(course.robot, body), _acceleration(course)
    where = f" above the origin of the {course.ground}. The same with vectors: minus the mass times "
    why: Prose = ("The mass times ", g, " times the height ", h, where, *product)
    formula = side_by_side([equation(P, Product((course.mass(body), g, h))), general])
    return why, formula, (equation(h, height), *working)


def _rows(node: Node) -> tuple[tuple[Node, ...], ...]:
    assert isinstance(node, Matrix)
    return node.rows


def _height(course: Course, body: Body) -> Node | None:
    """The height of the mass centre, where gravity lies along an axis of the base."""
    along = [(i, entry) for i, entry in enumerate(course.robot.gravity.entries) if not entry.is_zero]
    if len(along) != 1:
        return None
    i, entry = along[0]
    center: Expr = course.values[f"rc{body.name}"][i, 0]
    return course.show(center if _leads_with_minus(entry) else -center)


def _acceleration(course: Course) -> Node:
    """The size of gravity along its axis: the problem's symbol, g for a number."""
    (entry,) = (entry for entry in course.robot.gravity.entries if not entry.is_zero)
    size = course.show(-entry if _leads_with_minus(entry) else entry)
    named = "g" in course.robot.parameters
    return size if named or not entry.is_number else Symbol("g")


def _leads_with_minus(expr: Expr) -> bool:
    return bool(expr.poly.leading_coefficient() < 0)


def _total(course: Course, name: str, kind: str, letter: Letter, parts: list[Letter]) -> Step:
    members: list[Node] = [letter]
    if len(parts) > 1:
        members.append(Sum(tuple(parts)))
    else:
        members.append(parts[0])
    notes: tuple[Prose, ...] = ()
    if name == "K":
        notes = (("Kinetic energy is counted per mass; torques and forces, below, per joint.",),)
    return Step(
        id=name,
        stage=STAGE,
        title=f"Total {kind} energy",
        why=("The sum over the bodies.",) if len(parts) > 1 else ("There is one body only.",),
        formula=equation(*members),
        source=shv("7.2"),
        result=(equation(letter, course.form(name)),),
        notes=notes,
        detail=Detail.BRIEF,
    )


# -- kinetic energy --------------------------------------------------------------------------------


def _jacobians(course: Course, body: Body) -> Step:
    b, robot = body.name, course.robot
    columns = [
        coordinate_column(course, k, body.link, letters.rc(body)) or (ZERO, ZERO) for k in range(robot.n)
    ]
    late = [Symbol(q.name) for q, both in zip(robot.coordinates, columns, strict=True) if both[0] == ZERO]
    why: Prose = (
        "Like the Jacobian of the arm, but of the mass centre: only the joints up to the body's link move it",
    )
    if late:
        why += (", so the column of " if len(late) == 1 else ", so the columns of ", *listed(late))
        why += (" is zero." if len(late) == 1 else " are zero.",)
    else:
        why += (".",)
    linear = equation(letters.jv(body), Matrix((tuple(v for v, _ in columns),)))
    angular = equation(letters.jw(body), Matrix((tuple(w for _, w in columns),)))
    beside = robot.n <= _BESIDE and not any(isinstance(v, Sum) for v, _ in columns)
    return Step(
        id=f"Jv{b}",
        stage=STAGE,
        title=f"Jacobians of the mass centre of {name_of(body)}",
        why=why,
        formula=side_by_side([linear, angular]) if beside else linear,
        source=shv("7.2.2"),
        working=() if beside else (angular,),
        result=(
            equation(letters.jv(body), course.form(f"Jv{b}")),
            equation(letters.jw(body), course.form(f"Jw{b}")),
        ),
    )


def _velocities(course: Course, body: Body) -> Step:
    b = body.name
    v, w = letters.of_body("v", body, "bold"), letters.of_body("omega", body, "bold")
    results = [equation(v, course.form(f"v{b}"))]
    formulas: list[Node] = [equation(v, Product((letters.jv(body), letters.QD)))]
    if not body.is_point:
        results.append(equation(w, course.form(f"w{b}")))
        formulas.append(equation(w, Product((letters.jw(body), letters.QD))))
    qd = column(*(letters.rate(q) for q in course.robot.coordinates))
    Jv = course.form(f"Jv{b}")
    working = (equation(v, Product((Jv, qd))),) if is_small(Jv, qd) else ()
    return Step(
        id=f"v{b}",
        stage=STAGE,
        title=f"Velocity of {name_of(body)}",
        why=("The Jacobians times the rates of the coordinates.",),
        formula=side_by_side(formulas),
        source=shv("7.2.2"),
        working=working,
        result=tuple(results),
    )


def _linear(course: Course, body: Body, tells: bool) -> Step:
    b = body.name
    Kv, v = letters.energy_part("v", body), letters.of_body("v", body, "bold")
    velocity = course.matrix(f"v{b}")
    form = course.form(f"Kv{b}")
    mass = course.show(body.mass)
    working: tuple[Node, ...] = ()
    still = all(row[0] == Number(0) for row in velocity.rows)
    if still:
        why: Prose = ("The mass centre does not move.",)
    elif body.mass.is_zero:
        why = ("The body has no mass, only inertia.",)
    else:
        why = ("Half the mass times the square of the speed of the mass centre.",)
        squares = tuple(Power(row[0], Number(2)) for row in velocity.rows if row[0] != Number(0))
        if is_small(velocity, velocity):
            total = squares[0] if len(squares) == 1 else Sum(squares)
            working = (equation(Kv, Product((letters.HALF, mass, total))),)
    return Step(
        id=f"Kv{b}",
        stage=STAGE,
        title=f"Linear kinetic energy of {name_of(body)}",
        why=why,
        formula=equation(Kv, Product((letters.HALF, course.mass(body), letters.transposed_product(v)))),
        source=shv("7.2"),
        working=working,
        result=(equation(Kv, form),),
        notes=tuple(_cancelling(course, body)) if working and tells else (),
    )


def _cancelling(course: Course, body: Body) -> Iterator[Prose]:
    """Where sines and cosines of a joint angle leave the square by s² + c² = 1."""
    ring = course.robot.ring
    v, K = course.values[f"v{body.name}"], course.values[f"Kv{body.name}"]
    left = K.poly.degrees()
    entries = [entry.poly.degrees() for entry in v.entries]
    for pair in ring.pairs:
        if len(pair.angle.terms) != 1 or pair.angle.degrees:
            continue
        ((atom, rate),) = pair.angle.terms
        if rate != 1 or atom[0][0] not in ring.names or left[pair.sine] or left[pair.cosine]:
            continue
        holding = [d for d in entries if d[pair.sine] or d[pair.cosine]]
        if len(holding) > 1 and any(d[pair.sine] for d in holding) and any(d[pair.cosine] for d in holding):
            angle = Symbol(atom[0][0])
            yield (
                "The squares add up by ",
                _pythagoras(angle),
                ", so that the speed does not depend on ",
                angle,
                ". (The difference of the squares, which is the cosine of twice the angle, does not occur.)",
            )
            return


def _pythagoras(angle: Symbol) -> Node:
    from dynsolve.notation.tree import Function

    squares = tuple(Power(Function(name, angle), Number(2)) for name in ("sin", "cos"))
    return equation(Sum(squares), Number(1))


def _rotational(course: Course, body: Body) -> Step:
    b = body.name
    Kw, w = letters.energy_part("omega", body), letters.of_body("omega", body, "bold")
    if body.is_point:
        return Step(
            id=f"Kw{b}",
            stage=STAGE,
            title=f"Rotational kinetic energy of {name_of(body)}",
            why=("Skipped: a point mass has no inertia tensor, and so no rotational energy.",),
            source=shv("7.2"),
            result=(equation(Kw, Number(0)),),
        )
    tensor = letters.of_body("I", body, "script")
    form = course.form(f"Kw{b}")
    velocity, base = course.matrix(f"w{b}"), course.form(f"I{b}")
    working: tuple[Node, ...] = ()
    still = all(row[0] == Number(0) for row in velocity.rows)
    if not still and is_small(velocity, velocity, base):
        product = Product((letters.HALF, Matrix((tuple(row[0] for row in velocity.rows),)), base, velocity))
        working = (equation(Kw, product),)
    return Step(
        id=f"Kw{b}",
        stage=STAGE,
        title=f"Rotational kinetic energy of {name_of(body)}",
        why=("The body does not turn.",)
        if still
        else (f"ω and the tensor, both in {course.ground} coordinates.",),
        formula=equation(Kw, Product((letters.HALF, letters.transposed_product(w, tensor)))),
        source=shv("7.2"),
        working=working,
        result=(equation(Kw, form),),
    )


def _kinetic(course: Course, body: Body) -> Step:
    K = letters.of_body("K", body)
    parts = Sum((letters.energy_part("v", body), letters.energy_part("omega", body)))
    return Step(
        id=f"K{body.name}",
        stage=STAGE,
        title=f"Kinetic energy of {name_of(body)}",
        why=("Linear and rotational together.",),
        formula=equation(K, parts),
        source=shv("7.2"),
        result=(equation(K, course.form(f"K{body.name}")),),
    )
