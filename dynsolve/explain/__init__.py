"""Quantities -> steps: why, the formula with its source, the formula of this robot, the result.

One file a stage, in the order of the course.  To explain a further quantity, add a
step to its stage's file; a stage is a function that yields its steps in order.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from typing import TYPE_CHECKING

from dynsolve.explain import energy, inertia, jacobian, kinematics, lagrangian, torque, vectorized
from dynsolve.explain.step import Detail, Step
from dynsolve.quantities.stages import Stage

if TYPE_CHECKING:
    from dynsolve.explain.course import Course

__all__ = ["Detail", "Step", "explain"]

_EXPLAINED: dict[Stage, Callable[[Course], Iterator[Step]]] = {
    Stage.KINEMATICS: kinematics.steps,
    Stage.JACOBIAN: jacobian.steps,
    Stage.INERTIA: inertia.steps,
    Stage.ENERGY: energy.steps,
    Stage.LAGRANGIAN: lagrangian.steps,
    Stage.TORQUE: torque.steps,
    Stage.VECTORIZED: vectorized.steps,
}


def explain(course: Course, stages: Iterable[str] | None = None) -> Iterator[Step]:
    """The steps of the given stages, or of all, in the order of the course."""
    wanted = set(Stage if stages is None else stages)
    for stage, steps in _EXPLAINED.items():
        if stage in wanted and (course.robot.bodies or not stage.needs_masses):
            yield from steps(course)
