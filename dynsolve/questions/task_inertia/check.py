"""Λ J_r D⁻¹ J_rᵀ is the identity, with D⁻¹ J_rᵀ found by elimination on numbers."""

from __future__ import annotations

from collections.abc import Mapping
from itertools import islice

from dynsolve.derivation.arm_values import states_with
from dynsolve.derivation.elimination import solved
from dynsolve.notation.tree import Node
from dynsolve.notation.tree_values import compile_trees
from dynsolve.questions.held import Held, Rows, compare
from dynsolve.robot.model import Robot

COMPARED = ("Lambda", "Jr", "D")
"""What is compared."""


def verify_task_inertia(robot: Robot, results: Mapping[str, Node], states: int = 5) -> None:
    """Compare the printed forms of `COMPARED`; raises VerificationError where Λ is off."""
    program = compile_trees([results[name] for name in COMPARED])
    for _, (inertia, J, D) in islice(states_with(robot.ring, program.run), states):
        columns = [solved(D, row) for row in J]  # D⁻¹ Jᵀ
        mobility = _products(J, list(zip(*columns, strict=True)))
        compare(
            "Lambda",
            _products(inertia, mobility),
            [[float(i == j) for j in range(len(J))] for i in range(len(J))],
        )


def _products(left: Rows, right: Rows) -> Rows:
    columns = list(zip(*right, strict=True))
    return [[sum(a * b for a, b in zip(row, column, strict=True)) for column in columns] for row in left]


def verify(held: Held) -> None:
    """Hold the results as they are printed; raises VerificationError where one is wrong."""
    if "Lambda" in held.wanted:
        held.hold(verify_task_inertia, COMPARED)
