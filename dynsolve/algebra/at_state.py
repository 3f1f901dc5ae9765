"""Exact values of coordinates and their rates put into expressions, within one ring.

Coordinates without a value stay: sin(q₁ + q₂) at q₂ = 90° is cos q₁.  The map respects
sums and products; the ring must hold the sines and cosines of the values (`needed_angles`).
"""

from __future__ import annotations

from collections.abc import Mapping
from functools import cached_property
from typing import Any

from dynsolve.algebra.angles import Angle, angle_from_tree
from dynsolve.algebra.expr import Expr
from dynsolve.algebra.matrix import Matrix
from dynsolve.algebra.ring import Ring
from dynsolve.algebra.ring_values import value_of
from dynsolve.notation.tree import Node

StateValues = Mapping[tuple[str, int], Node]
"""Formulas free of coordinates by (name, number of dots)."""


def angle_at(angle: Angle, values: StateValues) -> Angle:
    """An angle with values for the coordinates in it."""
    result = Angle((), angle.degrees)
    for atom, rate in angle.terms:
        if len(atom) == 1 and atom[0][1] == 1 and (atom[0][0], 0) in values:
            result = result + angle_from_tree(values[atom[0][0], 0]) * rate
        else:
            result = result + Angle(((atom, rate),))
    return result


def needed_angles(ring: Ring, values: StateValues) -> list[Angle]:
    """The angles whose sines and cosines a ring must hold for these values."""
    return [angle_at(pair.angle, values) for pair in ring.pairs]


class AtState:
    """Puts values into the expressions of a ring.

    >>> from dynsolve.algebra.build import build_ring
    >>> from dynsolve.notation.text import read
    >>> both = Angle.of("q1") + Angle.of("q2")
    >>> coordinates = [("q1", "revolute"), ("q2", "revolute")]
    >>> ring = build_ring(coordinates, [read("pi").tree], [Angle.of("q1"), both])
    >>> AtState(ring, {("q2", 0): read("90deg").tree})(ring.sin(both)) == ring.cos(Angle.of("q1"))
    True
    """

    def __init__(self, ring: Ring, values: StateValues) -> None:
        self.ring, self.values = ring, values

    @cached_property
    def _images(self) -> tuple[Any, ...]:
        images = [self.ring.generator(g.index) for g in self.ring.generators]
        for pair in self.ring.pairs:
            angle = angle_at(pair.angle, self.values)
            if angle != pair.angle:
                images[pair.sine], images[pair.cosine] = self.ring.sin(angle), self.ring.cos(angle)
        for (name, dots), tree in self.values.items():
            index = self.ring.symbol_indices[name, dots]
            images[index] = value_of(self.ring, tree)
        return tuple(image.poly for image in images)

    def __call__(self, expr: Expr) -> Expr:
        """The expression with the values in it."""
        if not self.values or expr.is_number:
            return expr
        return Expr(self.ring, self.ring.reduce(expr.poly.compose(*self._images, ctx=self.ring.ctx)))

    def matrix(self, matrix: Matrix) -> Matrix:
        """The matrix with the values in it."""
        return matrix.map(self)
