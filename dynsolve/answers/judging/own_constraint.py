"""Answers about constraints, judged on the constraint and with the student's own matrix.

A_c is right where its rows span those of the key's; its rate is that of the student's own A_c, and
the multipliers are right where A_cᵀ λ is.  What differs from that for every state, and not where
h = 0 and A_c q̇ = 0, is right too: that is held in numbers, at states of a fixed seed.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from functools import cached_property
from itertools import islice
from typing import TYPE_CHECKING

from msgspec.structs import replace

from dynsolve.algebra.fraction import RationalExpr, add, equal, multiply
from dynsolve.algebra.linear_systems import FractionMatrix, fraction_of
from dynsolve.algebra.matrix import Matrix
from dynsolve.algebra.ring_values import evaluate
from dynsolve.algebra.sampling import samples
from dynsolve.answers.judging.graph import AnswerGraph
from dynsolve.answers.judging.key_comparison import KeyComparison
from dynsolve.answers.judging.other_solutions import Other
from dynsolve.derivation.elimination import solved
from dynsolve.questions.rates.check import orthonormal

if TYPE_CHECKING:
    from dynsolve.answers.judging.answer_values import AnswerValue

Rows = tuple[tuple[RationalExpr, ...], ...]

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
        return not self._same(self.rows, self._key("Ac"))

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
        return tuple(self._sum(map(multiply, column, multipliers)) for column in zip(*A, strict=True))

    def _sum(self, terms: Iterator[RationalExpr]) -> RationalExpr:
        total = RationalExpr(self.ring.zero)
        for term in terms:
            total = add(total, term)
        return total

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
        if self._same(mine, theirs):
            return Other.SAME_CONSTRAINT
        gaps = (self._gap(mine, theirs, at) for at in self.states)
        return Other.ON_CONSTRAINT if self.states and all(gap < _CLOSE for gap in gaps) else None

    def _same(self, mine: Rows, theirs: Rows) -> bool:
        return len(mine) == len(theirs) and all(
            equal(a, b)
            for row, other in zip(mine, theirs, strict=True)
            for a, b in zip(row, other, strict=True)
        )

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
