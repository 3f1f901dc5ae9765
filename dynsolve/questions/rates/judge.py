"""Joint rates and accelerations that are another solution than the key, and the equation that none may miss.

Every x with Jᵀ (J x - b) = 0 solves J x = b, or comes as near to it as can be where nothing does; the key
is the one of least norm.
"""

from __future__ import annotations

from collections.abc import Sequence

from msgspec import Struct

from dynsolve.algebra.fraction import RationalExpr, multiply, same, summed
from dynsolve.algebra.linear_systems import is_solvable, rank_parts
from dynsolve.algebra.matrix import AtState, Matrix
from dynsolve.algebra.ring import Expr
from dynsolve.questions.judging import Case, Missed, right_as
from dynsolve.questions.rates.derive import wanted_by_accelerations

OF_MANY = "another solution than that of least norm, which is the key"

_LONGEST = 400
"""Values with more terms are not put into the equations."""


def _solves(case: Case) -> bool:
    """Whether rates or accelerations of the joints do what is asked of the task, but for rounded decimals."""
    equation = _equation(case)
    return equation is not None and not _is_long(case) and equation.row_missed(case) is None


def _missed(case: Case) -> Missed | None:
    """The equation that they do not satisfy, and what stands in its first row; None where none is known."""
    equation = _equation(case)
    if equation is None:
        return None
    row = None if _is_long(case) else equation.row_missed(case)
    if row is None:
        return Missed(equation.text, is_one_of_many=equation.has_many)
    J, b, known = (m.rows[row] for m in (equation.J, equation.b, equation.known))
    value = _sum_of(case, J, known[0] - b[0])
    goal = RationalExpr(known[0])
    if all(same(((entry,),), ((case.in_numbers(entry),),)) for entry in case.entries):
        value, goal = case.in_numbers(value), case.in_numbers(goal)
    return Missed(equation.text, row + 1, equation.whole, value, goal, equation.has_many)


class _Equation(Struct, frozen=True):
    """J x = b, in which `whole` must be `known`; it `has_many` solutions, or none but the nearest."""

    text: str
    whole: str
    J: Matrix
    b: Matrix
    known: Matrix
    has_many: bool

    def row_missed(self, case: Case) -> int | None:
        """The first row, from 0, that an answer does not satisfy."""
        rows = enumerate(zip(self.J.rows, self.b.entries, strict=True))
        return next((k for k, (row, goal) in rows if not case.makes(row, goal)), None)


def _is_long(case: Case) -> bool:
    entries = [case.in_numbers(entry) for entry in case.entries]
    return sum(len(entry.numerator) + len(entry.denominator) for entry in entries) > _LONGEST


def _sum_of(case: Case, row: Sequence[Expr], start: Expr) -> RationalExpr:
    """Σ Jⱼ xⱼ and what is added to it."""
    return summed(map(multiply, map(RationalExpr, row), case.entries), start)


def _equation(case: Case) -> _Equation | None:
    """The equation at the state, None of what is no solution of such a system."""
    asked = case.robot.questions
    at = AtState(case.robot.ring, asked.state.by_symbol)
    known = asked.velocity if case.node == "qd" else asked.acceleration if case.node == "qdd" else None
    if known is None or len(case.entries) != case.robot.n:
        return None
    b, left, whole = known, "ṙ", "J_r q̇"
    if case.node == "qdd":
        b = wanted_by_accelerations(case.robot, known, case.result("Jr_dot"))
        left, whole = "r̈", "J_r q̈ + J̇_r q̇"
    J, b, known = (at.matrix(m) for m in (case.result("Jr"), b, known))
    numbers, right = (m.map(lambda e: case.in_numbers(RationalExpr(e)).numerator) for m in (J, b))
    if is_solvable(numbers, right):
        return _Equation(f"{left} = {whole}", whole, J, b, known, rank_parts(numbers).rank < J.shape[1])
    b, whole = J.T @ b, f"J_rᵀ ({whole} - {left})"
    return _Equation(f"{whole} = 0", whole, J.T @ J, b, b - b, True)


MISSED = {"qd": _missed, "qdd": _missed}
EQUIVALENCES = (right_as(OF_MANY, _solves, "qd", "qdd"),)
