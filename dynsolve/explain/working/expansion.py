"""Products of sums, multiplied out where they stand: (L₂ c₂ + l c₂₃)(L₂ s₂ + l s₂₃) as four terms."""

from __future__ import annotations

from itertools import product

from dynsolve.explain.working.differentiation import product_of
from dynsolve.notation.build import negated, split_sign, total
from dynsolve.notation.tree import Function, Node, Product, Sum, Symbol
from dynsolve.notation.walk import mapped, walk


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


def is_trigonometric(node: Node) -> bool:
    """Whether a sine or cosine stands in a tree."""
    return any(isinstance(part, Function) and part.name in ("sin", "cos") for part in walk(node))
