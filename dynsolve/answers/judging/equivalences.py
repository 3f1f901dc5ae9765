"""What is right without being the key's: a table of equivalences, each with its test and its words.

The rows of `EQUIVALENCES` say of which quantities each holds.  Forces: those from outside may have been
moved over to the side of the motors; the equation of a coordinate that no motor drives, ... = 0, may be
multiplied by anything.  C q̇: friction may be counted in it.  Energies: a constant of the springs is
free, as the zero of height is.  Joint rates and accelerations: every x with Jᵀ (J x - b) = 0 solves
J x = b, or comes as near to it as can be where nothing does; the key is the one of least norm.
Regressors: where parameters depend on each other, many a Y gives one product.  Accelerations of links:
gravity may count as an acceleration of the base, or as a force of its own.

The parameters a of τ = Y a are the student's to choose.  Many pairs (Y, a) have one product: an a of which
every coefficient of the forces is a combination is right, and the Y that belongs to it is the key from
then on; where a is absent or wrong, but some a belongs to the student's Y, that a is the key.

Constraints: A_c is right where its rows span those of the key's; its rate is that of the student's own A_c,
and the multipliers are right where A_cᵀ λ is.  What differs from that for every state, and not where
h = 0 and A_c q̇ = 0, is right too: that is held in numbers, at states of a fixed seed.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from enum import StrEnum
from functools import cached_property
from itertools import islice
from typing import TYPE_CHECKING, Any

from msgspec import Struct
from msgspec.structs import replace

from dynsolve.algebra.compact.compactor import Compactor
from dynsolve.algebra.expr import Expr
from dynsolve.algebra.fraction import RationalExpr, add, multiply
from dynsolve.algebra.linear_systems import FractionMatrix, fraction_of
from dynsolve.algebra.matrix import AtState, Matrix
from dynsolve.algebra.ring_values import evaluate
from dynsolve.algebra.sampling import samples
from dynsolve.answers.judging.answer_ring import AnswerRing
from dynsolve.answers.judging.answer_values import AnswerValue, Rows, as_value, same
from dynsolve.answers.judging.entry_comparison import EntryComparer, WrittenEntry, placed, put_numbers
from dynsolve.answers.judging.graph import AnswerGraph
from dynsolve.answers.reading.vocabulary import ENERGY_LEVELS
from dynsolve.derivation.elimination import solved
from dynsolve.derivation.graph import Skipped
from dynsolve.derivation.kinematics import rotation
from dynsolve.derivation.link_frame import accelerations, velocities
from dynsolve.errors import AlgebraError
from dynsolve.notation.unicode import UnicodePrinter
from dynsolve.quantities import action_families, families
from dynsolve.quantities.family import Family
from dynsolve.quantities.index import Quantity
from dynsolve.questions import newton_euler
from dynsolve.questions.newton_euler.recursions import is_standard
from dynsolve.questions.parameters import PARAMETERS, REFERENCE, REGRESSORS
from dynsolve.questions.parameters.derive import missing, parameters_for, reference_forces
from dynsolve.questions.rates.check import orthonormal
from dynsolve.questions.rates.derive import wanted_by_accelerations
from dynsolve.questions.statics import derive as statics
from dynsolve.robot.model import Robot
from dynsolve.robot.questions import reference

if TYPE_CHECKING:
    from dynsolve.answers.judging.key_comparison import KeyComparison


# The table of equivalences


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


class Case(Struct, frozen=True):
    """An answer that is not the key's, by its entries; `compare` compares these.

    `is_equation` says that it was written as one side of `... = 0`.
    """

    graph: AnswerGraph
    node: str
    rows: Sequence[Sequence[WrittenEntry]]
    compare: EntryComparer
    is_equation: bool = False

    @property
    def quantity(self) -> Quantity | None:
        """What the answer is."""
        return self.graph.quantities.of_rule(self.node)

    @property
    def index(self) -> int:
        """Of which body, coordinate or link it is, from 1."""
        return self.quantity.index[0] if self.quantity is not None else 1

    @property
    def robot(self) -> Robot:
        """The robot, in the ring of the answers."""
        return self.graph.robot

    @property
    def key(self) -> Any:
        """The key's value."""
        return self.graph.key(self.node)

    def value(self, like: Any) -> Any:
        """What was written, of the kind of another value; None where it is none."""
        return as_value(tuple(tuple(entry.value for entry in row) for row in self.rows), like)

    def difference(self) -> Expr | None:
        """A scalar less the key; None of a fraction."""
        written = self.rows[0][0].value
        return None if written.divisor is not None else written.numerator - self.key

    def is_entry_by_entry(self, wanted: Iterable[Expr]) -> bool:
        """Whether a column has these entries, as an answer may have them."""
        pairs = zip(wanted, self.rows, strict=True)
        return all(self.compare(entry, row[0]) is not None for entry, row in pairs)


