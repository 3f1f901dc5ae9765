"""What the steps of a derivation give from the student's own answers: done right, and done otherwise."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from dynsolve.algebra.matrix import Matrix
from dynsolve.answers.diagnosis.changed_rules import ChangedDerivation, DerivationSlips
from dynsolve.answers.diagnosis.steps import variants
from dynsolve.answers.judging.follow_through import FollowThrough
from dynsolve.answers.judging.graph import AnswerGraph
from dynsolve.answers.verdict import Diagnosis
from dynsolve.errors import AlgebraError


class OwnSteps:
    """What steps give from the student's own answers; `earlier` are the slips of the steps before them."""

    def __init__(self, graph: AnswerGraph, follow_through: FollowThrough, earlier: DerivationSlips) -> None:
        self.graph = graph
        self.follow_through = follow_through
        self.earlier = earlier
        self._leading: dict[str, frozenset[str]] = {}

    def done_right(self, node: str) -> Any:
        """The value that the student's own inputs of a step lead to."""
        derived = self.follow_through.derived(node) if self.follow_through.touched(node) else ()
        return derived[0].value if derived else self.graph.key(node)

    def done_otherwise(self, node: str) -> Iterator[tuple[Any, Diagnosis]]:
        """The values that a step gives when it is done wrongly, from the student's own inputs."""
        if node in ("C", "christoffel"):
            return
        try:
            yield from variants(
                self.graph.robot,
                node,
                lambda name: self.done_right(name) if name == node else self._nearest(name),
            )
        except AlgebraError:  # inputs of the student's from which the step cannot be taken
            return

    def _nearest(self, node: str) -> Any:
        """The student's own value of a node, or the value that their nearest answers lead to."""
        choices = self.follow_through.choices(node)
        value = choices[0].value if choices else None
        return self.graph.key(node) if value is None else value

    def fits_the_rest(self, node: str, changed: ChangedDerivation) -> bool:
        """Whether a slip of an earlier step agrees with all that the student wrote on the way.

        What the student's own answer holds was not left out.
        """
        for name, own in self.follow_through.students.items():
            if own.value is None or not changed.reached(name):
                continue
            if name == node:
                if not self.fits_what_is_written(node, changed(node), self.graph.key(node)):
                    return False
            elif name in self._before(node) and changed(name) != own.value:
                return False
        return True

    def fits_what_is_written(self, node: str, changed: Any, right: Any) -> bool:
        """Whether a slip changes no entry of a matrix that is right: what it changes is as it was written."""
        own = self.follow_through.students.get(node)
        written = own.value if own is not None else None
        if not isinstance(changed, Matrix) or not isinstance(written, Matrix):
            return True
        if changed.shape != written.shape:
            return True  # parameters may be as many as the student chose
        entries = zip(changed.entries, written.entries, right.entries, strict=True)
        return all(new in (wanted, mine) for new, mine, wanted in entries)

    def _before(self, node: str) -> frozenset[str]:
        """The nodes that lead to a node."""
        if node not in self._leading:
            self._leading[node] = frozenset()
            inputs = {name for route in self.graph.routes(node) for name in route.inputs}
            self._leading[node] = frozenset(inputs).union(*map(self._before, inputs))
        return self._leading[node]
