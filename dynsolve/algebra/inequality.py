"""Inequalities between polynomials in parameters that follow from given ones, proved exactly.

A polynomial is positive where it is a sum of products of what is assumed positive, of squares
and of positive numbers (the certificates of Handelman and Krivine).  Which sum it is, is a
system of linear equations with non-negative unknowns, solved by the simplex method on rational
numbers; what is not found in this way is not said.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from functools import lru_cache
from itertools import combinations
from math import prod
from random import Random

from flint import fmpq
from msgspec import Struct

from dynsolve.algebra.ring import Expr

Exponents = tuple[int, ...]
Polynomial = dict[Exponents, fmpq]

_ZERO = fmpq(0)

TRIES = 60
"""At so many points an inequality is tried before it is proved."""

MOST_PRODUCTS = 120
"""So many products of assumptions are tried."""


class Bound(Struct, frozen=True):
    """`value` > 0 where it is strict, else ≥ 0."""

    value: Expr
    is_strict: bool = True


def follows(bound: Bound, assumed: Sequence[Bound]) -> bool:
    """Whether an inequality follows from others, as a sum of their products.

    >>> from dynsolve.algebra.ring_values import build_ring
    >>> from dynsolve.notation.tree import Symbol
    >>> ring = build_ring([], [Symbol("a"), Symbol("b")])
    >>> a, b = ring.symbol("a"), ring.symbol("b")
    >>> follows(Bound(a * a - b * b), [Bound(a - b), Bound(b)]), follows(Bound(a - b), [Bound(b)])
    (True, False)
    """
    if bound.value.is_number:
        return bound.value.number > 0 or (not bound.is_strict and bound.value.is_zero)
    return _follows(bound, tuple(assumed))


@lru_cache(maxsize=512)  # what a minor needs is asked for again at each point of a case
def _follows(bound: Bound, assumed: tuple[Bound, ...]) -> bool:
    if _fails_somewhere(bound, assumed):
        return False
    products = list(_products(bound.value, assumed))
    return _is_sum(_polynomial(bound.value), products, bound.is_strict)


def _fails_somewhere(bound: Bound, assumed: Sequence[Bound]) -> bool:
    """Whether an inequality fails at some point where all that is assumed holds: nothing shows it then."""
    for point in _points(len(bound.value.ring.generators)):
        value = bound.value.poly(*point)
        fails = value < 0 or (bound.is_strict and value == 0)
        if fails and all(one.value.poly(*point) > 0 for one in assumed):
            return True
    return False


@lru_cache(maxsize=32)
def _points(dimension: int) -> list[list[fmpq]]:
    """Points at which inequalities are tried, the same every time; most values are positive."""
    random = Random(TRIES)  # noqa: S311 - the same values every time are wanted
    values = [fmpq(k, 2) for k in (-3, -1, 0, 1, 1, 2, 3, 5, 8, 20)]
    return [[random.choice(values) for _ in range(dimension)] for _ in range(TRIES)]


def opposite(bound: Bound) -> Bound:
    """What holds where an inequality does not."""
    return Bound(-bound.value, not bound.is_strict)


def simplified(bound: Bound, known: Sequence[Bound]) -> Bound:
    """An inequality without the factors, or products of these, that are known to be positive, or negative.

    >>> from dynsolve.algebra.ring_values import build_ring
    >>> from dynsolve.notation.tree import Symbol
    >>> ring = build_ring([], [Symbol("a"), Symbol("b")])
    >>> a, b = ring.symbol("a"), ring.symbol("b")
    >>> simplified(Bound((a * a - b * b) * (a * a - 2 * b * b)), [Bound(2 * a * a - 3 * b * b)]).value
    Expr(1*a^2 + -2*b^2)
    """
    ring = bound.value.ring
    content, factors = bound.value.poly.factor()
    value = ring.one if content > 0 else -ring.one
    left = [Expr(ring, factor) ** int(times) for factor, times in factors]
    size = 1
    while size <= len(left):
        for chosen in combinations(left, size):
            product = prod(chosen, start=ring.one)
            sign = next((sign for sign in (1, -1) if follows(Bound(product * sign), known)), 0)
            if sign:
                value, left = value * sign, [factor for factor in left if factor not in chosen]
                break
        else:
            size += 1
    return Bound(prod(left, start=value), bound.is_strict)


def independent(needed: Sequence[Bound], assumed: Sequence[Bound]) -> tuple[Bound, ...]:
    """Inequalities without those that follow from the others, the later ones left out first.

    >>> from dynsolve.algebra.ring_values import build_ring
    >>> from dynsolve.notation.tree import Symbol
    >>> ring = build_ring([], [Symbol(name) for name in "abc"])
    >>> a, b, c = map(ring.symbol, "abc")
    >>> [one.value for one in independent([Bound(a), Bound(c), Bound(a * c - b * b)], [])]
    [Expr(1*a), Expr(1*a*c + -1*b^2)]
    """
    kept = list(dict.fromkeys(needed))
    for bound in reversed(list(kept)):
        rest = [other for other in kept if other is not bound]
        known = [*assumed, *rest]
        positive = (Bound(bound.value * other.value, bound.is_strict) for other in known if other.is_strict)
        if any(follows(one, known) for one in (bound, *positive)):
            kept = rest
    return tuple(kept)


def _polynomial(value: Expr) -> Polynomial:
    return {tuple(map(int, e)): f for e, f in value.poly.to_dict().items()}


def _degree(value: Expr) -> int:
    return int(value.poly.total_degree())


def _products(target: Expr, assumed: Sequence[Bound]) -> Iterator[tuple[Polynomial, bool]]:
    """Products of assumptions and squares up to the largest degree, and whether each is above 0."""
    ring = target.ring
    most = max([_degree(target), *(_degree(bound.value) for bound in assumed)])
    degrees = target.poly.degrees()
    used = {i for bound in assumed for i, d in enumerate(bound.value.poly.degrees()) if d > 0}
    squares = [ring.generator(i) ** 2 for i, d in enumerate(degrees) if d > 0 or i in used]
    given = (bound for bound in assumed if not bound.value.is_number)
    distinct = dict.fromkeys([*given, *(Bound(square, False) for square in squares)])
    factors = [(factor, _degree(factor.value)) for factor in distinct]
    found: dict[Expr, bool] = {ring.one: True}
    waiting = [(Bound(ring.one), 0, 0)]
    for product, degree, first in waiting:
        for k, (factor, more) in enumerate(factors[first:], first):
            if degree + more > most or len(found) >= MOST_PRODUCTS:
                continue
            made = Bound(product.value * factor.value, product.is_strict and factor.is_strict)
            if made.value not in found or (made.is_strict and not found[made.value]):
                waiting.append((made, _degree(made.value), k))
                found[made.value] = made.is_strict
    return ((_polynomial(value), is_strict) for value, is_strict in found.items())


def _is_sum(
    target: Mapping[Exponents, fmpq], products: Sequence[tuple[Polynomial, bool]], is_strict: bool
) -> bool:
    """Whether the target is Σ λ_j p_j with λ_j ≥ 0; where it is to be strict, with a strict p_j in it."""
    products = _usable(target, products)
    rows = sorted({e for p, _ in products for e in p} | target.keys())
    right = [target.get(e, _ZERO) for e in rows]
    columns = [[p.get(e, _ZERO) for e in rows] for p, _ in products]
    gain = [fmpq(int(strict)) for _, strict in products]
    best = _Simplex(columns, right).maximum(gain)
    return best is not None and (best > 0 or not is_strict)


def _usable(
    target: Mapping[Exponents, fmpq], products: Sequence[tuple[Polynomial, bool]]
) -> Sequence[tuple[Polynomial, bool]]:
    """The products that can stand in the sum: each of their terms is the target's, or others take it away.

    >>> a, ab, b = {(1, 0): fmpq(1)}, {(1, 1): fmpq(-1), (0, 1): fmpq(1)}, {(0, 1): fmpq(1)}
    >>> [p for p, _ in _usable(a, [(p, True) for p in (a, ab, b)])] == [a]
    True
    """
    while True:
        against = {(e, f < 0) for e, f in target.items()}
        against |= {(e, f > 0) for p, _ in products for e, f in p.items()}
        left = [one for one in products if all((e, f < 0) in against for e, f in one[0].items())]
        if len(left) == len(products):
            return left
        products = left


class _Simplex:
    """Σ λ_j column_j = right with λ ≥ 0, by Bland's rule, which never circles.

    `worth` is what each λ_j would add to what is largest, and last what there is of it, with a minus.  A row
    begins with a slack of its own in the basis; one that has left it is not looked at again.
    """

    def __init__(self, columns: Sequence[Sequence[fmpq]], right: Sequence[fmpq]) -> None:
        self.width = len(columns)
        self.rows = [
            [-x if value < 0 else x for x in (*(column[i] for column in columns), value)]
            for i, value in enumerate(right)
        ]
        self.basis = [self.width + i for i in range(len(right))]
        self.worth: list[fmpq] = []

    def maximum(self, gain: Sequence[fmpq]) -> fmpq | None:
        """The largest Σ gain_j λ_j, 1 where there is none; None where the equations have no solution."""
        self.worth = [sum(column, _ZERO) for column in zip(*self.rows, strict=True)]
        self._improve()
        if self.worth[-1] != 0:
            return None
        self._leave_slack()
        self.worth = [*gain, _ZERO]
        for i, j in enumerate(self.basis):
            if j < self.width:
                self._subtract(i, self.worth[j])
        return -self.worth[-1] if self._improve() else fmpq(1)

    def _improve(self) -> bool:
        """Go where the value is largest; False where it grows without end."""
        while (entering := next((j for j in range(self.width) if self.worth[j] > 0), None)) is not None:
            ratios = [
                (row[-1] / row[entering], self.basis[i], i)
                for i, row in enumerate(self.rows)
                if row[entering] > 0
            ]
            if not ratios:
                return False
            self._pivot(min(ratios)[2], entering)
        return True

    def _leave_slack(self) -> None:
        """Take the slack out of the basis; a row that cannot is 0 = 0."""
        for i, j in enumerate(self.basis):
            if j >= self.width:
                entering = next((k for k in range(self.width) if self.rows[i][k]), None)
                if entering is not None:
                    self._pivot(i, entering)

    def _pivot(self, i: int, entering: int) -> None:
        head = self.rows[i][entering]
        self.rows[i] = [x / head for x in self.rows[i]]
        for k, row in enumerate(self.rows):
            if k != i and row[entering]:
                self.rows[k] = self._without(row, i, row[entering])
        self._subtract(i, self.worth[entering])
        self.basis[i] = entering

    def _subtract(self, i: int, factor: fmpq) -> None:
        """Write what is largest without the variable of row i."""
        if factor:
            self.worth = self._without(self.worth, i, factor)

    def _without(self, row: Sequence[fmpq], i: int, factor: fmpq) -> list[fmpq]:
        return [x - factor * y if y else x for x, y in zip(row, self.rows[i], strict=True)]
