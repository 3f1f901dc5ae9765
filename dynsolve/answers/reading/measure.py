"""How large a value is when its abbreviations are written out and its products multiplied out.

Trees share parts, so every part is measured once: ten lines of `a = b b` name a tree
of a thousand leaves.
"""

from __future__ import annotations

from collections.abc import Iterable
from math import comb

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
    Sum,
    Symbol,
)

_HELP = "write it shorter, or as a sum of its terms"
_Measure = tuple[int, int, int, int]
"""Nodes, depth, terms, degree."""


_LEAVES = frozenset({Symbol, Number, Degrees})
_LEAF: _Measure = (1, 1, 1, 1)


def check(node: Node, known: dict[int, _Measure] | None = None) -> None:
    """Raise ReadError for a value over the bounds of `limits`."""
    measures: dict[int, _Measure] = {} if known is None else known
    waiting: list[Node] = [node]
    nodes = 0
    while waiting:
        part = waiting[-1]
        if id(part) in measures:
            waiting.pop()
            continue
        children = _children(part)
        missing = [child for child in children if type(child) not in _LEAVES and id(child) not in measures]
        if missing:
            waiting += missing
            nodes += len(missing)
            if nodes > 20 * MAX_NODES or len(waiting) > 20 * MAX_NODES:
                raise ReadError("this is too large", help=_HELP)
            continue
        waiting.pop()
        measures[id(part)] = _checked(_measured(part, [measures.get(id(child), _LEAF) for child in children]))


def _checked(measure: _Measure) -> _Measure:
    nodes, depth, terms, degree = measure
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
    return measure


def _children(node: Node) -> Iterable[Node]:
    match node:
        case Sum(terms):
            return terms
        case Product(factors):
            return factors
        case Quotient(numerator, denominator):
            return (numerator, denominator)
        case Power(base, _):
            return (base,)
        case Negative(argument) | Function(_, argument):
            return (argument,)
        case Matrix(rows):
            return [entry for row in rows for entry in row]
    return ()


def _measured(node: Node, parts: list[_Measure]) -> _Measure:
    nodes = 1 + sum(part[0] for part in parts)
    depth = 1 + max((part[1] for part in parts), default=0)
    terms, degree = 1, 1
    match node:
        case Sum() | Quotient():
            terms, degree = sum(p[2] for p in parts), max(p[3] for p in parts)
        case Matrix():
            terms, degree = max(p[2] for p in parts), max(p[3] for p in parts)
        case Product():
            for part in parts:
                terms = min(terms * part[2], MAX_TERMS + 1)
            degree = sum(p[3] for p in parts)
        case Power(_, exponent):
            inner = exponent.argument if isinstance(exponent, Negative) else exponent
            count = inner.p if isinstance(inner, Number) else 1
            terms, degree = comb(parts[0][2] + count - 1, count) if count else 1, count * parts[0][3]
        case Negative():
            terms, degree = parts[0][2:]
    return nodes, depth, terms, degree
