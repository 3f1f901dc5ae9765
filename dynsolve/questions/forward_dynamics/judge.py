"""Accelerations in which others of the same motion stand, as q̈₂ by q̈₁ that is found beside it.

They are right where they hold in every motion, D q̈ + C q̇ + g = τ: that is held in numbers, with the key's
q̈ at states of a fixed seed.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from dynsolve.algebra.fraction import RationalExpr
from dynsolve.algebra.linear_systems import FractionMatrix, fraction_of
from dynsolve.algebra.matrix import Matrix
from dynsolve.algebra.ring_values import evaluate
from dynsolve.robot.model import Robot

Numbers = Mapping[str, float]

_CLOSE = 1e-7


def value_at(entry: RationalExpr, at: Numbers) -> float:
    """The value of a fraction at a state; raises ZeroDivisionError where it has none."""
    above = evaluate(entry.numerator, at)
    return above if entry.divisor is None else above / evaluate(entry.divisor, at)


def accelerations_in(robot: Robot, entry: RationalExpr) -> frozenset[int]:
    """The coordinates, from 0, whose accelerations stand in a fraction."""
    places = {q.acceleration: k for k, q in enumerate(robot.coordinates)}
    used = {*entry.numerator.used, *(entry.divisor.used if entry.divisor is not None else ())}
    generators = (entry.ring.generators[i] for i in used)
    names = (f"{g.name}_ddot" for g in generators if g.kind == "symbol" and g.dots == 2)
    return frozenset(places[name] for name in names if name in places)


def in_motion(robot: Robot, accelerations: Matrix | FractionMatrix, at: Numbers) -> dict[str, float]:
    """A state with the accelerations that its forces make."""
    made = [value_at(fraction_of(row[0]), at) for row in accelerations.rows]
    return {**at, **{q.acceleration: x for q, x in zip(robot.coordinates, made, strict=True)}}


def found_before(within: Sequence[frozenset[int]]) -> set[int]:
    """The accelerations that are found one after the other, where each holds those `within` it."""
    found: set[int] = set()
    while True:
        further = {k for k, others in enumerate(within) if others <= found} - found
        if not further:
            return found
        found |= further


def holds(robot: Robot, k: int, entry: RationalExpr, motions: Sequence[Numbers]) -> bool:
    """Whether the acceleration of coordinate k, from 0, is this one in all of these motions."""
    try:
        pairs = [(value_at(entry, at), at[robot.coordinates[k].acceleration]) for at in motions]
    except (ValueError, ZeroDivisionError):
        return False
    return bool(pairs) and all(abs(mine - its) < _CLOSE * max(1.0, abs(its)) for mine, its in pairs)
