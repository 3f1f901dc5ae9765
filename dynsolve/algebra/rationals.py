"""Rational numbers: Python's `Fraction`, FLINT's `fmpq`, trees made of numbers, divisors and roots."""

from __future__ import annotations

from collections.abc import Callable, Container, Sequence
from fractions import Fraction
from math import gcd, isqrt, lcm
from typing import Any

from flint import fmpq

from dynsolve.notation.tree import Negative, Node, Number, Parenthesized, Power, Product, Quotient, Sum

LARGEST_POWER = 20
"""The largest exponent in a tree that counts as a number."""


def rational(value: int | Fraction) -> fmpq:
    """A rational number as FLINT's."""
    return fmpq(value) if isinstance(value, int) else fmpq(value.numerator, value.denominator)


def fraction(value: Any) -> Fraction:
    """A rational number of FLINT's as Python's."""
    return Fraction(int(value.p), int(value.q))


def rational_gcd(values: Sequence[Fraction]) -> Fraction:
    """The largest rational of which every value is an integer multiple.

    >>> rational_gcd([Fraction(10), Fraction(25)])
    Fraction(5, 1)
    """
    scale = lcm(*(v.denominator for v in values))
    return Fraction(gcd(*(int(v * scale) for v in values)), scale)


def rational_value(node: Node) -> Fraction | None:
    """The value of a tree made of numbers alone, else None; large powers count as None."""
    match node:
        case Number(p, q):
            return Fraction(p, q)
        case Negative(argument):
            value = rational_value(argument)
            return None if value is None else -value
        case Parenthesized(argument):
            return rational_value(argument)
        case Sum(terms):
            return _folded(terms, lambda a, b: a + b, Fraction(0))
        case Product(factors):
            return _folded(factors, lambda a, b: a * b, Fraction(1))
        case Quotient(numerator, denominator):
            top, bottom = rational_value(numerator), rational_value(denominator)
            return None if top is None or not bottom else top / bottom
        case Power(base, Number(p, 1)) if p <= LARGEST_POWER:
            value = rational_value(base)
            return None if value is None else value**p
    return None


def _folded(
    parts: tuple[Node, ...], operation: Callable[[Fraction, Fraction], Fraction], start: Fraction
) -> Fraction | None:
    total = start
    for part in parts:
        value = rational_value(part)
        if value is None:
            return None
        total = operation(total, value)
    return total


def rational_sqrt(value: Fraction) -> Fraction | None:
    """The square root of a number that is not negative, None where it is not rational.

    >>> rational_sqrt(Fraction(9, 4)), rational_sqrt(Fraction(2))
    (Fraction(3, 2), None)
    """
    if value < 0:
        return None
    above, below = isqrt(value.numerator), isqrt(value.denominator)
    return Fraction(above, below) if Fraction(above, below) ** 2 == value else None


FEWEST_DIGITS = 3
"""A decimal with fewer significant digits is exact."""


def half_unit(value: Fraction, exact: Container[Fraction] = ()) -> Fraction | None:
    """Half a unit of the last place of a decimal that stands for all that round to it; None of another."""
    places = _places(value)
    if not places or value in exact:
        return None
    digits = len(str(abs(value.numerator) * 10**places // value.denominator))
    return Fraction(1, 2 * 10**places) if digits >= FEWEST_DIGITS else None


def _places(value: Fraction) -> int:
    """How many decimals a number was written with, at least; 0 for one that was no decimal."""
    q, places = value.denominator, 0
    if q == 1:
        return 0
    while q % 10 == 0:
        q, places = q // 10, places + 1
    twos = fives = 0
    while q % 2 == 0:
        q, twos = q // 2, twos + 1
    while q % 5 == 0:
        q, fives = q // 5, fives + 1
    return places + max(twos, fives) if q == 1 else 0
