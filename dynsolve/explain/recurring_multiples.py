"""Sums that are multiples of each other: 4κ s c + m = 2 (2κ s c + m/2), and c (2κ s + m c) = 2κ s c + m c².

Sums are compared as polynomials in what their terms are products of.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from fractions import Fraction
from math import gcd, lcm

from dynsolve.notation.build import split_sign, times
from dynsolve.notation.printing import flat_factors
from dynsolve.notation.tree import Function, Node, Number, Power, Product, Quotient, Symbol

_Monomial = frozenset[tuple[Node, int]]
_Key = frozenset[tuple[_Monomial, Fraction]]

LONGEST = 6
"""Up to this number of terms a sum is multiplied out: a longer one is no part of a product that recurs."""


class Multiples:
    """The sums that have a placeholder, up to rational factors."""

    def __init__(self, decimal: bool) -> None:
        self.decimal = decimal
        self._known: dict[_Key, tuple[Symbol, Fraction]] = {}
        self.smallest: dict[Symbol, Fraction] = {}
        """Of a placeholder of which there is a part, ½ of it or less, the smallest."""

    def add(self, name: Symbol, terms: Sequence[Node]) -> None:
        """Remember what a placeholder stands for."""
        key, content = _primitive(map(_monomial, terms))
        self._known.setdefault(key, (name, content))

    def found(self, terms: Iterable[tuple[_Monomial, Fraction]]) -> Node | None:
        """A sum as a rational multiple of one that has a placeholder."""
        key, content = _primitive(terms)
        for sign in (1, -1):
            known = self._known.get(key if sign > 0 else frozenset((mono, -f) for mono, f in key))
            if known is not None:
                name, own = known
                if content < own:
                    self.smallest[name] = min(content / own, self.smallest.get(name, Fraction(1)))
                return times(sign * content / own, [(name, 1)], decimal=self.decimal)
        return None

    def of_sum(self, terms: Sequence[Node]) -> Node | None:
        """The same of the terms of a sum."""
        return self.found(map(_monomial, terms))

    def in_product(self, product: Product, terms: dict[Symbol, tuple[Node, ...]]) -> Node | None:
        """A product of a sine or cosine and a sum as the placeholder of both, multiplied out."""
        factors = flat_factors(product)
        angles = [factor for factor in factors if isinstance(factor, Function)]
        sums = [factor for factor in factors if isinstance(factor, Symbol) and factor in terms]
        for name in sums:
            if len(terms[name]) > LONGEST:
                continue
            for angle in angles:
                both = self.found((_times(mono, angle), f) for mono, f in map(_monomial, terms[name]))
                if both is not None:
                    rest = list(factors)
                    rest[rest.index(name)] = both
                    rest.remove(angle)
                    return times(1, [(factor, 1) for factor in rest], decimal=self.decimal)
        return None


def _primitive(terms: Iterable[tuple[_Monomial, Fraction]]) -> tuple[_Key, Fraction]:
    """(terms with coprime whole factors, what they were divided by)"""
    found = list(terms)
    content = Fraction(gcd(*(f.numerator for _, f in found)), lcm(*(f.denominator for _, f in found)))
    return frozenset((mono, f / content) for mono, f in found), content


def _monomial(term: Node) -> tuple[_Monomial, Fraction]:
    """A term as (its factors with their exponents, its number)."""
    sign, inner = split_sign(term)
    number = Fraction(sign)
    if isinstance(inner, Quotient) and isinstance(inner.denominator, Number):
        number /= Fraction(inner.denominator.p, inner.denominator.q)
        inner = inner.numerator
    exponents: dict[Node, int] = {}
    for factor in flat_factors(inner) if isinstance(inner, Product) else (inner,):
        match factor:
            case Number(p, q):
                number *= Fraction(p, q)
            case Power(base, Number(p, 1)):
                exponents[base] = exponents.get(base, 0) + p
            case _:
                exponents[factor] = exponents.get(factor, 0) + 1
    return frozenset(exponents.items()), number


def _times(mono: _Monomial, factor: Node) -> _Monomial:
    exponents = dict(mono)
    exponents[factor] = exponents.get(factor, 0) + 1
    return frozenset(exponents.items())
