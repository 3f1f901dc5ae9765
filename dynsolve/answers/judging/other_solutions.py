"""Joint rates and accelerations that are right without being the key's: there may be many.

Every x with Jᵀ (J x - b) = 0 solves J x = b, or comes as near to it as can be where nothing does;
the key is the one of least norm.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction

from dynsolve.algebra.at_state import AtState
from dynsolve.algebra.expr import Expr
from dynsolve.algebra.fraction import RationalExpr, add, multiply
from dynsolve.algebra.matrix import Matrix
from dynsolve.answers.judging.entry_comparison import WrittenEntry, put_numbers
from dynsolve.answers.judging.graph import AnswerGraph
from dynsolve.derivation.rates import wanted_by_accelerations

LONGEST = 400
"""Values with more terms are not put into the equations."""


def is_other_solution(
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
