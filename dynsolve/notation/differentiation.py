"""The derivative of a formula as a person writes it: term by term, product and chain rule.

Nothing is collected or simplified afterwards; that is the next line's work.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator, Sequence
from fractions import Fraction
from functools import partial
from itertools import product
from math import prod

from msgspec import Struct

from dynsolve.notation.build import factors_of, negated, split_sign, times, total
from dynsolve.notation.tree import (
    ONE,
    ZERO,
    Function,
    Negative,
    Node,
    Number,
    Parenthesized,
    Power,
    Product,
    Quotient,
    Sum,
    Symbol,
    mapped,
    walk,
)

Rule = Callable[[Symbol], Node]
"""The derivative of every symbol: ZERO for what is held fixed."""


def by_time(coordinates: Sequence[str]) -> Rule:
    """d/dt: a coordinate gives its rate, a rate its acceleration."""
    names = frozenset(coordinates)
    return lambda symbol: Symbol(symbol.name, symbol.dots + 1) if symbol.name in names else ZERO


def by_symbol(variable: Symbol) -> Rule:
    """∂/∂variable: everything else is held fixed, rates of the variable among it."""
    return lambda symbol: ONE if symbol == variable else ZERO


class Differentiated(Struct, frozen=True):
    """A derivative, and whether the product or the chain rule was more than a look: several factors vary."""

    tree: Node
    by_product_rule: bool


def differentiated(node: Node, rule: Rule, *, decimal: bool = False) -> Differentiated:
    """The derivative of a scalar tree; `decimal` says that numbers are decimals.

    >>> from dynsolve.notation.unicode import to_unicode
    >>> q = Symbol("q")
    >>> found = differentiated(Product((Symbol("m"), Function("cos", q), Symbol("q", 1))), by_time(["q"]))
    >>> to_unicode(found.tree), found.by_product_rule
    ('m cos(q) q̈ - m sin(q) q̇²', True)
    """
    worker = _Worker(rule, decimal)
    return Differentiated(worker.derivative(node), worker.by_product_rule)


class _Worker:
    def __init__(self, rule: Rule, decimal: bool) -> None:
        self.rule = rule
        self.times = partial(product_of, decimal=decimal)
        self.decimal = decimal
        self.by_product_rule = False

    def derivative(self, node: Node) -> Node:
        match node:
            case Symbol():
                return self.rule(node)
            case Sum(terms):
                return total([self.derivative(term) for term in terms])
            case Negative(argument):
                return negated(self.derivative(argument))
            case Parenthesized(argument):
                return self.derivative(argument)
            case Product(factors):
                return self._product(factors)
            case Quotient(numerator, denominator) if self._is_fixed(denominator):
                slope = self.derivative(numerator)
                return divided(slope, denominator) or self.times(1, [(slope, 1), (denominator, -1)])
            case Power(base, Number(p, 1)):
                slope = self.derivative(base)
                self.by_product_rule |= slope not in (ZERO, ONE) and not isinstance(base, Symbol)
                return ZERO if slope == ZERO else self.times(p, [(base, p - 1), (slope, 1)])
            case Function("sin" | "cos" as name, argument):
                other, sign = ("cos", 1) if name == "sin" else ("sin", -1)
                return self.times(sign, [(Function(other, argument), 1), (self.derivative(argument), 1)])
        if self._is_fixed(node):
            return ZERO
        raise TypeError(f"no derivative of {type(node).__name__}")

    def _is_fixed(self, node: Node) -> bool:
        return all(self.rule(part) == ZERO for part in walk(node) if isinstance(part, Symbol))

    def _product(self, factors: tuple[Node, ...]) -> Node:
        slopes = [self.derivative(factor) for factor in factors]
        varying = [k for k, slope in enumerate(slopes) if slope != ZERO]
        self.by_product_rule |= len(varying) > 1
        if len(factors) == 2 and varying == [1] and (denominator := _one_over(factors[0])):
            cancelled = self._divided(slopes[1], denominator)
            if cancelled is not None:
                return cancelled
        changed = [[*factors[:k], slopes[k], *factors[k + 1 :]] for k in varying]
        return total([self.times(1, [(factor, 1) for factor in each]) for each in changed])

    def _divided(self, slope: Node, denominator: Node) -> Node | None:
        """A slope over a number: of decimals each term, 0.48 s₂ as 0.24 s₂."""
        if not (self.decimal and isinstance(denominator, Number)):
            return divided(slope, denominator)
        part = 1 / Fraction(denominator.p, denominator.q)
        terms = slope.terms if isinstance(slope, Sum) else (slope,)
        return total([times(part, [(term, 1)], decimal=True) for term in terms])


def product_of(
    coefficient: Fraction | int, factors: Sequence[tuple[Node, int]], *, decimal: bool = False
) -> Node:
    """The product of factors with exponents; powers of one base are put together."""
    merged: dict[Node, int] = {}
    for node, exponent in factors:
        for base, power in _flattened(node, exponent):
            merged[base] = merged.get(base, 0) + power
    kept = [(node, exponent) for node, exponent in merged.items() if exponent]
    return times(coefficient, _sines_first(sorted(kept, key=_place)), decimal=decimal)


def _one_over(node: Node) -> Node | None:
    """The denominator of ½, ⅓, ... in front of an energy."""
    match node:
        case Number(1, q) if q > 1:
            return Number(q)
        case Quotient(Number(1, 1), denominator):
            return denominator
    return None


def divided(node: Node, by: Node) -> Node | None:
    """A tree over a whole number that divides all its terms, where they stand; None where it does not.

    >>> from dynsolve.notation.unicode import to_unicode
    >>> a, b = Symbol("a"), Symbol("b")
    >>> even = Sum((Product((Number(2), a)), Negative(Product((Number(4), b)))))
    >>> to_unicode(divided(Product((even, a)), Number(2))), divided(Sum((even, a)), Number(2))
    ('(a - 2b) a', None)
    """
    match node, by:
        case Number(p, 1), Number(q, 1):
            return Number(p // q) if p % q == 0 else None
        case Negative(argument), _:
            part = divided(argument, by)
            return None if part is None else negated(part)
        case Sum(terms), _:
            parts = [part for part in (divided(term, by) for term in terms) if part is not None]
            return total(parts) if len(parts) == len(terms) else None
        case Product(factors), _:
            for k, factor in enumerate(factors):
                part = divided(factor, by)
                if part is not None:
                    return times(1, [(f, 1) for f in (*factors[:k], part, *factors[k + 1 :])])
    return None


def _place(factor: tuple[Node, int]) -> tuple[int, str]:
    """Roots of numbers, lengths and masses first, rates last; between them the others as they stand."""
    match factor[0]:
        case Function("sqrt", Number()):
            return -1, ""
        case Symbol(_, 0) | Number() | Negative(Number()):
            return 0, ""
        case Symbol(name, dots):
            return 4 - dots, name
    return 1, ""


def _sines_first(factors: list[tuple[Node, int]]) -> list[tuple[Node, int]]:
    for k in range(len(factors) - 1):
        (left, _), (right, _) = factors[k : k + 2]
        if isinstance(right, Function) and right.name == "sin" and left == Function("cos", right.argument):
            factors[k : k + 2] = factors[k + 1], factors[k]
    return factors


def _flattened(node: Node, exponent: int) -> list[tuple[Node, int]]:
    """The factors of a product that stands in a product, with their exponents."""
    match node:
        case Negative(argument) if exponent == 1:
            return [(Negative(ONE), 1), *_flattened(argument, 1)]
        case Product(factors) if exponent == 1:
            return [pair for factor in factors for pair in _flattened(factor, 1)]
        case Quotient(numerator, denominator) if exponent == 1:
            return [*_flattened(numerator, 1), (denominator, -1)]
        case Power(base, Number(p, 1)):
            return [(base, p * exponent)]
    return [(node, exponent)]


# -- products of sums, multiplied out: (L₂ c₂ + l c₂₃)(L₂ s₂ + l s₂₃) as four terms where they stand
# Sums of rates are multiplied out together, into one term for each product of rates.

Factors = tuple[tuple[Node, int], ...]
"""The factors of a product, each with its exponent."""


def multiplied_out(node: Node, kept: Collection[Node] = (), *, decimal: bool = False) -> Node:
    """A tree in which products of sums of sines and cosines are sums; all else stands as it is.

    So do products of sums that are all `kept`.

    >>> from dynsolve.notation.tree import Symbol
    >>> from dynsolve.notation.unicode import to_unicode
    >>> a, b, q = map(Symbol, "abq")
    >>> s, c = Function("sin", q), Function("cos", q)
    >>> to_unicode(multiplied_out(Product((Symbol("m"), Sum((a, Product((b, c)))), Sum((c, s))))))
    'm (a cos(q) + a sin(q) + b cos²(q) + b sin(q) cos(q))'
    """
    return mapped(node, lambda part: _expanded(part, kept, decimal) if isinstance(part, Product) else part)


def _expanded(node: Product, kept: Collection[Node], decimal: bool) -> Node:
    sums = [factor for factor in node.factors if isinstance(factor, Sum) and is_trigonometric(factor)]
    if len(sums) < 2 or all(one in kept for one in sums):
        return node
    whole = total([_in_order(chosen, decimal) for chosen in product(*(each.terms for each in sums))])
    first = node.factors.index(sums[0])
    others = [factor for factor in node.factors[first:] if factor not in sums]
    factors = (*node.factors[:first], whole, *others)
    return Product(factors) if len(factors) > 1 else whole


def _in_order(terms: tuple[Node, ...], decimal: bool) -> Node:
    """The product of some terms, its sign in front: symbols, then sines, then cosines, then sums."""
    signs, bare = zip(*map(split_sign, terms), strict=True)
    factors = sorted((factor for term in bare for factor in factors_of(term)), key=_place_in_term)
    return product_of(prod(signs), [(factor, 1) for factor in factors], decimal=decimal)


def _place_in_term(factor: Node) -> tuple[int, str]:
    """Symbols by their names, then sines, then cosines, then all else as it stands."""
    match factor:
        case Symbol(name, 0):
            return 0, name.lower()
        case Function("sin" | "cos" as name):
            return (1 if name == "sin" else 2), ""
    return 3, ""


def by_rates(node: Node, *, decimal: bool = False) -> Node:
    """A sum sorted by the products of rates and accelerations, each with all that stands beside it.

    Accelerations come first; the terms in a bracket stand as they come.

    >>> from dynsolve.notation.unicode import to_unicode
    >>> a, b, c, u, q = *map(Symbol, "abc"), Symbol("u", 1), Symbol("q", 1)
    >>> terms = Product((a, Sum((u, q)), u)), Product((b, u, q)), Product((c, Symbol("u", 2)))
    >>> to_unicode(by_rates(Sum(terms)))
    'c ü + a u̇² + (a + b) q̇ u̇'
    """
    beside: dict[tuple[Node, ...], dict[Factors, Fraction]] = {}
    for term in _terms_of_rates(node):
        sign, bare = split_sign(term)
        number, moving, still = Fraction(sign), list[Node](), list[tuple[Node, int]]()
        for factor, exponent in _flattened(bare, 1):
            if isinstance(factor, Number):
                number *= Fraction(factor.p, factor.q) ** exponent
            elif has_rates(factor):
                moving += [factor] * exponent
            else:
                still.append((factor, exponent))
        counts = beside.setdefault(tuple(sorted(moving, key=_place_of_rate)), {})
        counts[tuple(still)] = counts.get(tuple(still), Fraction(0)) + number
    times = partial(product_of, decimal=decimal)
    in_order = sorted(beside, key=lambda moving: not any(_place_of_rate(part)[0] > 1 for part in moving))
    sums = []
    for key in in_order:
        bracket = total([times(n, still) for still, n in beside[key].items() if n])
        sums.append(times(1, [(bracket, 1), *((part, 1) for part in key)]))
    return total(sums)


def _terms_of_rates(node: Node) -> Iterator[Node]:
    """The terms of a tree, with its sums that hold rates multiplied out."""
    match node:
        case Sum(terms):
            for term in terms:
                yield from _terms_of_rates(term)
        case Negative(argument):
            yield from map(negated, _terms_of_rates(argument))
        case Parenthesized(argument):
            yield from _terms_of_rates(argument)
        case Power(Sum() as base, Number(exponent, 1)) if has_rates(base):
            yield from _terms_of_rates(Product((base,) * exponent))
        case Quotient(numerator, denominator) if has_rates(numerator):
            for term in _terms_of_rates(numerator):
                yield product_of(1, [(term, 1), (denominator, -1)])
        case Product(factors):
            parts = [list(_terms_of_rates(factor)) if has_rates(factor) else [factor] for factor in factors]
            for chosen in product(*parts):
                yield product_of(1, [(factor, 1) for factor in chosen])
        case _:
            yield node


def sums_of_rates(node: Node) -> set[Node]:
    """The sums q̇₁ + q̇₂ that stand in a tree; q̇₁² + q̇₁ q̇₂ is none."""
    sums = (part for part in walk(node) if isinstance(part, Sum))
    return {each for each in sums if all(map(_is_rate, each.terms))}


def _is_rate(term: Node) -> bool:
    """Whether of letters a term holds one rate alone, and that to no power."""
    parts = list(walk(term))
    symbols = [part for part in parts if isinstance(part, Symbol)]
    return len(symbols) == 1 and symbols[0].dots > 0 and not any(isinstance(part, Power) for part in parts)


def brackets(node: Node) -> set[Node]:
    """The sums that are a factor of some term, such as m l² + I beside θ̇²."""
    factors = (factor for part in walk(node) if isinstance(part, Product) for factor in part.factors)
    return {factor for factor in factors if isinstance(factor, Sum)}


def has_rates(node: Node) -> bool:
    """Whether a rate or an acceleration stands in a tree."""
    return any(isinstance(part, Symbol) and part.dots for part in walk(node))


def _place_of_rate(factor: Node) -> tuple[int, str]:
    """Rates by their names, accelerations last."""
    return max((part.dots, part.name) for part in walk(factor) if isinstance(part, Symbol))


def is_trigonometric(node: Node) -> bool:
    """Whether a sine or cosine stands in a tree."""
    return any(isinstance(part, Function) and part.name in ("sin", "cos") for part in walk(node))
