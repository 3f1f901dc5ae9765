"""Terms in words: exact expressions as one line of Unicode, for messages."""

from __future__ import annotations

from fractions import Fraction

from dynsolve.algebra.build import power
from dynsolve.algebra.compact import Compactor
from dynsolve.algebra.expr import Expr, Generator
from dynsolve.algebra.ring import Ring
from dynsolve.answers.field import is_opaque
from dynsolve.explain.forms import leading_names
from dynsolve.explain.style import style_of
from dynsolve.notation.tree import Node, Symbol, number
from dynsolve.notation.unicode import UnicodePrinter
from dynsolve.robot.model import Robot

LONGEST = 160


class Words:
    """Writes expressions of one field as a person reads them."""

    def __init__(self, ring: Ring, robot: Robot) -> None:
        self.ring = ring
        self._problem: set[str] = set()
        self.compactor = Compactor(ring, leading_names(robot))
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

    def generator(self, g: Generator) -> str:
        """A symbol."""
        return self.power(g, 1)

    def power(self, g: Generator, exponent: int) -> str:
        """A symbol's power."""
        if g.kind == "symbol" and is_opaque(g.name):
            return "a function of an argument that cannot be one"
        node = Symbol(g.name, g.dots) if g.kind == "symbol" else self.form(self.ring.generator(g.index))
        return self._printer.text(power(node, exponent))

    def is_unknown(self, g: Generator) -> bool:
        """Whether a symbol is none of the problem's."""
        return g.kind == "symbol" and bool(self._problem) and g.name not in self._problem
