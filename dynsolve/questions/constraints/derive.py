"""Constraints: A_c q̇ = 0, its rate, and the multipliers that keep it.

With A_c q̇ = 0 the equations of motion are D q̈ + C q̇ + g = τ + Q + A_cᵀ λ, and A_c q̈ + Ȧ_c q̇ = 0
besides.  Put q̈ from the first into the second:

    λ = -(A_c D⁻¹ A_cᵀ)⁻¹ (A_c D⁻¹ (τ + Q - C q̇ - g) + Ȧ_c q̇)

Every inverse is an adjugate over a determinant, so that all is polynomial but for one division.  A D
without an inverse, as of a coordinate that moves no mass, leaves both systems together to be solved:

    [D, -A_cᵀ; A_c, 0] [q̈; λ] = [τ + Q - C q̇ - g; -Ȧ_c q̇]

So are the accelerations that given forces make, where these are asked for.

Murray, Li, Sastry, A Mathematical Introduction to Robotic Manipulation, section 6.1.2;
Siciliano, Sciavicco, Villani, Oriolo, Robotics, section 11.4 for constraints on the rates.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from functools import partial

from dynsolve.algebra.linear_systems import (
    FractionMatrix,
    adjugate,
    fraction_of,
    inverse_times,
    quotient,
    rank_parts,
    tidy,
)
from dynsolve.algebra.matrix import Matrix, determinant, vstack, work
from dynsolve.algebra.ring import Expr
from dynsolve.algebra.ring_values import value_of
from dynsolve.derivation import kinematics
from dynsolve.derivation.allowed import NOT_DETERMINED, NOT_SHOWN, where_allowed
from dynsolve.derivation.graph import Rule, Skipped
from dynsolve.derivation.link_frame import velocities
from dynsolve.questions.forward_dynamics.derive import (
    TOO_LARGE,
    Reduced,
    acting_forces,
    acting_names,
    if_readable,
    outside_names,
    reduced,
)
from dynsolve.questions.task import derive as task
from dynsolve.questions.task.derive import position_rule, task_value
from dynsolve.robot.model import Robot
from dynsolve.robot.questions import TIP, Constraint, Task, points_of

MOST_PRODUCTS = 200_000
"""Multipliers that may come to more products of terms are not multiplied out: nobody could read them."""

FREE = "what the constraints leave free moves no mass, so that the accelerations are not determined"

DEPENDENT = "one constraint follows from the others, so that the multipliers are not determined"


def holonomic(robot: Robot) -> tuple[Constraint, ...]:
    """The constraints that are functions of the coordinates."""
    return tuple(one for one in robot.questions.constraints if not one.in_rates)


def constraint_functions(robot: Robot, positions: Mapping[str, Matrix]) -> Matrix:
    """h(q), a row a holonomic constraint; `positions` are those of the points in it, 3×1 each."""
    return task_value(robot, Task(tuple(one.entry for one in holonomic(robot))), positions)


def constraint_matrix(robot: Robot, h: Matrix) -> Matrix:
    """A_c, c×n: ∂h/∂q, and the factors of the rates where a constraint is given by these."""
    ring, functions = robot.ring, iter(h.entries)
    rows: list[list[Expr]] = []
    for one in robot.questions.constraints:
        if one.in_rates:
            value = value_of(ring, one.entry)
            rows.append([ring.coefficient(value, name, 1) for name in ring.names])
        else:
            function = next(functions)
            rows.append([ring.diff(function, k) for k in range(robot.n)])
    return Matrix.of(ring, rows)


def multipliers(
    robot: Robot, A: Matrix, A_dot: Matrix, D: Matrix, acting: Matrix
) -> Matrix | FractionMatrix | Skipped:
    """λ, c×1; `acting` is τ + Q - C q̇ - g, n×1: what is left of the forces beside D q̈.

    Of dependent rows many λ have the same A_cᵀ λ, one of them with 0 where a row follows from others.
    """
    independent = rank_parts(A).rows
    if len(independent) < len(A.rows):
        found = multipliers(robot, _rows(A, independent), _rows(A_dot, independent), D, acting)
        if isinstance(found, Skipped):
            return found
        of = dict(zip(independent, map(fraction_of, found.entries), strict=True))
        none = fraction_of(D.ring.zero)
        rows = ([of.get(i, none)] for i in range(len(A.rows)))
        return Skipped(DEPENDENT, one=tidy(D.ring, rows))
    if work(D) > MOST_PRODUCTS:
        return Skipped(TOO_LARGE)
    through, scale = A @ adjugate(D), determinant(D)
    along = A_dot @ velocities(robot)
    square = through @ A.T
    if not scale.is_zero and work(square) > MOST_PRODUCTS:
        return Skipped(TOO_LARGE)
    if scale.is_zero or determinant(square).is_zero:
        return _together(A, D, vstack(acting, -along), slice(len(D.rows), None))
    wanted = through @ acting + along.scale(scale)
    return if_readable(quotient(-(adjugate(square) @ wanted), determinant(square)))


def _rows(matrix: Matrix, places: Iterable[int]) -> Matrix:
    return Matrix(matrix.ring, tuple(matrix.rows[i] for i in places))


def accelerations(
    robot: Robot, A: Matrix, A_dot: Matrix, D: Matrix, acting: Matrix
) -> Matrix | FractionMatrix | Skipped:
    """q̈, n×1, from the same, together with λ."""
    if rank_parts(A).rank < len(A.rows):
        return Skipped(DEPENDENT)
    return _together(A, D, vstack(acting, -(A_dot @ velocities(robot))), slice(len(D.rows)))


def _together(A: Matrix, D: Matrix, right: Matrix, rows: slice) -> Matrix | FractionMatrix | Skipped:
    """These rows of q̈ and λ, where both systems are solved together."""
    both = bordered(A, D)
    if work(both) > MOST_PRODUCTS:
        return Skipped(TOO_LARGE)
    found = inverse_times(both, right)
    if found is None:
        return Skipped(FREE)
    return if_readable(tidy(D.ring, (map(fraction_of, row) for row in found.rows[rows])))


def bordered(A: Matrix, D: Matrix) -> Matrix:
    """[D, -Aᵀ; A, 0]"""
    upper = Matrix(D.ring, tuple((*mine, *theirs) for mine, theirs in zip(D.rows, (-A.T).rows, strict=True)))
    return vstack(upper, Matrix(D.ring, tuple((*row, *(D.ring.zero for _ in A.rows)) for row in A.rows)))


# The rules

LAMBDA, REDUCED, QDD_FORWARD = "lambda", "reduced", "qdd_forward"


def rules(robot: Robot) -> Iterator[Rule]:
    """The rules of h, A_c, its rate and, where they are asked for, the multipliers."""
    used = points_of(Task(tuple(one.entry for one in holonomic(robot))))

    def functions(*found: Matrix) -> Matrix:
        positions = zip(used, found, strict=True)
        at = {point: kinematics.origin(x) if point == TIP else x for point, x in positions}
        return constraint_functions(robot, at)

    yield Rule("hc", tuple(position_rule(robot, point) for point in used), functions)
    yield Rule("Ac", ("hc",), partial(constraint_matrix, robot))
    yield Rule("Ac_dot", ("Ac",), task.rate)
    for name, solve in ((LAMBDA, multipliers), (QDD_FORWARD, accelerations)):
        if name in robot.questions.asked and robot.has_dynamics:
            yield _solved(robot, name, solve)
    if REDUCED in robot.questions.asked and robot.has_dynamics:
        yield Rule(REDUCED, ("hc", "Ac", "tau", *outside_names(robot)), partial(_reduced, robot))


def _reduced(robot: Robot, h: Matrix, A: Matrix, *forces: Matrix) -> Reduced | Skipped:
    """The equations without multipliers, with h, A_c q̇ and its rate as what is kept at 0."""
    if where_allowed(robot, A, h).is_less:
        return Skipped(NOT_SHOWN)
    rates = velocities(robot)
    accelerations = Matrix.column(robot.ring, [robot.ring.symbol(q.name, 2) for q in robot.coordinates])
    kept = (*h.entries, *(A @ rates).entries, *(A @ accelerations + task.rate(A) @ rates).entries)
    return reduced(robot, A, [value for value in kept if not value.is_zero], *forces)


def _solved(robot: Robot, name: str, solve: Callable[..., Matrix | FractionMatrix | Skipped]) -> Rule:
    """The rule of λ, or of q̈."""

    def compute(
        h: Matrix, A: Matrix, A_dot: Matrix, D: Matrix, *forces: Matrix
    ) -> Matrix | FractionMatrix | Skipped:
        if where_allowed(robot, A, h).is_less:
            return Skipped(NOT_DETERMINED)
        return solve(robot, A, A_dot, D, acting_forces(robot, *forces))

    return Rule(name, ("hc", "Ac", "Ac_dot", "D", *acting_names(robot)), compute)
