"""Exact angles: directions of points (x, y) whose coordinates are sums of roots, and degrees beside them."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cache
from math import atan2, copysign, pi, radians

from dynsolve.algebra.surds import NotExact, Surd, whole_multiple
from dynsolve.notation.build import cost, negated, times, total
from dynsolve.notation.tree import Arguments, Function, Node, Symbol
from dynsolve.notation.walk import walk

PI = Symbol("pi")

_STEP = 15
"""The sines and cosines of the multiples of so many degrees are sums of roots."""


@dataclass(frozen=True, slots=True)
class SurdAngle:
    """The angle of the point (x, y), which is not the origin, and `rest` degrees; modulo 2π.

    The length of (x, y) means nothing.  `rest` is 0 or no multiple of 15, between -45 and 45.

    >>> right = SurdAngle(Surd.of(0), Surd.of(1))
    >>> (right + right).is_same(SurdAngle.of_degrees(180))
    True
    """

    x: Surd
    y: Surd
    rest: Fraction = Fraction(0)

    @staticmethod
    def of_degrees(degrees: Fraction | int) -> SurdAngle:
        """A constant angle."""
        steps = Fraction(degrees) / _STEP
        if steps.denominator == 1:
            return _multiples()[int(steps) % (360 // _STEP)]
        quarters = round(Fraction(degrees) / 90)
        quarter = _multiples()[quarters * 90 // _STEP % (360 // _STEP)]
        return SurdAngle(quarter.x, quarter.y, Fraction(degrees) - 90 * quarters)

    @property
    def norm(self) -> Surd:
        """√(x² + y²); raises NotExact where it is no sum of roots, or there is a rest."""
        if self.rest:
            raise NotExact
        return (self.x * self.x + self.y * self.y).root()

    @property
    def cosine(self) -> Surd:
        """cos, exact."""
        return self.x / self.norm

    @property
    def sine(self) -> Surd:
        """sin, exact."""
        return self.y / self.norm

    def __add__(self, other: SurdAngle) -> SurdAngle:
        x = self.x * other.x - self.y * other.y
        y = self.x * other.y + self.y * other.x
        size = Surd.of(whole_multiple((x, y)))
        both = SurdAngle(x * size, y * size)
        if not (self.rest or other.rest):
            return both
        more = SurdAngle.of_degrees(self.rest + other.rest)
        return replace(both + replace(more, rest=Fraction(0)), rest=more.rest)

    def __neg__(self) -> SurdAngle:
        return SurdAngle(self.x, -self.y, -self.rest)

    def times(self, factor: Fraction) -> SurdAngle:
        """A whole multiple; raises NotExact for another."""
        if factor.denominator != 1 or abs(factor) > 12:
            raise NotExact
        one = self if factor > 0 else -self
        found = SurdAngle.of_degrees(0)
        for _ in range(abs(int(factor))):
            found = found + one
        return found

    def is_same(self, other: SurdAngle) -> bool:
        """Whether both are one angle, modulo 2π."""
        across = self.x * other.y - self.y * other.x
        return self.rest == other.rest and across.is_zero and (self.x * other.x + self.y * other.y).sign > 0

    def __float__(self) -> float:
        """The angle in radians, greater than -π and at most π."""
        value = atan2(float(self.y), float(self.x)) + radians(self.rest)
        if value > pi or value <= -pi:
            value -= copysign(2 * pi, value)
        return pi if not self.rest and self.y.is_zero and self.x.sign < 0 else value

    @property
    def node(self) -> Node:
        """The angle as a formula: π/3, arccos(1/3), atan2(4, 3)."""
        direction = replace(self, rest=Fraction(0))
        for steps, angle in enumerate(_multiples()):
            if direction.is_same(angle):
                degrees = steps * _STEP + self.rest
                return times((degrees if degrees <= 180 else degrees - 360) / 180, [(PI, 1)])
        if self.rest:
            return total([direction.node, times(self.rest / 180, [(PI, 1)])])
        return min(self._written(), key=lambda node: (_roots(node), cost(node)))

    def _written(self) -> Iterator[Node]:
        size = Surd.of(whole_multiple((self.x, self.y)))
        x, y = self.x * size, self.y * size
        yield _atan2(y, x)
        shared = {m for m, _ in (*x.terms, *y.terms)}
        for m in sorted(shared - {1}):
            root = Surd(((m, Fraction(1)),))
            size = Surd.of(whole_multiple((x * root, y * root)))
            yield _atan2(y * root * size, x * root * size)
        try:
            norm = self.norm
        except NotExact:
            return
        cosine, sine = self.x / norm, self.y / norm
        if cosine.rational is not None:
            found = Function("acos", cosine.node)
            yield found if sine.sign > 0 else negated(found)
        if sine.rational is not None:
            angle: Node = Function("asin", (sine if sine.sign > 0 else -sine).node)
            parts = [angle] if cosine.sign > 0 else [PI, negated(angle)]
            yield total(parts if sine.sign > 0 else [negated(part) for part in parts])


def _roots(node: Node) -> int:
    return sum(isinstance(part, Function) and part.name == "sqrt" for part in walk(node))


def _atan2(y: Surd, x: Surd) -> Node:
    return Function("atan2", Arguments((y.node, x.node)))


@cache
def _multiples() -> tuple[SurdAngle, ...]:
    """0°, 15°, 30°, ... up to 345°."""
    root6, root2 = (Surd(((m, Fraction(1, 4)),)) for m in (6, 2))
    step = SurdAngle(root6 + root2, root6 - root2)
    found = [SurdAngle(Surd.of(1), Surd())]
    while len(found) < 360 // _STEP:
        found.append(found[-1] + step)
    return tuple(found)
