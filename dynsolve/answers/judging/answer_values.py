"""The answers of a hand-in with their values, in one answer_ring.

Every answer is admitted to the ring by itself: one that cannot be held is
unreadable and leaves the others as they are.  Names that occur inside a value stand
for the student's own answers (`OwnNames`); one that is given nowhere makes it a definition.

Where the student's coordinate is -q_i plus a constant, the rates and the generalized force
of it have the other sign.  With S the diagonal matrix of the signs: τ, f, g, C q̇, dLdqd, ddt
and dLdq become S times themselves, D and C become S D S and S C S, a Jacobian J S,
and c_ijk takes the signs of all three; energies, positions and velocities stay.

What a name inside a value stands for: an answer of the student's own, wherever it stands in the file.

A quantity that is given in another way is taken from there: an entry from its matrix, a
matrix from its entries, a sum from its parts, C q̇ from C, a velocity from its Jacobian.
What the problem states (the tensors of the bodies) and what is no answer (rotations, axes)
is the key's.  Anything else that the student gives nowhere makes the equation a
definition: it says what a quantity is, and not what it comes to.

In q̈ = D⁻¹ (τ + Q - C q̇ - g) and λ = -(A_c D⁻¹ A_cᵀ)⁻¹ (A_c D⁻¹ (τ + Q - C q̇ - g) + Ȧ_c q̇) a name as τ₁
is what a motor gives, never the student's own answer τ₁, which holds the accelerations; a coordinate
without a motor has none.  In equations of motion, D q̈ + C q̇ + g - A_cᵀ λ, a name as λ₁ is the force of a
constraint, and never the answer λ.

A robot is planar where no point of it ever moves along one axis and everything turns about
that axis alone.  Then 2-vectors, J_v as 2×n, J_ω as 1×n and J as 3×n (the velocity in
the plane, and the rotation) say all that there is to say.
"""

from __future__ import annotations

from collections.abc import Callable, Container, Iterable, Iterator, Sequence
from typing import NoReturn, TypeVar

from msgspec import Struct

from dynsolve.algebra.fraction import RationalExpr, as_expr, equal
from dynsolve.algebra.linear_systems import FractionMatrix
from dynsolve.algebra.matrix import Matrix
from dynsolve.algebra.ring import Expr
from dynsolve.answers.judging.answer_ring import AnswerRing, AnswerRingBuilder
from dynsolve.answers.judging.evaluate import AnswerEvaluator
from dynsolve.answers.judging.graph import AnswerGraph
from dynsolve.answers.verdict import Answer
from dynsolve.errors import AlgebraError
from dynsolve.notation import tree
from dynsolve.notation.tree import Matrix as MatrixTree
from dynsolve.notation.tree import Negative, Node, Number, Reference, Symbol, with_children
from dynsolve.quantities import families
from dynsolve.quantities.family import Owner
from dynsolve.quantities.index import Quantities, Quantity, quantities
from dynsolve.questions import forward_dynamics, rates, statics, task
from dynsolve.questions.constraints import MULTIPLIERS
from dynsolve.robot.model import Robot
from dynsolve.robot.names import free, marks, names_taken

# Names of generalized forces in what is solved for: the inputs of the motors


def with_inputs(robot: Robot, named: Quantities, name: str, node: Node) -> Node:
    """The tree of the answer `name`, forces and multipliers being inputs in those that hold them."""
    if families.holds_forces(name):
        return _with_forces(robot, named, node)
    if robot.questions.constraints and named[name].family in (families.TAU, families.FORCE):
        return _with_multipliers(robot, named, node)
    return node


def _with_forces(robot: Robot, named: Quantities, node: Node) -> Node:
    def put(part: Node) -> Node:
        match part:
            case Reference(quantity, row) if named[quantity].family in (families.TAU, families.FORCE):
                k = named[quantity].index[0] - 1 if row is None else row - 1
                return Number(0) if k in robot.actions.passive else Symbol(robot.inputs[k])
        return with_children(part, put)

    return put(node)


def _with_multipliers(robot: Robot, named: Quantities, node: Node) -> Node:
    names = multiplier_names(robot)

    def put(part: Node) -> Node:
        match part:
            case Reference(quantity, row) if named[quantity].family in MULTIPLIERS:
                return Symbol(names[(*named[quantity].index, row or 1)[0] - 1])
        return with_children(part, put)

    return put(node)


