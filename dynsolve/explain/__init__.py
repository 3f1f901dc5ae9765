"""Quantities -> steps: why, the formula with its source, the formula of this robot, the result.

One file a stage, in the order of the course.  To explain a further quantity, add a
step to its stage's file; a stage is a function that yields its steps in order.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from typing import TYPE_CHECKING

from dynsolve.explain import energy, inertia, jacobian, kinematics, lagrangian, torque, vectorized
from dynsolve.explain.step import STAGES, Detail, Step

if TYPE_CHECKING:
    from dynsolve.explain.course import Course

__all__ = ["STAGES", "Detail", "Step", "explain"]

_EXPLAINED: dict[str, Callable[[Course], Iterator[Step]]] = {
    "kinematics": kinematics.steps,
    "jacobian": jacobian.steps,
    "inertia": inertia.steps,
    "energy": energy.steps,
    "lagrangian": lagrangian.steps,
    "torque": torque.steps,
    "vectorized": vectorized.steps,
}

WITHOUT_MASSES = ("kinematics", "jacobian")
"""How far the derivation goes where no body has mass."""


def explain(course: Course, stages: Iterable[str] | None = None) -> Iterator[Step]:
    """The steps of the given stages, or of all, in the order of the course."""
    wanted = set(STAGES if stages is None else stages)
    possible = STAGES if course.robot.bodies else WITHOUT_MASSES
    for stage in possible:
        if stage in wanted:
            yield from _EXPLAINED[stage](course)
