"""A sum or a product exchanged for a name, wherever it stands in a formula, with either sign."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass

from dynsolve.explain.recurring import Definition
from dynsolve.explain.working.differentiation import product_of
from dynsolve.notation.build import negated, times, total
from dynsolve.notation.printing import flat_factors
from dynsolve.notation.tree import Function, Negative, Node, Product, Sum
from dynsolve.notation.walk import with_children


@dataclass(frozen=True, slots=True)
class Exchange:
    """A sum or a product, and what stands in its place.

    >>> from dynsolve.notation.python import to_python
    >>> from dynsolve.notation.tree import Symbol
    >>> a, b, c, name = map(Symbol, "abcs")
    >>> to_python(Exchange(Sum((a, b)), name).put(Product((c, Sum((a, c, b))))))
    'c*(s + c)'
    >>> to_python(Exchange(Product((a, b)), name).put(Sum((c, Negative(Product((a, c, b)))))))
    'c - s*c'
    """

    meaning: Sum | Product
    name: Node

    @classmethod
    def of(cls, definition: Definition) -> Exchange:
        """The name of a definition for its meaning."""
        assert isinstance(definition.meaning, Sum | Product)
        return cls(definition.meaning, definition.name)

    def put(self, node: Node) -> Node:
        """The tree with the name in the places of its meaning."""
        if isinstance(node, Function):  # no angle has a name
            return node
        changed = with_children(node, self.put)
        match changed:
            case Negative(argument) if changed is not node:
                return negated(argument)
            case Sum() if isinstance(self.meaning, Sum):
                return self._in_sum(changed, self.meaning)
            case Product() if isinstance(self.meaning, Product):
                return self._in_product(changed, self.meaning)
            case Product(factors) if changed is not node and any(
                isinstance(factor, Product | Negative) for factor in factors
            ):
                return product_of(1, [(factor, 1) for factor in factors])
        return changed

    def _in_sum(self, node: Sum, meaning: Sum) -> Node:
        for own, name in (
            (set(meaning.terms), self.name),
            (set(map(negated, meaning.terms)), negated(self.name)),
        ):
            if own <= set(node.terms):
                place = next(i for i, term in enumerate(node.terms) if term in own)
                rest = [term for term in node.terms if term not in own]
                before = sum(term not in own for term in node.terms[:place])
                return total([*rest[:before], name, *rest[before:]])
        return node

    def _in_product(self, node: Product, meaning: Product) -> Node:
        own, factors = Counter(flat_factors(meaning)), Counter(flat_factors(node))
        if not own <= factors:
            return node
        rest = factors - own
        return times(1, [(self.name, 1), *((factor, 1) for factor in rest.elements())])
