"""The Fourier form: a polynomial in sines and cosines as Σ aₙ cos(n·α) + bₙ sin(n·α).

α = (α₁, α₂, …) are basic angles and n are integers, so n·α is an angle such as
2α₁ - α₂.  Every product of powers of sines and cosines is such a sum, by

    cos α = (e^{iα} + e^{-iα}) / 2,   sin α = (e^{iα} - e^{-iα}) / 2i.

It is unique, so it shows what a polynomial is: s₁c₁ = ½ sin 2α₁, and with α₁ = θ₂,
α₂ = θ₂ + θ₃ it is the form in which c₂c₂₃ + s₂s₂₃ becomes cos(α₂ - α₁) = c₃.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from fractions import Fraction

Multiples = tuple[int, ...]
"""An angle as integer multiples n of the basic angles."""

Powers = tuple[int, ...]
"""Of a product of powers: those of sin α₁, cos α₁, sin α₂, cos α₂, …"""

TrigFunction = tuple[str, Multiples]
"""`sin` or `cos`, of the angle n·α."""

FourierForm = dict[Multiples, tuple[Fraction, Fraction]]
"""{n: (aₙ, bₙ)}; of n and -n the one whose last multiple that is not 0 is positive: θ₃ - θ₂."""

_Exponentials = dict[Multiples, tuple[int, int]]
"""Σ (x + iy) e^{i n·α}: {n: (x, y)}"""


def fourier_form(polynomial: Mapping[Powers, int | Fraction]) -> FourierForm:
    """The Fourier form of Σ factor · Π sin^a cos^b, given as {exponents: factor}.

    >>> fourier_form({(1, 1): 1})
    {(2,): (Fraction(0, 1), Fraction(1, 2))}
    >>> fourier_form({(0, 1, 0, 1): 1, (1, 0, 1, 0): 1})
    {(-1, 1): (Fraction(1, 1), Fraction(0, 1))}
    """
    total: dict[Multiples, list[Fraction]] = {}
    for exponents, factor in polynomial.items():
        share = Fraction(factor, 2 ** sum(exponents))
        for n, (x, y) in _exponentials(exponents).items():
            entry = total.setdefault(n, [Fraction(0), Fraction(0)])
            # x + iy at n comes with x - iy at -n; together they are 2x cos(n·α) - 2y sin(n·α).
            twice = 2 if any(n) else 1
            entry[0] += twice * x * share
            entry[1] -= twice * y * share
    return {n: (a, b) for n, (a, b) in total.items() if a or b}


def terms_of(form: FourierForm) -> Iterator[tuple[TrigFunction, Fraction]]:
    """The terms of a Fourier form, each a sine or cosine with its factor; a constant is that of cos 0."""
    for n, (a, b) in form.items():
        if a:
            yield ("cos", n), a
        if b:
            yield ("sin", n), b


def positive(n: Multiples) -> tuple[int, Multiples]:
    """(sign, ±n) with the last multiple that is not 0 positive: θ₃ - θ₂ and not θ₂ - θ₃."""
    last = next((x for x in reversed(n) if x), 1)
    return (1, n) if last > 0 else (-1, tuple(-x for x in n))


def _exponentials(exponents: Powers) -> _Exponentials:
    """2^Σexponents Π sin^a cos^b in exponentials, those at `positive` n alone."""
    product: _Exponentials = {(0,) * (len(exponents) // 2): (1, 0)}
    for k, exponent in enumerate(exponents):
        for _ in range(exponent):
            product = _times(product, k // 2, sine=not k % 2)
    return {n: value for n, value in product.items() if positive(n)[0] > 0}


def _times(product: _Exponentials, j: int, *, sine: bool) -> _Exponentials:
    """The product with 2 cos αⱼ = z + 1/z, or with 2 sin αⱼ = (z - 1/z)/i, where z = e^{iαⱼ}."""
    result: _Exponentials = {}
    for n, (x, y) in product.items():
        for step in (1, -1):
            shifted = (*n[:j], n[j] + step, *n[j + 1 :])
            re, im = (y * step, -x * step) if sine else (x, y)
            before = result.get(shifted, (0, 0))
            result[shifted] = (before[0] + re, before[1] + im)
    return {n: value for n, value in result.items() if value != (0, 0)}
