"""Accelerations of links in which gravity is counted in the other of two ways."""

from __future__ import annotations

from functools import partial

from dynsolve.derivation.kinematics import rotation
from dynsolve.questions.judging import Case, right_as
from dynsolve.questions.newton_euler import ACL, AL
from dynsolve.questions.newton_euler.recursions import is_standard

WITH_GRAVITY = "right with gravity as an acceleration of the base; in the key it is a force on each link"
WITHOUT_GRAVITY = "right with gravity as a force on each link; in the key the base accelerates instead"


def _has_other_gravity(standard: bool, case: Case) -> bool:
    """Whether an acceleration is right where gravity is counted in the other of the two ways."""
    robot, link = case.robot, case.index
    if is_standard(robot) is not standard:
        return False
    if case.quantity is not None and case.quantity.family is ACL:
        link = robot.bodies[link - 1].link
    gravity = rotation(case.result(f"H{link}")).T @ robot.gravity
    return case.is_entry_by_entry((case.key + (-gravity if standard else gravity)).entries)


EQUIVALENCES = (
    right_as(WITH_GRAVITY, partial(_has_other_gravity, True), AL, ACL),
    right_as(WITHOUT_GRAVITY, partial(_has_other_gravity, False), AL, ACL),
)
