"""Which value that a student's own answers lead to explains an answer that differs from the key.

An answer *follows* where it is not the key's and equals what the student's own earlier
answers lead to, in one direction between τ and D, C, g (both in `follow_through`).
One such value should explain the whole of a matrix; where none does, each entry is compared by
itself.  Between two answers that keep nothing of the key nothing follows: agreement
is no work where neither holds any of this robot.

A slip leaves most of an answer standing, and what is derived from it with care is worth its
marks.  A model of nobody's robot (τ = q̈, D = 1), or one of zeros, keeps next to nothing: what
follows from it and keeps nothing either shows no work on this robot, in whatever order the
two were written.  What counts are the kinds of terms: the masses and moments, the rates and the powers
of all others in a term, whether a sine or cosine stands in it, and how many lengths, but not which:
a term with the wrong angle, number, sign or point of a body is of its kind still.  A term with
one factor left out, too many or in the place of another keeps a part.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from fractions import Fraction
from functools import cached_property
from itertools import islice, product
from typing import Any

from dynsolve.algebra.fraction import RationalExpr
from dynsolve.algebra.linear_systems import FractionMatrix
from dynsolve.algebra.matrix import Matrix
from dynsolve.algebra.ring import Expr
from dynsolve.answers.judging.entry_comparison import placed, spans, substituted
from dynsolve.answers.judging.follow_through import (
    Direction,
    FollowThrough,
    PossibleValue,
    StudentValue,
    student_values,
)
from dynsolve.answers.judging.hand_in import ComparedHandIn
from dynsolve.answers.judging.key_comparison import KeyComparison, Target
from dynsolve.questions.parameters import REGRESSORS
from dynsolve.questions.parameters.judge import covers
from dynsolve.robot.dimensions import Dimensions
from dynsolve.robot.model import Coordinate
from dynsolve.robot.units import LENGTH

# What a wrong answer keeps of the key, and so whether others may follow from it

LEAST = Fraction(1, 4)
"""An answer that keeps no more than this share of the key's kinds of terms keeps nothing."""

NEARLY = Fraction(1, 3)
"""What a term counts that has one factor more or less than one of the key's, or another in its place."""

Kind = tuple[tuple[tuple[int, int], ...], int, bool]
"""(symbol, power) of all but the lengths; the power of the lengths; whether a sine or cosine is in it."""

_CONSTANT: Kind = ((), 0, False)

_LENGTH = -1
"""The place of the lengths among the symbols."""


class Content:
    """What the terms of values are; `numbers` are those that the problem gives for symbols."""

    def __init__(self, dimensions: Dimensions, numbers: Mapping[str, Fraction]) -> None:
        ring = dimensions.ring
        self._put = placed(numbers, ring)
        self._places: dict[int, str] = {}
        for g in ring.generators:
            role = dimensions.of_generator(g)
            if g.kind in ("sin", "cos", "function"):
                self._places[g.index] = "angle"
            elif g.kind == "symbol" and (g.dots or role not in (None, LENGTH)):
                self._places[g.index] = "symbol"
            elif g.kind == "symbol" and g.name != "pi":
                self._places[g.index] = "length"

    def is_kept(self, value: Iterable[Expr], key: Iterable[Expr]) -> bool:
        """Whether the entries of an answer keep more than next to nothing of the key's; of 0 none can."""
        wanted, mine = self._kinds(key), self._kinds(value)
        kept = Fraction(len(wanted & mine))
        left = wanted - mine
        for kind in mine - wanted:
            near = next((other for other in left if _is_near(kind, other)), None)
            if near is not None:
                left.discard(near)
                kept += NEARLY
        return kept > LEAST * len(wanted)

    def _kinds(self, entries: Iterable[Expr]) -> set[Kind]:
        """The kinds of terms of all entries; constants are one only where there is nothing else."""
        kinds = {kind for entry in entries for kind in self._of(substituted(entry, self._put))}
        return kinds - {_CONSTANT} or kinds

    def _of(self, entry: Expr) -> Iterator[Kind]:
        for exponents in entry.poly.monoms() if entry.poly else ():
            symbols, lengths, turning = [], 0, False
            for index, place in self._places.items():
                power = int(exponents[index])
                if not power:
                    continue
                if place == "symbol":
                    symbols.append((index, power))
                elif place == "length":
                    lengths += power
                else:
                    turning = True
            yield tuple(symbols), lengths, turning


def _is_near(mine: Kind, other: Kind) -> bool:
    """Whether one symbol, or one kind of factor, is left out, too many or in the place of another."""
    powers = {**dict(other[0]), _LENGTH: other[1]}
    for index, power in (*mine[0], (_LENGTH, mine[1])):
        powers[index] = powers.get(index, 0) - power
    missing = [power for power in powers.values() if power > 0]
    needless = [-power for power in powers.values() if power < 0]
    if mine[2] != other[2]:
        return not missing and not needless
    return max(len(missing), len(needless)) <= 1 and (not missing or not needless or missing == needless)


