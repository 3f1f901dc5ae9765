"""Configurations in numbers: whether they give the task what is asked, and whether two are the same."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from math import cos, pi

from dynsolve.algebra.matrix import Matrix
from dynsolve.algebra.ring import Ring

CLOSE = 1e-6
"""What floating point may leave of 0; lengths and angles are about 1."""


def angle_rows(task: Matrix) -> tuple[bool, ...]:
    """Which components of r(q) are sums of joint angles, which count modulo 2π."""
    ring = task.ring
    turning = [ring.symbol_indices[name, 0] for name, kind in ring.coordinates if kind == "revolute"]
    return tuple(any(entry.poly.degrees()[i] > 0 for i in turning) for entry in task.entries)


def near(
    mine: Sequence[float], theirs: Sequence[float], angles: Sequence[bool], close: float = CLOSE
) -> bool:
    """Whether two values of a task are the same; of those that are `angles` modulo 2π."""
    return all(
        1 - cos(a - b) <= close**2 if is_angle else abs(a - b) <= close * max(1.0, abs(b))
        for a, b, is_angle in zip(mine, theirs, angles, strict=True)
    )


def same_configuration(
    ring: Ring, q: Mapping[str, float], other: Mapping[str, float], close: float = CLOSE
) -> bool:
    """Whether two configurations are the same; joint angles modulo 2π."""
    return all(abs(gap(kind, q[name], other[name])) <= close for name, kind in ring.coordinates)


def gap(kind: str, value: float, other: float) -> float:
    """The difference of two values of a coordinate, of angles the shortest way round."""
    difference = value - other
    return (difference + pi) % (2 * pi) - pi if kind == "revolute" else difference
