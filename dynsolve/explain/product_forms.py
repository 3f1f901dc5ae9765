"""Compact forms of products and quotients: a determinant in its factors, fractions."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction

from dynsolve.algebra.compact.compactor import Compactor
from dynsolve.algebra.expr import Expr
from dynsolve.algebra.fraction import RationalExpr, with_integers
from dynsolve.algebra.rationals import fraction
from dynsolve.algebra.transfer import Transfer
from dynsolve.algebra.trig_factor import trig_factors
from dynsolve.derivation.inverse.unknowns import search_ring
from dynsolve.errors import AlgebraError
from dynsolve.notation.build import cost, times
from dynsolve.notation.tree import Node

Factors = Sequence[tuple[Node, int]]

LONG = 150
"""Expressions of more terms are not taken apart: over roots that takes minutes."""


class ProductForms:
    """Writes expressions of one ring as products, where that is shorter than as sums."""

    def __init__(self, compactor: Compactor) -> None:
        self.compactor = compactor
        self.ring = compactor.ring

    def form(self, expr: Expr) -> Node:
        """The shorter of the product of an expression's factors and its compact form."""
        coefficient, factors = self._factors(expr)
        return times(coefficient, factors)

    def fraction(self, value: RationalExpr) -> Node:
        """A fraction, numerator and denominator as products."""
        value = with_integers(value)
        above, over = self._factors(value.numerator)
        if value.divisor is None:
            return times(above, over)
        below, under = self._factors(value.divisor)
        return times(above / below, [*over, *((node, -power) for node, power in under)])

    def _factors(self, expr: Expr) -> tuple[Fraction, Factors]:
        """(number, factors with their exponents) that make the shortest form."""
        plain = self.compactor.form(expr)
        found = None if expr.is_number or len(expr) > LONG else self._product(expr)
        if found is None or cost(times(*found)) >= cost(plain):
            return Fraction(1), [(plain, 1)]
        return found

    def _product(self, expr: Expr) -> tuple[Fraction, Factors] | None:
        """An expression taken apart; None where its factors have no form in this ring."""
        relative = search_ring(self.ring, (), {})
        there, back = Transfer(self.ring, relative), Transfer(relative, self.ring)
        try:
            factors = [(back(factor), power) for factor, power in trig_factors(there(expr))]
        except AlgebraError:
            return None
        product = self.ring.one
        for factor, power in factors:
            product = product * factor**power
        coefficient = fraction(expr.poly.leading_coefficient() / product.poly.leading_coefficient())
        if product * coefficient != expr:
            return None
        factors.sort(key=lambda found: (self.ring.depends_on_coordinates(found[0]), len(found[0])))
        return coefficient, [(self.compactor.form(factor), power) for factor, power in factors]
