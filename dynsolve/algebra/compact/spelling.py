"""One sum, one spelling: in all formulas of a robot a factor that is a sum has one order and one sign.

    2(w d + a u) s₃ + (a u + w d) c₃ + (b - e) - x (e - b)  ->  2(w d + a u) s₃ + (w d + a u) c₃ + ...

A sum is found in several ways, and each leaves its terms in an order of its own.  The spelling of the first
stands for all, with a minus in front where the others had the opposite sign; but of a distance and a sine the
distance has plus, d - b s₃.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from operator import is_

from dynsolve.notation.build import negated, split_sign, total
from dynsolve.notation.tree import (
    Function,
    Negative,
    Node,
    Number,
    Power,
    Product,
    Quotient,
    Sum,
    Symbol,
    walk,
    with_children,
)


class Speller:
    """Writes formulas so that factors that are the same sum up to sign are spelled like the first of them.

    What is `given`, as a file has it, stands before the first.

    >>> from dynsolve.notation.text import read
    >>> from dynsolve.notation.unicode import to_unicode
    >>> write = Speller()
    >>> to_unicode(write(read("2*(w*d + a*u)*x + (a*u + w*d)*y - (e - b)*z + (b - e)^2*v").tree))
    '2(w d + a u) x + (w d + a u) y - (e - b) z + (e - b)² v'
    >>> to_unicode(write(read("l*(b - e)").tree))
    '-l (e - b)'
    """

    def __init__(self, given: Iterable[Sum] = ()) -> None:
        self._sums: dict[frozenset[tuple[int, Node]], Sum] = {}
        """By their terms, each a sign and the rest."""
        for one in given:
            self._sums[frozenset(map(split_sign, one.terms))] = one
        self._done: dict[int, Node] = {}

    def __call__(self, node: Node) -> Node:
        """The formula in the spelling of those before it, each part once however often it stands there."""
        self._done = {}
        return self.spelled(node)

    def spelled(self, node: Node) -> Node:
        """A part of it, the node itself where nothing in it is spelled anew."""
        if isinstance(node, Symbol | Number | Function):
            return node
        found = self._done.get(id(node))
        if found is None:
            found = self._done[id(node)] = self._spelled(node)
        return found

    def _spelled(self, node: Node) -> Node:
        match node:
            case Product(factors):
                return self._product(node, list(map(self.spelled, factors)))
            case Power(base, Number(p, 1)):
                own = self.spelled(base)
                if isinstance(own, Sum):
                    sign, first = self._like_the_first(own)
                    own = own if sign < 0 and p % 2 else first
                return node if own is base else Power(own, Number(p))
            case Negative(argument):
                own = self.spelled(argument)
                return node if own is argument else negated(own)
            case Sum(terms):
                found = list(map(self.spelled, terms))
                return node if _are_the_same(found, terms) else total(found)
            case Quotient():
                match own := with_children(node, self.spelled):
                    case Quotient(Negative(above), below):
                        return Negative(Quotient(above, below))
                return own
        return node

    def _product(self, node: Product, factors: Sequence[Node]) -> Node:
        """The product of factors, those that are sums spelled like the first of their kind."""
        sign, spelled = 1, list[Node]()
        for factor in factors:
            turned, inner = split_sign(factor)
            if isinstance(inner, Sum):
                own, inner = self._like_the_first(inner)
                turned *= own
            sign *= turned
            spelled.append(inner)
        product = node if _are_the_same(spelled, node.factors) else Product(tuple(spelled))
        return product if sign > 0 else Negative(product)

    def _like_the_first(self, node: Sum) -> tuple[int, Sum]:
        """(±1, the sum that stands first with these terms, or with their opposites)"""
        if all(isinstance(term, Negative) for term in node.terms):
            sign, found = self._like_the_first(Sum(tuple(map(negated, node.terms))))
            return -sign, found
        terms = frozenset(map(split_sign, node.terms))
        if terms in self._sums:
            return 1, self._sums[terms]
        opposite = frozenset((-sign, inner) for sign, inner in terms)
        if opposite in self._sums:
            return -1, self._sums[opposite]
        turned = _with_still_first(node)
        if turned is not None:
            self._sums[opposite] = turned
            return -1, turned
        self._sums[terms] = node
        return 1, node


def _with_still_first(node: Sum) -> Sum | None:
    """d - b s₃ of b s₃ - d: the opposite of a sum in which sines and cosines have plus, all others minus."""
    if 2 * sum(isinstance(term, Negative) for term in node.terms) != len(node.terms):
        return None
    if any(isinstance(term, Negative) is _has_angle(term) for term in node.terms):
        return None
    opposite = map(negated, node.terms)
    return Sum(tuple(sorted(opposite, key=lambda term: isinstance(term, Negative))))


def _has_angle(node: Node) -> bool:
    return any(isinstance(part, Function) for part in walk(node))


def _are_the_same(some: Sequence[Node], others: Sequence[Node]) -> bool:
    return all(map(is_, some, others))
