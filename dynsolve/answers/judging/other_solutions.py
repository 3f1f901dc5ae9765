"""What is right without being the key's.

Forces: those from outside may have been moved over to the side of the motors; the equation of a
coordinate that no motor drives, ... = 0, may be multiplied by anything.

C q̇: friction may be counted in it.

The energy of springs: a constant of it is free, as the zero of height is.

Joint rates and accelerations: every x with Jᵀ (J x - b) = 0 solves J x = b, or comes as near to it as can
be where nothing does; the key is the one of least norm.  Regressors: where parameters depend on each
other, many a Y gives one product.  Accelerations of links: gravity may count as an
acceleration of the base, or as a force of its own.

The parameters a of τ = Y a, which are the student's to choose.

Many pairs (Y, a) have one product.  An a of which every coefficient of the forces is a
combination is right, and the Y that belongs to it is the key from then on; where a is absent or
wrong, but some a belongs to the student's Y, that a is the key.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from enum import StrEnum
from fractions import Fraction
from typing import Any

from dynsolve.algebra.compact.compactor import Compactor
from dynsolve.algebra.expr import Expr
from dynsolve.algebra.fraction import RationalExpr, add, multiply
from dynsolve.algebra.matrix import AtState, Matrix
from dynsolve.answers.judging.answer_ring import AnswerRing
from dynsolve.answers.judging.answer_values import AnswerValue, as_value
from dynsolve.answers.judging.entry_comparison import EntryComparer, WrittenEntry, put_numbers
from dynsolve.answers.judging.graph import AnswerGraph
from dynsolve.answers.reading.vocabulary import ENERGY_LEVELS
from dynsolve.derivation.graph import Skipped
from dynsolve.derivation.kinematics import rotation
from dynsolve.derivation.link_frame import accelerations, velocities
from dynsolve.errors import AlgebraError
from dynsolve.notation.unicode import UnicodePrinter
from dynsolve.quantities import action_families, families
from dynsolve.quantities.index import Quantity
from dynsolve.questions import newton_euler
from dynsolve.questions.newton_euler.recursions import is_standard
from dynsolve.questions.parameters import PARAMETERS, REFERENCE, REGRESSORS
from dynsolve.questions.parameters.derive import missing, parameters_for, reference_forces
from dynsolve.questions.rates.derive import wanted_by_accelerations
from dynsolve.questions.statics import derive as statics
from dynsolve.robot.model import Robot
from dynsolve.robot.questions import reference

# The parameters a of τ = Y a, which are the student's to choose


def forces_of(robot: Robot, regressor: str, value: Callable[[str], Any]) -> Matrix:
    """What a regressor times its parameters is: τ, D q̈ or g; `value` gives τ, D and g."""
    if regressor == "YM":
        inertia: Matrix = value("D")
        return inertia @ accelerations(robot)
    forces: Matrix = value("g" if regressor == "Yg" else "tau")
    return forces


def is_free(robot: Robot, name: str) -> bool:
    """Whether the entries of a column of parameters are the student's to choose."""
    return name in REGRESSORS and not (name == "a" and robot.questions.model.parameters is not None)


def as_matrix(value: AnswerValue, name: str) -> Matrix | None:
    """What was written for a regressor or its parameters; None of what is no matrix over the ring.

    Parameters may stand in a row as well as in a column.
    """
    if value.rows is None:
        return None
    rows = value.rows
    if name in REGRESSORS and len(rows) == 1:
        rows = tuple((entry,) for entry in rows[0])
    found = as_value(rows, Matrix.of(rows[0][0].ring, ()))
    return found if isinstance(found, Matrix) and (name not in REGRESSORS or found.shape[1] == 1) else None


def wrong_parameters(robot: Robot, forces: Matrix, written: Matrix) -> str:
    """Why no Y belongs to some parameters, in a sentence."""
    try:
        lacking = missing(robot, forces, written)
    except AlgebraError as error:
        return f"{error.message[0].upper()}{error.message[1:]}: {error.help}."
    if lacking is None:
        return "The forces are combinations of these, but the pair is another."
    shown = UnicodePrinter().text(Compactor(robot.ring).form(lacking))
    return f"The forces have {shown}, up to a factor, which is no combination of your parameters."


def covers(robot: Robot, written: Matrix, parameters: Matrix) -> bool:
    """Whether every one of some parameters is a combination of those that were written."""
    try:
        return missing(robot, parameters, written) is None
    except AlgebraError:
        return False


