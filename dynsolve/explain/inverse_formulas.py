"""The solutions of the steps of inverse kinematics as formulas: θ₂ = ± arccos(…), θ₁ = atan2(y, x) - …

A step of two solutions has two formulas, in the order of `subproblems`' `values`.
"""

from __future__ import annotations

from functools import singledispatchmethod
from math import lcm

from dynsolve.algebra.compact.compactor import Compactor
from dynsolve.algebra.expr import Expr
from dynsolve.algebra.fraction import RationalExpr, simplified
from dynsolve.algebra.positivity import is_nonnegative
from dynsolve.derivation.inverse.subproblems import (
    Length,
    OneLine,
    Remainder,
    RootLength,
    Solved,
    TwoLines,
)
from dynsolve.notation.build import negated, split_sign, times, total
from dynsolve.notation.tree import Arguments, Function, Node, Quotient, Symbol, number

_PI = Symbol("pi")


def atan2(y: Node, x: Node) -> Node:
    """The angle of the point (x, y), in all four quadrants."""
    return Function("atan2", Arguments((y, x)))


class InverseFormulas:
    """Formulas of solved unknowns; `compactor` is that of the ring of the search."""

    def __init__(self, compactor: Compactor) -> None:
        self._form = compactor.form

    def solutions(self, step: Solved) -> tuple[Node, ...]:
        """The solutions of a step."""
        return self._solutions(step)

    @singledispatchmethod
    def _solutions(self, step: Solved) -> tuple[Node, ...]:
        raise TypeError(type(step).__name__)

    @_solutions.register
    def _two_lines(self, step: TwoLines) -> tuple[Node, ...]:
        a, b, x = step.first
        c, d, y = step.second
        if d == a and c == -b:  # a c + b s = x, a s - b c = y: the vector (a, b) is turned to (x, y)
            return (self._turned(a, b, x, y),)
        if d == -a and c == b:
            return (self._turned(a, b, x, -y),)
        sine, cosine, below = a * y - c * x, d * x - b * y, step.determinant
        if is_nonnegative(-below):
            sine, cosine, below = -sine, -cosine, -below
        if is_nonnegative(below):
            return (self._direction(sine, cosine),)
        return (atan2(self.ratio(sine, below), self.ratio(cosine, below)),)

    def _turned(self, a: Expr, b: Expr, x: Expr, y: Expr) -> Node:
        """ψ from a cos ψ + b sin ψ = x and a sin ψ - b cos ψ = y: atan2(y, x) + atan2(b, a)."""
        if b.is_zero:
            return self._of_vector(x, y, a)
        if a.is_zero:
            return self._of_vector(-y, x, b)
        sign, sine = split_sign(self._form(b))
        own = atan2(sine, self._form(a))
        return total([self._direction(y, x), own if sign > 0 else negated(own)])

    def _of_vector(self, x: Expr, y: Expr, length: Expr) -> Node:
        """ψ from length·cos ψ = x, length·sin ψ = y."""
        if is_nonnegative(length):
            return self._direction(y, x)
        if is_nonnegative(-length):
            return self._direction(-y, -x)
        return atan2(self.ratio(y, length), self.ratio(x, length))

    def _direction(self, y: Expr, x: Expr) -> Node:
        """atan2(y, x) without a positive factor that both share."""
        shared = y.poly.gcd(x.poly) if not (y.is_zero or x.is_zero) else None
        if shared is not None and not shared.is_constant():
            factor = Expr(y.ring, shared)
            if is_nonnegative(-factor):
                factor = -factor
            if is_nonnegative(factor):
                y, x = (Expr(y.ring, divmod(e.poly, factor.poly)[0]) for e in (y, x))
        return atan2(self._form(y), self._form(x))

    @_solutions.register
    def _one_line(self, step: OneLine) -> tuple[Node, ...]:
        a, b, x = step.cosine, step.sine, step.value
        if x.is_zero:
            return self._direction(a, -b), self._direction(-a, b)
        if b.is_zero:
            first = Function("acos", self.ratio(x, a))
            return first, negated(first)
        if a.is_zero:
            first = Function("asin", self.ratio(x, b))
            return first, total([_PI, negated(first)])
        middle = self._direction(b, a)
        root = Function("sqrt", self.half_chord(step))
        either = atan2(root, self._form(x))
        return total([middle, either]), total([middle, negated(either)])

    def half_chord(self, step: OneLine) -> Node:
        """A² + B² - X², what is not negative within reach."""
        return self._form(step.cosine * step.cosine + step.sine * step.sine - step.value * step.value)

    @_solutions.register
    def _length(self, step: Length) -> tuple[Node, ...]:
        return (self.ratio(step.value, step.factor),)

    @_solutions.register
    def _root_length(self, step: RootLength) -> tuple[Node, ...]:
        root = Function("sqrt", self.radicand(step))
        if step.linear.is_zero:
            return root, negated(root)
        below = step.square * 2
        middle, either = self.ratio(-step.linear, below), Quotient(root, self._form(below))
        return total([middle, either]), total([middle, negated(either)])

    def radicand(self, step: RootLength) -> Node:
        """What stands under the root: -C/A, or B² - 4 A C."""
        if step.linear.is_zero:
            return self.ratio(-step.constant, step.square)
        return self._form(step.linear * step.linear - step.square * step.constant * 4)

    @_solutions.register
    def _remainder(self, step: Remainder) -> tuple[Node, ...]:
        others = [negated(times(rate, [(Symbol(name), 1)])) for name, rate in step.others]
        rest = [] if step.rest.is_zero else [negated(self._form(step.rest))]
        value = total([Symbol(step.value), *others, *rest])
        if step.rate == 1:
            return (value,)
        if step.rate == -1:
            return (negated(value),)
        return (Quotient(value, number(step.rate)),)

    def ratio(self, above: Expr, below: Expr) -> Node:
        """above / below, cancelled; the sign in front."""
        value = simplified(RationalExpr(above, below))
        if value.divisor is None:
            return self._form(value.numerator)
        whole = lcm(*(int(factor.q) for e in (value.numerator, value.divisor) for factor in e.poly.coeffs()))
        numerator, divisor = value.numerator * whole, value.divisor * whole
        if is_nonnegative(-divisor):
            numerator, divisor = -numerator, -divisor
        return Quotient(self._form(numerator), self._form(divisor))
