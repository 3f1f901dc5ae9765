"""What the check of a question is given: the results of a robot as they are printed."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence

from msgspec import Struct

from dynsolve.algebra.compact.proof import nested_form
from dynsolve.algebra.fraction import RationalExpr
from dynsolve.algebra.linear_systems import FractionMatrix, fraction_of
from dynsolve.algebra.matrix import Matrix as AnyMatrix
from dynsolve.algebra.ring import Expr
from dynsolve.derivation.graph import Derivation, known
from dynsolve.errors import VerificationError
from dynsolve.explain.forms import Forms
from dynsolve.notation.build import times
from dynsolve.notation.tree import Matrix, Node
from dynsolve.robot.model import Robot


class Held(Struct, frozen=True):
    """The results to be held: `wanted` are their names, and those that they are derived from.

    They are compared at `states` random states; those that are too long to be printed as they are derived.
    """

    robot: Robot
    values: Derivation
    forms: Forms
    wanted: frozenset[str]
    states: int

    def hold(self, verify: Callable[[Robot, Mapping[str, Node], int], object], names: Iterable[str]) -> None:
        """Compare printed forms, by name; those that the robot has not are passed over."""
        verify(
            self.robot, {name: self._form(name) for name in names if name in self.values.rules}, self.states
        )

    def _form(self, name: str) -> Node:
        value = known(self.values[name])
        return self.forms(name) if value is self.values[name] else as_derived(value)


def as_derived(value: AnyMatrix | FractionMatrix) -> Matrix:
    """A result that is too long to be printed, its terms as they come."""

    def entry(one: Expr | RationalExpr) -> Node:
        found = fraction_of(one)
        return times(1, [(nested_form(found.numerator), 1), (nested_form(found.denominator), -1)])

    return Matrix(tuple(tuple(map(entry, row)) for row in value.rows))


Rows = Sequence[Sequence[float]]

TOLERANCE = 1e-5
"""The largest error of an entry, relative to the largest: differences are no derivatives."""


def compare(name: str, ours: Rows, theirs: Rows) -> None:
    """Raises VerificationError where two matrices of numbers differ."""
    size = max((1.0, *(abs(x) for row in theirs for x in row)))
    gaps = (abs(a - b) for r, s in zip(ours, theirs, strict=True) for a, b in zip(r, s, strict=True))
    if not all(gap <= TOLERANCE * size for gap in gaps):
        raise VerificationError(f"{name} differs from elimination on numbers; this is a fault of dynsolve")
