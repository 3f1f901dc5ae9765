"""Sets of configurations as formulas: what is 0 together, and under which conditions."""

from __future__ import annotations

from collections.abc import Iterator, Sequence, Set
from contextlib import suppress
from fractions import Fraction
from math import isqrt, lcm, prod

from dynsolve.algebra.factors import is_positive, numeric_roots, ratio, trig_factors
from dynsolve.algebra.inequality import Bound
from dynsolve.algebra.matrix import Matrix as Values
from dynsolve.algebra.ring import Expr
from dynsolve.algebra.sampling import Transfer
from dynsolve.derivation.elimination import turn_of
from dynsolve.derivation.graph import Derivation, Skipped
from dynsolve.derivation.singular.zeros import Condition
from dynsolve.document import Prose
from dynsolve.document.sentences import say
from dynsolve.errors import AlgebraError
from dynsolve.explain.inequalities import Inequalities
from dynsolve.explain.writing import as_row, listed, side_by_side
from dynsolve.notation.build import cost, split_sign, times, total
from dynsolve.notation.python import to_python
from dynsolve.notation.tree import (
    Matrix,
    Negative,
    Node,
    Number,
    Parenthesized,
    Product,
    Quotient,
    Sum,
    equation,
    names_in,
)
from dynsolve.robot.model import Robot


class SetForms(Inequalities):
    """The formulas of sets of equations of one robot, by the names of their rules."""

    def __init__(self, robot: Robot, values: Derivation) -> None:
        super().__init__(robot)
        self.values = values

    def alternatives(self, name: str) -> tuple[tuple[Node, ...], ...]:
        """The alternatives of a set of equations, by its name; none where they are too long."""
        found = self.values[name]
        if isinstance(found, Skipped):
            return ()
        return tuple(tuple(map(self.condition, one)) for one in found.alternatives)

    def existence(
        self, name: str, exist: Sequence[Sequence[Bound]], is_seen: Sequence[bool] = ()
    ) -> Iterator[Prose]:
        """For which parameters the alternatives of a set are there that are not for all.

        Of those of which it `is_seen` that the inequalities are all, else only there.
        """
        count = len(self.alternatives(name))
        kinds = list(zip(map(tuple, exist), is_seen or [True] * count, strict=True))
        for bounds, is_enough in dict.fromkeys(kinds):
            if not bounds:
                continue
            places = [k for k, other in enumerate(kinds, 1) if other == (bounds, is_enough)]
            these = "This" if count == 1 else "Each case" if len(places) == count else _cases(places)
            have = "have" if 1 < len(places) < count else "has"
            yield say(
                f"{these} {have} solutions{'' if is_enough else ' only'} where {{conditions}}.",
                conditions=side_by_side([*map(self.inequality, bounds)]),
            )

    def matrix(self, values: Values) -> Matrix:
        """A matrix of a ring of the search."""
        form = self.compactor(values.ring).form
        return Matrix(tuple(tuple(map(form, row)) for row in values.rows))

    def condition(self, condition: Condition) -> Node:
        """What is 0 where a condition holds, with whole coefficients, or decimals as the file has them."""
        expr = condition.expr
        forms = [self._whole(expr)]
        with suppress(AlgebraError):  # the robot's own ring, with sums of angles, has not every angle
            forms.append(self._whole(Transfer(expr.ring, self.robot.ring)(expr)))
        if condition.linear is not None and len(condition.linear[0]) > 1:
            forms.insert(0, self._solvable(*condition.linear))
        return min(forms, key=cost)

    def _solvable(self, factor: Expr, unknown: Expr, rest: Expr) -> Node:
        """(k - m w²) q₃ - k d₀, where that is 0: what is unknown beside all that stands in front of it."""
        form, whole = self.compactor(factor.ring).form, 1 / self.content((factor, rest))
        shown, signed = self._signed(factor * whole)
        rest = rest * (whole if signed == factor * whole else -whole)
        return total([times(1, [(shown, 1), (form(unknown), 1)]), *([] if rest.is_zero else [form(rest)])])

    def _whole(self, expr: Expr) -> Node:
        """What is 0 where an expression is, without a number in front of it."""
        return without_number(self._signed(expr / self.content((expr,)))[0])

    def vanishing(self, value: Expr, signed: Set[int] = frozenset()) -> Node:
        """What is 0 where an expression is, without the factors that never are; 1 where there is no other.

        `signed` are generators of parameters that may be 0 or negative.
        """
        return self._whole(may_vanish(value, signed))

    def product(self, value: Expr) -> Node:
        """An expression as the product of its factors in sines and cosines, parameters in front."""
        ring, product, front = value.ring, value.ring.one, value.ring.one
        shown: list[tuple[Node, int]] = []
        for factor, exponent in trig_factors(value):
            if ring.depends_on_coordinates(factor):
                whole = 1 if self.robot.has_decimals else lcm(*(int(c.q) for c in factor.poly.coeffs()))
                node, signed = self._signed(factor * whole)
                shown.append((node, exponent))
                product = product * signed**exponent
            else:
                front = front * factor**exponent
        shown.sort(key=lambda part: (cost(part[0]), to_python(part[0])))
        front = value if value.is_zero else front * ratio(value, product * front)
        if front.is_number:
            return times(front.number, shown)
        return times(1, [(self.compactor(ring).form(front), 1), *shown])

    def _signed(self, expr: Expr) -> tuple[Node, Expr]:
        """±expr with the sign that leaves fewer minus signs, as a formula and as it is."""
        form = self.compactor(expr.ring).form
        for one in _as_one_swing(expr):
            expr = min(expr, one, key=lambda e: cost(form(e)))
        return min(((form(e), e) for e in (expr, -expr)), key=lambda both: _minus_signs(both[0]))


