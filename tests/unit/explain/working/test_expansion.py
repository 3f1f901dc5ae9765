"""Products of sums, multiplied out."""

from __future__ import annotations

import pytest

from dynsolve.explain.working.expansion import multiplied_out
from dynsolve.notation.text import read
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
