"""Singular configurations as formulas, and the directions that are lost there."""

from __future__ import annotations

from functools import cached_property

from dynsolve.derivation.singular.losses import Direction
from dynsolve.derivation.singular.sets import SingularSet
from dynsolve.notation.tree import Matrix, Node, column
from dynsolve.questions.set_forms import SetForms


class SingularForms(SetForms):
    """The alternatives of one robot."""

    @cached_property
    def singular_set(self) -> SingularSet | None:
        """Where the Jacobian of the task loses rank; None where it is too long."""
        found = self.values["singular"]
        return found if isinstance(found, SingularSet) else None

    @cached_property
    def singular(self) -> tuple[tuple[Node, ...], ...]:
        """The alternatives: expressions that are 0 together."""
        return self.alternatives("singular")

    @cached_property
    def lost(self) -> tuple[tuple[Matrix, ...], ...]:
        """At each alternative the directions that are lost, each a column."""
        losses = () if self.singular_set is None else self.singular_set.losses
        return tuple(tuple(map(self._column, loss.directions)) for loss in losses)

    @cached_property
    def lost_here(self) -> tuple[tuple[Matrix, ...], ...]:
        """The same without those that are lost in every configuration."""
        losses = () if self.singular_set is None else self.singular_set.losses
        return tuple(tuple(map(self._column, loss.here)) for loss in losses)

    def _column(self, direction: Direction) -> Matrix:
        compactor = self.compactor(direction[0].ring)
        return column(*compactor.collector.direction([*map(compactor.form, direction)]))
