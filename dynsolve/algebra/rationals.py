"""Rational numbers: Python's `Fraction` and FLINT's `fmpq`, and the greatest common divisor of several."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from math import gcd, lcm
from typing import Any

from flint import fmpq


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
