"""Determinants by their properties: products, transposes, rows that depend on each other."""

from __future__ import annotations

from random import Random

import pytest

from dynsolve.algebra.matrix import Matrix, determinant, minors
from dynsolve.algebra.ring_values import build_ring
from dynsolve.notation.tree import Symbol

RING = build_ring([], [Symbol(name) for name in "abc"])


def random_matrix(size: int, seed: int) -> Matrix:
    random = Random(seed)
    symbols = [RING.symbol(name) for name in "abc"]
    return Matrix.of(
        RING,
        (
            [
                symbols[random.randrange(3)] * random.randint(-3, 3) + RING.one * random.randint(-2, 2)
                for _ in range(size)
            ]
            for _ in range(size)
        ),
    )


@pytest.mark.parametrize("size", [1, 2, 3, 4])
def test_the_determinant_of_a_product(size: int) -> None:
    a, b = random_matrix(size, 1), random_matrix(size, 2)
    assert determinant(a @ b) == determinant(a) * determinant(b)
    assert determinant(a.T) == determinant(a)


def test_the_minors_of_a_matrix_of_rank_one() -> None:
    column = Matrix.column(RING, [RING.symbol(name) for name in "abc"])
    product = column @ column.T
    assert list(minors(product, 2)) == []
    assert len(list(minors(product, 1))) == 9
