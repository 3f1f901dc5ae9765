"""The units of abbreviations, from the formulas that define them: σ₁ = m₂ l_c2² + I₂ is in kg m²."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from functools import reduce

from dynsolve.explain.recurring import Definition
from dynsolve.notation.tree import (
    Degrees,
    Function,
    Negative,
    Node,
    Number,
    Parenthesized,
    Power,
    Product,
    Quotient,
    Sum,
    Symbol,
)
from dynsolve.robot.dimensions import Dimensions
from dynsolve.robot.model import Robot
from dynsolve.robot.units import NONE, Dimension, si, times


def units_of(robot: Robot, definitions: Iterable[Definition]) -> dict[str, list[str]]:
    """The names by their unit, in order; under the empty unit those of which it cannot be told.

    Nothing can be told where the problem gives numbers for lengths or masses: they hide their units.
    """
    known = Dimensions(robot.ring, robot)
    found: dict[Node, Dimension | None] = {}

    def of_symbol(symbol: Symbol) -> Dimension | None:
        if symbol in found:
            return found[symbol]
        return known.of(robot.ring.symbol(symbol.name, symbol.dots))

    by_unit: dict[str, list[str]] = {}
    for one in definitions:
        own = found[one.name] = _dimension(one.meaning, of_symbol) if known.known else None
        by_unit.setdefault("" if own is None else si(own), []).append(one.name.name)
    return by_unit


def _dimension(node: Node, of_symbol: Callable[[Symbol], Dimension | None]) -> Dimension | None:
    """The dimension of a formula; None where that of a part is unknown, or terms of a sum differ."""

    def of(part: Node) -> Dimension | None:
        return _dimension(part, of_symbol)

    match node:
        case Number() | Degrees() | Function("sin" | "cos"):
            return NONE
        case Symbol():
            return of_symbol(node)
        case Negative(part) | Parenthesized(part):
            return of(part)
        case Sum(terms):
            different = set(map(of, terms))
            return different.pop() if len(different) == 1 else None
        case Product(factors):
            return reduce(_multiplied, map(of, factors))
        case Power(base, Number(exponent, 1)):
            return _multiplied(NONE, of(base), exponent)
        case Quotient(above, below):
            return _multiplied(of(above), of(below), -1)
    return None


def _multiplied(a: Dimension | None, b: Dimension | None, power: int = 1) -> Dimension | None:
    return None if a is None or b is None else times(a, b, power)
