"""Every dress is the same function; constant angles are written as a person writes them."""

from __future__ import annotations

import math
from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st

from dynsolve.algebra.compact.constant_forms import ConstantDresses
from dynsolve.algebra.compact.trig_forms import Dress, Poly, dresses

ANGLES = (0.7, -1.3)


def value(dress: Dress, delta: float = 0.0) -> float:
    total = 0.0
    for monomial, factor in dress.items():
        term = float(factor)
        for (name, turns), exponent in monomial:
            if name == "sqrt":
                term *= math.sqrt(turns[0]) ** exponent
            else:
                angle = delta * turns[0] if delta else sum(t * a for t, a in zip(turns, ANGLES, strict=True))
                term *= getattr(math, name)(angle) ** exponent
        total += term
    return total


def plain_value(poly: Poly) -> float:
    waves = [f(a) for a in ANGLES for f in (math.sin, math.cos)]
    return sum(
        float(f) * math.prod(w**e for w, e in zip(waves, exponents, strict=True))
        for exponents, f in poly.items()
    )


powers = st.tuples(st.integers(0, 1), st.integers(0, 3), st.integers(0, 1), st.integers(0, 3))
polynomials = st.dictionaries(powers, st.integers(-5, 5).filter(bool), min_size=1, max_size=5)


@given(polynomials)
def test_every_dress_is_the_same_function(poly: Poly) -> None:
    for dress in dresses(poly):
        assert value(dress) == pytest.approx(plain_value(poly), abs=1e-9)


@pytest.mark.parametrize(
    ("poly", "waves"),
    [
        ({(0, 2, 0, 0): 2, (0, 0, 0, 0): -1}, "cos(2,0)"),
        ({(1, 1, 0, 0): 2}, "sin(2,0)"),
        ({(1, 0, 1, 0): 1, (0, 1, 0, 1): 1}, "cos(-1,1)"),
        ({(1, 0, 0, 1): 1, (0, 1, 1, 0): 1}, "sin(1,1)"),
    ],
)
def test_what_is_one_wave_is_found(poly: Poly, waves: str) -> None:
    single = [
        f"{name}({','.join(map(str, turns))})"
        for dress in dresses(poly)
        if len(dress) == 1
        for monomial in dress
        for (name, turns), _ in monomial
    ]
    assert waves in single


@given(
    st.sampled_from([10, 5, 18, 9]),
    st.dictionaries(st.integers(0, 5), st.integers(-4, 4).filter(bool), min_size=1),
)
def test_constant_dresses_are_the_same_number(degrees: int, powers: dict[int, int]) -> None:
    write = ConstantDresses(Fraction(degrees))
    delta = math.radians(degrees)
    number = sum(f * math.cos(delta) ** k for k, f in powers.items())
    for dress in write({(k,): f for k, f in powers.items()}):
        assert value(dress, delta) == pytest.approx(number, abs=1e-9)
