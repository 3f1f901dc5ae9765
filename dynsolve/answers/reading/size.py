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
Size = tuple[int, int, int, int]
"""Nodes, depth, terms, degree."""

_LEAVES = frozenset({Symbol, Reference, Number, Degrees})
_LEAF: Size = (1, 1, 1, 1)


def size(node: Node) -> Size:
    """Nodes, depth, terms and degree of a value; ReadError for one over the bounds of `limits`.

    >>> from dynsolve.notation.text import read
    >>> size(read("2*(a + b)^3").tree)
    (6, 4, 4, 4)
    """
    return _size(node, {}, 1)


def _size(node: Node, known: dict[int, Size], level: int) -> Size:
    """The size of a part; `known` has sizes by identity, `level` is how deep the part was met."""
    kind = type(node)
    if kind in _LEAVES or kind not in _PARTS:
        return _LEAF
    found = known.get(id(node))
    if found is None:
        if level > MAX_DEPTH:
            raise ReadError(f"this is nested over {MAX_DEPTH} levels deep", help=_HELP)
        parts, rule = _PARTS[kind]
        sizes = [_LEAF if type(part) in _LEAVES else _size(part, known, level + 1) for part in parts(node)]
        nodes, depths, terms, degrees = zip(*sizes, strict=True)
        found = known[id(node)] = _checked(1 + sum(nodes), 1 + max(depths), *rule(node, terms, degrees))
    return found


def _checked(nodes: int, depth: int, terms: int, degree: int) -> Size:
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


def _added(node: Node, terms: tuple[int, ...], degrees: tuple[int, ...]) -> tuple[int, int]:
    return sum(terms), max(degrees)


def _beside(node: Node, terms: tuple[int, ...], degrees: tuple[int, ...]) -> tuple[int, int]:
    return max(terms), max(degrees)


def _multiplied(node: Node, terms: tuple[int, ...], degrees: tuple[int, ...]) -> tuple[int, int]:
    product = 1
    for count in terms:
        if count != 1:
            product = min(product * count, MAX_TERMS + 1)
    return product, sum(degrees)


def _raised(node: Power, terms: tuple[int, ...], degrees: tuple[int, ...]) -> tuple[int, int]:
    exponent = node.exponent
    inner = exponent.argument if isinstance(exponent, Negative) else exponent
    count = inner.p if isinstance(inner, Number) else 1
    return (comb(terms[0] + count - 1, count) if count else 1), count * degrees[0]


def _opaque(node: Function, terms: tuple[int, ...], degrees: tuple[int, ...]) -> tuple[int, int]:
    return 1, 1


_Parts = Callable[[Any], Iterable[Node]]
_Rule = Callable[[Any, tuple[int, ...], tuple[int, ...]], tuple[int, int]]
_PARTS: Mapping[type[Node], tuple[_Parts, _Rule]] = {
    Sum: (lambda node: node.terms, _added),
    Product: (lambda node: node.factors, _multiplied),
    Quotient: (lambda node: (node.numerator, node.denominator), _added),
    Power: (lambda node: (node.base,), _raised),
    Negative: (lambda node: (node.argument,), _beside),
    Function: (lambda node: (node.argument,), _opaque),
    Matrix: (lambda node: [entry for row in node.rows for entry in row], _beside),
}
"""The parts of a node that count, and how its terms and its degree come from theirs."""
