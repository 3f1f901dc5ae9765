"""Configurations in numbers: solutions put into formulas, and zeros found by Newton's method from samples."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from itertools import islice, product
from math import pi
from typing import Any

from msgspec import Struct

from dynsolve.algebra.sampling import ENOUGH
from dynsolve.derivation.arm_values import states_with
from dynsolve.derivation.elimination import rank, shortest_step
from dynsolve.derivation.reached import CLOSE, near
from dynsolve.notation.tree import Node
from dynsolve.notation.tree_values import Program, compile_trees
from dynsolve.robot.model import Robot

NEWTON_STEPS = 60
MOST_TURNS = 128
DIFFERENCE = 1e-6
SMALL = 1e-9

Values = Mapping[str, float]


class Condition(Struct, frozen=True):
    """Two formulas that are to be equal, angles modulo 2π."""

    sides: tuple[Node, Node]
    is_angle: bool = False


Conditions = tuple[Condition, ...]

NO_VALUE = (KeyError, ValueError, TypeError, ArithmeticError)
"""What is raised where a formula has no real value, or lacks one of a name."""


def reaches(task: Program, q: Values) -> list[float]:
    """r(q)"""
    (value,) = task.run(q)
    return flat(value)


def on_branch(branch: Mapping[str, Node], given: Values) -> dict[str, float] | None:
    """The configuration; None where the branch does not exist, or a formula lacks a value."""
    return solution_of(branch)(given)


def holds(condition: Condition, values: Values) -> bool:
    """Whether both sides of a condition are the same."""
    return solution_of({}, (condition,))(values) is not None


def solution_of(
    branch: Mapping[str, Node], when: Conditions = ()
) -> Callable[[Values], dict[str, float] | None]:
    """The same as `on_branch` for many places; None where a condition does not hold, too."""
    try:
        programs = {name: compile_trees([formula]) for name, formula in branch.items()}
        sides = compile_trees([side for one in when for side in one.sides])
    except NO_VALUE:
        return lambda given: None
    turns = [one.is_angle for one in when]

    def at(given: Values) -> dict[str, float] | None:
        q = dict(given)
        try:
            for name, program in programs.items():
                (q[name],) = program.run(q)
            values = sides.run(q)
        except NO_VALUE:
            return None
        return q if near(values[1::2], values[::2], turns) else None

    return at


def states_of(robot: Robot, program: Program, first: int = 0) -> list[dict[str, float]]:
    """Configurations in all quadrants with parameters for which formulas have a value."""
    found = states_with(robot.ring, program.run, first=first)
    return [values for values, _ in islice(found, ENOUGH)]


def zero_near(robot: Robot, zeros: Program, start: Values) -> dict[str, float] | None:
    """A configuration near `start` at which everything is 0, by Newton's method; None where none is found."""
    try:
        return _newton(robot, zeros, start)
    except NO_VALUE:
        return None


def with_half_turns(
    robot: Robot, zeros: Program, points: Iterable[dict[str, float]]
) -> Iterator[dict[str, float]]:
    """Points at which everything is 0, and those that are the first of them with angles half a turn on.

    Which of q = 0 and q = π Newton's method finds of sin q = 0 is chance; these are all.
    """
    turning = [name for name, kind in robot.ring.coordinates if kind == "revolute"]
    for number, q in enumerate(points):
        yield q
        ways = product((0.0, pi), repeat=len(turning)) if number == 0 else ()
        for turns in islice(ways, 1, MOST_TURNS):
            turned = q | {name: q[name] + turn for name, turn in zip(turning, turns, strict=True)}
            if is_zero(zeros, turned):
                yield turned


def is_zero(program: Program, at: Values) -> bool:
    """Whether everything is 0, and has a value."""
    try:
        return all(abs(value) < CLOSE for value in program.run(at))
    except NO_VALUE:
        return False


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
        sizes = (max(1.0, *map(abs, row)) for row in rows)
        if moved < SMALL and max(abs(value) / size for value, size in zip(f, sizes, strict=True)) < CLOSE**2:
            return at
    return None


def rank_of(rows: Sequence[Sequence[float]]) -> int:
    """The rank of a Jacobian in numbers."""
    return rank(rows, CLOSE, scale=1.0)


def flat(value: Any) -> list[float]:
    """The entries of a matrix, row by row."""
    return [entry for row in value for entry in row]
