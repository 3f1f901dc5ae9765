"""The equations without multipliers in the accelerations that are free: the others are put in.

Where columns of A_c have a determinant that is a number other than 0, A_c q̇ = 0 and
A_c q̈ + Ȧ_c q̇ = 0 give the rates and the accelerations of these columns by the others'.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import combinations

from msgspec import Struct

from dynsolve.algebra.linear_systems import adjugate, part
from dynsolve.algebra.lowest_terms import without_shared
from dynsolve.algebra.matrix import Matrix, determinant
from dynsolve.algebra.ring import Expr
from dynsolve.questions.forward_dynamics.derive import MOST_TERMS, Reduced
from dynsolve.questions.task.derive import rate
from dynsolve.robot.model import Robot


class Closed(Struct, frozen=True):
    """What the constraints give, as (coordinate, rate) and (coordinate, acceleration), and the equations."""

    rates: tuple[tuple[int, Expr], ...]
    accelerations: tuple[tuple[int, Expr], ...]
    equations: tuple[tuple[Expr, Expr], ...]


def closed(robot: Robot, A: Matrix, found: Reduced) -> Closed | None:
    """The equations in as many accelerations as they are; None where that takes a quotient, or is so."""
    ring, every = robot.ring, range(robot.n)
    rows = tuple(range(len(A.rows)))
    choices = ((columns, determinant(part(A, rows, columns))) for columns in combinations(every, len(rows)))
    columns, size = next((one for one in choices if one[1].is_number and not one[1].is_zero), ((), ring.zero))
    if not columns:
        return None
    solving = adjugate(part(A, rows, columns)).scale(ring.constant(-1 / size.number))
    others = tuple(k for k in every if k not in columns)
    beside = part(A, rows, others)

    def solved(dots: int, more: Matrix | None = None) -> tuple[tuple[int, Expr], ...]:
        moved = beside @ Matrix.column(ring, [ring.symbol(robot.coordinates[k].name, dots) for k in others])
        return tuple(zip(columns, (solving @ (moved if more is None else moved + more)).entries, strict=True))

    def put(value: Expr, given: Sequence[tuple[int, Expr]], dots: int) -> Expr:
        places = (ring.symbol(robot.coordinates[k].name, dots).used[0] for k, _ in given)
        return ring.put(value, {i: one.poly for i, (_, one) in zip(places, given, strict=True)})

    def of_acceleration(value: Expr, k: int) -> Expr:
        return ring.coefficient(value, robot.coordinates[k].name, 2)

    rates = solved(1)
    velocities = Matrix.column(ring, [ring.symbol(q.name, 1) for q in robot.coordinates])
    accelerations = tuple((k, put(one, rates, 1)) for k, one in solved(2, rate(A) @ velocities))
    equations = []
    for left, right in found.equations:
        both = put(put(left, accelerations, 2), rates, 1), put(right, rates, 1)
        shared = both if any(one.is_zero for one in both) else tuple(without_shared(both))
        leading = next((c for q in others if not (c := of_acceleration(shared[0], q)).is_zero), ring.one)
        sign = -1 if all(number < 0 for number in leading.poly.coeffs()) else 1
        equations.append((shared[0] * sign, shared[1] * sign))
    is_long = sum(len(one) for both in equations for one in both) > MOST_TERMS
    if is_long or tuple(equations) == found.equations:
        return None
    return Closed(rates, accelerations, tuple(equations))
