"""One factor where another belongs: what this slip is called, how far-fetched it is, and its words.

The words are made of the mend alone, so that a message says what is put right, and only
where it is told, since most pairs of terms that are compared are never told.

A slip in one place of an answer: what was exchanged for what, so that all of it is explained.

An answer that is off by rest · (wanted - written) has one factor where another belongs.  Every
pair of factors that people mistake for one another is tried (`factors`), and numbers: a sign, a
2 for a 1, a term that is missing or one too many.  Of those that stand in the answer the one
with the lightest name (`exchanges`) is taken, then the one in the fewest terms.

What is equal is taken away, part by part (a monomial in the symbols times sines and cosines).
Of a part that both have, the slip is in its sines and cosines or in its number; what is left of
the answer is matched with what is left of the expected value by the slip that leads from one to
the other, the lightest first.  A part without a partner is a missing term, or one too many.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from fractions import Fraction
from itertools import groupby

from msgspec import Struct

from dynsolve.algebra.generators import Generator
from dynsolve.algebra.rationals import fraction
from dynsolve.algebra.ring import Expr, Ring
from dynsolve.algebra.ring_values import value_of
from dynsolve.answers.diagnosis.factors import FactorPairs, Found
from dynsolve.answers.diagnosis.mends import (
    Exchange,
    Monomial,
    is_small,
    monomial_expr,
    parts,
    stands_in,
)
from dynsolve.answers.diagnosis.slips import slip
from dynsolve.answers.diagnosis.wrong_entry import TermWriter
from dynsolve.answers.verdict import Diagnosis
from dynsolve.notation.tree import Negative, Node, Number, Product, Sum, walk
from dynsolve.robot.dimensions import Dimensions
from dynsolve.robot.units import INERTIA, MASS

HEAVY = 4
"""The weight of a term that is missing, or one too many: anything lighter is likelier."""


class TermSlip(Struct, frozen=True):
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
        is_number = mend.rest.is_number or max(abs(ratio.numerator), ratio.denominator) > COARSE
        code = "number" if is_number else "factor"
        return TermSlip(1 if abs(ratio) in (2, Fraction(1, 2)) else 2, code, mend)

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
        g = self.ring.generators[mend.written.used[0]]
        more = self.ring.generator(g.index) ** _degree(mend.rest, g)
        return Exchange(Expr(self.ring, mend.rest.poly / more.poly), mend.written * more, mend.wanted * more)

    def _name(self, mend: Exchange) -> tuple[int, str]:
        one = self.ring.one
        if mend.written == one:
            return self._left_out(mend)
        if mend.wanted == one:
            return self._too_many(mend)
        written, wanted = ([self.ring.generators[i] for i in e.used] for e in (mend.written, mend.wanted))
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
        g = self.ring.generators[mend.wanted.used[0]]
        if len(mend.wanted.used) > 1 or g.kind != "symbol":
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
        strange = self._strange(mend.written)
        if strange is not None:
            return 2, "odd_argument" if strange.kind == "function" else "unknown_symbol"
        g = self.ring.generators[mend.written.used[0]]
        if len(mend.written.used) > 1 or g.kind != "symbol":
            return 3, "extra_factor"
        single = mend.written == self.ring.generator(g.index)
        return 2, "extra_square" if single and _degree(mend.rest, g) > 0 else "extra_factor"

    def _strange(self, expr: Expr) -> Generator | None:
        """The first symbol, or function, that the problem does not have."""
        found = (self.ring.generators[i] for i in expr.used)
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
        term = mend.have if one.code in ("sign", "extra_term") else mend.want
        if one.code == "number":
            return slip("number", yours=words.in_decimals(mend.have), other=words.in_decimals(mend.want))
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


# A slip in one place of an answer

MOST_TERMS = 60
"""An answer that is off by more terms than this has no slip in one place."""


LIGHTEST = 1
"""The weight of the nearest slips, of which none is one sine or cosine for another."""


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
        before = [*self._numbers(mine, expected, off), *self._exchanged(self.factors.of_symbols(off))]
        behind = [*self._exchanged(self.factors.of_strange_functions(off))]
        found = self._lightest([*before, *behind], mine, expected)
        if found is not None and found.weight == LIGHTEST:
            return found
        functions = self._exchanged(self.factors.of_functions(off))
        return self._lightest([*before, *functions, *behind], mine, expected)

    def _lightest(self, slips: Sequence[TermSlip], mine: Expr, expected: Expr) -> TermSlip | None:
        stands = [
            one for one in slips if stands_in(one.mend.have, mine) and stands_in(one.mend.want, expected)
        ]
        stands.sort(key=lambda one: (one.weight, len(one.mend.rest)))
        return next(filter(self._is_seen, stands), None)

    def _exchanged(self, pairs: Iterable[Found]) -> Iterator[TermSlip]:
        for (a, b), code, rest in pairs:
            yield self.exchanges.named(Exchange(rest, b, a), code)
            yield self.exchanges.named(Exchange(-rest, a, b), code)

    def _numbers(self, mine: Expr, expected: Expr, off: Expr) -> Iterator[TermSlip]:
        """A number before one term: 0 of a missing one, 1 of one too many, a sign, a factor."""
        have, want = _at_terms_of(off, mine), _at_terms_of(off, expected)
        ratio = ratio_of(want, have)
        is_number = ratio is not None or have.is_zero or want.is_zero
        if not is_number or isinstance(self.words.form(off), Sum):
            return
        if ratio is not None:
            yield self.exchanges.number(have, ratio)
        else:
            yield self.exchanges.missing(want) if have.is_zero else self.exchanges.needless(have)

    def _is_seen(self, one: TermSlip) -> bool:
        """Whether the one function stands in the term and the other in what it should be.

        The ring may hold cos θ₂ in sines and cosines of θ₁ and θ₁ + θ₂; that these become
        something else is no slip that anybody makes.
        """
        mend, form = one.mend, self.words.form
        if not any(self.ring.generators[i].kind in ("sin", "cos") for i in (mend.written - mend.wanted).used):
            return True
        return _holds(form(mend.have), form(mend.written)) and _holds(form(mend.want), form(mend.wanted))


NEAR, COARSE = Fraction(1, 50), 20
"""A ratio as near to 1, with larger numbers than a factor has, is that of a rounded number."""


def multiplied(words: TermWriter, called: str, ratio: Fraction) -> Diagnosis:
    """What is said of an answer that is `ratio` times what it should be, which is not -1."""
    if abs(ratio - 1) <= NEAR and max(ratio.numerator, ratio.denominator) > COARSE:
        return slip("rounded_all", yours=called, part=f"{float(abs(ratio - 1)) * 100:.2g}")
    return slip("factor_all", yours=called, part=words.number(ratio))


def ratio_of(a: Expr, b: Expr) -> Fraction | None:
    """r where a = r b, None where there is no such number."""
    if a.is_zero or b.is_zero or len(a) != len(b):
        return None
    ratio = Fraction(fraction(a.poly.leading_coefficient()) / fraction(b.poly.leading_coefficient()))
    return ratio if a == b * ratio else None


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


# Slips in several terms, from the exact difference of an answer and what was expected

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
        found = [slip for m in same for slip in self._in_part(m, ours.pop(m), theirs.pop(m))]
        return _joined([*found, *self._matched(list(ours.items()), list(theirs.items()))])

    def _in_part(self, monomial: Monomial, mine: Expr, expected: Expr) -> Iterator[TermSlip]:
        """The slip in a part that both have; without symbols, as in a model in numbers, in its terms."""
        if mine == expected:
            return
        found = self.one_place(mine, expected)
        if found is not None or monomial:
            yield found or TermSlip(5, "trig_part", Exchange(self.ring.one, mine, expected))
        else:
            yield from self._in_numbers(self._by_function(mine), self._by_function(expected))

    def _in_numbers(self, ours: dict[str, Expr], theirs: dict[str, Expr]) -> Iterator[TermSlip]:
        """The number before a function that both have; else one function for another."""
        for function in ours.keys() & theirs.keys():
            have, want = ours.pop(function), theirs.pop(function)
            ratio = ratio_of(want, have)
            if ratio is not None and ratio != 1:
                yield self.exchanges.number(have, ratio)
        for function, have in tuple(ours.items()):
            pairs = ((self.one_place(have, want), other) for other, want in theirs.items())
            near = [(one, other) for one, other in pairs if one is not None and one.weight < HEAVY]
            if near:
                one, other = min(near, key=lambda pair: pair[0].weight)
                del ours[function], theirs[other]
                yield one
        yield from map(self.exchanges.missing, theirs.values())
        yield from map(self.exchanges.needless, ours.values())

    def _by_function(self, expr: Expr) -> dict[str, Expr]:
        """The terms as they are written, by what each is but for its number."""
        values = [value_of(self.ring, node) for node in _summands(self.exchanges.words.form(expr))]
        return {str((one * (1 / fraction(one.poly.leading_coefficient()))).poly): one for one in values}

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


def _summands(node: Node) -> Iterator[Node]:
    """The terms of a sum; of a number times a sum each with that number."""
    match node:
        case Sum(terms):
            yield from terms
        case Product((Number() as number, Sum(terms))):
            yield from (Product((number, term)) for term in terms)
        case _:
            yield node


LIKELY = {"symbol", "dropped_dot", "extra_dot", "odd_argument", "unknown_symbol"}


def _without_common(have: Monomial, want: Monomial) -> tuple[Monomial, Monomial]:
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
        if len(alike) == 1 or code in ("missing_term", "extra_term", "trig_part", "factor", "number", "sign"):
            result += alike
            continue
        rest = sum((one.mend.rest for one in alike[1:]), alike[0].mend.rest)
        mend = Exchange(rest, alike[0].mend.written, alike[0].mend.wanted)
        result.append(TermSlip(alike[0].weight, code, mend))
    return result
