"""Results in numbers: with values for parameters (`Valued`), at a state (`State`), and both (`Numbers`)."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import Any

from msgspec import Struct

from dynsolve.algebra.angles import names_of
from dynsolve.algebra.compact.compactor import Compactor
from dynsolve.algebra.fraction import RationalExpr, cancelled, is_zero
from dynsolve.algebra.linear_systems import FractionMatrix, tidy
from dynsolve.algebra.matrix import Matrix
from dynsolve.algebra.ring import Expr
from dynsolve.derivation.graph import Derivation, Skipped, known
from dynsolve.errors import AlgebraError, Finding
from dynsolve.explain.forms import Forms, entry_of, leading_names
from dynsolve.notation import tree
from dynsolve.notation.tree import Node
from dynsolve.quantities.index import quantities
from dynsolve.robot.model import Robot
from dynsolve.solution.numbers.given import Given
from dynsolve.solution.numbers.substitution import (
    DIGITS,
    Substitution,
    has_constants,
    rounded,
    without_constants,
)

Exact = Expr | RationalExpr | Matrix | FractionMatrix
"""What a result may be."""


@dataclass(frozen=True, kw_only=True)
class _NumericResults(ABC):
    """Exact results by their names in an answer file (`H2`, `Jv1`, `K`, `tau`, `D`), and how they are shown.

    `given` are the numbers that were put in.  With `decimal` results are shown as
    decimals, whatever was put in, of `digits` significant digits, where these were asked for.
    """

    robot: Robot
    values: Derivation
    given: Given
    decimal: bool = False
    digits: int = 0

    @property
    @abstractmethod
    def shows_decimals(self) -> bool:
        """Whether results are shown as decimals."""

    @abstractmethod
    def __call__(self, name: str) -> Node:
        """A result as an exact tree, a `tree.Matrix` for a matrix."""

    @abstractmethod
    def plain(self, name: str) -> Node:
        """A result with roots, cosines of numbers and π in it as decimals of 40 digits."""

    def value(self, name: str) -> Any:
        """A value of the derivation; a Christoffel symbol by its own name."""
        if name in self.values.rules:
            return self.values[name]
        own = quantities(self.robot)[name]
        return self.values[own.whole][own.entry]

    def shown(self, name: str, digits: int = DIGITS) -> Node:
        """A result as it is shown: exact where no decimal goes in, else to `digits`, or those asked for."""
        own = quantities(self.robot).get(name)
        if own is not None and own.is_read_off and len(own.entry) == 2:
            return entry_of(self.shown(own.whole, digits), own.entry)
        value = self.value(name)
        if isinstance(value, Skipped):
            return tree.Words(f"({value.why})")
        return rounded(self.plain(name), self.digits or digits) if self.shows_decimals else self(name)


@dataclass(frozen=True, kw_only=True)
class Valued(_NumericResults):
    """The results with numbers for parameters: `values` and `forms` are those of the robot with them."""

    forms: Forms

    @property
    def shows_decimals(self) -> bool:
        """Whether a decimal went in, or decimals were asked for."""
        return self.decimal

    def __call__(self, name: str) -> Node:
        """A result as an exact tree."""
        return self.forms(name)

    def plain(self, name: str) -> Node:
        """A result without roots and the like."""
        return self.forms.of(_plain(self.value(name))) if has_constants(self.robot.ring) else self(name)


@dataclass(frozen=True, kw_only=True)
class State(_NumericResults):
    """The results at a state, exact.

    `given` holds the coordinates, velocities and accelerations; parameters without a
    value stay symbols.  Lengths are in m, masses in kg, angles in radians.
    """

    @cached_property
    def _put(self) -> Substitution:
        return Substitution(self.robot.ring, self.given.values)

    @cached_property
    def _compactor(self) -> Compactor:
        return Compactor(self._put.ring, leading_names(self.robot), decimal=self.shows_decimals)

    @cached_property
    def shows_decimals(self) -> bool:
        """Whether results are shown as decimals: where a decimal goes in, or an angle such as 17°."""
        turned = [g.angle for g in self._put.ring.generators if g.kind in ("sin", "cos", "constant")]
        odd = any(all(atom == () for atom, _ in angle.terms) for angle in turned)
        return self.decimal or self.given.decimal or self.robot.has_decimals or odd

    def value(self, name: str) -> Any:
        """A value of the derivation, skipped where a denominator is 0 at this state."""
        value = known(super().value(name))
        fractions = value.entries if isinstance(value, FractionMatrix) else (value,)
        if any(is_zero(self._put(one.denominator)) for one in fractions if isinstance(one, RationalExpr)):
            return Skipped("a denominator is 0 at this state")
        return value

    def exact(self, name: str) -> Exact:
        """A result in the exact ring of this state."""
        value = self.value(name)
        if isinstance(value, Skipped):
            raise AlgebraError(f"{name}: {value.why}")
        if isinstance(value, RationalExpr):
            return _whole(self._fraction(value))
        if isinstance(value, FractionMatrix):
            return tidy(self._put.ring, ([self._fraction(entry) for entry in row] for row in value.rows))
        return self._put.matrix(value) if isinstance(value, Matrix) else self._put(value)

    def __call__(self, name: str) -> Node:
        """A result as an exact tree."""
        return self._form(self.exact(name))

    def plain(self, name: str) -> Node:
        """A result without roots and the like."""
        return self._form(_plain(self.exact(name)))

    def _fraction(self, value: RationalExpr) -> RationalExpr:
        return cancelled(RationalExpr(self._put(value.numerator), self._put(value.denominator)))

    def _form(self, value: Exact) -> Node:
        if isinstance(value, RationalExpr | FractionMatrix):
            from dynsolve.explain.forms import ProductForms

            forms = ProductForms(self._compactor)
            if isinstance(value, RationalExpr):
                return forms.fraction(value)
            return forms.matrix(value)
        return self._compactor.matrix(value) if isinstance(value, Matrix) else self._compactor.form(value)

    def number(self, name: str) -> Any:
        """A result as a float, or rows of floats for a matrix.

        Raises KeyError for a result that this robot does not have, ValueError where a
        parameter without a value is left in it.
        """
        value = self.exact(name)
        if isinstance(value, FractionMatrix):
            return [[_float(entry, name) for entry in row] for row in value.rows]
        if isinstance(value, Matrix):
            return [[_float(entry, name) for entry in row] for row in value.rows]
        return _float(value, name)

    def symbolic(self, name: str) -> Any:
        """A result as an exact SymPy object."""
        from dynsolve.solution.numeric import to_sympy

        return to_sympy(self(name))


def _whole(value: RationalExpr) -> Expr | RationalExpr:
    """A fraction, as a polynomial where nothing is below."""
    return value.numerator if value.divisor is None else value


def _plain(value: Exact) -> Exact:
    """A value with its roots, cosines of numbers and π as decimals."""
    if isinstance(value, RationalExpr):
        return _whole(cancelled(RationalExpr(*map(without_constants, (value.numerator, value.denominator)))))
    if isinstance(value, FractionMatrix):
        rows = (
            [(without_constants(x.numerator), without_constants(x.denominator)) for x in row]
            for row in value.rows
        )
        return tidy(value.ring, ([cancelled(RationalExpr(*parts)) for parts in row] for row in rows))
    return value.map(without_constants) if isinstance(value, Matrix) else without_constants(value)


def _float(expr: Expr | RationalExpr, name: str) -> float:
    if isinstance(expr, RationalExpr):
        return _float(expr.numerator, name) / _float(expr.denominator, name)
    plain = without_constants(expr)
    if not plain.is_number:
        raise ValueError(f"{name} holds parameters without values: give them, with_values(...)")
    return float(plain.number)


class Numbers(Struct, frozen=True):
    """The numeric results beside the symbolic ones of a robot.

    `given` are the values of parameters; `valued` the results with these values, None
    where there are none; `state` what holds at a state, None where none is asked for.
    """

    robot: Robot
    given: Given
    valued: Valued | None = None
    state: State | None = None

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
    if robot.has_dynamics:
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
