"""Trees -> SymPy, node by node; no text is ever parsed."""

from __future__ import annotations

from typing import Any

import sympy

from dynsolve.notation.tree import (
    Degrees,
    Function,
    Matrix,
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
from dynsolve.notation.tree_values import plain_name

_FUNCTIONS = {"sin": sympy.sin, "cos": sympy.cos, "tan": sympy.tan, "sqrt": sympy.sqrt, "sgn": sympy.sign}


def to_sympy(node: Node) -> Any:
    """The SymPy object of a tree, all of its symbols real; velocities are `theta1_dot`.

    >>> to_sympy(Product((Symbol("m1"), Power(Symbol("theta1", 1), Number(2)))))
    m1*theta1_dot**2
    """
    return _Converter().convert(node)


class _Converter:
    """Converts each shared part once."""

    def __init__(self) -> None:
        self._known: dict[int, Any] = {}

    def convert(self, node: Node) -> Any:
        if id(node) not in self._known:
            self._known[id(node)] = self._converted(node)
        return self._known[id(node)]

    def _converted(self, node: Node) -> Any:
        match node:
            case Number(p, q):
                return sympy.Rational(p, q)
            case Degrees(p, q):
                return sympy.pi * sympy.Rational(p, 180 * q)
            case Symbol("pi", 0):
                return sympy.pi
            case Symbol():
                return sympy.Symbol(plain_name(node), real=True)
            case Sum(terms):
                return sympy.Add(*map(self.convert, terms))
            case Product(factors):
                return sympy.Mul(*map(self.convert, factors))
            case Quotient(numerator, denominator):
                return self.convert(numerator) / self.convert(denominator)
            case Power(base, exponent):
                return self.convert(base) ** self.convert(exponent)
            case Negative(argument):
                return -self.convert(argument)
            case Parenthesized(argument):
                return self.convert(argument)
            case Function(name, argument):
                return _FUNCTIONS[name](self.convert(argument))
            case Matrix(rows):
                return sympy.ImmutableMatrix([[self.convert(entry) for entry in row] for row in rows])
        raise TypeError(f"{type(node).__name__} has no meaning in SymPy")
