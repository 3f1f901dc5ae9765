"""Verdicts on equations of motion without multipliers."""

from __future__ import annotations

from functools import cached_property

from dynsolve.questions.constraints.check import ConstrainedStates, constrained_names
from dynsolve.questions.judging import (
    RIGHT,
    Alternatives,
    Fault,
    Judged,
    SetKey,
    SetVerdict,
    by_code,
    nodes_of,
)


class ReducedKey(SetKey):
    """The equations of motion without multipliers of one problem."""

    faults = by_code(
        Fault("motion_differs", "an equation of motion",
              "There are motions that the constraints allow in which equation {number} does not hold.",
              "Combine the equations so that every multiplier drops out, with the forces of the motors."),
        Fault("motions_missing", "an equation of motion", "Every equation holds, and some are missing.",
              "With the constraints there are as many equations as coordinates."),
    )  # fmt: skip

    def __init__(self, judged: Judged, name: str) -> None:
        super().__init__(judged, name)
        self.names = {q.force for q in self.robot.coordinates}

    @property
    def is_skipped(self) -> bool:
        """Whether there are no such equations here, or no state was found that keeps the constraints."""
        return super().is_skipped or not self._states.all

    @cached_property
    def _states(self) -> ConstrainedStates:
        forms = {name: self.forms(name) for name in constrained_names(self.robot)}
        return ConstrainedStates(self.robot, forms, self.judged.numbers)

    def verdict(self, given: Alternatives) -> SetVerdict:
        """Whether each equation holds, and they are enough."""
        theirs = nodes_of(given)
        for number, node in enumerate(theirs, 1):
            if not self._states.hold(node):
                return SetVerdict(False, "motion_differs", number)
        enough = bool(theirs) and self._states.are_enough(theirs)
        return RIGHT if enough else SetVerdict(False, "motions_missing")


KEYS = {"reduced": ReducedKey}
