"""How large a value is when its abbreviations are written out and its products multiplied out.

Trees share parts, so every part is measured once: ten lines of `a = b b` name a tree
of a thousand leaves.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from math import comb
from typing import Any

from dynsolve.answers.reading.limits import MAX_DEGREE, MAX_NODES, MAX_TERMS
from dynsolve.errors import ReadError
from dynsolve.notation.bounds import MAX_DEPTH
from dynsolve.notation.tree import (
    Degrees,
    Function,
    Matrix,
    Negative,
    Node,
    Number,
    Power,
    Product,
    Quotient,
    Reference,
    Sum,
    Symbol,
)

_HELP = "write it shorter, or as a sum of its terms"
Measure = tuple[int, int, int, int]
"""Nodes, depth, terms, degree."""

_LEAVES = frozenset({Symbol, Reference, Number, Degrees})
_LEAF: Measure = (1, 1, 1, 1)


def measured(node: Node, known: dict[int, Measure], level: int = 1) -> Measure:
    """The measure of a part; `known` has measures by identity, `level` is how deep it was met.

    Raises ReadError for a value over the bounds of `limits`.
    """
    kind = type(node)
    if kind in _LEAVES:
        return _LEAF
    found = known.get(id(node))
    if found is None:
        if level > MAX_DEPTH:
            raise ReadError(f"this is nested over {MAX_DEPTH} levels deep", help=_HELP)
        rule = _RULES.get(kind, _leaf)
        parts = [measured(child, known, level + 1) for child in _CHILDREN.get(kind, _none)(node)]
        found = known[id(node)] = _checked(
            1 + sum(part[0] for part in parts),
            1 + max((part[1] for part in parts), default=0),
            *rule(node, parts),
        )
    return found


def _checked(nodes: int, depth: int, terms: int, degree: int) -> Measure:
    if nodes > MAX_NODES:
        raise ReadError(
            f"this is too large: over {MAX_NODES} signs when its abbreviations are written out", help=_HELP
        )
    if depth > MAX_DEPTH:
        raise ReadError(f"this is nested over {MAX_DEPTH} levels deep", help=_HELP)
    if terms > MAX_TERMS:
        raise ReadError(f"this is too large: multiplied out it would have over {MAX_TERMS} terms", help=_HELP)
    if degree > MAX_DEGREE:
        raise ReadError(f"this is too large: it holds powers over {MAX_DEGREE}", help=_HELP)
    return nodes, depth, terms, degree


def _none(node: Node) -> tuple[Node, ...]:
    return ()


_CHILDREN: Mapping[type[Node], Callable[[Any], Iterable[Node]]] = {
    Sum: lambda node: node.terms,
    Product: lambda node: node.factors,
    Quotient: lambda node: (node.numerator, node.denominator),
    Power: lambda node: (node.base,),
    Negative: lambda node: (node.argument,),
    Function: lambda node: (node.argument,),
    Matrix: lambda node: [entry for row in node.rows for entry in row],
}


def _leaf(node: Node, parts: list[Measure]) -> tuple[int, int]:
    return 1, 1


def _added(node: Node, parts: list[Measure]) -> tuple[int, int]:
    return sum(part[2] for part in parts), max(part[3] for part in parts)


def _beside(node: Node, parts: list[Measure]) -> tuple[int, int]:
    return max(part[2] for part in parts), max(part[3] for part in parts)


def _multiplied(node: Node, parts: list[Measure]) -> tuple[int, int]:
    terms = 1
    for part in parts:
        if part[2] != 1:
            terms = min(terms * part[2], MAX_TERMS + 1)
    return terms, sum(part[3] for part in parts)


def _raised(node: Power, parts: list[Measure]) -> tuple[int, int]:
    exponent = node.exponent
    inner = exponent.argument if isinstance(exponent, Negative) else exponent
    count = inner.p if isinstance(inner, Number) else 1
    return (comb(parts[0][2] + count - 1, count) if count else 1), count * parts[0][3]


_RULES: Mapping[type[Node], Callable[[Any, list[Measure]], tuple[int, int]]] = {
    Sum: _added,
    Quotient: _added,
    Matrix: _beside,
    Negative: _beside,
    Product: _multiplied,
    Power: _raised,
}
