"""The answers of a hand-in with their values, in one answer_ring.

Every answer is admitted to the ring by itself: one that cannot be held is
unreadable and leaves the others as they are.  Names that occur inside a value stand
for the student's own answers (`own_names`); one that is given nowhere makes it a definition.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from dynsolve.algebra.expr import Expr
from dynsolve.algebra.fraction import RationalExpr, as_expr, equal
from dynsolve.algebra.fraction_matrix import FractionMatrix
from dynsolve.algebra.matrix import Matrix
from dynsolve.answers.judging.answer_ring import AnswerRing, AnswerRingBuilder
from dynsolve.answers.judging.evaluate import AnswerEvaluator
from dynsolve.answers.judging.graph import AnswerGraph
from dynsolve.answers.judging.inputs import with_inputs
from dynsolve.answers.judging.own_coordinates import in_problems_coordinates
from dynsolve.answers.judging.own_names import GivenNowhereError, OwnNames, Rows
from dynsolve.answers.submission import Answer
from dynsolve.errors import AlgebraError
from dynsolve.notation import tree
from dynsolve.notation.tree import Node, Reference
from dynsolve.quantities.index import quantities

MOST_ENTRIES = 144
"""The most entries of a matrix that is judged."""


@dataclass(frozen=True, slots=True)
class AnswerValue:
    """One answer with its value: rows of entries, a scalar as 1×1; `fault` where there is none.

    `read` are the rows where only some entries could be read, 0 for the others.
    `is_definition` says that the value needs what is given nowhere, which `fault` names.
    """

    answer: Answer
    rows: Rows | None
    nodes: tuple[tuple[Node, ...], ...] = ()
    fault: str = ""
    expected: str = ""
    is_definition: bool = False
    read: Rows | None = None

    @property
    def is_matrix(self) -> bool:
        """Whether it was written as a matrix."""
        return isinstance(self.answer.node, tree.Matrix)

    @property
    def entries(self) -> tuple[RationalExpr, ...]:
        """All entries, row by row."""
        return tuple(entry for row in self.rows or () for entry in row)


class AnswerValues:
    """All answers of one hand-in, valued in a ring that refines `base`, the problem's."""

    def __init__(self, base: AnswerRing, answers: Sequence[Answer]) -> None:
        builder = AnswerRingBuilder(base)
        named = quantities(base.robot)
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
        self.graph = AnswerGraph(self.answer_ring)
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
        nodes = _entries(self._nodes[place])
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


def _entries(node: Node) -> tuple[tuple[Node, ...], ...]:
    return node.rows if isinstance(node, tree.Matrix) else ((node,),)


def same(a: Rows, b: Rows) -> bool:
    """Whether two values are equal, entry by entry."""
    if len(a) != len(b) or len(a[0]) != len(b[0]):
        return False
    return all(equal(x, y) for r, s in zip(a, b, strict=True) for x, y in zip(r, s, strict=True))


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
