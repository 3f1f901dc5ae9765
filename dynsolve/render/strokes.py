"""Fractions in a line of words have a stroke, m l²/12: stacked ones are small there, and part the lines."""

from __future__ import annotations

from dynsolve.notation.tree import (
    Cross,
    Derivative,
    Letter,
    Negative,
    Node,
    Number,
    Parenthesized,
    Power,
    Product,
    Quotient,
    Relation,
    Row,
    Slashed,
    Sum,
    Symbol,
    Transpose,
)
from dynsolve.notation.walk import walk, with_children


def in_line(node: Node) -> Node:
    """The formula with a stroke in the fractions that stand alone or as terms.

    A factor before others stays stacked, for a stroke there could be misread, but not in parentheses, and
    so does a number: ½ has the size of a line.

    >>> from dynsolve.notation.text import read
    >>> [type(in_line(read(text).tree)).__name__ for text in ("m*l^2/12", "(m/2)/l", "1/2")]
    ['Slashed', 'Quotient', 'Quotient']
    >>> squared = in_line(Power(Derivative(Symbol("g"), Symbol("q")), Number(2)))
    >>> [type(node).__name__ for node in walk(squared)][:3]
    ['Power', 'Parenthesized', 'Slashed']
    """
    match node:
        case Product((*before, last)):
            return Product((*(in_line(part) if _is_closed(part) else part for part in before), in_line(last)))
        case Power(Derivative() as base, exponent):
            return Power(Parenthesized(in_line(base)), exponent)
        case Derivative(Derivative() as inner, by, total):
            return Slashed(Derivative(Parenthesized(in_line(inner)), by, total))
        case Quotient(Number(), Number()):
            return node
        case Quotient() if not any(map(_is_stacked, walk(node.numerator, node.denominator))):
            return Slashed(node)
        case Derivative(of) if isinstance(of, Symbol | Letter):
            return Slashed(node)
        case Sum() | Relation() | Row() | Negative() | Parenthesized() | Power() | Transpose() | Cross():
            return with_children(node, in_line)
    return node


def _is_closed(node: Node) -> bool:
    """Whether a factor has parentheses around it, raised or not."""
    return isinstance(node, Parenthesized | Power | Transpose)


def _is_stacked(node: Node) -> bool:
    """Whether a part of a fraction is one itself."""
    return isinstance(node, Quotient | Derivative) or (isinstance(node, Number) and node.q != 1)
