"""Numeric results that stand beside the symbolic ones."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field

from dynsolve.algebra.angles import names_of
from dynsolve.algebra.expr import Expr
from dynsolve.errors import Finding
from dynsolve.robot.model import Robot
from dynsolve.solution.numbers.given import Given
from dynsolve.solution.numbers.state import State
from dynsolve.solution.numbers.valued import Valued


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
        return tuple(name for name in needed(self.robot) if (name, 0) not in self.given.entries)

    @property
    def warnings(self) -> tuple[Finding, ...]:
        """What deserves a look in the values and the state."""
        return (*self.given.warnings, *(self.state.given.warnings if self.state else ()))


def needed(robot: Robot) -> tuple[str, ...]:
    """The parameters that results depend on: without masses, gravity is none of them."""
    if robot.bodies:
        return robot.parameters
    used = {name for joint in robot.joints for name in _names(robot, joint.a, joint.d)}
    used |= {name for entry in robot.base_position.entries for name in _names(robot, entry)}
    turned = [angle for joint in robot.joints for angle in (joint.theta, joint.alpha)]
    used |= {name for angle in turned for name in names_of(angle)}
    return tuple(name for name in robot.parameters if name in used)


def _names(robot: Robot, *exprs: Expr) -> Iterator[str]:
    for expr in exprs:
        degrees = expr.poly.degrees()
        for g in robot.ring.generators:
            if g.kind != "symbol" and degrees[g.index] > 0:
                yield from robot.parameters  # it stands in a root or a denominator: all may matter
            elif degrees[g.index] > 0:
                yield g.name
