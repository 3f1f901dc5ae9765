"""Which way a hand-in goes between τ and D, C, g, and that nothing explains itself on it.

Some students read D, C and g off from τ, others assemble τ from them.  What was written
first is taken as it stands: what was written after it explains it only where it is itself
explained without it, by K or ∂L/∂q, say.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from functools import cached_property

from dynsolve.answers.judging.follow_through import FollowThrough, PossibleValue, StudentValue
from dynsolve.answers.judging.graph import MODEL, AnswerGraph
from dynsolve.answers.judging.key_comparison import KeyComparison
from dynsolve.quantities import families

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
