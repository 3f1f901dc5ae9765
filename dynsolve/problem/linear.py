"""The joint variable as a linear combination of coordinates with rational coefficients."""

from __future__ import annotations

from collections.abc import Container
from fractions import Fraction

from dynsolve.algebra.rationals import rational_value
from dynsolve.notation.tree import (
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
from dynsolve.notation.walk import names_in

Rates = dict[str, Fraction]


class NotLinear(Exception):
    """A coordinate occurs otherwise than times a rational number."""

    def __init__(self, message: str, help: str) -> None:
        super().__init__(message)
        self.message, self.help = message, help


_HELP = (
    "a joint variable is a sum of coordinates times rational numbers, plus a constant: p2* - p1*/2 + 90deg"
)


def linear_rates(node: Node, coordinates: Container[str]) -> Rates:
    """Σ rate·coordinate of a formula, its constant part left out; rates of 0 are left out.

    Raises NotLinear.

    >>> from dynsolve.notation.text import read
    >>> linear_rates(read("2*(p2 - p1/3) + 90deg").tree, ("p1", "p2"))
    {'p2': Fraction(2, 1), 'p1': Fraction(-2, 3)}
    """
    return {name: rate for name, rate in _rates(node, coordinates).items() if rate}


def _rates(node: Node, coordinates: Container[str]) -> Rates:
    found = sorted(name for name in names_in(node) if name in coordinates)
    if not found:
        return {}
    match node:
        case Symbol(name):
            return {name: Fraction(1)}
        case Negative(argument):
            return _scaled(_rates(argument, coordinates), Fraction(-1))
        case Parenthesized(argument):
            return _rates(argument, coordinates)
        case Sum(terms):
            total: Rates = {}
            for term in terms:
                for name, rate in _rates(term, coordinates).items():
                    total[name] = total.get(name, Fraction(0)) + rate
            return total
        case Product(factors):
            return _product(factors, coordinates)
        case Quotient(numerator, denominator):
            if any(name in coordinates for name in names_in(denominator)):
                raise NotLinear(f"the coordinate {found[0]} stands in a denominator", _HELP)
            return _scaled(_rates(numerator, coordinates), 1 / _rational(denominator, found[0]))
        case Power(base, Number(1, 1)):
            return _rates(base, coordinates)
        case Power() | Function():
            what = "a power" if isinstance(node, Power) else f"{node.name}(...)"
            raise NotLinear(f"the coordinate {found[0]} stands in {what}: not linear", _HELP)
    raise NotLinear(f"not linear in the coordinate {found[0]}", _HELP)


def _product(factors: tuple[Node, ...], coordinates: Container[str]) -> Rates:
    moving = [f for f in factors if any(name in coordinates for name in names_in(f))]
    first = min(name for name in names_in(moving[0]) if name in coordinates)
    if len(moving) > 1:
        raise NotLinear(f"a product of coordinates, {first} among them: not linear", _HELP)
    rates = _rates(moving[0], coordinates)
    for factor in factors:
        if factor is not moving[0]:
            rates = _scaled(rates, _rational(factor, first))
    return rates


def _scaled(rates: Rates, factor: Fraction) -> Rates:
    return {name: rate * factor for name, rate in rates.items()}


def _rational(node: Node, coordinate: str) -> Fraction:
    value = rational_value(node)
    if value is None:
        raise NotLinear(f"the coefficient of {coordinate} is not a rational number", _HELP)
    if not value:
        raise NotLinear(f"the coefficient of {coordinate} is zero, or divided by zero", _HELP)
    return value
