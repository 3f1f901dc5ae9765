"""Inequalities between values of a robot as formulas, without the sets of configurations they may bound."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from functools import lru_cache
from typing import Any

from dynsolve.algebra.compact.compactor import Compactor
from dynsolve.algebra.factors import is_positive, ratio, trig_factors, trig_quotient
from dynsolve.algebra.inequality import Bound
from dynsolve.algebra.linear_systems import content, decimal_content
from dynsolve.algebra.ring import Expr, Ring
from dynsolve.explain.forms import ProductForms, leading_names, parallel_coordinates
from dynsolve.notation.build import cost
from dynsolve.notation.tree import ZERO, Node, Relation
from dynsolve.robot.model import Robot

_TURNED = {">": "<", "≥": "≤", "<": ">", "≤": "≥"}

_compactor = lru_cache(maxsize=8)(Compactor)  # what is checked, explained and exported has the same forms


class Inequalities:
    """The inequalities of one robot, in its ring or one of a search."""

    def __init__(self, robot: Robot) -> None:
        self.robot = robot

    def inequality(self, bound: Bound) -> Relation:
        """l W² > g, with either side positive."""
        return self.comparison(bound.value, ">" if bound.is_strict else "≥")

    def comparison(self, value: Expr, sign: str) -> Relation:
        """A value compared with 0: what is positive of it on one side, what is negative on the other.

        A positive factor that both sides share is left out, but not of matrices to be judged, whose
        parameters may be negative; and so is a number.
        """
        ring = value.ring
        has_both = len({factor < 0 for factor in value.poly.coeffs()}) == 2
        if has_both and not self.robot.questions.candidates:
            for shared, exponent in trig_factors(value):
                if is_positive(shared):
                    value = trig_quotient(value, shared**exponent) or value
        value = value / self.content([value])
        left, right = self._apart(value)
        products = ProductForms(self.compactor(ring))
        squares = [products.form(one * one) for one in _squared(value)]
        product, opposite = map(products.form, (value, -value))
        if squares and sum(map(cost, squares)) < cost(left) + cost(right):
            left, right = squares
        elif min(cost(product), cost(opposite)) < cost(left) + cost(right):
            left, right = product, ZERO
            if cost(opposite) < cost(product):
                left, sign = opposite, _TURNED.get(sign, sign)
        elif left == ZERO:
            left, right, sign = right, left, _TURNED.get(sign, sign)
        return Relation((left, right), (sign,))

    def content(self, values: Sequence[Expr]) -> Fraction:
        """What is divided out: it leaves whole coefficients, or such as a model in numbers has."""
        robot = self.robot
        return decimal_content(values, robot.decimals) if robot.has_decimals else content(values)

    def _apart(self, value: Expr) -> list[Node]:
        """What is positive of a value, and what is negative, as formulas."""
        sides: tuple[dict[Any, Any], dict[Any, Any]] = {}, {}
        for exponents, factor in value.poly.to_dict().items():
            sides[factor < 0][exponents] = abs(factor)
        ring, form = value.ring, self.compactor(value.ring).form
        return [form(Expr(ring, ring.ctx.from_dict(side))) for side in sides]

    def compactor(self, ring: Ring) -> Compactor:
        """The compactor of a ring of the search: the values of the task lead its sums, then masses."""
        named = (*self.robot.questions.reached, *ring.plan.signed, *leading_names(self.robot))
        leading = [name for name in dict.fromkeys(named) if ring.has_symbol(name)]
        parallel = tuple(parallel_coordinates(self.robot))
        robot = self.robot
        return _compactor(ring, tuple(leading), parallel, decimal=robot.has_decimals, typed=robot.decimals)


def _squared(value: Expr) -> list[Expr]:
    """a and b where a value is a² - b² times a number, the product of a + b and a - b."""
    factors = trig_factors(value)
    if len(factors) != 2 or any(exponent != 1 for _, exponent in factors):
        return []
    (one, _), (other, _) = factors
    sign = ratio(value, one * other)
    if sign not in (value.ring.one, -value.ring.one):
        return []
    found = [one + other, one - other]
    if sum(map(len, found)) > max(len(one), len(other)):  # nothing in common
        return []
    shared = content(found)
    return [part / shared for part in (found if sign == value.ring.one else found[::-1])]
