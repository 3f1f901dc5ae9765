"""Half-way along an arm: where a long product is parted, and the halves worked out."""

from __future__ import annotations

from collections.abc import Sequence

from dynsolve.algebra.matrix import Matrix
from dynsolve.derivation.kinematics import base_transform, dh_matrix
from dynsolve.explain.context import Context
from dynsolve.explain.working.identities import Identity
from dynsolve.explain.working.products import used_in_product
from dynsolve.robot.model import Joint, Robot


def halves(robot: Robot) -> tuple[tuple[Joint, ...], tuple[Joint, ...]]:
    """The rows up to the last frame in two halves: of six joints, the arm and its wrist."""
    rows = robot.path(len(robot.joints))
    return rows[: len(rows) // 2], rows[len(rows) // 2 :]


def product(context: Context, rows: Sequence[Joint]) -> tuple[Matrix, list[Identity]]:
    """The matrices of rows multiplied from the left, 4×4, and the identities that are used on the way.

    From the base on, with the frame of the base before them.
    """
    robot = context.robot
    matrices = [dh_matrix(robot, row) for row in rows]
    if rows[0].parent == 0:
        matrices = [base_transform(robot), *matrices]
    used: dict[Identity, None] = {}
    made = matrices[0]
    for A in matrices[1:]:
        before, made = made, made @ A
        used |= dict.fromkeys(used_in_product(context, before, A, made))
    return made, list(used)
