"""Values at which formulas are compared in numbers: all quadrants, both signs, parameters in every order.

What holds in one quadrant alone, as atan(y/x) does for atan2(y, x), must not be taken for right.  So
values lie on sides: an angle where its sine and its cosine are positive or negative, a length along a
joint and a rate where they are positive or negative, large or small, a parameter where it is large or
small.  On which side is the parity of k & m, of the number k of the sample and a mask m of each side:
in each 16 samples any three of the first eight sides meet in all eight ways equally often, and the
sides of any two of the first four coordinates in all sixteen; in each four, every coordinate is on all
four of its own (orthogonal arrays; Hedayat, Sloane and Stufken, Orthogonal Arrays, chapter 3).  Where
between its ends a value lies is random, of a fixed seed.

Carrying exact expressions over from one ring into another that holds the same things and more.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from functools import cached_property
from itertools import count
from math import pi
from random import Random
from typing import Any

from dynsolve.algebra.angles import Angle, name_alone
from dynsolve.algebra.ring import Expr, Ring
from dynsolve.algebra.ring_values import value_of
from dynsolve.notation.tree import Function

SEED = 20_200_312
"""The samples are the same every time."""

ENOUGH = 16
"""So many samples have every quadrant of two angles with every order of two parameters."""

_MASKS = (1, 3, 5, 15, 9, 7, 13, 11)
"""Those of the first eight sides; of the next ones the same with a higher bit."""

_END, WIDEST = 0.1, 1.5
"""How near values come to 0 and to right angles, where formulas lose digits, and how far lengths go."""


class Sample:
    """The values of sample number `k`, drawn one after the other."""

    def __init__(self, k: int, random: Random) -> None:
        self.k, self.random, self._sides = k, random, 0

    def angle(self) -> float:
        """An angle in (-π, π)."""
        sine, cosine = self.side(), self.side()
        acute = self.random.uniform(_END, pi / 2 - _END)
        return sine * (acute if cosine > 0 else pi - acute)

    def signed(self) -> float:
        """A number of either sign."""
        sign = self.side()
        return sign * (
            self.random.uniform(_END, 0.8) if self.side() < 0 else self.random.uniform(0.8, WIDEST)
        )

    def positive(self) -> float:
        """The value of a parameter."""
        return self.random.uniform(0.2, 0.7) if self.side() < 0 else self.random.uniform(1.0, 1.8)

    def side(self) -> int:
        """+1 or -1; half of the sides begin with each."""
        higher, place = divmod(self._sides, len(_MASKS))
        self._sides += 1
        mask = _MASKS[place] + 16 * higher
        ones = (self.k & mask).bit_count() + (mask & mask >> 1).bit_count()
        return 1 - 2 * (ones % 2)


def numbered(first: int = 0) -> Iterator[Sample]:
    """One sample after the other, without end."""
    random = Random(SEED + first)  # noqa: S311 - the same samples every time are wanted
    return (Sample(k, random) for k in count(first))


def samples(ring: Ring, signed: Iterable[str] = (), first: int = 0) -> Iterator[dict[str, float]]:
    """Values of coordinates, positive parameters and rates, by plain names, and of further `signed` names.

    Those from another `first` sample on are others.
    """
    rates = [f"{name}_{dots}" for dots in ("dot", "ddot") for name in ring.names]
    for sample in numbered(first):
        values = {"pi": pi}
        for name, kind in ring.coordinates:
            values[name] = sample.angle() if kind == "revolute" else sample.signed()
        values |= {name: sample.positive() for name in ring.parameters}
        yield values | {name: sample.signed() for name in (*rates, *signed)}


# Carrying exact expressions over from one ring into another that holds the same things and more


class Transfer:
    """The map of expressions of `source` into `target`; it respects sums and products.

    `target` has every symbol and every root of `source`, and holds its angles, perhaps on
    another basis.  `angles` are put for coordinates in the arguments of sines and cosines.

    >>> from dynsolve.algebra.ring_values import build_ring
    >>> coordinates = [("q1", "revolute"), ("q2", "revolute")]
    >>> both = Angle.of("q1") + Angle.of("q2")
    >>> absolute = build_ring(coordinates, [], [Angle.of("q1"), both], [Angle.of("q1"), both])
    >>> relative = build_ring(coordinates, [], [Angle.of("q1"), Angle.of("q2")])
    >>> Transfer(absolute, relative)(absolute.sin(both))
    Expr(1*sin(1*(('q1', 1),))*cos(1*(('q2', 1),)) + 1*sin(1*(('q2', 1),))*cos(1*(('q1', 1),)))
    """

    def __init__(self, source: Ring, target: Ring, angles: Mapping[str, Angle] | None = None) -> None:
        self.source, self.target = source, target
        self._angles = angles or {}

    def __call__(self, expr: Expr) -> Expr:
        """The expression in the target ring."""
        if expr.ring is self.target:
            return expr
        if not expr.poly:
            return self.target.zero
        poly = expr.poly.compose(*self._images, ctx=self.target.ctx)
        return Expr(self.target, self.target.reduce(poly))

    def angle(self, angle: Angle) -> Angle:
        """An angle with the given angles in place of coordinates."""
        result = Angle((), angle.degrees)
        for atom, rate in angle.terms:
            result = result + self._angles.get(name_alone(atom), Angle(((atom, 1),))) * rate  # type: ignore[arg-type]
        return result

    @cached_property
    def _images(self) -> tuple[Any, ...]:
        """What each generator of the source is in the target."""
        return tuple(image.poly for image in self._make_images())

    def _make_images(self) -> Iterator[Expr]:
        ring = self.target
        waiting: list[int] = []
        images: list[Expr] = []
        for g in self.source.generators:
            match g.kind:
                case "sin":
                    images.append(ring.sin(self.angle(g.angle)))
                case "cos" | "constant":
                    images.append(ring.cos(self.angle(g.angle)))
                case "symbol":
                    images.append(ring.symbol(g.name, g.dots))
                case "root":
                    assert g.node is not None
                    images.append(ring.root(g.node, value_of(ring, g.node)))
                case "function":
                    assert isinstance(g.node, Function)
                    images.append(ring.function(g.node))
                case _:
                    waiting.append(g.index)
                    images.append(ring.zero)
        for index in waiting:
            inverted = self.source.inverses.get(index)
            if inverted is not None:
                polys = [image.poly for image in images]
                images[index] = ring.inverse(Expr(ring, ring.reduce(inverted.compose(*polys, ctx=ring.ctx))))
        yield from images
