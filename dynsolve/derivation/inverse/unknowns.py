"""The ring in which a task is solved for its coordinates, and which of these are still unknown."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cached_property
from math import lcm
from typing import Any

from dynsolve.algebra.angles import Angle
from dynsolve.algebra.build import ring_of
from dynsolve.algebra.contents import Contents
from dynsolve.algebra.expr import Expr
from dynsolve.algebra.rationals import rational_gcd
from dynsolve.algebra.ring import Ring


def search_ring(ring: Ring, values: Sequence[str], given_angles: Mapping[str, Angle]) -> Ring:
    """The ring with one basic angle a revolute coordinate and the task's `values` as symbols.

    `given_angles` are the coordinates that sums of angles in the task give away, each as an angle of
    such values and of other coordinates: the names of these values are angles too.
    """
    names = [name for name, _ in ring.coordinates]
    turning = tuple(
        (_unit(names, name, _finest_rate(ring, name)), Angle())
        for name, kind in ring.coordinates
        if kind == "revolute" and name not in given_angles
    )
    carried = (_put(pair.angle, given_angles).degrees for pair in ring.pairs)
    constants = Contents(angles=tuple(Angle((), degrees) for degrees in carried if degrees % 90))
    plan = ring.plan.extended(constants, 0) if given_angles else ring.plan
    fixed = dict(plan.fixed)
    for atom, rate in (term for angle in given_angles.values() for term in angle.terms):
        if atom[0][0] not in names:
            fixed[atom] = rational_gcd((rate, fixed.get(atom, rate)))
    symbols = tuple(dict.fromkeys((*plan.symbols, *values)))
    return ring_of(
        ring.coordinates,
        replace(plan, turning=turning, fixed=tuple(fixed.items()), symbols=symbols, signed=tuple(values)),
    )


def _put(angle: Angle, angles: Mapping[str, Angle]) -> Angle:
    """An angle with others for coordinates."""
    found = angle
    for atom, rate in angle.terms:
        if atom[0][0] in angles:
            found = found + (angles[atom[0][0]] - Angle.of(atom[0][0])) * rate
    return found


def _unit(names: Sequence[str], name: str, rate: Fraction) -> tuple[Fraction, ...]:
    return tuple(rate if other == name else Fraction(0) for other in names)


def _finest_rate(ring: Ring, name: str) -> Fraction:
    """The part of a coordinate of which all its multiples in angles are whole multiples."""
    rates = [rate for pair in ring.pairs for atom, rate in pair.angle.terms if atom == ((name, 1),)]
    return Fraction(1, lcm(*(rate.denominator for rate in rates))) if rates else Fraction(1)


@dataclass(frozen=True)
class Unknowns:
    """The coordinates that are still looked for, in one ring; `values` are the names of the task's values."""

    ring: Ring
    names: tuple[str, ...]
    values: tuple[str, ...]

    def without(self, name: str) -> Unknowns:
        """The same after `name` has been solved for."""
        return replace(self, names=tuple(other for other in self.names if other != name))

    @cached_property
    def turning(self) -> tuple[str, ...]:
        """The unknown angles."""
        return tuple(name for name in self.names if self._kind[name] == "revolute")

    @cached_property
    def sliding(self) -> tuple[str, ...]:
        """The unknown lengths."""
        return tuple(name for name in self.names if self._kind[name] == "prismatic")

    @cached_property
    def _kind(self) -> dict[str, str]:
        return dict(self.ring.coordinates)

    @cached_property
    def _generators(self) -> dict[str, tuple[int, ...]]:
        """Of each coordinate the generators in which it occurs."""
        found: dict[str, list[int]] = {name: [] for name in self.names}
        for pair in self.ring.pairs:
            for atom, _ in pair.angle.terms:
                for name, _ in atom:
                    if name in found:
                        found[name] += [pair.sine, pair.cosine]
        for name in found:
            found[name].append(self.ring.symbol_indices[(name, 0)])
        return {name: tuple(indices) for name, indices in found.items()}

    @cached_property
    def places(self) -> tuple[int, ...]:
        """The generators of all unknowns."""
        return tuple(i for indices in self._generators.values() for i in indices)

    def pair(self, name: str) -> tuple[int, int]:
        """The generators of the sine and the cosine of an unknown angle."""
        sine, cosine, _ = self._generators[name]
        return sine, cosine

    def sine(self, name: str) -> Expr:
        """sin of an unknown angle."""
        return self.ring.sin(Angle.of(name))

    def cosine(self, name: str) -> Expr:
        """cos of an unknown angle."""
        return self.ring.cos(Angle.of(name))

    def has(self, expr: Expr, name: str) -> bool:
        """Whether an unknown occurs in an expression."""
        degrees = expr.poly.degrees()
        return any(degrees[i] > 0 for i in self._generators[name])

    def within(self, expr: Expr) -> tuple[str, ...]:
        """The unknowns that occur in an expression."""
        return tuple(name for name in self.names if self.has(expr, name))

    def split(self, expr: Expr) -> tuple[Expr, Expr]:
        """(the terms without an unknown, the others)"""
        known: dict[tuple[int, ...], Any] = {}
        unknown: dict[tuple[int, ...], Any] = {}
        for exponents, factor in expr.poly.to_dict().items():
            is_unknown = any(exponents[i] for i in self.places)
            (unknown if is_unknown else known)[exponents] = factor
        ring = self.ring
        return Expr(ring, ring.ctx.from_dict(known)), Expr(ring, ring.ctx.from_dict(unknown))