def multiplies_to(regressor: Matrix, parameters: Matrix, forces: Matrix) -> bool:
    """Whether forces = Y a."""
    return regressor.shape[1] == len(parameters.rows) and regressor @ parameters == forces


def own_parameters(answer_ring: AnswerRing, written: Mapping[str, Matrix]) -> dict[str, Matrix]:
    """The parameters that a student chose, by name; `written` are the values of what was handed in."""
    robot = answer_ring.robot
    found: dict[str, Matrix] = {}
    for Y, a in PARAMETERS.items():
        if not written.keys() & {Y, a} or not is_free(robot, a) or Y not in answer_ring.rules:
            continue
        if isinstance(answer_ring.key(a), Skipped):
            continue
        forces = forces_of(robot, Y, answer_ring.key)
        chosen = _chosen(robot, forces, written.get(Y), written.get(a))
        if chosen is not None:
            found[a] = chosen
    if REFERENCE in written and "a" not in found and REFERENCE in answer_ring.rules and is_free(robot, "a"):
        forces = reference_forces(robot, *map(answer_ring.key, ("D", "C", "g")))
        chosen = _chosen(robot, forces, written[REFERENCE], None)
        return found if chosen is None else {**found, "a": chosen}
    return found


def other_references(robot: Robot, forces: Matrix, value: Callable[[str], Any]) -> bool:
    """Whether forces are D q̈_r + C q̇_r + g with any C whose C q̇ is right and Ḋ - 2C skew."""
    ring, D = robot.ring, value("D")
    names = [reference(q.name) for q in robot.coordinates]
    C = Matrix.of(ring, ([ring.coefficient(force, name, 1) for name in names] for force in forces.entries))
    skew = D.map(ring.time_derivative) - C - C
    return (
        reference_forces(robot, D, C, value("g")) == forces
        and C @ velocities(robot) == value("Cqd")
        and (skew + skew.T).is_zero
    )


def _chosen(robot: Robot, forces: Matrix, Y: Matrix | None, a: Matrix | None) -> Matrix | None:
    try:
        if a is not None and missing(robot, forces, a) is None:
            return a
    except AlgebraError:  # a parameter moves
        pass
    return parameters_for(robot, forces, Y) if Y is not None and len(Y.rows) == len(forces.rows) else None


class Other(StrEnum):
    """How an answer differs from the key, as it is told."""

    OF_MANY = "another solution than that of least norm, which is the key"
    WITH_GRAVITY = "right with gravity as an acceleration of the base; in the key it is a force on each link"
    UP_TO_CONSTANT = "right; the letter that is added is the potential energy at the zero of height"
    SPRINGS_FROM_ELSEWHERE = "right; the energy of the springs is counted from elsewhere than in the key"
    WITHOUT_LOADS = "right with the forces from outside moved over: here τ is the left side, τ + Q the right"
    WITHOUT_MULTIPLIERS = (
        "right with the forces of the constraint moved over: here τ + A_cᵀ λ is the right side"
    )
    UP_TO_FACTOR = "right: where no motor drives, the equation may be multiplied by a factor"
    WITHOUT_GRAVITY = "right with gravity as a force on each link; in the key the base accelerates instead"
    WITH_FRICTION = "right with the friction in it, which is a term of its own in the key"
    OF_C = "right with another choice of C than Christoffel's"
    OF_THE_PRODUCT = "these parameters leave Y open; the product is right"
    SAME_CONSTRAINT = "right in another form of the same constraint"
    ON_CONSTRAINT = "right where the constraint holds; that was held in numbers, at several states"


LONGEST = 400
"""Values with more terms are not put into the equations."""