def multiplier_names(robot: Robot) -> tuple[str, ...]:
    """Names for λ_1, λ_2, ..., which nothing else has."""
    count = len(robot.questions.constraints)
    offers = ([f"lambda{mark}{i}" for i in range(1, count + 1)] for mark in marks())
    return free(offers, names_taken(robot))


# Answers in the student's own coordinates, as they read in the problem's

_OF_ROWS = (
    families.TAU, families.G, families.CQD, statics.Q, statics.TAU_STATIC,
    rates.QD, rates.QDD, forward_dynamics.QDD_FORWARD,
)  # fmt: skip
_OF_COLUMNS = (
    families.JV, families.JW, families.J, families.JV_BODY, families.JW_BODY, task.JV_POINT, task.JW_POINT,
    task.JV_DOT, task.JW_DOT, task.J_DOT, task.JR, task.JR_DOT,
)  # fmt: skip
_OF_BOTH = (families.D, families.C)


def in_problems_coordinates(answer: Answer, quantities: Quantities) -> Node | None:
    """The tree of an answer with the signs that it has in the coordinates of the problem."""
    node = answer.node
    if node is None or not answer.turned:
        return node
    order = [q.name for q in quantities.owners.coordinates]
    turned = {order.index(name) for name in answer.turned}

    def is_turned(name: str, row: int, column: int) -> bool:
        quantity = quantities.get(name)
        found = () if quantity is None else _coordinates(quantity, row, column)
        return sum(k in turned for k in found) % 2 == 1

    node = _references_turned(node, is_turned)
    if not isinstance(node, MatrixTree):
        return Negative(node) if is_turned(answer.name, 0, 0) else node
    is_row = len(node.rows) == 1 and (quantities[answer.name].shape or (1, 1))[1] == 1
    return MatrixTree(
        tuple(
            tuple(
                Negative(entry) if is_turned(answer.name, j if is_row else i, j) else entry
                for j, entry in enumerate(row)
            )
            for i, row in enumerate(node.rows)
        )
    )


def _references_turned(node: Node, is_turned: Callable[[str, int, int], bool]) -> Node:
    """The student's own answers, which are kept in the problem's coordinates, turned back."""
    if isinstance(node, Reference):
        turned = is_turned(node.quantity, (node.row or 1) - 1, (node.column or 1) - 1)
        return Negative(node) if turned else node
    return with_children(node, lambda child: _references_turned(child, is_turned))


def _coordinates(quantity: Quantity, row: int, column: int) -> tuple[int, ...]:
    """The coordinates whose signs an entry takes, from 0."""
    family = quantity.family
    if family in _OF_ROWS:
        return (row,)
    if family in _OF_COLUMNS:
        return (column,)
    if family in _OF_BOTH:
        return row, column
    if family.owner in (Owner.COORDINATE, Owner.PAIR, Owner.TRIPLE):
        return tuple(i - 1 for i in quantity.index)
    return ()


# Planar robots: vectors and Jacobians without the rows that are zero for every q

_LINEAR = (
    families.RC, families.V, families.JV, families.JV_BODY,
    task.P_POINT, task.V_POINT, task.JV_POINT, task.JV_DOT,
)  # fmt: skip
_ANGULAR = (families.W, families.JW, families.JW_BODY, task.JW_POINT, task.JW_DOT)
_BOTH = (families.J, task.J_DOT)
_POSITIONS = (families.RC, task.P_POINT)

Entry = TypeVar("Entry")


class Plane(Struct, frozen=True):
    """The axes across the plane of a robot; several where it slides along one line and turns nowhere."""

    across: tuple[int, ...]

    def kept(self, quantity: Quantity) -> Iterator[tuple[int, ...]]:
        """The rows that may be handed in alone, from 0."""
        for axis in self.across:
            within = tuple(row for row in range(3) if row != axis)
            if quantity.family in _LINEAR:
                yield within
            elif quantity.family in _ANGULAR:
                yield (axis,)
            elif quantity.family in _BOTH:
                yield (*within, 3 + axis)


