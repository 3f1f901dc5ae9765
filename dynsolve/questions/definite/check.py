"""Whether matrices are positive definite, held at random values of parameters and coordinates.

Symmetric elimination on numbers: a matrix is positive definite exactly if every pivot is positive.
It shares nothing with the minors and their smallest values.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from random import Random

from dynsolve.algebra.inequality import Bound
from dynsolve.algebra.ring_values import evaluate
from dynsolve.derivation.elimination import is_positive_definite
from dynsolve.derivation.graph import Skipped
from dynsolve.errors import VerificationError
from dynsolve.questions.definite.derive import Answer, Definiteness, Refusal
from dynsolve.questions.held import Held
from dynsolve.robot.model import JointType, Robot
from dynsolve.robot.questions import Candidate

SEED = 20_190_429


DRAWS = 20_000
"""So many values are drawn in the search for some that satisfy what is assumed."""


POSES = 200


def verify_definite(robot: Robot, candidate: Candidate, found: Definiteness, states: int) -> None:
    """Hold a verdict at random values; raises VerificationError where it is wrong."""
    random = Random(SEED)  # noqa: S311 - the same values every time are wanted
    bounds = (*candidate.assumed, *found.conditions)
    if found.refusal not in (None, Refusal.INDEFINITE):
        return
    for parameters in _parameters(candidate, bounds, random, states):
        every = all(_is_definite(candidate, values) for values in _poses(robot, parameters, random))
        if every != (found.answer is not Answer.NO):
            raise VerificationError(
                f"whether {candidate.name} is positive definite comes out otherwise on numbers; "
                "this is a fault of dynsolve"
            )


def _parameters(
    candidate: Candidate, bounds: Sequence[Bound], random: Random, states: int
) -> Iterator[dict[str, float]]:
    """Values of the parameters that satisfy inequalities."""
    ring, count = candidate.matrix.ring, 0
    for _ in range(DRAWS):
        values = {
            name: random.choice((random.uniform(-2, 2), random.uniform(0.1, 3))) for name in ring.parameters
        }
        if all(evaluate(b.value, values) > 1e-3 * b.is_strict for b in bounds):
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


def _is_definite(candidate: Candidate, values: Mapping[str, float]) -> bool:
    rows = [[evaluate(entry, values) for entry in row] for row in candidate.matrix.rows]
    return is_positive_definite(rows, 1e-12)


def verify(held: Held) -> None:
    """Hold the results as they are printed; raises VerificationError where one is wrong."""
    if "definite" in held.wanted:
        for candidate, found in zip(held.robot.questions.candidates, held.values["definite"], strict=True):
            if not isinstance(found, Skipped):
                verify_definite(held.robot, candidate, found, held.states)
