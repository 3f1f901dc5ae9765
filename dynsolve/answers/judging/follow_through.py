"""Follow-through: the values that a student's own answers lead to.

Every input of a quantity is the student's own answer, or is derived in the same
way from still earlier ones, down to the key.  Of all combinations those with the
fewest derived inputs come first; at most 64 distinct values are kept.

The graph is walked once, and only where an answer that is not correct lies before:
everywhere else there is one value, the key's.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from functools import cached_property
from heapq import heappop, heappush
from itertools import islice
from typing import Any

from msgspec import Struct, field

from dynsolve.algebra.expr import Expr
from dynsolve.algebra.matrix import Matrix
from dynsolve.answers.judging.graph import AnswerGraph, Route
from dynsolve.derivation.graph import Skipped
from dynsolve.errors import AlgebraError

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
        """The nodes of the answers that are not correct."""
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
