"""Whether matrices are positive definite, held at random values of parameters and coordinates.

Symmetric elimination on numbers: a matrix is positive definite exactly if every pivot is positive.
It shares nothing with the minors and their smallest values.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from random import Random

from dynsolve.algebra.ring_values import evaluate
from dynsolve.derivation.elimination import is_positive_definite, pivots
from dynsolve.derivation.graph import Skipped
from dynsolve.errors import VerificationError
from dynsolve.questions.definite.derive import Alternatives, Answer, Definiteness, Refusal, failing, hold
from dynsolve.questions.held import Held
from dynsolve.robot.model import JointType, Robot
from dynsolve.robot.questions import Candidate

SEED = 20_190_429

EDGES = 6
"""Where a condition fails so many times more values are drawn: some where it is an equality."""


DRAWS = 20_000
"""So many values are drawn in the search for some that satisfy what is assumed."""


POSES = 200

STARTS = 3
"""From so many poses a smallest minor is looked for, where no pose has one that is not positive."""

SMALLEST_STEP = 1e-8

ROUNDING = 1e-12


def verify_definite(robot: Robot, candidate: Candidate, found: Definiteness, states: int) -> None:
    """Hold a verdict at random values; raises VerificationError where it is wrong."""
    random = Random(SEED)  # noqa: S311 - the same values every time are wanted
    if found.refusal not in (None, Refusal.INDEFINITE):
        return
    is_no = found.answer is Answer.NO
    assumed = tuple((one,) for one in candidate.assumed)
    given = (*assumed, *found.conditions)
    told = [(values, not is_no) for values in _parameters(candidate, given, random, states)]
    for condition in found.conditions if found.is_exact else ():
        fails = (*assumed, *failing(condition))
        told += [(values, False) for values in _parameters(candidate, fails, random, EDGES * states)]
    for parameters, is_told in told:
        poses = list(_poses(robot, parameters, random))
        every = all(_is_definite(candidate, values) for values in poses)
        if every and not is_told:
            every = _is_definite(candidate, _lowest(robot, candidate, poses))
        if every != is_told:
            raise VerificationError(
                f"whether {candidate.name} is positive definite comes out otherwise on numbers; "
                "this is a fault of dynsolve"
            )


def _parameters(
    candidate: Candidate, conditions: Sequence[Alternatives], random: Random, states: int
) -> Iterator[dict[str, float]]:
    """Values of the parameters that satisfy conditions, some of them 0 or the same."""
    ring, count = candidate.matrix.ring, 0
    for _ in range(DRAWS):
        values: dict[str, float] = {}
        for name in ring.parameters:
            edge = random.choice((0.0, *values.values()))
            values[name] = random.choice((edge, random.uniform(-2, 2), random.uniform(0.1, 3)))
        if hold(conditions, values, 1e-3, 0.0):
            count += 1
            yield values
            if count == states:
                return


def _poses(robot: Robot, parameters: Mapping[str, float], random: Random) -> Iterator[dict[str, float]]:
    """Values of the coordinates: right angles first, and lengths of every size."""
    for k in range(POSES):
        values = dict(parameters)
        for q in robot.coordinates:
            if q.type is JointType.PRISMATIC:
                values[q.name] = random.choice((0.0, random.uniform(-3, 3), random.uniform(-100, 100)))
            elif k % 2:
                values[q.name] = random.choice((0, 1, 2, 3)) * math.pi / 2
            else:
                values[q.name] = random.uniform(-math.pi, math.pi)
        yield values


def _lowest(robot: Robot, candidate: Candidate, poses: Sequence[dict[str, float]]) -> dict[str, float]:
    """Where a leading minor is as small as it is found to be: from some poses, one coordinate at a time."""
    ends = []
    for start in sorted(poses, key=lambda at: _least(candidate, at))[:STARTS]:
        at, steps = dict(start), {q.name: 1.0 for q in robot.coordinates}
        least = _least(candidate, at)
        while max(steps.values()) > SMALLEST_STEP and least > 0:
            for name, step in steps.items():
                moved = [{**at, name: at[name] + sign * step} for sign in (1, -1)]
                best = min(moved, key=lambda one: _least(candidate, one))
                value = _least(candidate, best)
                steps[name] = step * (2 if value < least else 0.5)
                at, least = (best, value) if value < least else (at, least)
        ends.append(at)
    return min(ends, key=lambda at: _least(candidate, at))


def _least(candidate: Candidate, values: Mapping[str, float]) -> float:
    """The smallest of the pivots, each beside its entry of the diagonal; -1 where one is not positive."""
    rows = _numbers(candidate, values)
    found = list(pivots(rows))
    if found[-1] <= 0:
        return -1.0
    return min(
        1.0, *(pivot / max(row[k], 1.0) for k, (pivot, row) in enumerate(zip(found, rows, strict=True)))
    )


def _numbers(candidate: Candidate, values: Mapping[str, float]) -> list[list[float]]:
    return [[evaluate(entry, values) for entry in row] for row in candidate.matrix.rows]


def _is_definite(candidate: Candidate, values: Mapping[str, float]) -> bool:
    return is_positive_definite(_numbers(candidate, values), ROUNDING)


def verify(held: Held) -> None:
    """Hold the results as they are printed; raises VerificationError where one is wrong."""
    if "definite" in held.wanted:
        for candidate, found in zip(held.robot.questions.candidates, held.values["definite"], strict=True):
            if not isinstance(found, Skipped):
                verify_definite(held.robot, candidate, found, held.states)
