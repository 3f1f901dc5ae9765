"""A slip in one place of an answer: what was exchanged for what, so that all of it is explained.

An answer that is off by rest · (wanted - written) has one factor where another belongs.  Every
pair of factors that people mistake for one another is tried (`factors`), and numbers: a sign, a
2 for a 1, a term that is missing or one too many.  Of those that stand in the answer the one
with the lightest name (`exchanges`) is taken, then the one in the fewest terms.
"""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction
from itertools import chain

from dynsolve.algebra.expr import Expr
from dynsolve.algebra.rationals import fraction
from dynsolve.answers.diagnosis.exchanges import Exchanges, TermSlip
from dynsolve.answers.diagnosis.factors import FactorPairs
from dynsolve.answers.diagnosis.mends import Exchange
from dynsolve.answers.diagnosis.parts import stands_in, used
from dynsolve.notation.tree import Negative, Node, Number, Product, Sum
from dynsolve.notation.walk import walk

MOST_TERMS = 60
"""An answer that is off by more terms than this has no slip in one place."""


class OnePlace:
    """Finds the slip in one place of an answer that leads to it from what was expected."""

    def __init__(self, exchanges: Exchanges, factors: FactorPairs) -> None:
        self.exchanges = exchanges
        self.ring = exchanges.ring
        self.words = exchanges.words
        self.factors = factors

    def __call__(self, mine: Expr, expected: Expr) -> TermSlip | None:
        """The slip, None where there is none in one place."""
        off = expected - mine
        if off.is_zero or len(off) > MOST_TERMS:
            return None
        found = [one for one in self._all(mine, expected, off) if _stands(one.mend, mine, expected)]
        found.sort(key=lambda one: (one.weight, len(one.mend.rest)))
        return next(filter(self._is_seen, found), None)

    def _all(self, mine: Expr, expected: Expr, off: Expr) -> Iterator[TermSlip]:
        yield from self._numbers(mine, expected, off)
        of = self.factors
        for (a, b), code, rest in chain(
            of.of_symbols(off), of.of_functions(off), of.of_strange_functions(off)
        ):
            yield self.exchanges.named(Exchange(rest, b, a), code)
            yield self.exchanges.named(Exchange(-rest, a, b), code)

    def _numbers(self, mine: Expr, expected: Expr, off: Expr) -> Iterator[TermSlip]:
        """A number before one term: 0 of a missing one, 1 of one too many, a sign, a factor."""
        have, want = _at_terms_of(off, mine), _at_terms_of(off, expected)
        if not isinstance(self.words.form(off), Sum):
            if have.is_zero:
                yield self.exchanges.missing(want)
            elif want.is_zero:
                yield self.exchanges.needless(have)
            elif (ratio := ratio_of(want, have)) is not None:
                yield self.exchanges.number(have, ratio)

    def _is_seen(self, one: TermSlip) -> bool:
        """Whether the one function stands in the term and the other in what it should be.

        The ring may hold cos θ₂ in sines and cosines of θ₁ and θ₁ + θ₂; that these become
        something else is no slip that anybody makes.
        """
        mend, form = one.mend, self.words.form
        if not any(self.ring.generators[i].kind in ("sin", "cos") for i in used(mend.written - mend.wanted)):
            return True
        return _holds(form(mend.have), form(mend.written)) and _holds(form(mend.want), form(mend.wanted))


def ratio_of(a: Expr, b: Expr) -> Fraction | None:
    """r where a = r b, None where there is no such number."""
    if a.is_zero or b.is_zero or len(a) != len(b):
        return None
    ratio = Fraction(fraction(a.poly.leading_coefficient()) / fraction(b.poly.leading_coefficient()))
    return ratio if a == b * ratio else None


def _stands(mend: Exchange, mine: Expr, expected: Expr) -> bool:
    return stands_in(mend.have, mine) and stands_in(mend.want, expected)


def _at_terms_of(off: Expr, value: Expr) -> Expr:
    """The terms of a value that have the monomials of another."""
    places = off.poly.to_dict().keys()
    kept = {e: v for e, v in value.poly.to_dict().items() if e in places} if value.poly else {}
    return Expr(off.ring, off.ring.ctx.from_dict(kept))


def _holds(node: Node, part: Node) -> bool:
    """Whether a formula has another in it, with whatever sign; a number need not be seen."""
    bare = part.argument if isinstance(part, Negative) else part
    if isinstance(bare, Product):  # 2s₁ c₁ stands in 2m g s₁ c₁
        return all(_holds(node, factor) for factor in bare.factors)
    return isinstance(bare, Number) or bare in walk(node)
