"""The keys of a problem file that say which rates a task has; see `problem.specification`."""

from __future__ import annotations

from dynsolve.problem.kinds import EXPRESSION, Key, ListOf, MapOf, OneOf, Word
from dynsolve.problem.kinematic_keys import MAX_TASK

BY_INERTIA = Word(("D",))

VELOCITY = Key(
    "velocity",
    ListOf(EXPRESSION, "a list of expressions", 1, MAX_TASK),
    "The velocity of the task, for which the rates qd are asked.",
    "[vx, vy]",
    remedy="write velocity: [vx, vy], an expression for each component of the task",
    serves=("qd",),
)
ACCELERATION = Key(
    "acceleration",
    ListOf(EXPRESSION, "a list of expressions", 1, MAX_TASK),
    "The acceleration of the task, for which the accelerations qdd are asked.",
    "[0, 0]",
    remedy="write acceleration: [0, 0], an expression for each component of the task",
    serves=("qdd",),
)
WEIGHTS = Key(
    "weights",
    OneOf(
        (
            MapOf(EXPRESSION, "weights by coordinate"),
            ListOf(ListOf(EXPRESSION, "a row", 1), "a matrix W", 1),
            BY_INERTIA,
        )
    ),
    "Where many rates qd or accelerations qdd do, those with the least q̇ᵀ W q̇ are meant: W is diagonal, "
    "a matrix, or the inertia matrix D.",
    "{theta1: 2, L2: 1}",
    "1 for each coordinate",
    remedy="write weights: {q1: 2, q2: w}, a matrix [[2, 0], [0, w]], or D",
    serves=("qd", "qdd"),
)

KEYS = (VELOCITY, ACCELERATION, WEIGHTS)
