"""What a wrong answer keeps of the key, and so whether others may follow from it.

A slip leaves most of an answer standing, and what is derived from it with care is worth its
marks.  A model of nobody's robot (τ = q̈, D = 1), or one of zeros, keeps next to nothing: what
follows from it and keeps nothing either shows no work on this robot, in whatever order the
two were written.

What counts are the kinds of terms: the masses and moments, the rates and the powers of all
others in a term, whether a sine or cosine stands in it, and how many lengths, but not which:
a term with the wrong angle, number, sign or point of a body is of its kind still.  A term with
one factor left out, too many or in the place of another keeps a part.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from fractions import Fraction

from dynsolve.algebra.expr import Expr
from dynsolve.answers.judging.entry_comparison import substituted
from dynsolve.robot.dimensions import Dimensions
from dynsolve.robot.units import LENGTH

LEAST = Fraction(1, 4)
"""An answer that keeps no more than this share of the key's kinds of terms keeps nothing."""

NEARLY = Fraction(1, 3)
"""What a term counts that has one factor more or less than one of the key's, or another in its place."""

Kind = tuple[tuple[tuple[int, int], ...], int, bool]
"""(symbol, power) of all but the lengths; the power of the lengths; whether a sine or cosine is in it."""

_CONSTANT: Kind = ((), 0, False)

_LENGTH = -1
"""The place of the lengths among the symbols."""


class Content:
    """What the terms of values are; `numbers` are those that the problem gives for symbols."""

    def __init__(self, dimensions: Dimensions, numbers: Mapping[str, Fraction]) -> None:
        ring = dimensions.ring
        self._put = {ring.symbol_indices[n, 0]: v for n, v in numbers.items() if ring.has_symbol(n)}
        self._places: dict[int, str] = {}
        for g in ring.generators:
            role = dimensions.of_generator(g)
            if g.kind in ("sin", "cos", "function"):
                self._places[g.index] = "angle"
            elif g.kind == "symbol" and (g.dots or role not in (None, LENGTH)):
                self._places[g.index] = "symbol"
            elif g.kind == "symbol" and g.name != "pi":
                self._places[g.index] = "length"

    def is_kept(self, value: Iterable[Expr], key: Iterable[Expr]) -> bool:
        """Whether the entries of an answer keep more than next to nothing of the key's; of 0 none can."""
        wanted, mine = self._kinds(key), self._kinds(value)
        kept = Fraction(len(wanted & mine))
        left = wanted - mine
        for kind in mine - wanted:
            near = next((other for other in left if _is_near(kind, other)), None)
            if near is not None:
                left.discard(near)
                kept += NEARLY
        return kept > LEAST * len(wanted)

    def _kinds(self, entries: Iterable[Expr]) -> set[Kind]:
        """The kinds of terms of all entries; constants are one only where there is nothing else."""
        kinds = {kind for entry in entries for kind in self._of(substituted(entry, self._put))}
        return kinds - {_CONSTANT} or kinds

    def _of(self, entry: Expr) -> Iterator[Kind]:
        for exponents in entry.poly.monoms() if entry.poly else ():
            symbols, lengths, turning = [], 0, False
            for index, place in self._places.items():
                power = int(exponents[index])
                if not power:
                    continue
                if place == "symbol":
                    symbols.append((index, power))
                elif place == "length":
                    lengths += power
                else:
                    turning = True
            yield tuple(symbols), lengths, turning


def _is_near(mine: Kind, other: Kind) -> bool:
    """Whether one symbol, or one kind of factor, is left out, too many or in the place of another."""
    powers = {**dict(other[0]), _LENGTH: other[1]}
    for index, power in (*mine[0], (_LENGTH, mine[1])):
        powers[index] = powers.get(index, 0) - power
    missing = [power for power in powers.values() if power > 0]
    needless = [-power for power in powers.values() if power < 0]
    if mine[2] != other[2]:
        return not missing and not needless
    return max(len(missing), len(needless)) <= 1 and (not missing or not needless or missing == needless)
