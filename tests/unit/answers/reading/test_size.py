"""The size of values: what is over a bound is refused before anything is multiplied out."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from dynsolve.answers.reading.grids import check_size
from dynsolve.errors import ReadError
from dynsolve.notation.size import Size, size
from dynsolve.notation.text import read
from dynsolve.notation.tree import Node, Number, Power, Product, Sum, Symbol

SIZES = [
    ("m1", (1, 1)),
    ("a + b", (2, 1)),
    ("a*(b + c)", (2, 2)),
    ("(a + b)^2", (3, 2)),
    ("sin(a + b)", (1, 1)),
]


@pytest.mark.parametrize(("text", "terms_and_degree"), SIZES)
def test_terms_and_degree_of_a_value(text: str, terms_and_degree: tuple[int, int]) -> None:
    assert size(read(text).tree, Size(100, 100, 100, 100))[2:] == terms_and_degree


def _nested(levels: int) -> Node:
    node: Node = Symbol("a")
    for _ in range(levels):
        node = Sum((node, Symbol("b")))
    return node


def _doubled(times: int) -> Node:
    node: Node = Symbol("a")
    for _ in range(times):
        node = Product((node, node))
    return node


TERMS = Power(Sum(tuple(Symbol(letter) for letter in "abcdefgh")), Number(20))


@pytest.mark.parametrize("make", [lambda: _nested(120), lambda: _doubled(16), lambda: TERMS])
def test_a_value_over_the_bounds_is_refused(make: Callable[[], Node]) -> None:
    node = make()
    try:
        check_size(node)
    except ReadError:
        return
    pytest.fail("nothing was refused")
