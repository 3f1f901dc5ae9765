"""What a name inside a value stands for: an answer of the student's own, wherever it stands in the file.

A quantity that is given in another way is taken from there: an entry from its matrix, a
matrix from its entries, a sum from its parts, C q̇ from C, a velocity from its Jacobian.
What the problem states (the tensors of the bodies) and what is no answer (rotations, axes)
is the key's.  Anything else that the student gives nowhere makes the equation a
definition: it says what a quantity is, and not what it comes to.
"""

from __future__ import annotations

from collections.abc import Callable, Container, Iterator, Sequence
from typing import NoReturn

from dynsolve.algebra.expr import Expr
from dynsolve.algebra.fraction import RationalExpr, as_expr
from dynsolve.algebra.matrix import Matrix
from dynsolve.answers.judging.graph import AnswerGraph
from dynsolve.answers.judging.planar import unfolded
from dynsolve.answers.submission import Answer
from dynsolve.errors import AlgebraError
from dynsolve.notation.tree import Reference
from dynsolve.quantities import families
from dynsolve.quantities import kinematic_families as asked

Rows = tuple[tuple[RationalExpr, ...], ...]

_BY_RATES = {families.CQD: "C", families.V: "Jv", families.W: "Jw", asked.V_POINT: "Jv"}
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
        """The student's own value, however it is given; None where it is not."""
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
            yield self._times_rates(_BY_RATES[family] + name[len(family.name.partition("{")[0]) :], row)

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
        """A row of a matrix times q̇."""
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
