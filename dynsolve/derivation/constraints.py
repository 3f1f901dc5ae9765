"""Constraints: A_c q̇ = 0, its rate, and the multipliers that keep it.

With A_c q̇ = 0 the equations of motion are D q̈ + C q̇ + g = τ + Q + A_cᵀ λ, and A_c q̈ + Ȧ_c q̇ = 0
besides.  Put q̈ from the first into the second:

    λ = -(A_c D⁻¹ A_cᵀ)⁻¹ (A_c D⁻¹ (τ + Q - C q̇ - g) + Ȧ_c q̇)

Every inverse is an adjugate over a determinant, so that all is polynomial but for one division.

Murray, Li, Sastry, A Mathematical Introduction to Robotic Manipulation, section 6.1.2;
Siciliano, Sciavicco, Villani, Oriolo, Robotics, section 11.4 for constraints on the rates.

Constraints as rules; the formulas are in `constraints`.

Constraints, compared with the motion of the arm, and the multipliers with elimination on numbers.

The functions h, A_c and its rate are held to the motion as a task is.  With the multipliers put into
the equations of motion the accelerations are found by elimination; they must keep the constraint.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from functools import partial
from itertools import islice
from typing import Any

from msgspec.structs import replace

from dynsolve.algebra.expr import Expr
from dynsolve.algebra.linear_systems import FractionMatrix, adjugate, quotient
from dynsolve.algebra.matrix import Matrix, determinant, work
from dynsolve.algebra.ring_values import value_of
from dynsolve.derivation import kinematics, task
from dynsolve.derivation.arm_values import arms
from dynsolve.derivation.elimination import solved
from dynsolve.derivation.forward_dynamics import SINGULAR, acting_forces, acting_names, reduced
from dynsolve.derivation.graph import Rule, Skipped
from dynsolve.derivation.kinematic_check import verify_kinematics
from dynsolve.derivation.link_frame import velocities
from dynsolve.derivation.rate_check import TOLERANCE
from dynsolve.derivation.task import position_rule, task_value
from dynsolve.errors import VerificationError
from dynsolve.notation.tree import Matrix as MatrixTree
from dynsolve.notation.tree import Node
from dynsolve.notation.tree_values import compile_trees
from dynsolve.robot.actions import Constraint
from dynsolve.robot.model import Robot
from dynsolve.robot.questions import TIP, Task, points_of

# Constraints: A_c q̇ = 0, its rate, and the multipliers that keep it

MOST_PRODUCTS = 200_000
"""Multipliers that may come to more products of terms are not multiplied out: nobody could read them."""

DEPENDENT = "one constraint follows from the others, so that the multipliers are not determined"

TOO_LARGE = "multiplied out they are too large to be read"


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
    """λ, c×1; `acting` is τ + Q - C q̇ - g, n×1: what is left of the forces beside D q̈."""
    if work(D) > MOST_PRODUCTS:
        return Skipped(TOO_LARGE)
    inverse, scale = adjugate(D), determinant(D)
    through = A @ inverse
    square = through @ A.T
    if work(square) > MOST_PRODUCTS:
        return Skipped(TOO_LARGE)
    if scale.is_zero:
        return Skipped(SINGULAR)
    if determinant(square).is_zero:
        return Skipped(DEPENDENT)
    wanted = through @ acting + (A_dot @ velocities(robot)).scale(scale)
    return quotient(-(adjugate(square) @ wanted), determinant(square))


# Constraints as rules; the formulas are in `constraints`

LAMBDA, REDUCED = "lambda", "reduced"


def constraint_rules(robot: Robot) -> Iterator[Rule]:
    """The rules of h, A_c, its rate and, where they are asked for, the multipliers."""
    used = points_of(Task(tuple(one.entry for one in holonomic(robot))))

    def functions(*found: Matrix) -> Matrix:
        positions = zip(used, found, strict=True)
        at = {point: kinematics.origin(x) if point == TIP else x for point, x in positions}
        return constraint_functions(robot, at)

    yield Rule("hc", tuple(position_rule(robot, point) for point in used), functions)
    yield Rule("Ac", ("hc",), partial(constraint_matrix, robot))
    yield Rule("Ac_dot", ("Ac",), task.rate)
    if LAMBDA in robot.questions.asked and robot.has_dynamics:
        yield _multipliers(robot)
    if REDUCED in robot.questions.asked and robot.has_dynamics:
        loads = ("Q",) if robot.questions.loads else ()
        yield Rule(REDUCED, ("Ac", "tau", *loads), partial(reduced, robot))


def _multipliers(robot: Robot) -> Rule:
    def compute(A: Matrix, A_dot: Matrix, D: Matrix, *forces: Matrix) -> Matrix | FractionMatrix | Skipped:
        return multipliers(robot, A, A_dot, D, acting_forces(robot, *forces))

    return Rule(LAMBDA, ("Ac", "Ac_dot", "D", *acting_names(robot)), compute)


# Constraints, compared with the motion of the arm, and the multipliers with elimination on numbers

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
        if isinstance(form, MatrixTree):
            held[mine] = MatrixTree(tuple(form.rows[i] for i in places))
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
