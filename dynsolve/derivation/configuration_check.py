"""Branches of the inverse kinematics and singular configurations as they are printed, held in numbers.

A branch is put into r(q) at values of the task that a random configuration reaches; one of the
branches must be that configuration.  Where an alternative of a singular set holds, found by
Newton's method from random configurations, the Jacobian has less than its greatest rank; at
random configurations it has that rank.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from operator import mul
from random import Random
from typing import Any

from dynsolve.derivation.arm_values import draw
from dynsolve.derivation.elimination import rank, shortest_step
from dynsolve.derivation.reached import CLOSE, near, same_configuration
from dynsolve.derivation.verification import SEED
from dynsolve.errors import VerificationError
from dynsolve.notation.tree import Node
from dynsolve.notation.tree_values import Program, compile_trees, evaluate
from dynsolve.robot.model import Robot

STATES = 8
NEWTON_STEPS = 60
DIFFERENCE = 1e-6
SMALL = 1e-9

Values = Mapping[str, float]


@dataclass(frozen=True, slots=True)
class Condition:
    """Two formulas that are to be equal, angles modulo 2π."""

    sides: tuple[Node, Node]
    is_angle: bool = False


Conditions = tuple[Condition, ...]

NO_VALUE = (KeyError, ValueError, TypeError, ArithmeticError)
"""What is raised where a formula has no real value, or lacks one of a name."""


def verify_inverse(
    robot: Robot, r: Node, angles: Sequence[bool], branches: Sequence[tuple[Mapping[str, Node], Conditions]]
) -> None:
    """Put every branch into r(q), whose components are lengths or `angles`, where its conditions hold.

    Raises VerificationError where one is none, or one is missing.
    """
    task = compile_trees([r])
    for values in states_of(robot):
        reached = reaches(task, values)
        given = {**values, **dict(zip(robot.questions.reached, reached, strict=True))}
        found = [q for q in (on_branch(*branch, given) for branch in branches) if q is not None]
        if not all(near(reaches(task, q), reached, angles) for q in found):
            raise VerificationError("a branch of the inverse kinematics does not reach what it should")
        if not any(same_configuration(robot.ring, q, values) for q in found):
            raise VerificationError("a branch of the inverse kinematics is missing")


def verify_target(
    robot: Robot,
    r: Node,
    angles: Sequence[bool],
    given: Values,
    configurations: Sequence[tuple[Mapping[str, Node], Sequence[str]]],
) -> None:
    """Put configurations as they are printed into r(q), each with the names of what is free in it.

    `given` are the values of the parameters and of the task.  Raises VerificationError where one
    does not reach the target.
    """
    task = compile_trees([r])
    wanted = [given[name] for name in robot.questions.reached]
    for formulas, free in configurations:
        for place in (0.0, 1.0) if free else (0.0,):
            q = on_branch(formulas, (), {**given, **dict.fromkeys(free, place)})
            if q is None or not near(reaches(task, q), wanted, angles):
                raise VerificationError("a configuration does not reach the target of the inverse kinematics")


def reaches(task: Program, q: Values) -> list[float]:
    """r(q)"""
    (value,) = task.run(q)
    return _flat(value)


def on_branch(branch: Mapping[str, Node], when: Conditions, given: Values) -> dict[str, float] | None:
    """The configuration; None where the branch does not exist or a condition does not hold."""
    q = dict(given)
    try:
        for name, formula in branch.items():
            q[name] = evaluate(formula, q)
        return q if all(holds(one, q) for one in when) else None
    except NO_VALUE:
        return None


def holds(condition: Condition, values: Values) -> bool:
    """Whether both sides of a condition are the same, those of angles modulo 2π."""
    left, right = (float(evaluate(side, values)) for side in condition.sides)
    return near([right], [left], [condition.is_angle])


@dataclass(frozen=True, slots=True)
class Singular:
    """Expressions that are 0 together, the rank there, and the directions that are lost, m×1 each."""

    zeros: Sequence[Node]
    rank: int
    lost: Sequence[Node]


def verify_singular(robot: Robot, jacobian: Node, rank: int, cases: Sequence[Singular]) -> None:
    """Compare the rank of a Jacobian at singular and at other configurations.

    Raises VerificationError where it is not what it should be, or a lost direction is none.
    """
    program = compile_trees([jacobian])
    for values in states_of(robot):
        if rank_of(program.run(values)[0]) != rank:
            raise VerificationError("the rank of the Jacobian is not what it should be")
    for case in cases:
        zeros, lost = compile_trees(case.zeros), compile_trees(case.lost)
        found = (zero_near(robot, zeros, values) for values in states_of(robot))
        ranks: list[int] = []
        for at in (values for values in found if values is not None):
            J = program.run(at)[0]
            ranks.append(rank_of(J))
            columns = list(zip(*J, strict=True))
            if any(abs(sum(map(mul, _flat(w), column))) > CLOSE for w in lost.run(at) for column in columns):
                raise VerificationError("a direction that should be lost is not")
        if ranks and max(ranks) != case.rank:  # it is less where an alternative meets itself or another
            raise VerificationError("the rank at a singular configuration is not what it should be")


def states_of(robot: Robot) -> Iterator[dict[str, float]]:
    """Random configurations with values for the parameters, the same ones every time."""
    random = Random(SEED)  # noqa: S311 - the same states every time are wanted
    for _ in range(STATES):
        yield dict(draw(robot, random)[0])


def zero_near(robot: Robot, zeros: Program, start: Values) -> dict[str, float] | None:
    """A configuration near `start` at which everything is 0, by Newton's method; None where none is found."""
    try:
        return _newton(robot, zeros, start)
    except NO_VALUE:
        return None


def _newton(robot: Robot, zeros: Program, start: Values) -> dict[str, float] | None:
    """Until nothing moves any more: near a double root, as of cos q = 1, an equation is 0 long before."""
    at = dict(start)
    names = [q.name for q in robot.coordinates]
    for _ in range(NEWTON_STEPS):
        f = zeros.run(at)
        ahead, behind = (
            [zeros.run({**at, name: at[name] + step}) for name in names] for step in (DIFFERENCE, -DIFFERENCE)
        )
        rows = [
            [(a[k] - b[k]) / (2 * DIFFERENCE) for a, b in zip(ahead, behind, strict=True)]
            for k in range(len(f))
        ]
        step = shortest_step(f, rows)
        for name, x in zip(names, step, strict=True):
            at[name] += x
        moved = max(map(abs, step), default=0.0)
        if moved < SMALL and max(map(abs, f)) < CLOSE**2:
            return at
    return None


def rank_of(rows: Sequence[Sequence[float]]) -> int:
    """The rank of a Jacobian in numbers."""
    return rank(rows, CLOSE, scale=1.0)


def _flat(value: Any) -> list[float]:
    return [entry for row in value for entry in row]
