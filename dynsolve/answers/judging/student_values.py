"""The student's own values of the graph's nodes: what follow-through starts from."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

from dynsolve.algebra.expr import Expr
from dynsolve.algebra.fraction import as_expr
from dynsolve.algebra.matrix import Matrix
from dynsolve.answers.judging.answer_values import as_value
from dynsolve.answers.judging.follow_through import StudentValue
from dynsolve.answers.judging.graph import AnswerGraph
from dynsolve.answers.judging.key_comparison import KeyComparison


def student_values(graph: AnswerGraph, held: Mapping[str, KeyComparison]) -> dict[str, StudentValue]:
    """The values of the nodes that a student handed in, a matrix also by its entries."""
    return dict(_Owner(graph, held).all())


@dataclass(frozen=True, slots=True)
class _Owner:
    graph: AnswerGraph
    held: Mapping[str, KeyComparison]

    def all(self) -> Iterator[tuple[str, StudentValue]]:
        for name, held in self.held.items():
            target = held.target
            second = name == "Cqd" and "C" in self.held
            known = held.given.rows is not None and target.node in self.graph.field.rules
            if not target.entry and known and not second:
                yield target.node, self._value(name, held)
        for whole in ("D", "g"):
            if whole not in self.held:
                yield from self._whole(whole)

    def _value(self, name: str, held: KeyComparison) -> StudentValue:
        key = self.graph.key(held.target.node)
        if held.correct:
            return StudentValue(key)
        rows = tuple(tuple(written.value for written in row) for row in held.rows)
        return StudentValue(as_value(rows, key) if rows else None, (name,))

    def _whole(self, whole: str) -> Iterator[tuple[str, StudentValue]]:
        """A matrix that was given entry by entry; of a symmetric one half is enough."""
        if not self.graph.robot.bodies:
            return
        key: Matrix = self.graph.key(whole)
        quantities = self.graph.quantities
        parts = {quantities[part].entry: part for part in quantities.parts(whole)}
        entries: list[list[Expr]] = []
        names: list[str] = []
        for i, row in enumerate(key.rows):
            entries.append([])
            for j in range(len(row)):
                part = parts.get((i, j), "")
                name = next((c for c in (part, quantities.mirrored(part)) if c in self.held), None)
                held = self.held[name] if name else None
                if name is None or held is None or held.given.rows is None or not held.rows:
                    return
                value = key[i, j] if held.correct else as_expr(held.rows[0][0].value)
                if value is None:
                    return
                entries[-1].append(value)
                names += [] if held.correct else [name]
        yield whole, StudentValue(Matrix.of(self.graph.field.ring, entries), tuple(dict.fromkeys(names)))
