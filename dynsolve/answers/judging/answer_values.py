"""The answers of a hand-in with their values, in one answer_ring.

Every answer is admitted to the ring by itself: one that cannot be held is
unreadable and leaves the others as they are.  Names that occur inside a value stand
for the student's own answers, and for the key's where there is none.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from dynsolve.algebra.expr import Expr
from dynsolve.algebra.fraction import RationalExpr, as_expr, equal
from dynsolve.algebra.matrix import Matrix
from dynsolve.answers.judging.answer_ring import AnswerRing, AnswerRingBuilder
from dynsolve.answers.judging.evaluate import AnswerEvaluator
from dynsolve.answers.judging.graph import AnswerGraph
from dynsolve.answers.submission import Answer
from dynsolve.errors import AlgebraError
from dynsolve.notation import tree
from dynsolve.notation.tree import Node, Reference

Rows = tuple[tuple[RationalExpr, ...], ...]

MOST_ENTRIES = 144
"""The most entries of a matrix that is judged."""


@dataclass(frozen=True, slots=True)
class AnswerValue:
    """One answer with its value: rows of entries, a scalar as 1×1; `fault` where there is none."""

    answer: Answer
    rows: Rows | None
    nodes: tuple[tuple[Node, ...], ...] = ()
    fault: str = ""
    expected: str = ""

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
        self._faults: dict[int, tuple[str, str]] = {}
        for place, answer in enumerate(answers):
            if answer.node is None:
                self._faults[place] = answer.fault or "this could not be read", answer.expected
                continue
            try:
                builder.admit(answer.node)
            except AlgebraError as error:
                self._faults[place] = error.message, error.help
        self.answer_ring: AnswerRing = builder.build()
        self.graph = AnswerGraph(self.answer_ring)
        self.answers = tuple(answers)
        self._last = {a.name: place for place, a in enumerate(answers) if place not in self._faults}
        self._values: dict[int, AnswerValue] = {}
        self._busy: set[int] = set()
        self.evaluator = AnswerEvaluator(self.answer_ring.ring, self.lookup, self.answer_ring.known_values)
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
        assert answer.node is not None
        nodes = _entries(answer.node)
        if len(nodes) * len(nodes[0]) > MOST_ENTRIES:
            return AnswerValue(
                answer, None, nodes, "the matrix is too large", f"at most {MOST_ENTRIES} entries"
            )
        self.evaluator.work = 0
        try:
            rows = tuple(tuple(self.evaluator.value(node) for node in row) for row in nodes)
        except AlgebraError as error:
            return AnswerValue(answer, None, nodes, error.message, error.help)
        return AnswerValue(answer, rows, nodes)

    def lookup(self, reference: Reference) -> RationalExpr:
        """The value of an answer that occurs inside another."""
        name, row, column = reference.quantity, reference.row, reference.column
        own = self._own(name, row, column)
        return self._from_key(name, row, column) if own is None else own

    def _own(self, name: str, row: int | None, column: int | None) -> RationalExpr | None:
        """The student's own value: of the answer itself, or of the matrix that it is an entry of."""
        place = self._last.get(name)
        if place is None:
            name, entry = self.graph.quantities.entry_of(name)
            if len(entry) != 2:
                return None
            row, column = entry[0] + 1, entry[1] + 1
            place = self._last.get(name)
        if place is None or place in self._busy:
            return None
        work = self.evaluator.work
        value = self._value(place)
        self.evaluator.work = work
        return None if value.rows is None else _entry(value.rows, row, column)

    def _from_key(self, name: str, row: int | None, column: int | None) -> RationalExpr:
        quantity = self.graph.quantities.get(name)
        if quantity is None or quantity.rule not in self.answer_ring.rules:
            raise AlgebraError(f"{name} is not a quantity of this problem")
        value = self.answer_ring.key(quantity.rule)
        if quantity.is_read_off:
            return RationalExpr(value[quantity.entry])
        if isinstance(value, Matrix):
            if row is None or column is None or row > value.shape[0] or column > value.shape[1]:
                raise AlgebraError(f"{name} is a matrix and stands where a number should")
            return RationalExpr(value[row - 1, column - 1])
        return RationalExpr(value)

    def changed(self, node: Node) -> RationalExpr:
        """The value of a tree that is an answer's but for a decimal."""
        self.evaluator.work = 0
        return self.evaluator.value(node)


def _entries(node: Node) -> tuple[tuple[Node, ...], ...]:
    return node.rows if isinstance(node, tree.Matrix) else ((node,),)


def _entry(rows: Rows, row: int | None, column: int | None) -> RationalExpr | None:
    if row is None or column is None:
        return rows[0][0] if len(rows) == 1 and len(rows[0]) == 1 else None
    if row <= len(rows) and column <= len(rows[0]):
        return rows[row - 1][column - 1]
    if len(rows) == 1 and column == 1 and row <= len(rows[0]):  # a column written as a row
        return rows[0][row - 1]
    return None


def same(a: Rows, b: Rows) -> bool:
    """Whether two values are equal, entry by entry."""
    if len(a) != len(b) or len(a[0]) != len(b[0]):
        return False
    return all(equal(x, y) for r, s in zip(a, b, strict=True) for x, y in zip(r, s, strict=True))


def as_value(rows: Rows, like: Expr | Matrix) -> Expr | Matrix | None:
    """The value as one of the ring, of the key's shape; None where it is none."""
    exprs = [[as_expr(entry) for entry in row] for row in rows]
    if any(e is None for row in exprs for e in row):
        return None
    flat: Iterable[Iterable[Expr]] = [[e for e in row if e is not None] for row in exprs]
    matrix = Matrix.of(rows[0][0].ring, flat)
    return matrix if isinstance(like, Matrix) else matrix[0, 0]


def fitted(rows: Rows, like: Expr | Matrix) -> Rows | None:
    """The rows in the key's shape: a row for a column, 0 for a zero vector; None where they do not fit."""
    shape = like.shape if isinstance(like, Matrix) else (1, 1)
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
