"""Fractions of results are in lowest terms: where a factor of a denominator is 0 the value has no bound.

What is 0 above and below has a value next to where it is 0, and the printed form is 0/0 there.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from random import Random
from typing import Any

import numpy as np

from dynsolve.algebra.linear_systems import FractionMatrix
from dynsolve.algebra.lowest_terms import is_decided
from dynsolve.notation.build import factors_of
from dynsolve.notation.tree import Matrix, Node, Power, Quotient, walk
from dynsolve.notation.tree_values import compile_trees
from tests.strangers.oracle import state

RESULTS = ("qdd_forward", "lambda", "Lambda", "qd", "qdd")
"""The results that are fractions."""

NEAR, NEARER = 1e-2, 1e-4
"""How far from a zero a fraction is looked at; of a simple one it is a hundred times as great there."""

GROWS, SAME, SIDES = 10, 0.05, 5
TRIES = 4

Names = dict[str, float]


def reducible(solution: Any, seed: int = 0) -> Iterator[tuple[str, Node, Node]]:
    """Of each result the fractions, with a factor below, whose values stay finite where that is 0.

    Those that are too long to be brought to lowest terms are not held.
    """
    for name in RESULTS:
        if name not in solution.values.rules or not _is_decided(solution.values[name]):
            continue
        if isinstance(form := solution.forms(name), Matrix):
            for quotient in dict.fromkeys(part for part in walk(form) if isinstance(part, Quotient)):
                for factor in finite_at(solution, quotient, seed):
                    yield name, quotient, factor


def _is_decided(value: Any) -> bool:
    if not isinstance(value, FractionMatrix):
        return False
    return all(is_decided(one.numerator, one.denominator) for one in value.entries if not one.is_zero)


def finite_at(solution: Any, quotient: Quotient, seed: int = 0) -> Iterator[Node]:
    """The factors below with a zero at which the quotient has a bound."""
    free = solution.robot.ring.names
    for part in factors_of(quotient.denominator):
        factor = part.base if isinstance(part, Power) else part
        for k in range(TRIES):
            names = dict(state(solution, seed + k, {}).names)
            zero = _zero(factor, names, free)
            if zero is not None and _has_value(quotient, zero, free, Random(seed + k)):
                yield factor
                break


def _zero(factor: Node, names: Names, free: tuple[str, ...]) -> Names | None:
    """A configuration in which a factor is 0, by Newton's method."""
    program = compile_trees([factor])

    def value(at: Mapping[str, float]) -> float:
        return float(program.run(at)[0])

    size = abs(value(names))
    for _ in range(100):
        here = value(names)
        if abs(here) < 1e-13 * size:
            return names
        slopes = [
            (value(names | {q: names[q] + 1e-6}) - value(names | {q: names[q] - 1e-6})) / 2e-6 for q in free
        ]
        square = float(np.dot(slopes, slopes))
        if square < 1e-24:
            break
        names = names | {q: names[q] - here * slope / square for q, slope in zip(free, slopes, strict=True)}
    return None


def _has_value(quotient: Node, zero: Names, free: tuple[str, ...], random: Random) -> bool:
    """Whether next to a zero the quotient has one value on all sides, as x y/(x² + y²) has not."""
    program = compile_trees([quotient])
    reached: list[float] = []
    for _ in range(SIDES):
        along = {q: random.uniform(-1, 1) for q in free}
        far, close = (
            float(program.run(zero | {q: zero[q] + step * along[q] for q in free})[0])
            for step in (NEAR, NEARER)
        )
        if abs(close) > GROWS * abs(far):
            return False
        reached.append(close)

    return max(reached) - min(reached) < SAME * max(map(abs, reached))
