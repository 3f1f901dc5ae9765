"""What mends an answer: every slip that is told carries its mend, and is told only where that mends it.

    Exchange   in one place one factor stands where another belongs
    Renaming   in some terms a symbol, or an angle, stands for another throughout
    Redoing    a step was done otherwise; done right, it gives what is expected

`mends` is the one place where this is decided, exactly: with all mends put into the student's own
value, what comes out is what is expected.

An expression as terms that a person would name: monomials in the symbols, each with its factor.

The factor of a part is a polynomial in sines and cosines.  Two parts that have one monomial
in common are told apart by this factor alone.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from fractions import Fraction
from math import prod
from typing import Any, Protocol

from msgspec import Struct

from dynsolve.algebra.ring import Expr, Ring

# An expression as terms that a person would name

Monomial = tuple[tuple[int, int], ...]
"""(generator, exponent) of the generators that are no sines and cosines."""

MOST_TERMS = 600
"""The most terms of an expression that is taken apart."""

MOST_TRIG_TERMS = 8_000
"""The most sines and cosines that it may have, multiplied out."""

HIGHEST = 10
"""The highest degree in sines and cosines."""


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


def parts(expr: Expr) -> dict[Monomial, Expr]:
    """The parts of an expression, by monomial."""
    groups: dict[Monomial, dict[tuple[int, ...], object]] = {}
    if not expr.poly:
        return {}
    turning = {i for pair in expr.ring.pairs for i in (pair.sine, pair.cosine)}
    for exponents, value in expr.poly.to_dict().items():
        monomial = tuple((i, int(e)) for i, e in enumerate(exponents) if e and i not in turning)
        groups.setdefault(monomial, {})[exponents] = value
    return {m: Expr(expr.ring, expr.ring.ctx.from_dict(terms)) for m, terms in groups.items()}


def in_common(a: Expr, b: Expr) -> int:
    """How many terms two values share."""
    if not a.poly or not b.poly:
        return 0
    return len(a.poly.to_dict().items() & b.poly.to_dict().items())


def likeness(a: Expr, b: Expr) -> Fraction:
    """The share of the terms of two values that they have in common."""
    same = in_common(a, b)
    return Fraction(same, max(len(a) + len(b) - same, 1))


def monomial_expr(ring: Ring, monomial: Monomial) -> Expr:
    """Π generator^exponent"""
    total = ring.one
    for index, power in monomial:
        total = total * ring.generator(index) ** power
    return total


def stands_in(term: Expr, whole: Expr) -> bool:
    """Whether an expression holds all of a term: to take it away leaves every coefficient with its sign."""
    if not term.poly:
        return True
    held = whole.poly.to_dict() if whole.poly else {}
    return all(
        exponents in held and 0 < value / held[exponents] <= 1
        for exponents, value in term.poly.to_dict().items()
    )


class Mend(Protocol):
    """How a slip is undone."""

    def fits(self, mine: Expr) -> bool:
        """Whether what is to be mended stands in the answer."""

    def applied(self, mine: Expr) -> Expr:
        """The answer without the slip."""


class Exchange(Struct, frozen=True):
    """rest · `written` stands where rest · `wanted` belongs.

    A term that is missing has 0 written, one too many 0 wanted; a factor that was left out has 1
    written.
    """

    rest: Expr
    written: Expr
    wanted: Expr

    @property
    def have(self) -> Expr:
        """The term as it was written."""
        return self.rest * self.written

    @property
    def want(self) -> Expr:
        """The term as it should be."""
        return self.rest * self.wanted

    def fits(self, mine: Expr) -> bool:
        """Whether the term that was written stands in the answer."""
        return stands_in(self.have, mine)

    def applied(self, mine: Expr) -> Expr:
        """The answer with the right factor in this place."""
        return mine - self.have + self.want


class Renaming(Struct, frozen=True):
    """In `have`, some terms of the answer, what stands for some generators is put right."""

    have: Expr
    images: Mapping[int, Any]

    def fits(self, mine: Expr) -> bool:
        """Whether these terms stand in the answer."""
        return stands_in(self.have, mine)

    def applied(self, mine: Expr) -> Expr:
        """The answer with the right generators in these terms."""
        return mine - self.have + self.have.ring.put(self.have, self.images)


class Redoing(Struct, frozen=True):
    """The step gives `wrong` with the slip and `right` without it."""

    wrong: Expr
    right: Expr

    def fits(self, mine: Expr) -> bool:
        """Whether the slip gives just what was written; 0 shows no step at all."""
        return mine == self.wrong and not mine.is_zero

    def applied(self, mine: Expr) -> Expr:
        """What the right step gives, which may be a fraction."""
        return self.right if mine == self.wrong else mine - self.wrong + self.right


def mends(all_of: Iterable[Mend], mine: Expr, expected: Expr) -> bool:
    """Whether mends, put into an answer, give exactly what is expected."""
    mended = mine
    for one in all_of:
        if not one.fits(mine):
            return False
        mended = one.applied(mended)
    return mended == expected
