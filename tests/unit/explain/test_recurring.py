"""What stands in several places gets a name where that saves enough."""

from __future__ import annotations

from itertools import count

import pytest

from dynsolve.explain.recurring import name_recurring
from dynsolve.notation.python import to_python
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


# entries -> meanings of the names, entries with them
MULTIPLES = [
    (  # twice a sum is written by it, whichever comes first
        ("x*(4*k*s + m*p*s*t)", "y*(2*k*s + m*p*s*t/2)"),
        (["2*k*s + m*p*s*t/2"], ["2*x*h1", "y*h1"]),
    ),
    (  # c (2 k s + m c), with s = sin q and c = cos q
        ("x*(2*k*sin(q)*cos(q) + m*cos(q)^2)", "y*cos(q)*(2*k*sin(q) + m*cos(q))"),
        (["2*k*sin(q)*cos(q) + m*cos(q)**2"], ["x*h1", "y*h1"]),
    ),
]


@pytest.mark.parametrize(("entries", "named"), MULTIPLES)
def test_a_multiple_of_a_sum_has_no_name_of_its_own(
    entries: tuple[str, ...], named: tuple[list[str], list[str]]
) -> None:
    names = (Symbol(f"h{k}") for k in count(1))
    definitions, used = name_recurring([read(entry).tree for entry in entries], names, whole=False)
    assert ([to_python(one.meaning) for one in definitions], list(map(to_python, used))) == named
