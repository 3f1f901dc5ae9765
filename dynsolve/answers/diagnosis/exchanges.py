"""One factor where another belongs: what this slip is called, how far-fetched it is, and its words.

The words are made of the mend alone, so that a message says what is put right, and only
where it is told, since most pairs of terms that are compared are never told.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction

from dynsolve.algebra.expr import Expr
from dynsolve.algebra.generators import Generator
from dynsolve.algebra.rationals import fraction
from dynsolve.algebra.ring import Ring
from dynsolve.answers.diagnosis.mends import Exchange
from dynsolve.answers.diagnosis.parts import monomial_expr, parts, used
from dynsolve.answers.diagnosis.slips import slip
from dynsolve.answers.diagnosis.term_writer import TermWriter
from dynsolve.answers.verdict import Diagnosis
from dynsolve.robot.dimensions import Dimensions
from dynsolve.robot.units import INERTIA, MASS

HEAVY = 4
"""The weight of a term that is missing, or one too many: anything lighter is likelier."""


@dataclass(frozen=True, slots=True)
class TermSlip:
    """A slip in one place: `weight` tells how unlikely it is."""

    weight: int
    code: str
    mend: Exchange


class Exchanges:
    """Names exchanges of factors, and tells them."""

    def __init__(self, ring: Ring, dimensions: Dimensions, words: TermWriter) -> None:
        self.ring = ring
        self.dimensions = dimensions
        self.words = words

    # -- naming ------------------------------------------------------------------------------------

    def missing(self, term: Expr) -> TermSlip:
        """A term that is expected and was not written."""
        return TermSlip(HEAVY, "missing_term", Exchange(term, self.ring.zero, self.ring.one))

    def needless(self, term: Expr) -> TermSlip:
        """A term that was written and is not expected."""
        mend = Exchange(term, self.ring.one, self.ring.zero)
        strange = self._strange(term)
        if strange is not None:
            is_function = strange.kind == "function"
            return TermSlip(
                3 if is_function else HEAVY, "odd_argument" if is_function else "unknown_symbol", mend
            )
        return TermSlip(HEAVY, "extra_term", mend)

    def number(self, have: Expr, ratio: Fraction) -> TermSlip:
        """A term that should be `ratio` times what it is."""
        constant = self.ring.constant
        if ratio == -1:
            return TermSlip(1, "sign", Exchange(-have, constant(-1), constant(1)))
        written = self.words.coefficient(have)
        if written < 0 and ratio > 0:
            written = -written
        mend = Exchange(have * (1 / written), constant(written), constant(written * ratio))
        return TermSlip(1 if abs(ratio) in (2, Fraction(1, 2)) else 2, "factor", mend)

    def named(self, mend: Exchange, code: str = "") -> TermSlip:
        """An exchange of symbols or of functions under its name; `code` is that of two functions."""
        is_left_out = mend.written == self.ring.one
        if code and not (code == "double_angle" and is_left_out):
            return TermSlip(2, code, mend)
        weight, code = self._name(mend)
        return TermSlip(
            weight, code, self._with_power(mend) if code in ("dropped_dot", "extra_dot") else mend
        )

    def _with_power(self, mend: Exchange) -> Exchange:
        """L̇₂² where L₂ L̇₂ belongs, in place of L̇₂ where L₂ does: all that stands there of one symbol."""
        g = self.ring.generators[next(used(mend.written))]
        more = self.ring.generator(g.index) ** _degree(mend.rest, g)
        return Exchange(Expr(self.ring, mend.rest.poly / more.poly), mend.written * more, mend.wanted * more)

    def _name(self, mend: Exchange) -> tuple[int, str]:
        one = self.ring.one
        if mend.written == one:
            return self._left_out(mend)
        if mend.wanted == one:
            return self._too_many(mend)
        written, wanted = ([self.ring.generators[i] for i in used(e)] for e in (mend.written, mend.wanted))
        strange = self._strange(mend.written)
        if strange is not None:
            return 2, "odd_argument" if strange.kind == "function" else "unknown_symbol"
        if len(written) == len(wanted) == 1 and written[0].name == wanted[0].name != "":
            return 1, "dropped_dot" if written[0].dots < wanted[0].dots else "extra_dot"
        if any(g.kind == "symbol" for g in (*written, *wanted)):
            alike = self.dimensions.of(mend.written) == self.dimensions.of(mend.wanted)
            return (2 if alike else HEAVY), "symbol"
        return 2, "symbol"

    def _left_out(self, mend: Exchange) -> tuple[int, str]:
        """The name of a factor that was left out."""
        found = list(used(mend.wanted))
        g = self.ring.generators[found[0]]
        if len(found) > 1 or g.kind != "symbol":
            return 3, "dropped_factor"
        if mend.wanted == self.ring.generator(g.index) and _degree(mend.rest, g) == 1:
            return 1, "dropped_square"
        if g.dots:
            return 1, "dropped_velocity" if g.dots == 1 else "dropped_factor"
        role = self.dimensions.of_generator(g)
        return (
            1,
            "dropped_mass" if role == MASS else "dropped_inertia" if role == INERTIA else "dropped_factor",
        )

    def _too_many(self, mend: Exchange) -> tuple[int, str]:
        """The name of a factor that is too many."""
        strange = self._strange(mend.written)
        if strange is not None:
            return 2, "odd_argument" if strange.kind == "function" else "unknown_symbol"
        found = list(used(mend.written))
        g = self.ring.generators[found[0]]
        if len(found) > 1 or g.kind != "symbol":
            return 3, "extra_factor"
        single = mend.written == self.ring.generator(g.index)
        return 2, "extra_square" if single and _degree(mend.rest, g) > 0 else "extra_factor"

    def _strange(self, expr: Expr) -> Generator | None:
        """The first symbol, or function, that the problem does not have."""
        found = (self.ring.generators[i] for i in used(expr))
        unknown = [g for g in found if self.words.is_unknown(g)]
        return min(unknown, key=lambda g: g.kind != "function", default=None)

    # -- telling -----------------------------------------------------------------------------------

    def told(self, one: TermSlip) -> Diagnosis:
        """A slip as a message."""
        mend, words = one.mend, self.words
        if one.code == "factor":
            return self._factor_told(mend)
        if one.code == "trig_part":
            return self._trig_part_told(mend)
        if one.code == "unknown_symbol":
            strange = self._strange(mend.have)
            assert strange is not None
            return slip("unknown_symbol", part=words.generator(strange))
        term = mend.have if one.code == "extra_term" else mend.want
        left_out = mend.written == self.ring.one
        return slip(
            one.code,
            yours=words.of(mend.have),
            term=words.of(term),
            part=words.of(mend.wanted if left_out else mend.written),
            other=words.of(mend.wanted),
        )

    def _factor_told(self, mend: Exchange) -> Diagnosis:
        yours, other = (
            self.words.number(fraction(e.poly.leading_coefficient())) for e in (mend.written, mend.wanted)
        )
        return slip("factor", term=self.words.of(mend.rest), yours=yours, other=other)

    def _trig_part_told(self, mend: Exchange) -> Diagnosis:
        """The factor in sines and cosines of a term that is right but for it."""
        monomial = monomial_expr(self.ring, next(iter(parts(mend.written))))
        factor = Expr(self.ring, mend.written.poly / monomial.poly)
        return slip("trig_part", term=self.words.of(monomial), yours=self.words.of(factor))


def _degree(expr: Expr, g: Generator) -> int:
    """The power of a symbol that all terms of an expression have; 0 where they differ."""
    powers = {int(exponents[g.index]) for exponents in expr.poly.monoms()} if expr.poly else set()
    return powers.pop() if len(powers) == 1 else 0
