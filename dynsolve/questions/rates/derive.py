"""The determinant of a Jacobian; joint rates and accelerations for those of the task.

Spong, Hutchinson, Vidyasagar, section 4.9 for det J, 4.11 for q̇ = J⁻¹ ṙ and
q̈ = J⁻¹ (r̈ - J̇ q̇), and for the pseudoinverse where J is not square.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator

from dynsolve.algebra.linear_systems import FractionMatrix, adjugate, pseudoinverse_times
from dynsolve.algebra.matrix import AtState, Matrix, determinant, work
from dynsolve.algebra.ring import Expr
from dynsolve.algebra.spaces import nullspace, rangespace
from dynsolve.derivation.graph import Rule, Skipped
from dynsolve.derivation.link_frame import velocities
from dynsolve.robot.model import Robot


def whole_or_task(robot: Robot) -> str:
    """The Jacobian whose rank is looked at: that of the task, or all of J of six joints without a task."""
    task = robot.questions.task
    is_whole = task is not None and task.is_default and robot.n == 6
    return "J" if is_whole else "Jr"


def squared(jacobian: Matrix) -> Matrix:
    """J where it is square, else J Jᵀ of one with more columns than rows, Jᵀ J of one with more rows."""
    rows, columns = jacobian.shape
    if rows == columns:
        return jacobian
    return jacobian @ jacobian.T if rows < columns else jacobian.T @ jacobian


MOST_PRODUCTS = 200_000
"""A determinant that may come to more products of terms is not multiplied out: nobody could read it."""

TOO_LARGE = "multiplied out it is too large to be read"
TOO_LARGE_EVERYWHERE = f"{TOO_LARGE}; it is found at a `state` in numbers"


def jacobian_determinant(jacobian: Matrix) -> Expr | Skipped:
    """det J, det(J Jᵀ) or det(Jᵀ J), whichever is the determinant of a square matrix and not always 0."""
    square = squared(jacobian)
    return Skipped(TOO_LARGE) if work(square) > MOST_PRODUCTS else determinant(square)


def joint_rates(
    jacobian: Matrix, velocity: Matrix, weights: Matrix | None = None
) -> Matrix | FractionMatrix | Skipped:
    """q̇ = J⁺ ṙ, n×1; of many the one with the least q̇ᵀ W q̇, where there are weights."""
    square = squared(jacobian) if weights is None else weighted_square(jacobian, weights)
    if work(square) > MOST_PRODUCTS:
        return Skipped(TOO_LARGE)
    return pseudoinverse_times(jacobian, velocity, weights)


def weighted_square(jacobian: Matrix, weights: Matrix) -> Matrix:
    """J adj(W) Jᵀ, which is J W⁻¹ Jᵀ but for its factor det W; of one with more rows than columns Jᵀ J."""
    rows, columns = jacobian.shape
    return jacobian @ adjugate(weights) @ jacobian.T if rows < columns else squared(jacobian)


def wanted_by_accelerations(robot: Robot, acceleration: Matrix, jacobian_rate: Matrix) -> Matrix:
    """r̈ - J̇ q̇, m×1: what J q̈ must be."""
    return acceleration - jacobian_rate @ velocities(robot)


def motions_without_effect(jacobian: Matrix) -> Matrix | Skipped:
    """A basis of the joint rates with J q̇ = 0, which the task does not see."""
    return _spanned(jacobian, nullspace)


def possible_motions(jacobian: Matrix) -> Matrix | Skipped:
    """A basis of the velocities J q̇ of the task that are possible."""
    return _spanned(jacobian, rangespace)


def lost_motions(jacobian: Matrix) -> Matrix | Skipped:
    """A basis of the directions across all possible ones: Jᵀ F = 0, so forces along them need no torque."""
    return _spanned(jacobian.T, nullspace)


def _spanned(matrix: Matrix, space: Callable[[Matrix], Matrix]) -> Matrix | Skipped:
    """A space of a matrix, where its minors of full size are not too large."""
    size = range(min(matrix.shape))
    square = Matrix.of(matrix.ring, ([matrix[i, j] for j in size] for i in size))
    return Skipped(TOO_LARGE_EVERYWHERE) if work(square) > MOST_PRODUCTS else space(matrix)


def rules(robot: Robot) -> Iterator[Rule]:
    """The rules of joint rates and accelerations, and of what the joints and the task can do."""
    asked = robot.questions
    at = AtState(robot.ring, asked.state.by_symbol)
    velocity, acceleration = asked.velocity, asked.acceleration

    inertia = ("D",) if asked.weighs_by_inertia else ()

    def weights(D: tuple[Matrix, ...]) -> Matrix | None:
        return at.matrix(D[0]) if D else asked.weights

    def rates_of(J: Matrix, *D: Matrix) -> Matrix | FractionMatrix | Skipped:
        assert velocity is not None
        return joint_rates(at.matrix(J), at.matrix(velocity), weights(D))

    def accelerations_of(J: Matrix, J_dot: Matrix, *D: Matrix) -> Matrix | FractionMatrix | Skipped:
        assert acceleration is not None
        wanted = wanted_by_accelerations(robot, acceleration, J_dot)
        return joint_rates(at.matrix(J), at.matrix(wanted), weights(D))

    if velocity is not None:
        yield Rule("qd", ("Jr", *inertia), rates_of)
    if acceleration is not None:
        yield Rule("qdd", ("Jr", "Jr_dot", *inertia), accelerations_of)
    yield Rule("nullspace", ("Jr",), lambda J: motions_without_effect(at.matrix(J)))
    yield Rule("rangespace", ("Jr",), lambda J: possible_motions(at.matrix(J)))
    yield Rule("lost", ("Jr",), lambda J: lost_motions(at.matrix(J)))
