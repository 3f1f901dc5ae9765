"""Fractions over a ring, compared by cross-multiplication.

A denominator may hold joint variables, as in sin θ / tan θ; what can be divided is,
so that most answers end as elements of the ring.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from dynsolve.algebra.expr import Expr
from dynsolve.algebra.ring import Ring


@dataclass(frozen=True, slots=True)
class Frac:
    """numerator / denominator over one ring; `below` None stands for 1."""

    above: Expr
    below: Expr | None = None

    @property
    def ring(self) -> Ring:
        """The ring of both."""
        return self.above.ring

    @property
    def is_zero(self) -> bool:
        """Whether it is 0."""
        return is_zero(self.above)

    @property
    def bottom(self) -> Expr:
        """The denominator."""
        return self.ring.one if self.below is None else self.below


def is_zero(expr: Expr) -> bool:
    """Whether an expression is 0, also where several inverses occur.

    The relations u·p = 1 of several denominators are no complete system of
    rewriting rules, so u is multiplied away before the answer is no.
    """
    if expr.is_zero or not expr.ring.inverses:
        return expr.is_zero
    return not clear_inverses(expr).poly


def clear_inverses(expr: Expr) -> Expr:
    """The expression times its denominators."""
    ring = expr.ring
    for index, factor in ring.inverses.items():
        degree = int(expr.poly.degrees()[index]) if expr.poly else 0
        if degree <= 0:
            continue
        total = ring.ctx.constant(0)
        poly, power = expr.poly, ring.ctx.constant(1)
        parts = [_coefficient(ring, poly, index, k) for k in range(degree + 1)]
        for k in range(degree, -1, -1):
            total = total + parts[k] * power
            power = power * factor
        expr = Expr(ring, ring.reduce(total))
    return expr


def _coefficient(ring: Ring, poly: Any, index: int, power: int) -> Any:
    """The coefficient of generator^power."""
    terms = {}
    for exponents, value in poly.to_dict().items():
        if exponents[index] == power:
            terms[tuple(0 if i == index else e for i, e in enumerate(exponents))] = value
    return ring.ctx.from_dict(terms)


def equal(a: Frac, b: Frac) -> bool:
    """Whether two fractions are the same, by cross-multiplication."""
    if a.below is None and b.below is None:
        return a.above == b.above or is_zero(a.above - b.above)
    return is_zero(a.above * b.bottom - b.above * a.bottom)


def simplified(value: Frac) -> Frac:
    """The same fraction with a rational denominator drawn in, or without one where it divides.

    Sines are removed from the denominator by their conjugates; what divides then is
    divided, so that (1 - t²)/(1 + t²) with t = tan(θ/2) becomes a polynomial.
    """
    if value.below is None:
        return value
    ring = value.ring
    above, below = value.above, value.below
    for pair in ring.pairs:
        if not below.poly or len(above) * len(below) > 20_000:
            break
        if int(below.poly.degrees()[pair.sine]) > 0:
            conjugate = _conjugate(below, pair.sine)
            above, below = above * conjugate, below * conjugate
    if below.is_zero:
        return value
    if below.is_number:
        return Frac(above / below.number)
    shared = above.poly.gcd(below.poly)
    if not shared.is_constant():
        above, below = Expr(ring, _divided(above.poly, shared)), Expr(ring, _divided(below.poly, shared))
    if below.is_number:
        return Frac(above / below.number)
    lead = below.poly.leading_coefficient()
    return Frac(Expr(ring, above.poly / lead), Expr(ring, below.poly / lead))


def _divided(poly: Any, divisor: Any) -> Any:
    quotient, _ = divmod(poly, divisor)
    return quotient


def _conjugate(expr: Expr, sine: int) -> Expr:
    """The expression with one sine negated; normal forms are linear in it."""
    terms = {e: (-c if e[sine] % 2 else c) for e, c in expr.poly.to_dict().items()}
    return Expr(expr.ring, expr.ring.ctx.from_dict(terms))


def as_expr(value: Frac) -> Expr | None:
    """The value as an element of the ring where it is one, with inverses of parameters; else None."""
    value = simplified(value)
    if value.below is None:
        return value.above
    try:
        return value.above * value.ring.inverse(value.below)
    except Exception:  # noqa: BLE001  no room for another inverse, or a joint variable below
        return None
