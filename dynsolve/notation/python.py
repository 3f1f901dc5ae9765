"""Trees -> text that Python evaluates once `sin`, `cos`, `sqrt` and the symbols have values."""

from __future__ import annotations

from keyword import iskeyword
from math import radians

from dynsolve.notation.printing import Printer, Style, decimal_text, is_whole
from dynsolve.notation.tree import (
    Arguments,
    Degrees,
    Function,
    Matrix,
    Node,
    Number,
    Parenthesized,
    Power,
    Product,
    Quotient,
    Sum,
    Symbol,
)

_DOTS = ("", "_dot", "_ddot", "_dddot")
_BARE_BASES = frozenset({Symbol, Function, Parenthesized})
_BARE_DENOMINATORS = _BARE_BASES | {Power}


def to_python(node: Node, *, decimal: bool = False) -> str:
    """The tree as plain text: `m1*L1**2*cos(theta1 + theta2)`.

    Velocities are `theta1_dot`, accelerations `theta1_ddot`; a name that Python
    reserves ends in an underscore.  With `decimal`, 981/100 is `9.81` where that
    is exact.

    >>> to_python(Product((Number(1, 2), Symbol("m1"), Power(Symbol("theta1", 1), Number(2)))))
    '1/2*m1*theta1_dot**2'
    """
    return PythonPrinter(Style(decimal=decimal)).text(node)


def python_name(name: str, dots: int = 0) -> str:
    """The identifier of a symbol or of its time derivative: `theta1_dot`, `lambda_`."""
    name += _DOTS[dots]
    return name + "_" if iskeyword(name) else name


class PythonPrinter(Printer):
    """Plain text for Python, and for the reader of `notation.text`."""

    notation = "Python"

    def _number(self, node: Number) -> str:
        if node.q == 1:
            return str(node.p)
        decimal = decimal_text(node.p, node.q) if self.style.decimal or node.decimal else None
        return decimal or f"{node.p}/{node.q}"

    def _degrees(self, node: Degrees) -> str:
        # Radians as a float: who evaluates the text needs no name beyond sin, cos, sqrt and the symbols.
        return repr(radians(node.p / node.q))

    def _symbol(self, node: Symbol) -> str:
        return python_name(node.name, node.dots)

    def _product(self, node: Product) -> str:
        if not node.factors:
            return "1"
        pieces: list[str] = []
        for factor in node.factors:
            text = self.text(factor)
            if type(factor) is Sum or (pieces and text.startswith("-")):
                text = f"({text})"
            pieces.append(text)
        return "*".join(pieces)

    def _quotient(self, node: Quotient) -> str:
        numerator = self.text(node.numerator)
        if type(node.numerator) is Sum:
            numerator = f"({numerator})"
        denominator = self.text(node.denominator)
        if type(node.denominator) not in _BARE_DENOMINATORS and not is_whole(node.denominator):
            denominator = f"({denominator})"
        return f"{numerator}/{denominator}"

    def _power(self, node: Power) -> str:
        base, exponent = self.text(node.base), self.text(node.exponent)
        if type(node.base) not in _BARE_BASES and not is_whole(node.base):
            base = f"({base})"
        if not is_whole(node.exponent):
            exponent = f"({exponent})"
        return f"{base}**{exponent}"

    def _function(self, node: Function) -> str:
        return f"{node.name}({self.text(node.argument)})"

    def _arguments(self, node: Arguments) -> str:
        return ", ".join(map(self.text, node.parts))

    def _matrix(self, node: Matrix) -> str:
        rows = (f"[{', '.join(map(self.text, row))}]" for row in node.rows)
        return f"[{', '.join(rows)}]"
