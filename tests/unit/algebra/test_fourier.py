"""The Fourier form: the same function, unique, and every angle with one sign."""

from __future__ import annotations

import math
from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st

from dynsolve.algebra.ring import FourierForm, fourier_form, positive, terms_of

ANGLES = (0.7, -1.3)


def value(form: FourierForm) -> float:
    total = 0.0
    for (name, n), factor in terms_of(form):
        total += float(factor) * getattr(math, name)(sum(k * a for k, a in zip(n, ANGLES, strict=True)))
    return total


powers = st.tuples(*[st.integers(0, 3)] * 4)
polynomials = st.dictionaries(powers, st.integers(-5, 5).filter(bool), max_size=5)


@given(polynomials)
def test_it_is_the_same_function(poly: dict[tuple[int, ...], int]) -> None:
    functions = [f(a) for a in ANGLES for f in (math.sin, math.cos)]
    plain = sum(f * math.prod(x**e for x, e in zip(functions, es, strict=True)) for es, f in poly.items())
    assert value(fourier_form(poly)) == pytest.approx(plain, abs=1e-9)


@given(polynomials)
def test_every_angle_has_one_sign(poly: dict[tuple[int, ...], int]) -> None:
    assert all(positive(n) == (1, n) for n in fourier_form(poly))


def test_what_is_equal_has_one_form() -> None:
    one_minus_sine_squared, cosine_squared = {(0, 0): 1, (2, 0): -1}, {(0, 2): 1}
    assert fourier_form(one_minus_sine_squared) == fourier_form(cosine_squared)
    half = Fraction(1, 2)
    assert fourier_form(cosine_squared) == {(0,): (half, 0), (2,): (half, 0)}
