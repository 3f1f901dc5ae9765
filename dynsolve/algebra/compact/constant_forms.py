"""The forms of polynomials in cos δ, the generator of a problem's constant angles.

4 cos³10° - 3 cos 10° is √3/2, and 1 - 2 cos²40° is -sin 10°: a polynomial in cos δ is a
vector in the powers below the degree of its minimal polynomial, and so is every
cos jδ.  A multiple of one of these, or a sum of two, is what a person writes.
"""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction
from itertools import combinations
from math import comb

from flint import fmpq, fmpq_poly, fmpz_poly

from dynsolve.algebra.compact.terms import exact
from dynsolve.algebra.compact.trig_forms import TrigForm, TrigMonomial, TrigPolynomial
from dynsolve.algebra.integer_basis import coordinates_in
from dynsolve.algebra.rationals import fraction, rational

_KNOWN: dict[Fraction, tuple[TrigMonomial, Fraction]] = {
    Fraction(0): ((), Fraction(1)),
    Fraction(60): ((), Fraction(1, 2)),
    Fraction(30): (((("sqrt", (3,)), 1),), Fraction(1, 2)),
    Fraction(45): (((("sqrt", (2,)), 1),), Fraction(1, 2)),
}
"""Cosines that are written without an angle."""


class ConstantForms:
    """Writes polynomials {(k,): factor} in powers of cos δ; δ in degrees.

    >>> ten = ConstantForms(Fraction(10))
    >>> ten({(3,): 4, (1,): -3})
    [{((('sqrt', (3,)), 1),): Fraction(1, 2)}]
    """

    def __init__(self, delta: Fraction) -> None:
        self.delta = delta
        halves = fmpz_poly.cos_minpoly(int(360 / delta))
        self._relation = fmpq_poly(halves)(fmpq_poly([0, 2]))
        self._degree = int(halves.degree())
        self._cosines = [(self._name(j), self._vector(self._chebyshev(j))) for j in range(int(90 / delta))]

    def __call__(self, poly: TrigPolynomial) -> list[TrigForm]:
        """The shortest form: one cosine, two, or the sum over all powers."""
        vector = self._vector(fmpq_poly(self._dense(poly)))
        for count in (1, 2):
            found = next(self._combinations(vector, count), None)
            if found is not None:
                return [found]
        return [self._fourier(poly)]

    def _dense(self, poly: TrigPolynomial) -> list[fmpq]:
        dense = [fmpq(0)] * (max(k for (k,) in poly) + 1)
        for (k,), factor in poly.items():
            dense[k] = rational(factor)
        return dense

    def _vector(self, polynomial: fmpq_poly) -> tuple[Fraction, ...]:
        rest = polynomial % self._relation
        coefficients = [fraction(c) for c in rest.coeffs()]
        return (*coefficients, *(Fraction(0) for _ in range(self._degree - len(coefficients))))

    @staticmethod
    def _chebyshev(j: int) -> fmpq_poly:
        return fmpq_poly(fmpz_poly.chebyshev_t(j))

    def _name(self, j: int) -> tuple[TrigMonomial, Fraction]:
        """cos jδ as it is written: by a root, or as the sine of the complement above 45°."""
        angle = self.delta * j
        if angle in _KNOWN:
            return _KNOWN[angle]
        if angle > 45:
            return ((("sin", (int(90 / self.delta) - j,)), 1),), Fraction(1)
        return ((("cos", (j,)), 1),), Fraction(1)

    def _combinations(self, vector: tuple[Fraction, ...], count: int) -> Iterator[TrigForm]:
        for chosen in combinations(self._cosines, count):
            factors = coordinates_in([v for _, v in chosen], vector)
            if factors is not None and all(factors):
                yield {
                    mono: exact(f * scale, 1) for ((mono, scale), _), f in zip(chosen, factors, strict=True)
                }

    def _fourier(self, poly: TrigPolynomial) -> TrigForm:
        """Σ cos jδ by cos^k δ = 2^-k Σ_i C(k, i) cos (k - 2i)δ."""
        form: TrigForm = {}
        for (k,), factor in poly.items():
            for i in range(k + 1):
                mono, scale = self._name(abs(k - 2 * i))
                total = form.get(mono, 0) + factor * scale * Fraction(comb(k, i), 2**k)
                form[mono] = exact(total, 1)
        return {mono: factor for mono, factor in form.items() if factor}
