"""The signs of polynomials in parameters, which count as positive, under what is assumed of them."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from dynsolve.algebra.expr import Expr
from dynsolve.algebra.inequality import Bound, follows
from dynsolve.algebra.positivity import is_positive


@dataclass(frozen=True, slots=True)
class ParameterSigns:
    """What is `assumed` of the parameters beside that they are positive."""

    assumed: tuple[Bound, ...] = ()

    def beside(self, *more: Bound) -> ParameterSigns:
        """The same where further inequalities hold."""
        return ParameterSigns((*self.assumed, *more))

    def open_part(self, value: Expr) -> Expr:
        """What has the sign of a value, without the factors whose sign is known: 1 or -1 where all are.

        >>> from dynsolve.algebra.build import build_ring
        >>> from dynsolve.notation.tree import Symbol
        >>> ring = build_ring([], [Symbol("a"), Symbol("b")])
        >>> a, b = ring.symbol("a"), ring.symbol("b")
        >>> ParameterSigns().open_part(2 * a**3 - 2 * a * b * b) == a - b
        True
        >>> ParameterSigns((Bound(a - b),)).open_part(b * b - a * a) == -ring.one
        True
        """
        ring = value.ring
        if value.is_zero:
            return value
        content, factors = value.poly.factor()
        left = ring.one if content > 0 else -ring.one
        for factor, times in factors:
            own = Expr(ring, factor)
            sign = self._sign(own)
            left = left * (ring.constant(sign) if sign else own) ** int(times)
        return left

    def is_positive(self, value: Expr) -> bool:
        """Whether a value is positive."""
        part = self.open_part(value)
        return part.is_number and part.number > 0

    def _sign(self, factor: Expr) -> int:
        """1 or -1 where it is known, else 0."""
        for sign in (1, -1):
            signed = factor * sign
            if is_positive(signed) or any(
                signed == bound.value and bound.is_strict for bound in self.assumed
            ):
                return sign
        if not self.assumed or factor.ring.depends_on_coordinates(factor):
            return 0
        known = (*self.assumed, *self._positive(factor))
        return next((sign for sign in (1, -1) if follows(Bound(factor * sign), known)), 0)

    def _positive(self, factor: Expr) -> Iterator[Bound]:
        """That the parameters are positive which stand in a factor, or in what is assumed."""
        ring = factor.ring
        degrees = [value.poly.degrees() for value in (factor, *(bound.value for bound in self.assumed))]
        for g in ring.generators:
            if g.kind == "symbol" and g.name in ring.parameters and any(d[g.index] > 0 for d in degrees):
                yield Bound(ring.generator(g.index))
