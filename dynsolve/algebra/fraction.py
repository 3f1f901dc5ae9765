"""Fractions over a ring: numerator / denominator, compared by cross-multiplication.

A denominator may contain joint variables, as in sin θ / tan θ.  Where the division is
exact it is carried out, so that most values become elements of the ring.
"""

from __future__ import annotations

from collections.abc import Iterable
from fractions import Fraction
from math import gcd, lcm
from typing import Any

from flint import fmpq_mpoly
from msgspec import Struct

from dynsolve.algebra.factors import numeric_roots
from dynsolve.algebra.lowest_terms import lowest_terms
from dynsolve.algebra.ring import Expr, NoRoom, Ring
from dynsolve.errors import AlgebraError


class RationalExpr(Struct, frozen=True):
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


FractionRows = tuple[tuple[RationalExpr, ...], ...]
"""A matrix of fractions."""


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
    for index in expr.ring.inverses:
        expr = _times(expr, index, int(expr.poly.degrees()[index]))
    return expr


def _times(expr: Expr, index: int, degree: int) -> Expr:
    """Σ aₖ uᵏ times pⁿ, with u = 1/p of that index; n is no less than the degree in u."""
    ring = expr.ring
    if not degree:
        return expr
    inverted = ring.inverses[index]
    coefficients: dict[int, dict[tuple[int, ...], Any]] = {}
    for exponents, value in expr.poly.to_dict().items():
        rest = (*exponents[:index], 0, *exponents[index + 1 :])
        coefficients.setdefault(int(exponents[index]), {})[rest] = value
    total = ring.ctx.constant(0)
    for k, terms in coefficients.items():
        total = total + ring.ctx.from_dict(terms) * inverted ** (degree - k)
    return Expr(ring, ring.reduce(total))


def equal(a: RationalExpr, b: RationalExpr) -> bool:
    """Whether two fractions are the same, by cross-multiplication."""
    if a.divisor is None and b.divisor is None:
        return a.numerator == b.numerator or is_zero(a.numerator - b.numerator)
    return is_zero(a.numerator * b.denominator - b.numerator * a.denominator)


def same(a: FractionRows, b: FractionRows) -> bool:
    """Whether two matrices are equal, entry by entry."""
    if len(a) != len(b) or len(a[0]) != len(b[0]):
        return False
    return all(equal(x, y) for r, s in zip(a, b, strict=True) for x, y in zip(r, s, strict=True))


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


def cancelled(value: RationalExpr) -> RationalExpr:
    """The same fraction with what numerator and denominator share, in half angles, divided out.

    Where they are too long for that, the sines below go where the whole becomes shorter; so do roots of
    numbers and fractions of parameters in any case.  The leading coefficient below is 1.

    >>> from dynsolve.algebra.ring_values import build_ring
    >>> from dynsolve.notation.tree import Symbol
    >>> ring = build_ring([], [Symbol("a"), Symbol("b")])
    >>> a, b = ring.symbol("a"), ring.symbol("b")
    >>> cancelled(RationalExpr(a * b, a * a))
    RationalExpr(numerator=Expr(1*b), divisor=Expr(1*a))
    """
    if value.divisor is None or is_zero(value.numerator):
        return RationalExpr(value.numerator)
    plain = _without_common(_without_root_factors(_without_roots(value)))
    whole = _without_inverses(plain) if plain.ring.inverses else plain
    if whole.divisor is None:
        return min(plain, whole, key=_length)
    found = lowest_terms(whole.numerator, whole.divisor)
    if found is None:
        return min(plain, simplified(plain), whole, key=_length)
    if found == (whole.numerator, whole.divisor):
        return min(plain, whole, key=_length)
    lowest = _without_common(_without_root_factors(RationalExpr(*found)))
    return min(_with_inverses(lowest, like=plain), lowest, key=_length)


def exactly_divided(numerator: Expr, divisor: Expr) -> tuple[fmpq_mpoly, fmpq_mpoly]:
    """(whole, rest): of m (m L³ + J L) θ̇² + J f over m L² + J the factor of θ̇² is divided, and J f left."""
    inside, zero = set(divisor.used), numerator.ring.zero.poly
    factors: dict[tuple[int, ...], fmpq_mpoly] = {}
    for exponents, number in numerator.poly.terms():
        beside = tuple(0 if k in inside else int(e) for k, e in enumerate(exponents))
        factors[beside] = factors.get(beside, zero) + zero.context().from_dict({exponents: number})
    whole, rest = zero, zero
    for factor in factors.values():
        quotient, left = divmod(factor, divisor.poly)
        whole, rest = (whole, rest + factor) if left else (whole + quotient, rest)
    return whole, rest


