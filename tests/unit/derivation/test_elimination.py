"""Elimination on numbers, against values that are known and against NumPy."""

from __future__ import annotations

import numpy as np
import pytest

from dynsolve.derivation.elimination import determinant, is_positive_definite, rank, solved

ROUNDING = 1e-10


def test_known_values() -> None:
    assert solved([[2.0, 1.0], [1.0, 3.0]], [3.0, 5.0]) == pytest.approx([0.8, 1.4])
    assert determinant([[0.0, 2.0], [3.0, 1.0]]) == pytest.approx(-6.0)
    assert determinant([[1.0, 2.0, 0.0], [2.0, 4.0, 1.0], [0.0, 1.0, 1.0]]) == pytest.approx(-1.0)
    assert determinant([[1.0, 2.0], [2.0, 4.0]]) == 0.0
    assert rank([[0.0, 0.0], [0.0, 0.0]], ROUNDING) == 0
    assert rank([[1.0, 2.0, 3.0], [4.0, 5.0, 6.0], [7.0, 8.0, 9.0]], ROUNDING) == 2


def test_what_is_rounding() -> None:
    small = [[1e-3, 0.0], [0.0, 1e-8]]
    assert rank(small, 1e-4) == 1
    assert rank(small, 1e-6) == 2
    assert rank(small, 1e-2, scale=1.0) == 0
    assert is_positive_definite(small)
    assert not is_positive_definite(small, 1e-4)


@pytest.mark.parametrize("size", [1, 2, 3, 5])
def test_as_numpy_has_it(size: int) -> None:
    random = np.random.default_rng(size)
    for _ in range(20):
        A, b = random.normal(size=(size, size)), random.normal(size=size)
        assert solved(A.tolist(), b.tolist()) == pytest.approx(np.linalg.solve(A, b).tolist(), rel=1e-6)
        assert determinant(A.tolist()) == pytest.approx(np.linalg.det(A))
        for columns in range(1, size + 1):
            thin = A[:, :columns]
            assert rank((thin @ thin.T).tolist(), ROUNDING) == np.linalg.matrix_rank(thin) == columns
        symmetric = A + A.T
        definite = bool((np.linalg.eigvalsh(symmetric) > 0).all())
        assert is_positive_definite(symmetric.tolist()) is definite
        assert is_positive_definite((A @ A.T).tolist())