def _with_other_gravity(case: Case, standard: bool) -> bool:
    """Whether an acceleration is right where gravity is counted in the other of the two ways."""
    robot, link = case.robot, case.index
    if is_standard(robot) is not standard:
        return False
    if case.quantity is not None and case.quantity.family is newton_euler.ACL:
        link = robot.bodies[link - 1].link
    gravity = rotation(case.graph.key(f"H{link}")).T @ robot.gravity
    return case.is_entry_by_entry((case.key + (-gravity if standard else gravity)).entries)


def _multiplies(case: Case) -> bool:
    """Whether Y a is right for the student's own a."""
    parameters = case.graph.parameters.get(PARAMETERS[case.node])
    forces = forces_of(case.robot, case.node, case.graph.key)
    Y = case.value(forces)
    return parameters is not None and isinstance(Y, Matrix) and multiplies_to(Y, parameters, forces)


def _refers(case: Case) -> bool:
    """Whether Y_r a = D q̈_r + C q̇_r + g with any C whose C q̇ is right and Ḋ - 2C skew."""
    robot, value, parameters = case.robot, case.graph.key, case.graph.key("a")
    Y = case.value(parameters)
    if not isinstance(Y, Matrix) or Y.shape[1] != len(parameters.rows):
        return False
    forces, ring, D = Y @ parameters, robot.ring, value("D")
    names = [reference(q.name) for q in robot.coordinates]
    C = Matrix.of(ring, ([ring.coefficient(force, name, 1) for name in names] for force in forces.entries))
    skew = D.map(ring.time_derivative) - C - C
    is_skew: bool = (skew + skew.T).is_zero
    is_right: bool = C @ velocities(robot) == value("Cqd")
    return is_skew and is_right and bool(reference_forces(robot, D, C, value("g")) == forces)


def _differs_by_level(case: Case) -> bool:
    """Whether an energy differs from the key by a letter alone, for the energy at the zero of height."""
    difference = case.difference()
    if difference is None or len(difference.poly.monoms()) != 1:
        return False
    used = [g for g in difference.ring.generators if difference.poly.degrees()[g.index] > 0]
    own = case.robot.parameters
    return (
        len(used) == 1
        and used[0].name in ENERGY_LEVELS
        and used[0].name not in own
        and difference.poly.total_degree() == 1
    )


def _differs_by_springs(case: Case) -> bool:
    """Whether an energy differs from the key by a constant in which every term has a stiffness.

    The constant has none of masses or gravity: these have one zero of height for all bodies.
    """
    robot, difference = case.robot, case.difference()
    stored = robot.actions.stored
    if not stored or difference is None:
        return False
    own = _parameters(act.energy for act in stored)
    own -= _parameters((*(body.mass for body in robot.bodies), *robot.gravity.entries))
    symbols = robot.ring.symbol_indices
    stiff = _parameters(act.along[1] if act.along else act.energy for act in stored)
    places = [symbols[name, 0] for name in stiff & own]
    return (
        not difference.is_zero
        and not robot.ring.depends_on_coordinates(difference)
        and _parameters([difference]) <= own
        and all(any(exponents[i] for i in places) for exponents in difference.poly.monoms())
    )


