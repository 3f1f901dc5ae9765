"""Carrying exact expressions over from one ring into another that holds the same things and more."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from functools import cached_property
from typing import Any

from dynsolve.algebra.angles import Angle
from dynsolve.algebra.expr import Expr
from dynsolve.algebra.ring import Ring
from dynsolve.algebra.ring_values import value_of
from dynsolve.notation.tree import Function


class Transfer:
    """The map of expressions of `source` into `target`; it respects sums and products.

    `target` has every symbol and every root of `source`, and holds its angles, perhaps on
    another basis.  `angles` are put for coordinates in the arguments of sines and cosines.

    >>> from dynsolve.algebra.build import build_ring
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
            name = atom[0][0] if len(atom) == 1 and atom[0][1] == 1 else ""
            result = result + self._angles.get(name, Angle(((atom, 1),))) * rate  # type: ignore[arg-type]
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
