"""Slips in single terms, from the exact difference of an answer and what was expected.

What is equal is taken away, part by part (a monomial in the symbols times sines and
cosines); what is left of the answer is matched with what is left of the expected
value by the slip that leads from one to the other, the lightest first.  A part
without a partner is a missing term, or one too many.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass, replace
from fractions import Fraction

from dynsolve.algebra.expr import Expr
from dynsolve.algebra.fourier import TrigFunction
from dynsolve.algebra.generators import Generator
from dynsolve.algebra.rationals import fraction
from dynsolve.algebra.ring import Ring
from dynsolve.answers.diagnosis.fourier import (
    Monomial,
    Part,
    angle_of,
    differing,
    is_small,
    monomial_expr,
    part_expr,
    parts,
    trig_expr,
)
from dynsolve.answers.diagnosis.slips import slip
from dynsolve.answers.diagnosis.term_writer import TermWriter
from dynsolve.answers.judging.ring_extension import is_opaque
from dynsolve.answers.verdict import Diagnosis
from dynsolve.robot.dimensions import Dimensions
from dynsolve.robot.units import INERTIA, MASS

LIGHT = 4
"""A slip up to this weight is one that a person makes in one place."""


Told = str | Callable[[], str]
"""A piece of a message, or how to make it."""


def _found(weight: int, code: str, **what: Told) -> TermSlip:
    return TermSlip(weight, code, what)


@dataclass(frozen=True, slots=True)
class TermSlip:
    """A slip between two parts: how far-fetched it is, and what is said."""

    weight: int
    code: str
    what: Mapping[str, Told]

    @property
    def diagnosis(self) -> Diagnosis:
        """The slip as it is told; its words are made here, since most pairs are never told."""
        return slip(self.code, **{key: self.word(key) for key in self.what})

    def word(self, key: str) -> str:
        """One piece of the message."""
        told = self.what[key]
        return told if isinstance(told, str) else told()


class TermDiagnoser:
    """Finds slips in terms; `words` writes them."""

    def __init__(self, ring: Ring, dimensions: Dimensions, words: TermWriter) -> None:
        self.ring = ring
        self.dimensions = dimensions
        self.words = words

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
            found += self._same_monomial(ours.pop(monomial), theirs.pop(monomial))
        return found + self._matched(list(ours.values()), list(theirs.values()))

    def _monomial(self, monomial: Iterable[tuple[int, int]]) -> Told:
        """A monomial in words, made when it is told."""
        return lambda: self.words.of(monomial_expr(self.ring, monomial))

    # -- the same monomial -------------------------------------------------------------------------

    def _same_monomial(self, mine: Part, expected: Part) -> list[TermSlip]:
        ratio = _ratio(mine, expected)
        if ratio is not None:
            return [self._factor(expected, ratio, self._number_of(mine), self._number_of(expected))]
        single = self._trig_function(mine, expected)
        if single is not None:
            return [single]
        return self._term_by_term(mine, expected)

    def _factor(self, expected: Part, ratio: Fraction, yours: Fraction, other: Fraction) -> TermSlip:
        if ratio == -1:
            return _found(1, "sign", term=self._said(expected))
        weight = 1 if abs(ratio) in (2, Fraction(1, 2)) else 2
        bare = Part(expected.monomial, tuple((w, c / other) for w, c in expected.fourier))
        mine, theirs = self.words.number(yours), self.words.number(other)
        return _found(weight, "factor", term=self._said(bare), yours=mine, other=theirs)

    def _said(self, part: Part) -> Told:
        """A part in words, made when it is told."""
        return lambda: self.words.of(part_expr(self.ring, part))

    def _number_of(self, part: Part) -> Fraction:
        return part.fourier[0][1]

    def _trig_function(self, mine: Part, expected: Part) -> TermSlip | None:
        """A slip in the one sine or cosine of a part: the wrong function, the wrong angle."""
        m, e = mine.single, expected.single
        if m is None or e is None or abs(m[1]) != abs(e[1]):
            return None
        (function, _), (wanted, _) = m, e
        yours = self._said(mine)
        mine_says, theirs = self._function_words(function), self._function_words(wanted)
        if wanted == ("cos", (0,) * len(wanted[1])):
            if function[0] == "cos" and all(x % 2 == 0 for x in function[1]):
                return _found(2, "double_angle", yours=yours, part=mine_says)
            return _found(3, "extra_factor", yours=yours, part=mine_says)
        if not any(function[1]):
            return _found(3, "dropped_factor", yours=yours, part=theirs)
        if function[1] == wanted[1]:
            return _found(2, "sin_for_cos", yours=yours, part=mine_says, other=self._instead(m, e))
        if function[0] == wanted[0]:
            code = "angle_product" if self._is_product(function) else "angle"
            return _found(2 + (m[1] != e[1]), code, yours=yours, part=mine_says, other=self._instead(m, e))
        return None

    def _is_product(self, function: TrigFunction) -> bool:
        return any(len(atom) > 1 for atom, _ in angle_of(self.ring, function).terms)

    def _function_words(self, function: TrigFunction) -> Told:
        return lambda: self._signed(function)[1]

    def _signed(self, function: TrigFunction) -> tuple[bool, str]:
        """Whether it is written with a sign (sin(θ₁ - (θ₁ + θ₂)) is -s₂), and its words without it."""
        text = self.words.of(trig_expr(self.ring, function))
        return text.startswith("-"), text.removeprefix("-")

    def _instead(self, mine: tuple[TrigFunction, Fraction], expected: tuple[TrigFunction, Fraction]) -> Told:
        """What belongs where a function stands: with a sign where the sign is another, too."""

        def told() -> str:
            turned, _ = self._signed(mine[0])
            wanted, text = self._signed(expected[0])
            same = ((mine[1] < 0) != turned) == ((expected[1] < 0) != wanted)
            return text if same else f"-{text}"

        return told

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
            found.append(self._missing(Part(mine.monomial, ((function, value),))))
        for function, value in extra.items():
            found.append(self._extra(Part(mine.monomial, ((function, value),))))
        if len(found) > 2:
            term = self._monomial(mine.monomial)
            factor = self._said(Part((), mine.fourier))
            return [_found(5, "trig_part", term=term, yours=factor)]
        return found

    # -- other monomials ---------------------------------------------------------------------------

    def _matched(self, mine: list[Part], expected: list[Part]) -> list[TermSlip]:
        """Pairs of parts with the slip between them, the lightest first; what is left is missing or extra."""
        if len(mine) * len(expected) > 2_500:
            return [*map(self._missing, expected), *map(self._extra, mine)]
        pairs = sorted(
            (
                (found.weight, i, j, found)
                for i, m in enumerate(mine)
                for j, e in enumerate(expected)
                if (found := self._between(m, e)) is not None
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
        result += [self._missing(e) for j, e in enumerate(expected) if j not in used_theirs]
        result += [self._extra(m) for i, m in enumerate(mine) if i not in used_mine]
        return result

    def _missing(self, part: Part) -> TermSlip:
        return _found(4, "missing_term", term=self._said(part))

    def _extra(self, part: Part) -> TermSlip:
        unknown = [
            g for i, _ in part.monomial
            if (g := self.ring.generators[i]).kind == "symbol" and self.words.is_unknown(g)
        ]  # fmt: skip
        if any(is_opaque(g.name) for g in unknown):
            return _found(3, "odd_argument", yours=self._said(part))
        if unknown:
            return _found(4, "unknown_symbol", part=self.words.generator(unknown[0]))
        return _found(4, "extra_term", term=self._said(part))

    def _between(self, mine: Part, expected: Part) -> TermSlip | None:
        """The slip that turns an expected part into the one that was written."""
        ratio = _ratio(mine, expected)
        weight = 0
        if ratio is None or ratio != 1:
            weight = 2
            if ratio is None or abs(ratio) not in (1, 2, Fraction(1, 2)):
                return None
        change = _change(mine.monomial, expected.monomial)
        found = next(self._named(change, mine), None)
        return None if found is None else replace(found, weight=found.weight + weight)

    def _named(self, change: dict[int, int], mine: Part) -> Iterator[TermSlip]:
        """The slip of a change of exponents (expected minus written)."""
        yours = self._said(mine)
        generators = self.ring.generators
        has = dict(mine.monomial)
        if len(change) == 1:
            ((index, power),) = change.items()
            g, name = generators[index], self.words.generator(generators[index])
            if power > 0:
                code = self._dropped(g, power, has.get(index, 0))
                part = name if power == 1 or code == "dropped_square" else self.words.power(g, power)
                yield _found(1, code, yours=yours, part=part)
            elif has.get(index, 0) > -power:
                yield _found(2, "extra_square", yours=yours, part=name)
            else:
                yield _found(2, "extra_factor", yours=yours, part=self.words.power(g, -power))
            return
        if len(change) == 2:
            (plus, p), (minus, q) = sorted(change.items(), key=lambda item: -item[1])
            if p > 0 > q:
                yield from self._exchanged(
                    generators[plus], p, generators[minus], -q, has.get(minus, 0), yours
                )
                return
        if all(power > 0 for power in change.values()) and sum(change.values()) <= 3:
            lost = self._monomial(change.items())
            yield _found(3, "dropped_factor", yours=yours, part=lost)
        elif all(power < 0 for power in change.values()) and sum(change.values()) >= -3:
            gained = self._monomial([(i, -p) for i, p in change.items()])
            yield _found(3, "extra_factor", yours=yours, part=gained)

    def _dropped(self, g: Generator, power: int, present: int) -> str:
        if present:
            return "dropped_square"
        if g.kind == "symbol" and g.dots:
            return "dropped_velocity" if g.dots == 1 else "dropped_factor"
        role = self.dimensions.of_generator(g)
        if role == MASS:
            return "dropped_mass"
        return "dropped_inertia" if role == INERTIA else "dropped_factor"

    def _exchanged(
        self, wanted: Generator, p: int, written: Generator, q: int, present: int, yours: Told
    ) -> Iterator[TermSlip]:
        """One symbol where another belongs, or the same with another number of dots."""
        part: Told = self.words.power(written, q)
        other: Told = self.words.power(wanted, p)
        if wanted.kind == written.kind == "symbol" and wanted.name == written.name:
            if p != q:
                return
            code = "dropped_dot" if written.dots < wanted.dots else "extra_dot"
            if present > q:
                part = self.words.power(written, present)
                other = self._monomial([(wanted.index, p), (written.index, present - q)])
            yield _found(1, code, yours=yours, part=part, other=other)
        elif p == q and wanted.kind == written.kind == "symbol":
            if is_opaque(written.name):
                yield _found(2, "odd_argument", yours=yours)
                return
            if self.words.is_unknown(written):
                yield _found(2, "unknown_symbol", part=part)
                return
            light = self.dimensions.of_generator(wanted) == self.dimensions.of_generator(written)
            yield _found(2 if light else 4, "symbol", yours=yours, part=part, other=other)


def _ratio(mine: Part, expected: Part) -> Fraction | None:
    """r where the factors of one are r times those of the other."""
    if [w for w, _ in mine.fourier] != [w for w, _ in expected.fourier]:
        return None
    ratios = {m / e for (_, m), (_, e) in zip(mine.fourier, expected.fourier, strict=True)}
    return ratios.pop() if len(ratios) == 1 else None


def _change(mine: Monomial, expected: Monomial) -> dict[int, int]:
    """Exponents of what was expected minus those of what was written."""
    change = dict(expected)
    for index, power in mine:
        change[index] = change.get(index, 0) - power
    return {i: p for i, p in change.items() if p}