def with_integers(value: RationalExpr) -> RationalExpr:
    """The same fraction with integer coefficients that have no common factor, above and below together.

    Beside π a fraction stays: q₁ - π/2.

    >>> from dynsolve.algebra.ring_values import build_ring
    >>> from dynsolve.notation.tree import Symbol
    >>> ring = build_ring([], [Symbol("a"), Symbol("b")])
    >>> a, b = ring.symbol("a"), ring.symbol("b")
    >>> with_integers(RationalExpr(a / 2, a + b / 3))
    RationalExpr(numerator=Expr(3*a), divisor=Expr(6*a + 2*b))
    """
    if value.divisor is None:
        return value
    place = value.ring.symbol_indices.get(("pi", 0))
    terms = (*value.numerator.poly.terms(), *value.divisor.poly.terms())
    both = [c for exponents, c in terms if place is None or not exponents[place]]
    if not both:
        return value
    common = lcm(*(int(c.q) for c in both))
    scale = Fraction(common, gcd(*(int(c.p) * common // int(c.q) for c in both)))
    return RationalExpr(value.numerator * scale, value.divisor * scale)


def _length(value: RationalExpr) -> int:
    return len(value.numerator) + (0 if value.divisor is None else len(value.divisor))


def _without_common(value: RationalExpr) -> RationalExpr:
    """Numerator and denominator over their greatest common divisor as polynomials."""
    ring, numerator, divisor = value.ring, value.numerator.poly, value.denominator.poly
    shared = numerator.gcd(divisor)
    if not shared.is_constant():
        numerator, divisor = divmod(numerator, shared)[0], divmod(divisor, shared)[0]
    lead = divisor.leading_coefficient()
    above, below = Expr(ring, numerator / lead), Expr(ring, divisor / lead)
    return RationalExpr(above) if below.is_number else RationalExpr(above, below)


def _without_inverses(value: RationalExpr) -> RationalExpr:
    """The fraction with what stands below its own fractions: (m + I/R²)/(m R + I/R) is 1/R."""
    above, below = value.numerator, value.denominator
    for index in value.ring.inverses:
        degree = max(int(one.poly.degrees()[index]) for one in (above, below))
        above, below = _times(above, index, degree), _times(below, index, degree)
    return _without_common(RationalExpr(above, below))


def _with_inverses(value: RationalExpr, like: RationalExpr) -> RationalExpr:
    """The fraction with the fractions of parameters that stand in another."""
    factor = value.ring.one
    for index in value.ring.inverses:
        degree = max(int(one.poly.degrees()[index]) for one in (like.numerator, like.denominator))
        factor = factor * value.ring.generator(index) ** max(degree, 0)
    return _without_common(RationalExpr(value.numerator * factor, value.denominator * factor))


def _without_roots(value: RationalExpr) -> RationalExpr:
    """The fraction without square roots of numbers below, where that makes it shorter."""
    ring, numerator, divisor = value.ring, value.numerator, value.denominator
    for _ in ring.radicands:
        conjugate = ring.conjugate(divisor)
        if conjugate is None:
            break
        above, below = numerator * conjugate, divisor * conjugate
        if len(below) > len(divisor):
            break
        numerator, divisor = above, below
    return RationalExpr(numerator, divisor)


def _without_root_factors(value: RationalExpr) -> RationalExpr:
    """√2 v/(2 l), which is v/(√2 l)."""
    ring, numerator, divisor = value.ring, value.numerator, value.denominator
    for index in numeric_roots(ring):
        if all(exponents[index] for exponents in divisor.poly.monoms()):
            numerator, divisor = numerator * ring.generator(index), divisor * ring.generator(index)
    return RationalExpr(numerator, divisor)


def add(a: RationalExpr, b: RationalExpr) -> RationalExpr:
    """a + b"""
    if a.denominator == b.denominator:
        return RationalExpr(a.numerator + b.numerator, a.divisor)
    above = a.numerator * b.denominator + b.numerator * a.denominator
    return RationalExpr(above, a.denominator * b.denominator)


def summed(terms: Iterable[RationalExpr], start: Expr) -> RationalExpr:
    """The sum of fractions and an expression."""
    total = RationalExpr(start)
    for term in terms:
        total = add(total, term)
    return total


def multiply(a: RationalExpr, b: RationalExpr) -> RationalExpr:
    """a · b"""
    if a.divisor is None and b.divisor is None:
        return RationalExpr(a.numerator * b.numerator)
    return RationalExpr(a.numerator * b.numerator, a.denominator * b.denominator)


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
