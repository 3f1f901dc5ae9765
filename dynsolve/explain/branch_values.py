"""One branch of the inverse kinematics at numbers: every coordinate, exactly where it can be."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from fractions import Fraction
from math import acos, asin, atan2, sqrt
from typing import Any

from dynsolve.algebra.rationals import rational_value
from dynsolve.algebra.surd_angles import SurdAngle
from dynsolve.algebra.surd_values import Exact, NoValue, Undetermined, exact_value
from dynsolve.algebra.surds import NotExact
from dynsolve.errors import AlgebraError
from dynsolve.notation.build import negated, times, total
from dynsolve.notation.tree import ZERO, Negative, Node, Number, Product, Quotient, Sum, Symbol
from dynsolve.notation.tree_values import FUNCTIONS, compile_trees
from dynsolve.notation.walk import mapped, names_in

DIGITS = 12
"""So many digits has a value that has no formula."""

_ROUNDING = 1e-9
"""What rounding may make of 0, and of what is on the boundary."""


class Unreal(Exception):
    """A coordinate has no real value: `function` was taken of `argument`."""

    def __init__(self, coordinate: str, function: str, argument: Node) -> None:
        super().__init__(coordinate)
        self.coordinate, self.function, self.argument = coordinate, function, argument


@dataclass(slots=True)
class BranchValues:
    """The coordinates of a branch as far as they are known: by number, and exactly as far as they are.

    `free` are angles whose formula says nothing at these numbers; they stand at a place of their own.
    """

    numbers: dict[str, float]
    exact: dict[str, Exact]
    free: dict[str, float] = field(default_factory=dict)

    def put(self, name: str, formula: Node, place: float) -> None:
        """Work out one coordinate; one that is free is put at `place`.

        Raises Unreal where it has no real value, ZeroDivisionError where its formula says nothing.
        """
        try:
            value = exact_value(formula, self.exact)
        except NoValue as error:
            if error.function == "/":
                raise ZeroDivisionError from None
            raise Unreal(name, error.function, error.argument) from None
        except Undetermined:
            self.set_free(name, place)
        except NotExact:
            try:
                self.numbers[name] = number_of(name, formula, self.numbers)
            except _NoDirection:
                self.set_free(name, place)
        else:
            self.exact[name], self.numbers[name] = value, float(value)

    def set_free(self, name: str, place: float) -> None:
        """Put an angle at a place; several at places that differ, lest they be free only together."""
        self.numbers[name] = self.free[name] = place * (1 + len(self.free))
        if not place:
            self.exact[name] = SurdAngle.of_degrees(0)


def branch_values(
    branch: Mapping[str, Node], numbers: Mapping[str, float], exact: Mapping[str, Exact], place: float = 0.0
) -> BranchValues:
    """Every coordinate of a branch; raises as `BranchValues.put` does."""
    found = BranchValues(dict(numbers), dict(exact))
    for name in sorted(names_in(*branch.values()) - {*branch, *numbers}):
        found.set_free(name, place)
    for name, formula in branch.items():
        found.put(name, formula, place)
    return found


def shown(name: str, branch: Mapping[str, Node], found: BranchValues, written: Mapping[str, Node]) -> Node:
    """A coordinate as a formula: its exact value, else its formula with numbers in it."""
    return found.exact[name].node if name in found.exact else with_numbers(branch[name], written, found.exact)


def with_numbers(formula: Node, written: Mapping[str, Node], exact: Mapping[str, Exact]) -> Node:
    """A formula with the given formulas in place of names, each part that has an exact value as that."""

    def put(part: Node) -> Node:
        try:
            return exact_value(part, exact).node
        except AlgebraError:
            return _folded(written.get(part.name, part) if isinstance(part, Symbol) else part)

    return mapped(formula, put)


def _folded(part: Node) -> Node:
    """A sum or product without the 0 and 1 that numbers have left in it."""
    match part:
        case Product(factors):
            return times(1, [(factor, 1) for factor in factors])
        case Sum(terms):
            numbers = [value for term in terms if (value := rational_value(term)) is not None]
            rest = [term for term in terms if rational_value(term) is None]
            return total([*rest, times(sum(numbers, Fraction(0)), [])]) if numbers else total(rest)
        case Negative(argument) if argument == ZERO:
            return ZERO
        case Quotient(numerator, denominator) if numerator == ZERO and denominator != ZERO:
            return ZERO
    return part


def decimal(value: float, digits: int = DIGITS) -> Node:
    """A number in floating point, as a decimal."""
    exact = Fraction(f"{value:.{digits}g}")
    size = Number(abs(exact.numerator), exact.denominator, decimal=True)
    return negated(size) if exact < 0 else size


# -- floating point --------------------------------------------------------------------------------


class _NoDirection(Exception):
    """The direction of a point to itself."""


def number_of(name: str, formula: Node, values: Mapping[str, float]) -> float:
    """The value of a formula; what is beyond a boundary by rounding alone is on it."""

    def within(function: Any, low: float, high: float) -> Any:
        def at(x: float) -> float:
            if not low - _ROUNDING <= x <= high + _ROUNDING:
                raise Unreal(name, labels[function], decimal(x, 4))
            return float(function(min(max(x, low), high)))

        return at

    def direction(both: tuple[float, float]) -> float:
        if max(map(abs, both)) < _ROUNDING:
            raise _NoDirection
        return atan2(*both)

    labels = {acos: "acos", asin: "asin", sqrt: "sqrt"}
    functions = {
        **FUNCTIONS,
        "acos": within(acos, -1, 1),
        "asin": within(asin, -1, 1),
        "sqrt": within(sqrt, 0, float("inf")),
        "atan2": direction,
    }
    return float(compile_trees([formula], functions).run(values)[0])
