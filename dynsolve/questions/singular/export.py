"""Singular configurations in the JSON of a solution."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from dynsolve.questions.export import Export, alternatives, existence
from dynsolve.questions.singular.forms import SingularForms


def value(export: Export, name: str) -> Any:
    """The alternatives, each a list of equations."""
    return alternatives(export, SingularForms(export.robot, export.values), name)


def beside(export: Export) -> Iterator[tuple[str, Any]]:
    """`singular_exist`: where alternatives are there for some parameters alone."""
    shown = SingularForms(export.robot, export.values)
    if shown.singular_set is not None:
        yield from existence("singular", shown, export.python, shown.singular_set.exist)
