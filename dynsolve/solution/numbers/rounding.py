"""Exact results shown as decimals: the only place where a number is rounded."""

from __future__ import annotations

from collections.abc import Mapping
from decimal import Decimal
from fractions import Fraction
from functools import lru_cache
from typing import Any

from flint import arb, ctx

from dynsolve.algebra.expr import Expr
from dynsolve.algebra.generators import Generator
from dynsolve.algebra.rationals import rational
from dynsolve.algebra.ring import Ring
from dynsolve.notation.printing import significant
from dynsolve.notation.tree import (
    Function,
    Letter,
    Node,
    Number,
    Power,
    Quotient,
)
from dynsolve.notation.walk import with_children

DIGITS = 4
"""Significant digits, unless others are asked for."""

_WORKING_DIGITS = 40
_WORKING_BITS = 400


def rounded(node: Node, digits: int) -> Node:
    """A tree with every number in it as a decimal of so many significant digits.

    Exponents, angles and indices stay.
    """
    match node:
        case Number(p, q):
            value = significant(Fraction(p, q), digits)
            return Number(value.numerator, value.denominator, decimal=True)
        case Quotient(Number(p, q), Number(r, s)):
            return rounded(Number(p * s, q * r), digits)
        case Power(base, exponent):
            return Power(rounded(base, digits), exponent)
        case Function(name) if name != "sqrt":
            return node
        case Letter():
            return node
    return with_children(node, lambda part: rounded(part, digits))


def without_constants(expr: Expr) -> Expr:
    """The expression with √3, cos 17° and π in it as decimals of 40 digits.

    >>> from dynsolve.algebra.build import build_ring
    >>> from dynsolve.algebra.ring_values import value_of
    >>> ring = build_ring([], [Function("sqrt", Number(2))])
    >>> float(without_constants(value_of(ring, Function("sqrt", Number(2)))).number)
    1.4142135623730951
    """
    constants = _constants(expr.ring)
    used = expr.poly.degrees()
    if not any(used[index] > 0 for index in constants):
        return expr
    collected: dict[tuple[int, ...], Any] = {}
    with ctx.workprec(_WORKING_BITS):
        for exponents, coefficient in expr.poly.to_dict().items():
            value = arb(coefficient)
            for index, number in constants.items():
                if exponents[index]:
                    value *= number ** int(exponents[index])
            rest = tuple(0 if i in constants else int(e) for i, e in enumerate(exponents))
            collected[rest] = collected.get(rest, arb(0)) + value
        numbers = {rest: rational(_fraction(value)) for rest, value in collected.items()}
    poly = expr.ring.ctx.from_dict({rest: number for rest, number in numbers.items() if number})
    return Expr(expr.ring, poly)


def _fraction(value: arb) -> Fraction:
    """The value to 40 digits; rounding that is left of a sum that is 0 counts as 0."""
    if abs(float(value)) < 10.0**-_WORKING_DIGITS:
        return Fraction(0)
    return Fraction(Decimal(value.str(_WORKING_DIGITS, radius=False)))


def _constants(ring: Ring) -> Mapping[int, arb]:
    """The generators that are numbers, with their values."""
    return _found(ring, len(ring.inverses))


@lru_cache(maxsize=8)
def _found(ring: Ring, inverses: int) -> Mapping[int, arb]:
    found: dict[int, arb] = {}
    with ctx.workprec(_WORKING_BITS):
        for g in sorted(ring.generators, key=_order):
            value = _value(ring, g, found)
            if value is not None:
                found[g.index] = value
    return found


def _order(g: Generator) -> tuple[int, int]:
    """Roots are of angles, numbers and roots laid out after them; denominators may hold all of these."""
    return ("root", "inverse").index(g.kind) + 1 if g.kind in ("root", "inverse") else 0, -g.index


def _value(ring: Ring, g: Generator, known: Mapping[int, arb]) -> arb | None:
    match g.kind:
        case "symbol" if g.name == "pi":
            return arb.pi()
        case "root":
            inner = _worth(ring.radicands[g.index], known)
            return None if inner is None else inner.sqrt()
        case "inverse" if g.index in ring.inverses:
            inner = _worth(ring.inverses[g.index], known)
            return None if inner is None else 1 / inner
        case "sin" | "cos" | "constant" if all(atom == () for atom, _ in g.angle.terms):
            angle = arb.pi() * arb(rational(g.angle.degrees / 180))
            for _, radians in g.angle.terms:
                angle += arb(rational(radians))
            return angle.sin() if g.kind == "sin" else angle.cos()
    return None


def _worth(poly: Any, known: Mapping[int, arb]) -> arb | None:
    """The value of a polynomial in known generators, None where another stands in it."""
    total = arb(0)
    for exponents, coefficient in poly.to_dict().items():
        term = arb(coefficient)
        for index, exponent in enumerate(exponents):
            if exponent and index not in known:
                return None
            if exponent:
                term *= known[index] ** int(exponent)
        total += term
    return total


def has_constants(ring: Ring) -> bool:
    """Whether a ring has roots of numbers, cosines of constant angles or π among its generators."""
    return bool(_constants(ring))
