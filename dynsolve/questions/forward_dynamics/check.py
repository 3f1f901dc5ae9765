"""Forward dynamics, put back: with these accelerations the left side of the equations gives the forces.

Nothing is inverted or eliminated: D q̈ + C q̇ + friction + g, as it is printed, must be τ + Q.
"""

from __future__ import annotations

from collections.abc import Mapping
from itertools import islice

from dynsolve.derivation.arm_values import states_with
from dynsolve.errors import VerificationError
from dynsolve.notation.tree import Node
from dynsolve.notation.tree_values import compile_trees
from dynsolve.questions.held import Held
from dynsolve.questions.rates.check import TOLERANCE
from dynsolve.questions.statics.check import outside_forces
from dynsolve.robot.model import Robot

COMPARED = ("qdd_forward", "tau")
"""What is compared."""


def verify_forward(robot: Robot, results: Mapping[str, Node], states: int = 5) -> None:
    """Compare the printed form of `qdd_forward` with that of `tau` and the power of forces from outside.

    Raises VerificationError where it does not give the forces back.
    """
    found, left = compile_trees([results["qdd_forward"]]), compile_trees([results["tau"]])
    for values, (rows,) in islice(states_with(robot.ring, found.run), states):
        moved = {q.acceleration: row[0] for q, row in zip(robot.coordinates, rows, strict=True)}
        (theirs,) = left.run({**values, **moved})
        loads = outside_forces(robot, values)
        for k in range(robot.n):
            force = loads[k] + (0.0 if k in robot.actions.passive else values[robot.inputs[k]])
            size = max(1.0, abs(force), *map(abs, moved.values()))
            if not abs(theirs[k][0] - force) <= TOLERANCE * size:
                raise VerificationError("qdd_forward does not give the forces; this is a fault of dynsolve")


def verify(held: Held) -> None:
    """Hold the results as they are printed; raises VerificationError where one is wrong."""
    if "qdd_forward" in held.wanted and not held.robot.questions.constraints:  # else with λ
        held.hold(verify_forward, COMPARED)
