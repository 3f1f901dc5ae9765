"""The keys of a problem file that say what is to be reached; see `problem.specification`."""

from __future__ import annotations

from dynsolve.problem.kinds import EXPRESSION, Key, ListOf, MapOf, Word
from dynsolve.problem.kinematic_keys import MAX_TASK

ALL = Word(("all",))

REACH = Key(
    "reach",
    ListOf(EXPRESSION, "a list of names, or of numbers", 1, MAX_TASK),
    "What the values of r(q) are called in the inverse kinematics, or what they are: numbers, and "
    "expressions of parameters that have a number in `values`; of a pose the position, and the rows of "
    "the rotation behind it.",
    "[px, py]",
    "r1, r2, ...; of a pose x, y, z, r11, ..., r33",
    remedy="write reach: [px, py], a name or a number for each component of the task",
    serves=("inverse",),
)
BRANCHES = Key(
    "branches",
    ALL,
    "Whether every branch of the inverse kinematics is asked for; else some are enough.",
    "all",
)
LIMITS = Key(
    "limits",
    MapOf(ListOf(EXPRESSION, "`[low, high]`", 2, 2), "ranges by coordinate"),
    "Ranges of the coordinates: they mark the branches of the inverse kinematics, and remove none.",
    "{theta1: [-90deg, 90deg]}",
    "none",
    remedy="write limits: {theta1: [-90deg, 90deg], d2: [0, 1/2]}",
    serves=("inverse",),
)

KEYS = (REACH, BRANCHES, LIMITS)