def plane(answer_ring: AnswerRing) -> Plane | None:
    """The plane of a planar robot, None for all others."""
    named = quantities(answer_ring.robot)
    found = [q for q in named.values() if q.family in (*_LINEAR, *_ANGULAR) and q.family not in _POSITIONS]
    keys = [(q, answer_ring.key(q.rule)) for q in found if q.rule in answer_ring.rules]
    moving = {i for q, key in keys if q.family in _LINEAR for i in _rows_that_move(key)}
    turning = {i for q, key in keys if q.family in _ANGULAR for i in _rows_that_move(key)}
    still = set(range(3)) - moving
    if not still or not turning <= still or len(turning) > 1:
        return None
    return Plane(tuple(sorted(turning or still)))


def _rows_that_move(key: Matrix) -> list[int]:
    return [i for i, row in enumerate(key.rows) if any(not entry.is_zero for entry in row)]


def unfolded(
    answer_ring: AnswerRing, quantity: Quantity, rows: Sequence[Sequence[Entry]], zero: Entry
) -> tuple[tuple[Entry, ...], ...] | None:
    """Rows with those that are zero for every q put in again; None where they do not fit."""
    if quantity.family not in (*_LINEAR, *_ANGULAR, *_BOTH) or quantity.rule not in answer_ring.rules:
        return None
    key: Matrix = answer_ring.key(quantity.rule)
    height, width = key.shape
    given = [list(row) for row in rows]
    if width == 1 and len(given) == 1:
        given = [[entry] for entry in given[0]]
    if len(given) >= height or len(given[0]) != width:
        return None
    found = plane(answer_ring)
    for kept in found.kept(quantity) if found is not None else ():
        left_out = set(range(height)) - set(kept)
        if len(kept) == len(given) and not left_out & set(_rows_that_move(key)):
            filled = dict(zip(kept, given, strict=True))
            return tuple(tuple(filled.get(i, [zero] * width)) for i in range(height))
    return None


# What a name inside a value stands for

Rows = tuple[tuple[RationalExpr, ...], ...]

_BY_RATES = {families.CQD: "C", families.V: "Jv", families.W: "Jw", task.V_POINT: "Jv"}
"""What is a matrix times q̇, and how the name of that matrix begins."""


class GivenNowhereError(AlgebraError):
    """A value needs a quantity that the student gives nowhere."""

    def __init__(self, name: str) -> None:
        super().__init__(f"{name} stands in it and is given nowhere: this is a definition")
        self.name = name


