"""How formulas are written: what no book prints, found in the formula trees of a report.

`misspelled(blocks, style)` gives the kind and the place of each; values are not looked at.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from fractions import Fraction
from functools import reduce
from operator import and_
from typing import Any

from dynsolve.notation import tree
from dynsolve.notation.printing import Style, flat_factors, shorthand
from dynsolve.notation.tree import Node, Number
from dynsolve.notation.unicode import UnicodePrinter
from dynsolve.notation.walk import walk
from tests.strangers.oracle import relations

HALF = Fraction(1, 2)
_SINE = {"sin", "cos"}


def misspelled(blocks: Any, style: Style) -> Iterator[tuple[str, str, str]]:
    """(kind, step, formula) of what is not written as books write it."""
    printer = UnicodePrinter(style)
    turned: dict[Node, Node] = {}
    lines: Counter[tuple[str, Node]] = Counter()
    styled: dict[bool, str] = {}
    for where, relation in relations(blocks):
        lines[where, relation] += 1
        if lines[where, relation] == 2 and _is_a_line(relation):
            yield "line twice", where, printer.text(relation)
        for node in walk(relation):
            for kind in _kinds(node):
                yield kind, where, printer.text(node)
            if isinstance(node, tree.Function) and node.name in _SINE and style.shorthand:
                styled.setdefault(shorthand(node, style) is not None, printer.text(node))
        last = relation.parts[-1]
        for node in walk(last):
            for kind in _kinds_of_results(node):
                yield kind, where, printer.text(node)
            for factor in _factors(node) if isinstance(node, tree.Product | tree.Quotient) else ():
                if isinstance(factor, tree.Sum) and _is_scalar(factor) and not _turns(factor):
                    opposite = frozenset(map(_negated, factor.terms))
                    if opposite in turned:
                        yield (
                            "opposite",
                            where,
                            f"{printer.text(factor)} after {printer.text(turned[opposite])}",
                        )
                    turned.setdefault(frozenset(factor.terms), factor)
        rounded = [any(isinstance(n, Number) and style.rounds(n) for n in walk(p)) for p in relation.parts]
        for i, sign in enumerate(relation.signs):
            if sign == "=" and (rounded[i] or rounded[i + 1]):
                yield "rounded behind =", where, printer.text(relation)
    if len(styled) == 2:
        yield "cos(q) beside c", "", f"{styled[True]} and {styled[False]}"


def _is_a_line(relation: tree.Relation) -> bool:
    return len(relation.parts) > 1 and any(isinstance(n, tree.Sum | tree.Product) for n in walk(relation))


def _is_sum_of_symbols(node: Node) -> bool:
    terms = node.terms if isinstance(node, tree.Sum) else (node,)
    return all(isinstance(term, tree.Symbol) for term in terms)


def _negated(node: Node) -> Node:
    return node.argument if isinstance(node, tree.Negative) else tree.Negative(node)


def number_of(node: Node) -> Fraction:
    """The number in front of a product."""
    match node:
        case Number(p, q):
            return Fraction(p, q)
        case tree.Negative(inner):
            return -number_of(inner)
        case tree.Quotient(above, below):
            return number_of(above) / number_of(below)
        case tree.Product(factors):
            value = Fraction(1)
            for factor in factors:
                value *= number_of(factor)
            return value
    return Fraction(1)


def _factors(node: Node) -> list[Node]:
    """The factors of a term above the line, without numbers."""
    match node:
        case tree.Negative(inner):
            return _factors(inner)
        case tree.Quotient(above, _):
            return _factors(above)
        case tree.Product(factors):
            return [f for factor in factors for f in _factors(factor)]
        case Number():
            return []
    return [node]


def _powers(term: Node) -> Counter[Node]:
    found: Counter[Node] = Counter()
    for factor in _factors(term):
        match factor:
            case tree.Power(base, Number(p, 1)):
                found[base] += p
            case _:
                found[factor] += 1
    return found


def _is_scalar(node: Node) -> bool:
    return not any(
        isinstance(n, tree.Letter | tree.Matrix | tree.BigSum | tree.Derivative) for n in walk(node)
    )


def _kinds(node: Node) -> Iterator[str]:
    match node:
        case tree.Product() | tree.Quotient():
            front = number_of(node)
            plain = flat_factors(node) if isinstance(node, tree.Product) else ()
            if any(isinstance(f, Number) for f in plain[1:]):
                yield "number behind a factor"
            decimal = any(isinstance(f, Number) and f.decimal for f in walk(node))
            if abs(front) not in (1, HALF) and not decimal:
                for factor in _factors(node):
                    if isinstance(factor, tree.Sum) and _is_scalar(factor):
                        below = {number_of(t).denominator for t in factor.terms} - {1}
                        if below and (abs(front) != 2 or below == {2}):
                            yield "fractions in a sum with a number before it"
        case tree.Power(Number(1, 1), _):
            yield "power of 1"
        case tree.BigSum(_, _, lower, upper) if lower == upper:
            yield "sum from 1 to 1"


def _kinds_of_results(node: Node) -> Iterator[str]:
    match node:
        case tree.Sum(terms) if _is_scalar(node) and len(terms) > 1 and not _moves(node):
            shared = reduce(and_, map(_powers, terms))
            shared = {a: e for a, e in shared.items() if a != tree.Symbol("g")}
            if shared:
                same = all(len({_powers(t)[a] for t in terms}) == 1 for a in shared)
                yield "common factor" if same else "common factor, squared in one"
            yield from _addition(terms)


def _turns(node: Node) -> bool:
    return any(isinstance(n, tree.Function) and n.name in _SINE for n in walk(node))


def _moves(node: Node) -> bool:
    return any(isinstance(n, tree.Symbol) and n.dots for n in walk(node))


def _addition(terms: tuple[Node, ...]) -> Iterator[str]:
    """sin a cos b ± cos a sin b with one coefficient."""
    seen: dict[Any, set[Any]] = {}
    for term in terms:
        trig = [f for f in _factors(term) if isinstance(f, tree.Function) and f.name in _SINE]
        rest = tuple(f for f in _factors(term) if f not in trig)
        if len(trig) == 2 and trig[0].argument != trig[1].argument:
            key = frozenset(t.argument for t in trig), rest, abs(number_of(term))
            kinds = frozenset((t.name, t.argument) for t in trig)
            opposite = frozenset(("cos" if n == "sin" else "sin", a) for n, a in kinds)
            if opposite in seen.setdefault(key, set()):
                yield "addition theorem"
            seen[key].add(kinds)
