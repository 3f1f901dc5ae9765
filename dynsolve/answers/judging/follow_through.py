"""Follow-through: the values that a student's own answers lead to.

Every input of a quantity is the student's own answer, or is derived in the same
way from still earlier ones, down to the key.  Of all combinations those with the
fewest derived inputs come first; at most 64 distinct values are kept.

The graph is walked once, and only where an answer that is not correct lies before:
everywhere else there is one value, the key's.

Some students read D, C and g off from τ, others assemble τ from them.  What was written
first is taken as it stands: what was written after it explains it only where it is itself
explained without it, by K or ∂L/∂q, say.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import cached_property
from heapq import heappop, heappush
from itertools import islice
from typing import Any

from msgspec import Struct, field

from dynsolve.algebra.fraction import as_expr
from dynsolve.algebra.matrix import Matrix
from dynsolve.algebra.ring import Expr
from dynsolve.answers.judging.answer_values import as_value
from dynsolve.answers.judging.graph import MODEL, AnswerGraph, Route
from dynsolve.answers.judging.key_comparison import KeyComparison
from dynsolve.derivation.graph import Skipped
from dynsolve.errors import AlgebraError
from dynsolve.quantities import families

MOST_CANDIDATES = 64

MOST_WORK = 4_000_000
"""The products of terms that the candidates of one hand-in may cost, estimated before they are formed."""


class StudentValue(Struct, frozen=True):
    """A student's own value of a node, None where it cannot be worked with.

    `names` are the answers it stands in that are not correct; none where it is the key's.
    """

    value: Any
    names: tuple[str, ...] = ()

    @property
    def correct(self) -> bool:
        """Whether it is the key's."""
        return not self.names


class PossibleValue(Struct, frozen=True):
    """A value that a node may have; `derived` counts derived inputs, `used` are the answers it rests on."""

    value: Any
    derived: int = 0
    used: frozenset[str] = frozenset()


class FollowThrough(Struct, dict=True):
    """The candidates of every node, given what a student handed in.

    `assembled` says which way the routes between τ and D, C, g are taken, see `graph`.
    """

    graph: AnswerGraph
    students: Mapping[str, StudentValue]
    assembled: bool = False
    work: int = 0
    _touched: dict[str, bool] = field(default_factory=dict)
    _choices: dict[str, tuple[PossibleValue, ...]] = field(default_factory=dict)
    _derived: dict[str, tuple[PossibleValue, ...]] = field(default_factory=dict)

    def routes(self, node: str) -> Sequence[Route]:
        """The routes to a node."""
        return self.graph.routes(node, self.assembled)

    def touched(self, node: str) -> bool:
        """Whether an answer that is not correct lies before a node."""
        if not self._wrong:
            return False
        if node not in self._touched:
            self._touched[node] = any(
                name in self._wrong or self.touched(name)
                for route in self.routes(node)
                for name in route.inputs
            )
        return self._touched[node]

    @cached_property
    def _wrong(self) -> frozenset[str]:
        return frozenset(node for node, value in self.students.items() if not value.correct)

    def choices(self, node: str) -> tuple[PossibleValue, ...]:
        """What may stand for a node where it is an input: the student's own answer first."""
        if node not in self._choices:
            found: list[PossibleValue] = []
            value = self.students.get(node)
            if value is not None:
                found.append(PossibleValue(value.value, 0, frozenset(value.names)))
            if self.touched(node):
                for one in self.derived(node):
                    _keep(found, PossibleValue(one.value, one.derived + 1, one.used))
            elif value is None or not value.correct:
                untouched = 1 if value is not None else 0
                _keep(found, PossibleValue(self.graph.key(node), untouched))
            found.sort(key=lambda c: c.derived)
            self._choices[node] = tuple(found[:MOST_CANDIDATES])
        return self._choices[node]

    def derived(self, node: str) -> tuple[PossibleValue, ...]:
        """The values that a node's inputs lead to, fewest derived inputs first."""
        if node not in self._derived:
            found: list[PossibleValue] = []
            streams = [self._combinations(route) for route in self.routes(node)]
            for one in _merged(streams):
                _keep(found, one)
                if len(found) >= MOST_CANDIDATES:
                    break
            self._derived[node] = tuple(found)
        return self._derived[node]

    def nearest_of_each_route(self, node: str) -> Iterator[PossibleValue]:
        """The nearest value of each route to a node on which an answer of the student's lies."""
        for route in self.routes(node):
            if any(name in self.students or self.touched(name) for name in route.inputs):
                yield from islice(self._combinations(route), 1)

    def _combinations(self, route: Route) -> Iterator[PossibleValue]:
        """The values of one route, over all choices of its inputs, cheapest first."""
        lists = [self.choices(name) for name in route.inputs]
        if not all(lists):  # what leads to an input goes over the bound of work
            return
        start = (0,) * len(lists)
        waiting = [(self._derivations(lists, start), start)]
        seen = {start}
        tried = 0
        while waiting and tried < 4 * MOST_CANDIDATES:
            derived, places = heappop(waiting)
            tried += 1
            chosen = [choices[i] for choices, i in zip(lists, places, strict=True)]
            value = self._value(route, chosen)
            if value is not None:
                yield PossibleValue(value, derived, frozenset().union(*(c.used for c in chosen)))
            for k, choices in enumerate(lists):
                if places[k] + 1 < len(choices):
                    following = (*places[:k], places[k] + 1, *places[k + 1 :])
                    if following not in seen:
                        seen.add(following)
                        heappush(waiting, (self._derivations(lists, following), following))

    def _derivations(self, lists: Sequence[Sequence[PossibleValue]], places: tuple[int, ...]) -> int:
        return sum(choices[i].derived for choices, i in zip(lists, places, strict=True))

    def _value(self, route: Route, chosen: Sequence[PossibleValue]) -> Any:
        if any(c.value is None for c in chosen):
            return None
        cost = _estimate([c.value for c in chosen], route.linear)
        if self.work + cost > MOST_WORK:
            return None
        self.work += cost
        try:
            found = route.compute(*(c.value for c in chosen))
        except (AlgebraError, ValueError, ZeroDivisionError):
            return None
        return None if isinstance(found, Skipped) else found


