"""The linear model near an equilibrium, compared with numbers.

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
from dynsolve.errors import VerificationError
from dynsolve.notation.tree import Node, Symbol, names_in
from dynsolve.notation.tree_values import Program, compile_trees, plain_name
from dynsolve.questions.equilibria.linearization import driven
from dynsolve.questions.held import compare
from dynsolve.questions.statics.check import outside_forces
from dynsolve.robot.model import Robot

_STEP = 1e-4


def linear_names(wanted: frozenset[str]) -> tuple[str, ...]:
    """Which of the wanted results are compared, with what they are compared with."""
    near = [name for name in ("linear_A", "linear_B") if name in wanted]
    return (*near, "D", "tau") if near else ()


def verify_linear(robot: Robot, results: Mapping[str, Node], states: int = 5) -> None:
    """Compare printed forms with elimination and differences on numbers (see `linear_names`).

    Raises VerificationError where one is off.
    """
    if not results:
        return
    linear = (results[name] for name in ("linear_A", "linear_B") if name in results)
    if not names_in(*linear).isdisjoint(robot.ring.names):
        raise VerificationError("the linear model is taken elsewhere; this is a fault of dynsolve")
    program = compile_trees(list(results.values()))
    for values, _ in islice(states_with(robot.ring, program.run), states):
        _verify_near(robot, results, _equilibrium(robot, values), program)


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
    held = _less_outside(robot, at_rest["tau"], rest)

    def accelerations(**moved: float) -> list[float]:
        at = {**rest, **moved}
        here = dict(zip(names, program.run(at), strict=True))
        left = _less_outside(robot, here["tau"], at)
        return solved(here["D"], [h - force for h, force in zip(held, left, strict=True)])

    n = robot.n
    if "linear_A" in results:
        columns = [_by_coordinate(accelerations, q.name, rest[q.name]) for q in robot.coordinates]
        columns += [_by_rate(accelerations, q.velocity) for q in robot.coordinates]
        upper = [[float(j == n + i) for j in range(2 * n)] for i in range(n)]
        compare("linear_A", at_rest["linear_A"], [*upper, *map(list, zip(*columns, strict=True))])
    if "linear_B" in results:
        units = [[float(i == k) for i in range(n)] for k in driven(robot)]
        columns = [solved(at_rest["D"], unit) for unit in units]
        zeros = [[0.0] * len(units) for _ in range(n)]
        compare("linear_B", at_rest["linear_B"], [*zeros, *map(list, zip(*columns, strict=True))])


def _less_outside(robot: Robot, tau: Sequence[Sequence[float]], at: Mapping[str, float]) -> list[float]:
    """τ - Q"""
    return [row[0] - load for row, load in zip(tau, outside_forces(robot, at), strict=True)]


def _by_coordinate(accelerations: Any, name: str, at: float) -> list[float]:
    ahead, behind = (accelerations(**{name: at + step}) for step in (_STEP, -_STEP))
    return [(a - b) / (2 * _STEP) for a, b in zip(ahead, behind, strict=True)]


def _by_rate(accelerations: Any, name: str) -> list[float]:
    """((f(2) - f(-2)) - (f(1) - f(-1))) / 2: exact for f = a + b x + c x² + d sgn x."""
    far, near, back, opposite = (accelerations(**{name: x}) for x in (2.0, 1.0, -1.0, -2.0))
    return [(a - d - b + c) / 2 for a, b, c, d in zip(far, near, back, opposite, strict=True)]
