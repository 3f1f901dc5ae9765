"""Values at which formulas are compared in numbers: all quadrants, both signs, parameters in every order.

What holds in one quadrant alone, as atan(y/x) does for atan2(y, x), must not be taken for right.  So
values lie on sides: an angle where its sine and its cosine are positive or negative, a length along a
joint and a rate where they are positive or negative, large or small, a parameter where it is large or
small.  On which side is the parity of k & m, of the number k of the sample and a mask m of each side:
in each 16 samples any three of the first eight sides meet in all eight ways equally often, and the
sides of any two of the first four coordinates in all sixteen; in each four, every coordinate is on all
four of its own (orthogonal arrays; Hedayat, Sloane and Stufken, Orthogonal Arrays, chapter 3).  Where
between its ends a value lies is random, of a fixed seed.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from itertools import count
from math import pi
from random import Random

from dynsolve.algebra.ring import Ring

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
