"""Results with numbers for the parameters: functions of the state alone, where every parameter has one."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any

from dynsolve.algebra.matrix import Matrix
from dynsolve.derivation.graph import Derivation
from dynsolve.explain.forms import Forms
from dynsolve.explain.style import style_of
from dynsolve.notation.printing import Style
from dynsolve.notation.tree import Node
from dynsolve.robot.model import Robot
from dynsolve.solution.numbers.given import Given
from dynsolve.solution.numbers.rounding import DIGITS, has_constants, rounded, without_constants


@dataclass(frozen=True)
class Valued:
    """The results of a robot with numbers in it, exact (`forms`) and as they are shown."""

    robot: Robot
    values: Derivation
    forms: Forms
    given: Given
    decimal: bool = False
    digits: int = DIGITS

    @cached_property
    def style(self) -> Style:
        """How its formulas look."""
        return style_of(self.robot)

    def shown(self, name: str, digits: int = 0) -> Node:
        """A result as it is shown: exact where no decimal goes in, else to so many digits."""
        if not self.decimal:
            return self.forms(name)
        if not has_constants(self.robot.ring):
            return rounded(self.forms(name), digits or self.digits)
        value: Any = self.values[name]
        plain = value.map(without_constants) if isinstance(value, Matrix) else without_constants(value)
        return rounded(self.forms.of(plain), digits or self.digits)
