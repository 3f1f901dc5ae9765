"""An expression as terms that a person would name: monomials in the symbols times Fourier forms.

A term of a Fourier form is a sine or cosine of an integer combination of the ring's basic
angles (`algebra.fourier`); c₁² - s₁² is one of them, cos 2θ₁, however it was written.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from fractions import Fraction
from math import prod
from typing import Any

from dynsolve.algebra.angles import Angle
from dynsolve.algebra.expr import Expr
from dynsolve.algebra.fourier import TrigFunction, fourier_form, terms_of
from dynsolve.algebra.rationals import fraction, rational
from dynsolve.algebra.ring import Ring

Monomial = tuple[tuple[int, int], ...]
"""(generator, exponent) of the generators that are no sines and cosines."""

ONE: Monomial = ()

MOST_TERMS = 600
"""The most terms of an expression that is taken apart."""

MOST_TRIG_TERMS = 8_000
"""The most sines and cosines that its Fourier forms may have."""

HIGHEST = 10
"""The highest degree in sines and cosines."""


@dataclass(frozen=True, slots=True)
class Part:
    """monomial · Fourier form: `fourier` are the sines and cosines, each with its factor."""

    monomial: Monomial
    fourier: tuple[tuple[TrigFunction, Fraction], ...]

    @property
    def single(self) -> tuple[TrigFunction, Fraction] | None:
        """The one sine or cosine, where it is one."""
        return self.fourier[0] if len(self.fourier) == 1 else None


def is_small(expr: Expr) -> bool:
    """Whether an expression is small enough to be taken apart; answers written by hand are."""
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
    return total <= MOST_TRIG_TERMS


def parts(expr: Expr) -> dict[Monomial, Part]:
    """The parts of an expression, by monomial."""
    return {m: Part(m, _fourier_terms(terms)) for m, terms in _groups(expr).items()}


def differing(a: Expr, b: Expr) -> tuple[dict[Monomial, Part], dict[Monomial, Part]]:
    """The parts in which two expressions differ; what is equal, which is most, is not taken apart."""
    ours, theirs = _groups(a), _groups(b)
    found: tuple[dict[Monomial, Part], dict[Monomial, Part]] = {}, {}
    for into, groups, others in zip(found, (ours, theirs), (theirs, ours), strict=True):
        for monomial, terms in groups.items():
            if others.get(monomial) != terms:
                into[monomial] = Part(monomial, _fourier_terms(terms))
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


def _fourier_terms(terms: Mapping[tuple[int, ...], Fraction]) -> tuple[tuple[TrigFunction, Fraction], ...]:
    """The terms of a Fourier form, sorted; here the first multiple that is not 0 is positive."""
    found = []
    for (name, n), factor in terms_of(fourier_form(terms)):
        if next((x for x in n if x), 0) < 0:
            n, factor = tuple(-x for x in n), (-factor if name == "sin" else factor)
        found.append(((name, n), factor))
    return tuple(sorted(found))


def angle_of(ring: Ring, function: TrigFunction) -> Angle:
    """The angle of a sine or cosine."""
    total = Angle.zero()
    for pair, times in zip(ring.pairs, function[1], strict=True):
        total = total + pair.angle * times
    return total


def trig_expr(ring: Ring, function: TrigFunction, factor: Fraction = Fraction(1)) -> Expr:
    """factor·sin or factor·cos"""
    angle = angle_of(ring, function)
    return (ring.sin(angle) if function[0] == "sin" else ring.cos(angle)) * factor


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
    for function, factor in part.fourier:
        total = total + trig_expr(ring, function, factor)
    return total * monomial_expr(ring, part.monomial)
