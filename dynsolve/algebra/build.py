"""Small constructors of notation trees, and what a tree costs to read.

The cost of a formula is what a person counts in it: every + - * /, power, sign
and function call.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from fractions import Fraction
from math import prod

from dynsolve.notation.tree import (
    ONE,
    ZERO,
    Function,
    Negative,
    Node,
    Number,
    Power,
    Product,
    Quotient,
    Sum,
    Symbol,
)


def cost(node: Node) -> int:
    """The operations of a formula as it is printed.

    >>> cost(Sum((Product((Symbol("m"), Power(Symbol("l"), Number(2)))), Negative(Function("cos", Symbol("q"))))))
    4
    """
    match node:
        case Symbol() | Number(_, 1):
            return 0
        case Number():
            return 1
        case Sum(terms):
            inner = sum(cost(t.argument) if isinstance(t, Negative) else cost(t) for t in terms)
            return inner + len(terms) - 1 + isinstance(terms[0], Negative)
        case Product(factors):
            return sum(map(cost, factors)) + len(factors) - 1
        case Power(base, exponent):
            return cost(base) + cost(exponent) + 1
        case Quotient(numerator, denominator):
            return cost(numerator) + cost(denominator) + 1
        case Negative(argument) | Function(_, argument):
            return cost(argument) + 1
    raise TypeError(f"no cost for {type(node).__name__}")


def power(base: Node, exponent: int) -> Node:
    """base^exponent, exponent ≥ 1."""
    return base if exponent == 1 else Power(base, Number(exponent))


def split_sign(node: Node) -> tuple[int, Node]:
    """(±1, the tree without its leading sign)"""
    return (-1, node.argument) if isinstance(node, Negative) else (1, node)


def total(terms: Sequence[Node]) -> Node:
    """The sum of terms, flattened; a positive term is put first where there is one."""
    flat: list[Node] = []
    for term in terms:
        sign, inner = split_sign(term)
        if isinstance(inner, Sum):
            flat.extend(inner.terms if sign > 0 else map(negated, inner.terms))
        elif inner != ZERO:
            flat.append(term)
    if not flat:
        return ZERO
    if len(flat) == 1:
        return flat[0]
    if isinstance(flat[0], Negative):
        first = next((i for i, t in enumerate(flat) if not isinstance(t, Negative)), 0)
        flat.insert(0, flat.pop(first))
    return Sum(tuple(flat))


def negated(node: Node) -> Node:
    """-node, without double signs."""
    return node.argument if isinstance(node, Negative) else node if node == ZERO else Negative(node)


def leads_with_minus(node: Node) -> bool:
    """Whether a sum has more negative terms than positive ones, or starts with one."""
    return isinstance(node, Sum) and isinstance(node.terms[0], Negative)


def times(coefficient: Fraction | int, factors: Iterable[tuple[Node, int]]) -> Node:
    """coefficient · Π node^exponent; negative exponents go below the fraction line.

    Signs of factors are drawn to the front, products flattened, in the given order.
    """
    coefficient = Fraction(coefficient)
    above: list[Node] = []
    below: list[Node] = []
    for node, exponent in factors:
        sign, inner = split_sign(node)
        if leads_with_minus(inner) and all(isinstance(t, Negative) for t in inner.terms):  # type: ignore[attr-defined]
            sign, inner = -sign, total([negated(t) for t in inner.terms])  # type: ignore[attr-defined]
        coefficient *= sign ** (exponent % 2)
        if isinstance(inner, Quotient) and exponent == 1 and isinstance(inner.denominator, Number):
            coefficient /= inner.denominator.p
            inner = inner.numerator
        if isinstance(inner, Number):
            coefficient *= Fraction(inner.p, inner.q) ** exponent
        elif isinstance(inner, Product) and exponent == 1:
            for factor in inner.factors:
                if isinstance(factor, Number):
                    coefficient *= Fraction(factor.p, factor.q)
                else:
                    above.append(factor)
        elif exponent > 0:
            above.append(power(inner, exponent))
        else:
            below.append(power(inner, -exponent))
    if not coefficient:
        return ZERO
    node = _fraction(abs(coefficient), above, below)
    return Negative(node) if coefficient < 0 else node


def _fraction(coefficient: Fraction, above: list[Node], below: list[Node]) -> Node:
    if coefficient.numerator != 1:
        above = [Number(coefficient.numerator), *above]
    if coefficient.denominator != 1:
        below = [Number(coefficient.denominator), *below]
    numerator = _product(above)
    if not below:
        return numerator
    if numerator == ONE and len(below) == 1 and isinstance(below[0], Number):
        return Number(1, below[0].p)
    if isinstance(numerator, Number) and len(below) == 1 and isinstance(below[0], Number):
        return Number(numerator.p, below[0].p)
    return Quotient(numerator, _product(below))


def _product(factors: list[Node]) -> Node:
    if not factors:
        return ONE
    if all(isinstance(f, Number) for f in factors):
        return Number(prod(f.p for f in factors if isinstance(f, Number)))
    return factors[0] if len(factors) == 1 else Product(tuple(factors))
