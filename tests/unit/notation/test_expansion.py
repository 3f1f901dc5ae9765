"""Products of sums, multiplied out."""

from __future__ import annotations

import pytest

from dynsolve.notation.differentiation import by_rates, multiplied_out
from dynsolve.notation.text import read
from dynsolve.notation.tree import Symbol, mapped
from dynsolve.notation.unicode import to_unicode

CASES = """
m*(a + b*cos(q))*(c + sin(q)) | m (a c + a sin(q) + b c cos(q) + b sin(q) cos(q))
(a - cos(q))*(b - sin(q))     | a b - a sin(q) - b cos(q) + sin(q) cos(q)
k*(a + b)*(a + cos(q))        | k (a + b)(a + cos(q))
(a + cos(q))^2                | (a + cos(q))²
"""


@pytest.mark.parametrize("case", CASES.strip().splitlines())
def test_products_of_sums_of_sines_and_cosines_alone(case: str) -> None:
    before, after = (part.strip() for part in case.split("|"))
    assert to_unicode(multiplied_out(read(before).tree)) == after


RATES = """
m*(u + v)^2 + I*u*v      | m u̇² + (2m + I) u̇ v̇ + m v̇²
m*(2*u - v)^2/2          | 2m u̇² - 2m u̇ v̇ + m v̇²/2
m*u*(u - v)/2 - k*v*u    | m u̇²/2 - (m/2 + k) u̇ v̇
"""


@pytest.mark.parametrize("case", RATES.strip().splitlines())
def test_squares_and_fractions_of_sums_of_rates(case: str) -> None:
    before, after = (part.strip() for part in case.split("|"))
    moving = mapped(
        read(before).tree, lambda part: Symbol(part.name, 1) if part in (Symbol("u"), Symbol("v")) else part
    )
    assert to_unicode(by_rates(moving)) == after
