"""Every form is the same function; constant angles are written as a person writes them."""

from __future__ import annotations

import math
from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st

from dynsolve.algebra.compact.trig_forms import ConstantForms, TrigForm, TrigPolynomial, trig_forms

ANGLES = (0.7, -1.3)


def value(form: TrigForm, delta: float = 0.0) -> float:
    total = 0.0
    for monomial, factor in form.items():
        term = float(factor)
        for (name, multiples), exponent in monomial:
            if name == "sqrt":
                term *= math.sqrt(multiples[0]) ** exponent
            else:
                angle = (
                    delta * multiples[0]
                    if delta
                    else sum(t * a for t, a in zip(multiples, ANGLES, strict=True))
                )
                term *= getattr(math, name)(angle) ** exponent
        total += term
    return total


def plain_value(poly: TrigPolynomial) -> float:
    functions = [f(a) for a in ANGLES for f in (math.sin, math.cos)]
    return sum(
        float(f) * math.prod(w**e for w, e in zip(functions, exponents, strict=True))
        for exponents, f in poly.items()
    )


powers = st.tuples(st.integers(0, 1), st.integers(0, 3), st.integers(0, 1), st.integers(0, 3))
polynomials = st.dictionaries(powers, st.integers(-5, 5).filter(bool), min_size=1, max_size=5)


@given(polynomials)
def test_every_form_is_the_same_function(poly: TrigPolynomial) -> None:
    for form in trig_forms(poly):
        assert value(form) == pytest.approx(plain_value(poly), abs=1e-9)


@pytest.mark.parametrize(
    ("poly", "function"),
    [
        ({(0, 2, 0, 0): 2, (0, 0, 0, 0): -1}, "cos(2,0)"),
        ({(1, 1, 0, 0): 2}, "sin(2,0)"),
        ({(1, 0, 1, 0): 1, (0, 1, 0, 1): 1}, "cos(-1,1)"),
        ({(1, 0, 0, 1): 1, (0, 1, 1, 0): 1}, "sin(1,1)"),
    ],
)
def test_what_is_one_sine_or_cosine_is_found(poly: TrigPolynomial, function: str) -> None:
    single = [
        f"{name}({','.join(map(str, multiples))})"
        for form in trig_forms(poly)
        if len(form) == 1
        for monomial in form
        for (name, multiples), _ in monomial
    ]
    assert function in single


@given(
    st.sampled_from([10, 5, 18, 9]),
    st.dictionaries(st.integers(0, 5), st.integers(-4, 4).filter(bool), min_size=1),
)
def test_constant_forms_are_the_same_number(degrees: int, powers: dict[int, int]) -> None:
    write = ConstantForms(Fraction(degrees))
    delta = math.radians(degrees)
    number = sum(f * math.cos(delta) ** k for k, f in powers.items())
    for form in write({(k,): f for k, f in powers.items()}):
        assert value(form, delta) == pytest.approx(number, abs=1e-9)
