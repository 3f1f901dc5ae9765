"""Which arms are worked out line by line: of others every line would fill pages."""

from __future__ import annotations

from dynsolve.derivation.graph import Derivation
from dynsolve.robot.model import Robot

MOST_JOINTS = 3
"""Up to this number of coordinates every line is shown."""

MOST_TERMS = 20
"""The terms in the last frame up to which more coordinates are like these: an arm with parallel axes."""


def is_short(robot: Robot, values: Derivation) -> bool:
    """Whether an arm has few joints, or many of which the last frame has but few terms."""
    if robot.n <= MOST_JOINTS:
        return True
    if not robot.has_table:
        return False
    last = values[f"H{len(robot.joints)}"]
    return sum(len(entry.poly) for entry in last.entries) <= MOST_TERMS
