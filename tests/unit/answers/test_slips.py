"""Every slip of the table that has an example is recognized in it."""

from __future__ import annotations

import pytest

from dynsolve.answers.slips.table import SLIPS, Slip
from tests.unit.answers.hands import codes, judged

WITH_EXAMPLES = [slip for slip in SLIPS.values() if slip.example]


@pytest.mark.parametrize("slip", WITH_EXAMPLES, ids=lambda slip: slip.code)
def test_the_example_of_a_slip_shows_it(slip: Slip) -> None:
    example = slip.example
    assert example is not None
    answer = judged(example.problem, example.name, example.value, **example.beside)
    assert answer.verdict == "wrong"
    assert slip.code in codes(answer)