# Which value explains an answer

MOST_EXPECTED = 4
"""So many of the values that a student's own answers lead to are looked at for a slip."""


class Explanations:
    """Explains the answers of one hand-in by its own earlier answers."""

    def __init__(self, hand_in: ComparedHandIn) -> None:
        self.hand_in = hand_in
        self._students = student_values(hand_in.graph, hand_in.comparisons)
        self.direction = self._direction(self._students)

    @cached_property
    def _content(self) -> Content:
        return Content(self.hand_in.answer_ring.dimensions, self.hand_in.compare_entry.values)

    def _keeps(self, compared: KeyComparison) -> bool:
        """Whether an answer is right, or keeps some of what is."""
        written = [entry.value.numerator for row in compared.rows for entry in row]
        return compared.correct or self._content.is_kept(
            written, _entries(self.hand_in.compare.key(compared.target))
        )

    @cached_property
    def _empty(self) -> frozenset[str]:
        graph = self.hand_in.graph
        return frozenset(
            node
            for node, own in self._students.items()
            if not own.correct
            and own.value is not None
            and not self._content.is_kept(_entries(own.value), _entries(graph.key(node)))
        )

    def _direction(self, values: Mapping[str, StudentValue]) -> Direction:
        hand_in = self.hand_in
        order = {name: chains[0][0].answer.occurrence[0] for name, chains in hand_in.chains.items()}
        return Direction(hand_in.graph, values, hand_in.comparisons, order, self._explain_all)

    @cached_property
    def _from_substance(self) -> Direction:
        """What the answers lead to that keep some of the key."""
        kept = {node: own for node, own in self._students.items() if node not in self._empty}
        return self._direction(kept) if self._empty else self.direction

    @property
    def values(self) -> FollowThrough:
        """The values of the nodes, for a student who goes from τ to D, C and g."""
        return self._from_substance.values

    def _direction_to(self, compared: KeyComparison) -> Direction:
        """What may lead to an answer: to one that keeps nothing only those that do."""
        return self.direction if not self._empty or self._keeps(compared) else self._from_substance

    def of_whole(self, compared: KeyComparison) -> PossibleValue | None:
        """The first value that explains every entry that is not the key's."""
        different = [(i, j) for i, row in enumerate(compared.right) for j, r in enumerate(row) if r is None]
        for value in self._rests_on_answers(compared):
            if all(self._explains(value, compared, i, j) for i, j in different):
                return value
        return self._of_own_equation(compared) if compared.holds_with is not None else None

    def _of_own_equation(self, compared: KeyComparison) -> PossibleValue | None:
        """What an answer rests on that solves the equation which the student's own answers make."""
        assert compared.holds_with is not None
        for route in self.values.routes(compared.target.node):
            ways = product(*map(self.values.choices, route.inputs))
            for chosen in islice(ways, MOST_EXPECTED):
                used = frozenset().union(*(one.used for one in chosen))
                own = {name: one.value for name, one in zip(route.inputs, chosen, strict=True)}
                if used and compared.holds_with(own):
                    return PossibleValue(None, 0, used)
        return None

    def of_span(self, compared: KeyComparison) -> PossibleValue | None:
        """The first space that the student's own answers lead to and that the written vectors span.

        Of parameters a the first that are combinations of those that were written.
        """
        numbers = self.hand_in.compare_entry.values
        candidates = self._rests_on_answers(compared)
        if compared.target.node in REGRESSORS:
            robot, (written,) = self.hand_in.graph.robot, compared.written
            return next((v for v in candidates if covers(robot, written, v.value)), None)
        return next((v for v in candidates if spans(v.value, compared.written, numbers)), None)

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
        return self._direction_to(compared).ways(compared.target.node)

    def _explain_all(self, node: str, values: Iterator[PossibleValue]) -> bool:
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
        forces = (v for v in self._forces(f"tau{i + 1}", compared) if v.used and v.value is not None)
        return next((v for v in forces if self.hand_in.compare_entry(v.value, written) is not None), None)

    def _forces(self, node: str, compared: KeyComparison) -> Iterator[PossibleValue]:
        """A component of τ that may lead to an answer: the student's own, or what leads to it."""
        direction = self._direction_to(compared)
        own = direction.students.get(node)
        if own is not None:
            yield PossibleValue(own.value, 0, frozenset(own.names))
        yield from direction.ways(node, judged="tau")

    def _explains(self, value: PossibleValue, compared: KeyComparison, i: int, j: int) -> bool:
        expected = entry_of(compared.target.of(value.value), i, j)
        return self.hand_in.compare_entry(expected, compared.rows[i][j]) is not None

    def expected(self, target: Target) -> Iterator[Any]:
        """The values that the student's own answers lead to, the nearest first; none where all are right."""
        if self._from_substance.touched(target.node):
            for value in islice(self._from_substance.ways(target.node), MOST_EXPECTED):
                yield target.of(value.value)

    def of_nothing(self, compared: KeyComparison) -> frozenset[str]:
        """The answers that keep nothing of the key and lead to one that is wrong; none where others do."""
        if self._direction_to(compared) is self.direction:
            return frozenset()
        empty = {name for node in self._empty for name in self._students[node].names}
        for value in self.direction.ways(compared.target.node):
            if all(
                right is not None or self._explains(value, compared, i, j)
                for i, row in enumerate(compared.right)
                for j, right in enumerate(row)
            ):
                return value.used & empty
        return frozenset()

    def hanging_on(self, compared: KeyComparison, unread: Mapping[str, str]) -> frozenset[str]:
        """The answers on which one that is not the key's hangs, of those that could not be read.

        These are the values of `unread`, its keys their nodes: if one of them has twice the key's value, the
        nearest values lead to another.
        """
        graph, node = self.hand_in.graph, compared.target.node
        doubled = {
            name: StudentValue(twice, (unread[name],))
            for name in unread.keys() - self._students.keys() - {node}
            if (twice := _twice(graph.key(name))) is not None
        }
        if not doubled or not self._keeps(compared):
            return frozenset()
        different = [(i, j) for i, row in enumerate(compared.right) for j, r in enumerate(row) if r is None]

        def shown(value: Any) -> list[Any]:
            return [entry_of(compared.target.of(value), i, j) for i, j in different]

        known = [graph.key(node), *(v.value for v in self.direction.nearest_of_each_route(node))]
        unchanged = [shown(value) for value in known]
        led = self._direction({**self._students, **doubled}).nearest_of_each_route(node)
        changed = (one.used for one in led if shown(one.value) not in unchanged)
        return frozenset().union(*changed) & frozenset(unread.values())

    def own_values(self, node: str) -> Iterator[PossibleValue]:
        """The values that a student's own answers give a node, or lead to, the nearest first."""
        return (value for value in islice(self.values.choices(node), MOST_EXPECTED) if value.used)

    def before(self, node: str, unread: Mapping[str, str]) -> frozenset[str]:
        """The answers that could not be read, of `unread`, of which a node is one, or on which it hangs."""
        if node in unread:
            return frozenset({unread[node]})
        if node in self._students:
            return frozenset()
        inputs = {name for route in self.values.routes(node) for name in route.inputs}
        return frozenset().union(*(self.before(name, unread) for name in inputs))

    def lead_elsewhere(self, compared: KeyComparison) -> bool:
        """Whether an answer is the key's although the student's own wrong answers lead to other values."""
        node, robot = compared.target.node, self.hand_in.answer_ring.robot
        if node in ("Cqd", "C", "christoffel") and not robot.has_dynamics:
            return False
        if node == "tau" and any(map(self._force_leads_elsewhere, robot.coordinates)):
            return True
        led = self.direction.nearest_of_each_route(node)
        return self._differ(
            (compared.target.of(v.value) for v in led), self.hand_in.compare.key(compared.target)
        )

    def _force_leads_elsewhere(self, coordinate: Coordinate) -> bool:
        """Whether what leads to a component of τ, which is not given by itself, leads elsewhere."""
        node = f"tau{coordinate.index}"
        led = () if node in self._students else self.direction.nearest_of_each_route(node, judged="tau")
        return self._differ((value.value for value in led), self.hand_in.graph.key(node))

    def _differ(self, led: Iterable[Any], key: Any) -> bool:
        any_led = False
        for value in led:
            if value == key:  # what else there is need not be worked out
                return False
            any_led = True
        return any_led


def entry_of(value: Any, i: int, j: int) -> Any:
    """One entry of a matrix; a scalar is its own."""
    return value[i, j] if isinstance(value, Matrix | FractionMatrix) else value


def _twice(value: Any) -> Expr | Matrix | None:
    """A value that is not the key's; None of what cannot be added."""
    if isinstance(value, Matrix):
        return value.scale(value.ring.constant(2))
    return value + value if isinstance(value, Expr) else None


def _entries(value: Any) -> tuple[Expr, ...]:
    if isinstance(value, FractionMatrix):
        return tuple(entry.numerator for entry in value.entries)
    if isinstance(value, RationalExpr):
        return (value.numerator,)
    return value.entries if isinstance(value, Matrix) else (value,)
