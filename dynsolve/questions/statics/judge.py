"""Forces from outside on the side of the motors."""

from __future__ import annotations

from dynsolve.algebra.matrix import Matrix
from dynsolve.quantities import families
from dynsolve.questions.judging import Case, right_as
from dynsolve.questions.statics.derive import total

WITHOUT_LOADS = "right with the forces from outside moved over: here τ is the left side, τ + Q the right"


def _is_what_motors_give(case: Case) -> bool:
    """Whether forces are D q̈ + C q̇ + friction + g - Q: what is left for the motors."""
    robot, key = case.robot, case.key
    if not robot.questions.loads:
        return False
    parts = tuple(case.result(f"load{i}") for i, _ in enumerate(robot.questions.loads, 1))
    Q = total(robot, parts)
    wanted = (key - Q).entries if isinstance(key, Matrix) else (key - Q[case.index - 1, 0],)
    return case.is_entry_by_entry(wanted)


EQUIVALENCES = (right_as(WITHOUT_LOADS, _is_what_motors_give, families.TAU, families.FORCE),)
