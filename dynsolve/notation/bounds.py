"""How large a formula may be, measured before anything is multiplied out.

A text of fifteen characters, (a+b+c+d)^20^20, can ask for more work than a
machine has.  What counts is known from the tree alone: how deep it is, and an
upper bound of the terms and the degree it has when multiplied out.
"""

from __future__ import annotations

from math import comb

from dynsolve.errors import ReadError
from dynsolve.notation.tree import (
    Degrees,
    Function,
    Negative,
    Node,
    Number,
    Power,
    Product,
    Quotient,
    Sum,
)

MAX_LENGTH = 10_000
MAX_NESTING = 50
MAX_DIGITS = 60
MAX_EXPONENT = 20
MAX_DEPTH = 100
MAX_TERMS = 20_000
MAX_DEGREE = 100


def check_size(tree: Node, length: int = 1) -> None:
    """Raise ReadError for a tree that is too deep, or too large when multiplied out.

    `length` is that of the text it was read from, for the error.
    """
    order = [tree]
    for node in order:
        order.extend(_children(node))
    measures: dict[int, tuple[int, int, int]] = {}
    for node in reversed(order):
        depth, terms, degree = _measure(node, [measures[id(child)] for child in _children(node)])
        if depth > MAX_DEPTH:
            raise ReadError(
                "this is nested too deeply", 0, length, "write it in fewer levels of / and parentheses"
            )
        if terms > MAX_TERMS or degree > MAX_DEGREE:
            raise ReadError(
                "this is too large: multiplied out it would have "
                + (f"over {MAX_TERMS} terms" if terms > MAX_TERMS else f"powers over {MAX_DEGREE}"),
                0,
                length,
                "name a part of it with a symbol of its own",
            )
        measures[id(node)] = depth, terms, degree


def _children(node: Node) -> tuple[Node, ...]:
    match node:
        case Sum():
            return node.terms
        case Product():
            return node.factors
        case Quotient():
            return (node.numerator, node.denominator)
        case Power():
            return (node.base,)
        case Negative() | Function():
            return (node.argument,)
    return ()


def _measure(node: Node, parts: list[tuple[int, int, int]]) -> tuple[int, int, int]:
    """Depth, terms and degree of a node from those of its parts."""
    depth = 1 + max((part[0] for part in parts), default=0)
    terms, degree = 1, 1
    match node:
        case Number() | Degrees():
            degree += (node.p.bit_length() + node.q.bit_length()) // 32
        case Sum() | Quotient():
            terms = sum(part[1] for part in parts)
            degree = max(part[2] for part in parts)
        case Product():
            degree = sum(part[2] for part in parts)
            for part in parts:
                terms *= part[1]
        case Power():
            n = _size(node.exponent)
            degree = n * parts[0][2]
            terms = comb(parts[0][1] + n - 1, n) if n else 1
        case Negative():
            terms, degree = parts[0][1:]
    return depth, terms, degree


def _size(exponent: Node) -> int:
    """|n| of a whole exponent n."""
    inner = exponent.argument if isinstance(exponent, Negative) else exponent
    return inner.p if isinstance(inner, Number) else MAX_EXPONENT
