"""Slips in single terms, from the exact difference of an answer and what was expected.

What is equal is taken away, part by part (a monomial in the symbols times sines and
cosines); what is left of the answer is matched with what is left of the expected
value by the slip that leads from one to the other, the lightest first.  A part
without a partner is a missing term, or one too many.
"""

from __future__ import annotations

from fractions import Fraction

from dynsolve.algebra.expr import Expr
from dynsolve.algebra.rationals import fraction
from dynsolve.algebra.ring import Ring
from dynsolve.answers.diagnosis.fourier import (
    Part,
    differing,
    is_small,
    parts,
)
from dynsolve.answers.diagnosis.function_slips import FunctionSlips
from dynsolve.answers.diagnosis.slips import slip
from dynsolve.answers.diagnosis.symbol_slips import SymbolSlips
from dynsolve.answers.diagnosis.term_slips import PartWriter, TermSlip
from dynsolve.answers.diagnosis.term_writer import TermWriter
from dynsolve.answers.verdict import Diagnosis
from dynsolve.robot.dimensions import Dimensions


class TermDiagnoser:
    """Finds slips in terms; `words` writes them."""

    def __init__(self, ring: Ring, dimensions: Dimensions, words: TermWriter) -> None:
        self.words = words
        self.writer = PartWriter(ring, words)
        self.in_functions = FunctionSlips(self.writer)
        self.in_symbols = SymbolSlips(self.writer, dimensions)

    def whole(self, mine: Expr, expected: Expr) -> Diagnosis | None:
        """One number between the whole answer and what was expected: a sign, a factor."""
        if mine.is_zero or expected.is_zero or len(mine) != len(expected):
            return None
        ratio = Fraction(
            fraction(mine.poly.leading_coefficient()) / fraction(expected.poly.leading_coefficient())
        )
        if mine != expected * ratio:
            return None
        if ratio == -1:
            return slip("sign_all") if len(parts(mine)) > 1 else slip("sign", term=self.words.of(expected))
        return slip("factor_all", part=self.words.number(ratio))

    def __call__(self, mine: Expr, expected: Expr) -> list[TermSlip] | None:
        """The slips that lead from what was expected to the answer; None where there are too many terms."""
        if not (is_small(mine) and is_small(expected)):
            return None
        ours, theirs = differing(mine, expected)
        found: list[TermSlip] = []
        for monomial in [m for m in ours if m in theirs]:
            found += self.in_functions(ours.pop(monomial), theirs.pop(monomial))
        return found + self._matched(list(ours.values()), list(theirs.values()))

    def _matched(self, mine: list[Part], expected: list[Part]) -> list[TermSlip]:
        """Pairs of parts with the slip between them, the lightest first; what is left is missing or extra."""
        if len(mine) * len(expected) > 2_500:
            return [*map(self.writer.missing_term, expected), *map(self.writer.extra_term, mine)]
        pairs = sorted(
            (
                (found.weight, i, j, found)
                for i, m in enumerate(mine)
                for j, e in enumerate(expected)
                if (found := self.in_symbols(m, e)) is not None
            ),
            key=lambda pair: pair[:3],
        )
        used_mine: set[int] = set()
        used_theirs: set[int] = set()
        result: list[TermSlip] = []
        for _, i, j, found in pairs:
            if i not in used_mine and j not in used_theirs:
                used_mine.add(i)
                used_theirs.add(j)
                result.append(found)
        result += [self.writer.missing_term(e) for j, e in enumerate(expected) if j not in used_theirs]
        result += [self.writer.extra_term(m) for i, m in enumerate(mine) if i not in used_mine]
        return result
