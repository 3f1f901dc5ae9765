"""Products as books write them: numbers and signs in front."""

from __future__ import annotations

from fractions import Fraction

import pytest

from dynsolve.notation.build import times, total
from dynsolve.notation.printing import Style
from dynsolve.notation.text import read
from dynsolve.notation.tree import Negative, Node, Product, Symbol
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
        (Fraction(1, 4), [("sqrt(3)", 2), ("b", 1)], "3b/4"),
    ],
)
def test_numbers_of_all_factors_are_one(
    coefficient: Fraction | int, factors: list[tuple[str, int]], written: str
) -> None:
    node = times(coefficient, [(tree(text), power) for text, power in factors])
    assert UnicodePrinter().text(node) == written


def test_what_is_made_of_a_decimal_is_one() -> None:
    own, rate = times(Fraction(1, 2), [(tree("x"), 2)], decimal=True), Symbol("q", 2)
    printed = UnicodePrinter().text
    assert printed(times(1, [(own, 1), (rate, 1)])) == "0.5 x² q̈"
    assert printed(times(1, [(times(-1, [(own, 1)]), 1), (rate, 1)])) == "-0.5 x² q̈"
    assert printed(times(2, [(own, 1), (rate, 1)])) == "x² q̈"


def test_beside_fractions_and_roots_halves_are_fractions() -> None:
    def term(factor: Fraction, *names: str) -> Node:
        return times(factor, [(tree(name), 1) for name in names], decimal=True)

    printed = UnicodePrinter(Style(decimal=True)).text
    third, quarter, other = term(Fraction(1, 12)), term(Fraction(-1, 4), "x"), term(Fraction(7, 20), "y")
    assert printed(total([third, quarter, other])) == "1/12 - x/4 + 0.35 y"
    assert printed(total([quarter, other])) == "0.35 y - 0.25 x"
    assert printed(total([third, term(Fraction(5, 2), "x")])) == "1/12 + 2.5 x", "2.5 elsewhere, too"
    assert printed(term(Fraction(3, 4), "sqrt(2)", "x")) == "3√2 x/4"


def test_accelerations_stay_in_their_order() -> None:
    d12, first, second = tree("-(a + b)"), Symbol("q1", 2), Symbol("q2", 2)
    terms = [times(1, [(d12, 1), (first, 1)]), Product((tree("c"), second)), Symbol("g")]
    assert UnicodePrinter().text(total(terms)) == "-(a + b) q̈₁ + c q̈₂ + g"
    assert UnicodePrinter().text(total([Negative(first), second])) == "q̈₂ - q̈₁"
    away = Negative(Product((Symbol("w"), Symbol("q1", 1))))
    assert UnicodePrinter().text(total([away, Symbol("q2", 1)])) == "q̇₂ - w q̇₁", "of rates a plus is first"
