"""Products as books write them: numbers and signs in front."""

from __future__ import annotations

import pytest

from dynsolve.notation.build import times
from dynsolve.notation.text import read
from dynsolve.notation.tree import Node
from dynsolve.notation.unicode import UnicodePrinter


def tree(text: str) -> Node:
    return read(text).tree


@pytest.mark.parametrize(
    ("coefficient", "factors", "written"),
    [
        (1, [("2", -1), ("3*(a + b)", -1)], "1/(6(a + b))"),
        (3, [("x", 1), ("6*y", -1)], "x/(2y)"),
        (1, [("2*x", 2)], "4x²"),
        (1, [("2*x*y", -1), ("4*z", 1)], "2z/(x y)"),
        (-1, [("a - b", -1)], "-1/(a - b)"),
    ],
)
def test_numbers_of_all_factors_are_one(
    coefficient: int, factors: list[tuple[str, int]], written: str
) -> None:
    node = times(coefficient, [(tree(text), power) for text, power in factors])
    assert UnicodePrinter().text(node) == written
