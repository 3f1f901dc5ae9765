"""The solutions of the steps of inverse kinematics as formulas: θ₂ = ± arccos(…), θ₁ = atan2(y, x) - …

A step of two solutions has two formulas, in the order of `subproblems`' `values`.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from fractions import Fraction
from functools import singledispatchmethod
from math import lcm

from dynsolve.algebra.compact.compactor import Compactor
from dynsolve.algebra.expr import Expr
from dynsolve.algebra.fraction import RationalExpr, cancelled
from dynsolve.algebra.positivity import is_nonnegative
from dynsolve.derivation.inverse.equations import Squared
from dynsolve.derivation.inverse.subproblems import (
    Length,
    OneLine,
    Remainder,
    RootLength,
    Solved,
    TwoLines,
)
from dynsolve.notation.build import cost, negated, power, split_sign, times, total
from dynsolve.notation.tree import (
    Arguments,
    Function,
    Letter,
    Node,
    Quotient,
    Relation,
    Sum,
    Symbol,
    equation,
)

_PI = Symbol("pi")
_X = Letter("X")

LONG = 10
"""Right sides with more operations are written once, and called X."""


def atan2(y: Node, x: Node) -> Node:
    """The angle of the point (x, y), in all four quadrants."""
    return Function("atan2", Arguments((y, x)))


def _differ_by_sign(solutions: tuple[Node, ...]) -> bool:
    """Whether these are two that differ by one sign alone."""
    if len(solutions) != 2:
        return False
    first, second = solutions
    if second == negated(first):
        return True
    return (
        isinstance(first, Sum)
        and isinstance(second, Sum)
        and first.terms[:-1] == second.terms[:-1]
        and second.terms[-1] == negated(first.terms[-1])
    )


class InverseFormulas:
    """Formulas of solved unknowns; `compactor` is that of the ring of the search."""

    def __init__(self, compactor: Compactor, steps: Sequence[Solved] = ()) -> None:
        self._compact = compactor.form
        self._squares = [square for step in steps for square in self._sums_of_squares(step)]

    def form(self, expr: Expr) -> Node:
        """An expression; sums of squares that are told of stay sums of squares where that is shorter."""
        best = self._compact(expr)
        for value, node in self._squares:
            if len(expr) < len(value):
                continue
            for sign, signed in ((1, node), (-1, negated(node))):
                rest = expr - value * sign
                if len(rest) < len(expr):
                    parts = [signed] if rest.is_zero else [signed, self._compact(rest)]
                    best = min(best, total(parts), key=cost)
        return best

    _form = form

    def _sums_of_squares(self, step: Solved) -> Iterator[tuple[Expr, Node]]:
        """The left sides of the equations that are sums of squares."""
        for e in step.equations:
            if isinstance(e.origin, Squared):
                squares = [power(self._compact(p.left), 2) for p in e.origin.parts if not p.left.is_zero]
                if squares:
                    yield e.origin.left, total(squares)

    def results(self, unknown: Node, step: Solved) -> tuple[Node, ...]:
        """The solutions as equations; two that differ by a sign alone are one with ±.

        A long right side of A cos ψ + B sin ψ = X is called X in them.
        """
        if isinstance(step, OneLine) and self._is_long(step):
            meant = equation(_X, self._form(step.value))
            return (meant, *self._signed(unknown, self._of_line(step, _X)))
        return self._signed(unknown, self.solutions(step))

    def _is_long(self, step: OneLine) -> bool:
        """Whether a step has a right side that is too long to be written twice."""
        is_general = not (step.cosine.is_zero or step.sine.is_zero)
        return is_general and cost(self._form(step.value)) > LONG

    def _signed(self, unknown: Node, found: tuple[Node, ...]) -> tuple[Node, ...]:
        """Solutions as equations."""
        if not _differ_by_sign(found):
            return tuple(equation(unknown, value) for value in found)
        first, second = found
        if second == negated(first):
            return (Relation((unknown, first), ("= ±",)),)
        assert isinstance(first, Sum)
        middle = total(first.terms[:-1])
        return (Relation((unknown, middle, first.terms[-1]), ("=", "±")),)

    def has_signs(self, step: Solved) -> bool:
        """Whether the two solutions of a step differ by one sign alone."""
        return _differ_by_sign(self.solutions(step))

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
            return (self.direction(sine, cosine),)
        return (atan2(self.ratio(sine, below), self.ratio(cosine, below)),)

    def _turned(self, a: Expr, b: Expr, x: Expr, y: Expr) -> Node:
        """ψ from a cos ψ + b sin ψ = x and a sin ψ - b cos ψ = y: atan2(y, x) + atan2(b, a)."""
        if b.is_zero:
            return self._of_vector(x, y, a)
        if a.is_zero:
            return self._of_vector(-y, x, b)
        sign, sine = split_sign(self._form(b))
        own = atan2(sine, self._form(a))
        return total([self.direction(y, x), own if sign > 0 else negated(own)])

    def _of_vector(self, x: Expr, y: Expr, length: Expr) -> Node:
        """ψ from length·cos ψ = x, length·sin ψ = y."""
        if is_nonnegative(length):
            return self.direction(y, x)
        if is_nonnegative(-length):
            return self.direction(-y, -x)
        return atan2(self.ratio(y, length), self.ratio(x, length))

    def direction(self, y: Expr, x: Expr) -> Node:
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
            return self.direction(a, -b), self.direction(-a, b)
        if b.is_zero:
            first = Function("acos", self.ratio(x, a))
            return first, negated(first)
        if a.is_zero:
            first = Function("asin", self.ratio(x, b))
            return first, total([_PI, negated(first)])
        return self._of_line(step, self._form(x))

    def _of_line(self, step: OneLine, value: Node) -> tuple[Node, Node]:
        """Both angles of A cos ψ + B sin ψ = X, with X written as `value`."""
        a, b, x = step.cosine, step.sine, step.value
        square = a * a + b * b
        if len(x) == 1:
            height = self._form(square - x * x)
        else:
            height = total([self._form(square), negated(power(value, 2))])
        middle, either = self.direction(b, a), atan2(Function("sqrt", height), value)
        return total([middle, either]), total([middle, negated(either)])

    def boundary(self, step: OneLine) -> Node:
        """X² ≤ A² + B², where there are solutions."""
        x = step.value
        square = self._form(step.cosine * step.cosine + step.sine * step.sine)
        if len(x) == 1:
            return Relation((self._form(x * x), square), ("≤",))
        return Relation((power(_X if self._is_long(step) else self._form(x), 2), square), ("≤",))

    @_solutions.register
    def _length(self, step: Length) -> tuple[Node, ...]:
        return (self.ratio(step.value, step.factor),)

    @_solutions.register
    def _root_length(self, step: RootLength) -> tuple[Node, ...]:
        root = Function("sqrt", self.radicand(step))
        if step.linear.is_zero:
            return root, negated(root)
        below = step.square if _is_even(step.linear) else step.square * 2
        middle = self.ratio(-step.linear, step.square * 2)
        either = times(1, [(root, 1), (self._form(below), -1)])
        return total([middle, either]), total([middle, negated(either)])

    def radicand(self, step: RootLength) -> Node:
        """What stands under the root: -C/A, B² - 4 A C, or (B/2)² - A C where that has no fractions."""
        if step.linear.is_zero:
            return self.ratio(-step.constant, step.square)
        discriminant = step.linear * step.linear - step.square * step.constant * 4
        return self._form(discriminant * Fraction(1, 4) if _is_even(step.linear) else discriminant)

    @_solutions.register
    def _remainder(self, step: Remainder) -> tuple[Node, ...]:
        given, others = (
            [times(rate, [(Symbol(name), 1)]) for name, rate in terms] for terms in (step.given, step.others)
        )
        taken = [*others, *([] if step.rest.is_zero else [self._form(step.rest)])]
        terms = [*taken, *map(negated, given)] if step.rate < 0 else [*given, *map(negated, taken)]
        size = abs(step.rate)
        return (total(terms) if size == 1 else times(1 / size, [(total(terms), 1)]),)

    def ratio(self, above: Expr, below: Expr) -> Node:
        """above / below, cancelled; the sign in front."""
        value = cancelled(RationalExpr(above, below))
        if value.divisor is None:
            return self._form(value.numerator)
        whole = lcm(*(int(factor.q) for e in (value.numerator, value.divisor) for factor in e.poly.coeffs()))
        numerator, divisor = value.numerator * whole, value.divisor * whole
        if is_nonnegative(-divisor):
            numerator, divisor = -numerator, -divisor
        return Quotient(self._form(numerator), self._form(divisor))


def _is_even(expr: Expr) -> bool:
    """Whether all numbers in front of terms are even."""
    return all(int(factor.q) == 1 and int(factor.p) % 2 == 0 for factor in expr.poly.coeffs())