def _merged(streams: list[Iterator[PossibleValue]]) -> Iterator[PossibleValue]:
    """The candidates of several routes, fewest derived inputs first; of equal ones the first route's."""
    heads: list[tuple[int, int, PossibleValue]] = []
    for place, stream in enumerate(streams):
        first = next(stream, None)
        if first is not None:
            heads.append((first.derived, place, first))
    while heads:
        heads.sort(key=lambda head: head[:2])
        _, place, one = heads.pop(0)
        yield one
        following = next(streams[place], None)
        if following is not None:
            heads.append((following.derived, place, following))


def _keep(found: list[PossibleValue], one: PossibleValue) -> None:
    if not any(one.value == other.value for other in found):
        found.append(one)


def _estimate(values: Sequence[Any], linear: bool) -> int:
    """The products of terms that a route forms, at most about so many."""
    sizes = [
        sum(map(len, value.entries)) if isinstance(value, Matrix) else len(value)
        for value in values
        if isinstance(value, (Matrix, Expr))
    ]
    return 16 * sum(sizes) if linear else sum(sizes) * (max(sizes, default=1) + 8)


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
        self._leans: dict[str, frozenset[str]] = {}

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

    def _wrong_later(self, node: str) -> frozenset[str]:
        return frozenset(other for other in self._later(node) if not self.students[other].correct)

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
        leaning, later = self._leaning(judged), self._wrong_later(judged)
        yield from self._all(node, leaning | later)
        doubtful = {name for other in later for name in self.students[other].names}
        if later - self._bars(judged):
            yield from (v for v in self._all(node, leaning | self._bars(judged)) if v.used & doubtful)

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
            itself = self._with_components(node)
            self._barred[node] = frozenset(
                other
                for other in self._wrong_later(node)
                if not self._explain(other, self._all(other, itself))
            )
        return self._barred[node]

    def _with_components(self, node: str) -> frozenset[str]:
        return self.forces if node in self.forces else frozenset({node})

    def _leaning(self, node: str) -> frozenset[str]:
        """What was written before a node and is explained by the node alone: it does not explain the node."""
        if node not in self._leans:
            itself = self._with_components(node)
            self._leans[node] = frozenset(
                other
                for other in self._other_side(node)
                if not self.students[other].correct
                and itself & (self._wrong_later(other) - self._bars(other))
                and not self._explain(other, self._all(other, self._wrong_later(other)))
                and self._explain(other, self._all(other, self._bars(other)))
            )
        return self._leans[node]
