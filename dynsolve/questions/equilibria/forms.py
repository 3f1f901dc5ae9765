"""Equilibria, and what balances gravity, as formulas."""

from __future__ import annotations

from functools import cached_property
from typing import TYPE_CHECKING

from dynsolve.algebra.factors import is_positive
from dynsolve.derivation.graph import Skipped
from dynsolve.notation.tree import (
    Node,
)
from dynsolve.questions.equilibria.solving import SpecialCase

if TYPE_CHECKING:
    pass


from dynsolve.explain.set_forms import SetForms


class EquilibriaForms(SetForms):
    """The alternatives and the conditions of one robot."""

    @cached_property
    def equilibria(self) -> tuple[tuple[Node, ...], ...]:
        """The equilibria: alternatives of expressions that are 0 together; none where they are too long."""
        return self.alternatives("equilibria")

    def special_forces(self, case: SpecialCase) -> tuple[Node, ...] | None:
        """What must be 0 for special parameters, without what never is; None where it cannot be."""
        if any(is_positive(force) or is_positive(-force) for force in case.forces):
            return None
        return tuple(dict.fromkeys(map(self.vanishing, case.forces)))

    @cached_property
    def balance(self) -> tuple[Node, ...]:
        """What must be 0 for gravity to be balanced; none where it is too long."""
        found = self.values["balance"]
        if isinstance(found, Skipped):
            return ()
        return tuple(map(self.compactor(self.robot.ring).form, found))
