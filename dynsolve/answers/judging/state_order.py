"""The matrices A and B of a linear motion in another order of the state than (q, q̇).

With P the permutation to the student's order A is P A Pᵀ, and B is P B.  The orders are (q̇, q), one
coordinate after the other with its rate, (x, ẋ, θ, θ̇), and these with the coordinates in another order.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import permutations
from typing import Any

from msgspec.structs import replace

from dynsolve.algebra.linear_systems import FractionMatrix, fraction_of
from dynsolve.algebra.matrix import Matrix
from dynsolve.answers.judging.key_comparison import KeyComparer, KeyComparison, Obstacle
from dynsolve.notation.tree import Symbol
from dynsolve.notation.unicode import to_unicode
from dynsolve.robot.model import Robot

IN_ORDER = "right with the state in the order {}"

MOST = 4
"""Of more coordinates no other order is looked for."""

Order = tuple[int, ...]
"""The places in (q, q̇), from 0, of the states as they follow one another."""


def with_own_order(
    robot: Robot, comparisons: Mapping[str, KeyComparison], compare: KeyComparer
) -> dict[str, KeyComparison]:
    """The comparisons, A and B being right in one order of the state."""
    found, own = dict(comparisons), list(_orders(robot.n))
    for name in ("linear_A", "linear_B"):
        compared = found.get(name)
        if name == "linear_B" and len(own) > 1:  # no A tells the order: each coordinate before its rate
            own = list(_of_coordinates(tuple(range(robot.n))))[:1]
        if compared is None or not compared.rows:
            continue
        if compared.correct:
            own = []
            continue
        held = [(order, _wrong_entries(order, name, compared, compare)) for order in own]
        order = next((order for order, wrong in held if not wrong), None)
        if order is not None:
            right = tuple(tuple("" for _ in row) for row in compared.rows)
            found[name] = replace(compared, right=right, other=IN_ORDER.format(_words(robot, order)))
            own = [order]
        elif name == "linear_A" and None in (one for row in compared.right[: robot.n] for one in row):
            found[name] = _wrong_in_its_order(robot, compared, held)
    return found


def _orders(n: int) -> Iterator[Order]:
    """The orders of the state beside (q, q̇), those with the coordinates in their order first."""
    for coordinates in permutations(range(n)) if n <= MOST else ():
        if any(k != i for i, k in enumerate(coordinates)):
            yield (*coordinates, *(n + k for k in coordinates))
        yield from _of_coordinates(coordinates)


def _of_coordinates(order: Order) -> Iterator[Order]:
    """Each coordinate with its rate behind it, or before it; the rates first."""
    n = len(order)
    yield tuple(place for k in order for place in (k, n + k))
    yield (*(n + k for k in order), *order)
    yield tuple(place for k in order for place in (n + k, k))


def _wrong_entries(
    order: Order, name: str, compared: KeyComparison, compare: KeyComparer
) -> list[tuple[int, int]]:
    """The entries, from 0, that are not the key's in an order of the state."""
    key: Any = compare.key(compared.target)
    assert isinstance(key, Matrix | FractionMatrix)
    columns: Sequence[int] = order if name == "linear_A" else range(key.shape[1])
    return [
        (i, j)
        for i, row in enumerate(order)
        for j, column in enumerate(columns)
        if compare.compare(fraction_of(key[row, column]), compared.rows[i][j]) is None
    ]


def _wrong_in_its_order(
    robot: Robot, compared: KeyComparison, held: Sequence[tuple[Order, list[tuple[int, int]]]]
) -> KeyComparison:
    """A wrong A whose rows of the coordinates show another order: its wrong entries are told in this."""
    for order, wrong in held:
        if all(order[i] >= robot.n for i, _ in wrong):
            entries = ", ".join(f"({i + 1}, {j + 1})" for i, j in wrong)
            told = f"the order {_words(robot, order)} of the state, it is wrong in {entries}"
            return replace(compared, obstacles=(Obstacle("state_order", told),))
    return compared


def _words(robot: Robot, order: Order) -> str:
    """(x, ẋ, θ, θ̇)"""
    states = [Symbol(q.name, dots) for dots in (0, 1) for q in robot.coordinates]
    return f"({', '.join(to_unicode(states[place]) for place in order)})"
