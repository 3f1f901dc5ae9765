"""Accelerations that are written by others of the same motion, q̈₂ by q̈₁, which stands beside it."""

from __future__ import annotations

from collections.abc import Mapping
from itertools import islice

from msgspec.structs import replace

from dynsolve.algebra.linear_systems import FractionMatrix
from dynsolve.algebra.matrix import Matrix
from dynsolve.algebra.sampling import samples
from dynsolve.answers.judging.key_comparison import KeyComparer, KeyComparison
from dynsolve.questions.constraints.judge import OwnConstraint
from dynsolve.questions.forward_dynamics.judge import accelerations_in, found_before, holds, in_motion
from dynsolve.questions.judging import Missed

BY_OTHERS = "right with the accelerations put in that are found beside it"
IN_A_CIRCLE = "it holds in every motion, and its accelerations are found by one another"
NAME = "qdd_forward"

STATES = 4
"""In so many states it is held."""


def with_own_accelerations(
    comparisons: Mapping[str, KeyComparison], compare: KeyComparer
) -> dict[str, KeyComparison]:
    """The comparisons, rows of q̈ being right that hold with the accelerations of the rows beside them."""
    found, compared, robot = dict(comparisons), comparisons.get(NAME), compare.robot
    if compared is None or compared.correct or compared.obstacles:
        return found
    entries = [row[0].value for row in compared.rows]
    within = [accelerations_in(robot, entry) for entry in entries]
    if not any(within):
        return found
    key = compare.key(compared.target)
    assert isinstance(key, Matrix | FractionMatrix)
    if robot.questions.constraints:
        states = OwnConstraint(robot, compare.graph.key).states
    else:
        states = list(islice(samples(compare.answer_ring.ring), STATES))
    motions = [in_motion(robot, key, at) for at in states]
    held = {k for k, others in enumerate(within) if others and holds(robot, k, entries[k], motions)}
    right = tuple(("" if k in held else None,) if within[k] else row for k, row in enumerate(compared.right))
    lost = [k for k, (one,) in enumerate(right) if one is None]
    if lost:
        missed = Missed("D q̈ + C q̇ + g = τ", is_one_of_many=True) if any(within[k] for k in lost) else None
        found[NAME] = replace(compared, right=right, missed=missed)
    elif len(found_before(within)) == robot.n:
        found[NAME] = replace(compared, right=right, other=BY_OTHERS)
    else:
        found[NAME] = replace(compared, waits=IN_A_CIRCLE)
    return found
