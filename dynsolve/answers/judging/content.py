"""What a wrong answer keeps of the key, and so whether others may follow from it.

A slip leaves most of an answer standing, and what is derived from it with care is worth its
marks.  A model of nobody's robot (τ = q̈, D = 1), or one of zeros, keeps next to nothing: what
follows from it and keeps nothing either shows no work on this robot, in whatever order the
two were written.

What counts are the kinds of terms: the masses and moments, the rates and the powers of all
others in a term, whether a sine or cosine stands in it, and how many lengths, but not which:
a term with the wrong angle, number, sign or point of a body is of its kind still.  A term with
one factor left out, too many or in the place of another keeps a part.

The student's own values of the graph's nodes: what follow-through starts from.

Which way a hand-in goes between τ and D, C, g, and that nothing explains itself on it.

Some students read D, C and g off from τ, others assemble τ from them.  What was written
first is taken as it stands: what was written after it explains it only where it is itself
explained without it, by K or ∂L/∂q, say.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from fractions import Fraction
from functools import cached_property

from dynsolve.algebra.expr import Expr
from dynsolve.algebra.fraction import as_expr
from dynsolve.algebra.matrix import Matrix
from dynsolve.answers.judging.answer_values import as_value
from dynsolve.answers.judging.entry_comparison import substituted
from dynsolve.answers.judging.follow_through import FollowThrough, PossibleValue, StudentValue
from dynsolve.answers.judging.graph import MODEL, AnswerGraph
from dynsolve.answers.judging.key_comparison import KeyComparison
from dynsolve.quantities import families
from dynsolve.robot.dimensions import Dimensions
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
        self._put = {ring.symbol_indices[n, 0]: v for n, v in numbers.items() if ring.has_symbol(n)}
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


# The student's own values of the graph's nodes: what follow-through starts from


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


# Which way a hand-in goes between τ and D, C, g, and that nothing explains itself on it

Explains = Callable[[str, Iterator[PossibleValue]], bool]
"""Whether values explain all that is not the key's in a node's answers."""

_NEVER = (-1, False)
"""Before everything that was written."""


class Direction:
    """The values that lead to each node of a hand-in, none of which rests on what the node leads to.

    `order` tells when an answer was first written, `explain` whether values explain a node's answers.
    Of one equation D q̈ + C q̇ + g = τ the matrices are written first, and τ is made of them.
    """

    def __init__(
        self,
        graph: AnswerGraph,
        students: Mapping[str, StudentValue],
        comparisons: Mapping[str, KeyComparison],
        order: Mapping[str, int],
        explain: Explains,
    ) -> None:
        self.graph = graph
        self.students = students
        self._explain = explain
        self._written: dict[str, tuple[int, bool]] = {}
        for name, compared in comparisons.items():
            node = graph.node("C") if compared.target.node == "C" else compared.target.node
            when = order[name], node in self.forces
            self._written[node] = min(when, self._written.get(node, when))
        self.values = FollowThrough(graph, students)
        self._without: dict[tuple[frozenset[str], bool], FollowThrough] = {}
        self._barred: dict[str, frozenset[str]] = {}

    @cached_property
    def forces(self) -> frozenset[str]:
        """The nodes of τ and its components."""
        forces = self.graph.quantities.of_family(families.FORCE)
        return frozenset({"tau", *(quantity.rule for quantity in forces)})

    @cached_property
    def _assembles(self) -> bool:
        """Whether τ may carry a slip in D, C or g."""
        return any(node in self.students and not self.students[node].correct for node in MODEL)

    def _other_side(self, node: str) -> tuple[str, ...]:
        """What may lead to a node as well as come from it, of what was handed in."""
        side = self.forces if node in MODEL else MODEL if node in self.forces else ()
        return tuple(other for other in side if other in self.students)

    def _later(self, node: str) -> frozenset[str]:
        """What was written after a node, of what may lead to it as well as come from it."""
        written = self._written.get(node, _NEVER)
        return frozenset(o for o in self._other_side(node) if self._written.get(o, _NEVER) > written)

    def is_assembled(self) -> bool:
        """Whether D, C or g was written before any torque."""
        torques = [self._written[node] for node in self.forces if node in self._written]
        model = [self._written[node] for node in MODEL if node in self._written]
        return bool(torques and model) and min(model) < min(torques)

    # -- what leads to a node ----------------------------------------------------------------------

    def ways(self, node: str, judged: str = "") -> Iterator[PossibleValue]:
        """The values that a node's inputs lead to and that rest on answers of the student's.

        `judged` is the node that they are to explain, where it is another: a component of τ
        leads to τ.
        """
        judged = judged or node
        doubtful = {name for other in self._later(judged) for name in self.students[other].names}
        for value in self._all(node, frozenset()):
            if value.used & doubtful and self._bars(judged):
                yield from self._all(node, self._bars(judged))
                return
            yield value

    def touched(self, node: str) -> bool:
        """Whether an answer that is not correct lies before a node."""
        assembled = node in self.forces and self._assembles and self._follow(frozenset(), True).touched(node)
        return assembled or self.values.touched(node)

    def nearest_of_each_route(self, node: str, judged: str = "") -> Iterator[PossibleValue]:
        """The nearest value of each route to a node, by what was written before it; `judged` as in `ways`."""
        later = self._later(judged or node)
        follow = self._follow(later, node in self.forces and self._assembles)
        return follow.nearest_of_each_route(node) if follow.touched(node) else iter(())

    def _all(self, node: str, barred: frozenset[str]) -> Iterator[PossibleValue]:
        streams = [False]
        if node in self.forces and self._assembles:
            first = set(MODEL) <= self.students.keys() and not self._later(node)
            streams = [True, False] if first else [False, True]
        for assembled in streams:
            yield from (v for v in self._follow(barred, assembled).derived(node) if v.used)

    def _follow(self, barred: frozenset[str], assembled: bool) -> FollowThrough:
        if not barred and not assembled:
            return self.values
        which = barred, assembled
        if which not in self._without:
            students = {node: value for node, value in self.students.items() if node not in barred}
            self._without[which] = FollowThrough(self.graph, students, assembled)
        return self._without[which]

    def _bars(self, node: str) -> frozenset[str]:
        """What was written after a node and is not explained without it: it does not explain the node.

        τ and its components are one here, since they lead to each other.
        """
        if node not in self._barred:
            itself = self.forces if node in self.forces else frozenset({node})
            self._barred[node] = frozenset(
                other
                for other in self._later(node)
                if not self.students[other].correct and not self._explain(other, self._all(other, itself))
            )
        return self._barred[node]
