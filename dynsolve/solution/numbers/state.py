"""What holds at a state: every result of a derivation with numbers for the coordinates and their rates."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any

from dynsolve.algebra.compact.compactor import Compactor
from dynsolve.algebra.expr import Expr
from dynsolve.algebra.matrix import Matrix
from dynsolve.derivation.graph import Derivation
from dynsolve.explain.forms import is_numeric, leading_names
from dynsolve.explain.style import style_of
from dynsolve.notation.printing import Style
from dynsolve.notation.tree import Node
from dynsolve.robot.model import Robot
from dynsolve.solution.numbers.given import Given
from dynsolve.solution.numbers.rounding import DIGITS, rounded, without_constants
from dynsolve.solution.numbers.substitution import Substitution


@dataclass(frozen=True)
class State:
    """The results of a robot at a state, exact.

    `given` holds the coordinates, velocities and accelerations; parameters without a
    value stay symbols.  Results go by their names in an answer file: `H2`, `Jv1`, `K`,
    `tau`, `D`.  Lengths are in m, masses in kg, angles in radians.
    """

    robot: Robot
    values: Derivation
    given: Given
    decimal: bool = False
    digits: int = DIGITS

    @cached_property
    def _put(self) -> Substitution:
        return Substitution(self.robot.ring, self.given.values)

    @cached_property
    def _compactor(self) -> Compactor:
        return Compactor(self._put.ring, leading_names(self.robot), decimal=self.shows_decimals)

    @cached_property
    def style(self) -> Style:
        """How its formulas look."""
        return style_of(self.robot)

    @cached_property
    def shows_decimals(self) -> bool:
        """Whether results are shown as decimals: where a decimal goes in, or an angle such as 17°."""
        turned = [g.angle for g in self._put.ring.generators if g.kind in ("sin", "cos", "constant")]
        odd = any(all(atom == () for atom, _ in angle.terms) for angle in turned)
        return self.decimal or self.given.decimal or is_numeric(self.robot) or odd

    def exact(self, name: str) -> Expr | Matrix:
        """A result in the exact ring of this state."""
        value: Any = self.values[name]
        return self._put.matrix(value) if isinstance(value, Matrix) else self._put(value)

    def __call__(self, name: str) -> Node:
        """A result as an exact tree, a `tree.Matrix` for a matrix."""
        value = self.exact(name)
        if isinstance(value, Matrix):
            return self._compactor.matrix(value)
        return self._compactor.form(value)

    def shown(self, name: str, digits: int = 0) -> Node:
        """A result as it is shown: exact where no decimal goes in, else to so many digits."""
        if not self.shows_decimals:
            return self(name)
        return rounded(self.plain(name), digits or self.digits)

    def plain(self, name: str) -> Node:
        """A result with roots, cosines of numbers and π in it as decimals of 40 digits."""
        value = self.exact(name)
        if isinstance(value, Matrix):
            return self._compactor.matrix(value.map(without_constants))
        return self._compactor.form(without_constants(value))

    def number(self, name: str) -> Any:
        """A result as a float, or rows of floats for a matrix.

        Raises KeyError for a result that this robot does not have, ValueError where a
        parameter without a value is left in it.
        """
        value = self.exact(name)
        if isinstance(value, Matrix):
            return [[_float(entry, name) for entry in row] for row in value.rows]
        return _float(value, name)

    def symbolic(self, name: str) -> Any:
        """A result as an exact SymPy object."""
        from dynsolve.solution.symbolic import to_sympy

        return to_sympy(self(name))


def _float(expr: Expr, name: str) -> float:
    plain = without_constants(expr)
    if not plain.is_number:
        raise ValueError(f"{name} holds parameters without values: give them, with_values(...)")
    return float(plain.number)
