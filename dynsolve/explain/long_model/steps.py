"""The steps of a derivation, those of a long model told otherwise."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace

from dynsolve.derivation.rules import course_rules
from dynsolve.explain.abbreviations import Abbreviated
from dynsolve.explain.context import Context
from dynsolve.explain.long_model import energies, frames, vectorized
from dynsolve.explain.long_model.general import GeneralStep, general_steps
from dynsolve.explain.long_model.inertia_entry import worked_entry
from dynsolve.explain.long_model.model import LongModel
from dynsolve.explain.long_model.sizes import is_too_long, left_out
from dynsolve.explain.step import Detail, Step

_DIRECT = "D_direct"
"""The step that assembles D from the Jacobians."""

_READ_OFF = ("Cqd", "agreement")
"""The steps of what is read off from the forces, which are in the same letters, and compared."""


def of_long_model(steps: Iterable[Step], context: Context, short: Abbreviated) -> Iterator[Step]:
    """The steps of a long model, what is alike said once."""
    steps = tuple(steps)
    direct = next((step for step in steps if step.id == _DIRECT), None)
    model = LongModel(context, short, direct)
    changes = frames.changes(model) | energies.changes(model) | vectorized.changes(model)
    general = {name: group for group in general_steps(context) for name in group.details}
    inputs = {rule.name: rule.inputs for rule in course_rules(context.robot)}
    told: set[GeneralStep] = set()
    for step in steps:
        if step is direct:  # its formula is that of D itself
            continue
        if direct is not None and step.id in _READ_OFF:  # nothing is read off: there is one way only
            continue
        group = general.get(step.id)
        if group is not None and group not in told:
            told.add(group)
            yield group.step
        change = changes.get(step.id)
        if change is not None:
            step = change(step)
        elif is_too_long(step):
            step = left_out(step)
        uses = inputs.get(step.id, ()) if step.uses is None else step.uses
        if group is not None:
            yield replace(step, detail=Detail.FULL)
        else:
            yield replace(step, uses=tuple(dict.fromkeys(_source(name, general) for name in uses)))
        if step.id == "D" and (entry := worked_entry(model)):
            yield entry.step()
        if step.id == "C":
            yield vectorized.coriolis_entries(model, step)


def _source(name: str, general: Mapping[str, GeneralStep]) -> str:
    """What a result is to be looked up under: where it is a detail, the step that speaks of all like it."""
    group = general.get(name)
    return name if group is None else group.step.id