def other_solution(
    graph: AnswerGraph,
    node: str,
    rows: Sequence[Sequence[WrittenEntry]],
    compare: EntryComparer,
    is_equation: bool = False,
) -> Other | None:
    """What an answer is that is not the key's and right all the same; None of a wrong one.

    `is_equation` says that it was written as one side of `... = 0`.
    """
    quantity = graph.quantities.of_rule(node)
    if quantity is not None and quantity.family in (newton_euler.AL, newton_euler.ACL):
        return _with_other_gravity(graph, quantity, rows, compare)
    if node in PARAMETERS:
        return Other.OF_THE_PRODUCT if _multiplies(graph, node, rows) else None
    if quantity is not None and quantity.family in (families.TAU, families.FORCE):
        if _is_what_motors_give(graph, quantity, rows, compare):
            return Other.WITHOUT_LOADS
        return Other.UP_TO_FACTOR if is_equation and _is_multiple(graph, quantity, rows, compare) else None
    is_potential = quantity is not None and quantity.family in (families.P, families.P_BODY, families.L)
    if quantity is not None and is_potential and _differs_by_level(graph, quantity, rows[0][0]):
        return Other.UP_TO_CONSTANT
    if quantity is not None and quantity.family in (families.P, families.L, action_families.PS):
        return Other.SPRINGS_FROM_ELSEWHERE if _differs_by_springs(graph, quantity, rows[0][0]) else None
    if node == "Cqd":
        return Other.WITH_FRICTION if _holds_friction(graph, rows, compare) else None
    if node == REFERENCE:
        return Other.OF_C if _refers(graph, rows) else None
    return Other.OF_MANY if _solves(graph, node, rows, compare.values) else None


def _multiplies(graph: AnswerGraph, node: str, rows: Sequence[Sequence[WrittenEntry]]) -> bool:
    """Whether Y a is right for the student's own a."""
    parameters = graph.parameters.get(PARAMETERS[node])
    forces = forces_of(graph.robot, node, graph.key)
    entries = tuple(tuple(entry.value for entry in row) for row in rows)
    Y = as_value(entries, forces)
    return parameters is not None and isinstance(Y, Matrix) and multiplies_to(Y, parameters, forces)


def _refers(graph: AnswerGraph, rows: Sequence[Sequence[WrittenEntry]]) -> bool:
    """Whether Y_r a holds another C that is as good."""
    parameters = graph.key("a")
    Y = as_value(tuple(tuple(entry.value for entry in row) for row in rows), parameters)
    is_fit = isinstance(Y, Matrix) and Y.shape[1] == len(parameters.rows)
    return is_fit and other_references(graph.robot, Y @ parameters, graph.key)


def _with_other_gravity(
    graph: AnswerGraph, quantity: Quantity, rows: Sequence[Sequence[WrittenEntry]], compare: EntryComparer
) -> Other | None:
    """Whether an acceleration is right where gravity is counted in the other of the two ways."""
    robot, place = graph.robot, quantity.index[0]
    link = robot.bodies[place - 1].link if quantity.family is newton_euler.ACL else place
    standard = is_standard(robot)
    gravity = rotation(graph.key(f"H{link}")).T @ robot.gravity
    wanted = graph.key(quantity.rule) + (-gravity if standard else gravity)
    right = all(compare(entry, row[0]) is not None for entry, row in zip(wanted.entries, rows, strict=True))
    if not right:
        return None
    return Other.WITH_GRAVITY if standard else Other.WITHOUT_GRAVITY


def _differs_by_level(graph: AnswerGraph, quantity: Quantity, written: WrittenEntry) -> bool:
    """Whether an energy differs from the key by a letter alone, for the energy at the zero of height."""
    difference = written.value.numerator - graph.key(quantity.rule)
    if written.value.divisor is not None or len(difference.poly.monoms()) != 1:
        return False
    used = [g for g in difference.ring.generators if difference.poly.degrees()[g.index] > 0]
    own = graph.robot.parameters
    return (
        len(used) == 1
        and used[0].name in ENERGY_LEVELS
        and used[0].name not in own
        and difference.poly.total_degree() == 1
    )


def _differs_by_springs(graph: AnswerGraph, quantity: Quantity, written: WrittenEntry) -> bool:
    """Whether an energy differs from the key by a constant in which every term has a stiffness.

    The constant has none of masses or gravity: these have one zero of height for all bodies.
    """
    robot, difference = graph.robot, written.value.numerator - graph.key(quantity.rule)
    if not robot.actions.springs or written.value.divisor is not None:
        return False
    own = _parameters(spring.energy for spring in robot.actions.springs)
    own -= _parameters((*(body.mass for body in robot.bodies), *robot.gravity.entries))
    symbols = robot.ring.symbol_indices
    stiff = _parameters(s.law.stiffness if s.law else s.energy for s in robot.actions.springs)
    places = [symbols[name, 0] for name in stiff & own]
    return (
        not difference.is_zero
        and not robot.ring.depends_on_coordinates(difference)
        and _parameters([difference]) <= own
        and all(any(exponents[i] for i in places) for exponents in difference.poly.monoms())
    )


