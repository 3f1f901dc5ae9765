"""The equations of motion without multipliers, as formulas."""

from __future__ import annotations

from functools import cached_property

from dynsolve.derivation.graph import Skipped
from dynsolve.notation.tree import (
    Node,
)
from dynsolve.questions.set_forms import SetForms


class ReducedForms(SetForms):
    """The equations of one robot."""

    @cached_property
    def reduced(self) -> tuple[tuple[Node, Node], ...]:
        """Both sides of the equations of motion without multipliers; none where they are too long."""
        found = self.values["reduced"]
        form = self.compactor(self.robot.ring).form
        return () if isinstance(found, Skipped) else tuple((form(a), form(b)) for a, b in found.equations)