def _parameters(values: Iterable[Expr]) -> set[str]:
    found: set[str] = set()
    for value in values:
        degrees, known = value.poly.degrees(), value.ring.parameters
        found |= {g.name for g in value.ring.generators if degrees[g.index] > 0 and g.name in known}
    return found


def _is_what_motors_give(case: Case) -> bool:
    """Whether forces are D q̈ + C q̇ + friction + g - Q: what is left for the motors."""
    robot, key = case.robot, case.key
    if not robot.questions.loads:
        return False
    parts = tuple(case.graph.key(f"load{i}") for i, _ in enumerate(robot.questions.loads, 1))
    Q = statics.total(robot, parts)
    wanted = (key - Q).entries if isinstance(key, Matrix) else (key - Q[case.index - 1, 0],)
    return case.is_entry_by_entry(wanted)


def _is_multiple(case: Case) -> bool:
    """Whether forces, which are said to be 0, are right up to a factor."""
    if not case.is_equation:
        return False
    robot, key = case.robot, case.key
    first = 0 if isinstance(key, Matrix) else case.index - 1
    wanted = key.entries if isinstance(key, Matrix) else (key,)
    for k, (right, (written,)) in enumerate(zip(wanted, case.rows, strict=True), first):
        if case.compare(right, written) is not None:
            continue
        acceleration, given = robot.coordinates[k].name, written.value.numerator
        own, its = (robot.ring.coefficient(one, acceleration, 2) for one in (given, right))
        if own.is_zero or given * its != right * own:
            return False
    return True


def _holds_friction(case: Case) -> bool:
    """Whether a vector is C q̇ and friction together."""
    key = case.graph.key
    return "friction" in case.graph.answer_ring.rules and case.is_entry_by_entry(
        (key("Cqd") + key("friction")).entries
    )


def _solves(case: Case) -> bool:
    """Whether rates or accelerations of the joints do what is asked of the task."""
    system = _system(case.graph, case.node)
    if system is None:
        return False
    ring = case.graph.answer_ring.ring
    put = placed(case.compare.values, ring)
    J, right = (m.map(lambda entry: put_numbers(RationalExpr(entry), put).numerator) for m in system)
    x = [put_numbers(row[0].value, put) for row in case.rows]
    if sum(len(entry.numerator) + len(entry.denominator) for entry in x) > LONGEST:
        return False
    squares, wanted = J.T @ J, J.T @ right
    return all(
        _sum(map(multiply, map(RationalExpr, row), x), -goal).is_zero
        for row, goal in zip(squares.rows, wanted.entries, strict=True)
    )


def _sum(terms: Iterable[RationalExpr], start: Expr) -> RationalExpr:
    total = RationalExpr(start)
    for term in terms:
        total = add(total, term)
    return total


LONGEST = 400
"""Values with more terms are not put into the equations."""


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


class Equivalence(Struct, frozen=True):
    """What is right though it is not the key: of which families or nodes, by which test, and its words."""

    of: frozenset[Family | str]
    holds: Callable[[Case], bool]
    words: Other


def _row(words: Other, holds: Callable[[Case], bool], *of: Family | str) -> Equivalence:
    return Equivalence(frozenset(of), holds, words)


_ACCELERATIONS = newton_euler.AL, newton_euler.ACL
_FORCES = families.TAU, families.FORCE

EQUIVALENCES = (
    _row(Other.WITH_GRAVITY, lambda case: _with_other_gravity(case, True), *_ACCELERATIONS),
    _row(Other.WITHOUT_GRAVITY, lambda case: _with_other_gravity(case, False), *_ACCELERATIONS),
    _row(Other.OF_THE_PRODUCT, _multiplies, *PARAMETERS),
    _row(Other.WITHOUT_LOADS, _is_what_motors_give, *_FORCES),
    _row(Other.UP_TO_FACTOR, _is_multiple, *_FORCES),
    _row(Other.UP_TO_CONSTANT, _differs_by_level, families.P, families.P_BODY, families.L),
    _row(Other.SPRINGS_FROM_ELSEWHERE, _differs_by_springs, families.P, families.L, action_families.PS),
    _row(Other.WITH_FRICTION, _holds_friction, "Cqd"),
    _row(Other.OF_C, _refers, REFERENCE),
    _row(Other.OF_MANY, _solves, "qd", "qdd"),
)
"""The first row that holds is told."""


