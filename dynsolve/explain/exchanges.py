"""A part of formulas exchanged for its name, wherever it stands, with either sign."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass
from fractions import Fraction

from dynsolve.explain.recurring import Definition
from dynsolve.explain.working.differentiation import product_of
from dynsolve.notation.build import negated, split_sign, times, total
from dynsolve.notation.printing import flat_factors
from dynsolve.notation.tree import Function, Negative, Node, Number, Product, Quotient, Sum
from dynsolve.notation.walk import with_children

_Monomial = tuple[Fraction, Counter[Node]]
"""A number and factors, each with how often it stands above the line, or (negative) below."""


@dataclass(frozen=True, slots=True)
class Exchange:
    """A formula, and what stands in its place: of a sum also among more terms, of others among factors.

    >>> from dynsolve.notation.python import to_python
    >>> from dynsolve.notation.tree import Symbol
    >>> a, b, c, name = map(Symbol, "abcs")
    >>> to_python(Exchange(Sum((a, b)), name).put(Product((c, Sum((a, c, b))))))
    'c*(s + c)'
    >>> to_python(Exchange(Product((a, b)), name).put(Sum((c, Negative(Product((a, c, b)))))))
    'c - s*c'
    >>> to_python(Exchange(Quotient(a, Number(2)), name).put(Quotient(Product((a, b)), Number(4))))
    's*b/2'
    """

    meaning: Node
    name: Node

    @classmethod
    def of(cls, definition: Definition) -> Exchange:
        """The name of a definition for its meaning."""
        sign, meaning = split_sign(definition.meaning)
        return cls(meaning, definition.name if sign > 0 else Negative(definition.name))

    def put(self, node: Node) -> Node:
        """The tree with the name in the places of its meaning."""
        if isinstance(node, Function):  # no angle has a name
            return node
        if node == self.meaning:
            return self.name
        changed = with_children(node, self.put)
        match changed:
            case Negative(argument) if changed is not node:
                return negated(argument)
            case Sum() if isinstance(self.meaning, Sum):
                return self._in_sum(changed, self.meaning)
            case Product() | Quotient() if not isinstance(self.meaning, Sum):
                return self._in_product(changed)
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

    def _in_product(self, node: Product | Quotient) -> Node:
        """What is left beside the name, where the meaning divides the node without a new fraction."""
        (own_number, own), (number, factors) = _monomial(self.meaning), _monomial(node)
        parts_out = all(abs(factors[part]) >= abs(n) and factors[part] * n > 0 for part, n in own.items())
        parts_out &= not (
            number.numerator % own_number.numerator or number.denominator % own_number.denominator
        )
        if not parts_out:
            return node
        factors.subtract(own)
        return times(number / own_number, [(self.name, 1), *((part, n) for part, n in factors.items() if n)])


def _monomial(node: Node) -> _Monomial:
    match node:
        case Number(p, q):
            return Fraction(p, q), Counter()
        case Negative(argument):
            number, factors = _monomial(argument)
            return -number, factors
        case Quotient(numerator, denominator):
            above, factors = _monomial(numerator)
            below, others = _monomial(denominator)
            factors.subtract(others)
            return above / below, factors
        case Product():
            number, factors = Fraction(1), Counter[Node]()
            for part in flat_factors(node):
                own, its = _monomial(part)
                number *= own
                factors.update(its)
            return number, factors
    return Fraction(1), Counter([node])
