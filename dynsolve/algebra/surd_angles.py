"""Angles with exact sine and cosine: the directions of points (x, y) whose coordinates are sums of roots."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction
from functools import cache
from math import atan2, pi

from dynsolve.algebra.surds import NotExact, Surd, whole_multiple
from dynsolve.notation.build import cost, negated, times, total
from dynsolve.notation.tree import Arguments, Function, Node, Symbol
from dynsolve.notation.walk import walk

PI = Symbol("pi")

_STEP = 15
"""The sines and cosines of the multiples of so many degrees are sums of roots."""


@dataclass(frozen=True, slots=True)
class SurdAngle:
    """The angle of the point (x, y), which is not the origin; modulo 2π, whatever the length of (x, y).

    >>> right = SurdAngle(Surd.of(0), Surd.of(1))
    >>> (right + right).is_same(SurdAngle.of_degrees(180))
    True
    """

    x: Surd
    y: Surd

    @staticmethod
    def of_degrees(degrees: Fraction | int) -> SurdAngle:
        """A constant angle; raises NotExact for what is no multiple of 15 degrees."""
        steps = Fraction(degrees) / _STEP
        if steps.denominator != 1:
            raise NotExact
        return _multiples()[int(steps) % (360 // _STEP)]

    @property
    def norm(self) -> Surd:
        """√(x² + y²); raises NotExact where it is no sum of roots."""
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
        return SurdAngle(x * size, y * size)

    def __neg__(self) -> SurdAngle:
        return SurdAngle(self.x, -self.y)

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
        return across.is_zero and (self.x * other.x + self.y * other.y).sign > 0

    def __float__(self) -> float:
        """The angle in radians, greater than -π and at most π."""
        value = atan2(float(self.y), float(self.x))
        return pi if self.y.is_zero and self.x.sign < 0 else value

    @property
    def node(self) -> Node:
        """The angle as a formula: π/3, arccos(1/3), atan2(4, 3)."""
        for steps, angle in enumerate(_multiples()):
            if self.is_same(angle):
                turned = steps if 2 * steps <= len(_multiples()) else steps - len(_multiples())
                return times(Fraction(turned * _STEP, 180), [(PI, 1)])
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
            turned = angle if cosine.sign > 0 else total([PI, negated(angle)])
            yield turned if sine.sign > 0 else negated(turned)


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