def _cases(places: Sequence[int]) -> str:
    """`Case 2`, or `Cases 1 and 3`."""
    *first, last = map(str, places)
    return f"Cases {', '.join(first)} and {last}" if first else f"Case {last}"


def _as_one_swing(expr: Expr) -> Iterator[Expr]:
    """s + √3 c over its length 2, which is sin(θ + 60°), where the ring has that length; else nothing."""
    turn = turn_of(expr)
    if turn is None or turn.is_one_sided or not turn.rest.is_zero:
        return
    squared = turn.cosine**2 + turn.sine**2
    if not squared.is_number:
        return
    ring, number = expr.ring, Fraction(squared.number)
    for root, square in ((ring.one, 1), *((ring.generator(i), n) for i, n in numeric_roots(ring).items())):
        whole = number * square  # √number = √whole / √square
        above, below = isqrt(abs(whole.numerator)), isqrt(whole.denominator)
        if above**2 == whole.numerator and below**2 == whole.denominator:
            yield expr * root * Fraction(below, above)
            return


def without_number(node: Node) -> Node:
    """2 (a + b), √2 (a + b) and (a + b)/2 as a + b"""
    match node:
        case Product(factors) if any(not names_in(factor) for factor in factors):
            return _bare(times(1, [(factor, 1) for factor in factors if names_in(factor)]))
        case Quotient(numerator, Number()):
            return without_number(_bare(numerator))
    return node


def _bare(node: Node) -> Node:
    return node.argument if isinstance(node, Parenthesized) else node


def may_vanish(value: Expr, signed: Set[int] = frozenset()) -> Expr:
    """An expression without the factors that are never 0, where `signed` generators may be 0 or negative."""
    factors = (f for f, _ in trig_factors(value) if not is_positive(f) or not signed.isdisjoint(f.used))
    return prod(factors, start=value.ring.one)


def vanishing(conditions: tuple[Node, ...]) -> Node:
    """a = 0 and b = 0, in one line"""
    return as_row(listed([equation(value, Number(0)) for value in conditions]))


def _minus_signs(node: Node) -> int:
    """How many terms of a sum are negative; a sum that begins with a minus counts one more."""
    terms = node.terms if isinstance(node, Sum) else (node,)
    return sum(isinstance(term, Negative) for term in terms) + (split_sign(terms[0])[0] < 0)
