"""Linearization and the inertia of the task, compared with numbers.

The accelerations D⁻¹(τ - C q̇ - friction - g) are found by elimination from D and τ as they are
printed, and differentiated by differences about the equilibrium; of the rates by second
differences of what is odd in them, in which neither C q̇ nor a sign has a part.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import islice
from typing import Any

from dynsolve.derivation.arm_values import states_with
from dynsolve.derivation.elimination import solved
from dynsolve.derivation.linearization import driven
from dynsolve.errors import VerificationError
from dynsolve.notation.tree import Node, Symbol
from dynsolve.notation.tree_values import Program, compile_trees, plain_name
from dynsolve.robot.model import Robot

TOLERANCE = 1e-5
"""The largest error of an entry, relative to the largest: differences are no derivatives."""

_STEP = 1e-4

_NEAR = ("linear_A", "linear_B", "D", "tau")
"""What is compared near the equilibrium."""

Rows = list[list[float]]


def linear_names(wanted: frozenset[str]) -> tuple[str, ...]:
    """Which of the wanted results are compared, with what they are compared with."""
    near = [name for name in ("linear_A", "linear_B") if name in wanted]
    found = [*near, *(("D", "tau") if near else ())]
    return tuple(dict.fromkeys((*found, *(("Lambda", "Jr", "D") if "Lambda" in wanted else ()))))


def verify_linear(robot: Robot, results: Mapping[str, Node], states: int = 5) -> None:
    """Compare printed forms with elimination and differences on numbers (see `linear_names`).

    Raises VerificationError where one is off.
    """
    if not results:
        return
    program = compile_trees(list(results.values()))
    near = {name: results[name] for name in _NEAR if name in results}  # where Lambda may be singular
    near_program = compile_trees(list(near.values()))
    for values, found in islice(states_with(robot.ring, program.run), states):
        here = dict(zip(results, found, strict=True))
        if "Lambda" in here:
            _compare("Lambda", _products(here["Lambda"], _mobility(here)), _identity(len(here["Jr"])))
        if "tau" in near:
            _verify_near(robot, near, _equilibrium(robot, values), near_program)


def _compare(name: str, ours: Sequence[Sequence[float]], theirs: Sequence[Sequence[float]]) -> None:
    size = max((1.0, *(abs(x) for row in theirs for x in row)))
    gaps = (abs(a - b) for r, s in zip(ours, theirs, strict=True) for a, b in zip(r, s, strict=True))
    if not all(gap <= TOLERANCE * size for gap in gaps):
        raise VerificationError(f"{name} differs from elimination on numbers; this is a fault of dynsolve")


def _mobility(here: Mapping[str, Any]) -> Rows:
    """J D⁻¹ Jᵀ"""
    J = here["Jr"]
    columns = [solved(here["D"], row) for row in J]
    return [[sum(a * b for a, b in zip(row, column, strict=True)) for column in columns] for row in J]


# -- near an equilibrium ---------------------------------------------------------------------------


def _equilibrium(robot: Robot, values: Mapping[str, float]) -> dict[str, float]:
    """The values with the equilibrium in them, at rest."""
    at = robot.questions.model.equilibrium
    numbers = compile_trees(list(at.values())).run(values)
    still = {name: 0.0 for q in robot.coordinates for name in (q.velocity, q.acceleration)}
    return {**values, **{plain_name(Symbol(*key)): x for key, x in zip(at, numbers, strict=True)}, **still}


def _verify_near(
    robot: Robot, results: Mapping[str, Node], rest: Mapping[str, float], program: Program
) -> None:
    names = list(results)
    at_rest = dict(zip(names, program.run(rest), strict=True))
    held = [row[0] for row in at_rest["tau"]]

    def accelerations(**moved: float) -> list[float]:
        here = dict(zip(names, program.run({**rest, **moved}), strict=True))
        return solved(here["D"], [h - row[0] for h, row in zip(held, here["tau"], strict=True)])

    n = robot.n
    if "linear_A" in results:
        columns = [_by_coordinate(accelerations, q.name, rest[q.name]) for q in robot.coordinates]
        columns += [_by_rate(accelerations, q.velocity) for q in robot.coordinates]
        upper = [[float(j == n + i) for j in range(2 * n)] for i in range(n)]
        _compare("linear_A", at_rest["linear_A"], [*upper, *map(list, zip(*columns, strict=True))])
    if "linear_B" in results:
        units = [[float(i == k) for i in range(n)] for k in driven(robot)]
        columns = [solved(at_rest["D"], unit) for unit in units]
        zeros = [[0.0] * len(units) for _ in range(n)]
        _compare("linear_B", at_rest["linear_B"], [*zeros, *map(list, zip(*columns, strict=True))])


def _by_coordinate(accelerations: Any, name: str, at: float) -> list[float]:
    ahead, behind = (accelerations(**{name: at + step}) for step in (_STEP, -_STEP))
    return [(a - b) / (2 * _STEP) for a, b in zip(ahead, behind, strict=True)]


def _by_rate(accelerations: Any, name: str) -> list[float]:
    """((f(2) - f(-2)) - (f(1) - f(-1))) / 2: exact for f = a + b x + c x² + d sgn x."""
    far, near, back, opposite = (accelerations(**{name: x}) for x in (2.0, 1.0, -1.0, -2.0))
    return [(a - d - b + c) / 2 for a, b, c, d in zip(far, near, back, opposite, strict=True)]


# -- matrices of numbers ---------------------------------------------------------------------------


def _products(left: Sequence[Sequence[float]], right: Sequence[Sequence[float]]) -> Rows:
    columns = list(zip(*right, strict=True))
    return [[sum(a * b for a, b in zip(row, column, strict=True)) for column in columns] for row in left]


def _identity(size: int) -> Rows:
    return [[float(i == j) for j in range(size)] for i in range(size)]
