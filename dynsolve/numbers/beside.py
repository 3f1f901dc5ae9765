"""Numeric results that stand beside the symbolic ones."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from dynsolve.errors import Finding
from dynsolve.numbers.given import Given
from dynsolve.numbers.state import State
from dynsolve.numbers.valued import Valued
from dynsolve.robot.model import Robot


@dataclass(frozen=True, slots=True)
class Numbers:
    """What is shown of a robot in numbers.

    `given` are the values of parameters; `valued` the results with these values, None
    where there are none; `state` what holds at a state, None where none is asked for.
    `units` are the SI units of the parameters, as far as their roles tell.
    """

    robot: Robot
    given: Given
    valued: Valued | None = None
    state: State | None = None
    units: Mapping[str, str] = field(default_factory=dict)

    @property
    def lacking(self) -> tuple[str, ...]:
        """The parameters without a value."""
        return tuple(name for name in self.robot.parameters if (name, 0) not in self.given.entries)

    @property
    def warnings(self) -> tuple[Finding, ...]:
        """What deserves a look in the values and the state."""
        return (*self.given.warnings, *(self.state.given.warnings if self.state else ()))
