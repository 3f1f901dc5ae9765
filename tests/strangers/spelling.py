"""How formulas are written: what no book prints, found in the trees of results and of a report.

Values are not looked at: they are held by `oracle`.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from fractions import Fraction
from typing import Any

from dynsolve.notation import tree
from dynsolve.notation.tree import Node, Number, walk
from dynsolve.quantities.letters import HALF

CO_FUNCTION = {"sin": "cos", "cos": "sin"}


def misspelled(forms: Iterable[Node]) -> Iterator[tuple[str, Node]]:
    """(what is wrong, where) in the forms of one robot's results."""
    met: dict[frozenset[Node], Node] = {}
    for node in walk(*forms):
        match node:
            case tree.Product() | tree.Quotient():
                if _keeps_fractions(node):
                    yield "a number before a sum that keeps fractions", node
                if _is_drawn_out(node):
                    yield "a decimal drawn out of a sum", node
                if isinstance(node, tree.Product) and any(map(_is_misplaced, node.factors, node.factors[1:])):
                    yield "a number behind a factor", node
                for factor in _factors(node):
                    if isinstance(factor, tree.Sum) and not _turns_or_moves(factor):
                        if (other := met.get(frozenset(map(_negated, factor.terms)))) is not None:
                            yield "a sum and its negative", tree.Row((factor, other))
                        met[frozenset(factor.terms)] = factor
            case tree.Sum(terms) if _is_one_sine(terms):
                yield "the sine or cosine of a sum", node
            case tree.Sum(terms) if _has_acceleration_last(terms):
                yield "an acceleration behind what has none", node
            case tree.BigSum(_, _, lower, upper) if lower == upper:
                yield "a sum of one term", node
            case tree.Power(Number(1, 1)):
                yield "a power of 1", node


def _is_misplaced(before: tree.Node, factor: tree.Node) -> bool:
    """Whether a factor is a number behind another one, unless it is a decimal of D: ½·0.25 m q̇²."""
    return isinstance(factor, Number) and not (factor.decimal and before == HALF)


def _keeps_fractions(node: Node) -> bool:
    """Twice a sum, as a derivative has it, and half of one, as an energy, may."""
    front = abs(_number(node))
    if front in (1, Fraction(1, 2)) or any(isinstance(n, Number) and n.decimal for n in walk(node)):
        return False
    sums = [factor for factor in _factors(node) if isinstance(factor, tree.Sum)]
    below = [{_number(term).denominator for term in each.terms} - {1} for each in sums]
    return any(each and (front != 2 or each == {2}) for each in below)


def _is_drawn_out(node: Node) -> bool:
    """Whether a decimal stands before a sum that has whole numbers by that, 0.5 (3 + m) or k (20r - 7)/40.

    Rates may be told together, 0.4 (2q̇₁ q̇₂ + q̇₂²).
    """
    if _number(node).denominator % 5 and not any(isinstance(n, Number) and n.decimal for n in walk(node)):
        return False
    for factor in _factors(node):
        base = factor.base if isinstance(factor, tree.Power) else factor
        if isinstance(base, tree.Sum) and _number(node).denominator != 1:
            sizes = {abs(_number(term)) for term in base.terms}
            whole = all(size.denominator == 1 for size in sizes)
            if whole and sizes - ({1, 2} if all(map(_turns_or_moves, base.terms)) else {1}):
                return True
    return False


def _number(node: Node) -> Fraction:
    """The number in a product."""
    match node:
        case Number(p, q):
            return Fraction(p, q)
        case tree.Negative(inner):
            return -_number(inner)
        case tree.Quotient(above, below):
            return _number(above) / _number(below)
        case tree.Product(factors):
            value = Fraction(1)
            for factor in factors:
                value *= _number(factor)
            return value
    return Fraction(1)


def _factors(node: Node) -> list[Node]:
    """The factors above the line, without numbers."""
    match node:
        case tree.Negative(inner) | tree.Quotient(inner):
            return _factors(inner)
        case tree.Product(factors):
            return [f for factor in factors for f in _factors(factor)]
        case Number():
            return []
    return [node]


def _negated(node: Node) -> Node:
    return node.argument if isinstance(node, tree.Negative) else tree.Negative(node)


def _turns_or_moves(node: Node) -> bool:
    return any(
        (isinstance(n, tree.Function) and n.name in CO_FUNCTION) or (isinstance(n, tree.Symbol) and n.dots)
        for n in walk(node)
    )


def _has_acceleration_last(terms: tuple[Node, ...]) -> bool:
    """Whether the terms with accelerations are not the first."""
    accelerated = [any(isinstance(n, tree.Symbol) and n.dots == 2 for n in walk(term)) for term in terms]
    return accelerated != sorted(accelerated, reverse=True)


def _is_one_sine(terms: tuple[Node, ...]) -> bool:
    """Whether two terms are sin a cos b and cos a sin b, or cos a cos b and sin a sin b, with one factor."""
    met: set[Any] = set()
    for term in terms:
        factors = _factors(term)
        angles = [f for f in factors if isinstance(f, tree.Function) and f.name in CO_FUNCTION]
        if len(angles) == 2 and angles[0].argument != angles[1].argument:
            key = tuple(f for f in factors if f not in angles), abs(_number(term))
            if (*key, frozenset((CO_FUNCTION[f.name], f.argument) for f in angles)) in met:
                return True
            met.add((*key, frozenset((f.name, f.argument) for f in angles)))
    return False
