"""Points, the task r(q), its Jacobian, and how Jacobians change in time.

Spong, Hutchinson, Vidyasagar, section 4.6 for the Jacobian of a point, 4.8 for that of a
task (the analytical Jacobian: ∂r/∂q), 4.11 for J̇ in accelerations: d²r/dt² = J_r q̈ + J̇_r q̇.

A point's quantities are called by its name: `pP`, `JvP`, `JwP`, `vP`.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from functools import partial

from dynsolve.algebra.fraction import RationalExpr
from dynsolve.algebra.matrix import Matrix, vstack
from dynsolve.algebra.ring import Ring
from dynsolve.algebra.ring_values import Evaluator
from dynsolve.derivation import kinematics, link_frame
from dynsolve.derivation.graph import Rule
from dynsolve.derivation.kinematics import origin, rotation
from dynsolve.notation.tree import Reference
from dynsolve.questions.rates import derive as rates
from dynsolve.robot.model import Robot
from dynsolve.robot.questions import TIP, NamedPoint, Task, points_of


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


# What exercises ask of the kinematics as rules


def rules(robot: Robot) -> Iterator[Rule]:
    """The rules of named points, of the rates of the Jacobian, and of the task."""
    for point in robot.questions.points:
        yield from _point(robot, point)
    yield Rule("Jv_dot", ("Jv",), rate)
    yield Rule("Jw_dot", ("Jw",), rate)
    yield Rule("J_dot", ("Jv_dot", "Jw_dot"), vstack)
    if robot.questions.task is not None:
        yield from _task(robot, robot.questions.task)


def _point(robot: Robot, point: NamedPoint) -> Iterator[Rule]:
    p, link = point.name, point.link

    frames = kinematics.frame_names(link)
    axes = () if point.axes is None else (f"H{point.axes}",)

    def linear(position: Matrix, *H: Matrix) -> Matrix:
        return along(kinematics.linear_jacobian(robot, H, position, link), *H[len(frames) :])

    def angular(*H: Matrix) -> Matrix:
        return along(kinematics.angular_jacobian(robot, H, link), *H[len(frames) :])

    def along(J: Matrix, *seen: Matrix) -> Matrix:
        return kinematics.rotation(seen[0]).T @ J if seen else J

    yield Rule(f"p{p}", (f"H{link}",), lambda H: kinematics.point(H, point.position))
    yield Rule(f"Jv{p}", (f"p{p}", *frames, *axes), linear)
    yield Rule(f"Jw{p}", (*frames, *axes), angular)
    yield Rule(f"v{p}", (f"Jv{p}",), partial(link_frame.velocity, robot))


def _task(robot: Robot, asked: Task) -> Iterator[Rule]:
    if asked.is_twist:
        yield Rule("Jr", ("J",), lambda J: J)
        if asked.is_pose:
            yield Rule("pose", (f"H{len(robot.joints)}",), pose_entries)
    else:
        used = points_of(asked)
        inputs = tuple(position_rule(robot, point) for point in used)

        def value(*found: Matrix) -> Matrix:
            positions = zip(used, found, strict=True)
            at = {point: kinematics.origin(x) if point == TIP else x for point, x in positions}
            return task_value(robot, asked, at)

        yield Rule("r", inputs, value)
        yield Rule("Jr", ("r",), partial(task_jacobian, robot))
    yield Rule("Jr_dot", ("Jr",), rate)
    yield Rule("det", (rates.whole_or_task(robot),), rates.jacobian_determinant)


def position_rule(robot: Robot, point: str) -> str:
    """The quantity that holds a point's position: the last frame for the tip."""
    return f"H{len(robot.joints)}" if point == TIP else f"p{point}"
