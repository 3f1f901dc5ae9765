"""Slips in the symbols of one term: a mass left out, a square or a dot lost, one symbol for another.

A part is compared with an expected part that has another monomial: what matters is by
which powers of which symbols the two differ.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from fractions import Fraction

from dynsolve.algebra.generators import Generator
from dynsolve.answers.diagnosis.fourier import (
    Monomial,
    Part,
)
from dynsolve.answers.diagnosis.term_slips import PartWriter, TermSlip, Told, found_slip, ratio_of
from dynsolve.robot.dimensions import Dimensions
from dynsolve.robot.units import INERTIA, MASS


class SymbolSlips:
    """Finds the slip that turns an expected part into one with other symbols."""

    def __init__(self, writer: PartWriter, dimensions: Dimensions) -> None:
        self.ring = writer.ring
        self.words = writer.words
        self.writer = writer
        self.dimensions = dimensions

    def __call__(self, mine: Part, expected: Part) -> TermSlip | None:
        """The slip that turns an expected part into the one that was written."""
        ratio = ratio_of(mine, expected)
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
        yours = self.writer.part(mine)
        generators = self.ring.generators
        has = dict(mine.monomial)
        if len(change) == 1:
            ((index, power),) = change.items()
            g, name = generators[index], self.words.generator(generators[index])
            if power > 0:
                code = self._dropped(g, power, has.get(index, 0))
                part = name if power == 1 or code == "dropped_square" else self.words.power(g, power)
                yield found_slip(1, code, yours=yours, part=part)
            elif has.get(index, 0) > -power:
                yield found_slip(2, "extra_square", yours=yours, part=name)
            else:
                yield found_slip(2, "extra_factor", yours=yours, part=self.words.power(g, -power))
            return
        if len(change) == 2:
            (plus, p), (minus, q) = sorted(change.items(), key=lambda item: -item[1])
            if p > 0 > q:
                yield from self._exchanged(
                    generators[plus], p, generators[minus], -q, has.get(minus, 0), yours
                )
                return
        reindexed = self._reindexed(change)
        if reindexed is not None:
            here, there = map(self.writer.monomial, reindexed)
            yield found_slip(2, "symbol", yours=yours, part=here, other=there)
            return
        if all(power > 0 for power in change.values()) and sum(change.values()) <= 3:
            lost = self.writer.monomial(change.items())
            yield found_slip(3, "dropped_factor", yours=yours, part=lost)
        elif all(power < 0 for power in change.values()) and sum(change.values()) >= -3:
            gained = self.writer.monomial([(i, -p) for i, p in change.items()])
            yield found_slip(3, "extra_factor", yours=yours, part=gained)

    def _reindexed(self, change: dict[int, int]) -> tuple[Monomial, Monomial] | None:
        """What was written and what belongs there, where one index is another: m₃ d_c3 for m₄ d_c4."""
        if any(self.ring.generators[i].kind != "symbol" or self.ring.generators[i].dots for i in change):
            return None
        written = tuple((i, -p) for i, p in change.items() if p < 0)
        wanted = tuple((i, p) for i, p in change.items() if p > 0)
        mine, theirs = self._letters_and_numbers(written), self._letters_and_numbers(wanted)
        if len(mine) < 2 or [letter for letter, _ in mine] != [letter for letter, _ in theirs]:
            return None
        moved = {(a, b) for (_, a), (_, b) in zip(mine, theirs, strict=True)}
        return (written, wanted) if len(moved) == 1 else None

    def _letters_and_numbers(self, monomial: Monomial) -> list[tuple[tuple[str, int], str]]:
        """((letters of a name, its power), number in its indices) of each symbol, sorted."""
        found = []
        for i, power in monomial:
            name = self.ring.generators[i].name
            letters = "".join(c for c in name if not c.isdigit())
            found.append(((letters, power), "".join(c for c in name if c.isdigit())))
        return sorted(found)

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
                other = self.writer.monomial([(wanted.index, p), (written.index, present - q)])
            yield found_slip(1, code, yours=yours, part=part, other=other)
        elif p == q and wanted.kind == "symbol" and written.kind in ("symbol", "function"):
            if written.kind == "function":
                yield found_slip(2, "odd_argument", yours=yours)
                return
            if self.words.is_unknown(written):
                yield found_slip(2, "unknown_symbol", part=part)
                return
            light = self.dimensions.of_generator(wanted) == self.dimensions.of_generator(written)
            yield found_slip(2 if light else 4, "symbol", yours=yours, part=part, other=other)


def _change(mine: Monomial, expected: Monomial) -> dict[int, int]:
    """Exponents of what was expected minus those of what was written."""
    change = dict(expected)
    for index, power in mine:
        change[index] = change.get(index, 0) - power
    return {i: p for i, p in change.items() if p}
