"""Conditions on parameters, compared with numbers: where they hold, gravity must be what is asked for.

Points are found by Newton's method, in which masses and the acceleration of gravity stay, and the
lengths of the table where they can.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import islice

from dynsolve.algebra.floats import evaluate
from dynsolve.algebra.sampling import samples
from dynsolve.derivation.balance import never_zero, table_lengths
from dynsolve.derivation.equilibrium_check import zero_along
from dynsolve.derivation.reached import CLOSE
from dynsolve.errors import VerificationError
from dynsolve.notation.tree import Node
from dynsolve.notation.tree_values import compile_trees
from dynsolve.robot.model import Robot

STATES = 6


def balanced_points(robot: Robot, conditions: Sequence[Node]) -> Iterator[dict[str, float]]:
    """Values of all parameters at which all conditions are 0, each with a configuration."""
    program = compile_trees(list(conditions))
    free = sorted(set(robot.parameters) - never_zero(robot))
    places = [name for name in free if name not in table_lengths(robot)]
    for start in islice(samples(robot.ring), STATES):
        found = (zero_along(names, program, start) for names in (places, free)) if conditions else (start,)
        yield from islice((at for at in found if at is not None), 1)


def is_balanced(robot: Robot, gravity: Node, at: Mapping[str, float]) -> bool:
    """Whether gravity is what is asked for."""
    wanted = robot.questions.model.balanced
    found = compile_trees([gravity]).run(at)[0]
    given = [0.0] * robot.n if wanted is None else [evaluate(e, at) for e in wanted.entries]
    return all(abs(row[0] - other) < CLOSE for row, other in zip(found, given, strict=True))


def verify_balance(robot: Robot, gravity: Node, conditions: Sequence[Node]) -> None:
    """Raises VerificationError where the conditions hold and gravity is not what is asked for."""
    if not all(is_balanced(robot, gravity, at) for at in balanced_points(robot, conditions)):
        raise VerificationError("gravity is not balanced where it should be; this is a fault of dynsolve")
