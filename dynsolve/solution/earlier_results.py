"""What a step refers back to: of the steps that it is computed from, the equations that it uses.

A step may have several results, the axes and origins of all joints above all.  A later step cites those of
them whose left side stands in its own formulas, and all of them where none does.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from itertools import count

from dynsolve.explain.step import Step
from dynsolve.explain.writing import side_by_side
from dynsolve.notation.tree import Node, Relation, Row
from dynsolve.notation.walk import walk


def labelled_results(step: Step) -> Iterator[tuple[Node, str]]:
    """The results of a step that have a number, each with its label."""
    if step.together:
        yield side_by_side(step.result), step.id
    elif not step.listed:
        yield from zip(step.result, _labels(step), strict=False)


def _labels(step: Step) -> Iterator[str]:
    """The names of a step's results; those without one are numbered."""
    yield from (step.id, *step.also)
    yield from (f"{step.id}-{place}" for place in count(2))


class EarlierResults:
    """The numbered results of the steps so far."""

    def __init__(self) -> None:
        self._results: dict[str, list[tuple[Node, str]]] = {}

    def add(self, step: Step) -> None:
        """Remember a step."""
        for line in step.lines:
            if line.label:
                self._results[line.label] = [(formula, line.label) for formula in line.formulas]
        if not (step.listed or step.together):
            self._results[step.id] = list(labelled_results(step))
            return
        in_one_display = [(result, step.id) for result in step.result]
        for name in (step.id, *step.also):
            self._results[name] = in_one_display

    def used(self, step: Step, names: Iterable[str]) -> tuple[str, ...]:
        """The labels of the equations of the steps `names` that a step uses; `x#2` is the second of x."""
        lines = [node for line in step.lines for node in line.formulas]
        formulas = [node for node in (step.formula, *step.further, *step.working, *lines) if node is not None]
        parts = frozenset(walk(*formulas))
        labels: list[str] = []
        for whole in names:
            name, _, place = whole.partition("#")
            results = self._results.get(name)
            if results is None:  # a further result of an earlier step, by its own label
                labels.append(name)
                continue
            if place:  # a step that is shown in another form may not have it
                labels += [label for _, label in results[int(place) - 1 : int(place)]]
                continue
            cited = [label for node, label in results if not parts.isdisjoint(_left_sides(node))]
            labels += cited or [label for _, label in results]
        return tuple(dict.fromkeys(labels))


def _left_sides(node: Node) -> Iterator[Node]:
    """The left side of an equation, or of several on one line."""
    for part in node.parts if isinstance(node, Row) else (node,):
        if isinstance(part, Relation):
            yield part.parts[0]
