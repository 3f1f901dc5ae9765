"""Whether a matrix can be an inertia matrix: symmetric, of the coordinates as D is, positive definite.

An inertia matrix is made of sines and cosines of angles, and is at most quadratic in lengths;
of a chain with relative coordinates the first one does not occur.  It is positive definite for
every q exactly if its leading minors are positive for every q (Sylvester).  Each minor is taken
to its smallest value over one coordinate after the other, which leaves inequalities between
parameters: those that do not follow from what is assumed are the conditions.

Spong, Hutchinson, Vidyasagar, section 7.5; De Luca, Robotics 2, midterm of 29 April 2019.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from enum import Enum
from random import Random

from dynsolve.algebra.expr import Expr
from dynsolve.algebra.floats import evaluate
from dynsolve.algebra.inequality import Bound, follows, independent, opposite, simplified
from dynsolve.algebra.matrix import Matrix
from dynsolve.algebra.minors import determinant, work
from dynsolve.derivation.graph import Rule, Skipped
from dynsolve.derivation.smallest import Extreme, smallest
from dynsolve.robot.candidates import Candidate
from dynsolve.robot.model import JointType, Robot

MOST_WORK = 20_000
"""The products of terms that a determinant may come to."""

TRIES = 4000
"""So many values of the parameters are tried for a case in which the conditions hold."""


class Answer(Enum):
    """Whether it can be one: for all parameters that are assumed, for some of them, or for none."""

    YES = "yes"
    IF = "if"
    NO = "no"


class Refusal(Enum):
    """Why it can be none."""

    ASYMMETRIC = "it is not symmetric"
    NOT_PERIODIC = "an angle stands outside of sines and cosines"
    LENGTH_IN_SINE = "a length stands in a sine or cosine"
    DEGREE = "a length stands in a higher power than the second"
    BASE = "it depends on the coordinate of the base"
    INDEFINITE = "it is not positive definite"


@dataclass(frozen=True, slots=True)
class Definiteness:
    """What is found of a matrix.

    `minors` are its leading ones; `conditions` what the parameters must satisfy beyond what is
    assumed.  Of a matrix that can be none `refusal` says why, `place` the entry (from 0), `extreme` where
    which minor (its `size`) is not positive.  `moves_with_base` is a remark.
    """

    name: str
    answer: Answer
    minors: tuple[Expr, ...] = ()
    conditions: tuple[Bound, ...] = ()
    refusal: Refusal | None = None
    place: tuple[int, int] = (0, 0)
    coordinate: str = ""
    extreme: Extreme | None = None
    size: int = 0
    moves_with_base: bool = False


def definite_rules(robot: Robot) -> Iterator[Rule]:
    """What is found of each matrix that is to be judged."""
    candidates = robot.questions.candidates
    yield Rule("definite", (), lambda: tuple(definiteness(robot, candidate) for candidate in candidates))


def definiteness(robot: Robot, candidate: Candidate) -> Definiteness | Skipped:
    """Whether a matrix can be an inertia matrix, for every q and the parameters that are assumed."""
    matrix, name = candidate.matrix, candidate.name
    refused = next(_refusals(robot, candidate), None)
    if refused is not None:
        return refused
    if work(matrix) > MOST_WORK:
        return Skipped(f"the leading minors of {name} are too long")
    minors = tuple(_leading(matrix))
    first = matrix.ring.names[0]
    moves = any(not matrix.ring.diff(entry, 0).is_zero for entry in matrix.entries) and bool(first)
    needed: list[Bound] = []
    for size, minor in enumerate(minors, 1):
        extremes = smallest(minor, candidate.assumed)
        if extremes is None:
            return Skipped(f"the smallest value of the {size}×{size} minor of {name} is not found")
        for extreme in extremes:
            if follows(extreme.bound, candidate.assumed):
                continue
            if follows(opposite(extreme.bound), candidate.assumed):
                found = Definiteness(name, Answer.NO, minors, (), Refusal.INDEFINITE, moves_with_base=moves)
                return replace(found, extreme=extreme, size=size)
            bound = simplified(extreme.bound, [*candidate.assumed, *needed])
            if not follows(bound, needed):
                needed.append(bound)
    conditions = independent(needed, candidate.assumed)
    if conditions and not _is_possible(matrix, (*candidate.assumed, *conditions)):
        return Skipped(f"whether {name} is positive definite for some parameters is not found")
    answer = Answer.IF if conditions else Answer.YES
    return Definiteness(name, answer, minors, conditions, moves_with_base=moves)


def _leading(matrix: Matrix) -> Iterator[Expr]:
    for size in range(1, matrix.shape[0] + 1):
        yield determinant(matrix.block(0, size, 0, size))


def _is_possible(matrix: Matrix, bounds: Sequence[Bound]) -> bool:
    """Whether there are parameters that satisfy all inequalities: tried at random, the same every time."""
    ring, random = matrix.ring, Random(TRIES)  # noqa: S311 - the same values every time are wanted
    for _ in range(TRIES):
        values = {
            name: random.choice((random.uniform(-3, 3), random.uniform(0, 3))) for name in ring.parameters
        }
        if all(evaluate(b.value, values) > (1e-9 if b.is_strict else -1e-9) for b in bounds):
            return True
    return False


# -- what no inertia matrix has --------------------------------------------------------------------


def _refusals(robot: Robot, candidate: Candidate) -> Iterator[Definiteness]:
    """Why it can be none, but for its definiteness."""
    matrix, n = candidate.matrix, candidate.matrix.shape[0]
    refused = Definiteness(candidate.name, Answer.NO)
    for i in range(n):
        for j in range(i):
            if matrix[i, j] != matrix[j, i]:
                yield replace(refused, refusal=Refusal.ASYMMETRIC, place=(i, j))
    for q in robot.coordinates:
        for i in range(n):
            for j in range(i + 1):
                refusal = _of_entry(matrix[i, j], q.name, q.type)
                if refusal is not None:
                    yield replace(refused, refusal=refusal, place=(i, j), coordinate=q.name)
    if candidate.is_relative:
        for i in range(n):
            for j in range(i + 1):
                if not matrix.ring.diff(matrix[i, j], 0).is_zero:
                    base = robot.coordinates[0].name
                    yield replace(refused, refusal=Refusal.BASE, place=(i, j), coordinate=base)


def _of_entry(entry: Expr, name: str, kind: JointType) -> Refusal | None:
    """What is wrong with how an entry depends on a coordinate."""
    ring, degrees = entry.ring, entry.poly.degrees()
    degree = degrees[ring.symbol_indices[(name, 0)]]
    if kind is JointType.REVOLUTE:
        return Refusal.NOT_PERIODIC if degree > 0 else None
    turning = [pair for pair in ring.pairs if any(name == n for atom, _ in pair.angle.terms for n, _ in atom)]
    if any(degrees[pair.sine] > 0 or degrees[pair.cosine] > 0 for pair in turning):
        return Refusal.LENGTH_IN_SINE
    return Refusal.DEGREE if degree > 2 else None
