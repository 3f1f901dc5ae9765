"""Polynomials in atoms as dictionaries {monomial: factor}: products, common factors, recurring sums.

A monomial is a sorted tuple of (number of an atom, exponent); see `atoms`.
"""

from __future__ import annotations

from collections.abc import Iterable
from fractions import Fraction
from math import gcd, lcm

from dynsolve.algebra.compact.terms import Rational, exact, primitive

Monomial = tuple[tuple[int, int], ...]
Polynomial = dict[Monomial, Rational]


def multiply(left: Monomial, right: Monomial) -> Monomial:
    """The product of two monomials."""
    exponents = dict(left)
    for atom, exponent in right:
        exponents[atom] = exponents.get(atom, 0) + exponent
    return tuple(sorted((a, e) for a, e in exponents.items() if e))


def divide(mono: Monomial, by: Monomial) -> Monomial:
    """mono / by"""
    return multiply(mono, tuple((atom, -exponent) for atom, exponent in by))


def common(monos: Iterable[Monomial]) -> Monomial:
    """The largest monomial that divides all; an inverse is common where all have it."""
    monos = list(monos)
    first = dict(monos[0])
    for mono in monos[1:]:
        other = dict(mono)
        for atom in list(first):
            exponent = other.get(atom, 0)
            mine = first[atom]
            if mine > 0 and exponent > 0:
                first[atom] = min(mine, exponent)
            elif mine < 0 and exponent < 0:
                first[atom] = max(mine, exponent)
            else:
                del first[atom]
    return tuple(sorted(first.items()))


def content(factors: Iterable[Rational]) -> Rational:
    """The factor worth drawing out: the common divisor of whole numbers, and a denominator if all have one.

    The denominator must be a multiple of the others: (m₁ + 2 m₂)/4, but a/2 + b/3 and h + d/2 + l/2.
    """
    factors = list(factors)
    shared = gcd(*(f.numerator for f in factors))
    if set(map(type, factors)) <= {int}:
        return shared
    denominators = {f.denominator for f in factors}
    largest = max(denominators)
    if 1 in denominators or any(largest % d for d in denominators):
        return 1
    return Fraction(shared, largest)


def whole_content(factors: Iterable[Rational]) -> Rational:
    """The content that leaves coprime whole numbers: of 1 and 1/2 it is 1/2."""
    factors = list(factors)
    return exact(gcd(*(f.numerator for f in factors)), lcm(*(f.denominator for f in factors)))


def joined_pair(poly: Polynomial) -> tuple[int, int, Rational] | None:
    """(x, y, r) where the polynomial is one in x + r·y: ∂/∂y = r ∂/∂x, and not merely linear in them."""
    atoms = sorted({atom for mono in poly for atom, e in mono if e > 0})
    slopes = {atom: _derivative(poly, atom) for atom in atoms}
    candidates: dict[object, tuple[int, Rational]] = {}
    for atom, part in slopes.items():
        if len(part) > 1:
            key, scale = primitive(part)
            if key in candidates:
                first, other = candidates[key]
                return first, atom, exact(scale, other)
            candidates[key] = atom, scale
    return None


def _derivative(poly: Polynomial, atom: int) -> Polynomial:
    """∂poly/∂atom"""
    result: Polynomial = {}
    for mono, f in poly.items():
        for a, e in mono:
            if a == atom:
                result[divide(mono, ((a, 1),))] = f * e
    return result


def join(poly: Polynomial, x: int, y: int, whole: int) -> Polynomial:
    """A polynomial in x + r·y, with y put to 0 and x replaced by the atom `whole`."""
    result: Polynomial = {}
    for mono, f in poly.items():
        exponents = dict(mono)
        if y in exponents:
            continue
        if x in exponents:
            exponents[whole] = exponents.pop(x)
        result[tuple(sorted(exponents.items()))] = f
    return result
