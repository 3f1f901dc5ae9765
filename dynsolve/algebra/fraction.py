"""Fractions over a ring: numerator / denominator, compared by cross-multiplication.

A denominator may contain joint variables, as in sin θ / tan θ.  Where the division is
exact it is carried out, so that most values become elements of the ring.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from dynsolve.algebra.expr import Expr
from dynsolve.algebra.ring import NoRoom, Ring
from dynsolve.errors import AlgebraError


@dataclass(frozen=True, slots=True)
class RationalExpr:
    """numerator / divisor over one ring; without a divisor the numerator by itself.

    `denominator` is the divisor, 1 where there is none.
    """

    numerator: Expr
    divisor: Expr | None = None

    @property
    def ring(self) -> Ring:
        """The ring of numerator and divisor."""
        return self.numerator.ring

    @property
    def is_zero(self) -> bool:
        """Whether it is 0."""
        return is_zero(self.numerator)

    @property
    def denominator(self) -> Expr:
        """The denominator, 1 where there is no divisor."""
        return self.ring.one if self.divisor is None else self.divisor

    def __neg__(self) -> RationalExpr:
        return RationalExpr(-self.numerator, self.divisor)


def is_zero(expr: Expr) -> bool:
    """Whether an expression is 0, also where several inverses occur.

    The relations u·p = 1 of several denominators are no complete system of
    rewriting rules, so u is multiplied away before the answer is no.
    """
    if expr.is_zero or not expr.ring.inverses:
        return expr.is_zero
    return not clear_inverses(expr).poly


def clear_inverses(expr: Expr) -> Expr:
    """The expression times its denominators: with u = 1/p, Σ aₖ uᵏ becomes Σ aₖ pⁿ⁻ᵏ, n its degree in u."""
    ring = expr.ring
    for index, inverted in ring.inverses.items():
        coefficients: dict[int, dict[tuple[int, ...], Any]] = {}
        for exponents, value in expr.poly.to_dict().items():
            rest = (*exponents[:index], 0, *exponents[index + 1 :])
            coefficients.setdefault(int(exponents[index]), {})[rest] = value
        degree = max(coefficients, default=0)
        if degree:
            total = ring.ctx.constant(0)
            for k, terms in coefficients.items():
                total = total + ring.ctx.from_dict(terms) * inverted ** (degree - k)
            expr = Expr(ring, ring.reduce(total))
    return expr


def equal(a: RationalExpr, b: RationalExpr) -> bool:
    """Whether two fractions are the same, by cross-multiplication."""
    if a.divisor is None and b.divisor is None:
        return a.numerator == b.numerator or is_zero(a.numerator - b.numerator)
    return is_zero(a.numerator * b.denominator - b.numerator * a.denominator)


def simplified(value: RationalExpr) -> RationalExpr:
    """The same fraction with a rational denominator drawn in, or without one where it divides.

    Sines are removed from the denominator by their conjugates; what divides then is
    divided, so that (1 - t²)/(1 + t²) with t = tan(θ/2) becomes a polynomial.
    """
    if value.divisor is None:
        return value
    numerator, divisor = _without_sines(value.numerator, value.divisor)
    if divisor.is_zero:
        return value
    ring = value.ring
    if not divisor.is_number:
        shared = numerator.poly.gcd(divisor.poly)
        if not shared.is_constant():
            numerator, divisor = (Expr(ring, divmod(e.poly, shared)[0]) for e in (numerator, divisor))
    if divisor.is_number:
        return RationalExpr(numerator / divisor.number)
    lead = divisor.poly.leading_coefficient()
    return RationalExpr(Expr(ring, numerator.poly / lead), Expr(ring, divisor.poly / lead))


MOST_PRODUCTS = 20_000
"""Above so many products of terms a sine stays in the denominator."""


def _without_sines(numerator: Expr, divisor: Expr) -> tuple[Expr, Expr]:
    """Both times the divisor's conjugates, sine by sine: (a + b s)(a - b s) = a² - b² (1 - c²)."""
    for pair in divisor.ring.pairs:
        if not divisor.poly or len(numerator) * len(divisor) > MOST_PRODUCTS:
            break
        if int(divisor.poly.degrees()[pair.sine]) > 0:
            conjugate = _conjugate(divisor, pair.sine)
            numerator, divisor = numerator * conjugate, divisor * conjugate
    return numerator, divisor


def _conjugate(expr: Expr, sine: int) -> Expr:
    """The expression with one sine negated; normal forms are linear in it."""
    terms = {e: (-c if e[sine] % 2 else c) for e, c in expr.poly.to_dict().items()}
    return Expr(expr.ring, expr.ring.ctx.from_dict(terms))


def as_expr(value: RationalExpr) -> Expr | None:
    """The value as an element of the ring where it is one, with inverses of parameters; else None."""
    value = simplified(value)
    if value.divisor is None:
        return value.numerator
    try:
        return value.numerator * value.ring.inverse(value.divisor)
    except (AlgebraError, NoRoom):  # a joint variable below, or no room for another inverse
        return None
