"""Gauss's elimination on floating-point numbers, by which the independent checks are made."""

from __future__ import annotations

from collections.abc import Sequence
from math import hypot
from operator import mul

Rows = Sequence[Sequence[float]]

_SMALL = 1e-9
_ALONG = 1e-6
"""What of a gradient is no direction of its own: a length, and a part of the gradient."""


def solved(matrix: Rows, right: Sequence[float]) -> list[float]:
    """The solution of A x = b, with the largest pivot of each column.

    >>> solved([[0.0, 2.0], [1.0, 1.0]], [4.0, 5.0])
    [3.0, 2.0]
    """
    rows = [[*row, b] for row, b in zip(matrix, right, strict=True)]
    size = len(rows)
    for k in range(size):
        best = max(range(k, size), key=lambda i: abs(rows[i][k]))
        rows[k], rows[best] = rows[best], rows[k]
        for i in range(size):
            if i != k and rows[i][k]:
                factor = rows[i][k] / rows[k][k]
                rows[i] = [a - factor * b for a, b in zip(rows[i], rows[k], strict=True)]
    return [row[-1] / row[k] for k, row in enumerate(rows)]


def determinant(matrix: Rows) -> float:
    """det A, with the largest pivot of each column.

    >>> determinant([[0.0, 2.0], [3.0, 1.0]])
    -6.0
    """
    rows, total = [list(row) for row in matrix], 1.0
    for k in range(len(rows)):
        best = max(range(k, len(rows)), key=lambda i: abs(rows[i][k]))
        if not rows[best][k]:
            return 0.0
        if best != k:
            rows[k], rows[best], total = rows[best], rows[k], -total
        total *= rows[k][k]
        for row in rows[k + 1 :]:
            factor = row[k] / rows[k][k]
            row[k:] = [a - factor * b for a, b in zip(row[k:], rows[k][k:], strict=True)]
    return total


def rank(matrix: Rows, rounding: float, scale: float = 0.0) -> int:
    """The rank, with the largest pivot of all that is left.

    A pivot is 0 up to `rounding` times the largest entry, or times `scale` if that is more.

    >>> rank([[1.0, 2.0], [2.0, 4.0], [0.0, 1.0]], 1e-9)
    2
    """
    left = [list(row) for row in matrix]
    least = rounding * max((abs(x) for row in left for x in row), default=0.0)
    found = 0
    while left and left[0]:
        pivot, i, j = max((abs(x), i, j) for i, row in enumerate(left) for j, x in enumerate(row))
        if pivot <= max(least, rounding * scale):
            break
        top = left.pop(i)
        left = [
            [x - row[j] / top[j] * y for k, (x, y) in enumerate(zip(row, top, strict=True)) if k != j]
            for row in left
        ]
        found += 1
    return found


def is_positive_definite(matrix: Rows, rounding: float = 0.0) -> bool:
    """Whether all pivots of a symmetric matrix are positive, by more than `rounding` times the largest entry.

    >>> is_positive_definite([[2.0, 1.0], [1.0, 1.0]]), is_positive_definite([[1.0, 2.0], [2.0, 1.0]])
    (True, False)
    """
    rows = [list(row) for row in matrix]
    least = rounding * max((abs(x) for row in rows for x in row), default=0.0)
    for k, pivot in enumerate(rows):
        if pivot[k] <= least:
            return False
        for row in rows[k + 1 :]:
            factor = row[k] / pivot[k]
            row[k:] = [a - factor * b for a, b in zip(row[k:], pivot[k:], strict=True)]
    return True


def shortest_step(values: Sequence[float], rows: Rows) -> list[float]:
    """The shortest step after which each value, changed by its gradient, is 0.

    One gradient after the other, each without its part along those before it; one that lies in their
    span is an equation that repeats another.
    """
    step = [0.0] * len(rows[0])
    across: list[list[float]] = []
    for value, row in zip(values, rows, strict=True):
        left = list(row)
        for one in across:
            along = sum(map(mul, row, one))
            left = [x - along * y for x, y in zip(left, one, strict=True)]
        length, whole = hypot(*left), hypot(*row)
        if length < _SMALL or length < _ALONG * whole:
            continue
        across.append([x / length for x in left])
        short = (value + sum(map(mul, row, step))) / length
        step = [x - short * y for x, y in zip(step, across[-1], strict=True)]
    return step
