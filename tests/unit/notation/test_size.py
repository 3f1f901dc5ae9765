"""The size of formulas, against sizes counted by hand and against what multiplying out gives."""

from __future__ import annotations

import pytest
import sympy
from hypothesis import example, given, settings

from dynsolve.notation.size import Size, TooLargeError, size
from dynsolve.notation.text import read
from dynsolve.notation.tree import Function, Matrix, Node, Number, Power, Product, Sum, Symbol
from dynsolve.solution.numeric import to_sympy
from tests.unit.notation.trees import rational_trees

A, B = Symbol("a"), Symbol("b")
MOST = Size(10_000, 100, 10_000, 1_000)


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("a", (1, 1, 1, 1)),
        ("a + b", (3, 2, 2, 1)),
        ("a*b*c", (4, 2, 1, 3)),
        ("(a + b)*(a + b + c)", (8, 3, 6, 2)),
        ("(a + b)^3", (5, 3, 4, 3)),
        ("-(a + b)", (4, 3, 2, 1)),
        ("(a + b)/(c + d + e)", (8, 3, 5, 1)),
        ("sin(a + b)*(a + b)", (8, 4, 2, 2)),
    ],
)
def test_sizes(text: str, expected: tuple[int, int, int, int]) -> None:
    assert size(read(text).tree, MOST) == expected


def test_a_matrix_is_as_large_as_its_largest_entry() -> None:
    assert size(Matrix(((Sum((A, B)), A), (B, Product((A, B))))), MOST) == (9, 3, 2, 2)


def test_long_numbers_count_by_their_length() -> None:
    assert size(Number(7**40), MOST).degree == 1 + (7**40).bit_length() // 32


@pytest.mark.parametrize(
    ("node", "measure"),
    [
        (Sum((A,) * 10_001), "nodes"),
        (Power(Sum((A, B, Symbol("c"))), Number(200)), "terms"),
        (Power(Power(A, Number(40)), Number(40)), "degree"),
    ],
)
def test_what_is_too_large_says_in_what(node: Node, measure: str) -> None:
    with pytest.raises(TooLargeError) as caught:
        size(node, MOST)
    assert caught.value.measure == measure


def test_what_is_too_deep_is_refused_before_the_descent_ends() -> None:
    node: Node = A
    for _ in range(50_000):
        node = Sum((node,))
    with pytest.raises(TooLargeError) as caught:
        size(node, MOST)
    assert caught.value.measure == "depth"


def test_shared_parts_count_wherever_they_stand_and_are_measured_once() -> None:
    node: Node = A
    for _ in range(80):
        node = Product((node, node))
    with pytest.raises(TooLargeError):
        size(node, MOST)


@example(Power(Function("sqrt", Sum((A, B))), Number(2)))
@settings(max_examples=60, deadline=None)
@given(rational_trees)
def test_multiplied_out_there_are_no_more_terms_than_said(node: Node) -> None:
    try:
        bound = size(node, Size(60, 20, 40, 12))
    except TooLargeError:
        return
    value = sympy.together(to_sympy(node))
    if value.has(sympy.Function, sympy.zoo, sympy.nan) or not value.is_rational_function():
        return
    numerator, denominator = value.as_numer_denom()
    if denominator.free_symbols:
        return
    assert len(sympy.Add.make_args(sympy.expand(numerator))) <= bound.terms
