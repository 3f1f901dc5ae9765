"""Slips in the sines, cosines and numbers of one term, whose other symbols are right.

A part is compared with the part of the expected value that has the same monomial.
"""

from __future__ import annotations

from fractions import Fraction
from math import prod

from dynsolve.algebra.fourier import TrigFunction
from dynsolve.answers.diagnosis.fourier import (
    Part,
    angle_of,
    part_expr,
)
from dynsolve.answers.diagnosis.substitution import put_polynomials
from dynsolve.answers.diagnosis.term_slips import PartWriter, TermSlip, found_slip, ratio_of
from dynsolve.notation.tree import Negative, Node, Number, Product, Quotient


class FunctionSlips:
    """Finds what is wrong in the sines and cosines of a part, or in the number before them."""

    def __init__(self, writer: PartWriter) -> None:
        self.ring = writer.ring
        self.words = writer.words
        self.writer = writer

    def __call__(self, mine: Part, expected: Part) -> list[TermSlip]:
        """The slips that lead from the expected part to the one that was written."""
        ratio = ratio_of(mine, expected)
        if ratio is not None:
            number = self._number_of(expected)
            return [self._factor(expected, ratio, ratio * number, number)]
        single = self._trig_function(mine, expected) or self._exchanged(mine, expected)
        if single is not None:
            return [single]
        return self._term_by_term(mine, expected)

    def _factor(self, expected: Part, ratio: Fraction, yours: Fraction, other: Fraction) -> TermSlip:
        if ratio == -1:
            return found_slip(1, "sign", term=self.writer.part(expected))
        weight = 1 if abs(ratio) in (2, Fraction(1, 2)) else 2
        bare = Part(expected.monomial, tuple((w, c / other) for w, c in expected.fourier))
        mine, theirs = self.words.number(yours), self.words.number(other)
        return found_slip(weight, "factor", term=self.writer.part(bare), yours=mine, other=theirs)

    def _number_of(self, part: Part) -> Fraction:
        """The number before a part as a person writes it."""
        if part.single is not None:
            return part.single[1]
        return _coefficient(self.words.form(part_expr(self.ring, part))) or part.fourier[0][1]

    def _exchanged(self, mine: Part, expected: Part) -> TermSlip | None:
        """Sine for cosine, or cosine for sine, in one factor of a product: s₁ s₂ for s₁ c₂."""
        here, there = part_expr(self.ring, mine), part_expr(self.ring, expected)
        degrees = there.poly.degrees()
        for pair in self.ring.pairs:
            if (degrees[pair.sine] > 0) == (degrees[pair.cosine] > 0):
                continue
            s, c = self.ring.generator(pair.sine), self.ring.generator(pair.cosine)
            if put_polynomials(there, {pair.sine: c.poly, pair.cosine: s.poly}) == here:
                written, wanted = (c, s) if degrees[pair.sine] > 0 else (s, c)
                part, other = self.words.of(written), self.words.of(wanted)
                yours = self.writer.part(mine)
                return found_slip(2, "sin_for_cos", yours=yours, part=part, other=other)
        return None

    def _trig_function(self, mine: Part, expected: Part) -> TermSlip | None:
        """A slip in the one sine or cosine of a part: the wrong function, the wrong angle."""
        m, e = mine.single, expected.single
        if m is None or e is None or abs(m[1]) != abs(e[1]):
            return None
        (function, _), (wanted, _) = m, e
        yours = self.writer.part(mine)
        mine_says, theirs = self.writer.function(function), self.writer.function(wanted)
        if wanted == ("cos", (0,) * len(wanted[1])):
            if function[0] == "cos" and all(x % 2 == 0 for x in function[1]):
                return found_slip(2, "double_angle", yours=yours, part=mine_says)
            return found_slip(3, "extra_factor", yours=yours, part=mine_says)
        if not any(function[1]):
            return found_slip(3, "dropped_factor", yours=yours, part=theirs)
        if function[1] == wanted[1]:
            return found_slip(2, "sin_for_cos", yours=yours, part=mine_says, other=self.writer.instead(m, e))
        if function[0] == wanted[0]:
            code = "angle_product" if self._is_product(function) else "angle"
            return found_slip(
                2 + (m[1] != e[1]), code, yours=yours, part=mine_says, other=self.writer.instead(m, e)
            )
        return None

    def _is_product(self, function: TrigFunction) -> bool:
        return any(len(atom) > 1 for atom, _ in angle_of(self.ring, function).terms)

    def _term_by_term(self, mine: Part, expected: Part) -> list[TermSlip]:
        """Each sine or cosine by itself: one that is missing, one too many, one with another number."""
        ours, theirs = dict(mine.fourier), dict(expected.fourier)
        missing = {w: c for w, c in theirs.items() if w not in ours}
        extra = {w: c for w, c in ours.items() if w not in theirs}
        other = [w for w in ours if w in theirs and ours[w] != theirs[w]]
        found: list[TermSlip] = []
        for function in other:
            have, want = ours[function], theirs[function]
            found.append(self._factor(Part(expected.monomial, ((function, want),)), have / want, have, want))
        for function, value in list(extra.items()):
            for wanted, number in list(missing.items()):
                one = self._trig_function(
                    Part(mine.monomial, ((function, value),)), Part(mine.monomial, ((wanted, number),))
                )
                if one is not None:
                    found.append(one)
                    del extra[function], missing[wanted]
                    break
        for function, value in missing.items():
            found.append(self.writer.missing_term(Part(mine.monomial, ((function, value),))))
        for function, value in extra.items():
            found.append(self.writer.extra_term(Part(mine.monomial, ((function, value),))))
        if len(found) > 2:
            term = self.writer.monomial(mine.monomial)
            factor = self.writer.part(Part((), mine.fourier))
            return [found_slip(5, "trig_part", term=term, yours=factor)]
        return found


def _coefficient(node: Node) -> Fraction:
    """The number before a product."""
    match node:
        case Number(p, q):
            return Fraction(p, q)
        case Negative(argument):
            return -_coefficient(argument)
        case Product(factors):
            return prod((_coefficient(factor) for factor in factors), start=Fraction(1))
        case Quotient(numerator, denominator):
            return _coefficient(numerator) / (_coefficient(denominator) or 1)
    return Fraction(1)
