"""The student's own values of the graph's nodes: what follow-through starts from."""

from __future__ import annotations

from collections.abc import Mapping

from dynsolve.algebra.expr import Expr
from dynsolve.algebra.fraction import as_expr
from dynsolve.algebra.matrix import Matrix
from dynsolve.answers.judging.answer_values import as_value
from dynsolve.answers.judging.follow_through import StudentValue
from dynsolve.answers.judging.graph import AnswerGraph
from dynsolve.answers.judging.key_comparison import KeyComparison


def student_values(graph: AnswerGraph, compared: Mapping[str, KeyComparison]) -> dict[str, StudentValue]:
    """The values of the nodes that a student handed in; D and g also where they were given by entries."""
    found = {}
    for name, one in compared.items():
        is_known = one.answer_value.rows is not None and one.target.node in graph.answer_ring.rules
        is_second = name == "Cqd" and "C" in compared
        if not one.target.entry and is_known and not is_second:
            found[one.target.node] = _value(graph, name, one)
    for whole in ("D", "g") if graph.robot.has_dynamics else ():
        assembled = None if whole in compared else _assembled(graph, compared, whole)
        if assembled is not None:
            found[whole] = assembled
    return found


def _value(graph: AnswerGraph, name: str, compared: KeyComparison) -> StudentValue:
    key = graph.key(compared.target.node)
    if compared.correct:
        return StudentValue(key)
    rows = tuple(tuple(written.value for written in row) for row in compared.rows)
    return StudentValue(as_value(rows, key) if rows else None, (name,))


def _assembled(graph: AnswerGraph, compared: Mapping[str, KeyComparison], whole: str) -> StudentValue | None:
    """A matrix that was given entry by entry; of a symmetric one half is enough."""
    key: Matrix = graph.key(whole)
    parts = {graph.quantities[part].entry: part for part in graph.quantities.parts(whole)}
    entries: list[list[Expr]] = []
    wrong: dict[str, None] = {}
    for i, row in enumerate(key.rows):
        entries.append([])
        for j, right in enumerate(row):
            part = parts.get((i, j), "")
            name = next((c for c in (part, graph.quantities.mirrored(part)) if c in compared), None)
            one = compared[name] if name else None
            if name is None or one is None or one.answer_value.rows is None or not one.rows:
                return None
            value = right if one.correct else as_expr(one.rows[0][0].value)
            if value is None:
                return None
            entries[-1].append(value)
            if not one.correct:
                wrong[name] = None
    return StudentValue(Matrix.of(graph.answer_ring.ring, entries), tuple(wrong))
