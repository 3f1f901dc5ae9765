"""Points, the task r(q), its Jacobian, and how Jacobians change in time.

Spong, Hutchinson, Vidyasagar, section 4.6 for the Jacobian of a point, 4.8 for that of a
task (the analytical Jacobian: ∂r/∂q), 4.11 for J̇ in accelerations: d²r/dt² = J_r q̈ + J̇_r q̇.
"""

from __future__ import annotations

from collections.abc import Mapping

from dynsolve.algebra.fraction import RationalExpr
from dynsolve.algebra.matrix import Matrix
from dynsolve.algebra.ring import Ring
from dynsolve.algebra.ring_values import Evaluator
from dynsolve.derivation.kinematics import origin, rotation
from dynsolve.notation.tree import Reference
from dynsolve.robot.model import Robot
from dynsolve.robot.questions import Task


def task_value(robot: Robot, task: Task, positions: Mapping[str, Matrix]) -> Matrix:
    """r(q), m×1; `positions` are those of the tip and of the named points, 3×1, by the names of a task."""
    evaluator = _TaskEvaluator(robot.ring, positions)
    return Matrix.column(robot.ring, [evaluator.value(entry).numerator for entry in task.entries])


def pose_entries(H: Matrix) -> Matrix:
    """The position of a frame and the rows of its rotation, 12×1, from H, 4×4."""
    return Matrix.column(H.ring, (*origin(H).entries, *rotation(H).entries))


class _TaskEvaluator(Evaluator):
    """Values of formulas in which coordinates of points stand."""

    def __init__(self, ring: Ring, positions: Mapping[str, Matrix]) -> None:
        super().__init__(ring)
        self._positions = positions

    def reference(self, node: Reference) -> RationalExpr:
        """A coordinate of a point."""
        assert node.row is not None
        return RationalExpr(self._positions[node.quantity][node.row - 1, 0])


def task_jacobian(robot: Robot, r: Matrix) -> Matrix:
    """J_r = ∂r/∂q, m×n."""
    ring = robot.ring
    return Matrix.of(ring, ([ring.diff(entry, k) for k in range(robot.n)] for entry in r.entries))


def rate(jacobian: Matrix) -> Matrix:
    """J̇ = Σ_k ∂J/∂q_k q̇_k, entry by entry."""
    return jacobian.map(jacobian.ring.time_derivative)
