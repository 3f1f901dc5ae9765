"""Which value that a student's own answers lead to explains an answer that differs from the key.

An answer *follows* where it is not the key's and equals what the student's own earlier
answers lead to (see `follow_through`).  One such value should explain the whole of a
matrix; where none does, each entry is compared by itself.
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import islice
from typing import Any

from dynsolve.algebra.matrix import Matrix
from dynsolve.answers.judging.direction import Direction
from dynsolve.answers.judging.follow_through import PossibleValue
from dynsolve.answers.judging.hand_in import ComparedHandIn
from dynsolve.answers.judging.key_comparison import KeyComparison, Target
from dynsolve.answers.judging.student_values import student_values

MOST_EXPECTED = 4
"""So many of the values that a student's own answers lead to are looked at for a slip."""


class Explanations:
    """Explains the answers of one hand-in by its own earlier answers."""

    def __init__(self, hand_in: ComparedHandIn) -> None:
        self.hand_in = hand_in
        students = student_values(hand_in.graph, hand_in.comparisons)
        order = {name: chains[0][0].answer.occurrence[0] for name, chains in hand_in.chains.items()}
        self.direction = Direction(hand_in.graph, students, hand_in.comparisons, order, self._explain_all)
        self.values = self.direction.values

    def of_whole(self, compared: KeyComparison) -> PossibleValue | None:
        """The first value that explains every entry that is not the key's."""
        different = [(i, j) for i, row in enumerate(compared.right) for j, r in enumerate(row) if r is None]
        for value in self._rests_on_answers(compared):
            if all(self._explains(value, compared, i, j) for i, j in different):
                return value
        return None

    def of_entry(
        self, compared: KeyComparison, i: int, j: int, whole: PossibleValue | None
    ) -> PossibleValue | None:
        """The value that explains one entry; `whole` explains all of them, where one does."""
        found = self._of_force(compared, i) if compared.target.node == "tau" else whole
        if found is not None:
            return found
        candidates = self._rests_on_answers(compared)
        return next((value for value in candidates if self._explains(value, compared, i, j)), None)

    def explains_entry(self, compared: KeyComparison, i: int, j: int) -> bool:
        """Whether any value explains one entry."""
        return any(self._explains(value, compared, i, j) for value in self._rests_on_answers(compared))

    def _rests_on_answers(self, compared: KeyComparison) -> Iterator[PossibleValue]:
        return self.direction.ways(compared.target.node)

    def _explain_all(self, node: str, values: Iterator[PossibleValue]) -> bool:
        """Whether values explain all entries of a node's answers that are not the key's."""
        left = [
            (compared, i, j)
            for compared in self.hand_in.comparisons.values()
            if compared.target.node == node
            for i, row in enumerate(compared.right)
            for j, right in enumerate(row)
            if right is None
        ]
        for value in values:
            left = [entry for entry in left if not self._explains(value, *entry)]
            if not left:
                return True
        return not left

    def _of_force(self, compared: KeyComparison, i: int) -> PossibleValue | None:
        """The force that an entry of τ is taken from."""
        written = compared.rows[i][0]
        forces = (v for v in self._forces(f"tau{i + 1}") if v.used and v.value is not None)
        return next((v for v in forces if self.hand_in.compare_entry(v.value, written) is not None), None)

    def _forces(self, node: str) -> Iterator[PossibleValue]:
        """A component of τ: the student's own, or what leads to it."""
        own = self.direction.students.get(node)
        if own is not None:
            yield PossibleValue(own.value, 0, frozenset(own.names))
        yield from self.direction.ways(node, judged="tau")

    def _explains(self, value: PossibleValue, compared: KeyComparison, i: int, j: int) -> bool:
        expected = entry_of(compared.target.of(value.value), i, j)
        return self.hand_in.compare_entry(expected, compared.rows[i][j]) is not None

    def expected(self, target: Target) -> Iterator[Any]:
        """The values that the student's own answers lead to, the nearest first; none where all are right."""
        if self.direction.touched(target.node):
            for value in islice(self.direction.ways(target.node), MOST_EXPECTED):
                yield target.of(value.value)

    def lead_elsewhere(self, compared: KeyComparison) -> bool:
        """Whether an answer is the key's although the student's own wrong answers lead to other values."""
        node, robot = compared.target.node, self.hand_in.answer_ring.robot
        if node in ("Cqd", "C", "christoffel") and not robot.bodies:
            return False
        key = self.hand_in.compare.key(compared.target)
        led = [compared.target.of(value.value) for value in self.direction.nearest_of_each_route(node)]
        return bool(led) and not any(value == key for value in led)


def entry_of(value: Any, i: int, j: int) -> Any:
    """One entry of a matrix; a scalar is its own."""
    return value[i, j] if isinstance(value, Matrix) else value