def other_solution(case: Case) -> Other | None:
    """How an answer that is not the key's is right all the same; None of a wrong one."""
    of = {case.node} if case.quantity is None else {case.node, case.quantity.family}
    return next((row.words for row in EQUIVALENCES if row.of & of and row.holds(case)), None)


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


def _chosen(robot: Robot, forces: Matrix, Y: Matrix | None, a: Matrix | None) -> Matrix | None:
    try:
        if a is not None and missing(robot, forces, a) is None:
            return a
    except AlgebraError:  # a parameter moves
        pass
    return parameters_for(robot, forces, Y) if Y is not None and len(Y.rows) == len(forces.rows) else None


# Constraints: A_c, its rate and λ, where the constraint holds

STATES = 4
"""So many states on the constraint are looked at."""

_TRIES, _STEPS, _CLOSE = 60, 40, 1e-7


def with_own_constraint(
    own: OwnConstraint, comparisons: Mapping[str, KeyComparison]
) -> dict[str, KeyComparison]:
    """The comparisons, those of A_c, its rate and λ being right where they belong together."""
    found = dict(comparisons)
    for name, is_right in (("Ac", own.matrix), ("Ac_dot", own.rate), ("lambda", own.multipliers)):
        compared = found.get(name)
        if compared is None or compared.answer_value.rows is None or not compared.rows:
            continue
        if not compared.correct or own.is_other:
            other = is_right(compared.answer_value)
            right: tuple[tuple[str | None, ...], ...] = tuple(
                tuple("" if other is not None else None for _ in row) for row in compared.rows
            )
            if other is not None or compared.correct:
                found[name] = replace(compared, right=right, other=other)
        if name == "Ac" and found[name].correct:
            own.rows = compared.answer_value.rows
    return found


