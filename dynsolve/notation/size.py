"""How large a formula is, known from its tree alone, before anything is multiplied out.

A text of fifteen characters, (a+b+c+d)^20^20, can ask for more work than a machine has, and
ten lines of `a = b b` name a tree of a thousand leaves.  So a tree is measured before it is
evaluated; parts that stand in several places are measured once.  How much is too much, and
what is said about it, is up to the reader: what stands at the end of this file for the formulas
of problem files, `answers.reading.grids` and `answers.reading.sources` for those of hand-ins.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from math import comb
from typing import Any, NamedTuple

from dynsolve.errors import ReadError
from dynsolve.notation.tree import (
    Arguments,
    Degrees,
    Function,
    Matrix,
    Negative,
    Node,
    Number,
    Parenthesized,
    Power,
    Product,
    Quotient,
    Reference,
    Sum,
    Symbol,
    children,
)

_BITS = 32
"""A number counts as a factor more for each so many bits."""

_UNKNOWN_EXPONENT = 20


class Size(NamedTuple):
    """The size of a formula, or a bound on it.

    `nodes` are those of the tree, shared parts counted wherever they stand; `depth` is its
    height; `terms` and `degree` are upper bounds of those of the formula multiplied out.
    """

    nodes: int
    depth: int
    terms: int
    degree: int


class TooLargeError(Exception):
    """A formula is over a bound; `measure` is the field of `Size` in which it is."""

    def __init__(self, measure: str) -> None:
        super().__init__(measure)
        self.measure = measure


def size(node: Node, most: Size) -> Size:
    """The size of a formula of at most a certain size; raises TooLargeError for a larger one.

    >>> from dynsolve.notation.text import read
    >>> size(read("2*(a + b)^3").tree, Size(100, 10, 100, 100))
    Size(nodes=7, depth=4, terms=4, degree=4)
    """
    return Size(*_size(node, {}, 1, most))


_Plain = tuple[int, int, int, int]
_LEAF: _Plain = (1, 1, 1, 1)
_LEAVES = frozenset({Symbol, Reference})


def _size(node: Node, known: dict[int, _Plain], level: int, most: Size) -> _Plain:
    """The size of a part; `known` has sizes by identity, `level` is how deep the part was met."""
    kind = type(node)
    if isinstance(node, Number | Degrees):
        return 1, 1, 1, 1 + (node.p.bit_length() + node.q.bit_length()) // _BITS
    if kind not in _RULES:
        return _LEAF
    found = known.get(id(node))
    if found is None:
        if level > most.depth:
            raise TooLargeError("depth")
        sizes = [_LEAF if type(p) in _LEAVES else _size(p, known, level + 1, most) for p in children(node)]
        if not sizes:  # a matrix without entries
            return _LEAF
        nodes, depths, terms, degrees = zip(*sizes, strict=True)
        found = 1 + sum(nodes), 1 + max(depths), *_RULES[kind](node, terms, degrees, most)
        if found[0] > most[0] or found[1] > most[1] or found[2] > most[2] or found[3] > most[3]:
            raise TooLargeError(next(m for m, a, b in zip(Size._fields, found, most, strict=True) if a > b))
        known[id(node)] = found
    return found


_Counts = tuple[int, ...]


def _added(node: Node, terms: _Counts, degrees: _Counts, most: Size) -> tuple[int, int]:
    return sum(terms), max(degrees)


def _beside(node: Node, terms: _Counts, degrees: _Counts, most: Size) -> tuple[int, int]:
    return max(terms), max(degrees)


def _multiplied(node: Node, terms: _Counts, degrees: _Counts, most: Size) -> tuple[int, int]:
    product = 1
    for count in terms:
        if count != 1:
            product = min(product * count, most.terms + 1)
    return product, sum(degrees)


def _raised(node: Power, terms: _Counts, degrees: _Counts, most: Size) -> tuple[int, int]:
    exponent = node.exponent
    inner = exponent.argument if isinstance(exponent, Negative) else exponent
    count = inner.p if isinstance(inner, Number) else _UNKNOWN_EXPONENT
    return (comb(terms[0] + count - 1, count) if count else 1), count * degrees[0]


def _applied(node: Function, terms: _Counts, degrees: _Counts, most: Size) -> tuple[int, int]:
    """One term; but the square of a root has those that are under it."""
    return (terms[0], degrees[0]) if node.name == "sqrt" else (1, 1)


_RULES: Mapping[type[Node], Callable[[Any, _Counts, _Counts, Size], tuple[int, int]]] = {
    Sum: _added,
    Product: _multiplied,
    Quotient: _added,
    Power: _raised,
    Negative: _beside,
    Parenthesized: _beside,
    Arguments: _added,
    Function: _applied,
    Matrix: _beside,
}
"""How the terms and the degree of a node come from those of its parts; every other node is a leaf."""


# How large a formula of a problem file may be

MAX_LENGTH = 10_000
MAX_NESTING = 50
MAX_DIGITS = 60
MAX_EXPONENT = 20
MAX_DEPTH = 100
MAX_TERMS = 20_000
MAX_DEGREE = 100


_MOST = Size(nodes=4 * MAX_LENGTH, depth=MAX_DEPTH, terms=MAX_TERMS, degree=MAX_DEGREE)
_NAME = "name a part of it with a symbol of its own"
_SAID = {
    "nodes": ("this is too large: it has too many parts", _NAME),
    "depth": ("this is nested too deeply", "write it in fewer levels of / and parentheses"),
    "terms": (f"this is too large: multiplied out it would have over {MAX_TERMS} terms", _NAME),
    "degree": (f"this is too large: multiplied out it would have powers over {MAX_DEGREE}", _NAME),
}


def check_size(tree: Node, length: int = 1) -> None:
    """Raise ReadError for a tree that is too deep, or too large when multiplied out.

    `length` is that of the text it was read from, for the error.
    """
    try:
        size(tree, _MOST)
    except TooLargeError as error:
        message, help = _SAID[error.measure]
        raise ReadError(message, 0, length, help) from None
