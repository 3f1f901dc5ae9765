"""Trees -> SymPy, node by node; no text is ever parsed."""

from __future__ import annotations

from typing import Any

import sympy

from dynsolve.notation.latex import to_latex
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


class Rate(sympy.Symbol):  # type: ignore[misc]
    r"""A velocity or an acceleration: the symbol `q1_dot`, which LaTeX shows as \dot{q}_1.

    >>> rate = Rate("q1_dot", real=True)
    >>> sympy.latex(2 * rate)
    '2 \\dot{q}_{1}'
    >>> rate == sympy.Symbol("q1_dot", real=True)
    True
    """

    __slots__ = ()

    @classmethod
    def class_key(cls) -> Any:
        """That of a symbol, so that expressions are sorted as if it were one."""
        return sympy.Symbol.class_key()

    def _latex(self, printer: Any) -> str:
        name, _, dots = self.name.rpartition("_")
        return to_latex(Symbol(name, len(dots) - len("ot")))

    def __eq__(self, other: object) -> bool:
        return isinstance(other, sympy.Symbol) and self._hashable_content() == other._hashable_content()

    def __hash__(self) -> int:
        return hash(sympy.Symbol(self.name, real=True))


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
            case Symbol(dots=dots) if dots:
                return Rate(plain_name(node), real=True)
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