class OwnConstraint:
    """The key's constraint, and the matrix that the student writes for it (`rows`)."""

    def __init__(self, graph: AnswerGraph) -> None:
        self.graph, self.ring, self.robot = graph, graph.answer_ring.ring, graph.answer_ring.robot
        self.rows: Rows = self._key("Ac")

    def _key(self, name: str) -> Rows:
        value: Matrix | FractionMatrix = self.graph.key(name)
        return tuple(tuple(map(fraction_of, row)) for row in value.rows)

    @property
    def is_other(self) -> bool:
        """Whether the student's matrix is not the key's."""
        return not same(self.rows, self._key("Ac"))

    # -- the three answers -------------------------------------------------------------------------

    def matrix(self, value: AnswerValue) -> Other | None:
        """Whether the rows span the key's, at every state on the constraint."""
        assert value.rows is not None
        return Other.SAME_CONSTRAINT if self.keeps(value.rows) else None

    def keeps(self, rows: Rows) -> bool:
        """Whether a matrix keeps the same constraint: its rows span the key's at every state on it."""
        key = self._key("Ac")
        for at in self.states:
            mine, theirs = self._numbers(rows, at), self._numbers(key, at)
            if mine is None or theirs is None:
                return False
            rank = len(orthonormal(theirs))
            if len(orthonormal(mine)) != rank or len(orthonormal([*theirs, *mine])) != rank:
                return False
        return bool(self.states)

    def rate(self, value: AnswerValue) -> Other | None:
        """Whether it is the rate of the student's matrix."""
        return self._agree(value.rows, tuple(tuple(map(self._rate, row)) for row in self.rows))

    def multipliers(self, value: AnswerValue) -> Other | None:
        """Whether A_cᵀ λ is the key's."""
        assert value.rows is not None
        mine = self._forces(self.rows, [row[0] for row in value.rows])
        return self._agree((mine,), (self._forces(self._key("Ac"), [row[0] for row in self._key("lambda")]),))

    def _forces(self, A: Rows, multipliers: Sequence[RationalExpr]) -> tuple[RationalExpr, ...]:
        """A_cᵀ λ"""
        zero = self.ring.zero
        return tuple(_sum(map(multiply, column, multipliers), zero) for column in zip(*A, strict=True))

    def _rate(self, entry: RationalExpr) -> RationalExpr:
        """d/dt of a fraction."""
        above, below = entry.numerator, entry.denominator
        rate = self.ring.time_derivative
        if entry.divisor is None:
            return RationalExpr(rate(above))
        return RationalExpr(rate(above) * below - above * rate(below), below * below)

    # -- equality, for every state or on the constraint --------------------------------------------

    def _agree(self, mine: Rows | None, theirs: Rows) -> Other | None:
        if mine is None or [len(row) for row in mine] != [len(row) for row in theirs]:
            return None
        if same(mine, theirs):
            return Other.SAME_CONSTRAINT
        gaps = (self._gap(mine, theirs, at) for at in self.states)
        return Other.ON_CONSTRAINT if self.states and all(gap < _CLOSE for gap in gaps) else None

    def _gap(self, mine: Rows, theirs: Rows, at: Mapping[str, float]) -> float:
        ours, keys = self._numbers(mine, at), self._numbers(theirs, at)
        if ours is None or keys is None:
            return float("inf")
        size = max((1.0, *(abs(x) for row in keys for x in row)))
        return (
            max(
                abs(a - b)
                for row, other in zip(ours, keys, strict=True)
                for a, b in zip(row, other, strict=True)
            )
            / size
        )

    def _numbers(self, rows: Rows, at: Mapping[str, float]) -> list[list[float]] | None:
        try:
            return [[self._number(entry, at) for entry in row] for row in rows]
        except (ValueError, ZeroDivisionError):
            return None

    def _number(self, entry: RationalExpr, at: Mapping[str, float]) -> float:
        above = evaluate(entry.numerator, at)
        return above if entry.divisor is None else above / evaluate(entry.divisor, at)

    # -- states on the constraint ------------------------------------------------------------------

    @cached_property
    def states(self) -> list[dict[str, float]]:
        """States with h = 0 and A_c q̇ = 0."""
        tried = map(self._state, islice(samples(self.ring), _TRIES))
        return list(islice((state for state in tried if state is not None), STATES))

    def _state(self, at: dict[str, float]) -> dict[str, float] | None:
        try:
            if not self._moved_to_zero(at):
                return None
            rates = [at[q.velocity] for q in self.robot.coordinates]
            for row in orthonormal(self._required(self._key("Ac"), at)):
                along = sum(a * b for a, b in zip(row, rates, strict=True))
                rates = [b - along * a for a, b in zip(row, rates, strict=True)]
        except (ValueError, ZeroDivisionError):
            return None
        return {**at, **{q.velocity: rate for q, rate in zip(self.robot.coordinates, rates, strict=True)}}

    def _required(self, rows: Rows, at: Mapping[str, float]) -> list[list[float]]:
        return [[self._number(entry, at) for entry in row] for row in rows]

    def _moved_to_zero(self, at: dict[str, float]) -> bool:
        """Newton's method towards h = 0, by the shortest steps Aᵀ (A Aᵀ)⁻¹ h."""
        holonomic = [i for i, one in enumerate(self.robot.questions.constraints) if not one.in_rates]
        matrix, functions = self._key("Ac"), self._key("hc") if holonomic else ()
        for _ in range(_STEPS):
            h = [row[0] for row in self._required(functions, at)]
            if all(abs(x) < 1e-13 for x in h):
                return True
            A = self._required(tuple(matrix[i] for i in holonomic), at)
            square = [[sum(a * b for a, b in zip(row, other, strict=True)) for other in A] for row in A]
            step = solved(square, h)
            for k, q in enumerate(self.robot.coordinates):
                at[q.name] -= sum(row[k] * x for row, x in zip(A, step, strict=True))
        return False
