"""What stands in several places gets a name where that saves enough."""

from __future__ import annotations

from itertools import count

import pytest

from dynsolve.explain.recurring import name_recurring
from dynsolve.notation.text import read
from dynsolve.notation.tree import Product, Symbol

PAIR = "2*k*s*c + m*c^2"
"""A sum of six operations and no more."""


@pytest.mark.parametrize(
    ("meaning", "times", "whole", "named"),
    [
        (PAIR, 2, True, False),
        (PAIR, 4, True, True),
        (PAIR, 2, False, True),
        ("a + b", 20, True, False),
    ],
)
def test_a_name_in_a_long_model_must_save_more(meaning: str, times: int, whole: bool, named: bool) -> None:
    node = read(meaning).tree
    entries = [Product((Symbol(f"x{place}"), node)) for place in range(times)]
    definitions, _ = name_recurring(entries, (Symbol(f"h{k}") for k in count(1)), whole=whole)
    assert bool(definitions) is named
