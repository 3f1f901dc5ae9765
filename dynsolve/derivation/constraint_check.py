"""Constraints, compared with the motion of the arm, and the multipliers with elimination on numbers.

The functions h, A_c and its rate are held to the motion as a task is.  With the multipliers put into
the equations of motion the accelerations are found by elimination; they must keep the constraint.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from itertools import islice
from typing import Any

from dynsolve.derivation.arm_values import arms
from dynsolve.derivation.constraints import holonomic
from dynsolve.derivation.elimination import solved
from dynsolve.derivation.kinematic_check import verify_kinematics
from dynsolve.derivation.rate_check import TOLERANCE
from dynsolve.errors import VerificationError
from dynsolve.notation.tree import Matrix, Node
from dynsolve.notation.tree_values import compile_trees
from dynsolve.robot.model import Robot
from dynsolve.robot.questions import Task

Rows = Sequence[Sequence[float]]

ACTING = ("Cqd", "g", "Q", "friction")
"""What stands beside D q̈, τ and A_cᵀ λ in the equations of motion; Q on the side of τ."""


def verify_constraints(robot: Robot, results: Mapping[str, Node], states: int = 5) -> None:
    """Compare printed forms of `hc`, `Ac`, `Ac_dot` and `lambda` with computations on numbers.

    With `lambda` come `D` and those of `ACTING` that there are.  Raises VerificationError where one is
    wrong.
    """
    _verify_functions(robot, results, states)
    _verify_rates(robot, results, states)
    if "lambda" in results:
        _verify_multipliers(robot, results, states)


def _verify_functions(robot: Robot, results: Mapping[str, Node], states: int) -> None:
    """h, and the rows of A_c and its rate that belong to it, as a task and its Jacobian."""
    if not holonomic(robot):
        return
    asked = robot.questions
    task = Task(tuple(one.entry for one in holonomic(robot)))
    places = [i for i, one in enumerate(asked.constraints) if not one.in_rates]
    held = {"r": results["hc"]}
    for mine, name in (("Jr", "Ac"), ("Jr_dot", "Ac_dot")):
        form = results.get(name)
        if isinstance(form, Matrix):
            held[mine] = Matrix(tuple(form.rows[i] for i in places))
    verify_kinematics(replace(robot, questions=replace(asked, task=task)), held, states)


def _verify_rates(robot: Robot, results: Mapping[str, Node], states: int) -> None:
    """A_c q̇ is what a constraint on the rates says is 0."""
    places = [i for i, one in enumerate(robot.questions.constraints) if one.in_rates]
    if not places:
        return
    program = compile_trees([results["Ac"], *(robot.questions.constraints[i].entry for i in places)])
    for values, _ in islice(arms(robot), states):
        A, *wanted = program.run(values)
        rates = [values[q.velocity] for q in robot.coordinates]
        for i, theirs in zip(places, wanted, strict=True):
            mine = _dot(A[i], rates)
            if not abs(mine - theirs) <= TOLERANCE * max(1.0, abs(theirs)):
                raise VerificationError("Ac differs from the constraint; this is a fault of dynsolve")


def _verify_multipliers(robot: Robot, results: Mapping[str, Node], states: int) -> None:
    program = compile_trees(list(results.values()))
    for values, _ in islice(arms(robot), states):
        ours = dict(zip(results, program.run(values), strict=True))
        rates = [values[q.velocity] for q in robot.coordinates]
        qdd = solved(ours["D"], _forces(robot, values, ours))
        gaps = [
            abs(_dot(row, qdd) + _dot(moved, rates))
            for row, moved in zip(ours["Ac"], ours["Ac_dot"], strict=True)
        ]
        if not max(gaps) <= TOLERANCE * max((1.0, *map(abs, qdd))):
            raise VerificationError("lambda does not keep the constraint; this is a fault of dynsolve")


def _forces(robot: Robot, values: Mapping[str, float], ours: Mapping[str, Any]) -> list[float]:
    """τ + Q + A_cᵀ λ - C q̇ - g"""
    found = []
    for k, q in enumerate(robot.coordinates):
        total = 0.0 if k in robot.actions.passive else values[q.force]
        total += sum(row[k] * x for row, (x,) in zip(ours["Ac"], ours["lambda"], strict=True))
        for name in ACTING:
            if name in ours:
                total += ours[name][k][0] * (1 if name == "Q" else -1)
        found.append(total)
    return found


def _dot(a: Sequence[float], b: Sequence[float]) -> float:
    return sum(x * y for x, y in zip(a, b, strict=True))
