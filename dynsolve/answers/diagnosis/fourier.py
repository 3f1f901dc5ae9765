"""An expression as terms that a person would name: a monomial in the symbols times waves.

A wave is the sine or cosine of an integer combination of the ring's basic angles;
c₁² - s₁² is one wave, cos 2θ₁, whatever dress it came in.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from fractions import Fraction
from functools import lru_cache
from math import prod
from typing import Any

from dynsolve.algebra.angles import Angle
from dynsolve.algebra.expr import Expr
from dynsolve.algebra.rationals import fraction, rational
from dynsolve.algebra.ring import Ring

Monomial = tuple[tuple[int, int], ...]
"""(generator, exponent) of the generators that are no sines and cosines."""

Wave = tuple[str, tuple[int, ...]]
"""(`sin` or `cos`, multiples of the basic angles), the first multiple that is not 0 positive."""

ONE: Monomial = ()

MOST_TERMS = 600
MOST_WAVES = 8_000
HIGHEST = 10


@dataclass(frozen=True, slots=True)
class Part:
    """monomial · Σ coefficient·wave"""

    monomial: Monomial
    waves: tuple[tuple[Wave, Fraction], ...]

    @property
    def single(self) -> tuple[Wave, Fraction] | None:
        """The one wave, where it is one."""
        return self.waves[0] if len(self.waves) == 1 else None


def is_small(expr: Expr) -> bool:
    """Whether an expression is small enough to be taken apart, which answers of people are."""
    if len(expr) > MOST_TERMS:
        return False
    if not expr.poly or not expr.ring.pairs:
        return True
    degrees = expr.poly.degrees()
    if (
        sum(max(int(degrees[p.sine]), 0) + max(int(degrees[p.cosine]), 0) for p in expr.ring.pairs)
        > 4 * HIGHEST
    ):
        return False
    places = [i for pair in expr.ring.pairs for i in (pair.sine, pair.cosine)]
    total = 0
    for exponents in expr.poly.monoms():
        powers = [int(exponents[i]) for i in places]
        if sum(powers) > HIGHEST:
            return False
        total += prod(power + 1 for power in powers)
    return total <= MOST_WAVES


def parts(expr: Expr) -> dict[Monomial, Part]:
    """The parts of an expression, by monomial."""
    width = len(expr.ring.pairs)
    return {m: Part(m, _waves(terms, width)) for m, terms in _groups(expr).items()}


def differing(a: Expr, b: Expr) -> tuple[dict[Monomial, Part], dict[Monomial, Part]]:
    """The parts in which two expressions differ; what is equal, which is most, is not taken apart."""
    width = len(a.ring.pairs)
    ours, theirs = _groups(a), _groups(b)
    found: tuple[dict[Monomial, Part], dict[Monomial, Part]] = {}, {}
    for into, groups, others in zip(found, (ours, theirs), (theirs, ours), strict=True):
        for monomial, terms in groups.items():
            if others.get(monomial) != terms:
                into[monomial] = Part(monomial, _waves(terms, width))
    return found


def _groups(expr: Expr) -> dict[Monomial, dict[tuple[int, ...], Fraction]]:
    """The terms by monomial, and by the powers of sines and cosines."""
    ring = expr.ring
    turning = _turning(ring)
    places = [i for pair in ring.pairs for i in (pair.sine, pair.cosine)]
    groups: dict[Monomial, dict[tuple[int, ...], Fraction]] = {}
    for exponents, value in expr.poly.to_dict().items():
        monomial = tuple((i, int(e)) for i, e in enumerate(exponents) if e and i not in turning)
        trig = tuple(int(exponents[i]) for i in places)
        groups.setdefault(monomial, {})[trig] = fraction(value)
    return groups


def _turning(ring: Ring) -> frozenset[int]:
    return frozenset(i for pair in ring.pairs for i in (pair.sine, pair.cosine))


def monomials(expr: Expr) -> list[Monomial]:
    """The monomials in the symbols that occur, each once."""
    turning = _turning(expr.ring)
    found: dict[Monomial, None] = {}
    for exponents in expr.poly.monoms() if expr.poly else ():
        found.setdefault(tuple((i, int(e)) for i, e in enumerate(exponents) if e and i not in turning))
    return list(found)


_Laurent = dict[tuple[int, ...], tuple[int, int]]
"""Σ (a + bi) Π z_k^{n_k}, z_k = exp(iθ_k), at (n_1, n_2, ...)"""


def _waves(terms: Mapping[tuple[int, ...], Fraction], width: int) -> tuple[tuple[Wave, Fraction], ...]:
    """Products of powers of sines and cosines as sums of waves, by exponentials."""
    total: dict[tuple[int, ...], list[Fraction]] = {}
    for powers, value in terms.items():
        share = value / (1 << sum(powers))
        for vector, (re, im) in _exponentials(powers, width).items():
            sums = total.setdefault(vector, [Fraction(0), Fraction(0)])
            sums[0] += re * share
            sums[1] += im * share
    found: dict[Wave, Fraction] = {}
    for vector, (a, b) in total.items():
        lead = next((x for x in vector if x), 0)
        if lead < 0:
            continue
        factor = 2 if lead else 1
        if a:
            found["cos", vector] = factor * a
        if b:
            found["sin", vector] = -factor * b
    return tuple(sorted(found.items()))


@lru_cache(maxsize=4096)
def _exponentials(powers: tuple[int, ...], width: int) -> _Laurent:
    """2^Σpowers Π sin^a cos^b in exponentials; powers are those of sine and cosine in turn."""
    product: _Laurent = {(0,) * width: (1, 0)}
    for k in range(width):
        for _ in range(powers[2 * k]):
            product = _shift(product, k, sine=True)
        for _ in range(powers[2 * k + 1]):
            product = _shift(product, k, sine=False)
    return product


def _shift(product: _Laurent, k: int, *, sine: bool) -> _Laurent:
    """times (z + 1/z), or (z - 1/z)/i"""
    result: _Laurent = {}
    for vector, (re, im) in product.items():
        for step in (1, -1):
            to = (*vector[:k], vector[k] + step, *vector[k + 1 :])
            x, y = (im * step, -re * step) if sine else (re, im)
            a, b = result.get(to, (0, 0))
            result[to] = (a + x, b + y)
    return {v: c for v, c in result.items() if c[0] or c[1]}


def angle_of(ring: Ring, wave: Wave) -> Angle:
    """The angle of a wave."""
    total = Angle.zero()
    for pair, times in zip(ring.pairs, wave[1], strict=True):
        total = total + pair.angle * times
    return total


def wave_expr(ring: Ring, wave: Wave, factor: Fraction = Fraction(1)) -> Expr:
    """factor·sin or factor·cos of a wave's angle."""
    angle = angle_of(ring, wave)
    return (ring.sin(angle) if wave[0] == "sin" else ring.cos(angle)) * factor


def monomial_expr(ring: Ring, monomial: Iterable[tuple[int, int]], factor: Fraction = Fraction(1)) -> Expr:
    """factor·Π generator^exponent"""
    exponents = [0] * len(ring.generators)
    for index, power in monomial:
        exponents[index] = power
    poly: Any = ring.ctx.from_dict({tuple(exponents): rational(factor)})
    return Expr(ring, poly)


def part_expr(ring: Ring, part: Part) -> Expr:
    """A part as an expression."""
    total = ring.zero
    for wave, factor in part.waves:
        total = total + wave_expr(ring, wave, factor)
    return total * monomial_expr(ring, part.monomial)
