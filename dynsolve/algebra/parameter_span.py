"""Sums of products of unknown parameters, whose coefficients are polynomials in known ones.

    m₁ l_c1 + m₂ l₁   with l₁ known   is   {m₁ l_c1: 1, m₂: l₁}

Over the fractions in what is known these are vectors.  `ParameterSpan` decides exactly whether
one is a combination of others, and of which: by elimination, that divides by a number where it
can and by a polynomial only where it must.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from msgspec import Struct

from dynsolve.algebra.compact.terms import Exponents
from dynsolve.algebra.fraction import RationalExpr, cancelled
from dynsolve.algebra.rationals import fraction, rational_gcd
from dynsolve.algebra.ring import Expr, Ring

Vector = dict[Exponents, Expr]
"""Polynomials in what is known, by the exponents of what is unknown; none of them is 0."""


class Generators(Struct, frozen=True):
    """Which generators of a ring move, and which are unknown parameters; the others are known."""

    moving: frozenset[int]
    unknown: frozenset[int]

    def split(self, expr: Expr) -> list[tuple[Expr, Vector]]:
        """Σ (what moves) · (a vector of parameters), no two of which are multiples of each other.

        Each vector stands for itself in the polynomial of what moves that is its factor, so that
        however long an expression is, every combination of parameters is looked at once.
        """
        ring = expr.ring
        width = len(ring.generators)
        moving = [i for i in range(width) if i in self.moving]
        still = [i for i in range(width) if i not in self.moving]
        by_motion: dict[Exponents, dict[Exponents, Any]] = {}
        for exponents, factor in expr.poly.to_dict().items():
            motion = tuple([exponents[i] for i in moving])
            by_motion.setdefault(motion, {})[tuple([exponents[i] for i in still])] = factor
        grouped: dict[frozenset[tuple[Exponents, Any]], dict[Exponents, Any]] = {}
        for motion, terms in by_motion.items():
            lead = terms[max(terms)]
            same = frozenset((own, str(factor / lead)) for own, factor in terms.items())
            grouped.setdefault(same, {})[motion] = lead
        found = []
        for motions in grouped.values():
            first, scale = next(iter(motions.items()))
            total = {_placed(width, moving, motion): lead for motion, lead in motions.items()}
            terms = {own: factor / scale for own, factor in by_motion[first].items()}
            found.append((Expr(ring, ring.ctx.from_dict(total)), self._vector(ring, still, terms)))
        return found

    def _vector(self, ring: Ring, still: Sequence[int], terms: Mapping[Exponents, Any]) -> Vector:
        width = len(ring.generators)
        unknown = [i for i in still if i in self.unknown]
        parts: dict[Exponents, dict[Exponents, Any]] = {}
        for own, factor in terms.items():
            exponents = _placed(width, still, own)
            key = _placed(width, unknown, [exponents[i] for i in unknown])
            rest = tuple(a - b for a, b in zip(exponents, key, strict=True))
            parts.setdefault(key, {})[rest] = factor
        return {key: Expr(ring, ring.ctx.from_dict(part)) for key, part in parts.items()}

    def vector(self, expr: Expr) -> Vector | None:
        """An expression in parameters alone as a vector; None where it moves."""
        if expr.is_zero:
            return {}
        if any(degree > 0 for i, degree in enumerate(expr.poly.degrees()) if i in self.moving):
            return None
        still = [i for i in range(len(expr.ring.generators)) if i not in self.moving]
        terms = {tuple(e[i] for i in still): f for e, f in expr.poly.to_dict().items()}
        return self._vector(expr.ring, still, terms)


def _placed(width: int, places: Sequence[int], values: Sequence[int]) -> Exponents:
    """The exponents of all generators: `values` at `places`, 0 elsewhere."""
    exponents = [0] * width
    for place, value in zip(places, values, strict=True):
        exponents[place] = int(value)
    return tuple(exponents)


def expression(ring: Ring, vector: Mapping[Exponents, Expr]) -> Expr:
    """The sum that a vector stands for."""
    total = ring.zero
    for unknown, factor in vector.items():
        total += factor * Expr(ring, ring.ctx.from_dict({unknown: 1}))
    return total


def primitive(vector: Vector) -> Vector:
    """The vector without what all its coefficients share, and positive for the most part."""
    shared = None
    for value in vector.values():
        shared = value.poly if shared is None else shared.gcd(value.poly)
    if shared is None:
        return {}
    plain = {key: Expr(value.ring, divmod(value.poly, shared)[0]) for key, value in vector.items()}
    numbers = [fraction(c) for value in plain.values() for c in value.poly.coeffs()]
    scale = rational_gcd(numbers)
    if 2 * sum(number > 0 for number in numbers) < len(numbers):
        scale = -scale
    return {key: value / scale for key, value in plain.items()}


def length(vector: Vector) -> float:
    """Its length to a reader: its terms, with a little more for a minus sign or a number."""
    numbers = [fraction(c) for value in vector.values() for c in value.poly.coeffs()]
    return len(numbers) + sum(0.5 * (abs(c) != 1) + 0.2 * (c < 0) for c in numbers)


def shortened(vector: Vector, others: Sequence[Vector]) -> Vector:
    """The vector less multiples of others, as long as each makes it shorter."""
    best = primitive(vector)
    while True:
        tried = (primitive(one) for other in others for one in _cancelling(best, other))
        shorter = min((one for one in tried if one), key=length, default=best)
        if length(shorter) >= length(best):
            return best
        best = shorter


def _cancelling(vector: Vector, other: Vector) -> Iterator[Vector]:
    """vector - f · other, for each polynomial f by which a coefficient vanishes."""
    tried: list[Expr] = []
    for key in vector.keys() & other.keys():
        factor = _quotient(vector[key], other[key])
        if factor is not None and factor not in tried:
            tried.append(factor)
            yield _less(vector, factor, other)


def _quotient(above: Expr, below: Expr) -> Expr | None:
    """above / below where that is a polynomial."""
    found, rest = divmod(above.poly, below.poly)
    return None if rest else Expr(above.ring, found)


def _less(vector: Vector, factor: Expr, other: Vector) -> Vector:
    """vector - factor · other"""
    result = dict(vector)
    for key, value in other.items():
        left = result[key] - factor * value if key in result else -(factor * value)
        if left.is_zero:
            del result[key]
        else:
            result[key] = left
    return result


class _Row(Struct, frozen=True):
    """What elimination leaves of a vector: values = divisor · vector - Σ factor_k · row_k, and its pivot.

    `factors` are (k, factor_k), those that are not 0.
    """

    values: Vector
    pivot: Exponents
    divisor: Expr
    factors: tuple[tuple[int, Expr], ...]


class ParameterSpan:
    """The combinations of some vectors, over the fractions in what is known.

    >>> from dynsolve.algebra.ring_values import build_ring
    >>> from dynsolve.notation.tree import Symbol
    >>> ring = build_ring([], [Symbol(name) for name in ("l", "m1", "m2")])
    >>> l, m1, m2 = (ring.symbol(name) for name in ("l", "m1", "m2"))
    >>> generators = Generators(frozenset(), frozenset({1, 2}))
    >>> span = ParameterSpan(ring)
    >>> [span.add(generators.vector(e)) for e in (m1 + l * m2, m2, l * m1)]
    [True, True, False]
    >>> [y.numerator for y in span.coordinates(generators.vector(l * m1))]
    [Expr(1*l), Expr(-1*l^2)]
    """

    def __init__(self, ring: Ring) -> None:
        self.ring = ring
        self._rows: list[_Row] = []

    def add(self, vector: Vector) -> bool:
        """Take a vector into the basis; whether it was none of the combinations before."""
        rest, factors, divisor = self._eliminated(vector)
        if not rest:
            return False
        pivot = min(rest, key=lambda key: (not rest[key].is_number, len(rest[key]), tuple(-e for e in key)))
        used = tuple((k, factor) for k, factor in enumerate(factors) if not factor.is_zero)
        self._rows.append(_Row(rest, pivot, divisor, used))
        return True

    def has(self, vector: Vector) -> bool:
        """Whether a vector is one of the combinations."""
        return not self._eliminated(vector)[0]

    def coordinates(self, vector: Vector) -> tuple[RationalExpr, ...] | None:
        """The factors y with vector = Σ y_k · (the k-th of the basis); None where there are none."""
        rest, factors, divisor = self._eliminated(vector)
        if rest:
            return None
        found: list[Expr] = []
        for k in reversed(range(len(self._rows))):
            row, factor = self._rows[k], factors[k]
            found.append(factor if factor.is_zero else factor * row.divisor)
            for j, other in () if factor.is_zero else row.factors:
                factors[j] = factors[j] - factor * other
        return tuple(cancelled(RationalExpr(factor, divisor)) for factor in reversed(found))

    def _eliminated(self, vector: Vector) -> tuple[Vector, list[Expr], Expr]:
        """(rest, f, d) with d · vector = rest + Σ f_k · row_k, and no pivot in the rest."""
        rest, divisor = dict(vector), self.ring.one
        factors: list[Expr] = []
        for row in self._rows:
            value = rest.get(row.pivot)
            if value is None:
                factors.append(self.ring.zero)
                continue
            factor = _quotient(value, row.values[row.pivot])
            if factor is None:
                pivot, factor = row.values[row.pivot], value
                rest = {key: entry * pivot for key, entry in rest.items()}
                factors = [other * pivot for other in factors]
                divisor = divisor * pivot
            rest = _less(rest, factor, row.values)
            factors.append(factor)
        return rest, factors, divisor
