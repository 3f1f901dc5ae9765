"""The signs of polynomials in parameters, which count as positive, under what is assumed of them."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from math import prod

from dynsolve.algebra.expr import Expr
from dynsolve.algebra.inequality import Bound, follows
from dynsolve.algebra.positivity import is_positive
from dynsolve.algebra.trig_factor import ratio, trig_factors


@dataclass(frozen=True, slots=True)
class ParameterSigns:
    """What is `assumed` of the parameters beside that they are positive; the `nonzero` factors are not 0."""

    assumed: tuple[Bound, ...] = ()
    nonzero: tuple[Expr, ...] = ()

    def beside(self, *more: Bound, nonzero: Iterable[Expr] = ()) -> ParameterSigns:
        """The same where further inequalities hold, and further factors are not 0."""
        return ParameterSigns((*self.assumed, *more), (*self.nonzero, *nonzero))

    def open_factors(self, value: Expr) -> Iterator[Expr]:
        """The irreducible factors of a value that may be 0, as far as is known; none where it is 0."""
        if not value.is_zero:
            yield from (factor for factor, _ in _factored(value)[1] if not self._sign(factor))

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
        is_positive, factors = _factored(value)
        left = ring.one if is_positive else -ring.one
        for factor, times in factors:
            sign = self._sign(factor)
            if sign or times % 2 or factor not in self.nonzero:
                left = left * (ring.constant(sign) if sign else factor) ** times
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


def _factored(value: Expr) -> tuple[bool, list[tuple[Expr, int]]]:
    """Whether the number before its irreducible factors is positive, and these with their multiplicities.

    With sines and cosines these are factors as in sin² β = 1 - cos² β.
    """
    ring, degrees = value.ring, value.poly.degrees()
    if any(degrees[pair.sine] > 0 or degrees[pair.cosine] > 0 for pair in ring.pairs):
        factors = trig_factors(value)
        number = ratio(value, prod((factor**times for factor, times in factors), start=ring.one))
        if number.is_number:
            return number.number > 0, [*factors]
    content, plain = value.poly.factor()
    return content > 0, [(Expr(ring, factor), int(times)) for factor, times in plain]
