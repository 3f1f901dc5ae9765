"""The rank of the constraint matrix where the constraints hold, in numbers.

Its rows may be dependent wherever h = 0, and nowhere else: those of (x - y)² = 0, or of two equations for
the tips of equal arms.  Configurations with h = 0 are found by Newton's method from all quadrants; the
first at which the rank is that of anywhere else decides.
"""

from __future__ import annotations

from collections.abc import Mapping
from itertools import islice
from math import dist

from msgspec import Struct

from dynsolve.algebra.linear_systems import rank_parts
from dynsolve.algebra.matrix import Matrix
from dynsolve.algebra.ring_values import evaluate
from dynsolve.algebra.sampling import ENOUGH
from dynsolve.derivation.arm_values import assumed_states
from dynsolve.derivation.configurations import NO_VALUE
from dynsolve.derivation.elimination import free_directions, rank, shortest_step
from dynsolve.derivation.reached import CLOSE
from dynsolve.robot.model import Robot

DEPENDENT_THERE = "the rows of the constraint matrix are dependent wherever the constraints hold"

NOT_DETERMINED = f"{DEPENDENT_THERE}, so that the multipliers are not determined"

NOT_SHOWN = f"{DEPENDENT_THERE}, so that it does not show what they leave free"

_STEPS = 60
_NEAR_ZERO = 1e-3
"""A zero of higher order is found with fewer digits, and a rank there with as many."""

_ALONG = 1e-2
"""So far a direction is followed; a curve leaves it by the square of that."""

Rows = list[list[float]]


class Allowed(Struct, frozen=True):
    """The rank where the constraints hold, and whether it `is_less` there than elsewhere.

    Every direction that the constraint matrix leaves free is one to move along if it `is_whole`.
    """

    rank: int
    is_less: bool = False
    is_whole: bool = True


def where_allowed(robot: Robot, A: Matrix, h: Matrix) -> Allowed:
    """What is known of A_c, or of some of its columns, where h = 0."""
    most = rank_parts(A).rank
    if not h.entries:
        return Allowed(most)
    slopes = Matrix.of(robot.ring, ([robot.ring.diff(f, k) for k in range(robot.n)] for f in h.entries))
    found = []
    for start in islice(assumed_states(robot), ENOUGH):
        at = _on(robot, h, slopes, start)
        if at is None:
            continue
        there = rank(_numbers(A, at), _NEAR_ZERO, scale=1.0)
        if there == most:
            return Allowed(most)
        found.append((there, at))
    if not found:
        return Allowed(most)
    least = max(there for there, _ in found)
    return Allowed(least, True, all(_is_whole(robot, h, slopes, at) for one, at in found if one == least))


def _on(robot: Robot, h: Matrix, slopes: Matrix, start: Mapping[str, float]) -> dict[str, float] | None:
    """A configuration near another with h = 0; None where none is found."""
    at = dict(start)
    try:
        for _ in range(_STEPS):
            values = [evaluate(f, at) for f in h.entries]
            if max(map(abs, values)) < CLOSE**2:
                return at
            step = shortest_step(values, _numbers(slopes, at))
            for q, x in zip(robot.coordinates, step, strict=True):
                at[q.name] += x
    except NO_VALUE:
        return None
    return None


def _is_whole(robot: Robot, h: Matrix, slopes: Matrix, at: Mapping[str, float]) -> bool:
    """Whether along each direction that the slopes leave free h stays 0, but for a curve."""
    names = [q.name for q in robot.coordinates]
    for direction in free_directions(_numbers(slopes, at)):
        ahead = {**at, **{n: at[n] + _ALONG * x for n, x in zip(names, direction, strict=True)}}
        back = _on(robot, h, slopes, ahead)
        if back is None or dist([ahead[n] for n in names], [back[n] for n in names]) > _ALONG / 10:
            return False
    return True


def _numbers(matrix: Matrix, at: Mapping[str, float]) -> Rows:
    return [[evaluate(entry, at) for entry in row] for row in matrix.rows]