def _parameters(values: Iterable[Expr]) -> set[str]:
    """The parameters that occur in some values."""
    found: set[str] = set()
    for value in values:
        degrees = value.poly.degrees()
        found |= {
            g.name for g in value.ring.generators if degrees[g.index] > 0 and g.name in value.ring.parameters
        }
    return found


def _is_what_motors_give(
    graph: AnswerGraph, quantity: Quantity, rows: Sequence[Sequence[WrittenEntry]], compare: EntryComparer
) -> bool:
    """Whether forces are D q̈ + C q̇ + friction + g - Q: what is left for the motors."""
    robot = graph.robot
    if not robot.questions.loads:
        return False
    parts = tuple(graph.key(f"load{i}") for i, _ in enumerate(robot.questions.loads, 1))
    Q = statics.total(robot, parts)
    key = graph.key(quantity.rule)
    forces = (
        key - Q if isinstance(key, Matrix) else Matrix.column(Q.ring, [key - Q[quantity.index[0] - 1, 0]])
    )
    return all(compare(entry, row[0]) is not None for entry, row in zip(forces.entries, rows, strict=True))


def _holds_friction(
    graph: AnswerGraph, rows: Sequence[Sequence[WrittenEntry]], compare: EntryComparer
) -> bool:
    """Whether a vector is C q̇ and friction together."""
    if "friction" not in graph.answer_ring.rules:
        return False
    wanted = graph.key("Cqd") + graph.key("friction")
    return all(compare(entry, row[0]) is not None for entry, row in zip(wanted.entries, rows, strict=True))


def _is_multiple(
    graph: AnswerGraph, quantity: Quantity, rows: Sequence[Sequence[WrittenEntry]], compare: EntryComparer
) -> bool:
    """Whether forces, which are said to be 0, are right up to a factor."""
    robot, key = graph.robot, graph.key(quantity.rule)
    first = 0 if isinstance(key, Matrix) else quantity.index[0] - 1
    wanted = key.entries if isinstance(key, Matrix) else (key,)
    for k, (right, (written,)) in enumerate(zip(wanted, rows, strict=True), first):
        if compare(right, written) is not None:
            continue
        acceleration, given = robot.coordinates[k].name, written.value.numerator
        own, its = (robot.ring.coefficient(one, acceleration, 2) for one in (given, right))
        if own.is_zero or given * its != right * own:
            return False
    return True


def _solves(
    graph: AnswerGraph,
    node: str,
    rows: Sequence[Sequence[WrittenEntry]],
    values: Mapping[str, Fraction],
) -> bool:
    """Whether rates or accelerations of the joints do what is asked of the task."""
    system = _system(graph, node)
    if system is None:
        return False
    ring = graph.answer_ring.ring
    put = {ring.symbol_indices[n, 0]: v for n, v in values.items() if ring.has_symbol(n)}
    J, right = (matrix.map(lambda entry: _number(entry, put)) for matrix in system)
    x = [put_numbers(row[0].value, put) for row in rows]
    if sum(len(entry.numerator) + len(entry.denominator) for entry in x) > LONGEST:
        return False
    squares, wanted = J.T @ J, J.T @ right
    return all(_dot(row, x, -goal).is_zero for row, goal in zip(squares.rows, wanted.entries, strict=True))


def _number(entry: Expr, put: Mapping[int, Fraction]) -> Expr:
    return put_numbers(RationalExpr(entry), put).numerator


def _dot(row: Sequence[Expr], x: Sequence[RationalExpr], start: Expr) -> RationalExpr:
    total = RationalExpr(start)
    for factor, entry in zip(row, x, strict=True):
        total = add(total, multiply(RationalExpr(factor), entry))
    return total


def _system(graph: AnswerGraph, node: str) -> tuple[Matrix, Matrix] | None:
    """(J, b) at the state, None of what is no solution of such a system."""
    asked = graph.robot.questions
    at = AtState(graph.answer_ring.ring, asked.state.by_symbol)
    if node == "qd" and asked.velocity is not None:
        return at.matrix(graph.key("Jr")), at.matrix(asked.velocity)
    if node == "qdd" and asked.acceleration is not None:
        wanted = wanted_by_accelerations(graph.robot, asked.acceleration, graph.key("Jr_dot"))
        return at.matrix(graph.key("Jr")), at.matrix(wanted)
    return None
