"""Gauss's elimination on floating-point numbers, by which the independent checks are made.

A cos θ + B sin θ + C.

The signs of polynomials in parameters, which count as positive, under what is assumed of them.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from itertools import product
from math import hypot, prod
from operator import mul
from typing import Any

from msgspec import Struct

from dynsolve.algebra.factors import in_numbers, is_positive, parameters, ratio, trig_factors
from dynsolve.algebra.generators import Pair
from dynsolve.algebra.inequality import Bound, follows
from dynsolve.algebra.ring import Expr

Rows = Sequence[Sequence[float]]

_INDEPENDENT = 1e-4
MOST_OF_QUADRATIC = 300
"""Expressions with more terms are not looked at as quadratics: none of a mechanism was one."""

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
    least = rounding * max((abs(x) for row in matrix for x in row), default=0.0)
    return all(pivot > least for pivot in pivots(matrix))


def pivots(matrix: Rows) -> Iterator[float]:
    """The pivots of a symmetric matrix, up to the first that is not positive."""
    rows = [list(row) for row in matrix]
    for k, pivot in enumerate(rows):
        yield pivot[k]
        if pivot[k] <= 0:
            return
        for row in rows[k + 1 :]:
            factor = row[k] / pivot[k]
            row[k:] = [a - factor * b for a, b in zip(row[k:], pivot[k:], strict=True)]


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


def free_directions(rows: Rows) -> list[list[float]]:
    """Unit vectors that are orthogonal to the rows, and to each other.

    >>> free_directions([[0.0, 2.0]])
    [[1.0, 0.0]]
    """
    n = len(rows[0])
    across = _orthonormal(rows, [])
    return _orthonormal([[float(i == j) for j in range(n)] for i in range(n)], across)


def _orthonormal(rows: Rows, others: Rows) -> list[list[float]]:
    """Unit vectors, each orthogonal to the `others`, in the span of both."""
    found: list[list[float]] = []
    for row in rows:
        left = list(row)
        for _ in range(2):  # once more for what rounding left
            for one in (*others, *found):
                along = sum(map(mul, left, one))
                left = [a - along * b for a, b in zip(left, one, strict=True)]
        if (length := hypot(*left)) > _INDEPENDENT:
            found.append([a / length for a in left])
    return found


# The signs of polynomials in parameters, which count as positive, under what is assumed of them


class ParameterSigns(Struct, frozen=True):
    """What is `assumed` of the parameters beside that they are positive; the `nonzero` factors are not 0."""

    assumed: tuple[Bound, ...] = ()
    nonzero: tuple[Expr, ...] = ()

    def beside(self, *more: Bound, nonzero: Iterable[Expr] = ()) -> ParameterSigns:
        """The same where further inequalities hold, and further factors are not 0."""
        return ParameterSigns((*self.assumed, *more), (*self.nonzero, *nonzero))

    def moved(self, there: Callable[[Expr], Expr]) -> ParameterSigns:
        """The same in another ring."""
        assumed = tuple(Bound(there(bound.value), bound.is_strict) for bound in self.assumed)
        return ParameterSigns(assumed, tuple(map(there, self.nonzero)))

    def open_factors(self, value: Expr) -> Iterator[Expr]:
        """The irreducible factors of a value that may be 0, as far as is known; none where it is 0."""
        if not value.is_zero:
            yield from (factor for factor, _ in _factored(value)[1] if not self._sign(factor))

    def open_part(self, value: Expr) -> Expr:
        """What has the sign of a value, without the factors whose sign is known: 1 or -1 where all are.

        >>> from dynsolve.algebra.ring_values import build_ring
        >>> from dynsolve.notation.tree import Symbol
        >>> ring = build_ring([], [Symbol("a"), Symbol("b")])
        >>> a, b = ring.symbol("a"), ring.symbol("b")
        >>> ParameterSigns().open_part(2 * a**3 - 2 * a * b * b) == a - b
        True
        >>> ParameterSigns((Bound(a - b),)).open_part(b * b - a * a) == -ring.one
        True
        """
        ring = value.ring
        if value.is_zero:
            return value
        is_positive, factors = _factored(value)
        left = ring.one if is_positive else -ring.one
        for factor, times in factors:
            sign = self._sign(factor)
            if sign or times % 2 or factor not in self.nonzero:
                left = left * (ring.constant(sign) if sign else factor) ** (2 - times % 2)
        for bound in self.assumed:  # 1 - 4 cos² β is assumed, and neither of its factors
            if bound.is_strict and not left.is_number and not bound.value.is_number:
                quotient = Expr(ring, divmod(left.poly, bound.value.poly)[0])
                left = quotient if quotient * bound.value == left else left
        if left.is_number:
            return ring.one if left.number > 0 else -ring.one
        return left

    def even_factors(self, value: Expr) -> list[Expr]:
        """The irreducible factors that stand in a value to even powers alone, and may be 0."""
        found = [] if value.is_zero else _factored(value)[1]
        return [f for f, times in found if not (times % 2 or self._sign(f) or f in self.nonzero)]

    def is_positive(self, value: Expr) -> bool:
        """Whether a value is positive."""
        part = self.open_part(value)
        return part.is_number and part.number > 0

    def implies(self, bound: Bound, known: Sequence[Bound]) -> bool:
        """Whether an inequality follows from others."""
        return follows(bound, [*known, *self.beside(*known)._positive(bound.value), *self.assumed])

    def _sign(self, factor: Expr) -> int:
        """1 or -1 where it is known, else 0."""
        for sign in (1, -1):
            signed = factor * sign
            assumed = any(signed == bound.value and bound.is_strict for bound in self.assumed)
            if (
                assumed
                or is_positive(signed)
                or _is_of_positive_numbers(signed)
                or _is_quadratic_without_zeros(signed)
            ):
                return sign
        if not self.assumed or factor.ring.depends_on_coordinates(factor):
            return 0
        for sign, bound in product((1, -1), self.assumed):
            if is_more(factor * sign, bound):
                return sign
        positive = tuple(self._positive(factor))
        known = (*self.assumed, *positive)
        multiples = (factor, *(factor * bound.value for bound in positive))  # n (a - b) of n a > b (m + n)
        return next((sign for one in multiples for sign in (1, -1) if follows(Bound(one * sign), known)), 0)

    def _positive(self, factor: Expr) -> Iterator[Bound]:
        """That the parameters are positive which stand in a factor, or in what is assumed."""
        ring = factor.ring
        degrees = [value.poly.degrees() for value in (factor, *(bound.value for bound in self.assumed))]
        for g in ring.generators:
            if g.kind == "symbol" and g.name in ring.parameters and any(d[g.index] > 0 for d in degrees):
                yield Bound(ring.generator(g.index))


def is_more(value: Expr, bound: Bound) -> bool:
    """Whether a value is an assumption times what is positive, and a rest that is."""
    times, rest = (Expr(value.ring, part) for part in divmod(value.poly, bound.value.poly))
    is_rest = is_positive(rest)
    return is_positive(times) and (is_rest or (rest.is_zero and bound.is_strict))


def _is_of_positive_numbers(value: Expr) -> bool:
    """Whether parameters alone stand in a value, each behind a positive number: sin 20° is 3c - 4c³."""
    positive = parameters(value)
    return all(
        size > _SMALL and all(i in positive for i, e in enumerate(exponents) if e)
        for exponents, size in in_numbers(value).items()
    )


def _is_quadratic_without_zeros(value: Expr) -> bool:
    """Whether a value is a x² - b x + c of a parameter x, with 4a c > b²: m² g² - 2m g k h + k² (b² + h²)."""
    ring, monomials = value.ring, value.poly.monoms()
    if len(monomials) > MOST_OF_QUADRATIC:
        return False
    for g in ring.generators:
        if (
            g.kind != "symbol"
            or g.name not in ring.parameters
            or {int(m[g.index]) for m in monomials} != {0, 1, 2}
        ):
            continue
        parts = _by_powers(value, (g.index,))
        c, b, a = (parts[power,] for power in range(3))
        if is_positive(a) and is_positive(4 * a * c - b * b):
            return True
    return False


def _by_powers(value: Expr, indices: tuple[int, ...]) -> dict[tuple[int, ...], Expr]:
    """The parts of an expression beside the powers of some generators, by these powers."""
    ring = value.ring
    parts: dict[tuple[int, ...], dict[tuple[int, ...], Any]] = {}
    for exponents, number in value.poly.to_dict().items():
        key = tuple(int(exponents[k]) for k in indices)
        plain = tuple(0 if k in indices else e for k, e in enumerate(exponents))
        parts.setdefault(key, {})[plain] = number
    return {key: Expr(ring, ring.ctx.from_dict(part)) for key, part in parts.items()}


def _factored(value: Expr) -> tuple[bool, list[tuple[Expr, int]]]:
    """Whether the number before its irreducible factors is positive, and these with their multiplicities.

    With sines and cosines these are factors as in sin² β = 1 - cos² β.
    """
    ring, degrees = value.ring, value.poly.degrees()
    if any(degrees[pair.sine] > 0 or degrees[pair.cosine] > 0 for pair in ring.pairs):
        factors = trig_factors(value)
        number = ratio(value, prod((factor**times for factor, times in factors), start=ring.one))
        if number.is_number:
            return number.number > 0, [*factors]
    content, plain = value.poly.factor()
    return content > 0, [(Expr(ring, factor), int(times)) for factor, times in plain]


# Expressions in one angle


class Turn(Struct, frozen=True):
    """A cos θ + B sin θ + C, with A, B and C free of coordinates."""

    pair: Pair
    cosine: Expr
    sine: Expr
    rest: Expr

    @property
    def is_one_sided(self) -> bool:
        """Whether the cosine stands alone, or the sine."""
        return self.cosine.is_zero or self.sine.is_zero


def turn_of(value: Expr) -> Turn | None:
    """An expression as such a sum; None where it is another, or holds no angle."""
    ring = value.ring
    for pair in ring.pairs:
        parts = _by_powers(value, (pair.cosine, pair.sine))
        if not parts.keys() - {(0, 0)}:
            continue
        free = not any(ring.depends_on_coordinates(part) for part in parts.values())
        if free and parts.keys() <= {(0, 0), (1, 0), (0, 1)}:
            return Turn(pair, *(parts.get(key, ring.zero) for key in ((1, 0), (0, 1), (0, 0))))
        return None
    return None
