"""The exact value of a tree in a ring.  Only trees are evaluated, never text.

Work is bounded before a product is formed: a library in C cannot be interrupted, and ends
the process where memory ends.  Terms that are products of symbols, sines and cosines are
put together by their exponents, so that a torque of hundreds of terms costs one reduction.

`Evaluator` is for the formulas of a problem; `answers.judging.evaluate` refines it for what
a student wrote, where a denominator may hold joint variables and a function any argument.

The values of exact expressions in floating point, or in another kind of number.

Making a ring: the smallest one that holds given formulas.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from fractions import Fraction
from math import comb, cos, pi, radians, sin, sqrt
from typing import Any, ClassVar, NamedTuple

from msgspec import Struct, field
from msgspec.structs import replace

from dynsolve.algebra.angles import Angle, Atom, angle_from_tree, names_of
from dynsolve.algebra.fraction import RationalExpr, simplified
from dynsolve.algebra.generators import Generator, dotted
from dynsolve.algebra.rationals import rational, rational_value
from dynsolve.algebra.ring import Expr, NoRoom, Ring, Terms, terms_of
from dynsolve.algebra.ring_plan import RingPlan, plan_ring
from dynsolve.errors import AlgebraError
from dynsolve.notation.tree import (
    Degrees,
    Function,
    Negative,
    Node,
    Number,
    Parenthesized,
    Power,
    Product,
    Quotient,
    Reference,
    Sum,
    Symbol,
)
from dynsolve.notation.tree_values import evaluate as value_of_tree

SHORT = 64
"""Products of up to so many terms are added up before they are reduced."""


def value_of(ring: Ring, node: Node) -> Expr:
    """The exact value of a tree in a ring that was built for it.

    Raises AlgebraError for an unknown symbol, a zero denominator or one with a joint
    variable, an angle that is a bare number, or a product over the bound.
    """
    return Evaluator(ring).value(node).numerator


def has_value(ring: Ring, node: Node) -> bool:
    """Whether a ring holds all that a formula is made of."""
    try:
        value_of(ring, node)
    except AlgebraError:
        return False
    return True


class ProductTerm(Struct):
    """A product under construction: coefficient · Π generator^exponent · Π factors."""

    coefficient: Fraction = Fraction(1)
    exponents: dict[int, int] = field(default_factory=dict)
    factors: list[RationalExpr] = field(default_factory=list)


class Unreduced(NamedTuple):
    """A term of a sum: coefficient · Π generator^exponent, or where it has no `exponents` a polynomial.

    `work` is what it cost.
    """

    exponents: tuple[int, ...] | None
    value: Any
    work: int


class Evaluator:
    """Values of trees in one ring; `work` counts the products of terms."""

    largest_power: ClassVar[int] = 64
    """The largest exponent of a power."""

    largest_exponent: ClassVar[int] = 4096
    """The largest exponent that powers of powers and products may come to."""

    most_terms: ClassVar[int] = 200_000
    """A product or a power that may have more terms than this is refused before it is formed."""

    most_bits: ClassVar[int] = 6_000
    """The most bits of a number."""

    def __init__(self, ring: Ring) -> None:
        self.ring = ring
        self.work = 0
        self._width = ring.ctx.nvars()

    def value(self, node: Node) -> RationalExpr:
        """The exact value of a scalar tree.

        Raises AlgebraError for a tree without a value in the ring, or for work over the bounds.
        """
        match node:
            case Sum(terms):
                return self._sum(terms)
            case Negative(argument) | Parenthesized(argument) if isinstance(argument, Sum):
                value = self._sum(argument.terms)
                return -value if isinstance(node, Negative) else value
            case Power(base, exponent):
                return self._power(self.value(base), exponent)
        term = ProductTerm()
        self._multiply(term, node, 1)
        return self._finished(term)

    # -- what a refinement may do otherwise --------------------------------------------------------

    def inverse(self, value: RationalExpr) -> RationalExpr:
        """1 / value: here an element of the ring."""
        return RationalExpr(self.ring.inverse(value.numerator))

    def root(self, node: Function) -> RationalExpr:
        """The value of a square root."""
        return RationalExpr(self.ring.root(node.argument, self.value(node.argument).numerator))

    def function(self, node: Function) -> RationalExpr | tuple[int, int]:
        """The value of a function of an angle, or (generator, ±1) where it is one."""
        if node.name == "sgn":
            return RationalExpr(self.ring.function(node))
        angle = angle_from_tree(node.argument)
        match node.name:
            case "sin":
                return RationalExpr(self.ring.sin(angle))
            case "cos":
                return RationalExpr(self.ring.cos(angle))
            case "tan":
                cosine = RationalExpr(self.ring.cos(angle))
                return self.product(RationalExpr(self.ring.sin(angle)), self.inverse(cosine))
        raise AlgebraError(
            f"{node.name} is not a function that occurs here", "known are sin, cos, tan and sqrt"
        )

    def reference(self, node: Reference) -> RationalExpr:
        """The value of a quantity that stands in a formula by its name."""
        raise AlgebraError(f"{node} stands for no value here")

    def times(self, a: Expr, b: Expr) -> Expr:
        """a · b, within the bounds."""
        if len(a) * len(b) > self.most_terms:
            raise AlgebraError("the product has too many terms", "write it with an abbreviation")
        return a * b

    def term(self, node: Node) -> Unreduced | RationalExpr:
        """A term of a sum: multiplied out and not yet reduced, or finished where it is long."""
        work, term = self.work, ProductTerm()
        self._multiply(term, node, 1)
        if not term.factors:
            return Unreduced(self._exponents(term), rational(term.coefficient), self.work - work)
        poly = self._short_product(term)
        return self._finished(term) if poly is None else Unreduced(None, poly, self.work - work)

    # -- sums --------------------------------------------------------------------------------------

    def _sum(self, terms: Iterable[Node]) -> RationalExpr:
        by_exponents: dict[tuple[int, ...], Any] = {}
        unreduced = self.ring.ctx.constant(0)
        finished: list[RationalExpr] = []
        for node in terms:
            inner, is_negative = _unwrapped(node)
            value = self.value(node) if isinstance(inner, Sum) else self.term(inner)
            if isinstance(value, RationalExpr):
                finished.append(-value if is_negative and not isinstance(inner, Sum) else value)
                continue
            key, number = value.exponents, -value.value if is_negative else value.value
            if key is None:
                unreduced = unreduced + number
            elif number:
                by_exponents[key] = by_exponents[key] + number if key in by_exponents else number
        total = self.ring.reduce(self.ring.ctx.from_dict(by_exponents) + unreduced)
        for value in finished:
            if value.divisor is None:
                total = total + value.numerator.poly
        fractions = [value for value in finished if value.divisor is not None]
        return self._with_fractions(RationalExpr(Expr(self.ring, total)), fractions)

    def _with_fractions(self, total: RationalExpr, fractions: Iterable[RationalExpr]) -> RationalExpr:
        """The sum over a common denominator."""
        numerators: dict[Expr, Expr] = {}
        for value in fractions:
            below, above = value.denominator, value.numerator
            numerators[below] = numerators[below] + above if below in numerators else above
        for below, above in numerators.items():
            top = self.times(total.numerator, below) + self.times(above, total.denominator)
            total = RationalExpr(top, self.times(total.denominator, below))
        return simplified(total) if numerators else total

    # -- products ----------------------------------------------------------------------------------

    def _multiply(self, term: ProductTerm, node: Node, power: int) -> None:
        """Multiply a tree, to a positive power, into a term."""
        match node:
            case Number(p, q):
                self._multiply_number(term, Fraction(p, q), power)
            case Negative(argument):
                if power % 2:
                    term.coefficient = -term.coefficient
                self._multiply(term, argument, power)
            case Parenthesized(argument):
                self._multiply(term, argument, power)
            case Product(factors):
                for factor in factors:
                    self._multiply(term, factor, power)
            case Symbol():
                self._multiply_generator(term, self._symbol(node), power)
            case Degrees(p, q):
                self._multiply_number(term, Fraction(p, 180 * q), power)
                self._multiply_generator(term, self._symbol(Symbol("pi")), power)
            case Quotient(numerator, denominator):
                self._multiply(term, numerator, power)
                value = rational_value(denominator)
                if value:
                    self._multiply_number(term, 1 / value, power)
                else:
                    self._multiply_value(term, self.inverse(self.value(denominator)), power)
            case Power(base, Number(p, 1)) if p * power <= self.largest_power:
                if p:
                    self._multiply(term, base, p * power)
            case Function():
                self._multiply_function(term, node, power)
            case Reference():
                self._multiply_value(term, self.reference(node), power)
            case Sum() | Power():
                self._multiply_value(term, self.value(node), power)
            case _:
                raise AlgebraError("this is not an expression")

    def _multiply_number(self, term: ProductTerm, value: Fraction, power: int) -> None:
        if power * max(value.numerator.bit_length(), value.denominator.bit_length()) <= self.most_bits:
            term.coefficient *= value**power
            number = term.coefficient
            if number.numerator.bit_length() + number.denominator.bit_length() <= self.most_bits:
                return
        raise AlgebraError("a number is too large")

    def _multiply_generator(self, term: ProductTerm, index: int, power: int) -> None:
        term.exponents[index] = term.exponents.get(index, 0) + power

    def _multiply_value(self, term: ProductTerm, value: RationalExpr, power: int) -> None:
        term.factors.append(self._power_of(value, power))

    def _multiply_function(self, term: ProductTerm, node: Function, power: int) -> None:
        found = self.root(node) if node.name == "sqrt" else self.function(node)
        if isinstance(found, RationalExpr):
            self._multiply_value(term, found, power)
            return
        index, sign = found
        self._multiply_generator(term, index, power)
        if sign < 0 and power % 2:
            term.coefficient = -term.coefficient

    def _symbol(self, node: Symbol) -> int:
        """The generator of a symbol; the derivative of a plain name is a symbol of its own."""
        indices = self.ring.symbol_indices
        index = indices.get((node.name, node.dots))
        if index is None:
            name = dotted(node.name, node.dots)
            index = indices.get((name, 0))
            if index is None:
                raise AlgebraError(f"{name} is not a symbol of this problem")
        return index

    def _exponents(self, term: ProductTerm) -> tuple[int, ...]:
        exponents = [0] * self._width
        for index, power in term.exponents.items():
            if power > self.largest_exponent:
                raise AlgebraError("a power is too large")
            exponents[index] = power
        return tuple(exponents)

    def _monomial(self, term: ProductTerm) -> Any:
        return self.ring.ctx.from_dict({self._exponents(term): rational(term.coefficient)})

    def _short_product(self, term: ProductTerm) -> Any:
        """A term multiplied out and not yet reduced; None where it is no short product of polynomials."""
        size = 1
        for factor in term.factors:
            size *= len(factor.numerator)
            if factor.divisor is not None or size > SHORT:
                return None
        if not term.coefficient or not size:
            return self.ring.zero.poly
        self.work += size
        poly = self._monomial(term)
        for factor in term.factors:
            poly = poly * factor.numerator.poly
        return poly

    def _finished(self, term: ProductTerm) -> RationalExpr:
        """A term multiplied out and reduced."""
        if not term.coefficient:
            return RationalExpr(self.ring.zero)
        result = RationalExpr(Expr(self.ring, self.ring.reduce(self._monomial(term))))
        for factor in sorted(term.factors, key=lambda f: len(f.numerator)):
            result = self.product(result, factor)
        return result

    def product(self, a: RationalExpr, b: RationalExpr) -> RationalExpr:
        """a · b, within the bounds."""
        numerator = self.times(a.numerator, b.numerator)
        if a.divisor is None and b.divisor is None:
            return RationalExpr(numerator)
        return RationalExpr(numerator, self.times(a.denominator, b.denominator))

    def _power(self, base: RationalExpr, exponent: Node) -> RationalExpr:
        match exponent:
            case Number(p, 1):
                return self._power_of(base, p)
            case Negative(Number(p, 1)):
                return self._power_of(self.inverse(base), p)
        raise AlgebraError("an exponent must be a whole number", "write sqrt(...) for a root")

    def _power_of(self, base: RationalExpr, count: int) -> RationalExpr:
        if count == 1:
            return base
        size = max(len(base.numerator), len(base.denominator), 1)
        if count > self.largest_power or comb(size + count - 1, count) > self.most_terms:
            raise AlgebraError(f"the power {count} is too large")
        result = RationalExpr(self.ring.one)
        for _ in range(count):
            result = self.product(result, base)
        return result


def _unwrapped(node: Node) -> tuple[Node, bool]:
    """The tree inside signs and parentheses, and whether it is negated."""
    is_negative = False
    while isinstance(node, (Negative, Parenthesized)):
        is_negative = is_negative != isinstance(node, Negative)
        node = node.argument
    return node, is_negative


# The values of exact expressions in floating point, or in another kind of number

Functions = Mapping[str, Callable[[Any], Any]]

FUNCTIONS: Functions = {"sin": sin, "cos": cos, "sqrt": sqrt}


def evaluate(expr: Expr, values: Mapping[str, float]) -> float:
    """The value at plain names: `theta1`, `theta1_dot`, `theta1_ddot` and the parameters.

    Raises KeyError for a symbol that occurs and has no value.
    """
    return float(evaluate_with(expr, values, FUNCTIONS))


def evaluate_with(expr: Expr, values: Mapping[str, Any], functions: Functions) -> Any:
    """The same in another kind of number, which `functions` work on: a sine, a cosine, a square root."""
    return _Evaluation(expr.ring, values, functions).of(expr.terms)


def _require(g: Generator, values: Mapping[str, Any]) -> None:
    names = [dotted(g.name, g.dots)] if g.kind == "symbol" else names_of(g.angle)
    for name in names:
        if name != "pi" and name not in values:
            raise KeyError(name)


class _Evaluation(Struct, frozen=True):
    """The values of polynomials at a point; `known` are generators whose values were found before."""

    ring: Ring
    values: Mapping[str, Any]
    functions: Functions
    known: dict[int, Any] = field(default_factory=dict)

    def of(self, terms: Terms) -> Any:
        """The value of a polynomial."""
        known = self.known
        total: Any = 0.0
        for coefficient, powers in terms:
            term: Any = coefficient
            for index, power in powers:
                if index not in known:
                    g = self.ring.generators[index]
                    _require(g, self.values)
                    known[index] = self._generator(g)
                term *= known[index] ** power
            total += term
        return total

    def _generator(self, g: Generator) -> Any:
        """The value of a generator; roots and inverses are of expressions in others."""
        match g.kind:
            case "symbol":
                return pi if g.name == "pi" else self.values[dotted(g.name, g.dots)]
            case "root":
                return self.functions["sqrt"](self.of(terms_of(self.ring.radicands[g.index])))
            case "inverse":
                return 1 / self.of(terms_of(self.ring.inverses[g.index]))
            case "function" if g.node is not None:
                return value_of_tree(g.node, self.values)
        turn = sum(float(rate) * self._atom(atom) for atom, rate in g.angle.terms)
        angle = radians(float(g.angle.degrees)) + turn
        return self.functions["sin" if g.kind == "sin" else "cos"](angle)

    def _atom(self, atom: Atom) -> Any:
        product: Any = 1.0
        for name, exponent in atom:
            product *= pi if name == "pi" else self.values[name] ** exponent
        return product


# Making a ring: the smallest one that holds given formulas


def build_ring(
    coordinates: Sequence[tuple[str, str]],
    trees: Iterable[Node],
    angles: Iterable[Angle] = (),
    preferred: Sequence[Angle] = (),
) -> Ring:
    """The smallest ring that holds everything in `trees` and the sine and cosine of `angles`.

    `coordinates` are (name, "revolute" | "prismatic"); `preferred` angles are
    taken as basic ones as far as they are independent.  Raises AlgebraError
    for a number used as an angle.
    """
    names = [name for name, _ in coordinates]
    return ring_of(coordinates, plan_ring(names, tuple(trees), tuple(preferred), tuple(angles)))


def with_symbols(ring: Ring, names: Iterable[str]) -> Ring:
    """A ring with further parameters; the generators of the given one keep their places."""
    return ring_of(ring.coordinates, replace(ring.plan, symbols=(*ring.plan.symbols, *names)))


def with_references(ring: Ring, names: Iterable[str]) -> Ring:
    """A ring with the first and second derivatives of further names as symbols."""
    return ring_of(ring.coordinates, replace(ring.plan, references=tuple(names)))


def ring_of(coordinates: Sequence[tuple[str, str]], plan: RingPlan) -> Ring:
    """The ring of a plan, with the relations of its roots and denominators."""
    while True:
        try:
            ring = Ring(coordinates, plan)
            for g in reversed(ring.generators):  # a root may stand under one that is laid out before it
                if g.kind == "root" and g.node is not None:
                    ring.adjoin_root(g.index, value_of(ring, g.node))
            for tree in plan.denominators:
                value_of(ring, Quotient(Number(1), tree))
            return ring
        except NoRoom:
            plan = plan.with_more_inverses()
