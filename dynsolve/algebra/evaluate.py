"""The exact value of a tree in a ring.  Nothing is evaluated that was not read into a tree before."""

from __future__ import annotations

from collections.abc import Iterable
from fractions import Fraction
from math import comb

from dynsolve.algebra.angles import angle_from_tree
from dynsolve.algebra.expr import Expr
from dynsolve.algebra.ring import Ring
from dynsolve.errors import AlgebraError
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

MOST_TERMS = 200_000
"""A product that may have more terms than this is refused before it is formed."""

LARGEST_POWER = 64
"""The largest exponent."""


def value_of(ring: Ring, node: Node) -> Expr:
    """The exact value of a tree.

    Raises AlgebraError for an unknown symbol, a zero denominator, an angle that is a
    bare number, or a product over the bound.
    """
    match node:
        case Number(p, q):
            return ring.constant(Fraction(p, q))
        case Symbol(name, dots):
            return ring.symbol(name, dots)
        case Negative(argument):
            return -value_of(ring, argument)
        case Parenthesized(argument):
            return value_of(ring, argument)
        case Sum(terms):
            return _sum(ring, (value_of(ring, term) for term in terms))
        case Product(factors):
            product = ring.one
            for factor in factors:
                product = _product(product, value_of(ring, factor))
            return product
        case Quotient(numerator, denominator):
            return _product(value_of(ring, numerator), ring.inverse(value_of(ring, denominator)))
        case Power(base, exponent):
            return _power(value_of(ring, base), exponent)
        case Function(name, argument):
            return _function(ring, name, argument)
        case Degrees(p, q):
            return ring.symbol("pi") * Fraction(p, 180 * q)
    raise AlgebraError("this is not an expression")


def _sum(ring: Ring, terms: Iterable[Expr]) -> Expr:
    total = ring.zero
    for term in terms:
        total = total + term
    return total


def _product(left: Expr, right: Expr) -> Expr:
    if len(left) * len(right) > MOST_TERMS:
        raise AlgebraError("the product has too many terms", "write it with an abbreviation")
    return left * right


def _power(base: Expr, exponent: Node) -> Expr:
    match exponent:
        case Number(p, 1):
            count = p
        case Negative(Number(p, 1)):
            base, count = base.ring.inverse(base), p
        case _:
            raise AlgebraError("an exponent must be a whole number", "write sqrt(...) for a root")
    if count > LARGEST_POWER or comb(max(len(base), 1) + count - 1, count) > MOST_TERMS:
        raise AlgebraError(f"the power {count} is too large")
    return base**count


def _function(ring: Ring, name: str, argument: Node) -> Expr:
    if name == "sqrt":
        return ring.root(argument, value_of(ring, argument))
    angle = angle_from_tree(argument)
    match name:
        case "sin":
            return ring.sin(angle)
        case "cos":
            return ring.cos(angle)
        case "tan":
            return ring.sin(angle) * ring.inverse(ring.cos(angle))
    raise AlgebraError(f"{name} is not a function that occurs here", "known are sin, cos, tan and sqrt")
