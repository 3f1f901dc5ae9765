"""Slips in several terms, from the exact difference of an answer and what was expected.

What is equal is taken away, part by part (a monomial in the symbols times sines and cosines).
Of a part that both have, the slip is in its sines and cosines or in its number; what is left of
the answer is matched with what is left of the expected value by the slip that leads from one to
the other, the lightest first.  A part without a partner is a missing term, or one too many.
"""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction
from itertools import groupby

from dynsolve.algebra.expr import Expr
from dynsolve.answers.diagnosis.exchanges import Exchanges, TermSlip
from dynsolve.answers.diagnosis.factors import FactorPairs
from dynsolve.answers.diagnosis.mends import Exchange
from dynsolve.answers.diagnosis.one_place import OnePlace, ratio_of
from dynsolve.answers.diagnosis.parts import Monomial, is_small, monomial_expr, parts

MOST_PAIRS = 2_500
"""More pairs of terms are not compared with each other."""

MOST_SYMBOLS = 3
"""A term with more symbols left out, or too many, is another term."""

Part = tuple[Monomial, Expr]


class TermDiagnoser:
    """Finds slips in terms."""

    def __init__(self, exchanges: Exchanges, factors: FactorPairs) -> None:
        self.exchanges = exchanges
        self.ring = exchanges.ring
        self.one_place = OnePlace(exchanges, factors)

    def __call__(self, mine: Expr, expected: Expr) -> list[TermSlip]:
        """The slips that lead from what was expected to the answer; none where there are too many terms."""
        if not (is_small(mine) and is_small(expected)):
            return []
        ours, theirs = parts(mine), parts(expected)
        same = [m for m in ours if m in theirs]
        found = [slip for m in same for slip in self._in_part(ours.pop(m), theirs.pop(m))]
        return _joined([*found, *self._matched(list(ours.items()), list(theirs.items()))])

    def _in_part(self, mine: Expr, expected: Expr) -> Iterator[TermSlip]:
        """The slip in a part that both have."""
        if mine == expected:
            return
        found = self.one_place(mine, expected)
        yield found or TermSlip(5, "trig_part", Exchange(self.ring.one, mine, expected))

    def _matched(self, mine: list[Part], expected: list[Part]) -> list[TermSlip]:
        """Pairs of parts with the slip between them, the lightest first; what is left is missing or extra."""
        pairs = []
        if len(mine) * len(expected) <= MOST_PAIRS:
            pairs = sorted(
                (
                    (found.weight, i, j, found)
                    for i, m in enumerate(mine)
                    for j, e in enumerate(expected)
                    if (found := self._between(m, e)) is not None
                ),
                key=lambda pair: pair[:3],
            )
        ours, theirs = dict(enumerate(mine)), dict(enumerate(expected))
        result: list[TermSlip] = []
        for _, i, j, found in pairs:
            if i in ours and j in theirs:
                del ours[i], theirs[j]
                result.append(found)
        result += [self.exchanges.missing(expr) for _, expr in theirs.values()]
        return result + [self.exchanges.needless(expr) for _, expr in ours.values()]

    def _between(self, mine: Part, expected: Part) -> TermSlip | None:
        """The slip between two terms that differ in a few symbols, and perhaps in the sign, a 2 or a ½."""
        (have, written_term), (want, wanted_term) = mine, expected
        left, right = _without_common(have, want)
        if max(len(left), len(right)) > MOST_SYMBOLS or len(left) + len(right) > MOST_SYMBOLS + 1:
            return None
        written, wanted = monomial_expr(self.ring, left), monomial_expr(self.ring, right)
        ratio = ratio_of(wanted_term * written, written_term * wanted)
        if ratio is None or abs(ratio) not in (1, 2, Fraction(1, 2)):
            return None
        rest = Expr(self.ring, (written_term.poly / written.poly))
        found = self.exchanges.named(Exchange(rest, written, wanted * ratio))
        is_likely = left == () or right == () or found.code in LIKELY
        return TermSlip(found.weight + 2 * (ratio != 1), found.code, found.mend) if is_likely else None


LIKELY = {"symbol", "dropped_dot", "extra_dot", "odd_argument", "unknown_symbol"}


def _without_common(have: Monomial, want: Monomial) -> tuple[Monomial, Monomial]:
    """Two monomials without the factors that they have in common."""
    change = dict(want)
    for index, power in have:
        change[index] = change.get(index, 0) - power
    left = tuple((i, -p) for i, p in change.items() if p < 0)
    return left, tuple((i, p) for i, p in change.items() if p > 0)


def _joined(found: list[TermSlip]) -> list[TermSlip]:
    """One factor that stands for another in several terms is one slip."""

    def kind(one: TermSlip) -> tuple[str, str, str]:
        return one.code, str(one.mend.written.poly), str(one.mend.wanted.poly)

    result = []
    for (code, _, _), same in groupby(sorted(found, key=kind), key=kind):
        alike = list(same)
        if len(alike) == 1 or code in ("missing_term", "extra_term", "trig_part", "factor", "sign"):
            result += alike
            continue
        rest = sum((one.mend.rest for one in alike[1:]), alike[0].mend.rest)
        mend = Exchange(rest, alike[0].mend.written, alike[0].mend.wanted)
        result.append(TermSlip(alike[0].weight, code, mend))
    return result
