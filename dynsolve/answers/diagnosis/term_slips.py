"""A slip between two terms: how far-fetched it is, and how it is told.

Most pairs of terms that are compared are never told, so the words of a message are made
only when it is.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction

from dynsolve.algebra.fourier import TrigFunction
from dynsolve.algebra.ring import Ring
from dynsolve.answers.diagnosis.fourier import (
    Part,
    monomial_expr,
    part_expr,
    trig_expr,
)
from dynsolve.answers.diagnosis.slips import slip
from dynsolve.answers.diagnosis.term_writer import TermWriter
from dynsolve.answers.verdict import Diagnosis

LIGHT = 4
"""A slip up to this weight is one that a person makes in one place."""

MOST_NAMED = 4
"""More slips than this in one answer are told as the terms that differ."""


Told = str | Callable[[], str]
"""A piece of a message, or how to make it."""


def found_slip(weight: int, code: str, **what: Told) -> TermSlip:
    """A slip of the table with the pieces of its message."""
    return TermSlip(weight, code, what)


@dataclass(frozen=True, slots=True)
class TermSlip:
    """A slip between two parts: `weight` tells how unlikely it is, `what` has the pieces of its message."""

    weight: int
    code: str
    what: Mapping[str, Told]

    @property
    def diagnosis(self) -> Diagnosis:
        """The slip as a message; its words are made only here, since most pairs are discarded."""
        return slip(self.code, **{key: self.word(key) for key in self.what})

    def word(self, key: str) -> str:
        """One piece of the message."""
        told = self.what[key]
        return told if isinstance(told, str) else told()


class PartWriter:
    """Writes parts of an expression in words, and makes the slip of a part that has no counterpart."""

    def __init__(self, ring: Ring, words: TermWriter) -> None:
        self.ring = ring
        self.words = words

    def part(self, part: Part) -> Told:
        """A part in words, made when it is told."""
        return lambda: self.words.of(part_expr(self.ring, part))

    def monomial(self, monomial: Iterable[tuple[int, int]]) -> Told:
        """A monomial in words, made when it is told."""
        return lambda: self.words.of(monomial_expr(self.ring, monomial))

    def function(self, function: TrigFunction) -> Told:
        """A sine or cosine in words, without its sign."""
        return lambda: self._signed(function)[1]

    def _signed(self, function: TrigFunction) -> tuple[bool, str]:
        """Whether it is written with a sign (sin(θ₁ - (θ₁ + θ₂)) is -s₂), and its words without it."""
        text = self.words.of(trig_expr(self.ring, function))
        return text.startswith("-"), text.removeprefix("-")

    def instead(self, mine: tuple[TrigFunction, Fraction], expected: tuple[TrigFunction, Fraction]) -> Told:
        """The function that was expected, with its sign where that differs too."""

        def told() -> str:
            turned, _ = self._signed(mine[0])
            wanted, text = self._signed(expected[0])
            same = ((mine[1] < 0) != turned) == ((expected[1] < 0) != wanted)
            return text if same else f"-{text}"

        return told

    def missing_term(self, part: Part) -> TermSlip:
        """An expected part that was not written."""
        return found_slip(4, "missing_term", term=self.part(part))

    def extra_term(self, part: Part) -> TermSlip:
        """A part that was written and is not expected."""
        unknown = [
            g for i, _ in part.monomial
            if self.words.is_unknown(g := self.ring.generators[i])
        ]  # fmt: skip
        if any(g.kind == "function" for g in unknown):
            return found_slip(3, "odd_argument", yours=self.part(part))
        if unknown:
            return found_slip(4, "unknown_symbol", part=self.words.generator(unknown[0]))
        return found_slip(4, "extra_term", term=self.part(part))


def ratio_of(mine: Part, expected: Part) -> Fraction | None:
    """r where the factors of one are r times those of the other."""
    if [w for w, _ in mine.fourier] != [w for w, _ in expected.fourier]:
        return None
    ratios = {m / e for (_, m), (_, e) in zip(mine.fourier, expected.fourier, strict=True)}
    return ratios.pop() if len(ratios) == 1 else None


def tell(found: Sequence[TermSlip], right: int) -> Iterator[Diagnosis]:
    """The slips, each named where they are few; of many, the terms that should not be there.

    Missing terms are named only beside at least as many right ones, so that an answer 0 does not reveal
    the solution.
    """
    found = sorted(found, key=lambda f: f.weight)
    missing = sum(f.code == "missing_term" for f in found)
    if len(found) <= MOST_NAMED and missing <= right:
        yield from (one.diagnosis for one in found)
        return
    if missing == len(found):
        yield slip("terms_missing", yours=f"{missing} terms are" if missing > 1 else "A term is")
        return
    light = [one for one in found if one.weight < LIGHT]
    yield from (one.diagnosis for one in light[:MOST_NAMED])
    if len(light) < len(found):
        extra = [f for f in found if f.code == "extra_term"]
        yours = f"{missing} {'is' if missing == 1 else 'are'} missing. " if missing else ""
        if extra:
            more = f", and {len(extra) - MOST_NAMED} more" if len(extra) > MOST_NAMED else ""
            yours += f"These do not belong: {', '.join(f.word('term') for f in extra[:MOST_NAMED])}{more}."
        yield slip("terms_differ", yours=yours.strip())
