"""Fractions in a line of words have a stroke, m l²/12: stacked ones are small there, and part the lines."""

from __future__ import annotations

from dynsolve.notation.tree import (
    Derivative,
    Letter,
    Negative,
    Node,
    Number,
    Parenthesized,
    Quotient,
    Relation,
    Row,
    Slashed,
    Sum,
    Symbol,
)
from dynsolve.notation.walk import walk, with_children


def in_line(node: Node) -> Node:
    """The formula with a stroke in the fractions that stand alone or as terms.

    A factor of a product stays stacked, for a stroke before other factors could be misread, and
    so does a number: ½ has the size of a line.

    >>> from dynsolve.notation.text import read
    >>> [type(in_line(read(text).tree)).__name__ for text in ("m*l^2/12", "(m/2)/l", "1/2")]
    ['Slashed', 'Quotient', 'Quotient']
    """
    match node:
        case Quotient(Number(), Number()):
            return node
        case Quotient() if not any(map(_is_stacked, walk(node.numerator, node.denominator))):
            return Slashed(node)
        case Derivative(of) if isinstance(of, Symbol | Letter):
            return Slashed(node)
        case Sum() | Relation() | Row() | Negative() | Parenthesized():
            return with_children(node, in_line)
    return node


def _is_stacked(node: Node) -> bool:
    """Whether a part of a fraction is one itself."""
    return isinstance(node, Quotient | Derivative) or (isinstance(node, Number) and node.q != 1)
