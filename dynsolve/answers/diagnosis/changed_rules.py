"""Slips that run through the derivation: the graph with one rule replaced.

A wrong step is told by what it makes of everything after it.  Each variant of a
step (see `steps`) is put into the key's derivation, and the answer is compared with
what comes out at its own place.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from dynsolve.answers.diagnosis.slips import SLIPS
from dynsolve.answers.diagnosis.steps import variants
from dynsolve.answers.judging.graph import AnswerGraph
from dynsolve.answers.verdict import Diagnosis
from dynsolve.derivation.graph import Skipped
from dynsolve.errors import AlgebraError

MOST_TERMS = 1_500
"""Robots whose kinetic energy has more terms than this are diagnosed step by step only."""


OF_THE_MATRIX = ("transposed", "rows_swapped")
"""What is said of a matrix itself: of what comes after it, it would be false."""


_ACTING = ("Ps", "Km", "friction")
"""What acts beside gravity, where anything does."""


class ChangedDerivation:
    """The key's derivation with the value of one node, or of one kind of node, replaced."""

    def __init__(self, graph: AnswerGraph, values: dict[str, Any]) -> None:
        self.graph = graph
        self._values = values
        self._reached: dict[str, bool] = {}

    def reached(self, node: str) -> bool:
        """Whether the replacement changes a node."""
        if node not in self._reached:
            self._reached[node] = node in self._values or any(
                self.reached(name) for route in self.graph.routes(node)[:1] for name in route.inputs
            )
        return self._reached[node]

    def __call__(self, node: str) -> Any:
        """The node's value; AlgebraError where the replacement leads to none."""
        if node not in self._values:
            if not self.reached(node):
                return self.graph.key(node)
            route = self.graph.routes(node)[0]
            found = route.compute(*(self(name) for name in route.inputs))
            if isinstance(found, Skipped):
                raise AlgebraError(found.why)
            self._values[node] = found
        return self._values[node]


class DerivationSlips:
    """The derivations with a rule replaced, made when first asked for."""

    def __init__(self, graph: AnswerGraph) -> None:
        self.graph = graph
        self._made: list[tuple[str, ChangedDerivation, Diagnosis]] | None = None

    def values(self, node: str) -> Iterator[tuple[Any, Diagnosis, ChangedDerivation]]:
        """What a node becomes under every slip that reaches it, and what everything else becomes."""
        for source, replaced, told in self.made():
            if source != node and replaced.reached(node):
                try:
                    yield replaced(node), told, replaced
                except AlgebraError:  # a step that cannot be taken from there tells nothing
                    continue

    def made(self) -> list[tuple[str, ChangedDerivation, Diagnosis]]:
        """(the node that goes wrong first, the derivation, the slip), slips that omit something first."""
        if self._made is None:
            self._made = sorted(self._make(), key=lambda made: not SLIPS[made[2].code].omits)
        return self._made

    def _make(self) -> Iterator[tuple[str, ChangedDerivation, Diagnosis]]:
        graph, robot = self.graph, self.graph.robot
        if not robot.has_dynamics or len(graph.key("K")) > MOST_TERMS:
            return
        for node in self._sources():
            right = graph.key(node)
            for wrong, told in variants(robot, node, graph.key):
                if told.code not in OF_THE_MATRIX and wrong != right:
                    yield node, ChangedDerivation(graph, {node: wrong}), told
        yield from self._everywhere()

    def _sources(self) -> Iterator[str]:
        robot = self.graph.robot
        for joint in robot.joints:
            yield f"A{joint.index}"
        for body in robot.bodies:
            yield from (f"rc{body.name}", f"Jv{body.name}", f"Jw{body.name}")
            if not body.is_point:
                yield from (f"I_body{body.name}", f"I{body.name}", f"Kw{body.name}")
            yield from (f"P{body.name}", f"K{body.name}")
        yield from (name for name in _ACTING if name in self.graph.answer_ring.rules)
        yield from ("P", "K", "L")
        for q in robot.coordinates:
            yield from (f"ddt{q.index}", f"tau{q.index}")

    def _everywhere(self) -> Iterator[tuple[str, ChangedDerivation, Diagnosis]]:
        """The same slip for every body or coordinate at once."""
        robot, graph = self.graph.robot, self.graph
        kinds: list[tuple[str, list[str]]] = [
            (head, [f"{head}{b.name}" for b in robot.bodies]) for head in ("rc", "Jv", "Jw", "I", "Kw", "K")
        ]
        kinds += [(head, [f"{head}{q.index}" for q in robot.coordinates]) for head in ("ddt", "tau")]
        for head, nodes in kinds:
            by_code: dict[str, dict[str, Any]] = {}
            told_as: dict[str, Diagnosis] = {}
            for node in nodes:
                for wrong, told in variants(robot, node, graph.key):
                    changed = by_code.setdefault(told.code, {})
                    if node not in changed and wrong != graph.key(node):
                        changed[node] = wrong
                        told_as.setdefault(told.code, told)
            for code, changed in by_code.items():
                if len(changed) > 1:
                    yield head, ChangedDerivation(graph, dict(changed)), told_as[code]
