"""Numbers put into trees."""

from __future__ import annotations

import math

import numpy as np
import pytest

from dynsolve.notation.text import read
from dynsolve.notation.tree import Letter, Matrix, Node, Number, Sum, Symbol
from dynsolve.notation.tree_values import compile_trees, evaluate

VALUES = {"x": 0.7, "y": -1.3, "x_dot": 2.0}


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("3/4", 0.75),
        ("x + y - 2", 0.7 - 1.3 - 2),
        ("-x*y", 0.7 * 1.3),
        ("x/y", 0.7 / -1.3),
        ("x^3", 0.7**3),
        ("x^(-2)", 0.7**-2),
        ("sin(x)^2 + cos(x)^2", 1.0),
        ("tan(30deg)", 1 / math.sqrt(3)),
        ("sqrt(2)*pi", math.sqrt(2) * math.pi),
        ("sin(2*x - y + 90deg)", math.cos(2 * 0.7 + 1.3)),
    ],
)
def test_a_formula_has_its_value(text: str, value: float) -> None:
    assert evaluate(read(text).tree, VALUES) == pytest.approx(value, rel=1e-15)


def test_a_derivative_goes_by_its_plain_name() -> None:
    assert evaluate(Symbol("x", 1), VALUES) == 2.0


def test_shared_parts_are_computed_once() -> None:
    node: Node = Sum((Symbol("x"), Number(1)))
    for _ in range(60):  # 2**60 additions, were every occurrence computed
        node = Sum((node, node))
    program = compile_trees([node])
    assert len(program.operations) == 61
    assert program.run({"x": 0.0}) == [2.0**60]


def test_matrices_keep_their_shape() -> None:
    assert evaluate(Matrix(((Symbol("x"), Number(0)),)), VALUES) == [[0.7, 0.0]]


def test_arrays_go_through_where_the_functions_take_them() -> None:
    program = compile_trees([read("sin(x)*y").tree], {"sin": np.sin})
    (result,) = program.run({"x": np.array([0.0, math.pi / 2]), "y": 2.0})
    assert result.tolist() == [0.0, 2.0]


def test_a_letter_of_the_textbook_has_no_value() -> None:
    with pytest.raises(TypeError, match="Letter"):
        evaluate(Letter("H"), VALUES)
