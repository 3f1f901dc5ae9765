"""Terms in words: exact expressions as one line of Unicode, for messages."""

from __future__ import annotations

from fractions import Fraction
from math import prod

from dynsolve.algebra.compact.compactor import Compactor
from dynsolve.algebra.expr import Expr
from dynsolve.algebra.generators import Generator
from dynsolve.answers.judging.answer_ring import AnswerRing
from dynsolve.explain.context import style_of
from dynsolve.explain.forms import leading_names, parallel_coordinates
from dynsolve.notation.build import power
from dynsolve.notation.tree import Function, Negative, Node, Number, Product, Quotient, Symbol, number
from dynsolve.notation.unicode import UnicodePrinter

LONGEST = 160


class TermWriter:
    """Writes expressions of one ring as a person reads them."""

    def __init__(self, answer_ring: AnswerRing) -> None:
        ring, robot = answer_ring.ring, answer_ring.robot
        self.ring = ring
        self._problem: set[str] = set()
        self.compactor = Compactor(ring, leading_names(robot), parallel_coordinates(robot))
        self._printer = UnicodePrinter(style_of(robot))

    def problem_symbols(self, names: set[str]) -> None:
        """Say which symbols the problem has."""
        self._problem = names

    def form(self, expr: Expr) -> Node:
        """The compact tree."""
        return self.compactor.form(expr)

    def of(self, expr: Expr) -> str:
        """An expression in one line."""
        text = self._printer.text(self.form(expr))
        return text if len(text) <= LONGEST else text[: LONGEST - 1] + "…"

    def number(self, value: Fraction) -> str:
        """A number."""
        return self._printer.text(number(value))

    def coefficient(self, expr: Expr) -> Fraction:
        """The number before an expression as a person writes it."""
        return _coefficient(self.form(expr)) or Fraction(1)

    def generator(self, g: Generator) -> str:
        """A symbol."""
        return self.power(g, 1)

    def power(self, g: Generator, exponent: int) -> str:
        """A symbol's power."""
        node = Symbol(g.name, g.dots) if g.kind == "symbol" else self.form(self.ring.generator(g.index))
        return self._printer.text(power(node, exponent))

    def is_unknown(self, g: Generator) -> bool:
        """Whether a symbol, or a sine or cosine of an unexpected argument, is none of the problem's."""
        is_odd = isinstance(g.node, Function) and g.node.name in ("sin", "cos", "tan")
        is_known = g.name in self._problem if g.kind == "symbol" else not (g.kind == "function" and is_odd)
        return bool(self._problem) and not is_known


def _coefficient(node: Node) -> Fraction:
    """The number before a product."""
    match node:
        case Number(p, q):
            return Fraction(p, q)
        case Negative(argument):
            return -_coefficient(argument)
        case Product(factors):
            return prod((_coefficient(factor) for factor in factors), start=Fraction(1))
        case Quotient(numerator, denominator):
            return _coefficient(numerator) / (_coefficient(denominator) or 1)
    return Fraction(1)
