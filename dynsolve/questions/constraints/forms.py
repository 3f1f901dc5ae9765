"""The equations of motion without multipliers, as formulas."""

from __future__ import annotations

from functools import cached_property

from dynsolve.algebra.ring import Expr
from dynsolve.derivation.graph import Skipped
from dynsolve.notation.tree import Node
from dynsolve.questions.constraints.closed import closed
from dynsolve.questions.set_forms import SetForms


class ReducedForms(SetForms):
    """The equations of one robot."""

    @cached_property
    def reduced(self) -> tuple[tuple[Node, Node], ...]:
        """Both sides of the equations of motion without multipliers; none where they are too long."""
        found = self.values["reduced"]
        return () if isinstance(found, Skipped) else self._sides(found.equations)

    @cached_property
    def closed(self) -> tuple[tuple[Node, Node], ...]:
        """The same in the accelerations that are free; none where the others take a quotient."""
        found = closed(self.robot, self.values["Ac"], self.values["reduced"])
        return () if found is None else self._sides(found.equations)

    def _sides(self, equations: tuple[tuple[Expr, Expr], ...]) -> tuple[tuple[Node, Node], ...]:
        form = self.compactor(self.robot.ring).form
        return tuple((form(left), form(right)) for left, right in equations)
