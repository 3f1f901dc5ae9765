"""Formulas of sets and branches: read, and asked which coordinates and names stand in them."""

from __future__ import annotations

import re

from dynsolve.answers.reading.displays import chain
from dynsolve.answers.reading.right_side import RightSide, read_right_side
from dynsolve.answers.reading.tokens.lexer import Token
from dynsolve.answers.reading.tokens.prepare import prepared
from dynsolve.answers.reading.vocabulary import Vocabulary
from dynsolve.errors import ReadError
from dynsolve.notation.tree import Function, Node, Reference, Symbol
from dynsolve.notation.walk import mapped, names_in, walk
from dynsolve.quantities import families
from dynsolve.quantities.constraint_families import REDUCED

EITHER = re.compile(r"±|\\pm\b|\+/-")
OPPOSITE = re.compile(r"∓|\\mp\b|-/\+")
"""One of two signs, and the other."""


def value(vocabulary: Vocabulary, tokens: list[Token]) -> Node:
    """The formula that tokens are; raises ReadError where they are none, or an answer stands in it."""
    found = read_right_side(vocabulary, tokens)
    if not isinstance(found, RightSide):
        raise found
    if found.free:
        raise ReadError(f"{found.free[0]} is no name of this problem", 0, 1, "write it in its symbols")
    if not isinstance(found.value, Node):
        raise ReadError("a single expression is expected", 0, 1, "write one formula")
    formula = _with_forces(vocabulary, found.value)
    for part in walk(formula):
        if isinstance(part, Reference):
            raise ReadError(f"{part} stands in it", 0, 1, "write it in the coordinates: sin(q2) = 0")
    return formula


def _with_forces(vocabulary: Vocabulary, node: Node) -> Node:
    """The formula with generalized forces as symbols, where equations of motion are among the sets."""
    named = vocabulary.quantities
    if REDUCED.name not in named:
        return node

    def put(part: Node) -> Node:
        if isinstance(part, Reference) and named[part.quantity].family in (families.TAU, families.FORCE):
            place = part.row or named[part.quantity].index[0]
            return Symbol(vocabulary.coordinates[place - 1].force)
        return part

    return mapped(node, put)


def has_coordinate(vocabulary: Vocabulary, node: Node) -> bool:
    """Whether a coordinate stands in a formula."""
    return not names_in(node).isdisjoint(q.name for q in vocabulary.coordinates)


def coordinate_named(vocabulary: Vocabulary, name: str) -> str:
    """The coordinate that a text is the name of; empty for any other."""
    try:
        node = value(vocabulary, prepared(name))
    except ReadError:
        return ""
    q = vocabulary.coordinate(node)
    return q.name if q is not None and not (isinstance(node, Symbol) and node.dots) else ""


def function_named(vocabulary: Vocabulary, name: str) -> Function | None:
    """The sine or cosine of a coordinate that a text is the name of: c_2."""
    try:
        node = value(vocabulary, prepared(name))
    except ReadError:
        return None
    is_one = isinstance(node, Function) and vocabulary.coordinate(node.argument) is not None
    return node if isinstance(node, Function) and is_one else None


def names_within(vocabulary: Vocabulary, text: str) -> frozenset[str]:
    """The names of symbols in a formula; none where it cannot be read."""
    one_sign = OPPOSITE.sub("+", EITHER.sub("+", text))
    try:
        return frozenset().union(
            *(names_in(value(vocabulary, part)) for part in chain(prepared(one_sign))[-1:])
        )
    except ReadError:
        return frozenset()
