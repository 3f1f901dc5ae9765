"""An equation f(q) = 0 that is a factor of something, and what expressions become where it holds."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

from dynsolve.algebra.expr import Expr
from dynsolve.algebra.generators import Pair
from dynsolve.algebra.trig_factor import trig_quotient


@dataclass(frozen=True)
class Condition:
    """f = 0, with f irreducible in a ring of one angle a coordinate."""

    expr: Expr

    def reduced(self, other: Expr) -> Expr:
        """Another expression where this holds, up to a factor that is never 0.

        An angle's sine, cosine or both are put in, a length that stands linearly is replaced;
        of any other condition it is only seen whether the expression has it as a factor.
        """
        (value,) = self.reduced_together((other,))
        return value

    def reduced_together(self, others: Sequence[Expr]) -> tuple[Expr, ...]:
        """Several expressions where this holds, up to a positive factor that all of them share."""
        for pair, sine, cosine in self._turn:
            return tuple(_at_angle(other, pair, sine, cosine) for other in others)
        for index, factor, rest in self._length:
            highest = max(
                (int(other.poly.degrees()[index]) for other in others if not other.is_zero), default=0
            )
            even = highest + highest % 2
            return tuple(_at_length(other, index, factor, rest, even) for other in others)
        return tuple(other.ring.zero if self._divides(other) else self._remainder(other) for other in others)

    def multiplier(self, others: Sequence[Expr]) -> Expr:
        """What `reduced_together` multiplies by: the factor of a length that stands in one of the others."""
        for index, factor, _ in self._length:
            if any(other.poly.degrees()[index] > 0 for other in others if not other.is_zero):
                return factor
        return self.expr.ring.one

    def _remainder(self, other: Expr) -> Expr:
        """Another expression less a multiple of this one, where that is shorter."""
        rest = Expr(other.ring, other.ring.reduce(divmod(other.poly, self.expr.poly)[1]))
        return rest if len(rest) < len(other) else other

    def _divides(self, other: Expr) -> bool:
        return trig_quotient(other, self.expr) is not None

    @property
    def fixes_coordinate(self) -> bool:
        """Whether an angle has few values, or a length one, where this holds."""
        return bool(self._turn or self._length)

    @property
    def fixes_length(self) -> bool:
        """Whether it is a length that has few values."""
        return bool(self._length)

    @property
    def keeps_values(self) -> bool:
        """Whether expressions that are reduced keep their values, and get no factor."""
        return not self._length or self._length[0][1] == self.expr.ring.one

    @cached_property
    def _turn(self) -> list[tuple[Pair, int | None, int | None]]:
        """(pair, sine, cosine) where the condition fixes an angle up to a sign; None is ±1."""
        ring = self.expr.ring
        for pair in ring.pairs:
            s, c = ring.generator(pair.sine), ring.generator(pair.cosine)
            known = ((s, 0, None), (c, None, 0), (c - ring.one, 0, 1), (c + ring.one, 0, -1),
                     (s - ring.one, 1, 0), (s + ring.one, -1, 0))  # fmt: skip
            for form, sine, cosine in known:
                if self.expr == form or self.expr == -form:
                    return [(pair, sine, cosine)]
        return []

    @cached_property
    def _length(self) -> list[tuple[int, Expr, Expr]]:
        """(generator d, m, n) where the condition is m d + n = 0 with m free of coordinates."""
        ring = self.expr.ring
        for name, kind in ring.coordinates:
            if kind != "prismatic":
                continue
            index = ring.symbol_indices[(name, 0)]
            factor = ring.coefficient(self.expr, name)
            if not factor.is_zero and not ring.depends_on_coordinates(factor):
                return [(index, factor, self.expr - factor * ring.generator(index))]
        return []


def _at_angle(expr: Expr, pair: Pair, sine: int | None, cosine: int | None) -> Expr:
    """An expression where sin and cos of an angle have these values; where one is 0 the other is ±1."""
    ring = expr.ring
    terms: dict[tuple[int, ...], Any] = {}
    for exponents, factor in expr.poly.to_dict().items():
        powers = list(exponents)
        for place, value in ((pair.sine, sine), (pair.cosine, cosine)):
            power = int(powers[place])
            if value is None:
                powers[place] = power % 2
            else:
                factor = factor * value**power
                powers[place] = 0
        if factor:
            key = tuple(powers)
            terms[key] = terms.get(key, 0) + factor
    return Expr(ring, ring.ctx.from_dict({key: value for key, value in terms.items() if value}))


def _at_length(expr: Expr, index: int, factor: Expr, rest: Expr, highest: int) -> Expr:
    """Σ aₖ dᵏ with d = -n/m, times m to the highest power t: Σ aₖ (-n)ᵏ mᵗ⁻ᵏ."""
    ring = expr.ring
    by_power: dict[int, dict[tuple[int, ...], Any]] = {}
    for exponents, value in expr.poly.to_dict().items():
        key = (*exponents[:index], 0, *exponents[index + 1 :])
        by_power.setdefault(int(exponents[index]), {})[key] = value
    total = ring.zero
    for power, terms in by_power.items():
        total += Expr(ring, ring.ctx.from_dict(terms)) * (-rest) ** power * factor ** (highest - power)
    return total
