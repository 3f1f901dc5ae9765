"""What the JSON of a solution says beside rates and spaces: where they hold."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from dynsolve.derivation.graph import Skipped
from dynsolve.notation.tree import Words
from dynsolve.questions.export import Export
from dynsolve.questions.rates.holding import Holding, of_rates, of_space
from dynsolve.questions.set_forms import SetForms


def beside(export: Export) -> Iterator[tuple[str, Any]]:
    """`qd_when`, `nullspace_when`: the rank that the Jacobian must have, and what may not be 0, if any."""
    forms = SetForms(export.robot, export.values)
    for name in ("qd", "qdd", "nullspace", "rangespace", "lost"):
        if name in export.robot.questions.asked and not isinstance(export.values[name], Skipped):
            found = of_rates(forms) if name in ("qd", "qdd") else of_space(forms, name)
            if found != Holding():
                yield f"{name}_when", dict(_written(export, found))


def _written(export: Export, holding: Holding) -> Iterator[tuple[str, Any]]:
    if holding.rank:
        yield "rank", holding.rank
    if holding.apart is not None:
        is_told = not isinstance(holding.apart, Words)
        yield "not_zero", export.python.text(holding.apart) if is_told else None
