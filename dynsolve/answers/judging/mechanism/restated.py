"""Formulas of an exercise in a student's coordinates: q = ±(q' - c) where the student counts q' = ±q + c.

A state is the other way round: where q has a value, q' has ± that value plus c.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from dynsolve.notation.build import negated, total
from dynsolve.notation.tree import ZERO, Node, Symbol
from dynsolve.notation.walk import mapped, names_in
from dynsolve.robot.questions import Questions, State


@dataclass(frozen=True, slots=True)
class Count:
    """How a student counts a coordinate: q' = sense·q + shift."""

    sense: int
    shift: Node

    def of(self, value: Node) -> Node:
        """The student's coordinate where the key's has a value."""
        kept = value if self.sense > 0 else negated(value)
        return kept if self.shift == ZERO else total([kept, self.shift])

    def keys(self, own: Node) -> Node:
        """The key's coordinate in the student's."""
        moved = own if self.shift == ZERO else total([own, negated(self.shift)])
        return moved if self.sense > 0 else negated(moved)


Counts = Mapping[str, Count]
"""By the names of the coordinates, which both have; none of a coordinate that is the key's own."""


def restated(tree: Node, counts: Counts) -> Node:
    """A formula in the key's coordinates and rates, in the student's."""

    def change(node: Node) -> Node:
        if not isinstance(node, Symbol) or node.name not in counts:
            return node
        count = counts[node.name]
        if node.dots:
            return node if count.sense > 0 else negated(node)
        return count.keys(node)

    return mapped(tree, change) if counts else tree


def restated_state(state: State, counts: Counts) -> State:
    """The same state in the student's coordinates."""
    return State(tuple((name, dots, _value(counts, name, dots, v)) for name, dots, v in state.values))


def _value(counts: Counts, name: str, dots: int, value: Node) -> Node:
    count = counts.get(name)
    if count is None:
        return value
    return count.of(value) if not dots else Count(count.sense, ZERO).of(value)


def speaks_of_coordinates(questions: Questions, counts: Counts) -> bool:
    """Whether what is asked names coordinates that the student counts otherwise."""
    task = questions.task.entries if questions.task else ()
    return bool(names_in(*task) & counts.keys()) or bool(
        {name for name, _, _ in questions.state.values} & counts.keys()
    )
