"""Where a Jacobian has less than its greatest rank (Spong, section 4.9)."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from dynsolve.algebra.matrix import Matrix
from dynsolve.derivation.graph import Rule, Skipped
from dynsolve.questions.rates.derive import whole_or_task
from dynsolve.robot.model import Robot

if TYPE_CHECKING:
    from dynsolve.derivation.singular.sets import SingularSet


def rules(robot: Robot) -> Iterator[Rule]:
    """The singular configurations: of the task, or of the whole Jacobian."""
    yield Rule("singular", (whole_or_task(robot),), where_singular)


def where_singular(jacobian: Matrix) -> SingularSet | Skipped:
    """The alternatives; they are skipped where the minors are too long."""
    from dynsolve.algebra.sampling import Transfer
    from dynsolve.derivation.search_ring import search_ring
    from dynsolve.derivation.singular.sets import singular_set

    ring = search_ring(jacobian.ring, (), {})
    found = singular_set(jacobian.map(Transfer(jacobian.ring, ring)))
    return found or Skipped("the Jacobian and its minors are too long to be taken apart into factors")
