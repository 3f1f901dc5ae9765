"""Choosing a dress for each of many small trigonometric polynomials.

The cheapest dress of one may be dear for the whole: a monomial that others wear
already costs only its coefficient.  So everyone picks the cheapest, and then picks
again at the prices that the first choice has made.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from typing import NamedTuple

from dynsolve.algebra.compact.terms import Exponents, Factor, primitive
from dynsolve.algebra.compact.trig_forms import Dress, Monomial, Poly, dresses

TERM = 3.0
"""What a term costs besides its waves: a sign, a product and a coefficient."""

SHARED = 0.75
"""The part of a wave's price that is saved where another coefficient stands at it too."""


class _Option(NamedTuple):
    items: tuple[tuple[Monomial, Factor], ...]
    price: float
    waves: tuple[float, ...]


Face = dict[Exponents, Factor]
"""A small trigonometric polynomial in the angles of one group."""


class Wardrobe:
    """The dresses of every face met so far, each made once."""

    def __init__(self, dresses: Callable[[Poly], list[Dress]] = dresses) -> None:
        self._dresses = dresses
        self._made: dict[frozenset[tuple[Exponents, Factor]], list[_Option]] = {}

    def choose(self, faces: Mapping[Exponents, Face]) -> dict[Exponents, list[tuple[Monomial, Factor]]]:
        """For each face its dress as (monomial, factor)."""
        options = {rest: self._options(face) for rest, face in faces.items()}
        picked = {rest: made[0] for rest, (made, _) in options.items()}
        worn = Counter(mono for option in picked.values() for mono, _ in option.items)
        common = {mono for mono, count in worn.items() if count > 1}
        for rest, (made, _) in options.items():
            if len(made) > 1 and common:
                picked[rest] = min(made, key=lambda o: _reduced(o, common))
        return {rest: [(m, f * options[rest][1]) for m, f in option.items] for rest, option in picked.items()}

    def _options(self, face: Face) -> tuple[list[_Option], Factor]:
        """(dresses, the cheapest first; the factor they are to be multiplied with)"""
        if len(face) == 1:
            ((exponents, scale),) = face.items()
            key: frozenset[tuple[Exponents, Factor]] = frozenset(((exponents, 1),))
        else:
            key, scale = primitive(face)
        made = self._made.get(key)
        if made is None:
            made = self._made[key] = sorted(map(_option, self._dresses(dict(key))), key=lambda o: o.price)
        return made, scale


def _option(dress: Mapping[Monomial, Factor]) -> _Option:
    waves = tuple(float(sum(2 + _angle_cost(turns) + (e > 1) for (_, turns), e in mono)) for mono in dress)
    odd = sum(0.5 * (abs(f) != 1) + (f.denominator != 1) for f in dress.values())
    return _Option(tuple(dress.items()), TERM * len(dress) + sum(waves) + odd, waves)


def _reduced(option: _Option, common: set[Monomial]) -> float:
    saved = sum(w for (mono, _), w in zip(option.items, option.waves, strict=True) if mono in common)
    return option.price - SHARED * saved


def _angle_cost(turns: Sequence[int]) -> int:
    """The operations inside sin( ): 1 for θ₂ + θ₃ and for 2θ₂."""
    return sum(1 + (abs(t) != 1) for t in turns if t) - 1