class OwnNames:
    """Values of names; `rows` gives the value of the answer at a place, None where it has none.

    `unreadable` are the places of answers that could not be read.
    """

    def __init__(
        self,
        graph: AnswerGraph,
        answers: Sequence[Answer],
        rows: Callable[[int], Rows | None],
        unreadable: Container[int],
    ) -> None:
        self.graph = graph
        self.answer_ring = graph.answer_ring
        self._rows = rows
        self._unreadable = unreadable
        self._busy: set[str] = set()
        self._places: dict[str, list[int]] = {}
        for place, answer in enumerate(answers):
            self._places.setdefault(answer.name, []).insert(0, place)
        for place, answer in enumerate(answers):
            for other in answer.alternatives:
                self._places.setdefault(other, [place])

    def __call__(self, reference: Reference) -> RationalExpr:
        """The value of a name, or of the entry of a matrix."""
        name, row, column = reference.quantity, reference.row, reference.column
        quantity = self.graph.quantities.get(name)
        if quantity is None or quantity.rule not in self.answer_ring.rules:
            raise AlgebraError(f"{name} is not a quantity of this problem")
        own = self._own(name, row, column)
        if own is not None:
            return own
        if quantity.family.is_answer and quantity.family is not families.I_BODY:
            self._refuse(name)
        return self._from_key(name, row, column)

    def _refuse(self, name: str) -> NoReturn:
        """Say why a name has no value: it is given and cannot be read, or it is given nowhere."""
        for given in (name, self.graph.quantities.entry_of(name)[0]):
            if any(place in self._unreadable for place in self._places.get(given, ())):
                raise AlgebraError(f"{given} stands in it and could not be read", f"mend {given} first")
        raise GivenNowhereError(name)

    def _own(self, name: str, row: int | None, column: int | None) -> RationalExpr | None:
        if name in self._busy:
            return None
        self._busy.add(name)
        try:
            return next((v for v in self._ways(name, row, column) if v is not None), None)
        finally:
            self._busy.discard(name)

    def _ways(self, name: str, row: int | None, column: int | None) -> Iterator[RationalExpr | None]:
        quantities = self.graph.quantities
        yield self._given(name, row, column)
        mirrored = quantities.mirrored(name)
        if mirrored != name:
            yield self._given(mirrored, row, column)
        whole, entry = quantities.entry_of(name)
        if len(entry) == 2:
            yield self._own(whole, entry[0] + 1, entry[1] + 1)
        yield self._from_parts(name, row, column)
        family = quantities[name].family
        if family in _BY_RATES and row is not None:
            yield self._times_rates(_BY_RATES[family] + name[len(family.stem) :], row)

    def _given(self, name: str, row: int | None, column: int | None) -> RationalExpr | None:
        for place in self._places.get(name, ()):
            rows = self._rows(place)
            if rows is not None:
                zero = RationalExpr(self.answer_ring.ring.zero)
                whole = unfolded(self.answer_ring, self.graph.quantities[name], rows, zero)
                return _entry(rows if whole is None else whole, row, column)
        return None

    def _from_parts(self, name: str, row: int | None, column: int | None) -> RationalExpr | None:
        """An entry that is given by itself, or the sum of what a quantity is added up from."""
        quantities = self.graph.quantities
        parts = quantities.parts(name)
        if row is not None and column is not None:
            found = next((p for p in parts if quantities[p].entry == (row - 1, column - 1)), None)
            return None if found is None else self._own(found, None, None)
        if not parts or any(quantities[part].entry for part in parts):
            return None
        total = self.answer_ring.ring.zero
        for part in parts:
            value = self._expr(part)
            if value is None:
                return None
            total = total + value
        return RationalExpr(total)

    def _times_rates(self, matrix: str, row: int) -> RationalExpr | None:
        ring = self.answer_ring.ring
        total = ring.zero
        for column, name in enumerate(ring.names, 1):
            value = self._expr(matrix, row, column)
            if value is None:
                return None
            total = total + value * ring.symbol(name, 1)
        return RationalExpr(total)

    def _expr(self, name: str, row: int | None = None, column: int | None = None) -> Expr | None:
        value = self._own(name, row, column)
        return None if value is None else as_expr(value)

    def _from_key(self, name: str, row: int | None, column: int | None) -> RationalExpr:
        quantity = self.graph.quantities[name]
        value = self.answer_ring.key(quantity.rule)
        if not isinstance(value, Matrix):
            return RationalExpr(value)
        if row is None or column is None or row > value.shape[0] or column > value.shape[1]:
            raise AlgebraError(f"{name} is a matrix and stands where a number should")
        return RationalExpr(value[row - 1, column - 1])


def _entry(rows: Rows, row: int | None, column: int | None) -> RationalExpr | None:
    if row is None or column is None:
        return rows[0][0] if len(rows) == 1 and len(rows[0]) == 1 else None
    if row <= len(rows) and column <= len(rows[0]):
        return rows[row - 1][column - 1]
    if len(rows) == 1 and column == 1 and row <= len(rows[0]):  # a column written as a row
        return rows[0][row - 1]
    return None


MOST_ENTRIES = 144
"""The most entries of a matrix that is judged."""


class AnswerValue(Struct, frozen=True):
    """One answer with its value: rows of entries, a scalar as 1×1; `fault` where there is none.

    `read` are the rows where only some entries could be read, 0 for the others.
    `is_definition` says that the value needs what is given nowhere, which `fault` names.
    `put` is what was put into the entries, as a given state.
    """

    answer: Answer
    rows: Rows | None
    nodes: tuple[tuple[Node, ...], ...] = ()
    fault: str = ""
    expected: str = ""
    is_definition: bool = False
    read: Rows | None = None
    put: Callable[[RationalExpr], RationalExpr] | None = None

    @property
    def is_matrix(self) -> bool:
        """Whether it was written as a matrix."""
        return isinstance(self.answer.node, tree.Matrix)

    @property
    def entries(self) -> tuple[RationalExpr, ...]:
        """All entries, row by row."""
        return tuple(entry for row in self.rows or () for entry in row)


