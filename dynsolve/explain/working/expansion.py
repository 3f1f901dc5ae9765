"""Products of sums, multiplied out: (L₂ c₂ + l c₂₃)(L₂ s₂ + l s₂₃) as four terms where they stand.

Sums of rates are multiplied out together, into one term for each product of rates.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from fractions import Fraction
from itertools import product

from dynsolve.explain.working.differentiation import product_of
from dynsolve.notation.build import factors_of, negated, split_sign, total
from dynsolve.notation.tree import (
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
)
from dynsolve.notation.walk import mapped, walk

Factors = tuple[tuple[Node, int], ...]
"""The factors of a product, each with its exponent."""


def multiplied_out(node: Node, *, decimal: bool = False) -> Node:
    """A tree in which products of sums of sines and cosines are sums; all else stands as it is.

    >>> from dynsolve.notation.tree import Symbol
    >>> from dynsolve.notation.unicode import to_unicode
    >>> a, b, q = map(Symbol, "abq")
    >>> s, c = Function("sin", q), Function("cos", q)
    >>> to_unicode(multiplied_out(Product((Symbol("m"), Sum((a, Product((b, c)))), Sum((c, s))))))
    'm (a cos(q) + a sin(q) + b cos²(q) + b sin(q) cos(q))'
    """
    return mapped(node, lambda part: _expanded(part, decimal) if isinstance(part, Product) else part)


def _expanded(node: Product, decimal: bool) -> Node:
    sums = [factor for factor in node.factors if isinstance(factor, Sum) and is_trigonometric(factor)]
    if len(sums) < 2:
        return node
    terms = [in_order(chosen, decimal) for chosen in product(*(each.terms for each in sums))]
    first = node.factors.index(sums[0])
    before = tuple(factor for factor in node.factors[:first])
    after = tuple(factor for factor in node.factors[first:] if factor not in sums)
    return Product((*before, total(terms), *after)) if before or after else total(terms)


def in_order(terms: tuple[Node, ...], decimal: bool) -> Node:
    """The product of some terms, its sign in front: symbols, then sines, then cosines, then sums."""
    signs, bare = zip(*map(split_sign, terms), strict=True)
    factors = [factor for term in bare for factor in (term.factors if isinstance(term, Product) else (term,))]
    found = product_of(1, [(factor, 1) for factor in sorted(factors, key=_place)], decimal=decimal)
    return negated(found) if signs.count(-1) % 2 else found


def _place(factor: Node) -> tuple[int, str]:
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
        factors = [pair for factor in factors_of(bare) for pair in _over_its_denominator(factor)]
        moving = tuple(sorted((factor for factor, _ in factors if has_rates(factor)), key=_place_of_rate))
        number, still = _number_and_factors(pair for pair in factors if not has_rates(pair[0]))
        counts = beside.setdefault(moving, {})
        counts[still] = counts.get(still, Fraction(0)) + sign * number
    ordered = sorted(beside, key=lambda moving: not any(_is_acceleration(part) for part in moving))
    brackets = {
        key: total([product_of(n, still, decimal=decimal) for still, n in beside[key].items() if n])
        for key in ordered
    }
    return total([product_of(1, [(brackets[key], 1), *((part, 1) for part in key)]) for key in ordered])


def _number_and_factors(pairs: Iterable[tuple[Node, int]]) -> tuple[Fraction, Factors]:
    """The numbers among some factors as one, and the others."""
    number, others = Fraction(1), []
    for node, exponent in pairs:
        if isinstance(node, Number):
            number *= Fraction(node.p, node.q) ** exponent
        else:
            others.append((node, exponent))
    return number, tuple(others)


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
                signs, bare = zip(*map(split_sign, chosen), strict=True)
                merged = product_of(1, [(factor, 1) for factor in bare])
                yield negated(merged) if signs.count(-1) % 2 else merged
        case _:
            yield node


def _over_its_denominator(factor: Node) -> list[tuple[Node, int]]:
    """The factors of a fraction with their exponents, so that rates above its line stand for themselves."""
    match factor:
        case Quotient(numerator, denominator):
            return [*((each, 1) for each in factors_of(numerator)), (denominator, -1)]
    return [(factor, 1)]


def sums_of_rates(node: Node) -> set[Node]:
    """The sums q̇₁ + q̇₂ that stand in a tree."""
    sums = (part for part in walk(node) if isinstance(part, Sum))
    return {each for each in sums if all(part.dots for part in walk(each) if isinstance(part, Symbol))}


def brackets(node: Node) -> set[Node]:
    """The sums that are a factor of some term, such as m l² + I beside θ̇²."""
    factors = (factor for part in walk(node) if isinstance(part, Product) for factor in part.factors)
    return {factor for factor in factors if isinstance(factor, Sum)}


def has_rates(node: Node) -> bool:
    """Whether a rate or an acceleration stands in a tree."""
    return any(isinstance(part, Symbol) and part.dots for part in walk(node))


def _is_acceleration(node: Node) -> bool:
    return any(isinstance(part, Symbol) and part.dots > 1 for part in walk(node))


def _place_of_rate(factor: Node) -> tuple[int, str]:
    """Rates by their names, accelerations last."""
    return max((part.dots, part.name) for part in walk(factor) if isinstance(part, Symbol))


def is_trigonometric(node: Node) -> bool:
    """Whether a sine or cosine stands in a tree."""
    return any(isinstance(part, Function) and part.name in ("sin", "cos") for part in walk(node))
