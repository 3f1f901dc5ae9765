"""One sum, one spelling: within a formula a factor that is a sum has one order of terms and one sign.

    2(w d + a u) s₃ + (a u + w d) c₃ + (b - e) - x (e - b)  ->  2(w d + a u) s₃ + (w d + a u) c₃ + ...

A sum is found in several ways, and each leaves its terms in an order of its own.  The spelling of the first
stands for all, with a minus in front where the others had the opposite sign.
"""

from __future__ import annotations

from collections.abc import Sequence

from dynsolve.notation.build import negated, split_sign, total
from dynsolve.notation.tree import Negative, Node, Number, Power, Product, Quotient, Sum, with_children

Spelled = dict[frozenset[tuple[int, Node]], Sum]
"""Sums by their terms, each a sign and the rest."""


def in_one_spelling(node: Node) -> Node:
    """A formula whose factors that are the same sum up to sign are spelled like the first of them.

    >>> from dynsolve.notation.text import read
    >>> from dynsolve.notation.unicode import to_unicode
    >>> to_unicode(in_one_spelling(read("2*(w*d + a*u)*x + (a*u + w*d)*y - (e - b)*z + (b - e)^2*v").tree))
    '2(w d + a u) x + (w d + a u) y - (e - b) z + (e - b)² v'
    """
    return _spelled(node, {})


def _spelled(node: Node, known: Spelled) -> Node:
    """The node itself where nothing in it is spelled anew."""
    match node:
        case Product(factors):
            return _product(node, [_spelled(factor, known) for factor in factors], known)
        case Power(base, Number(p, 1)):
            own = _spelled(base, known)
            if isinstance(own, Sum):
                sign, first = _like_the_first(own, known)
                own = own if sign < 0 and p % 2 else first
            return node if own is base else Power(own, Number(p))
        case Negative(argument):
            own = _spelled(argument, known)
            return node if own is argument else negated(own)
        case Sum(terms):
            found = [_spelled(term, known) for term in terms]
            return node if _are_the_same(found, terms) else total(found)
        case Quotient():
            return with_children(node, lambda part: _spelled(part, known))
    return node


def _product(node: Product, factors: Sequence[Node], known: Spelled) -> Node:
    """The product of factors, those that are sums spelled like the first of their kind."""
    sign, spelled = 1, list[Node]()
    for factor in factors:
        turned, inner = split_sign(factor)
        if isinstance(inner, Sum):
            own, inner = _like_the_first(inner, known)
            turned *= own
        sign *= turned
        spelled.append(inner)
    product = node if _are_the_same(spelled, node.factors) else Product(tuple(spelled))
    return product if sign > 0 else Negative(product)


def _are_the_same(some: Sequence[Node], others: Sequence[Node]) -> bool:
    return all(one is other for one, other in zip(some, others, strict=True))


def _like_the_first(node: Sum, known: Spelled) -> tuple[int, Sum]:
    """(±1, the sum that stands first with these terms, or with their opposites)"""
    if all(isinstance(term, Negative) for term in node.terms):
        sign, found = _like_the_first(Sum(tuple(map(negated, node.terms))), known)
        return -sign, found
    terms = frozenset(map(split_sign, node.terms))
    opposite = frozenset((-sign, inner) for sign, inner in terms)
    if opposite in known:
        return -1, known[opposite]
    return 1, known.setdefault(terms, node)
