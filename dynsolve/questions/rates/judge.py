"""Joint rates and accelerations that are another solution than the key.

Every x with Jᵀ (J x - b) = 0 solves J x = b, or comes as near to it as can be where nothing does; the key
is the one of least norm.
"""

from __future__ import annotations

from dynsolve.algebra.fraction import RationalExpr, multiply, summed
from dynsolve.algebra.matrix import AtState, Matrix
from dynsolve.questions.judging import Case, right_as
from dynsolve.questions.rates.derive import wanted_by_accelerations

OF_MANY = "another solution than that of least norm, which is the key"

_LONGEST = 400
"""Values with more terms are not put into the equations."""


def _solves(case: Case) -> bool:
    """Whether rates or accelerations of the joints do what is asked of the task."""
    system = _system(case)
    if system is None:
        return False
    J, right = (m.map(lambda entry: case.in_numbers(RationalExpr(entry)).numerator) for m in system)
    x = [case.in_numbers(entry) for entry in case.entries]
    if sum(len(entry.numerator) + len(entry.denominator) for entry in x) > _LONGEST:
        return False
    squares, wanted = J.T @ J, J.T @ right
    return all(
        summed(map(multiply, map(RationalExpr, row), x), -goal).is_zero
        for row, goal in zip(squares.rows, wanted.entries, strict=True)
    )


def _system(case: Case) -> tuple[Matrix, Matrix] | None:
    """(J, b) at the state, None of what is no solution of such a system."""
    asked = case.robot.questions
    at = AtState(case.robot.ring, asked.state.by_symbol)
    if case.node == "qd" and asked.velocity is not None:
        return at.matrix(case.result("Jr")), at.matrix(asked.velocity)
    if case.node == "qdd" and asked.acceleration is not None:
        wanted = wanted_by_accelerations(case.robot, asked.acceleration, case.result("Jr_dot"))
        return at.matrix(case.result("Jr")), at.matrix(wanted)
    return None


EQUIVALENCES = (right_as(OF_MANY, _solves, "qd", "qdd"),)
