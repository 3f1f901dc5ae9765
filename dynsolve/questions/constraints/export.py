"""The equations of motion without multipliers in the JSON of a solution."""

from __future__ import annotations

from typing import Any

from dynsolve.questions.constraints.forms import ReducedForms
from dynsolve.questions.export import Export, skipped


def value(export: Export, name: str) -> Any:
    """Equations, both sides of each."""
    sides = ReducedForms(export.general_robot, export.general_values).reduced
    written = [f"{export.python.text(left)} = {export.python.text(right)}" for left, right in sides]
    return skipped(export.general_values, name) or written
