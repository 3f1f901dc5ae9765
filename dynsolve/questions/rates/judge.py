"""Joint rates and accelerations that are another solution than the key, and the equation that none may miss.

Every x with Jᵀ (J x - b) = 0 solves J x = b, or comes as near to it as can be where nothing does; the key
is the one of least norm.
"""

from __future__ import annotations

from dynsolve.algebra.fraction import RationalExpr, multiply, summed
from dynsolve.algebra.linear_systems import is_solvable, rank_parts
from dynsolve.algebra.matrix import AtState, Matrix
from dynsolve.algebra.ring_values import evaluate
from dynsolve.algebra.sampling import samples
from dynsolve.questions.judging import Case, Missed, right_as
from dynsolve.questions.rates.derive import wanted_by_accelerations

OF_MANY = "another solution than that of least norm, which is the key"

_ROUNDED = 0.02
"""A row that is missed by no more than this share of its terms may be missed by rounding alone."""

_LONGEST = 400
"""Values with more terms are not put into the equations."""


def _solves(case: Case) -> bool:
    """Whether rates or accelerations of the joints do what is asked of the task."""
    system = _in_numbers(case)
    return system is not None and not _rows_missed(case, system[0].T @ system[0], system[0].T @ system[1])


def _missed(case: Case) -> Missed | None:
    """The equation, and its first row, that they do not satisfy; None where there is none that is known."""
    system = _in_numbers(case)
    if system is None:
        return None
    J, right = system
    left, whole = ("ṙ", "J_r q̇") if case.node == "qd" else ("r̈", "J_r q̈ + J̇_r q̇")
    equation = f"{left} = {whole}"
    if not is_solvable(J, right):
        equation, J, right = f"J_rᵀ ({whole} - {left}) = 0", J.T @ J, J.T @ right
    rows = _rows_missed(case, J, right, _ROUNDED)
    is_one_of_many = rank_parts(J).rank < J.shape[1] or not equation.startswith(left)
    return Missed(equation, rows[0], is_one_of_many) if rows else None


def _in_numbers(case: Case) -> tuple[Matrix, Matrix] | None:
    """(J, b) with the problem's numbers; None also where an answer is too long to be put in."""
    system = _system(case)
    x = [case.in_numbers(entry) for entry in case.entries]
    if system is None or sum(len(entry.numerator) + len(entry.denominator) for entry in x) > _LONGEST:
        return None
    J, right = (m.map(lambda entry: case.in_numbers(RationalExpr(entry)).numerator) for m in system)
    return J, right


def _rows_missed(case: Case, matrix: Matrix, right: Matrix, share: float = 0.0) -> list[int]:
    """The rows, from 1, in which they do not solve matrix x = right, by more than a `share` of the terms."""
    x = [case.in_numbers(entry) for entry in case.entries]
    at = next(iter(samples(matrix.ring)))

    def size(value: RationalExpr) -> float:
        return abs(evaluate(value.numerator, at) / evaluate(value.denominator, at))

    found = []
    for k, (row, goal) in enumerate(zip(matrix.rows, right.entries, strict=True), 1):
        terms = [*map(multiply, map(RationalExpr, row), x), RationalExpr(-goal)]
        off = summed(terms, matrix.ring.zero)
        if not off.is_zero and (not share or size(off) > share * sum(map(size, terms))):
            found.append(k)
    return found


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


MISSED = {"qd": _missed, "qdd": _missed}
EQUIVALENCES = (right_as(OF_MANY, _solves, "qd", "qdd"),)
