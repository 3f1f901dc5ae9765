"""The remarks of a problem's author, as notes of the steps that they speak of."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Iterator
from dataclasses import replace

from dynsolve.document import Prose
from dynsolve.errors import ProblemError
from dynsolve.explain.step import Step
from dynsolve.problem.model import Problem
from dynsolve.quantities.index import Quantities, quantities
from dynsolve.quantities.robot_stages import stages_of


def with_remarks(steps: Iterable[Step], problem: Problem, *, whole: bool) -> Iterator[Step]:
    """The steps, those of results with a remark with a note more.

    A remark on an entry (d12, c121) stands at the step of the whole, one on what has no step of
    its own (tau) at the last of its parts.  Raises ProblemError where the steps are the `whole`
    derivation, and none of them is what a remark speaks of, though its stage is there: the way from
    link to link has none of the energies.
    """
    steps, known = tuple(steps), quantities(problem.robot)
    owner = {name: step.id for step in steps for name in (step.id, *step.also)}
    stages = stages_of(problem.robot)
    notes: dict[str, list[Prose]] = defaultdict(list)
    lost = []
    for remark in problem.remarks:
        places = [owner[name] for name in _looked_up(known, remark.name) if name in owner]
        if places:
            notes[places[0]] += [(text,) for text in remark.texts]
        elif whole and known.stage(remark.name) in stages:
            message = f"the solution has no step of {remark.name}"
            lost.append(problem.finding(("remarks", remark.key), message, "remark on another result"))
    if lost:
        raise ProblemError(lost)
    for step in steps:
        yield replace(step, notes=(*step.notes, *notes[step.id])) if step.id in notes else step


def _looked_up(known: Quantities, name: str) -> Iterator[str]:
    """The names under which the step of a result may be found, the nearest first."""
    quantity = known[name]
    yield from (name, quantity.rule, quantity.whole, name.lower())
    yield from (known[part].rule for part in reversed(known.parts(name)))
