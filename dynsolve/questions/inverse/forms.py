"""The solutions of the steps of inverse kinematics as formulas: θ₂ = ± arccos(…), θ₁ = atan2(y, x) - …

A step of two solutions has two formulas, in the order of `subproblems`' `values`.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from fractions import Fraction
from functools import cached_property
from math import gcd, lcm
from typing import TYPE_CHECKING

from dynsolve.algebra.compact.compactor import Compactor
from dynsolve.algebra.factors import is_nonnegative
from dynsolve.algebra.fraction import RationalExpr, cancelled
from dynsolve.algebra.linear_systems import content
from dynsolve.algebra.matrix import Matrix as Values
from dynsolve.algebra.ring import Expr
from dynsolve.algebra.ring_plan import square_free_primes
from dynsolve.derivation.configurations import Condition as Equality
from dynsolve.derivation.configurations import Conditions
from dynsolve.derivation.graph import Skipped
from dynsolve.explain.forms import Forms
from dynsolve.notation.build import cost, negated, power, split_sign, times, total
from dynsolve.notation.tree import (
    ZERO,
    Arguments,
    Function,
    Letter,
    Matrix,
    Node,
    Number,
    Quotient,
    Relation,
    Sum,
    Symbol,
    equation,
    with_formulas,
)
from dynsolve.questions.inverse.derive import Inverse, without_number
from dynsolve.questions.inverse.equations import Squared
from dynsolve.questions.inverse.solving import Relation as Condition
from dynsolve.questions.inverse.subproblems import (
    Length,
    OneLine,
    Remainder,
    RootLength,
    Solved,
    TwoLines,
)
from dynsolve.questions.set_forms import SetForms

if TYPE_CHECKING:
    from dynsolve.questions.inverse.target import TargetForms

_X = Letter("X")

LONG = 10
"""Right sides with more operations are written once, and called X."""


def atan2(y: Node, x: Node) -> Node:
    """The angle of the point (x, y), in all four quadrants."""
    return Function("atan2", Arguments((y, x)))


def _both(middle: Node, either: Node) -> tuple[Node, Node]:
    """middle ± either"""
    return total([middle, either]), total([middle, negated(either)])


def _signed(solutions: tuple[Node, ...]) -> tuple[tuple[Node, ...], Node] | None:
    """The terms that two solutions share, and what has both signs; None where more differs."""
    match solutions:
        case (first, second) if second == negated(first):
            return (), first
        case (Sum(first), Sum(second)):
            middle = tuple(term for term in first if term in second)
            either, other = (total([t for t in terms if t not in middle]) for terms in (first, second))
            if other == negated(either):
                return middle, either
    return None


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

    def matrix(self, values: Values) -> Matrix:
        """A matrix of such expressions."""
        return Matrix(tuple(tuple(map(self.form, row)) for row in values.rows))

    def _sums_of_squares(self, step: Solved) -> Iterator[tuple[Expr, Node]]:
        """The left sides of the equations that are sums of squares, and those of a vector that is turned."""
        if isinstance(step, TwoLines) and step.is_rotation:
            lefts = [e.left for e in step.equations if not e.left.is_zero]
            yield (
                sum((e * e for e in lefts), start=step.determinant.ring.zero),
                total([power(self._compact(e), 2) for e in lefts]),
            )
        for e in step.equations:
            if isinstance(e.origin, Squared):
                squares = [power(self._compact(p.left), 2) for p in e.origin.parts if not p.left.is_zero]
                if squares:
                    yield e.origin.left, total(squares)

    def results(self, unknown: Node, step: Solved) -> tuple[Node, ...]:
        """The solutions as equations; two that differ by a sign alone are one with ±.

        A long right side of A cos ψ + B sin ψ = X is called X in them.
        """
        meant: tuple[Node, ...] = ()
        found = self.solutions(step)
        if isinstance(step, OneLine) and self._is_long(step):
            meant, found = (equation(_X, self.form(step.value)),), self._of_line(step, _X)
        signed = _signed(found)
        if signed is None:
            return (*meant, *(equation(unknown, value) for value in found))
        middle, either = signed
        if not middle:
            return (*meant, Relation((unknown, either), ("= ±",)))
        return (*meant, Relation((unknown, total(middle), either), ("=", "±")))

    def _is_long(self, step: OneLine) -> bool:
        """Whether a step has a right side that is too long to be written twice."""
        is_general = not (step.cosine.is_zero or step.sine.is_zero)
        return is_general and cost(self.form(step.value)) > LONG

    def has_signs(self, step: Solved) -> bool:
        """Whether the two solutions of a step differ by one sign alone."""
        return _signed(self.solutions(step)) is not None

    def solutions(self, step: Solved) -> tuple[Node, ...]:
        """The solutions of a step."""
        match step:
            case TwoLines():
                return (self._of_two_lines(step),)
            case OneLine(_, a, b, x) if x.is_zero:
                return self.direction(a, -b), self.direction(-a, b)
            case OneLine(_, a, b, x) if b.is_zero:
                return _both(ZERO, Function("acos", self.ratio(x, a)))
            case OneLine(_, a, b, x) if a.is_zero:
                signed = ((sign, self.ratio(x * sign, b)) for sign in (1, -1))
                sign, ratio = min(signed, key=lambda both: cost(both[1]))  # -arcsin(u/c), not arcsin(-u/c)
                first = times(sign, [(Function("asin", ratio), 1)])
                return first, total([Symbol("pi"), negated(first)])
            case OneLine(_, a, b, x):
                return self._of_line(step, self.form(x))
            case Length():
                return (self.ratio(step.value, step.factor),)
            case RootLength():
                return self._of_square(step)
            case Remainder():
                return (self._of_sum(step),)

    def _of_two_lines(self, step: TwoLines) -> Node:
        """ψ from a cos ψ + b sin ψ = x and c cos ψ + d sin ψ = y.

        Where the vector (a, b) is turned to (x, y) it is atan2(y, x) + atan2(b, a).
        """
        (a, b, x), (c, d, y) = step.first, step.second
        if not step.is_rotation:
            return self._of_vector(d * x - b * y, a * y - c * x, step.determinant)
        if not (d == a and c == -b):
            y = -y
        if b.is_zero:
            return self._of_vector(x, y, a)
        if a.is_zero:
            return self._of_vector(-y, x, b)
        sign, _ = split_sign(self.form(b))
        own = self.direction(b if sign > 0 else -b, a)
        return total([self.direction(y, x), own if sign > 0 else negated(own)])

    def _of_vector(self, x: Expr, y: Expr, length: Expr) -> Node:
        """ψ from length·cos ψ = x, length·sin ψ = y."""
        if is_nonnegative(length):
            return self.direction(y, x)
        if is_nonnegative(-length):
            return self.direction(-y, -x)
        return atan2(self.ratio(y, length), self.ratio(x, length))

    def direction(self, y: Expr, x: Expr) -> Node:
        """atan2(y, x) without a positive factor that both share; atan2(sin ψ, cos ψ) is ψ."""
        ways = _without_shared(y, x)
        forms = ([self.form(e) for e in both] for both in (ways, _in_whole_numbers(*ways)))
        sine, cosine = min(forms, key=lambda both: sum(map(cost, both)))
        match split_sign(sine), cosine:
            case (sign, Function("sin", angle)), Function("cos", same) if angle == same:
                return angle if sign > 0 else negated(angle)
        return atan2(sine, cosine)

    def _of_line(self, step: OneLine, value: Node) -> tuple[Node, Node]:
        """Both angles of A cos ψ + B sin ψ = X, with X written as `value`."""
        a, b, x = step.cosine, step.sine, step.value
        square = a * a + b * b
        if len(x) == 1:
            height = self.form(square - x * x)
        else:
            height = total([self.form(square), negated(power(value, 2))])
        return _both(self.direction(b, a), atan2(Function("sqrt", height), value))

    def boundary(self, step: OneLine) -> Node:
        """X² ≤ A² + B², where there are solutions."""
        x = step.value
        square = self.form(step.cosine * step.cosine + step.sine * step.sine)
        if len(x) == 1:
            return Relation((self.form(x * x), square), ("≤",))
        return Relation((power(_X if self._is_long(step) else self.form(x), 2), square), ("≤",))

    def _of_square(self, step: RootLength) -> tuple[Node, Node]:
        """Both lengths of A d² + B d + C = 0."""
        root = Function("sqrt", self.radicand(step))
        if step.linear.is_zero:
            return _both(ZERO, root)
        below = step.square * Fraction(2, _root_of_content(step.discriminant))
        return _both(self.ratio(-step.linear, step.square * 2), times(1, [(root, 1), (self.form(below), -1)]))

    def radicand(self, step: RootLength) -> Node:
        """What stands under the root: -C/A, or B² - 4 A C without the square of a number."""
        if step.linear.is_zero:
            return self.ratio(-step.constant, step.square)
        return self.form(step.discriminant / _root_of_content(step.discriminant) ** 2)

    def sum_of(self, step: Remainder) -> Node:
        """The sum of angles that the task gives: q₂ + q₃ = r₃."""
        angles = sorted(((step.coordinate, step.rate), *step.others), key=lambda one: (len(one[0]), one[0]))
        turning, given = (
            [times(rate, [(Symbol(name), 1)]) for name, rate in one] for one in (angles, step.given)
        )
        constant = [] if step.rest.is_zero else [self.form(step.rest)]
        return equation(total([*turning, *constant]), total(given))

    def _of_sum(self, step: Remainder) -> Node:
        """The angle that is left of a given sum of angles."""
        given, taken = (
            [times(rate, [(Symbol(name), 1)]) for name, rate in terms] for terms in (step.given, step.others)
        )
        if not step.rest.is_zero:
            taken.append(self.form(step.rest))
        terms = [*taken, *map(negated, given)] if step.rate < 0 else [*given, *map(negated, taken)]
        size = abs(step.rate)
        return total(terms) if size == 1 else times(1 / size, [(total(terms), 1)])

    def ratio(self, above: Expr, below: Expr) -> Node:
        """above / below, cancelled; the sign in front."""
        value = cancelled(RationalExpr(above, below))
        if value.divisor is None:
            plain, number = self.form(value.numerator), content([value.numerator])
            over = Quotient(self.form(value.numerator * number.denominator), Number(number.denominator))
            return plain if number.denominator == 1 else min(plain, over, key=cost)
        whole = lcm(*(int(factor.q) for e in (value.numerator, value.divisor) for factor in e.poly.coeffs()))
        if is_nonnegative(-value.divisor):
            whole = -whole
        return Quotient(self.form(value.numerator * whole), self.form(value.divisor * whole))


def _signed_sides(one: Condition) -> tuple[Expr, Expr]:
    """The sides of an equation; where one is 0 the other with as few minus signs as it may have."""
    left, right = one.left, one.right
    is_negative = right.is_zero and 2 * sum(factor < 0 for factor in left.poly.coeffs()) > len(left)
    return (-left, right) if is_negative else (left, right)


def _without_shared(a: Expr, b: Expr) -> tuple[Expr, Expr]:
    """Two expressions without a positive factor that both have."""
    if a.is_zero or b.is_zero:
        return a, b
    factor = Expr(a.ring, a.poly.gcd(b.poly))
    if is_nonnegative(-factor):
        factor = -factor
    if is_nonnegative(factor):
        a, b = (Expr(a.ring, divmod(e.poly, factor.poly)[0]) for e in (a, b))
    return a, b


def _without_same(a: Expr, b: Expr) -> tuple[Expr, Expr]:
    """The sides of an equation without a positive factor, and without terms, that both have.

    Where nothing is left of the right side, what is negative goes there.
    """
    a, b = _without_shared(a, b)
    theirs = b.poly.to_dict()
    same = {key: number for key, number in a.poly.to_dict().items() if theirs.get(key) == number}
    if not same:
        return a, b
    both = Expr(a.ring, a.ring.ctx.from_dict(same))
    a, b = a - both, b - both
    if b.is_zero:
        negative = {key: -number for key, number in a.poly.to_dict().items() if number < 0}
        b = Expr(a.ring, a.ring.ctx.from_dict(negative))
        a = a + b
    return a, b


def _in_whole_numbers(a: Expr, b: Expr) -> tuple[Expr, Expr]:
    """The same without a number that both have, and without fractions in front of terms."""
    numbers = [number for e in (a, b) for number in e.poly.coeffs()]
    whole = Fraction(lcm(*(int(n.q) for n in numbers)))
    shared = gcd(*(int((n * int(whole)).p) for n in numbers)) or 1
    return a * (whole / shared), b * (whole / shared)


def _root_of_content(expr: Expr) -> int:
    """The greatest number whose square is in all numbers in front of terms."""
    return square_free_primes(content([expr]).numerator)[0]


class InverseForms(SetForms):
    """The formulas of the branches of one robot."""

    @cached_property
    def solved(self) -> Inverse | None:
        """The solution of the task; None where no closed form was found."""
        found = self.values["inverse"]
        return found if isinstance(found, Inverse) else None

    @property
    def without_number(self) -> str:
        """The first parameter that has no number, where `reach` has them; nothing where all have."""
        return without_number(self.robot, self.values[self.task])

    @property
    def task(self) -> str:
        """The name of what is to be reached: the task or the pose."""
        (task,) = self.values.rules["inverse"].inputs
        return task

    @cached_property
    def target(self) -> TargetForms | None:
        """What reaches the numbers of `reach`; None where it has none."""
        is_given = self.robot.questions.target is not None
        if not is_given or isinstance(self.values["inverse"], Skipped) or self.without_number:
            return None
        from dynsolve.questions.inverse.target import TargetForms

        branches = None if self.solved is None else list(zip(self.inverse, self.when, strict=True))
        task, form = self.values[self.task], Forms(self.robot, self.values)(self.task)
        return TargetForms(self.robot, task, form, branches)

    @cached_property
    def inverse(self) -> tuple[dict[str, Node], ...]:
        """The branches: a formula for each coordinate, in the order in which they are solved for.

        What is put for the names that were given on the way stands in their place.
        """
        if self.solved is None:
            return ()
        meant: dict[str, Node] = {}
        for part in self.solved.solving.parts:
            for definition in part.definitions:
                meant[definition.name] = with_formulas(self.inverse_formulas.form(definition.value), meant)
        steps = self.solved.solving.solved
        return tuple(
            {
                step.coordinate: with_formulas(self.inverse_formulas.solutions(step)[index], meant)
                for step, index in zip(steps, branch.choice, strict=True)
            }
            for branch in self.solved.branches
        )

    @cached_property
    def when(self) -> tuple[Conditions, ...]:
        """Of each branch the conditions under which it gives r(q) = r."""
        if self.solved is None:
            return ()
        form = self.inverse_formulas.form
        return tuple(
            tuple(
                Equality((form(left), form(right)), one.is_angle)
                for one in branch.when
                for left, right in [
                    (one.left, one.right) if one.is_angle else _without_same(*_signed_sides(one))
                ]
            )
            for branch in self.solved.branches
        )

    @cached_property
    def inverse_formulas(self) -> InverseFormulas:
        """The formulas of the steps."""
        assert self.solved is not None
        solving = self.solved.solving
        return InverseFormulas(self.compactor(solving.ring), solving.solved)
