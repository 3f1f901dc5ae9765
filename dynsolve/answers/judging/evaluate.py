"""The exact value of what a student wrote: trees -> fractions over a field's ring.

Work is counted before a product is formed: a library in C cannot be interrupted,
and ends the process where memory ends.  Terms that are products of symbols, sines
and cosines are put together by their exponents, so that a torque of hundreds of
terms costs one reduction.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass, field
from fractions import Fraction
from math import comb
from typing import Any, NamedTuple

from dynsolve.algebra.angles import Angle
from dynsolve.algebra.expr import Expr
from dynsolve.algebra.fraction import RationalExpr, simplified
from dynsolve.algebra.generators import dotted
from dynsolve.algebra.rationals import rational, rational_value
from dynsolve.algebra.ring import Ring
from dynsolve.answers.judging.ring_extension import expected_angle, plain_radicand
from dynsolve.errors import AlgebraError
from dynsolve.notation.bounded import keep
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

MOST_WORK = 400_000
"""The products of terms that one answer may cost."""

MOST_TERMS = 30_000
"""The most terms of a value."""

SHORT = 64
"""Products of up to so many terms are added up before they are reduced."""

MOST_POWER = 20
MOST_BITS = 6_000
MOST_TURNS = 24

MOST_KNOWN = 4096
"""So many functions and terms are remembered."""


Lookup = Callable[[Reference], RationalExpr]
"""The value of an answer that occurs inside another."""


@dataclass(slots=True)
class Values:
    """What functions and terms were found to be in one ring, whoever wrote them.

    `turns` are sines and cosines: a value, or (generator, ±1).  `terms` are monomials
    or unreduced products, each with the work that it cost.
    """

    turns: dict[Function, RationalExpr | tuple[int, int]] = field(default_factory=dict)
    terms: dict[Node, _Value] = field(default_factory=dict)


def _nothing(reference: Reference) -> RationalExpr:
    raise AlgebraError(f"{reference} stands for no answer")


class _Value(NamedTuple):
    """A term: coefficient · Π generator^exponent, or where it has no `exponents` a product multiplied out."""

    exponents: tuple[int, ...] | None
    value: Any
    work: int


@dataclass(slots=True)
class _Term:
    """A product under construction: coefficient · Π generator^exponent · Π polynomials."""

    coefficient: Fraction
    exponents: dict[int, int]
    others: list[RationalExpr]


class Evaluator:
    """Values of trees in one ring; `work` is what the current tree has cost.

    `values` are those that are known already, for several hand-ins in one ring.
    """

    def __init__(self, ring: Ring, lookup: Lookup = _nothing, values: Values | None = None) -> None:
        self.ring = ring
        self.lookup = lookup
        self.work = 0
        self._width = len(ring.generators)
        self._values = Values() if values is None else values
        self._asked = 0
        self._roots: dict[Function, RationalExpr] = {}

    def value(self, node: Node) -> RationalExpr:
        """The exact value of a scalar tree.

        Raises AlgebraError for a zero denominator, or for work over the bound.
        """
        self.work = 0
        return self._value(node)

    def more(self, node: Node) -> RationalExpr:
        """The same, with the work added to what was counted before: entries of one answer share a bound."""
        return self._value(node)

    # -- descent -----------------------------------------------------------------------------------

    def _value(self, node: Node) -> RationalExpr:
        match node:
            case Sum(terms):
                return self._sum(terms)
            case Negative(argument) | Parenthesized(argument) if isinstance(argument, Sum):
                value = self._sum(argument.terms)
                return -value if isinstance(node, Negative) else value
            case Power(base, exponent):
                return self._power(self._value(base), exponent)
        term = _Term(Fraction(1), {}, [])
        self._gather(node, term, 1)
        return self._finish(term)

    def _sum(self, terms: Iterable[Node]) -> RationalExpr:
        flat: dict[tuple[int, ...], Any] = {}
        polys: list[Expr] = []
        fractions: list[RationalExpr] = []
        unreduced: Any = None
        for node in terms:
            inner, is_negative = _unwrapped(node)
            if isinstance(inner, Sum):
                self._put(self._value(node), polys, fractions)
                continue
            value = self._term(inner)
            if isinstance(value, RationalExpr):
                self._put(-value if is_negative else value, polys, fractions)
                continue
            key, number = value.exponents, -value.value if is_negative else value.value
            if key is None:
                unreduced = number if unreduced is None else unreduced + number
            elif number:
                flat[key] = flat[key] + number if key in flat else number
        if unreduced is not None:
            flat_poly = self.ring.ctx.from_dict(flat) + unreduced
        else:
            flat_poly = self.ring.ctx.from_dict(flat)
        total = self.ring.reduce(flat_poly) if flat_poly else self.ring.zero.poly
        for poly in polys:
            total = total + poly.poly
        result = RationalExpr(Expr(self.ring, total))
        return self._add_fractions(result, fractions)

    def _term(self, node: Node) -> _Value | RationalExpr:
        """A term of a sum: known, multiplied out and not yet reduced, or finished where it is long."""
        known = self._values.terms
        found = known.get(node)
        if found is not None:
            self.work += found.work
            return found
        asked, work = self._asked, self.work
        term = _Term(Fraction(1), {}, [])
        self._gather(node, term, 1)
        if not term.others:
            found = _Value(self._key(term), rational(term.coefficient), self.work - work)
        else:
            raw = self._raw(term)
            if raw is None:
                return self._finish(term)
            found = _Value(None, raw, self.work - work)
        if self._asked == asked:  # nothing of the student's own stands in it
            keep(known, node, found, MOST_KNOWN)
        return found

    def _raw(self, term: _Term) -> Any:
        """A term multiplied out and not yet reduced; None where it is no short product of polynomials."""
        size = 1
        for other in term.others:
            size *= len(other.numerator)
            if other.divisor is not None or size > SHORT:
                return None
        if not term.coefficient or not size:
            return self.ring.zero.poly
        self.work += size
        poly = self.ring.ctx.from_dict({self._key(term): rational(term.coefficient)})
        for other in term.others:
            poly = poly * other.numerator.poly
        return poly

    def _put(self, value: RationalExpr, polys: list[Expr], fractions: list[RationalExpr]) -> None:
        if value.divisor is None:
            polys.append(value.numerator)
        else:
            fractions.append(value)

    def _add_fractions(self, total: RationalExpr, fractions: list[RationalExpr]) -> RationalExpr:
        groups: dict[Expr, Expr] = {}
        for fraction in fractions:
            below = fraction.denominator
            groups[below] = groups[below] + fraction.numerator if below in groups else fraction.numerator
        for below, above in groups.items():
            top = self._times(total.numerator, below) + self._times(above, total.denominator)
            total = RationalExpr(top, self._times(total.denominator, below))
        return simplified(total) if groups else total

    def _key(self, term: _Term) -> tuple[int, ...]:
        exponents = [0] * self._width
        for index, power in term.exponents.items():
            if power > 100:
                raise AlgebraError("a power is too large")
            exponents[index] = power
        return tuple(exponents)

    def _gather(self, node: Node, term: _Term, power: int) -> None:
        """Multiply a tree, to a positive power, into a term."""
        match node:
            case Number(p, q):
                self._number(Fraction(p, q), term, power)
            case Negative(argument):
                if power % 2:
                    term.coefficient = -term.coefficient
                self._gather(argument, term, power)
            case Parenthesized(argument):
                self._gather(argument, term, power)
            case Product(factors):
                for factor in factors:
                    self._gather(factor, term, power)
            case Symbol():
                self._symbol(node, term, power)
            case Reference():
                self._asked += 1
                term.others.append(self._power_of(self.lookup(node), power))
            case Degrees(p, q):
                self._number(Fraction(p, 180 * q), term, power)
                self._symbol(Symbol("pi"), term, power)
            case Quotient(numerator, denominator):
                self._gather(numerator, term, power)
                value = rational_value(denominator)
                if value:
                    self._number(1 / value, term, power)
                else:
                    term.others.append(self._power_of(self._inverse(self._value(denominator)), power))
            case Power(base, Number(p, 1)) if p * power <= MOST_POWER:
                self._gather(base, term, p * power) if p else None
            case Power(base, exponent):
                term.others.append(self._power_of(self._power(self._value(base), exponent), power))
            case Function():
                self._function(node, term, power)
            case Sum():
                term.others.append(self._power_of(self._value(node), power))
            case _:
                raise AlgebraError("this is not an expression")

    def _number(self, value: Fraction, term: _Term, power: int) -> None:
        if power * max(value.numerator.bit_length(), value.denominator.bit_length()) > MOST_BITS:
            raise AlgebraError("a number is too large")
        term.coefficient *= value**power
        if term.coefficient.numerator.bit_length() + term.coefficient.denominator.bit_length() > MOST_BITS:
            raise AlgebraError("a number is too large")

    def _symbol(self, node: Symbol, term: _Term, power: int) -> None:
        index = self.ring.symbol_indices.get((node.name, node.dots))
        if index is None:
            index = self._unknown(dotted(node.name, node.dots))
        term.exponents[index] = term.exponents.get(index, 0) + power

    def _unknown(self, name: str) -> int:
        index = self.ring.symbol_indices.get((name, 0))
        if index is None:
            raise AlgebraError(f"{name} is not a symbol of this problem")
        return index

    # -- functions ---------------------------------------------------------------------------------

    def _function(self, node: Function, term: _Term, power: int) -> None:
        found = self._root(node) if node.name == "sqrt" else self._turn(node)
        if isinstance(found, RationalExpr):
            term.others.append(self._power_of(found, power))
            return
        index, sign = found
        term.exponents[index] = term.exponents.get(index, 0) + power
        if sign < 0 and power % 2:
            term.coefficient = -term.coefficient

    def _turn(self, node: Function) -> RationalExpr | tuple[int, int]:
        """The value of a sine, cosine or tangent, which no answer of the hand-in can change."""
        known = self._values.turns
        found = known.get(node)
        if found is None:
            work = self.work
            found = keep(known, node, self._turn_value(node), MOST_KNOWN)
            self.work = work  # what is remembered costs nothing, nor must the first who writes it pay
        return found

    def _turn_value(self, node: Function) -> RationalExpr | tuple[int, int]:
        """The value of a function of an angle, or (generator, ±1) where it is one."""
        angle = expected_angle(node, self.ring.names)
        if angle is None:
            value = self.ring.function(node)
            return self._generator(value) or RationalExpr(value)
        if node.name == "tan":
            c, s = self._turned("cos", angle), self._turned("sin", angle)
            return self._product(RationalExpr(s), self._inverse(RationalExpr(c)))
        if node.name not in ("sin", "cos"):
            raise AlgebraError(f"{node.name} is not a function that occurs here")
        value = self._turned(node.name, angle)
        return self._generator(value) or RationalExpr(value)

    def _generator(self, value: Expr) -> tuple[int, int] | None:
        """(generator, ±1) where a value is one."""
        if len(value) != 1:
            return None
        exponents, coefficient = next(iter(value.poly.to_dict().items()))
        used = [i for i, e in enumerate(exponents) if e]
        if len(used) != 1 or exponents[used[0]] != 1 or abs(coefficient) != 1:
            return None
        return used[0], 1 if coefficient > 0 else -1

    def _turned(self, name: str, angle: Angle) -> Expr:
        counts = self.ring.multiples(angle.linear) if angle.terms else ()
        if sum(map(abs, counts)) > MOST_TURNS:
            raise AlgebraError(f"an angle is more than {MOST_TURNS} times those of the problem")
        return self.ring.cos(angle) if name == "cos" else self.ring.sin(angle)

    def _root(self, node: Function) -> RationalExpr:
        found = self._roots.get(node)
        if found is None:
            found = self._roots[node] = self._root_value(node)
        return found

    def _root_value(self, node: Function) -> RationalExpr:
        value = rational_value(node.argument)
        if value is not None:
            if value < 0:
                raise AlgebraError("the root of a negative number", "lengths and masses are real")
            root = self.ring.constant(0) if not value else self.ring.root(node, self.ring.constant(value))
            return RationalExpr(root)
        if not plain_radicand(node.argument, self.ring.names):
            return RationalExpr(self.ring.function(node))
        inner = self._value(node.argument)
        if inner.divisor is None:
            exact = _exact_root(inner.numerator)
            if exact is not None:
                return RationalExpr(exact)
        return RationalExpr(self.ring.root(node.argument, inner.numerator))

    # -- products ----------------------------------------------------------------------------------

    def _finish(self, term: _Term) -> RationalExpr:
        if not term.coefficient:
            return RationalExpr(self.ring.zero)
        poly = self.ring.ctx.from_dict({self._key(term): rational(term.coefficient)})
        result = RationalExpr(Expr(self.ring, self.ring.reduce(poly)))
        for other in sorted(term.others, key=lambda f: len(f.numerator)):
            result = self._product(result, other)
        return result

    def _product(self, a: RationalExpr, b: RationalExpr) -> RationalExpr:
        above = self._times(a.numerator, b.numerator)
        if a.divisor is None and b.divisor is None:
            return RationalExpr(above)
        return RationalExpr(above, self._times(a.denominator, b.denominator))

    def _times(self, a: Expr, b: Expr) -> Expr:
        cost = len(a) * len(b)
        self.work += cost
        if self.work > MOST_WORK or cost > 8 * MOST_TERMS:
            raise AlgebraError(
                "multiplied out this is too large", "name a part of it with a symbol of its own"
            )
        product = a * b
        if len(product) > MOST_TERMS:
            raise AlgebraError("multiplied out this has too many terms")
        if product.poly and _bits(product) > MOST_BITS:
            raise AlgebraError("a number is too large")
        return product

    def _inverse(self, value: RationalExpr) -> RationalExpr:
        if value.is_zero:
            raise AlgebraError("the denominator is zero", "check what stands below the fraction line")
        if value.divisor is None and value.numerator.is_number:
            return RationalExpr(self.ring.one / value.numerator.number)
        return RationalExpr(value.denominator, value.numerator)

    def _power(self, base: RationalExpr, exponent: Node) -> RationalExpr:
        match exponent:
            case Number(p, 1):
                count = p
            case Negative(Number(p, 1)):
                base, count = self._inverse(base), p
            case _:
                raise AlgebraError("an exponent must be a whole number", "write sqrt(...) for a root")
        return self._power_of(base, count)

    def _power_of(self, base: RationalExpr, count: int) -> RationalExpr:
        if count == 1:
            return base
        size = max(len(base.numerator), len(base.denominator), 1)
        if count > MOST_POWER or comb(size + count - 1, count) > MOST_TERMS:
            raise AlgebraError(f"the power {count} is too large")
        result = RationalExpr(self.ring.one)
        for _ in range(count):
            result = self._product(result, base)
        return result


def _unwrapped(node: Node) -> tuple[Node, bool]:
    """What stands behind signs and parentheses, and whether it is negative."""
    is_negative = False
    while isinstance(node, (Negative, Parenthesized)):
        is_negative = is_negative != isinstance(node, Negative)
        node = node.argument
    return node, is_negative


def _bits(expr: Expr) -> int:
    lead = expr.poly.leading_coefficient()
    return int(lead.p).bit_length() + int(lead.q).bit_length()


def _exact_root(expr: Expr) -> Expr | None:
    """√p where p is the square of a polynomial, the one with a positive leading coefficient."""
    try:
        root = expr.poly.sqrt()
    except Exception:  # noqa: BLE001  FLINT says "not a square" by several classes
        return None
    if root and root.leading_coefficient() < 0:
        root = -root
    return Expr(expr.ring, root)