class AnswerValues:
    """All answers of one hand-in, valued in a ring that refines that of `key`, the problem's graph."""

    def __init__(self, key: AnswerGraph, answers: Sequence[Answer]) -> None:
        base, named = key.answer_ring, key.quantities
        builder = AnswerRingBuilder(base)
        self._nodes: dict[int, Node] = {}
        self._faults: dict[int, tuple[str, str]] = {}
        for place, answer in enumerate(answers):
            node = answer.node or answer.partial
            if node is None:
                self._faults[place] = answer.fault or "this could not be read", answer.expected
                continue
            try:
                turned = in_problems_coordinates(answer, named) or node
                self._nodes[place] = with_inputs(base.robot, named, answer.name, turned)
                builder.admit(self._nodes[place])
            except AlgebraError as error:
                self._faults[place] = error.message, error.help
        self.answer_ring: AnswerRing = builder.build()
        self.graph = key if self.answer_ring is base else AnswerGraph(self.answer_ring)
        self.answers = tuple(answers)
        self._values: dict[int, AnswerValue] = {}
        self._busy: set[int] = set()
        self._names = OwnNames(self.graph, answers, self._rows_at, self._faults)
        self.evaluator = AnswerEvaluator(self.answer_ring.ring, self._lookup, self.answer_ring.known_values)
        self.all: tuple[AnswerValue, ...] = tuple(self._value(place) for place in range(len(answers)))

    def _value(self, place: int) -> AnswerValue:
        found = self._values.get(place)
        if found is None:
            self._busy.add(place)
            found = self._values[place] = self._evaluate(place)
            self._busy.discard(place)
        return found

    def _evaluate(self, place: int) -> AnswerValue:
        answer = self.answers[place]
        if place in self._faults:
            return AnswerValue(answer, None, (), *self._faults[place])
        node = self._nodes[place]
        nodes = node.rows if isinstance(node, tree.Matrix) else ((node,),)
        if len(nodes) * len(nodes[0]) > MOST_ENTRIES:
            return AnswerValue(
                answer, None, nodes, "the matrix is too large", f"at most {MOST_ENTRIES} entries"
            )
        self.evaluator.work = 0
        try:
            rows = tuple(tuple(self.evaluator.value(node) for node in row) for row in nodes)
        except GivenNowhereError as error:
            return AnswerValue(answer, None, nodes, error.message, is_definition=True)
        except AlgebraError as error:
            return AnswerValue(answer, None, nodes, error.message, error.help)
        if answer.partial is not None:
            return AnswerValue(answer, None, nodes, answer.fault, answer.expected, read=rows)
        return AnswerValue(answer, rows, nodes)

    def _lookup(self, reference: Reference) -> RationalExpr:
        """The value of an answer that occurs inside another, whose work is not this one's."""
        work = self.evaluator.work
        try:
            return self._names(reference)
        finally:
            self.evaluator.work = work

    def _rows_at(self, place: int) -> Rows | None:
        """The value of the answer at a place; None while it is being worked out itself."""
        return None if place in self._busy else self._value(place).rows

    def changed(self, node: Node) -> RationalExpr:
        """The value of a tree that is an answer's but for a decimal."""
        self.evaluator.work = 0
        return self.evaluator.value(node)


def as_value(rows: Rows, like: Expr | Matrix | FractionMatrix) -> Expr | Matrix | None:
    """The value as one of the ring, of the key's shape; None where it is none."""
    exprs = [[as_expr(entry) for entry in row] for row in rows]
    if any(e is None for row in exprs for e in row):
        return None
    flat: Iterable[Iterable[Expr]] = [[e for e in row if e is not None] for row in exprs]
    matrix = Matrix.of(rows[0][0].ring, flat)
    return matrix if isinstance(like, Matrix | FractionMatrix) else matrix[0, 0]


def fitted(rows: Rows, like: Expr | Matrix | FractionMatrix) -> Rows | None:
    """The rows in the key's shape: a row for a column, 0 for a zero vector; None where they do not fit."""
    shape = like.shape if isinstance(like, Matrix | FractionMatrix) else (1, 1)
    mine = len(rows), len(rows[0])
    if mine == shape:
        return rows
    flat = tuple(entry for row in rows for entry in row)
    if 1 in shape and 1 in mine and len(flat) == shape[0] * shape[1]:
        return tuple((entry,) for entry in flat) if shape[1] == 1 else (flat,)
    if mine == (1, 1) and flat[0].is_zero:
        return ((flat[0],) * shape[1],) * shape[0]
    if shape == (3, 1) and len(flat) == 4 and 1 in mine and equal(flat[3], RationalExpr(flat[3].ring.one)):
        return tuple((entry,) for entry in flat[:3])
    if shape == (4, 4) and mine == (3, 4):
        ring = flat[0].ring
        return (*rows, (*(RationalExpr(ring.zero),) * 3, RationalExpr(ring.one)))
    return None
