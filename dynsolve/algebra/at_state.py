"""Exact values of coordinates and their rates put into expressions, within one ring.

Coordinates without a value stay: sin(q₁ + q₂) at q₂ = 90° is cos q₁.  The map respects
sums and products; the ring must hold the sines and cosines of the values (`needed_angles`,
`needed_roots`).  An angle may also be one whose sine is a sum of roots, such as atan2(4, 3);
where such a coordinate stands by itself, and not in a sine or cosine, it stays.
"""

from __future__ import annotations

from collections.abc import Mapping
from functools import cached_property
from typing import TYPE_CHECKING, Any

from dynsolve.algebra.angles import Angle, angle_from_tree, names_of
from dynsolve.algebra.expr import Expr
from dynsolve.algebra.generators import Pair
from dynsolve.algebra.matrix import Matrix
from dynsolve.algebra.ring import Ring
from dynsolve.algebra.ring_values import value_of
from dynsolve.errors import AlgebraError
from dynsolve.notation.tree import Function, Node
from dynsolve.notation.walk import walk

if TYPE_CHECKING:
    from dynsolve.algebra.surd_angles import SurdAngle

StateValues = Mapping[tuple[str, int], Node]
"""Formulas free of coordinates by (name, number of dots)."""

INVERSE = ("atan2", "acos", "asin", "atan")
"""The functions that give angles."""


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


def direction_at(angle: Angle, values: StateValues) -> SurdAngle:
    """An angle all of whose coordinates have values, exact; raises NotExact where it is none."""
    from dynsolve.algebra.surd_angles import SurdAngle
    from dynsolve.algebra.surd_values import exact_value
    from dynsolve.algebra.surds import NotExact, Surd

    found = SurdAngle.of_degrees(angle.degrees)
    for atom, rate in angle.terms:
        (name, _), *more = atom
        value = None if more or (name, 0) not in values else exact_value(values[name, 0], {})
        if isinstance(value, Surd) and value.is_zero:  # a plain 0 is the angle 0
            continue
        if not isinstance(value, SurdAngle):
            raise NotExact
        found = found + value.times(rate)
    return found


def needed_roots(ring: Ring, values: StateValues) -> list[Node]:
    """What a ring must hold where all coordinates have values: these, and sines and cosines as sums of roots.

    Raises NotExact where they are none.
    """
    moving = {name for name, _ in ring.coordinates}
    turned = [pair.angle for pair in ring.pairs if moving & set(names_of(pair.angle))]
    found = [direction_at(angle, values) for angle in turned]
    roots = [part.node for angle in found for part in (angle.sine, angle.cosine)]
    return [*roots, *filter(_has_value, values.values())]


def _has_value(tree: Node) -> bool:
    """Whether a formula has a value in a ring: no angle of a known sine."""
    return not any(isinstance(part, Function) and part.name in INVERSE for part in walk(tree))


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
            images[pair.sine], images[pair.cosine] = self._turned(pair)
        for (name, dots), tree in self.values.items():
            if _has_value(tree):
                images[self.ring.symbol_indices[name, dots]] = value_of(self.ring, tree)
        return tuple(image.poly for image in images)

    def _turned(self, pair: Pair) -> tuple[Expr, Expr]:
        """The sine and the cosine of an angle, with the values in it."""
        ring = self.ring
        try:
            angle = angle_at(pair.angle, self.values)
            if angle == pair.angle:
                return ring.generator(pair.sine), ring.generator(pair.cosine)
            return ring.sin(angle), ring.cos(angle)
        except AlgebraError:
            found = direction_at(pair.angle, self.values)
            return value_of(ring, found.sine.node), value_of(ring, found.cosine.node)

    def __call__(self, expr: Expr) -> Expr:
        """The expression with the values in it."""
        if not self.values or expr.is_number:
            return expr
        return Expr(self.ring, self.ring.reduce(expr.poly.compose(*self._images, ctx=self.ring.ctx)))

    def matrix(self, matrix: Matrix) -> Matrix:
        """The matrix with the values in it."""
        return matrix.map(self)
