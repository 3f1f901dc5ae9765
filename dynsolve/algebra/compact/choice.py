"""Choosing the form of each of many small trigonometric polynomials.

The shortest form of one may be dear for the whole: a product of sines and cosines that
other coefficients are written with already costs only its own coefficient.  So the
shortest form is taken for each, and then chosen again, one after the other, at the prices
that the forms of the others make: beside l² c₂² it is b² (2 - c₂²) and not b² (1 + s₂²).
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Mapping
from typing import NamedTuple

from dynsolve.algebra.compact.terms import Exponents, Rational, primitive
from dynsolve.algebra.compact.trig_forms import TrigForm, TrigMonomial, TrigPolynomial, trig_forms
from dynsolve.algebra.fourier import Multiples

TERM = 3.0
"""What a term costs besides its sines and cosines: a sign, a product and a coefficient."""

SHARED = 0.75
"""The part of the price of sines and cosines that is saved where another coefficient stands at them too."""


class _Option(NamedTuple):
    """A form, its price, and the share of the price for the sines and cosines of each term."""

    items: tuple[tuple[TrigMonomial, Rational], ...]
    price: float
    trig_prices: tuple[float, ...]


class FormChoice:
    """Chooses among the forms that `forms` gives of a polynomial.

    The forms of every polynomial met so far are kept, up to a rational factor: the
    entries of D, C and the torques share a few dozen, and PUMA 560 would take 70 %
    longer without.
    """

    def __init__(self, forms: Callable[[TrigPolynomial], list[TrigForm]] = trig_forms) -> None:
        self._forms = forms
        self._made: dict[frozenset[tuple[Exponents, Rational]], list[_Option]] = {}

    def choose(
        self, polynomials: Mapping[Exponents, TrigPolynomial]
    ) -> dict[Exponents, list[tuple[TrigMonomial, Rational]]]:
        """The chosen form of each polynomial as (monomial, factor).

        The keys are the monomials in parameters whose coefficients the polynomials are.
        """
        options = {key: self._options(polynomial) for key, polynomial in polynomials.items()}
        chosen = {key: made[0] for key, (made, _) in options.items()}
        uses = Counter(mono for option in chosen.values() for mono, _ in option.items)
        for key, (made, _) in options.items():
            if len(made) > 1:
                uses.subtract(mono for mono, _ in chosen[key].items)
                chosen[key] = min(made, key=lambda option: _price_beside(option, uses))
                uses.update(mono for mono, _ in chosen[key].items)
        return {key: [(m, f * options[key][1]) for m, f in option.items] for key, option in chosen.items()}

    def _options(self, polynomial: TrigPolynomial) -> tuple[list[_Option], Rational]:
        """(forms, the cheapest first; the factor they are to be multiplied with)"""
        if len(polynomial) == 1:
            ((exponents, scale),) = polynomial.items()
            key: frozenset[tuple[Exponents, Rational]] = frozenset(((exponents, 1),))
        else:
            key, scale = primitive(polynomial)
        made = self._made.get(key)
        if made is None:
            made = self._made[key] = sorted(map(_option, self._forms(dict(key))), key=lambda o: o.price)
        return made, scale


def _option(form: TrigForm) -> _Option:
    trig_prices = tuple(
        float(sum(2 + _angle_price(multiples) + (e > 1) for (_, multiples), e in mono)) for mono in form
    )
    odd = sum(0.5 * (abs(f) != 1) + (f.denominator != 1) for f in form.values())
    return _Option(tuple(form.items()), TERM * len(form) + sum(trig_prices) + odd, trig_prices)


def _price_beside(option: _Option, uses: Counter[TrigMonomial]) -> float:
    """The price where other coefficients are written with some monomials."""
    terms = zip(option.items, option.trig_prices, strict=True)
    return option.price - SHARED * sum(price for (mono, _), price in terms if uses[mono])


def _angle_price(multiples: Multiples) -> int:
    """The operations inside sin( ): 1 for θ₂ + θ₃ and for 2θ₂."""
    return sum(1 + (abs(m) != 1) for m in multiples if m) - 1
