"""The exact value of what a student wrote: trees -> fractions over the answers' ring.

It differs from that of a problem's formulas (`algebra.ring_values`) in four things: a
denominator may hold joint variables; a function may have any argument; a name may stand
for another answer; and the work that one answer may cost is counted.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import ClassVar

from flint.utils.flint_exceptions import FlintError
from msgspec import Struct, field

from dynsolve.algebra.angles import Angle
from dynsolve.algebra.expr import Expr, is_sign
from dynsolve.algebra.fraction import RationalExpr
from dynsolve.algebra.rationals import rational_value
from dynsolve.algebra.ring import Ring
from dynsolve.algebra.ring_values import Evaluator, Unreduced
from dynsolve.answers.judging.ring_extension import expected_angle, plain_radicand, unsigned
from dynsolve.errors import AlgebraError
from dynsolve.notation.tree import Function, Node, Reference
from dynsolve.notation.tree_values import keep

MOST_WORK = 400_000
"""The products of terms that one answer may cost."""

MOST_PRODUCTS = 240_000
"""The products of terms that one multiplication may cost."""

MOST_TURNS = 24
"""The largest sum of multiples of the basic angles in one angle."""

MOST_KNOWN = 4096
"""So many functions and terms are remembered."""


Lookup = Callable[[Reference], RationalExpr]
"""The value of an answer that occurs inside another."""

FunctionValue = RationalExpr | tuple[int, int]
"""A value, or (generator, ±1) where it is one."""


class KnownValues(Struct):
    """What functions of angles and terms of sums were found to be in one ring, whoever wrote them.

    All hand-ins to one problem hold much the same terms.
    """

    functions: dict[Function, FunctionValue] = field(default_factory=dict)
    terms: dict[Node, Unreduced] = field(default_factory=dict)


def _nothing(reference: Reference) -> RationalExpr:
    raise AlgebraError(f"{reference} stands for no answer")


class AnswerEvaluator(Evaluator):
    """Values of answers in one ring; `work` is what the current answer has cost.

    `known` are the values that are known already, for several hand-ins in one ring.
    """

    largest_power: ClassVar[int] = 20
    largest_exponent: ClassVar[int] = 100
    most_terms: ClassVar[int] = 30_000

    def __init__(self, ring: Ring, lookup: Lookup = _nothing, known: KnownValues | None = None) -> None:
        super().__init__(ring)
        self._lookup = lookup
        self._known = KnownValues() if known is None else known
        self._sign_generators = [ring.generator(g.index) for g in ring.generators if is_sign(g.node)]
        self._references = 0
        self._roots: dict[Function, RationalExpr] = {}

    def term(self, node: Node) -> Unreduced | RationalExpr:
        """A term of a sum; it is remembered where nothing of the student's own stands in it."""
        found: Unreduced | RationalExpr | None = self._known.terms.get(node)
        if isinstance(found, Unreduced):
            self.work += found.work
            return found
        references = self._references
        found = super().term(node)
        if isinstance(found, Unreduced) and self._references == references:
            keep(self._known.terms, node, found, MOST_KNOWN)
        return found

    def times(self, a: Expr, b: Expr) -> Expr:
        """a · b, with its work counted."""
        cost = len(a) * len(b)
        self.work += cost
        if self.work > MOST_WORK or cost > MOST_PRODUCTS:
            raise AlgebraError(
                "multiplied out this is too large", "name a part of it with a symbol of its own"
            )
        product = a * b
        if len(product) > self.most_terms:
            raise AlgebraError("multiplied out this has too many terms")
        if product.poly and _bits(product) > self.most_bits:
            raise AlgebraError("a number is too large")
        return product

    def inverse(self, value: RationalExpr) -> RationalExpr:
        """1 / value, a fraction where the value is no number."""
        if value.is_zero:
            raise AlgebraError("the denominator is zero", "check what stands below the fraction line")
        if value.divisor is None and value.numerator.is_number:
            return RationalExpr(self.ring.one / value.numerator.number)
        signs, rest = self._without_signs(value.numerator)
        if rest.is_number:
            return RationalExpr(value.denominator * signs / rest.number)
        return RationalExpr(value.denominator * signs, rest)

    def _without_signs(self, expr: Expr) -> tuple[Expr, Expr]:
        """The signs sgn q̇ that are factors of an expression, and what is left: 1 / sgn q̇ = sgn q̇."""
        found = self.ring.one
        for sign in self._sign_generators:
            quotient, rest = divmod(expr.poly, sign.poly)
            if not rest:
                found, expr = found * sign, Expr(self.ring, quotient)
        return found, expr

    def reference(self, node: Reference) -> RationalExpr:
        """The value of another answer."""
        self._references += 1
        return self._lookup(node)

    # -- functions ---------------------------------------------------------------------------------

    def function(self, node: Function) -> FunctionValue:
        """The value of a sine, cosine or tangent, which no answer of the hand-in can change."""
        found = self._known.functions.get(node)
        if found is None:
            work = self.work
            found = keep(self._known.functions, node, self._function_value(node), MOST_KNOWN)
            self.work = work  # what is remembered costs nothing, nor must the first who writes it pay
        return found

    def _function_value(self, node: Function) -> FunctionValue:
        angle = expected_angle(node, self.ring.names)
        if angle is None:
            sign, bare = unsigned(node)
            value = self.ring.function(bare) * sign
        elif node.name == "tan":
            cosine = RationalExpr(self._turned("cos", angle))
            return self.product(RationalExpr(self._turned("sin", angle)), self.inverse(cosine))
        elif node.name in ("sin", "cos"):
            value = self._turned(node.name, angle)
        else:
            raise AlgebraError(f"{node.name} is not a function that occurs here")
        return _generator(value) or RationalExpr(value)

    def _turned(self, name: str, angle: Angle) -> Expr:
        counts = self.ring.multiples(angle.linear) if angle.terms else ()
        if sum(map(abs, counts)) > MOST_TURNS:
            raise AlgebraError(f"an angle is more than {MOST_TURNS} times those of the problem")
        return self.ring.cos(angle) if name == "cos" else self.ring.sin(angle)

    def root(self, node: Function) -> RationalExpr:
        """The value of a square root."""
        found = self._roots.get(node)
        if found is None:
            found = self._roots[node] = RationalExpr(self._root_value(node))
        return found

    def _root_value(self, node: Function) -> Expr:
        value = rational_value(node.argument)
        if value is not None:
            if value < 0:
                raise AlgebraError("the root of a negative number", "lengths and masses are real")
            return self.ring.root(node, self.ring.constant(value)) if value else self.ring.zero
        if not plain_radicand(node.argument, self.ring.names):
            return self.ring.function(node)
        inner = self.value(node.argument)
        exact = _exact_root(inner.numerator) if inner.divisor is None else None
        return self.ring.root(node.argument, inner.numerator) if exact is None else exact


def _generator(value: Expr) -> tuple[int, int] | None:
    """(generator, ±1) where a value is one."""
    if len(value) != 1:
        return None
    exponents, coefficient = next(iter(value.poly.to_dict().items()))
    used = [i for i, e in enumerate(exponents) if e]
    if len(used) != 1 or exponents[used[0]] != 1 or abs(coefficient) != 1:
        return None
    return used[0], 1 if coefficient > 0 else -1


def _bits(expr: Expr) -> int:
    lead = expr.poly.leading_coefficient()
    return int(lead.p).bit_length() + int(lead.q).bit_length()


def _exact_root(expr: Expr) -> Expr | None:
    """√p where p is the square of a polynomial, the one with a positive leading coefficient."""
    try:
        root = expr.poly.sqrt()
    except (FlintError, ValueError):  # it is none
        return None
    if root and root.leading_coefficient() < 0:
        root = -root
    return Expr(expr.ring, root)
